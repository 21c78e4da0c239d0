//! N and D of a circuit in floats with error bounds, and exactly where all coordinates are small integers on a grid.
//!
//! The evaluation is that of [`formula`](crate::predicate::formula) over plain doubles first, with bounds from the largest
//! differences alone, and where those do not suffice over [`Approx`], so its proof of the error bounds applies; the rates
//! d_v are orient3d determinants, computed once per vertex, of index [`RATE_INDEX`] (difference 1,
//! product 3, minor 4, product 6, two sums 8). The zero rate of a vertex that does not move fulfils the same bound.
//!
//! # Bounds from the largest differences
//! By the proof in [`Approx`] an evaluation errs by at most k·u′·m, where k is an index that depends on the formula and m
//! the formula over magnitudes. Let X, Y, Z be the largest coordinate differences to the origin, a vertex of the
//! tetrahedron, R twice the largest magnitude of the rate of any vertex so far, so that it bounds the magnitude of a rate
//! relative to that of the origin, and L = X² + Y² + Z². Then
//!
//! | value | k | m at most |
//! |---|---|---|
//! | volume of the tetrahedron, and with the apex in place of another vertex | 8: cross product 4, product 6, two sums | 6·XYZ |
//! | volume with the apex in place of the origin | 11: three differences more | 4·6·XYZ |
//! | D = Σ V_i·d_i − V·d_w, V_i with the apex in place of vertex i | 21: rate 9, product 18, two sums, difference | 4·6·XYZ·R |
//! | N, the same for squares | 17: square 5, product 14, two sums, difference | 4·6·XYZ·L |
//!
//! D and N as G·w − V·d_w with the gradient G, which rounded times take for the values of plain doubles, have the same
//! index and magnitude: for D, G 16 (rate 9, product 14, two sums), product 18, two sums, difference.
//!
//! The bounds of this kind are used where X, Y and Z are in [2^−150, 2^150] and R is in [2^−450, 2^450]. Nothing overflows
//! then: all is below 2^(450+450+20). Products may underflow, and the terms T of that proof, 2^−1022 times the other factors of
//! a product, are to be made up for; relative to the bound they are largest where the product is that with R, or with L,
//! and there at most 2^−1022·2^(450+450)·2^52 = 2^−70. The constants are rounded up by 1 %, which pays for them, and for the
//! rounding of m.
//!
//! # Integers
//! If all coordinates are multiples of 2^g then the c_i, N and D are multiples of the quanta 2^(3g), 2^(5g) and 2^(6g). If
//! the error of a value is less than half of its quantum, the number is the multiple nearest to the value. If also the
//! value is less than 2^52 quanta, that multiple is found in floats: the division by a power of two is exact (or
//! underflows towards 0, the nearest multiple then), and so is rounding to an integer.

use super::motion::Motion;
use crate::machine::prefetch;
use crate::mesh::{VertexId, slot_of};
use crate::number::{Approx, Sign, Vec3};
use crate::predicate::PointStore;
use crate::predicate::formula::Lifted;

/// The error index of an orient3d determinant of given doubles; see [`Approx`]. (A frame may have exact Steiner points.)
const RATE_INDEX: u32 = 8;

/// A vertex: position and rate. NaN positions where they are not doubles: then nothing is certain.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
struct Moving([f64; 4]);

impl Moving {
    /// One that has not been computed yet: no position is infinite.
    const UNKNOWN: Moving = Moving([f64::INFINITY; 4]);

    #[inline(always)]
    fn is_known(&self) -> bool {
        self.0[0] != f64::INFINITY
    }
}

/// Evaluates circuits in floats.
pub(super) struct Filter<'a, P> {
    motion: &'a Motion<'a, P>,
    /// By the vertices' numbers.
    known: Vec<Moving>,
    /// Of the rates of those that are known.
    largest_magnitude: f64,
    /// The largest index of a rate: [`RATE_INDEX`], or more where vertices of the polygon's frame are no doubles.
    rate_index: u32,
    /// The bound of D times 1/(XYZ); infinite where the bounds do not hold.
    rising_bound: f64,
    grid: Grid,
}

/// 2^(3g), 2^(5g), 2^(6g), for coordinates on a grid 2^g; 0 where that is no normal double.
#[derive(Clone, Copy)]
struct Grid {
    coefficient: f64,
    numerator: f64,
    denominator: f64,
}

/// k·m/(XYZ) of the module's table, times u′, rounded up.
const VOLUME_BOUND: f64 = 48.5 * f64::EPSILON;
/// The same for the apex in place of the origin.
const ORIGIN_BOUND: f64 = 267.0 * f64::EPSILON;
/// The same for D, times 1/R.
const RISING_BOUND: f64 = 510.0 * f64::EPSILON;
/// The same for N, times 1/L.
const RESTING_BOUND: f64 = 413.0 * f64::EPSILON;

/// A value and a bound of its error.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounded {
    /// The value.
    pub value: f64,
    /// At least the distance to the number that it stands for; infinite or NaN where nothing is known.
    pub error: f64,
}

impl From<Approx> for Bounded {
    fn from(x: Approx) -> Bounded {
        Bounded {
            value: x.value(),
            error: x.error(),
        }
    }
}

impl Bounded {
    /// The sign of the number, if it is known to be an integer multiple of `quantum`.
    #[inline(always)]
    fn sign_on_grid(&self, quantum: f64) -> Option<Sign> {
        if self.value > self.error {
            Some(Sign::Positive)
        } else if self.value < -self.error {
            Some(Sign::Negative)
        } else if self.value.abs() + self.error < quantum * (1.0 - f64::EPSILON) {
            Some(Sign::Zero)
        } else {
            None
        }
    }

    /// Whether the number is certainly positive.
    #[inline(always)]
    pub(super) fn is_positive(&self) -> bool {
        self.value > self.error
    }

    /// The number as a multiple of `quantum`, which it is known to be, if the bound leaves only one possibility.
    #[inline(always)]
    fn in_quanta(&self, quantum: f64) -> Option<i64> {
        // No quantum: 0 < 0 is false, as bounds are positive.
        let certain = self.error < 0.5 * quantum && self.is_small(quantum);
        certain.then(|| (self.value / quantum).round() as i64)
    }

    /// Whether a smaller error might make an integer of it.
    #[inline(always)]
    fn is_small(&self, quantum: f64) -> bool {
        self.value.abs() < quantum * 2f64.powi(52)
    }
}

/// A tetrahedron in floats: what the evaluations of its facets have in common.
pub struct LiftedTet {
    ids: [VertexId; 4],
    origin: Moving,
    /// The places of the others relative to the origin.
    others: [Vec3<f64>; 3],
    /// Their rates relative to that of the origin.
    rates: [f64; 3],
    lifted: Lifted<f64>,
    /// X, Y and Z, as far as the tetrahedron itself goes.
    largest: [f64; 3],
}

/// The apex across a facet of a lifted tetrahedron.
pub(super) struct Across {
    apex: VertexId,
    /// Its place and its rate relative to the origin.
    w: Vec3<f64>,
    rate: f64,
    /// The volumes of the tetrahedron with the apex in place of the others.
    volumes: [f64; 3],
    /// X·Y·Z, and L; infinite where the bounds do not hold.
    product: f64,
    squares: f64,
    /// D.
    pub d: Bounded,
}

impl<'a, P: PointStore> Filter<'a, P> {
    pub(super) fn new(motion: &'a Motion<'a, P>) -> Self {
        let quantum = |degree: i32| {
            let exponent = motion.points.grid().map(|g| g.saturating_mul(degree));
            let normal = exponent.filter(|e| (-1022..=1023).contains(e));
            normal.map_or(0.0, |e| 2f64.powi(e))
        };
        Filter {
            motion,
            known: Vec::new(),
            largest_magnitude: 0.0,
            rate_index: RATE_INDEX,
            rising_bound: f64::INFINITY,
            grid: Grid {
                coefficient: quantum(3),
                numerator: quantum(5),
                denominator: quantum(6),
            },
        }
    }

    #[inline(always)]
    fn vertex(&mut self, v: VertexId) -> Moving {
        let number = self.motion.number(v);
        match self.known.get(number) {
            Some(known) if known.is_known() => *known,
            _ => self.know(v, number),
        }
    }

    #[cold]
    fn know(&mut self, v: VertexId, number: usize) -> Moving {
        if number >= self.known.len() {
            self.known.resize(number + 1, Moving::UNKNOWN);
        }
        let double = |x: &Approx| if x.index() == 0 { x.value() } else { f64::NAN };
        let position = self.motion.points.coordinates::<Approx>(v);
        let [x, y, z] = position.0.each_ref().map(double);
        let rate = self.motion.rate::<Approx>(v);
        let is_double = !(x.is_nan() || y.is_nan() || z.is_nan());
        if is_double {
            // A magnitude that overflowed may be NaN, which `max` would forget: without a bound nothing is certain.
            let magnitude = Some(rate.magnitude()).filter(|m| !m.is_nan());
            let magnitude = magnitude.unwrap_or(f64::INFINITY);
            self.largest_magnitude = self.largest_magnitude.max(magnitude);
            self.rate_index = self.rate_index.max(rate.index());
            let of_doubles = self.rate_index <= RATE_INDEX;
            if !of_doubles {
                // Rates about vertices that are no doubles are on no grid.
                self.grid.denominator = 0.0;
            }
            let r = 2.0 * self.largest_magnitude;
            let holds = of_doubles && (2f64.powi(-450)..=2f64.powi(450)).contains(&r);
            self.rising_bound = if holds {
                RISING_BOUND * r
            } else {
                f64::INFINITY
            };
        }
        self.known[number] = Moving([x, y, z, rate.value()]);
        self.known[number]
    }

    /// Lets the processor fetch a vertex, where that takes no look elsewhere.
    #[inline(always)]
    pub(super) fn prefetch(&self, v: VertexId) {
        if self.motion.is_of_few() {
            prefetch(&self.known, v.index());
        }
    }

    /// Prepares the evaluation of the facets of a positive tetrahedron.
    #[inline(always)]
    pub(super) fn lift(&mut self, tet: [VertexId; 4]) -> LiftedTet {
        let origin = self.vertex(tet[0]);
        let others = [
            self.vertex(tet[1]),
            self.vertex(tet[2]),
            self.vertex(tet[3]),
        ];
        let [a, b, c] = [
            from_origin(&others[0], &origin),
            from_origin(&others[1], &origin),
            from_origin(&others[2], &origin),
        ];
        let lifted = Lifted::new([&a, &b, &c]);
        let rate = |i: usize| others[i].0[3] - origin.0[3];
        let largest = |i: usize| larger(larger(a.0[i].abs(), b.0[i].abs()), c.0[i].abs());
        LiftedTet {
            ids: tet,
            rates: [rate(0), rate(1), rate(2)],
            largest: [largest(0), largest(1), largest(2)],
            origin,
            others: [a, b, c],
            lifted,
        }
    }

    /// D for the tetrahedron and the apex across one of its facets; `None` if certainly D ≤ 0.
    #[inline(always)]
    pub(super) fn across(&mut self, tet: &LiftedTet, apex: VertexId) -> Option<Across> {
        let moving = self.vertex(apex);
        let w = from_origin(&moving, &tet.origin);
        let largest = |i: usize| larger(tet.largest[i], w.0[i].abs());
        let (x, y, z) = (largest(0), largest(1), largest(2));
        let squares = x * x + y * y + z * z;
        let mut product = x * y * z;
        // No square is more than their sum.
        if (squares > 2f64.powi(300)) | (smaller(smaller(x, y), z) < 2f64.powi(-150)) {
            product = f64::INFINITY;
        }
        let rate = moving.0[3] - tet.origin.0[3];
        let volumes = tet.lifted.with_in_place(&w);
        let d = Bounded {
            value: weighted(&volumes, &tet.rates) - tet.lifted.volume() * rate,
            error: self.rising_bound * product,
        };
        let mut across = Across {
            apex,
            w,
            rate,
            volumes,
            product,
            squares,
            d,
        };
        let quantum = self.grid.denominator;
        let sign = match across.d.sign_on_grid(quantum) {
            Some(sign) => Some(sign),
            None => {
                across.d = self.in_approx(tet, &across).rising();
                across.d.sign_on_grid(quantum)
            }
        };
        (!matches!(sign, Some(Sign::Negative | Sign::Zero))).then_some(across)
    }

    /// N.
    #[inline(always)]
    pub(super) fn resting(&self, tet: &LiftedTet, across: &Across) -> Bounded {
        let [a, b, c] = &tet.others;
        let squares = [a.dot(a), b.dot(b), c.dot(c)];
        let height = across.w.dot(&across.w);
        Bounded {
            value: weighted(&across.volumes, &squares) - tet.lifted.volume() * height,
            error: RESTING_BOUND * across.product * across.squares,
        }
    }

    /// N and D as plain doubles give them by way of the gradients.
    #[inline(always)]
    pub(super) fn plain(&self, tet: &LiftedTet, across: &Across) -> [f64; 2] {
        let [a, b, c] = &tet.others;
        let below = |heights: [f64; 3], height: f64| {
            let gradient = tet.lifted.gradient(heights.each_ref());
            tet.lifted.below(&gradient, &across.w, &height)
        };
        [
            below([a.dot(a), b.dot(b), c.dot(c)], across.w.dot(&across.w)),
            below(tet.rates, across.rate),
        ]
    }

    /// N and D in quanta, if they are certain.
    #[inline(always)]
    pub(super) fn integers(
        &self,
        tet: &LiftedTet,
        across: &Across,
        n: &Bounded,
    ) -> Option<[i64; 2]> {
        let (quantum_n, quantum_d) = (self.grid.numerator, self.grid.denominator);
        if !n.is_small(quantum_n) || !across.d.is_small(quantum_d) {
            return None;
        }
        let integers = |n: &Bounded, d: &Bounded| {
            let (n, d) = (n.in_quanta(quantum_n)?, d.in_quanta(quantum_d)?);
            Some([n, d])
        };
        integers(n, &across.d).or_else(|| {
            let approx = self.in_approx(tet, across);
            integers(&approx.resting(), &approx.rising())
        })
    }

    /// The signs of c_x, c_y, c_z of a circuit, for a triangle xyz of the lifted tetrahedron, where they are certain.
    #[inline(always)]
    pub(super) fn signs(
        &self,
        tet: &LiftedTet,
        across: &Across,
        circuit: [VertexId; 5],
    ) -> [Option<Sign>; 3] {
        let volumes = plain_volumes(tet, across);
        let [_, x, y, z] = places(tet, circuit);
        let quantum = self.grid.coefficient;
        // Written out: array::map is not always inlined.
        let sign = |i: usize| match volumes[i].sign_on_grid(quantum) {
            Some(sign) => Some(-sign),
            None => self.in_approx(tet, across).sign_of_coefficient(i, quantum),
        };
        [sign(x), sign(y), sign(z)]
    }

    /// All five coefficients of a circuit in quanta, if all are certain: c_w is the volume of the tetrahedron, and those of
    /// its vertices are the volumes with the apex in their place, negated.
    #[inline(always)]
    pub(super) fn coefficients(
        &self,
        tet: &LiftedTet,
        across: &Across,
        circuit: [VertexId; 5],
    ) -> Option<[i64; 5]> {
        let quantum = self.grid.coefficient;
        let in_quanta = |[o, a, b, c, volume]: [Bounded; 5]| {
            let with_apex = [
                o.in_quanta(quantum)?,
                a.in_quanta(quantum)?,
                b.in_quanta(quantum)?,
                c.in_quanta(quantum)?,
            ];
            let [v, x, y, z] = places(tet, circuit).map(|i| -with_apex[i]);
            Some([v, x, y, z, volume.in_quanta(quantum)?])
        };
        let plain = plain_volumes(tet, across);
        in_quanta(plain).or_else(|| in_quanta(self.in_approx(tet, across).volumes()))
    }

    /// The same evaluations with running error bounds.
    #[cold]
    #[inline(never)]
    fn in_approx(&self, tet: &LiftedTet, across: &Across) -> InApprox {
        let known = |v: VertexId| self.known[self.motion.number(v)];
        let position = |v: VertexId| {
            let Moving([x, y, z, _]) = known(v);
            Vec3::<Approx>::from_f64([x, y, z])
        };
        let rate = |v: VertexId| {
            Approx::with_bound(known(v).0[3], self.largest_magnitude, self.rate_index)
        };
        let [o, a, b, c] = tet.ids;
        let (origin, at_origin) = (position(o), rate(o));
        let others = [a, b, c].map(|v| position(v).sub(&origin));
        InApprox {
            lifted: Lifted::new(others.each_ref()),
            rates: [a, b, c].map(|v| rate(v) - &at_origin),
            w: position(across.apex).sub(&origin),
            rate: rate(across.apex) - &at_origin,
            others,
        }
    }
}

/// The larger of two numbers, one instruction; NaN if the second one is.
#[inline(always)]
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// The smaller of two numbers; NaN if the second one is.
#[inline(always)]
fn smaller(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// Σ V_i·h_i.
#[inline(always)]
fn weighted(volumes: &[f64; 3], heights: &[f64; 3]) -> f64 {
    volumes[0] * heights[0] + volumes[1] * heights[1] + volumes[2] * heights[2]
}

/// Where v, x, y, z are in the lifted tetrahedron.
#[inline(always)]
fn places(tet: &LiftedTet, [v, x, y, z, _]: [VertexId; 5]) -> [usize; 4] {
    let place = |p: VertexId| slot_of(&tet.ids, p);
    [place(v), place(x), place(y), place(z)]
}

/// The volumes of the tetrahedron with the apex in the place of the origin and of the others, and its own.
#[inline(always)]
fn plain_volumes(tet: &LiftedTet, across: &Across) -> [Bounded; 5] {
    let volume = *tet.lifted.volume();
    let [a, b, c] = across.volumes;
    let bounded = |value: f64, bound: f64| Bounded {
        value,
        error: bound * across.product,
    };
    [
        bounded(volume - a - b - c, ORIGIN_BOUND),
        bounded(a, VOLUME_BOUND),
        bounded(b, VOLUME_BOUND),
        bounded(c, VOLUME_BOUND),
        bounded(volume, VOLUME_BOUND),
    ]
}

/// The same evaluations with running error bounds.
struct InApprox {
    others: [Vec3<Approx>; 3],
    rates: [Approx; 3],
    lifted: Lifted<Approx>,
    w: Vec3<Approx>,
    rate: Approx,
}

impl InApprox {
    fn rising(&self) -> Bounded {
        let gradient = self.lifted.gradient(self.rates.each_ref());
        self.lifted.below(&gradient, &self.w, &self.rate).into()
    }

    fn resting(&self) -> Bounded {
        let squares = self.others.each_ref().map(|p| p.dot(p));
        let gradient = self.lifted.gradient(squares.each_ref());
        let height = self.w.dot(&self.w);
        self.lifted.below(&gradient, &self.w, &height).into()
    }

    /// That of −volume.
    fn sign_of_coefficient(&self, i: usize, quantum: f64) -> Option<Sign> {
        self.volumes()[i].sign_on_grid(quantum).map(|sign| -sign)
    }

    fn volumes(&self) -> [Bounded; 5] {
        let volume = *self.lifted.volume();
        let [a, b, c] = self.lifted.with_in_place(&self.w);
        [volume - &a - &b - &c, a, b, c, volume].map(Bounded::from)
    }
}

/// p − origin.
#[inline(always)]
fn from_origin(p: &Moving, origin: &Moving) -> Vec3<f64> {
    let (p, origin) = (&p.0, &origin.0);
    Vec3([p[0] - origin[0], p[1] - origin[1], p[2] - origin[2]])
}
