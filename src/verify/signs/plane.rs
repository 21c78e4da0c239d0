//! Exact signs in the plane of two axes, and along one.

use crate::mesh::VertexId;
use crate::number::vector::minus;
use crate::number::{Dyadic, Sign};
use crate::verify::signs::filter::{self, Permanent};
use crate::verify::signs::fixed;
use crate::verify::signs::formulas::{Compare, Side2d};
use crate::verify::signs::points::Points;
use crate::verify::signs::words::{self, Cell};
use arrayvec::ArrayVec;
use std::cmp::Ordering;

impl Points {
    /// Twice the signed area of abc in the plane of the two axes, exactly.
    pub(crate) fn area(&self, axes: [usize; 2], [a, b, c]: [VertexId; 3]) -> Dyadic {
        let [a, b, c] = [a, b, c].map(|v| {
            let p = self.exact(v);
            axes.map(|i| p.0[i].clone())
        });
        let d = |p: &[Dyadic; 2], i: usize| p[i].clone() - &a[i];
        d(&b, 0) * &d(&c, 1) - &(d(&b, 1) * &d(&c, 0))
    }

    /// The sign of [`Points::area`].
    pub(crate) fn orient2d(&self, axes: [usize; 2], [a, b, c]: [VertexId; 3]) -> Sign {
        self.side2d(axes, [a, b], &[c])
    }

    /// The side of the line ab on which the centroid of the points q lies.
    pub(crate) fn side2d(&self, axes: [usize; 2], [a, b]: [VertexId; 2], q: &[VertexId]) -> Sign {
        let at = |v: VertexId| {
            let p = self.at(v);
            axes.map(|i| p[i])
        };
        let wobble = self.wobble(&[a, b]).max(self.wobble(q));
        let filtered = filter::side2d([at(a), at(b)], q.iter().map(|&v| at(v)), wobble);
        filtered.filter(|_| self.shortcut).unwrap_or_else(|| {
            if let [c] = *q
                && let Some(cells) = self.cells([a, b, c])
            {
                let plane = |p: Cell| axes.map(|i| p[i]);
                return self.counted(words::orient2d(cells.map(plane)));
            }
            let mut ids = ArrayVec::<VertexId, { fixed::MOST_POINTS }>::from_iter([a, b]);
            ids.extend(q.iter().copied().filter(|v| ![a, b].contains(v)));
            match ids.len() {
                2 => Sign::Zero,
                _ => self.in_fixed(&ids, &Side2d { axes }),
            }
        })
    }

    /// The sign of the area between a point and edges, if certain.
    pub(crate) fn quick_area(
        &self,
        axes: [usize; 2],
        origin: VertexId,
        edges: impl Iterator<Item = [VertexId; 2]>,
    ) -> Option<Sign> {
        if !self.shortcut {
            return None;
        }
        let o = self.at(origin);
        let mut sum = Permanent::default();
        let mut n = 4;
        for edge in edges {
            if self.wobble(&edge) != 0.0 || self.wobble(&[origin]) != 0.0 {
                return None;
            }
            let [p, q] = edge.map(|v| minus(self.at(v), o));
            let (left, right) = (p[axes[0]] * q[axes[1]], p[axes[1]] * q[axes[0]]);
            sum = sum.plus(Permanent {
                value: left - right,
                terms: left.abs() + right.abs(),
            });
            n += 1;
        }
        sum.sign(n)
    }

    /// The side of the line ab of a point that is known up to `slack`, if certain; all in the plane of two axes.
    pub(crate) fn quick_side2d(
        &self,
        line: [[f64; 2]; 2],
        point: [f64; 2],
        slack: f64,
    ) -> Option<Sign> {
        let sign = filter::side2d(line, std::iter::once(point), slack);
        sign.filter(|_| self.shortcut)
    }

    /// How a coordinate of the centroid of the points q (seven at most) compares with that of v.
    pub(crate) fn compare(&self, axis: usize, q: &[VertexId], v: VertexId) -> Sign {
        let wobble = self.wobble(&[v]).max(self.wobble(q));
        let others = q.iter().map(|&w| self.at(w)[axis]);
        let filtered = filter::compare(self.at(v)[axis], others, wobble);
        filtered.filter(|_| self.shortcut).unwrap_or_else(|| {
            let mut ids = ArrayVec::<VertexId, { fixed::MOST_POINTS }>::from_iter([v]);
            ids.extend(q.iter().copied().filter(|w| *w != v));
            self.in_fixed(&ids, &Compare { axis })
        })
    }

    /// The order of two points by a coordinate.
    pub(crate) fn order(&self, axis: usize, v: VertexId, w: VertexId) -> Ordering {
        match self.compare(axis, &[v], w) {
            Sign::Negative => Ordering::Less,
            Sign::Zero => Ordering::Equal,
            Sign::Positive => Ordering::Greater,
        }
    }
}
