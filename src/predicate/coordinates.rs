//! Exact signs of points given by their coordinates: of input before it is a [`PointStore`](super::PointStore), and of
//! projections along a coordinate axis, in which doubles stay doubles.
//!
//! Each is evaluated in doubles first. For two products of two differences each, l = (p−a)(q−b) and r likewise, with
//! relative errors below 3·2⁻⁵³ + 3·2⁻¹⁰⁶, the sum or difference errs by less than (2⁻⁵³ + 3·2⁻⁵³ + …)(|l| + |r|),
//! where |l| and |r| are the computed ones, but for underflow, which loses at most 2⁻¹⁰⁷⁴ (Shewchuk 1997, §4.3, has 3
//! in place of 4, with a longer argument). If anything overflows, the bound is infinite or not a number, and no
//! comparison with it is true.
//!
//! Then come integers of fixed size, as long as the coordinates' bits allow ([`super::integers`]), and dyadic numbers.

use super::formula;
use super::integers::{self, grid_and_bits, most_bits};
use super::stages::{on_grid, orient3d_of_doubles};
use crate::number::{Approx, Dyadic, Exact, Number, Sign, Vec3};

/// 4·2⁻⁵³, rounded up.
const BOUND: f64 = 2.1 * f64::EPSILON;
/// Far more than underflow may cost.
const TINY: f64 = 1e-300;

/// The sign of l + r, where l and r are products of two differences of doubles as computed.
#[inline(always)]
fn sign_of_sum(l: f64, r: f64) -> Option<Sign> {
    let (sum, bound) = (l + r, BOUND * (l.abs() + r.abs()) + TINY);
    if sum > bound {
        Some(Sign::Positive)
    } else if sum < -bound {
        Some(Sign::Negative)
    } else {
        None
    }
}

/// The sign of det[b−a, c−a]: positive iff abc turns counterclockwise.
#[inline]
pub(crate) fn orient2d([a, b, c]: [[f64; 2]; 3]) -> Sign {
    let (l, r) = ((b[0] - a[0]) * (c[1] - a[1]), (b[1] - a[1]) * (c[0] - a[0]));
    match sign_of_sum(l, -r) {
        Some(sign) => sign,
        None => orient2d_exact([a, b, c]),
    }
}

#[cold]
fn orient2d_exact([a, b, c]: [[f64; 2]; 3]) -> Sign {
    if a == b || b == c || c == a {
        return Sign::Zero;
    }
    // Points on a line across a coordinate axis are common in planes across one, and need no arithmetic.
    if (0..2).any(|k| a[k] == b[k] && b[k] == c[k]) {
        return Sign::Zero;
    }
    let [p, q, s] = [a, b, c].map(|[x, y]| [x, y, 0.0]);
    let (grid, bits) = grid_and_bits(&[p, q, s]);
    if bits <= most_bits(1) {
        let on = |p| on_grid(p, grid);
        integers::orient2d::<1, 2>([on(p), on(q), on(s)])
    } else if bits <= most_bits(2) {
        let on = |p| on_grid(p, grid);
        integers::orient2d::<2, 4>([on(p), on(q), on(s)])
    } else {
        formula::orient2d([a, b, c].map(|p| p.map(Dyadic::from_f64)).each_ref()).exact_sign()
    }
}

/// Whether three points of space are on one line.
pub(crate) fn collinear([a, b, c]: [[f64; 3]; 3]) -> bool {
    [(1, 2), (2, 0), (0, 1)].iter().all(|&(i, j)| {
        let on_plane = |p: [f64; 3]| [p[i], p[j]];
        orient2d([on_plane(a), on_plane(b), on_plane(c)]).is_zero()
    })
}

/// The sign of (b−a)·(c−a).
#[inline]
pub(crate) fn dot2d([a, b, c]: [[f64; 2]; 3]) -> Sign {
    let (l, r) = ((b[0] - a[0]) * (c[0] - a[0]), (b[1] - a[1]) * (c[1] - a[1]));
    sign_of_sum(l, r).unwrap_or_else(|| {
        formula::dot2d([a, b, c].map(|p| p.map(Dyadic::from_f64)).each_ref()).exact_sign()
    })
}

/// The sign of det[b−a, c−a, d−a].
pub(crate) fn orient3d(points: [[f64; 3]; 4]) -> Sign {
    let [a, b, c, d] = points;
    // The commonest coplanar points, without arithmetic: all in one plane across a coordinate axis.
    if (0..3).any(|k| a[k] == b[k] && b[k] == c[k] && c[k] == d[k]) {
        return Sign::Zero;
    }
    let [pa, pb, pc, pd]: [Vec3<Approx>; 4] = [
        Vec3::from_f64(a),
        Vec3::from_f64(b),
        Vec3::from_f64(c),
        Vec3::from_f64(d),
    ];
    if let Some(sign) = formula::orient3d([&pa, &pb, &pc, &pd]).sign() {
        return sign;
    }
    orient3d_of_doubles(points)
}

/// The coordinate in which the normal (b−a) × (c−a) is largest, the first of several, and its sign there; `None` if the
/// points are on one line.
pub(crate) fn normal_axis([a, b, c]: [[f64; 3]; 3]) -> Option<(usize, Sign)> {
    let (u, v): ([f64; 3], [f64; 3]) = (
        std::array::from_fn(|k| b[k] - a[k]),
        std::array::from_fn(|k| c[k] - a[k]),
    );
    // Component k, and a bound of its error.
    let component = |k: usize| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        let (l, r) = (u[i] * v[j], u[j] * v[i]);
        (l - r, BOUND * (l.abs() + r.abs()) + TINY)
    };
    let normal = [component(0), component(1), component(2)];
    let size = |k: usize| normal[k].0.abs();
    let mut axis = 0;
    for k in [1, 2] {
        if size(k) > size(axis) {
            axis = k;
        }
    }
    let (value, error) = normal[axis];
    // The errors' sum is rounded, and so is the difference that it is compared with.
    let is_larger = |k: usize| size(axis) - size(k) > 1.01 * (error + normal[k].1);
    if value.abs() > error && (0..3).all(|k| k == axis || is_larger(k)) {
        return Some((axis, Sign::of_f64(value)?));
    }
    normal_axis_exact([a, b, c])
}

#[cold]
fn normal_axis_exact(triangle: [[f64; 3]; 3]) -> Option<(usize, Sign)> {
    let [a, b, c] = triangle.map(Vec3::<Dyadic>::from_f64);
    let axis = largest(&b.sub(&a).cross(&c.sub(&a)));
    (!axis.1.is_zero()).then_some(axis)
}

/// The coordinate in which a vector is largest, the first of several, and its sign there.
pub(crate) fn largest(Vec3(vector): &Vec3<Dyadic>) -> (usize, Sign) {
    let size = |k: usize| match vector[k].exact_sign() {
        Sign::Negative => vector[k].clone().negated(),
        _ => vector[k].clone(),
    };
    let mut axis = 0;
    for k in [1, 2] {
        if (size(k) - &size(axis)).exact_sign().is_positive() {
            axis = k;
        }
    }
    (axis, vector[axis].exact_sign())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Coordinates from families that defeat floats.
    fn coordinate() -> impl Strategy<Value = f64> {
        prop_oneof![
            (-3i32..4).prop_map(f64::from),
            ((-3i32..4), (-3i32..4))
                .prop_map(|(x, k)| f64::from(x) * (1.0 + f64::from(k) * f64::EPSILON)),
            (-2i32..3, -300i32..300).prop_map(|(x, e)| f64::from(x) * 10f64.powi(e)),
            (-3i32..4).prop_map(|x| f64::from(x) * 5e-324),
            (-3i32..4).prop_map(|x| f64::from(x) * 1e-160),
            (-2i32..3).prop_map(|x| f64::from(x) * 8.9e307),
        ]
    }

    fn point() -> impl Strategy<Value = [f64; 3]> {
        let lattice = [-3i32..4, -3i32..4, -3i32..4].prop_map(|p| p.map(|x| f64::from(x) * 0.1));
        prop_oneof![[coordinate(), coordinate(), coordinate()], lattice]
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4000))]

        #[test]
        fn signs_agree_with_dyadics(p in [point(), point(), point(), point()]) {
            let [a, b, c, d] = p.map(Vec3::<Dyadic>::from_f64);
            let space = formula::orient3d([&a, &b, &c, &d]).exact_sign();
            prop_assert_eq!(orient3d(p), space);
            let normal = b.sub(&a).cross(&c.sub(&a));
            let plane = [0, 1, 2].map(|i| [p[i][1], p[i][2]]);
            prop_assert_eq!(orient2d(plane), normal.0[0].exact_sign());
            prop_assert_eq!(orient2d_exact(plane), normal.0[0].exact_sign());
            let flat = |v: &Vec3<Dyadic>| Vec3([v.0[0].clone(), v.0[1].clone(), Dyadic::ZERO]);
            let (u, v) = (flat(&b.sub(&a)), flat(&c.sub(&a)));
            let plane = [0, 1, 2].map(|i| [p[i][0], p[i][1]]);
            prop_assert_eq!(dot2d(plane), u.dot(&v).exact_sign());
            let [a, b, c, _] = p;
            prop_assert_eq!(collinear([p[0], p[1], p[2]]), largest(&normal).1.is_zero());
            let expected = largest(&normal);
            prop_assert_eq!(normal_axis([a, b, c]), (!expected.1.is_zero()).then_some(expected));
        }
    }
}
