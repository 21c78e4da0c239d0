//! Which edges a ray from a point crosses, in the plane of two axes.

use crate::mesh::VertexId;
use crate::number::Sign;
use crate::verify::signs::points::Points;

/// How the ray from the centroid of q in the direction of the first axis crosses the edge ab: +1 upwards, −1 downwards,
/// 0 not at all. An end belongs to the upper edge at it; a point on an edge counts as right of it. So the sum over a
/// closed polygon is its winding number around the point, a point on the boundary being moved consistently.
pub(crate) fn crossing(
    points: &Points,
    axes: [usize; 2],
    [a, b]: [VertexId; 2],
    q: &[VertexId],
) -> i32 {
    let above = |v| !points.compare(axes[1], q, v).is_negative();
    match (above(a), above(b)) {
        (true, false) if points.side2d(axes, [a, b], q).is_positive() => 1,
        (false, true) if points.side2d(axes, [a, b], q).is_negative() => -1,
        _ => 0,
    }
}

/// The centroid of points in the plane of two axes, the first of which is the direction of a ray.
pub(crate) struct Probe<'a> {
    points: &'a Points,
    axes: [usize; 2],
    q: &'a [VertexId],
    /// Rounded.
    at: [f64; 2],
    /// How far off that may be.
    slack: f64,
}

impl<'a> Probe<'a> {
    pub(crate) fn new(points: &'a Points, axes: [usize; 2], q: &'a [VertexId]) -> Probe<'a> {
        let share = q.len() as f64;
        let at = axes.map(|i| q.iter().map(|&v| points.at(v)[i] / share).sum::<f64>());
        // As in the locator: at most six roundings.
        let coordinates = q.iter().flat_map(|&v| axes.map(|i| points.at(v)[i].abs()));
        let largest = coordinates.fold(0.0, f64::max);
        Probe {
            points,
            axes,
            q,
            at,
            slack: 16.0 * f64::EPSILON * largest + f64::MIN_POSITIVE + points.wobble(q),
        }
    }

    /// Bounds of the coordinate across the ray.
    pub(crate) fn height(&self) -> [f64; 2] {
        [self.at[1] - self.slack, self.at[1] + self.slack]
    }

    /// As [`crossing`].
    pub(crate) fn crossing(&self, edge: [VertexId; 2]) -> i32 {
        let [low, high] = self.height();
        let wobble = self.points.wobble(&edge);
        let [a, b] = edge.map(|v| {
            let p = self.points.at(v);
            self.axes.map(|i| p[i])
        });
        let above = |v: [f64; 2], id| {
            if low > v[1] + wobble {
                true
            } else if high < v[1] - wobble {
                false
            } else {
                !self.points.compare(self.axes[1], self.q, id).is_negative()
            }
        };
        let (from, to) = (above(a, edge[0]), above(b, edge[1]));
        if from == to {
            return 0;
        }
        let quickly = self
            .points
            .quick_side2d([a, b], self.at, self.slack + wobble);
        let side = quickly.unwrap_or_else(|| self.points.side2d(self.axes, edge, self.q));
        match (from, side) {
            (true, Sign::Positive) => 1,
            (false, Sign::Negative) => -1,
            _ => 0,
        }
    }
}
