//! Signs of determinants in doubles, where they are certain.
//!
//! # The bounds
//! A determinant is evaluated in doubles. With u = 2⁻⁵³, every computed sum, difference and product is the exact one
//! times (1 + δ), |δ| ≤ u (products that underflow apart). Multiplied out, the computed determinant is Σ t_i·Π(1 +
//! δ), with n factors at most in each product, where t_i are the exact terms. So its error is at most ((1+u)ⁿ −
//! 1)·Σ|t_i|. Let P be at least Σ|t_i| where computed exactly, and be computed with m roundings at most along a path,
//! m ≤ n; the computed P is at least (1−u)ⁿ·Σ|t_i|, so that the error is at most n·u·(1 + 4nu)·P for n ≤ 2²⁰, and
//! certainly below 2n·u·(computed P), whatever the rounding of that last product. The number n of factors along the
//! longest path:
//!
//! - orient2d, d1·d2 − d3·d4: 2 (two differences) + 1 (product) + 1 (sum) = 4.
//! - A sum of k determinants: k more.
//! - orient3d, expanded by rows: 3 (differences) + 1 (inner product) + 1 (its difference) + 1 (outer product) + 2
//!   (sums) = 8.
//! - insphere, Σ lift_i·det3_i: lift 2 + 1 + 2 = 5, det3 8, their product 1, sums 3: 17.
//!
//! P is either the sum of the absolute values of the terms ([`Permanent`]), or, quicker and mostly enough, an upper
//! bound of it: with X, Y, Z the largest absolute values of the differences along the axes, 6·XYZ for orient3d and
//! 24·XYZ·(X² + Y² + Z²) for insphere.
//!
//! A product that underflows errs by at most 2⁻¹⁰⁷⁵ more. If every coordinate is below 2¹⁰⁰, differences are below
//! 2¹⁰¹, the factors that multiply such an error are below 2³¹⁰ and there are fewer than 2⁶ of them, so that the total
//! is below 2⁻⁵⁰⁰. Coordinates beyond 2¹⁰⁰ use no shortcut (which excludes overflow, too: insphere has degree 5).
//! So |determinant| > 2n·u·P + 2⁻⁵⁰⁰ proves the sign.
//!
//! # Where doubles are exact
//! Let all coordinates be multiples of g = 2^k. If every difference is below 2⁵³g it is exact, and so are all minors
//! and sums on the way to a determinant of degree n whose bound P above is below 2⁵³gⁿ: they are multiples of a power
//! of g that P bounds, since X, Y and Z are at least g (or one of them is zero, and then the determinant is, too).
//! Such a value has the right sign, zero included ([`Exactness`]). k ≥ −200 keeps underflow away.
//!
//! # Points that are not quite there
//! Where the differences are only known up to ω each (of rounded coordinates, or to a rounded centroid), let X′ = X + ω
//! and so on. A product of three of them changes by at most (X+ω)(Y+ω)(Z+ω) − XYZ ≤ ω·(X′Y′ + Y′Z′ + Z′X′), and
//! X² + Y² + Z² by at most 2ω(X′ + Y′ + Z′). This times the number of terms, and X′, Y′, Z′ in place of X, Y, Z in P,
//! is all that has to be added. (The doubled P pays for the rounding of what is added as well: it is rounded relatively
//! by less than 16u, and we add 1/16 of it.)

use crate::number::Sign;
use crate::number::vector::{dot, minus};

/// u = 2⁻⁵³.
const HALF_ULP: f64 = f64::EPSILON / 2.0;
/// What underflows, at most.
const UNDERFLOW: f64 = f64::from_bits((1023 - 500) << 52);
/// Coordinates for which the bounds hold.
pub(crate) const LARGEST: f64 = f64::from_bits((1023 + 100) << 52);

/// The sign of a value that errs by `bound` at most.
#[inline(always)]
fn beyond(value: f64, bound: f64) -> Option<Sign> {
    if value > bound {
        Some(Sign::Positive)
    } else if value < -bound {
        Some(Sign::Negative)
    } else {
        None
    }
}

/// A determinant, or a sum of them, with the sum of the absolute values of its terms.
#[derive(Clone, Copy, Default)]
pub(crate) struct Permanent {
    pub(crate) value: f64,
    pub(crate) terms: f64,
}

impl Permanent {
    /// The sign, if certain, where products have n factors. `n` is small.
    #[inline(always)]
    pub(crate) fn sign(self, n: usize) -> Option<Sign> {
        beyond(
            self.value,
            2.0 * n as f64 * HALF_ULP * self.terms + UNDERFLOW,
        )
    }

    /// The sum of two.
    #[inline(always)]
    pub(crate) fn plus(self, other: Permanent) -> Permanent {
        Permanent {
            value: self.value + other.value,
            terms: self.terms + other.terms,
        }
    }
}

/// Up to which bounds of their terms determinants are computed exactly.
#[derive(Clone, Copy, Default)]
pub(crate) struct Exactness {
    /// For degree 3.
    pub(crate) orient: f64,
    /// For degree 5.
    pub(crate) insphere: f64,
}

impl Exactness {
    /// Where coordinates are multiples of 2^k. Half of 2⁵³gⁿ, as the bounds are rounded.
    pub(crate) fn new(k: i16) -> Exactness {
        if !(-200..=100).contains(&k) {
            return Exactness::default();
        }
        let limit = |degree: i32| 2f64.powi(52 + degree * i32::from(k));
        Exactness {
            orient: limit(3),
            insphere: limit(5),
        }
    }
}

impl Permanent {
    /// The sign, if the value is exact.
    #[inline(always)]
    pub(crate) fn sign_below(self, limit: f64) -> Option<Sign> {
        if self.terms >= limit {
            return None;
        }
        Some(beyond(self.value, 0.0).unwrap_or(Sign::Zero))
    }
}

/// The determinant of three rows.
#[inline(always)]
pub(crate) fn det3([a, b, c]: [[f64; 3]; 3]) -> f64 {
    a[0] * (b[1] * c[2] - b[2] * c[1])
        + a[1] * (b[2] * c[0] - b[0] * c[2])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
}

/// The determinant of three rows and its terms.
#[inline(always)]
pub(crate) fn det3_and_terms([a, b, c]: [[f64; 3]; 3]) -> Permanent {
    let mut terms = 0.0;
    for (i, j, k) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
        terms += a[i].abs() * ((b[j] * c[k]).abs() + (b[k] * c[j]).abs());
    }
    Permanent {
        value: det3([a, b, c]),
        terms,
    }
}

/// The larger one; neither is NaN, about which [`f64::max`] would care.
#[inline(always)]
fn larger(x: f64, y: f64) -> f64 {
    if x > y { x } else { y }
}

/// The largest absolute value along each axis.
#[inline(always)]
fn extent<const N: usize>(rows: &[[f64; 3]; N]) -> [f64; 3] {
    let mut extent = [0.0f64; 3];
    for row in rows {
        for (e, x) in extent.iter_mut().zip(row) {
            *e = larger(*e, x.abs());
        }
    }
    extent
}

/// The error of a determinant of three differences, up to `wobble` each, whose extent this is.
#[inline(always)]
fn orient_bound([x, y, z]: [f64; 3], wobble: f64) -> f64 {
    let bound = 96.0 * HALF_ULP * (x * y * z) + UNDERFLOW;
    if wobble == 0.0 {
        return bound;
    }
    let [x, y, z] = [x + wobble, y + wobble, z + wobble];
    96.0 * HALF_ULP * (x * y * z) + 6.375 * wobble * (x * y + y * z + z * x) + UNDERFLOW
}

/// det[b−a, c−a, d−a] of points that are doubles, with an upper bound of its terms; [`Permanent::sign`] with n = 8.
#[inline(always)]
pub(crate) fn orient_of_doubles([a, b, c, d]: [[f64; 3]; 4]) -> Permanent {
    let rows = [minus(b, a), minus(c, a), minus(d, a)];
    let [x, y, z] = extent(&rows);
    Permanent {
        value: det3(rows),
        terms: 6.0 * (x * y * z),
    }
}

/// The sign of det[b−a, c−a, d−a], the differences being known up to `wobble`.
#[inline(always)]
pub(crate) fn orient([a, b, c, d]: [[f64; 3]; 4], wobble: f64) -> Option<Sign> {
    let rows = [minus(b, a), minus(c, a), minus(d, a)];
    beyond(det3(rows), orient_bound(extent(&rows), wobble))
}

/// The same by the terms; no wobble.
pub(crate) fn orient_by_terms([a, b, c, d]: [[f64; 3]; 4]) -> Option<Sign> {
    det3_and_terms([minus(b, a), minus(c, a), minus(d, a)]).sign(8)
}

/// Whether a closed positive tetrahedron contains a point, all differences being known up to `wobble`. `inward` are its
/// faces, by corners.
#[inline(always)]
pub(crate) fn contains(
    tet: [[f64; 3]; 4],
    inward: &[[usize; 3]; 4],
    point: [f64; 3],
    wobble: f64,
) -> Option<bool> {
    let [a, b, c, d] = tet;
    let rows = [
        minus(a, point),
        minus(b, point),
        minus(c, point),
        minus(d, point),
    ];
    let bound = orient_bound(extent(&rows), wobble);
    let mut certain = true;
    for face in inward {
        // orient(face, point), with the point as the origin.
        let [i, j, k] = *face;
        let side = -det3([rows[i], rows[j], rows[k]]);
        if side < -bound {
            return Some(false);
        }
        certain &= side > bound;
    }
    certain.then_some(true)
}

/// The minors of insphere: the determinants of three of the four rows.
const MINORS: [[usize; 3]; 4] = [[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]];

/// insphere, positive iff e is inside the circumsphere of the positive abcd, with an upper bound of its terms, and
/// the extent of the differences.
#[inline(always)]
fn insphere_and_extent([a, b, c, d, e]: [[f64; 3]; 5]) -> (Permanent, [f64; 3]) {
    let q = [minus(a, e), minus(b, e), minus(c, e), minus(d, e)];
    let lift = [
        dot(q[0], q[0]),
        dot(q[1], q[1]),
        dot(q[2], q[2]),
        dot(q[3], q[3]),
    ];
    // The six minors of two rows in x and y, and from them those of three.
    let xy = |i: usize, j: usize| q[i][0] * q[j][1] - q[j][0] * q[i][1];
    let (ab, ac, ad, bc, bd, cd) = (xy(0, 1), xy(0, 2), xy(0, 3), xy(1, 2), xy(1, 3), xy(2, 3));
    let z = |i: usize| q[i][2];
    let bcd = z(1) * cd - z(2) * bd + z(3) * bc;
    let acd = z(0) * cd - z(2) * ad + z(3) * ac;
    let abd = z(0) * bd - z(1) * ad + z(3) * ab;
    let abc = z(0) * bc - z(1) * ac + z(2) * ab;
    // As in the formula: the coefficients −O(e,b,c,d), O(e,a,c,d), −O(e,a,b,d), O(e,a,b,c), negated.
    let value = (lift[0] * bcd + lift[2] * abd) - (lift[1] * acd + lift[3] * abc);
    let [x, y, z] = extent(&q);
    let terms = 24.0 * (x * y * z) * (x * x + y * y + z * z);
    (Permanent { value, terms }, [x, y, z])
}

/// insphere of points that are doubles, with an upper bound of its terms; [`Permanent::sign`] with n = 17.
#[inline(always)]
pub(crate) fn insphere_of_doubles(p: [[f64; 3]; 5]) -> Permanent {
    insphere_and_extent(p).0
}

/// The sign of insphere, the differences being known up to `wobble`.
#[inline(always)]
pub(crate) fn insphere(p: [[f64; 3]; 5], wobble: f64) -> Option<Sign> {
    let (determinant, [x, y, z]) = insphere_and_extent(p);
    let [x, y, z] = [x + wobble, y + wobble, z + wobble];
    let squares = x * x + y * y + z * z;
    let product = x * y * z;
    let change = (x * y + y * z + z * x) * squares + 2.0 * product * (x + y + z);
    let bound = 816.0 * HALF_ULP * product * squares + 25.5 * wobble * change + UNDERFLOW;
    beyond(determinant.value, bound)
}

/// The same by the terms; no wobble.
pub(crate) fn insphere_by_terms([a, b, c, d, e]: [[f64; 3]; 5]) -> Option<Sign> {
    let q = [minus(a, e), minus(b, e), minus(c, e), minus(d, e)];
    let lift = q.map(|x| dot(x, x));
    let minors = MINORS.map(|i| det3_and_terms(i.map(|k| q[k])));
    let value = (lift[0] * minors[0].value + lift[2] * minors[2].value)
        - (lift[1] * minors[1].value + lift[3] * minors[3].value);
    let terms = (0..4).map(|i| lift[i] * minors[i].terms).sum();
    Permanent { value, terms }.sign(17)
}

/// The sign of a sum of 2×2 determinants (p−o)×(r−o) over the points r, up to `wobble` each difference.
#[inline(always)]
pub(crate) fn side2d(
    [o, p]: [[f64; 2]; 2],
    others: impl Iterator<Item = [f64; 2]>,
    wobble: f64,
) -> Option<Sign> {
    let mut sum = Permanent::default();
    let (mut n, mut change) = (4, 0.0);
    let along = [p[0] - o[0], p[1] - o[1]];
    for r in others {
        let away = [r[0] - o[0], r[1] - o[1]];
        let (left, right) = (along[0] * away[1], along[1] * away[0]);
        sum = sum.plus(Permanent {
            value: left - right,
            terms: left.abs() + right.abs(),
        });
        n += 1;
        // ω for one factor times the other one, for both factors of both products.
        let lengths = along[0].abs() + along[1].abs() + away[0].abs() + away[1].abs();
        change += lengths + 2.0 * wobble;
    }
    if wobble == 0.0 {
        return sum.sign(n);
    }
    let bound = 2.0 * n as f64 * HALF_ULP * sum.terms + 1.0625 * wobble * change + UNDERFLOW;
    beyond(sum.value, bound)
}

/// The sign of Σ (x − v) over the numbers x, each known up to `wobble` relative to v.
#[inline(always)]
pub(crate) fn compare(v: f64, others: impl Iterator<Item = f64>, wobble: f64) -> Option<Sign> {
    let mut sum = Permanent::default();
    let mut n = 1;
    for x in others {
        let value = x - v;
        sum = sum.plus(Permanent {
            value,
            terms: value.abs(),
        });
        n += 1;
    }
    if sum.terms == 0.0 && wobble == 0.0 {
        return Some(Sign::Zero);
    }
    let bound = 2.0 * n as f64 * HALF_ULP * sum.terms + 1.0625 * n as f64 * wobble;
    beyond(sum.value, bound)
}
