//! All points that a check talks about, and the exact signs of their determinants.
//!
//! # The shortcut
//! A determinant is first evaluated in doubles together with the sum P of the absolute values of its terms. With
//! u = 2⁻⁵³, every computed sum, difference and product is the exact one times (1 + δ), |δ| ≤ u (products that underflow
//! apart). Multiplied out, the computed determinant is Σ t_i·Π(1 + δ), with n factors at most in each product, where t_i
//! are the exact terms. So its error is at most ((1+u)ⁿ − 1)·Σ|t_i|, and the computed P is at least (1−u)ⁿ·Σ|t_i|; the
//! error is at most n·u·(1 + 4nu)·P for n ≤ 2²⁰, and certainly below 2n·u·(computed P), whatever the rounding of that
//! last product. The number n of factors along the longest path:
//!
//! - orient2d, d1·d2 − d3·d4: 2 (two differences) + 1 (product) + 1 (sum) = 4.
//! - A sum of k determinants: k more.
//! - orient3d, expanded by rows: 3 (differences) + 1 (inner product) + 1 (its difference) + 1 (outer product) + 2 (sums) = 8.
//! - insphere, Σ lift_i·det3_i: lift 2 + 1 + 2 = 5, det3 8, their product 1, sums 3: 17.
//!
//! A product that underflows errs by at most 2⁻¹⁰⁷⁵ more. If every coordinate is below 2¹⁰⁰, differences are below
//! 2¹⁰¹, the factors that multiply such an error are below 2³¹⁰ and there are fewer than 2⁶ of them, so that the total
//! is below 2⁻⁵⁰⁰. Coordinates beyond 2¹⁰⁰ use no shortcut (which excludes overflow, too: insphere has degree 5).
//! So |determinant| > 2n·u·P + 2⁻⁵⁰⁰ proves the sign. Everything else, zero in particular, is decided in [`Dyadic`]s.

use crate::mesh::VertexId;
use crate::number::{Approx, Dyadic, Exact, Number, Sign, Vec3};
use crate::predicate::formula;
use rustc_hash::FxHashMap;
use std::cmp::Ordering;

/// u = 2⁻⁵³.
const HALF_ULP: f64 = f64::EPSILON / 2.0;

/// Squares of lengths for which the distances below neither overflow nor lose anything that counts to underflow.
const SQUARES: std::ops::Range<f64> = 1e-90..1e90;

/// The points: first the vertices of the mesh, then those points of the input (vertices, hole and region points) that
/// are no mesh vertices. A [`VertexId`] in this module names any of them.
pub(super) struct Points {
    coordinates: Vec<[f64; 3]>,
    /// The points whose coordinates are no doubles; `coordinates` has them rounded.
    exact: FxHashMap<VertexId, Vec3<Dyadic>>,
    shortcut: bool,
    underflow: f64,
    largest: f64,
}

/// The difference of two points, in doubles.
pub(super) fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// The cross product, in doubles.
pub(super) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// The scalar product, in doubles.
pub(super) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

impl Points {
    /// Finite coordinates.
    pub(super) fn new(coordinates: Vec<[f64; 3]>) -> Points {
        let largest = coordinates
            .iter()
            .flatten()
            .fold(0.0f64, |m, x| m.max(x.abs()));
        Points {
            coordinates,
            exact: FxHashMap::default(),
            shortcut: largest <= 2f64.powi(100),
            underflow: 2f64.powi(-500),
            largest,
        }
    }

    /// The same points, some of which are exactly elsewhere.
    pub(super) fn with_exact(self, exact: FxHashMap<VertexId, Vec3<Dyadic>>) -> Points {
        Points { exact, ..self }
    }

    /// The largest absolute value of a coordinate.
    pub(super) fn largest(&self) -> f64 {
        self.largest
    }

    /// The coordinates, rounded if they are no doubles.
    pub(super) fn at(&self, v: VertexId) -> [f64; 3] {
        self.coordinates[v.index()]
    }

    /// The coordinates; NaN if they are no doubles, so that no shortcut is certain of anything.
    fn double(&self, v: VertexId) -> [f64; 3] {
        if !self.exact.is_empty() && self.exact.contains_key(&v) {
            return [f64::NAN; 3];
        }
        self.at(v)
    }

    /// The points, if one of them is exactly elsewhere.
    fn any_exact<const N: usize>(&self, v: &[VertexId; N]) -> Option<[VertexId; N]> {
        let any = !self.exact.is_empty() && v.iter().any(|v| self.exact.contains_key(v));
        any.then_some(*v)
    }

    pub(super) fn exact(&self, v: VertexId) -> Vec3<Dyadic> {
        let exact = self.exact.get(&v).cloned();
        exact.unwrap_or_else(|| Vec3::from_f64(self.at(v)))
    }

    /// Whether two points are exactly at the same place.
    pub(super) fn coincide(&self, v: VertexId, w: VertexId) -> bool {
        self.exact(v) == self.exact(w)
    }

    fn certain(&self, value: f64, permanent: f64, factors: u32) -> Option<Sign> {
        let bound = 2.0 * f64::from(factors) * HALF_ULP * permanent + self.underflow;
        if !self.shortcut {
            None
        } else if value > bound {
            Some(Sign::Positive)
        } else if value < -bound {
            Some(Sign::Negative)
        } else {
            None
        }
    }

    /// det[b−a, c−a, d−a], exactly.
    pub(super) fn volume(&self, t: [VertexId; 4]) -> Dyadic {
        let p = t.map(|v| self.exact(v));
        formula::orient3d(p.each_ref())
    }

    /// The sign of det[b−a, c−a, d−a].
    pub(super) fn orient(&self, [a, b, c, d]: [VertexId; 4]) -> Sign {
        let o = self.double(a);
        let (value, permanent) = det3([b, c, d].map(|v| minus(self.double(v), o)));
        self.certain(value, permanent, 8)
            .or_else(|| {
                let p = self
                    .any_exact(&[a, b, c, d])?
                    .map(|v| self.near(v, self.at(a)));
                formula::orient3d(p.each_ref()).sign()
            })
            .unwrap_or_else(|| self.volume([a, b, c, d]).exact_sign())
    }

    /// The coordinates relative to a double point, with a bound of their rounding ([`Approx`]): those of a point that is exactly
    /// elsewhere are (x − o) + (p − x), where x is p rounded.
    fn near(&self, v: VertexId, origin: [f64; 3]) -> Vec3<Approx> {
        let from_origin = Vec3::<Approx>::from_f64(self.at(v)).sub(&Vec3::from_f64(origin));
        match self.exact.get(&v) {
            None => from_origin,
            Some(p) => {
                let rest = p.sub(&Vec3::from_f64(self.at(v))).0;
                let [x, y, z] = from_origin.0;
                let [rx, ry, rz] = rest.map(|r| Approx::rounded(&r));
                Vec3([x + &rx, y + &ry, z + &rz])
            }
        }
    }

    /// The same with the rounded coordinates, if any of the points has others.
    pub(super) fn orient_rounded(&self, t: [VertexId; 4]) -> Option<Sign> {
        if self.exact.is_empty() || !t.iter().any(|v| self.exact.contains_key(v)) {
            return None;
        }
        let p = t.map(|v| Vec3::from_f64(self.at(v)));
        Some(formula::orient3d::<Dyadic>(p.each_ref()).exact_sign())
    }

    /// Positive iff e is inside the circumsphere of the positive abcd.
    pub(super) fn insphere(&self, five: [VertexId; 5]) -> Sign {
        let [a, b, c, d, e] = five;
        let o = self.double(e);
        let q = [a, b, c, d].map(|v| minus(self.double(v), o));
        let lift = q.map(|x| dot(x, x));
        // As in the formula: the coefficients −O(e,b,c,d), O(e,a,c,d), −O(e,a,b,d), O(e,a,b,c), negated.
        let minors = [[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]].map(|i| det3(i.map(|k| q[k])));
        let value = (lift[0] * minors[0].0 + lift[2] * minors[2].0)
            - (lift[1] * minors[1].0 + lift[3] * minors[3].0);
        let permanent = (0..4).map(|i| lift[i] * minors[i].1).sum();
        self.certain(value, permanent, 17)
            .or_else(|| {
                let p = self.any_exact(&five)?.map(|v| self.near(v, self.at(e)));
                formula::insphere(p.each_ref()).sign()
            })
            .unwrap_or_else(|| {
                let p = five.map(|v| self.exact(v));
                formula::insphere(p.each_ref()).exact_sign()
            })
    }

    /// The sign of the average of orient(a, b, c, q) over the points q: the side of the plane abc on which their
    /// centroid lies.
    pub(super) fn side(&self, [a, b, c]: [VertexId; 3], q: &[VertexId]) -> Sign {
        if let [v] = q {
            return self.orient([a, b, c, *v]);
        }
        let o = self.double(a);
        let (value, permanent) = q.iter().fold((0.0, 0.0), |(value, permanent), &v| {
            let (x, p) = det3([b, c, v].map(|w| minus(self.double(w), o)));
            (value + x, permanent + p)
        });
        self.certain(value, permanent, 8 + q.len() as u32)
            .or_else(|| {
                if self.exact.is_empty() {
                    return None;
                }
                let near = |v: VertexId| self.near(v, self.at(a));
                let p = [a, b, c].map(near);
                let sum = |sum: Approx, &v: &VertexId| {
                    sum + &formula::orient3d([&p[0], &p[1], &p[2], &near(v)])
                };
                q.iter().fold(Approx::from_f64(0.0), sum).sign()
            })
            .unwrap_or_else(|| total(q, |v| self.volume([a, b, c, v])))
    }

    /// Twice the signed area of abc in the plane of the two axes, exactly.
    pub(super) fn area(&self, axes: [usize; 2], [a, b, c]: [VertexId; 3]) -> Dyadic {
        let [a, b, c] = [a, b, c].map(|v| {
            let p = self.exact(v);
            axes.map(|i| p.0[i].clone())
        });
        let d = |p: &[Dyadic; 2], i: usize| p[i].clone() - &a[i];
        d(&b, 0) * &d(&c, 1) - &(d(&b, 1) * &d(&c, 0))
    }

    /// The sign of [`Points::area`].
    pub(super) fn orient2d(&self, axes: [usize; 2], [a, b, c]: [VertexId; 3]) -> Sign {
        self.side2d(axes, [a, b], &[c])
    }

    /// The side of the line ab on which the centroid of the points q lies.
    pub(super) fn side2d(&self, axes: [usize; 2], [a, b]: [VertexId; 2], q: &[VertexId]) -> Sign {
        let at = |v: VertexId| axes.map(|i| self.double(v)[i]);
        let (o, p) = (at(a), at(b));
        let (value, permanent) = q.iter().fold((0.0, 0.0), |(value, permanent), &v| {
            let r = at(v);
            let left = (p[0] - o[0]) * (r[1] - o[1]);
            let right = (p[1] - o[1]) * (r[0] - o[0]);
            (
                value + (left - right),
                permanent + (left.abs() + right.abs()),
            )
        });
        self.certain(value, permanent, 4 + q.len() as u32)
            .unwrap_or_else(|| total(q, |v| self.area(axes, [a, b, v])))
    }

    /// How a coordinate of the centroid of the points q compares with that of v.
    pub(super) fn compare(&self, axis: usize, q: &[VertexId], v: VertexId) -> Sign {
        let x = self.double(v)[axis];
        // NaN where a coordinate is no double.
        let mut signs = q.iter().map(|&w| Sign::of_f64(self.double(w)[axis] - x));
        let first = signs.next().unwrap_or(Some(Sign::Zero));
        if let Some(first) = first
            && signs.all(|s| s == Some(first))
        {
            return first;
        }
        let x = self.exact(v);
        total(q, |w| self.exact(w).0[axis].clone() - &x.0[axis])
    }

    /// The order of two points by a coordinate.
    pub(super) fn order(&self, axis: usize, v: VertexId, w: VertexId) -> Ordering {
        match self.compare(axis, &[v], w) {
            Sign::Negative => Ordering::Less,
            Sign::Zero => Ordering::Equal,
            Sign::Positive => Ordering::Greater,
        }
    }

    /// Whether three points are exactly collinear.
    pub(super) fn collinear(&self, t: [VertexId; 3]) -> bool {
        [[0, 1], [1, 2], [2, 0]]
            .iter()
            .all(|&axes| self.orient2d(axes, t).is_zero())
    }

    /// Whether v is within `tolerance` of the line ab: |(b−a)×(v−a)|² ≤ tolerance²·|b−a|², exactly.
    pub(super) fn near_line(&self, [a, b]: [VertexId; 2], v: VertexId, tolerance: f64) -> bool {
        let (pa, pb, pv) = (self.double(a), self.double(b), self.double(v));
        // Far away beyond all doubt (the rounding error of this distance is a few ulp of the coordinates).
        let (along, away) = (minus(pb, pa), minus(pv, pa));
        let moment = cross(along, away);
        let rounding = 64.0 * f64::EPSILON * self.largest;
        let (moment, length) = (dot(moment, moment), dot(along, along));
        if SQUARES.contains(&length)
            && moment < f64::INFINITY
            && moment.sqrt() > 2.0 * (tolerance + rounding) * length.sqrt()
        {
            return false;
        }
        let [a, b, v] = [a, b, v].map(|p| self.exact(p));
        let along = b.sub(&a);
        let moment = along.cross(&v.sub(&a));
        self.within(moment.dot(&moment), along.dot(&along), tolerance)
    }

    /// Whether v is within `tolerance` of the plane abc: det² ≤ tolerance²·|normal|², exactly.
    pub(super) fn near_plane(&self, [a, b, c]: [VertexId; 3], v: VertexId, tolerance: f64) -> bool {
        // Far away beyond all doubt. The rounded normal of a needle may be mostly error, so this says how much.
        let (pa, pb, pc, pv) = (
            self.double(a),
            self.double(b),
            self.double(c),
            self.double(v),
        );
        let [p, q, r] = [pb, pc, pv].map(|x| minus(x, pa));
        let squares = [p, q, r].map(|x| dot(x, x));
        if squares.iter().all(|x| SQUARES.contains(x)) {
            let [p_length, q_length, r_length] = squares.map(f64::sqrt);
            let normal = cross(p, q);
            let error = 32.0 * f64::EPSILON * p_length * q_length;
            let least_height = dot(normal, r).abs() - error * r_length;
            if least_height > 2.0 * tolerance * (dot(normal, normal).sqrt() + error) {
                return false;
            }
        }
        let [a, b, c, v] = [a, b, c, v].map(|p| self.exact(p));
        let normal = b.sub(&a).cross(&c.sub(&a));
        let height = normal.dot(&v.sub(&a));
        self.within(height.clone() * &height, normal.dot(&normal), tolerance)
    }

    /// The distance of v from the plane abc, rounded.
    pub(super) fn distance_to_plane(&self, [a, b, c]: [VertexId; 3], v: VertexId) -> f64 {
        let (a, b, c, v) = (self.at(a), self.at(b), self.at(c), self.at(v));
        let normal = cross(minus(b, a), minus(c, a));
        dot(normal, minus(v, a)).abs() / dot(normal, normal).sqrt()
    }

    fn within(&self, square: Dyadic, unit: Dyadic, tolerance: f64) -> bool {
        let t = Dyadic::from_f64(tolerance);
        !(square - &(t.clone() * &t * &unit))
            .exact_sign()
            .is_positive()
    }
}

/// The determinant of three rows and the sum of the absolute values of its terms.
fn det3([a, b, c]: [[f64; 3]; 3]) -> (f64, f64) {
    let mut value = [0.0; 3];
    let mut permanent = 0.0;
    for i in 0..3 {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        let (left, right) = (b[j] * c[k], b[k] * c[j]);
        value[i] = a[i] * (left - right);
        permanent += a[i].abs() * (left.abs() + right.abs());
    }
    (value[0] + value[1] + value[2], permanent)
}

/// The sign of Σ value(q).
fn total(q: &[VertexId], value: impl Fn(VertexId) -> Dyadic) -> Sign {
    q.iter()
        .fold(Dyadic::ZERO, |sum, &v| sum + &value(v))
        .exact_sign()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Grid points make many zeros; tiny offsets make many near-zeros.
    fn coordinate() -> impl Strategy<Value = f64> {
        (-3i32..4, -2i32..3).prop_map(|(i, k)| f64::from(i) * 0.1 + f64::from(k) * 1e-16)
    }

    proptest! {
        /// The shortcut never contradicts the exact number.
        #[test]
        fn shortcut_is_exact(p in prop::collection::vec([coordinate(), coordinate(), coordinate()], 5)) {
            let points = Points::new(p);
            let v = [0, 1, 2, 3, 4].map(VertexId::new);
            let e = v.map(|i| points.exact(i));
            let [a, b, c, d, _] = v;
            prop_assert_eq!(points.orient([a, b, c, d]), points.volume([a, b, c, d]).exact_sign());
            prop_assert_eq!(points.insphere(v), formula::insphere(e.each_ref()).exact_sign());
            prop_assert_eq!(points.orient2d([1, 2], [a, b, c]), points.area([1, 2], [a, b, c]).exact_sign());
        }
    }

    proptest! {
        /// The same where points are exactly between others, and have rounded coordinates.
        #[test]
        fn shortcut_knows_of_exact_positions(
            p in prop::collection::vec([coordinate(), coordinate(), coordinate()], 10),
            t in prop::collection::vec(1u32..16, 5),
        ) {
            let mut exact = FxHashMap::default();
            let mut coordinates = p.clone();
            for (i, t) in t.iter().enumerate() {
                let t = Dyadic::from_f64(f64::from(*t) / 16.0);
                let (a, b) = (Vec3::<Dyadic>::from_f64(p[i]), Vec3::from_f64(p[i + 5]));
                let along = b.sub(&a);
                let at = Vec3([0, 1, 2].map(|k| along.0[k].clone() * &t + &a.0[k]));
                exact.insert(VertexId::new(coordinates.len()), at.clone());
                coordinates.push(at.0.map(|x| x.to_f64()));
            }
            let points = Points::new(coordinates).with_exact(exact);
            for start in 5..11 {
                let v = [0, 1, 2, 3, 4].map(|i| VertexId::new(start + i));
                let e = v.map(|i| points.exact(i));
                let [a, b, c, d, _] = v;
                prop_assert_eq!(points.orient([a, b, c, d]), points.volume([a, b, c, d]).exact_sign());
                prop_assert_eq!(points.insphere(v), formula::insphere(e.each_ref()).exact_sign());
                prop_assert_eq!(points.orient2d([1, 2], [a, b, c]), points.area([1, 2], [a, b, c]).exact_sign());
            }
        }
    }

    #[test]
    fn centroid_decides_the_side() {
        let points = Points::new(vec![
            [0., 0., 0.],
            [1., 0., 0.],
            [0., 1., 0.],
            [0., 0., 2.],
            [0., 0., -1.],
            [5., 5., -1.],
        ]);
        let [a, b, c, up, down, far] = [0, 1, 2, 3, 4, 5].map(VertexId::new);
        assert_eq!(points.side([a, b, c], &[up, down]), Sign::Positive);
        assert_eq!(points.side([a, b, c], &[up, down, far]), Sign::Zero);
        assert_eq!(points.side([a, b, c], &[down, far]), Sign::Negative);
    }

    #[test]
    fn distances_are_compared_exactly() {
        let points = Points::new(vec![
            [0., 0., 0.],
            [4., 0., 0.],
            [0., 4., 0.],
            [1., 0., 0.25],
        ]);
        let [a, b, c, v] = [0, 1, 2, 3].map(VertexId::new);
        assert!(points.near_line([a, b], v, 0.25) && points.near_plane([a, b, c], v, 0.25));
        assert!(!points.near_line([a, b], v, 0.2499) && !points.near_plane([a, b, c], v, 0.2499));
    }

    #[test]
    fn distances_neither_overflow_nor_underflow() {
        for e in [-1000, -600, -300, 0, 300, 600, 900] {
            let scale = 2f64.powi(e);
            let at = [
                [0.0; 3],
                [4.0, 0.0, 0.0],
                [0.0, 4.0, 0.0],
                [1.0, 0.25, 0.25],
            ];
            let points = Points::new(at.map(|p| p.map(|x| x * scale)).to_vec());
            let [a, b, c, v] = [0, 1, 2, 3].map(VertexId);
            assert!(points.near_line([a, b], v, 0.36 * scale), "2^{e}");
            assert!(!points.near_line([a, b], v, 0.35 * scale), "2^{e}");
            assert!(points.near_plane([a, b, c], v, 0.25 * scale), "2^{e}");
            assert!(!points.near_plane([a, b, c], v, 0.24 * scale), "2^{e}");
        }
    }

    /// The rounded normal of this needle points anywhere, but v is exactly on its plane.
    #[test]
    fn needles_have_a_plane() {
        let third = 1.0 / 3.0;
        let at = [
            [0.0; 3],
            [1.0, third, 0.1],
            [
                1.0 - f64::EPSILON,
                third - f64::EPSILON / 4.0,
                0.1 + f64::EPSILON / 16.0,
            ],
            [0.0; 3],
        ];
        let mut at = at.to_vec();
        at[3] = [0, 1, 2].map(|i| 8.0 * at[1][i] - 7.0 * at[2][i]);
        let points = Points::new(at);
        let [a, b, c, v] = [0, 1, 2, 3].map(VertexId);
        assert!(points.near_plane([a, b, c], v, 1e-14));
    }
}
