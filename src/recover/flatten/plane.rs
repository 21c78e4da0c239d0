//! A polygon that is flat only to rounding, in projection: exact signs of two coordinates.
//!
//! The coordinate in which the normal of the polygon's frame is largest is dropped, so that the projection is one to one
//! wherever the polygon is nearly flat. The projection is viewed from the left side of the polygon.

use crate::mesh::VertexId;
use crate::number::{Approx, Dyadic, Exact, Number, Sign};
use crate::predicate::PointStore;
use std::cmp::Ordering;

/// The projection of a polygon.
pub(super) struct Plane<'a, P> {
    points: &'a P,
    /// The coordinates that are kept, in an order in which the frame turns counterclockwise.
    axes: [usize; 2],
}

impl<'a, P: PointStore> Plane<'a, P> {
    /// The projection of a polygon whose frame is not collinear.
    pub(super) fn new(points: &'a P, frame: [VertexId; 3]) -> Plane<'a, P> {
        let [a, b, c] = frame.map(|v| points.coordinates::<Dyadic>(v));
        let normal = b.sub(&a).cross(&c.sub(&a)).0;
        let size = |k: usize| match normal[k].exact_sign() {
            Sign::Negative => Dyadic::ZERO - &normal[k],
            _ => normal[k].clone(),
        };
        let mut dropped = 0;
        for k in [1, 2] {
            if (size(k) - &size(dropped)).exact_sign().is_positive() {
                dropped = k;
            }
        }
        let mut axes = [(dropped + 1) % 3, (dropped + 2) % 3];
        if normal[dropped].exact_sign().is_negative() {
            axes.swap(0, 1);
        }
        Plane { points, axes }
    }

    fn decide(&self, approx: Approx, exact: impl FnOnce() -> Dyadic) -> Sign {
        approx.sign().unwrap_or_else(|| exact().exact_sign())
    }

    fn difference<N: Number>(&self, a: VertexId, b: VertexId) -> [N; 2] {
        let (a, b) = (
            self.points.coordinates::<N>(a),
            self.points.coordinates::<N>(b),
        );
        self.axes.map(|k| b.0[k].clone() - &a.0[k])
    }

    /// Positive iff abc turns left.
    pub(super) fn turn(&self, a: VertexId, b: VertexId, c: VertexId) -> Sign {
        fn value<N: Number>([p, q]: [[N; 2]; 2]) -> N {
            let [[px, py], [qx, qy]] = [p, q];
            px * &qy - &(py * &qx)
        }
        let both = [self.difference::<Approx>(a, b), self.difference(a, c)];
        self.decide(value(both), || {
            value([self.difference(a, b), self.difference(a, c)])
        })
    }

    /// Whether b and c are in the same direction from a, rather than in opposite ones, for collinear points.
    pub(super) fn ahead(&self, a: VertexId, b: VertexId, c: VertexId) -> bool {
        fn value<N: Number>([[px, py], [qx, qy]]: [[N; 2]; 2]) -> N {
            px * &qx + &(py * &qy)
        }
        let both = [self.difference::<Approx>(a, b), self.difference(a, c)];
        let sign = self.decide(value(both), || {
            value([self.difference(a, b), self.difference(a, c)])
        });
        sign.is_positive()
    }

    /// The order of the directions from v to p and q, counterclockwise from the direction to `first`, which is the least.
    pub(super) fn around(
        &self,
        v: VertexId,
        first: VertexId,
        p: VertexId,
        q: VertexId,
    ) -> Ordering {
        let quarter = |p: VertexId| match self.turn(v, first, p) {
            Sign::Zero if p == first || self.ahead(v, first, p) => 0,
            Sign::Positive => 1,
            Sign::Zero => 2,
            Sign::Negative => 3,
        };
        let (quarter_p, quarter_q) = (quarter(p), quarter(q));
        quarter_p
            .cmp(&quarter_q)
            .then_with(|| match self.turn(v, p, q) {
                Sign::Positive if quarter_p % 2 == 1 => Ordering::Less,
                Sign::Negative if quarter_p % 2 == 1 => Ordering::Greater,
                _ => Ordering::Equal,
            })
    }

    /// Whether v is on the open segment pq.
    pub(super) fn is_between(&self, p: VertexId, q: VertexId, v: VertexId) -> bool {
        v != p
            && v != q
            && self.turn(p, q, v).is_zero()
            && self.ahead(p, q, v)
            && self.ahead(q, p, v)
    }

    /// Whether two segments without a common end have a common inner point.
    pub(super) fn cross(&self, [p, q]: [VertexId; 2], [s, t]: [VertexId; 2]) -> bool {
        (self.turn(p, q, s) * self.turn(p, q, t)).is_negative()
            && (self.turn(s, t, p) * self.turn(s, t, q)).is_negative()
    }

    /// Where two segments cross: whether pq passes on the left side of st, above it.
    pub(super) fn passes_above(&self, [p, q]: [VertexId; 2], [s, t]: [VertexId; 2]) -> bool {
        let sign = self.points.orient3d([p, q, s, t]);
        // With s to the right of p→q, det[q−p, s−p, t−p] is positive if st is below.
        if self.turn(p, q, s).is_negative() {
            sign.is_positive()
        } else {
            sign.is_negative()
        }
    }

    /// The sign of the area to the left of a closed walk.
    pub(super) fn area(&self, walk: &[[VertexId; 2]]) -> Sign {
        fn value<N: Number, P: PointStore>(plane: &Plane<P>, walk: &[[VertexId; 2]]) -> N {
            let origin = walk[0][0];
            walk.iter().fold(N::from_f64(0.0), |sum, &[a, b]| {
                let [px, py] = plane.difference::<N>(origin, a);
                let [qx, qy] = plane.difference::<N>(origin, b);
                sum + &(px * &qy - &(py * &qx))
            })
        }
        self.decide(value(self, walk), || value(self, walk))
    }

    /// Whether v is inside a closed walk that does not pass through it.
    pub(super) fn is_inside(&self, walk: &[[VertexId; 2]], v: VertexId) -> bool {
        let above = |w: VertexId| {
            let sign = self.decide(self.difference::<Approx>(v, w)[1], || {
                self.difference::<Dyadic>(v, w)[1].clone()
            });
            sign.is_positive()
        };
        let crossings = walk.iter().filter(|&&[a, b]| match (above(a), above(b)) {
            (false, true) => self.turn(a, b, v).is_positive(),
            (true, false) => self.turn(a, b, v).is_negative(),
            _ => false,
        });
        crossings.count() % 2 == 1
    }

    /// The projection of a point.
    pub(super) fn project(&self, p: [f64; 3]) -> [f64; 2] {
        self.axes.map(|k| p[k])
    }

    /// Rounded coordinates in the projection.
    pub(super) fn rounded(&self, v: VertexId) -> [f64; 2] {
        self.project(self.points.rounded(v))
    }
}
