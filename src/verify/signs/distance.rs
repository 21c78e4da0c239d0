//! Distances of points from lines and planes, compared exactly with a tolerance.

use crate::mesh::VertexId;
use crate::number::vector::{cross, dot, minus};
use crate::number::{Dyadic, Exact, Number};
use crate::verify::signs::points::Points;

/// Squares of lengths for which the distances below neither overflow nor lose anything that counts to underflow.
const SQUARES: std::ops::Range<f64> = 1e-90..1e90;

impl Points {
    /// Whether three points are exactly collinear.
    pub(crate) fn collinear(&self, t: [VertexId; 3]) -> bool {
        [[0, 1], [1, 2], [2, 0]]
            .iter()
            .all(|&axes| self.orient2d(axes, t).is_zero())
    }

    /// Whether v is within `tolerance` of the line ab: |(b−a)×(v−a)|² ≤ tolerance²·|b−a|², exactly.
    pub(crate) fn near_line(&self, [a, b]: [VertexId; 2], v: VertexId, tolerance: f64) -> bool {
        if tolerance == 0.0 {
            return self.collinear([a, b, v]);
        }
        let (pa, pb, pv) = (self.at(a), self.at(b), self.at(v));
        // Far away beyond all doubt (the rounding error of this distance is a few ulp of the coordinates).
        let (along, away) = (minus(pb, pa), minus(pv, pa));
        let moment = cross(along, away);
        let rounding = 64.0 * f64::EPSILON * self.largest();
        let (moment, length) = (dot(moment, moment), dot(along, along));
        if self.wobble(&[a, b, v]) == 0.0
            && SQUARES.contains(&length)
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
    pub(crate) fn near_plane(&self, [a, b, c]: [VertexId; 3], v: VertexId, tolerance: f64) -> bool {
        if tolerance == 0.0 {
            return self.is_on_plane([a, b, c], v);
        }
        // Far away beyond all doubt. The rounded normal of a needle may be mostly error, so this says how much.
        let [p, q, r] = [b, c, v].map(|x| minus(self.at(x), self.at(a)));
        let squares = [p, q, r].map(|x| dot(x, x));
        let is_double = self.wobble(&[a, b, c, v]) == 0.0;
        if is_double && squares.iter().all(|x| SQUARES.contains(x)) {
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
    pub(crate) fn distance_to_plane(&self, [a, b, c]: [VertexId; 3], v: VertexId) -> f64 {
        let (a, b, c, v) = (self.at(a), self.at(b), self.at(c), self.at(v));
        // Sides of length about 1: neither the normal nor its square underflows.
        let sides = [minus(b, a), minus(c, a)];
        let size = sides.iter().flatten().fold(0.0f64, |m, x| m.max(x.abs()));
        let [p, q] = sides.map(|side| side.map(|x| x / size));
        let normal = cross(p, q);
        let distance = dot(normal, minus(v, a)).abs() / dot(normal, normal).sqrt();
        // Three points on a line up to rounding tell no distance.
        if distance.is_finite() { distance } else { 0.0 }
    }

    fn within(&self, square: Dyadic, unit: Dyadic, tolerance: f64) -> bool {
        // A tolerance in units of the last place of very large coordinates may be too large for a double.
        let t = Dyadic::from_f64(tolerance.min(f64::MAX));
        !(square - &(t.clone() * &t * &unit))
            .exact_sign()
            .is_positive()
    }
}

/// The distance from a non-negative double to the next one, or, if there is none, to the one before.
pub(crate) fn ulp(x: f64) -> f64 {
    let next = x.next_up();
    if next.is_finite() {
        next - x
    } else {
        x - x.next_down()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
