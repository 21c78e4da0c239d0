//! Flips of faces that are not locally Delaunay, until there are none, or none that can be flipped.
//!
//! Every flip replaces the tetrahedralization of five or six vertices by their Delaunay tetrahedralization, so that the
//! lifted surface sinks, and this ends. Triangles on polygons and subsegments stay; so do all edges that are Delaunay
//! among all vertices.

use super::PolygonInsertion;
use super::changed::Changed;
use crate::delaunay::is_locally_delaunay;
use crate::mesh::{Corner, TetId, VertexId};
use crate::predicate::PointStore;
use crate::recover::flips::{Flip, FlipKind, Signs, flip_of_triangle};
use crate::recover::subpolygons::face;

/// A facet of a tetrahedron, with the vertices that this had when it was noted.
type Noted = (Corner, [VertexId; 4]);

impl<P: PointStore> PolygonInsertion<'_, P> {
    /// Repairs the faces of some tetrahedra, and then of those that take their place.
    pub(super) fn repair(&mut self, tets: impl Iterator<Item = TetId>, changed: &mut Changed) {
        let mut open: Vec<Noted> = Vec::new();
        for t in tets {
            let v = self.cdt.mesh.vertices(t);
            open.extend((0..4).map(|slot| (t.corner(slot), v)));
        }
        let mut stuck: Vec<Noted> = Vec::new();
        while let Some((c, v)) = open.pop() {
            let mesh = &self.cdt.mesh;
            if !mesh.is_alive(c.tet())
                || mesh.vertices(c.tet()) != v
                || is_locally_delaunay(&self.plc.points, mesh, c)
                || self.is_covered(mesh.facet(c))
            {
                continue;
            }
            let flip = flip_of_triangle(&self.plc.points, mesh, c, Signs::UNKNOWN);
            let Some(flip) = flip.filter(|flip| self.may_flip(flip)) else {
                stuck.push((c, v));
                continue;
            };
            changed.removes(mesh, flip.old());
            let created = flip.perform(&mut self.cdt.mesh);
            changed.creates(&created);
            self.cdt.created(&created);
            let repairs = &mut self.counts.repairs;
            match flip.kind() {
                FlipKind::TwoThree => repairs.two_three += 1,
                FlipKind::ThreeTwo => repairs.three_two += 1,
                FlipKind::FourFour => repairs.four_four += 1,
            }
            for t in created {
                let v = self.cdt.mesh.vertices(t);
                open.extend((0..4).map(|slot| (t.corner(slot), v)));
            }
            // What could not be flipped perhaps can be now.
            open.append(&mut stuck);
        }
    }

    fn is_covered(&self, facet: [VertexId; 3]) -> bool {
        self.cdt.subpolygons.contains_key(&face(facet))
    }

    /// Whether a flip leaves all polygons and segments.
    fn may_flip(&self, flip: &Flip) -> bool {
        let ([p, q], ring) = match *flip {
            Flip::TwoThree(..) => return true,
            Flip::ThreeTwo(_, [v, w, p, q, r]) => ([p, q], vec![v, w, r]),
            Flip::FourFour(_, [v, w, p, q, r, u]) => ([p, q], vec![v, w, r, u]),
        };
        self.plc.subsegments.segment_of(p, q).is_none()
            && !ring.iter().any(|&r| self.is_covered([p, q, r]))
    }
}
