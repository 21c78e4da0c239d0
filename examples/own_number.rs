//! Inserts polygons by flips over two number types that this file defines, and compares them with the exact order:
//! fractions of 128-bit integers, exact as long as they fit; and floats that keep track of their error, which do not
//! know everything.

use std::cmp::Ordering;
use std::error::Error;
use std::ops::{Add, Mul, Sub};
use tetflip::cdt::Cdt;
use tetflip::cdt::Insertion;
use tetflip::cdt::flips::{
    Evaluation, ExactNumbers, FlipNumbers, FlipOrder, RoundedNumbers, Rules,
};
use tetflip::exchange::{Facet, Plc};
use tetflip::mesh::VertexId;
use tetflip::number::{Exact, Float, Number, Sign};
use tetflip::report::Report;

/// An integer number of sixteenths, squares of sixteenths, …: m·16^(−k). Exact for small coordinates with few binary
/// places.
#[derive(Clone, Debug)]
struct Sixteenths {
    m: i128,
    k: u32,
}

impl Sixteenths {
    /// Both numbers over one power of 16.
    fn aligned(&self, other: &Sixteenths) -> [i128; 2] {
        let k = self.k.max(other.k);
        [self, other].map(|x| x.m.checked_mul(16i128.pow(k - x.k)).expect(TOO_LARGE))
    }
}

const TOO_LARGE: &str = "the coordinates of this example are small";

impl Add<&Sixteenths> for Sixteenths {
    type Output = Sixteenths;

    fn add(self, other: &Sixteenths) -> Sixteenths {
        let [a, b] = self.aligned(other);
        Sixteenths {
            m: a.checked_add(b).expect(TOO_LARGE),
            k: self.k.max(other.k),
        }
    }
}

impl Sub<&Sixteenths> for Sixteenths {
    type Output = Sixteenths;

    fn sub(self, other: &Sixteenths) -> Sixteenths {
        let [a, b] = self.aligned(other);
        Sixteenths {
            m: a.checked_sub(b).expect(TOO_LARGE),
            k: self.k.max(other.k),
        }
    }
}

impl Mul<&Sixteenths> for Sixteenths {
    type Output = Sixteenths;

    /// The exponents of products add up.
    #[allow(clippy::suspicious_arithmetic_impl)]
    fn mul(self, other: &Sixteenths) -> Sixteenths {
        Sixteenths {
            m: self.m.checked_mul(other.m).expect(TOO_LARGE),
            k: self.k + other.k,
        }
    }
}

impl Number for Sixteenths {
    fn from_f64(x: f64) -> Self {
        let (mut x, mut k) = (x, 0);
        while x != x.trunc() {
            x *= 16.0;
            k += 1;
        }
        Sixteenths { m: x as i128, k }
    }

    fn sign(&self) -> Option<Sign> {
        Some(match self.m.cmp(&0) {
            Ordering::Less => Sign::Negative,
            Ordering::Equal => Sign::Zero,
            Ordering::Greater => Sign::Positive,
        })
    }

    fn to_f64(&self) -> f64 {
        self.m as f64 / 16f64.powi(self.k as i32)
    }
}

impl Exact for Sixteenths {}

/// An interval that contains the number. Its middle serves as a rounded time.
#[derive(Clone, Debug)]
struct Interval {
    low: f64,
    high: f64,
}

impl Interval {
    /// Rounded outwards.
    fn around(ends: &[f64]) -> Interval {
        let low = ends.iter().copied().fold(f64::INFINITY, f64::min);
        let high = ends.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        Interval {
            low: low.next_down(),
            high: high.next_up(),
        }
    }

    fn middle(&self) -> f64 {
        self.low + (self.high - self.low) / 2.0
    }
}

impl Add<&Interval> for Interval {
    type Output = Interval;

    fn add(self, other: &Interval) -> Interval {
        Interval::around(&[self.low + other.low, self.high + other.high])
    }
}

impl Sub<&Interval> for Interval {
    type Output = Interval;

    fn sub(self, other: &Interval) -> Interval {
        Interval::around(&[self.low - other.high, self.high - other.low])
    }
}

impl Mul<&Interval> for Interval {
    type Output = Interval;

    fn mul(self, other: &Interval) -> Interval {
        let (a, b) = (self, other);
        Interval::around(&[
            a.low * b.low,
            a.low * b.high,
            a.high * b.low,
            a.high * b.high,
        ])
    }
}

impl Number for Interval {
    fn from_f64(x: f64) -> Self {
        Interval { low: x, high: x }
    }

    fn sign(&self) -> Option<Sign> {
        if self.low > 0.0 {
            Some(Sign::Positive)
        } else if self.high < 0.0 {
            Some(Sign::Negative)
        } else {
            None
        }
    }

    fn to_f64(&self) -> f64 {
        self.middle()
    }
}

impl Float for Interval {
    fn negated_quotient(n: &Self, d: &Self) -> Option<Self> {
        let time = -n.middle() / d.middle();
        time.is_finite().then(|| Interval::from_f64(time))
    }

    fn compare(a: &Self, b: &Self) -> Ordering {
        a.middle().total_cmp(&b.middle())
    }
}

/// The tetrahedra after all polygons have been inserted in some numbers.
fn tets_in<T: FlipNumbers>(cdt: &Cdt, numbers: &T) -> Result<Vec<[VertexId; 4]>, Box<dyn Error>> {
    let mut cdt = cdt.clone();
    let counts = cdt.insert_polygons_in(numbers, &mut Report::default(), None)?;
    println!(
        "{} flips, {} events",
        counts.flips.flips(),
        counts.flips.queued
    );
    Ok(sorted_tets(&cdt))
}

fn sorted_tets(cdt: &Cdt) -> Vec<[VertexId; 4]> {
    let mut tets: Vec<[VertexId; 4]> = cdt
        .mesh()
        .finite()
        .map(|t| cdt.mesh().vertices(t))
        .collect();
    for tet in &mut tets {
        tet.sort_unstable();
    }
    tets.sort_unstable();
    tets
}

/// Points near a rectangle that cuts through all of them, on a grid: many flips, and ties between their times.
fn scene() -> Plc {
    let mut state = 1u32;
    let mut next = |n: u32| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from((state >> 8) % n) / 16.0
    };
    let mut vertices = vec![[-1., -1., 0.], [3., -1., 0.], [3., 3., 0.], [-1., 3., 0.]];
    while vertices.len() < 100 {
        let p = [next(32), next(32), next(10) - 0.25];
        if p[2] != 0.0 && !vertices.contains(&p) {
            vertices.push(p);
        }
    }
    let rectangle = Facet {
        polygons: vec![[0, 1, 2, 3].map(VertexId).to_vec()],
        ..Facet::default()
    };
    Plc {
        vertices,
        facets: vec![rectangle],
        ..Plc::default()
    }
}

/// Compares the orders.
pub fn main() -> Result<(), Box<dyn Error>> {
    let cdt = Cdt::with_segments(&scene(), true, &mut Report::default())?;
    let mut exact = cdt.clone();
    let order = Insertion::Flip(FlipOrder::EXACT);
    let counts = exact.insert_polygons(order, &mut Report::default(), &mut |_polygons_done| {})?;
    assert!(counts.flips.flips() > 100 && counts.flips.ties > 0);
    let expected = sorted_tets(&exact);

    let sixteenths = tets_in(&cdt, &ExactNumbers::<Sixteenths>::default())?;
    assert_eq!(sixteenths, expected, "exact numbers lead to the CDT");

    // Rounded times may fail, and then say so; they never end in other tetrahedra.
    let rounded = RoundedNumbers::<Interval>::new(Evaluation::Plain, Rules::default());
    match tets_in(&cdt, &rounded) {
        Ok(tets) => assert_eq!(tets, expected, "the CDT is unique"),
        Err(failure) => println!("the order of intervals failed: {failure}"),
    }
    Ok(())
}
