//! The later stages of the predicates of [`DoublePoints`], for the few signs that the first one leaves open:
//!
//! 1. the same value as in stage 0 with the largest differences X, Y, Z of these points and L = 3·max(X,Y,Z)², where
//!    all are in [2^−150, 2^150]. And where this bound of m is below 2^53·2^(g·degree), all coordinates being multiples
//!    of 2^g, then all intermediate results are integer multiples of powers of 2^g that fit 53 bits: the value is
//!    exact, zero or not. (If X, Y or Z is zero then so is the value, unless another difference is so large that it is
//!    NaN.)
//! 2. integers of fixed size ([`super::integers`]), as long as the coordinates' bits allow;
//! 3. the formula over [`Dyadic`](crate::number::Dyadic), for every finite double.

use super::integers::{self, grid_and_bits, most_bits};
use super::range::ORIENT3D_BOUND;
use super::{DoublePoints, PointStore, formula, perturbed_sign};
use crate::mesh::VertexId;
use crate::number::{Dyadic, Exact, Integer, Sign, Vec3};

/// 18·24·3·2⁻⁵², rounded up.
const INSPHERE_BOUND: f64 = 1310.0 * f64::EPSILON;
/// 2^53.
const EXACT: f64 = (1u64 << 53) as f64;

impl DoublePoints {
    /// Stages 1 to 3, for points that are doubles.
    #[cold]
    pub(super) fn orient3d_slow(&self, v: [VertexId; 4]) -> Sign {
        if self.any_segment_point(&v) {
            return self.orient3d_of_any(v);
        }
        let [a, b, c, d] = v;
        let [a, b, c, d]: [Vec3<f64>; 4] = [self.at(a), self.at(b), self.at(c), self.at(d)];
        let det = formula::orient3d([&a, &b, &c, &d]);
        let [x, y, z] = largest_differences(&a, [&b, &c, &d]);
        let size = x * y * z;
        let sure = det.abs() > ORIENT3D_BOUND * size && in_static_range([x, y, z]);
        if sure || (6.1 * size < EXACT * self.range.quantum3 && det.is_finite()) {
            return Sign::of_f64(det).expect("the value is finite");
        }
        self.orient3d_exact(v)
    }

    /// Stages 2 and 3.
    pub(super) fn orient3d_exact(&self, v: [VertexId; 4]) -> Sign {
        // Written out here and below, because array::map is not inlined.
        let at = |i: usize| self.points[v[i].index()];
        let [a, b, c, d] = [at(0), at(1), at(2), at(3)];
        if self.range.unit != 0.0 {
            let word = |p| self.in_words(p);
            return integers::orient3d::<1, 2, 3>([word(a), word(b), word(c), word(d)]);
        }
        orient3d_of_doubles([a, b, c, d])
    }

    /// Stages 1 to 3, and the perturbation if `PERTURBED`.
    #[cold]
    pub(super) fn insphere_slow<const PERTURBED: bool>(&self, v: [VertexId; 5]) -> Sign {
        if self.any_segment_point(&v) {
            let sign = self.insphere_of_any(v);
            return match sign.is_zero() && PERTURBED {
                true => perturbed_sign(self, v),
                false => sign,
            };
        }
        let [a, b, c, d, e] = v;
        let [a, b, c, d, e]: [Vec3<f64>; 5] =
            [self.at(a), self.at(b), self.at(c), self.at(d), self.at(e)];
        let [x, y, z] = largest_differences(&e, [&a, &b, &c, &d]);
        let side = larger(x, larger(y, z));
        let size = (x * y * z) * (side * side);
        let (circuit, q) = formula::circuit([&a, &b, &c, &d, &e]);
        let [a, b, c, d] = &q;
        let det = formula::orient4d(&circuit, [&a.dot(a), &b.dot(b), &c.dot(c), &d.dot(d)]);
        if det.abs() > INSPHERE_BOUND * size && in_static_range([x, y, z]) {
            return Sign::of_f64(det).expect("the value is finite");
        }
        if 72.1 * size < EXACT * self.range.quantum5 && det.is_finite() {
            return match Sign::of_f64(det).expect("the value is finite") {
                Sign::Zero if PERTURBED => self.decisive(v, |i| {
                    Sign::of_f64(circuit[i]).expect("the value is finite")
                }),
                sign => sign,
            };
        }
        self.insphere_exact::<PERTURBED>(v)
    }

    /// Stages 2 and 3.
    pub(super) fn insphere_exact<const PERTURBED: bool>(&self, v: [VertexId; 5]) -> Sign {
        let at = |i: usize| self.points[v[i].index()];
        let [a, b, c, d, e] = [at(0), at(1), at(2), at(3), at(4)];
        if self.range.unit != 0.0 {
            let word = |p| self.in_words(p);
            let p = [word(a), word(b), word(c), word(d), word(e)];
            return self.of_integers::<PERTURBED, 1, 2, 3, 5>(v, p);
        }
        let (grid, bits) = grid_and_bits(&[a, b, c, d, e]);
        if bits <= most_bits(1) {
            let on = |p| on_grid(p, grid);
            let p = [on(a), on(b), on(c), on(d), on(e)];
            self.of_integers::<PERTURBED, 1, 2, 3, 5>(v, p)
        } else if bits <= most_bits(2) {
            let on = |p| on_grid(p, grid);
            let p = [on(a), on(b), on(c), on(d), on(e)];
            self.of_integers::<PERTURBED, 2, 4, 6, 10>(v, p)
        } else {
            let p = [a, b, c, d, e].map(Vec3::<Dyadic>::from_f64);
            let sign = formula::insphere(p.each_ref()).exact_sign();
            match sign.is_zero() && PERTURBED {
                true => perturbed_sign(self, v),
                false => sign,
            }
        }
    }

    fn of_integers<
        const PERTURBED: bool,
        const D: usize,
        const D2: usize,
        const D3: usize,
        const D5: usize,
    >(
        &self,
        v: [VertexId; 5],
        p: [[Integer<D>; 3]; 5],
    ) -> Sign {
        let (sign, circuit) = integers::insphere::<D, D2, D3, D5>(p);
        match sign.is_zero() && PERTURBED {
            true => self.decisive(v, |i| circuit[i].sign()),
            false => sign,
        }
    }

    /// The sign of the first coefficient that is not zero, in the order of the vertices' identities.
    fn decisive(&self, v: [VertexId; 5], coefficient: impl Fn(usize) -> Sign) -> Sign {
        let mut first = (u32::MAX, Sign::Zero);
        for (i, &v) in v.iter().enumerate() {
            let identity = self.identity(v);
            let sign = coefficient(i);
            if !sign.is_zero() && identity <= first.0 {
                first = (identity, sign);
            }
        }
        first.1
    }

    /// A point in units of the grid of all.
    #[inline(always)]
    fn in_words(&self, [x, y, z]: [f64; 3]) -> [Integer<1>; 3] {
        let word = |x: f64| Integer::from((x * self.range.unit) as i64);
        [word(x), word(y), word(z)]
    }
}

/// The sign of det[b−a, c−a, d−a] by stages 2 and 3, of any finite doubles.
pub(super) fn orient3d_of_doubles(points: [[f64; 3]; 4]) -> Sign {
    let [a, b, c, d] = points;
    let (grid, bits) = grid_and_bits(&points);
    if bits <= most_bits(1) {
        let on = |p| on_grid(p, grid);
        integers::orient3d::<1, 2, 3>([on(a), on(b), on(c), on(d)])
    } else if bits <= most_bits(2) {
        let on = |p| on_grid(p, grid);
        integers::orient3d::<2, 4, 6>([on(a), on(b), on(c), on(d)])
    } else {
        formula::orient3d(points.map(Vec3::<Dyadic>::from_f64).each_ref()).exact_sign()
    }
}

/// A point in units of 2^grid.
#[inline(always)]
pub(super) fn on_grid<const D: usize>([x, y, z]: [f64; 3], grid: i32) -> [Integer<D>; 3] {
    [
        Integer::on_grid(x, grid),
        Integer::on_grid(y, grid),
        Integer::on_grid(z, grid),
    ]
}

/// The larger of two numbers, by one instruction: `f64::max` also looks for NaN.
#[inline(always)]
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// The largest |x|, |y|, |z| among the differences of some points to one.
#[inline]
fn largest_differences<const N: usize>(origin: &Vec3<f64>, points: [&Vec3<f64>; N]) -> [f64; 3] {
    let mut largest = [0.0f64; 3];
    for p in points {
        for (i, x) in largest.iter_mut().enumerate() {
            *x = x.max((p.0[i] - origin.0[i]).abs());
        }
    }
    largest
}

/// Whether stage 0 is proved for these differences.
#[inline]
fn in_static_range(largest: [f64; 3]) -> bool {
    const LOW: f64 = 1.0 / (1u128 << 100) as f64 / (1u64 << 50) as f64;
    const HIGH: f64 = (1u128 << 100) as f64 * (1u64 << 50) as f64;
    largest.iter().all(|&x| (LOW..=HIGH).contains(&x))
}
