//! Whether walls hide a vertex from the centroid of a triangle: the visibility test of gift wrapping, exact.
//!
//! The centroid p of abc is no vertex, but orient3d is affine in each point, so
//!
//! > 3·orient3d(p,i,j,k) = orient3d(a,i,j,k) + orient3d(b,i,j,k) + orient3d(c,i,j,k).
//!
//! Where the three signs agree they settle it; otherwise the sum is evaluated, in filtered and then in exact numbers.
//!
//! Complexity: linear in the number of walls.

use crate::mesh::VertexId;
use crate::number::{Number, Polynomial, Sign, decide};
use crate::predicate::{PointStore, formula};

/// Triangles that hide what is behind them, as closed sets. No two of them overlap.
pub(super) struct Visibility<'a, P> {
    points: &'a P,
    walls: Vec<[VertexId; 3]>,
}

impl<'a, P: PointStore> Visibility<'a, P> {
    pub(super) fn new(points: &'a P, walls: Vec<[VertexId; 3]>) -> Visibility<'a, P> {
        Visibility { points, walls }
    }

    pub(super) fn points(&self) -> &'a P {
        self.points
    }

    /// Whether the open segment from the centroid of `s` to u, which is not in the plane of `s`, touches no wall.
    pub(super) fn is_visible(&self, u: VertexId, s: [VertexId; 3]) -> bool {
        !self.walls.iter().any(|&wall| self.hides(wall, u, s))
    }

    fn hides(&self, wall: [VertexId; 3], u: VertexId, s: [VertexId; 3]) -> bool {
        let from_u = self.orient(u, wall);
        match (from_u, self.orient_centroid(s, wall)) {
            (Sign::Zero, Sign::Zero) => self.hides_in_plane(wall, u, s),
            // The segment meets the plane of the wall at one of its ends only, or not at all.
            (Sign::Zero, _) | (_, Sign::Zero) => false,
            (from_u, from_p) if from_u == from_p => false,
            _ => {
                // It passes through the wall unless it passes the three edges on different sides.
                let [x, y, z] = wall;
                let turns = [[u, x, y], [u, y, z], [u, z, x]].map(|t| self.orient_centroid(s, t));
                !(turns.contains(&Sign::Positive) && turns.contains(&Sign::Negative))
            }
        }
    }

    /// The same if the segment is in the plane of the wall. Two convex sets in a plane are disjoint iff one of their
    /// edges lies on a line that separates them. An end of the segment may be on that line, as the segment is open; the
    /// wall is closed.
    fn hides_in_plane(&self, wall: [VertexId; 3], u: VertexId, s: [VertexId; 3]) -> bool {
        let off_plane = s
            .into_iter()
            .find(|&v| !self.orient(v, wall).is_zero())
            .expect("u is in the plane of the wall but not in that of s");
        let [x, y, z] = wall;
        // Seen from that vertex, three points in the plane turn left or right.
        let inner = self.orient(x, [y, z, off_plane]);
        let beyond_edge = |[i, j]: [VertexId; 2]| {
            let u_side = self.orient(u, [i, j, off_plane]);
            let p_side = self.orient_centroid(s, [i, j, off_plane]);
            u_side != inner && p_side != inner && !(u_side.is_zero() && p_side.is_zero())
        };
        let [from_x, from_y, from_z] = wall.map(|w| self.orient_centroid(s, [u, w, off_plane]));
        let beside_segment = from_x == from_y && from_y == from_z && !from_x.is_zero();
        !(beside_segment || [[x, y], [y, z], [z, x]].into_iter().any(beyond_edge))
    }

    /// orient3d(v, i, j, k).
    fn orient(&self, v: VertexId, [i, j, k]: [VertexId; 3]) -> Sign {
        if [i, j, k].contains(&v) {
            return Sign::Zero;
        }
        self.points.orient3d([v, i, j, k])
    }

    /// orient3d(p, i, j, k) for the centroid p of `s`.
    fn orient_centroid(&self, s: [VertexId; 3], t: [VertexId; 3]) -> Sign {
        let signs = s.map(|v| self.orient(v, t));
        match (
            signs.contains(&Sign::Positive),
            signs.contains(&Sign::Negative),
        ) {
            (true, true) => decide(&CentroidSum {
                points: self.points,
                s,
                t,
            }),
            (true, false) => Sign::Positive,
            (false, true) => Sign::Negative,
            (false, false) => Sign::Zero,
        }
    }
}

/// Three times orient3d(p, i, j, k) for the centroid p of `s` and the vertices i, j, k of `t`.
struct CentroidSum<'a, P> {
    points: &'a P,
    s: [VertexId; 3],
    t: [VertexId; 3],
}

impl<P: PointStore> Polynomial for CentroidSum<'_, P> {
    fn value<N: Number>(&self) -> N {
        let at = |v| self.points.coordinates::<N>(v);
        let [i, j, k] = self.t.map(at);
        let [a, b, c] = self.s.map(|v| formula::orient3d([&at(v), &i, &j, &k]));
        a + &b + &c
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::predicate::DoublePoints;

    /// Whether a wall hides u from the centroid of s.
    fn hidden(s: [[i32; 3]; 3], u: [i32; 3], wall: [[i32; 3]; 3]) -> bool {
        // A vertex that two of them share has one id.
        let mut all: Vec<[i32; 3]> = Vec::new();
        let mut id = |p: [i32; 3]| {
            let i = all.iter().position(|&q| q == p).unwrap_or_else(|| {
                all.push(p);
                all.len() - 1
            });
            VertexId::new(i)
        };
        let (s, u, wall) = (s.map(&mut id), id(u), wall.map(&mut id));
        let points = DoublePoints::new(all.iter().map(|p| p.map(f64::from)).collect());
        let [x, y, z] = wall;
        let answers = [[x, y, z], [y, z, x], [z, y, x]]
            .map(|wall| !Visibility::new(&points, vec![wall]).is_visible(u, s));
        assert!(answers[0] == answers[1] && answers[0] == answers[2]);
        answers[0]
    }

    /// Its centroid is the origin.
    const S: [[i32; 3]; 3] = [[-3, -3, 0], [3, 0, 0], [0, 3, 0]];

    #[test]
    fn a_wall_across_hides() {
        let u = [0, 0, 9];
        assert!(hidden(S, u, [[-1, -1, 4], [1, 0, 4], [0, 1, 4]]));
        // Beside the segment, behind its end, in front of its start.
        assert!(!hidden(S, u, [[5, -1, 4], [7, 0, 4], [5, 1, 4]]));
        assert!(!hidden(S, u, [[-1, -1, 10], [1, 0, 10], [0, 1, 10]]));
        assert!(!hidden(S, u, [[-1, -1, -1], [1, 0, -1], [0, 1, -1]]));
    }

    #[test]
    fn the_border_of_a_wall_hides() {
        let u = [0, 0, 9];
        // The segment passes through an edge, through a vertex, along an edge.
        assert!(hidden(S, u, [[-1, 0, 4], [1, 0, 5], [0, 3, 4]]));
        assert!(hidden(S, u, [[0, 0, 4], [1, 0, 5], [0, 3, 4]]));
        assert!(hidden(S, u, [[0, 0, 4], [0, 0, 5], [0, 3, 4]]));
    }

    #[test]
    fn what_touches_the_ends_does_not_hide() {
        let u = [0, 0, 9];
        assert!(!hidden(S, u, [u, [1, 0, 5], [0, 3, 4]]));
        assert!(!hidden(S, u, S));
        // In the plane y = 0 with the segment, at u, or at its centroid.
        assert!(!hidden(S, u, [u, [1, 0, 5], [3, 0, 4]]));
        assert!(!hidden(S, u, [u, [-2, 0, 12], [3, 0, 12]]));
        assert!(!hidden(S, u, [[0, 0, 0], [-2, 0, -2], [3, 0, -1]]));
        // On the line of the segment, beyond u.
        assert!(!hidden(S, u, [u, [0, 0, 12], [3, 0, 12]]));
        assert!(!hidden(S, u, [[0, 0, 10], [0, 0, 12], [3, 0, 12]]));
    }

    #[test]
    fn a_wall_in_the_plane_of_the_segment_hides() {
        let u = [0, 0, 9];
        assert!(hidden(S, u, [[-2, 0, 4], [2, 0, 4], [0, 0, 6]]));
        assert!(hidden(S, u, [[0, 0, 4], [2, 0, 4], [2, 0, 6]]));
        assert!(hidden(S, u, [u, [2, 0, 4], [-2, 0, 4]]));
        assert!(hidden(S, u, [u, [0, 0, 4], [-2, 0, 4]]));
        assert!(!hidden(S, u, [[1, 0, 4], [2, 0, 4], [2, 0, 6]]));
        // It contains the segment.
        assert!(hidden(S, u, [[-20, 0, -4], [20, 0, -4], [0, 0, 20]]));
    }

    /// Centroids that are no doubles: on the wall's plane or off it by less than rounding shows.
    #[test]
    fn centroids_are_exact() {
        let s = [[0, 0, 0], [1, 0, 0], [0, 1, 0]];
        // The centroid is (1/3, 1/3, 0), and the segment to u stays in the plane x = y.
        let u = [1 << 20, 1 << 20, 9];
        assert!(hidden(s, u, [[5, 5, -7], [5, 5, 7], [9, 9, 7]]));
        assert!(!hidden(s, u, [[5, 6, -7], [5, 6, 7], [9, 10, 7]]));
    }
}
