//! A polygon that is flat only to rounding, in projection: exact signs of two coordinates.
//!
//! The coordinate in which the normal of the polygon's frame is largest is dropped, so that the projection is one to
//! one wherever the polygon is nearly flat. The projection is viewed from the left side of the polygon.

use crate::mesh::VertexId;
use crate::number::{Dyadic, Number, Polynomial, Sign, Vec3, decide};
use crate::predicate::coordinates::{dot2d, largest, normal_axis, orient2d};
use crate::predicate::{PointStore, formula};
use std::cmp::Ordering;

/// The projection of a polygon.
pub(crate) struct Plane<'a, P> {
    points: &'a P,
    /// The coordinates that are kept, in an order in which the frame turns counterclockwise.
    axes: [usize; 2],
}

impl<'a, P: PointStore> Plane<'a, P> {
    /// The projection of a polygon whose frame is not collinear.
    pub(crate) fn new(points: &'a P, frame: [VertexId; 3]) -> Plane<'a, P> {
        let of_doubles = match frame.map(|v| points.doubles(v)) {
            [Some(a), Some(b), Some(c)] => normal_axis([a, b, c]),
            _ => None,
        };
        let (dropped, sign) = of_doubles.unwrap_or_else(|| {
            let [a, b, c] = frame.map(|v| points.coordinates::<Dyadic>(v));
            largest(&b.sub(&a).cross(&c.sub(&a)))
        });
        let mut axes = [(dropped + 1) % 3, (dropped + 2) % 3];
        if sign.is_negative() {
            axes.swap(0, 1);
        }
        Plane { points, axes }
    }

    /// Where v is, if its coordinates are doubles.
    #[inline]
    fn at(&self, v: VertexId) -> Option<[f64; 2]> {
        let p = self.points.doubles(v)?;
        Some([p[self.axes[0]], p[self.axes[1]]])
    }

    fn coordinates<N: Number>(&self, v: VertexId) -> [N; 2] {
        let Vec3(p) = self.points.coordinates::<N>(v);
        self.axes.map(|k| p[k].clone())
    }

    /// Positive iff abc turns left.
    #[inline]
    pub(crate) fn turn(&self, a: VertexId, b: VertexId, c: VertexId) -> Sign {
        match (self.at(a), self.at(b), self.at(c)) {
            (Some(a), Some(b), Some(c)) => orient2d([a, b, c]),
            _ => self.turn_of_any(a, b, c),
        }
    }

    fn turn_of_any(&self, a: VertexId, b: VertexId, c: VertexId) -> Sign {
        decide(&Turn(self, [a, b, c]))
    }

    /// Whether b and c are in the same direction from a, rather than in opposite ones, for collinear points.
    pub(crate) fn ahead(&self, a: VertexId, b: VertexId, c: VertexId) -> bool {
        let sign = match (self.at(a), self.at(b), self.at(c)) {
            (Some(a), Some(b), Some(c)) => dot2d([a, b, c]),
            _ => decide(&Ahead(self, [a, b, c])),
        };
        sign.is_positive()
    }

    /// Of several points, the one whose direction from v is the last one counterclockwise from the direction to
    /// `first`, which is the least; the last of them if several directions are.
    pub(crate) fn last_around<T>(
        &self,
        v: VertexId,
        first: VertexId,
        targets: impl Iterator<Item = (VertexId, T)>,
    ) -> Option<(VertexId, T)> {
        let mut targets = targets.peekable();
        let mut last = targets.next()?;
        if targets.peek().is_none() {
            return Some(last);
        }
        let quarter = |p: VertexId| {
            if p == first {
                return 0;
            }
            match self.turn(v, first, p) {
                Sign::Zero if self.ahead(v, first, p) => 0,
                Sign::Positive => 1,
                Sign::Zero => 2,
                Sign::Negative => 3,
            }
        };
        let mut its_quarter = quarter(last.0);
        for target in targets {
            let of_target = quarter(target.0);
            let is_before = match its_quarter.cmp(&of_target) {
                Ordering::Equal if of_target % 2 == 1 => {
                    self.turn(v, last.0, target.0).is_negative()
                }
                order => order.is_gt(),
            };
            if !is_before {
                (last, its_quarter) = (target, of_target);
            }
        }
        Some(last)
    }

    /// Whether v is on the open segment pq.
    pub(crate) fn is_between(&self, p: VertexId, q: VertexId, v: VertexId) -> bool {
        if let (Some(p), Some(q), Some(v)) = (self.at(p), self.at(q), self.at(v))
            && (0..2).any(|k| v[k] < p[k].min(q[k]) || v[k] > p[k].max(q[k]))
        {
            return false;
        }
        v != p
            && v != q
            && self.turn(p, q, v).is_zero()
            && self.ahead(p, q, v)
            && self.ahead(q, p, v)
    }

    /// Whether two segments cross: have one common inner point.
    pub(crate) fn cross(&self, [p, q]: [VertexId; 2], [s, t]: [VertexId; 2]) -> bool {
        let share = p == s || p == t || q == s || q == t;
        !share
            && (self.turn(p, q, s) * self.turn(p, q, t)).is_negative()
            && (self.turn(s, t, p) * self.turn(s, t, q)).is_negative()
    }

    /// Where two segments cross: whether pq passes on the left side of st, above it.
    pub(crate) fn passes_above(&self, [p, q]: [VertexId; 2], [s, t]: [VertexId; 2]) -> bool {
        let sign = self.points.orient3d([p, q, s, t]);
        // With s to the right of p→q, det[q−p, s−p, t−p] is positive if st is below.
        if self.turn(p, q, s).is_negative() {
            sign.is_positive()
        } else {
            sign.is_negative()
        }
    }

    /// The sign of the area to the left of a closed walk.
    pub(crate) fn area(&self, walk: &[[VertexId; 2]]) -> Sign {
        match *walk {
            [[a, b], [_, c], [_, d]] if d == a => self.turn(a, b, c),
            _ => decide(&Area(self, walk)),
        }
    }

    /// Whether v is inside a closed walk that does not pass through it.
    pub(crate) fn is_inside(&self, walk: &[[VertexId; 2]], v: VertexId) -> bool {
        let above = |w: VertexId| decide(&Above(self, [v, w])).is_positive();
        let crossings = walk.iter().filter(|&&[a, b]| match (above(a), above(b)) {
            (false, true) => self.turn(a, b, v).is_positive(),
            (true, false) => self.turn(a, b, v).is_negative(),
            _ => false,
        });
        crossings.count() % 2 == 1
    }

    /// The projection of a point.
    pub(crate) fn project(&self, p: [f64; 3]) -> [f64; 2] {
        [p[self.axes[0]], p[self.axes[1]]]
    }

    /// Rounded coordinates in the projection.
    pub(crate) fn rounded(&self, v: VertexId) -> [f64; 2] {
        self.project(self.points.rounded(v))
    }
}

/// The orientation of abc in the projection.
struct Turn<'a, P>(&'a Plane<'a, P>, [VertexId; 3]);

impl<P: PointStore> Polynomial for Turn<'_, P> {
    fn value<N: Number>(&self) -> N {
        let corners = self.1.map(|v| self.0.coordinates::<N>(v));
        formula::orient2d(corners.each_ref())
    }
}

/// (b−a)·(c−a) in the projection.
struct Ahead<'a, P>(&'a Plane<'a, P>, [VertexId; 3]);

impl<P: PointStore> Polynomial for Ahead<'_, P> {
    fn value<N: Number>(&self) -> N {
        let points = self.1.map(|v| self.0.coordinates::<N>(v));
        formula::dot2d(points.each_ref())
    }
}

/// How far w is above v in the projection.
struct Above<'a, P>(&'a Plane<'a, P>, [VertexId; 2]);

impl<P: PointStore> Polynomial for Above<'_, P> {
    fn value<N: Number>(&self) -> N {
        let [[_, v], [_, w]] = self.1.map(|v| self.0.coordinates::<N>(v));
        w - &v
    }
}

/// Twice the area to the left of a closed walk in the projection.
struct Area<'a, P>(&'a Plane<'a, P>, &'a [[VertexId; 2]]);

impl<P: PointStore> Polynomial for Area<'_, P> {
    fn value<N: Number>(&self) -> N {
        let at = |v| self.0.coordinates::<N>(v);
        let origin = at(self.1[0][0]);
        self.1.iter().fold(N::from_f64(0.0), |sum, &[a, b]| {
            sum + &formula::orient2d([&origin, &at(a), &at(b)])
        })
    }
}
