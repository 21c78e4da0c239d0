//! N and D of a circuit in floats with error bounds, and exactly where all coordinates are small integers on a grid.
//!
//! The evaluation is that of [`pairs`](crate::predicate::pairs) over plain doubles first, with bounds from the largest
//! differences alone, and where those do not suffice that of [`formula`] over [`Approx`], so its proof of the error
//! bounds applies; the rates d_v are orient3d determinants, computed once per vertex, of index [`RATE_INDEX`]
//! (difference 1, product 3, minor 4, product 6, two sums 8). The zero rate of a vertex that does not move fulfils the
//! same bound.
//!
//! # Bounds from the largest differences
//! By the proof in [`Approx`] an evaluation errs by at most k·u′·m, where k is an index that depends on the formula and
//! m the formula over magnitudes. Let X, Y, Z be the largest coordinate differences to the origin, the vertex w of the
//! circuit, R twice the largest magnitude of the rate of any vertex so far, so that it bounds the magnitude of a rate
//! relative to that of the origin, and L = X² + Y² + Z². Then
//!
//! | value | k | m at most |
//! |---|---|---|
//! | c_v, c_x, c_y, c_z | 8: minor 4, product 6, two sums | 6·XYZ |
//! | c_w = −(c_v + c_x + c_y + c_z) | 11: three sums more | 4·6·XYZ |
//! | D = −Σ c_i·d_i | 20: rate 9, product 18, two sums | 4·6·XYZ·R |
//! | N, the same for squares | 16: square 5, product 14, two sums | 4·6·XYZ·L |
//!
//! The bounds of this kind are used where all coordinates are at most 2^149 in magnitude, so that X, Y and Z are at
//! most 2^150, and where R is at most 2^450. Nothing overflows then: all is below 2^(450+450+20). Products may
//! underflow, and the terms T = 2^−1022 of that proof, one for each product, are to be made up for. For c they add up
//! to at most 9·T·2^150, for D to 40·T·2^(150+450), for N to 200·T·2^450, and k·u′ times that is less than [`FLOOR`] =
//! 2^−450, which is added to all bounds. The constants are rounded up by 1 %, which pays for the rounding of m.
//!
//! Where a coordinate is NaN so is D, as each term has each coordinate of its three vertices; then nothing is certain.
//! (Otherwise the largest of NaN and numbers might be too small for what does not depend on the NaN.)
//!
//! # Integers
//! If all coordinates are multiples of 2^g then the c_i, N and D are multiples of the quanta 2^(3g), 2^(5g) and 2^(6g):
//! [`Bounded`] tells when that makes integers of them.

use super::event::Signs;
use super::motion::PolygonMotion;
use crate::kinetic::Bounded;
use crate::machine::prefetch;
use crate::mesh::VertexId;
use crate::number::{Approx, Sign, Vec3};
use crate::predicate::{PointStore, formula, pairs};

/// The error index of an orient3d determinant of given doubles; see [`Approx`]. (A frame may have exact Steiner
/// points.)
const RATE_INDEX: u32 = 8;

/// A vertex: position and rate. NaN positions where they are not doubles: then nothing is certain.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub(super) struct Moving(pub(super) [f64; 4]);

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
    motion: &'a PolygonMotion<'a, P>,
    /// By the vertices' numbers.
    known: Vec<Moving>,
    /// Whether all vertices are known, and their ids are their numbers.
    is_complete: bool,
    /// Of the rates of those that are known.
    largest_magnitude: f64,
    /// The largest index of a rate: [`RATE_INDEX`], or more where vertices of the polygon's frame are no doubles.
    rate_index: u32,
    /// The bound of D times 1/(XYZ); infinite where the bounds do not hold.
    rising_bound: f64,
    /// [`FLOOR`]; infinite where the bounds do not hold.
    floor: f64,
    grid: Grid,
}

/// 2^(3g), 2^(5g), 2^(6g), for coordinates on a grid 2^g; 0 where that is no normal double.
#[derive(Clone, Copy)]
struct Grid {
    coefficient: f64,
    numerator: f64,
    denominator: f64,
}

/// k·m/(XYZ) of the module's table, times u′, rounded up: c_v, c_x, c_y, c_z.
const COEFFICIENT_BOUND: f64 = 48.5 * f64::EPSILON;
/// The same for c_w.
const ORIGIN_BOUND: f64 = 267.0 * f64::EPSILON;
/// The same for D, times 1/R.
const RISING_BOUND: f64 = 485.0 * f64::EPSILON;
/// The same for N, times 1/L.
const RESTING_BOUND: f64 = 388.0 * f64::EPSILON;
/// What underflow adds to all bounds at most: 2^−450.
const FLOOR: f64 = f64::from_bits((1023 - 450) << 52);

/// A circuit in floats, whose D may be positive.
pub(super) struct Rising {
    ids: [VertexId; 5],
    circuit: pairs::Circuit,
    /// X, Y and Z.
    largest: [f64; 3],
    /// X·Y·Z; infinite where the bounds do not hold.
    product: f64,
    /// D.
    pub d: Bounded,
}

impl<'a, P: PointStore> Filter<'a, P> {
    pub(super) fn new(motion: &'a PolygonMotion<'a, P>) -> Self {
        let quantum = |degree: i32| {
            let exponent = motion.points.grid().map(|g| g.saturating_mul(degree));
            let normal = exponent.filter(|e| (-1022..=1023).contains(e));
            normal.map_or(0.0, |e| 2f64.powi(e))
        };
        Filter {
            motion,
            known: Vec::new(),
            is_complete: false,
            largest_magnitude: 0.0,
            rate_index: RATE_INDEX,
            rising_bound: f64::INFINITY,
            floor: FLOOR,
            grid: Grid {
                coefficient: quantum(3),
                numerator: quantum(5),
                denominator: quantum(6),
            },
        }
    }

    /// Position and rate of a vertex.
    #[inline(always)]
    pub(super) fn vertex(&mut self, v: VertexId) -> Moving {
        let place = self.place(v);
        self.known[place]
    }

    /// Its number, once it is known.
    #[inline]
    fn place(&mut self, v: VertexId) -> usize {
        let number = self.motion.number(v);
        if !self.known.get(number).is_some_and(Moving::is_known) {
            self.know(v, number);
        }
        number
    }

    /// Those of five.
    #[inline(always)]
    fn places(&mut self, ids: [VertexId; 5]) -> [usize; 5] {
        if self.is_complete {
            let [v, x, y, z, w] = ids;
            return [v.index(), x.index(), y.index(), z.index(), w.index()];
        }
        self.places_by_number(ids)
    }

    #[inline(never)]
    fn places_by_number(&mut self, ids: [VertexId; 5]) -> [usize; 5] {
        if self.motion.is_of_few() {
            self.known.reserve_exact(self.motion.points.len());
            for v in (0..self.motion.points.len()).map(VertexId::new) {
                self.place(v);
            }
            self.is_complete = true;
        }
        ids.map(|v| self.place(v))
    }

    #[cold]
    #[inline(never)]
    fn know(&mut self, v: VertexId, number: usize) {
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
            if [x, y, z].iter().any(|x| x.abs() > 2f64.powi(149)) {
                self.floor = f64::INFINITY;
            }
            let r = 2.0 * self.largest_magnitude;
            let holds = of_doubles && r <= 2f64.powi(450);
            self.rising_bound = if holds {
                RISING_BOUND * r
            } else {
                f64::INFINITY
            };
        }
        self.known[number] = Moving([x, y, z, rate.value()]);
    }

    /// Lets the processor fetch a vertex, where that takes no look elsewhere.
    #[inline(always)]
    pub(super) fn prefetch(&self, v: VertexId) {
        if self.motion.is_of_few() {
            prefetch(&self.known, v.index());
        }
    }

    /// D of a circuit, of either sign.
    #[inline(always)]
    pub(super) fn evaluate(&mut self, ids: [VertexId; 5]) -> Rising {
        let [v, x, y, z, w] = self.places(ids);
        let at = |place: usize| &self.known[place].0;
        let circuit = pairs::Circuit::new([at(v), at(x), at(y), at(z), at(w)]);
        let largest = circuit.largest_differences();
        let [x, y, z] = largest;
        Rising {
            ids,
            d: Bounded {
                value: circuit.below(),
                error: self.rising_bound * (x * y * z) + self.floor,
            },
            circuit,
            largest,
            product: x * y * z,
        }
    }

    /// Whether D is positive, as far as that is certain.
    #[inline(always)]
    pub(super) fn may_rise(&self, rising: &mut Rising) -> bool {
        // The sign itself is as good as random: nothing branches here.
        let d = rising.d;
        if d.value.abs() > d.error {
            return d.value > 0.0;
        }
        if d.value.is_nan() {
            rising.product = f64::INFINITY;
        }
        match self.small_rising(rising.ids, d) {
            Some(d) => {
                rising.d = d;
                true
            }
            None => false,
        }
    }

    /// D of a circuit; `None` if certainly D ≤ 0.
    #[inline(always)]
    pub(super) fn rising(&mut self, ids: [VertexId; 5]) -> Option<Rising> {
        let mut rising = self.evaluate(ids);
        self.may_rise(&mut rising).then_some(rising)
    }

    /// D again, where it is near zero.
    #[cold]
    #[inline(never)]
    fn small_rising(&self, ids: [VertexId; 5], mut d: Bounded) -> Option<Bounded> {
        let quantum = self.grid.denominator;
        let mut sign = d.sign_on_grid(quantum);
        if sign.is_none() {
            d = self.in_approx(ids).rising();
            sign = d.sign_on_grid(quantum);
        }
        (!matches!(sign, Some(Sign::Negative | Sign::Zero))).then_some(d)
    }

    /// N.
    #[inline(always)]
    pub(super) fn resting(&self, rising: &Rising) -> Bounded {
        let [x, y, z] = rising.largest;
        let bound = RESTING_BOUND * rising.product * (x * x + y * y + z * z);
        Bounded {
            value: rising.circuit.insphere(),
            error: bound + self.floor,
        }
    }

    /// What −N/D is like, as far as the size of a circuit and the largest rate tell.
    #[inline]
    pub(super) fn typical_time(&self, rising: &Rising) -> f64 {
        let [x, y, z] = rising.largest;
        (x * x + y * y + z * z) / (2.0 * self.largest_magnitude)
    }

    /// N and D and all five coefficients of a circuit in quanta, if all are certain.
    #[inline(always)]
    pub(super) fn integers(&self, rising: &Rising, n: &Bounded) -> Option<([i64; 2], [i64; 5])> {
        if !n.is_small(self.grid.numerator) || !rising.d.is_small(self.grid.denominator) {
            return None;
        }
        let coefficients = self.plain_coefficients(rising);
        self.small_integers(rising.ids, [*n, rising.d], coefficients)
    }

    /// The same, where N and D are so small that they may be integers.
    #[inline(never)]
    fn small_integers(
        &self,
        ids: [VertexId; 5],
        quotient: [Bounded; 2],
        coefficients: [Bounded; 5],
    ) -> Option<([i64; 2], [i64; 5])> {
        let grid = self.grid;
        let quotient_in_quanta = |[n, d]: [Bounded; 2]| {
            Some([n.in_quanta(grid.numerator)?, d.in_quanta(grid.denominator)?])
        };
        let in_quanta = |[v, x, y, z, w]: [Bounded; 5]| {
            Some([
                v.in_quanta(grid.coefficient)?,
                x.in_quanta(grid.coefficient)?,
                y.in_quanta(grid.coefficient)?,
                z.in_quanta(grid.coefficient)?,
                w.in_quanta(grid.coefficient)?,
            ])
        };
        let quotient = quotient_in_quanta(quotient).or_else(|| {
            let approx = self.in_approx(ids);
            quotient_in_quanta([approx.resting(), approx.rising()])
        })?;
        let coefficients = in_quanta(coefficients)
            .or_else(|| in_quanta(self.in_approx(ids).coefficients.map(Bounded::from)))?;
        Some((quotient, coefficients))
    }

    /// The signs of c_x, c_y, c_z, where they are certain.
    #[inline(always)]
    pub(super) fn signs(&self, rising: &Rising) -> Signs {
        let bound = COEFFICIENT_BOUND * rising.product + self.floor;
        let [negative, positive] = rising.circuit.signs(bound);
        let signs = Signs {
            negative,
            positive,
            zero: 0,
        };
        if negative | positive == 0b111 {
            return signs;
        }
        self.small_signs(rising.ids, self.plain_coefficients(rising), signs)
    }

    /// The same, where some are near zero.
    #[inline(never)]
    fn small_signs(&self, ids: [VertexId; 5], plain: [Bounded; 5], mut signs: Signs) -> Signs {
        let quantum = self.grid.coefficient;
        for i in 0..3 {
            if signs.known() >> i & 1 == 1 {
                continue;
            }
            let sign = plain[i + 1]
                .sign_on_grid(quantum)
                .or_else(|| self.in_approx(ids).coefficients[i + 1].sign_on_grid(quantum));
            if let Some(sign) = sign {
                signs.set(i, sign);
            }
        }
        signs
    }

    /// c_v, c_x, c_y, c_z, c_w.
    #[inline(always)]
    fn plain_coefficients(&self, rising: &Rising) -> [Bounded; 5] {
        let [v, x, y, z] = rising.circuit.coefficients();
        let bounded = |value: f64, bound: f64| Bounded {
            value,
            error: bound * rising.product + self.floor,
        };
        [
            bounded(v, COEFFICIENT_BOUND),
            bounded(x, COEFFICIENT_BOUND),
            bounded(y, COEFFICIENT_BOUND),
            bounded(z, COEFFICIENT_BOUND),
            bounded(-(v + x + y + z), ORIGIN_BOUND),
        ]
    }

    /// The same evaluations with running error bounds.
    #[cold]
    #[inline(never)]
    fn in_approx(&self, ids: [VertexId; 5]) -> InApprox {
        let known = |v: VertexId| self.known[self.motion.number(v)];
        let position = |v: VertexId| {
            let Moving([x, y, z, _]) = known(v);
            Vec3::<Approx>::from_f64([x, y, z])
        };
        let rate = |v: VertexId| {
            Approx::with_bound(known(v).0[3], self.largest_magnitude, self.rate_index)
        };
        let [v, x, y, z, w] = ids;
        let (coefficients, relative) = formula::circuit(ids.map(position).each_ref());
        InApprox {
            coefficients,
            relative,
            rates: [v, x, y, z].map(|v| rate(v) - &rate(w)),
        }
    }
}

/// The same evaluations with running error bounds.
struct InApprox {
    coefficients: [Approx; 5],
    /// The places of v, x, y, z relative to w.
    relative: [Vec3<Approx>; 4],
    /// Their rates relative to that of w.
    rates: [Approx; 4],
}

impl InApprox {
    fn rising(&self) -> Bounded {
        formula::orient4d(&self.coefficients, self.rates.each_ref()).into()
    }

    fn resting(&self) -> Bounded {
        let squares = self.relative.each_ref().map(|p| p.dot(p));
        formula::orient4d(&self.coefficients, squares.each_ref()).into()
    }
}
