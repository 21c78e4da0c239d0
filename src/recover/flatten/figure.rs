//! A polygon that is to be cut, as a plane figure: its vertices, numbered in ascending order, and its boundary.

use super::neighbours::Neighbours;
use super::plane::Plane;
use crate::mesh::{Groups, Incidence, TetMesh, VertexId};
use crate::plc::Polygon;
use crate::predicate::PointStore;
use crate::recover::segments::Subsegments;

/// A polygon in projection.
pub(super) struct Figure<'a, P> {
    pub(super) points: &'a P,
    pub(super) plane: Plane<'a, P>,
    pub(super) vertices: &'a [VertexId],
    /// The directed boundary subsegments.
    pub(super) boundary: &'a [[VertexId; 2]],
    /// The ends of the subsegments at each vertex, by number, and whether they lead there from it.
    around: Groups<(VertexId, bool)>,
}

impl<'a, P: PointStore> Figure<'a, P> {
    /// The figure of polygon f with `vertices`, sorted, Steiner points included.
    pub(super) fn new(
        points: &'a P,
        f: &Polygon,
        (boundary, vertices): (&'a [[VertexId; 2]], &'a [VertexId]),
    ) -> Figure<'a, P> {
        let number = |v| VertexId::new(number(vertices, v));
        let ends = boundary
            .iter()
            .flat_map(|&[a, b]| [(number(a), (b, true)), (number(b), (a, false))]);
        let ends: Vec<(VertexId, (VertexId, bool))> = ends.collect();
        Figure {
            points,
            plane: Plane::new(points, f.frame),
            vertices,
            boundary,
            around: Groups::new(vertices.len(), ends.iter().copied()),
        }
    }

    /// The number of one of the vertices.
    pub(super) fn number(&self, v: VertexId) -> usize {
        number(self.vertices, v)
    }

    /// The edges of the mesh between the vertices that could divide f: those that are no edges of its boundary, do not
    /// run along segments, and lead into f at both ends.
    pub(super) fn candidates(
        &self,
        mesh: &TetMesh,
        incidence: &Incidence,
        neighbours: &mut Neighbours,
        subsegments: &Subsegments,
    ) -> Vec<[VertexId; 2]> {
        let mut candidates: Vec<[VertexId; 2]> = Vec::new();
        for (i, &v) in self.vertices.iter().enumerate() {
            let greater = &self.vertices[i + 1..];
            if greater.is_empty() {
                break;
            }
            let mut take = |j: usize| {
                let w = greater[j];
                if !self.around(i).any(|(u, _)| u == w)
                    && !subsegments.share_segment(v, w)
                    && self.leads_inside(i, w)
                    && self.leads_inside(i + 1 + j, v)
                {
                    candidates.push([v, w]);
                }
            };
            // A search for each element of the shorter list in the longer one.
            let others = neighbours.of(mesh, incidence, v);
            if others.len() < greater.len() {
                let found = others.iter().filter_map(|w| greater.binary_search(w).ok());
                found.for_each(&mut take);
            } else {
                let found =
                    (0..greater.len()).filter(|&j| others.binary_search(&greater[j]).is_ok());
                found.for_each(&mut take);
            }
        }
        candidates
    }

    fn around(&self, i: usize) -> impl Iterator<Item = (VertexId, bool)> + '_ {
        self.around.of(VertexId::new(i)).iter().copied()
    }

    /// Whether f is where the edge from the vertex with number i to w begins.
    fn leads_inside(&self, i: usize, w: VertexId) -> bool {
        let v = self.vertices[i];
        // The last one counterclockwise from w is the first one clockwise.
        let Some((last, _)) = self.plane.last_around(v, w, self.around(i)) else {
            return true;
        };
        let overlaps = |p| self.plane.turn(v, w, p).is_zero() && self.plane.ahead(v, w, p);
        self.around(i).any(|(p, leads)| leads && p == last)
            && !self.around(i).any(|(p, _)| overlaps(p))
    }
}

fn number(vertices: &[VertexId], v: VertexId) -> usize {
    let found = vertices.binary_search(&v);
    found.expect("the ends of subsegments are vertices of the polygon")
}
