//! Exact flip order at the price of floats: each event carries a float enclosure of its time; where two enclosures
//! overlap, the exact quotients decide, computed once per event and kept; where those are equal, the perturbation.
//! Exact quotients are of 64-bit integers where the floats are certain of those (`filter.rs`: small coordinates on a grid),
//! else of dyadic numbers of any size.
//!
//! # The enclosure
//! N and D are evaluated in floats (`filter.rs`), which gives n, d and bounds e ≥ |N − n|, g ≥ |D − d|, valid for every finite
//! input, under- and overflow included (the proof is there). Let d > g, so that D > 0 is certain, and let
//! q = −n/d exactly. With τ = −N/D,
//!
//! > |τ − q| = |N/D − n/d| = |(N − n) + n/d·(d − D)| / D ≤ (e + |q|·g)/(d − g).
//!
//! In floats, with u = 2⁻⁵³, η = 2⁻¹⁰⁷⁴, T = 2⁻¹⁰²²: q̂ = fl(−n/d) has |q̂ − q| ≤ u|q̂| + η/2, so that
//! |q| ≤ (|q̂| + T)(1 + 2u). We take
//!
//! > w = (e + (|q̂| + T)·g)/(d − g)·(1 + 2⁻⁴⁸) + |q̂|·2⁻⁵² + T.
//!
//! The fraction has five roundings, the sums after it three, and the factor 1 + 2u is to be made up for; 1 + 2⁻⁴⁸ = 1 + 32u
//! does all that (`paper/theory.tex` has it in detail); the product may
//! underflow and lose η/2 ≤ u·e, because e ≥ T; d − g is a difference of doubles and does not
//! underflow; the quotient may, and loses η/2, which the last T covers together with that of q̂. Overflow makes w infinite
//! or NaN, and then no comparison is decided by it.
//!
//! # The comparison
//! Both numbers are multiplied by a power of two that brings the first time of a region near 1, and w is then rounded to
//! single precision and from there to the next number above, so that the queue has less to move. A product that underflows
//! errs by at most η/2, twice that is less than the 2⁻¹⁵⁰ by which w has grown at least; an overflow gives an infinite or NaN
//! enclosure.
//!
//! q̂_B − q̂_A > (w_A + w_B)(1 + 2⁻⁵⁰) in floats implies τ_A < τ_B: the left side is at most (1 + u) times its exact value,
//! the right side at least (1 + 2⁻⁵⁰)(1 − 2u) > 1 + u times w_A + w_B. NaN and infinity make it false.

use super::event::Signs;
use super::filter::{Bounded, Filter};
use super::motion::Motion;
use super::time::{ExactTimes, FlipTimes, Quotient, Timed, Timing, Undecided, same_vertices};
use crate::mesh::VertexId;
use crate::number::Dyadic;
use crate::number::bits::exponent;
use crate::predicate::PointStore;
use std::cell::Cell;
use std::cmp::Ordering;

/// A float enclosure of a time, multiplied by [`FilteredTimes`]' scale: it is within `width` of `middle`.
#[derive(Clone, Copy, Debug)]
pub struct Enclosure {
    /// The bits of a double: twelve bytes with the width, not sixteen.
    middle: [u32; 2],
    width: f32,
}

impl Enclosure {
    #[inline(always)]
    fn new(middle: f64, width: f32) -> Enclosure {
        let bits = middle.to_bits();
        Enclosure {
            middle: [bits as u32, (bits >> 32) as u32],
            width,
        }
    }

    #[inline(always)]
    fn middle(self) -> f64 {
        let [low, high] = self.middle;
        f64::from_bits(u64::from(high) << 32 | u64::from(low))
    }
}

/// Where the exact quotient of a time is kept: 0, or 1 + its place in [`FilteredTimes`]' list.
#[derive(Clone, Debug, Default)]
pub struct FilteredTime(Cell<u32>);

/// An exact quotient.
#[derive(Clone, Debug)]
enum Exactly {
    /// In quanta of the grid that all coordinates lie on.
    Integers(Integers),
    /// In numbers of any size.
    Big(Box<Quotient<Dyadic>>),
}

/// N, D and the coefficients of a circuit in quanta of the grid that all coordinates lie on.
#[derive(Clone, Debug)]
struct Integers {
    numerator: i64,
    denominator: i64,
    /// The identities of the five vertices, ascending, and their coefficients.
    terms: [(u32, i64); 5],
}

impl Integers {
    /// Which of two times comes first: the sign of t_0, then those of t_v. All products are of numbers of up to 53 bits.
    fn compare(&self, other: &Integers, ties: &mut u64) -> Ordering {
        let product = |x: i64, y: i64| i128::from(x) * i128::from(y);
        let (a, b) = (self, other);
        let t0 = product(a.numerator, b.denominator).cmp(&product(b.numerator, a.denominator));
        if t0.is_ne() {
            return t0.reverse();
        }
        *ties += 1;
        let (mut i, mut j) = (0, 0);
        while i < 5 || j < 5 {
            let (va, ca) = a.terms.get(i).copied().unwrap_or((u32::MAX, 0));
            let (vb, cb) = b.terms.get(j).copied().unwrap_or((u32::MAX, 0));
            let of_a = if va <= vb {
                product(ca, b.denominator)
            } else {
                0
            };
            let of_b = if vb <= va {
                product(cb, a.denominator)
            } else {
                0
            };
            let term = of_a.cmp(&of_b);
            if term.is_ne() {
                return term.reverse();
            }
            i += usize::from(va <= vb);
            j += usize::from(vb <= va);
        }
        Ordering::Equal
    }
}

/// Flip times whose order is exact and is mostly decided by floats.
pub struct FilteredTimes<'a, P> {
    points: &'a P,
    filter: Filter<'a, P>,
    exact: ExactTimes<'a, P, Dyadic>,
    quotients: Vec<Exactly>,
    /// A power of two by which enclosures are multiplied; known once there is a time.
    scale: Option<f64>,
    /// Comparisons that needed exact quotients.
    compared_exactly: u64,
    /// Comparisons of equal quotients of integers.
    ties: u64,
}

impl<'a, P: PointStore> FilteredTimes<'a, P> {
    /// For the given motion.
    pub fn new(motion: &'a Motion<'a, P>) -> Self {
        FilteredTimes {
            points: motion.points,
            filter: Filter::new(motion),
            exact: ExactTimes::new(motion),
            quotients: Vec::new(),
            scale: None,
            compared_exactly: 0,
            ties: 0,
        }
    }

    fn keep(&mut self, exactly: Exactly) -> FilteredTime {
        self.quotients.push(exactly);
        let place = u32::try_from(self.quotients.len()).expect("fewer than 2^32 events");
        FilteredTime(Cell::new(place))
    }

    /// The exact quotient of an event, computed if no comparison has needed it yet: its place in the list.
    fn exactly(&mut self, (event, time): Timed<FilteredTime>) -> usize {
        if time.0.get() == 0 {
            let quotient = self.exact.exact_quotient(event.circuit);
            let quotient = quotient.expect("only events with positive D are queued");
            let kept = self.keep(Exactly::Big(Box::new(quotient)));
            time.0.set(kept.0.get());
        }
        (time.0.get() - 1) as usize
    }

    /// The same in numbers of any size.
    fn big(&mut self, event: Timed<FilteredTime>) -> usize {
        let place = self.exactly(event);
        if let Exactly::Integers(_) = self.quotients[place] {
            let quotient = self.exact.exact_quotient(event.0.circuit);
            let quotient = quotient.expect("only events with positive D are queued");
            self.quotients[place] = Exactly::Big(Box::new(quotient));
        }
        place
    }

    /// N and D of a circuit and its coefficients, in quanta.
    fn integers(&self, circuit: [VertexId; 5], [n, d]: [i64; 2], c: [i64; 5]) -> Exactly {
        let mut terms = [0, 1, 2, 3, 4].map(|i| (self.points.identity(circuit[i]), c[i]));
        terms.sort_unstable();
        Exactly::Integers(Integers {
            numerator: n,
            denominator: d,
            terms,
        })
    }
}

impl<P: PointStore> FlipTimes for FilteredTimes<'_, P> {
    type Key = Enclosure;
    type Time = FilteredTime;
    const EXACT: bool = true;

    #[inline]
    fn prefetch(&self, v: VertexId) {
        self.filter.prefetch(v);
    }

    #[inline]
    fn time_across(
        &mut self,
        _: [VertexId; 4],
        circuit: [VertexId; 5],
        is_wanted: impl FnOnce(Signs, bool) -> bool,
    ) -> Option<Timing<Enclosure, FilteredTime>> {
        let mut rising = self.filter.evaluate(circuit);
        let may_rise = self.filter.may_rise(&mut rising);
        let signs = self.filter.signs(&rising);
        if !is_wanted(signs, may_rise) {
            return None;
        }
        if !rising.d.is_positive() {
            let quotient = self.exact.exact_quotient(circuit)?;
            return Some(Timing {
                key: Enclosure::new(0.0, f32::INFINITY),
                time: self.keep(Exactly::Big(Box::new(quotient))),
                signs,
            });
        }
        let n = self.filter.resting(&rising);
        let time = match self.filter.integers(&rising, &n) {
            Some((quotient, c)) => {
                let integers = self.integers(circuit, quotient, c);
                self.keep(integers)
            }
            None => FilteredTime::default(),
        };
        let (middle, width) = enclosure(&n, &rising.d);
        let filter = &self.filter;
        let scale = *self.scale.get_or_insert_with(|| {
            // The first flip may be due at time 0.
            let typical = [middle, filter.typical_time(&rising)];
            let typical = typical.into_iter().find(|time| time.is_normal());
            typical.map_or(1.0, inverse_power)
        });
        let key = Enclosure::new(middle * scale, ((width * scale) as f32).next_up());
        Some(Timing { key, time, signs })
    }

    #[inline]
    fn about(key: Enclosure) -> Option<f64> {
        Some(key.middle())
    }

    #[inline]
    fn compare_keys(a: Enclosure, b: Enclosure) -> Option<Ordering> {
        let gap = b.middle() - a.middle();
        let widths = (f64::from(a.width) + f64::from(b.width)) * (1.0 + 4.0 * f64::EPSILON);
        if gap > widths {
            Some(Ordering::Less)
        } else if -gap > widths {
            Some(Ordering::Greater)
        } else {
            None
        }
    }

    fn compare(&mut self, a: Timed<FilteredTime>, b: Timed<FilteredTime>) -> Ordering {
        self.compared_exactly += 1;
        let (ca, cb) = (&a.0.circuit, &b.0.circuit);
        if same_vertices(*ca, *cb) {
            // Two triangles of one circuit, or one triangle queued again: the same time, perturbed or not.
            self.ties += 1;
            return Ordering::Equal;
        }
        let (i, j) = (self.exactly(a), self.exactly(b));
        if let (Exactly::Integers(qa), Exactly::Integers(qb)) =
            (&self.quotients[i], &self.quotients[j])
        {
            return qa.compare(qb, &mut self.ties);
        }
        let (i, j) = (self.big(a), self.big(b));
        match (&self.quotients[i], &self.quotients[j]) {
            (Exactly::Big(qa), Exactly::Big(qb)) => {
                self.exact.compare_quotients((*ca, qa), (*cb, qb))
            }
            _ => unreachable!("both quotients have just been computed in numbers of any size"),
        }
    }

    fn undecided(&self) -> Undecided {
        let exact = self.exact.undecided();
        Undecided {
            compared_exactly: self.compared_exactly,
            ties: self.ties + exact.ties,
            ..exact
        }
    }
}

/// The middle and the half width of an interval that contains −N/D, for D certainly positive.
#[inline]
fn enclosure(n: &Bounded, d: &Bounded) -> (f64, f64) {
    // e is at least T, since the product below may underflow; and infinite where the bound overflowed to NaN, which the larger of
    // the two would forget.
    let e = match n.error {
        e if e.is_nan() => f64::INFINITY,
        e => e.max(f64::MIN_POSITIVE),
    };
    let g = d.error;
    let middle = -n.value / d.value;
    let slope = (e + (middle.abs() + f64::MIN_POSITIVE) * g) / (d.value - g);
    let width =
        slope * (1.0 + 16.0 * f64::EPSILON) + middle.abs() * f64::EPSILON + f64::MIN_POSITIVE;
    (middle, width)
}

/// A power of two that brings a normal number near 1.
fn inverse_power(x: f64) -> f64 {
    2f64.powi((-exponent(x)).clamp(-1000, 1000))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Number;
    use crate::predicate::{DoublePoints, formula};
    use crate::recover::flips::event::Event;
    use num_rational::BigRational;
    use num_traits::Signed;
    use proptest::prelude::*;

    /// Points that make near ties and extreme exponents.
    fn family() -> impl Strategy<Value = Vec<[f64; 3]>> {
        let lattice = prop::collection::vec([-3i32..4, -3..4, -3..4], 8)
            .prop_map(|p| p.into_iter().map(|q| q.map(f64::from)).collect::<Vec<_>>());
        let jittered = (
            lattice.clone(),
            prop::collection::vec([-2i32..3, -2..3, -2..3], 8),
        )
            .prop_map(|(p, j)| {
                let jitter = |x: f64, k: i32| x * (1.0 + f64::from(k) * f64::EPSILON);
                p.iter()
                    .zip(j)
                    .map(|(p, j)| [0, 1, 2].map(|i| jitter(p[i], j[i])))
                    .collect::<Vec<_>>()
            });
        let scaled = (jittered.clone(), -200i32..200).prop_map(|(p, e)| {
            p.into_iter()
                .map(|q| q.map(|x| x * 2f64.powi(e)))
                .collect::<Vec<_>>()
        });
        let mixed = prop::collection::vec(
            [(-2i32..3, -70i32..70), (-2..3, -70..70), (-2..3, -70..70)],
            8,
        )
        .prop_map(|p| {
            p.into_iter()
                .map(|q| q.map(|(x, e)| f64::from(x) * 2f64.powi(e)))
                .collect::<Vec<_>>()
        });
        prop_oneof![lattice, jittered, scaled, mixed]
    }

    /// The magnitudes of rates about so large a frame overflow, and become NaN where they meet a zero.
    #[test]
    fn rates_without_a_bound_decide_nothing() {
        let s = 8e153;
        let mut points = vec![[-s, -s, 0.0], [-s, s, 0.0], [s, s, 0.0]];
        points.extend([
            [0.8375779762864113, 0.9162698360159993, 0.5564543176442385],
            [0.6516717132180929, 1.5456227399408817, 1.5489977290853858],
            [1.7597665395587683, 1.5585642028599977, 0.6564545948058367],
            [0.7236390076577663, 0.85994653403759, -0.14819519827142358],
            [1.57386027649045, 2.18791710678488, 1.648998006246984],
        ]);
        let points = DoublePoints::new(points);
        let frame = [0, 1, 2].map(VertexId);
        let is_left = |v: VertexId| {
            points
                .orient3d([frame[0], frame[1], frame[2], v])
                .is_positive()
        };
        let motion = Motion::new(&points, frame, &is_left);
        let mut exact = ExactTimes::<_, Dyadic>::new(&motion);
        // In all roles: the order in which vertices become known must not matter.
        for turn in 0..5 {
            let mut circuit = [3, 4, 5, 6, 7].map(VertexId);
            circuit.rotate_left(turn);
            let [a, b, c, d, _] = circuit;
            if points.orient3d([a, b, c, d]).is_negative() {
                circuit.swap(0, 1);
            }
            let filtered = FilteredTimes::new(&motion).time(circuit);
            assert_eq!(filtered.is_some(), exact.time(circuit).is_some(), "{turn}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(3000))]

        /// The true time is within the enclosure, and filtered and exact order agree.
        #[test]
        fn enclosures_hold_and_orders_agree(p in family()) {
            let points = DoublePoints::new(p);
            let is_left = |v: VertexId| v.0.is_multiple_of(2);
            let frame = [5, 6, 7].map(VertexId);
            let motion = Motion::new(&points, frame, &is_left);
            let mut filtered = FilteredTimes::new(&motion);
            let mut exact = ExactTimes::<_, Dyadic>::new(&motion);
            let mut rational = ExactTimes::<_, BigRational>::new(&motion);
            let mut events = Vec::new();
            for skip in 0..6u32 {
                let left_out = |&i: &u32| i != skip;
                let circuit: Vec<VertexId> = (0..6).filter(left_out).map(VertexId).collect();
                let circuit: [VertexId; 5] = circuit.try_into().expect("five of six");
                let (f, e, r) = (filtered.time(circuit), exact.time(circuit), rational.time(circuit));
                prop_assert_eq!(f.is_some(), e.is_some());
                prop_assert_eq!(f.is_some(), r.is_some());
                let (Some(f), Some(e), Some(r)) = (f, e, r) else { continue };
                let (middle, width) = (f.key.middle(), f.key.width);
                let (n, d) = r.time.parts();
                if width.is_finite() && middle.is_finite() {
                    let rational = <BigRational as Number>::from_f64;
                    let scale = rational(filtered.scale.expect("there is a time"));
                    let distance = (-n / d * scale - rational(middle)).abs();
                    prop_assert!(distance <= rational(width.into()));
                }
                if let Some(place) = f.time.0.get().checked_sub(1)
                    && let Exactly::Integers(integers) = &filtered.quotients[place as usize]
                {
                    let g = <BigRational as Number>::from_f64(2f64.powi(points.grid().expect("a grid")));
                    let quanta = |k: i64, degree: i32| BigRational::from_integer(k.into()) * g.pow(degree);
                    prop_assert_eq!(&quanta(integers.numerator, 5), n);
                    prop_assert_eq!(&quanta(integers.denominator, 6), d);
                    let (c, _) = formula::circuit(circuit.map(|v| points.coordinates::<BigRational>(v)).each_ref());
                    for (v, k) in integers.terms {
                        let place = circuit.iter().position(|&w| w.0 == v).expect("of the circuit");
                        prop_assert_eq!(&quanta(k, 3), &c[place]);
                    }
                }
                let event = Event { circuit, tet: crate::mesh::TetId(0), signs: Signs::UNKNOWN };
                events.push((event, f, e));
            }
            for (a, fa, ea) in &events {
                for (b, fb, eb) in &events {
                    let known = FilteredTimes::<DoublePoints>::compare_keys(fa.key, fb.key);
                    let order = exact.compare((a, &ea.time), (b, &eb.time));
                    prop_assert!(known.is_none_or(|o| o == order));
                    prop_assert_eq!(filtered.compare((a, &fa.time), (b, &fb.time)), order);
                }
            }
        }
    }
}
