//! Deleting an inserted polygon: which triangles are its, which constraints stay, and what to call what is in the way.
//! The flips are in [`flips`](crate::recover::flips).
//!
//! The segments of the polygon stay, with their Steiner points. Everything takes time in proportion to the polygon and
//! to the region that is flipped, not to the mesh.

use crate::error::{DeletionRefused, Obstacle};
use crate::mesh::{Corner, TetId, VertexId};
use crate::predicate::PointStore;
use crate::recover::flips::{Blocked, FlipCounts, Kept, flip_delete};
use crate::recover::method::FlipOrder;
use crate::recover::polygons::delete_whole;
use crate::recover::region::Sides;
use crate::recover::subpolygons::{Face, face};
use crate::recover::workspace::{ConstrainedMesh, EdgeProtectedPlc};
use rustc_hash::FxHashSet;
use serde::Serialize;

/// What a deletion did.
#[derive(Clone, Copy, Default, PartialEq, Eq, Debug, Serialize)]
pub struct DeletionCounts {
    /// Triangles that the polygon consisted of.
    pub subpolygons: u64,
    /// Tetrahedra removed.
    pub removed: u64,
    /// Tetrahedra that took their place.
    pub created: u64,
    /// The flips.
    pub flips: FlipCounts,
}

impl DeletionCounts {
    /// Adds the counts of another deletion.
    pub fn add(&mut self, other: &DeletionCounts) {
        self.subpolygons += other.subpolygons;
        self.removed += other.removed;
        self.created += other.created;
        self.flips.add(&other.flips);
    }
}

/// Deletes polygons from a CDT.
pub(crate) struct PolygonDeletion<'a, P> {
    plc: &'a EdgeProtectedPlc<P>,
    cdt: &'a mut ConstrainedMesh,
}

impl<'a, P: PointStore> PolygonDeletion<'a, P> {
    /// For polygons of the given PLC, of which `cdt` is the CDT.
    pub fn new(plc: &'a EdgeProtectedPlc<P>, cdt: &'a mut ConstrainedMesh) -> Self {
        PolygonDeletion { plc, cdt }
    }

    /// Deletes polygon `f`, which is in the mesh. If it is refused the mesh has the same tetrahedra as before.
    ///
    /// # Errors
    /// What is in the way.
    pub fn delete(
        &mut self,
        f: usize,
        order: FlipOrder,
    ) -> Result<DeletionCounts, DeletionRefused> {
        let plc = self.plc;
        let polygon = &plc.pieces.complex.polygons[f];
        let boundary = plc.subsegments.boundary(polygon);
        let on_boundary = boundary.iter().flatten();
        let sides = Sides::with_table(
            &plc.points,
            polygon,
            polygon.vertices.iter().chain(on_boundary).copied(),
            std::mem::take(&mut self.cdt.scratch.sides),
        );
        let mut result = self.by_flips(f, &sides, &boundary, order);
        if !sides.flat && result.is_err() {
            // It may have been inserted from behind.
            result = self.by_flips(f, &sides.reversed(), &boundary, order);
        }
        if !sides.flat
            && result.is_err()
            && let Some(counts) = self.by_repairs(f, &boundary)
        {
            result = Ok(counts);
        }
        let flat = sides.flat;
        self.cdt.scratch.sides = sides.into_table();
        result.map_err(|blocked| {
            let (facets, obstacle) = (polygon.facets.clone(), self.obstacle(blocked));
            if flat {
                DeletionRefused::NoCdt { facets, obstacle }
            } else {
                DeletionRefused::NotFlat { facets, obstacle }
            }
        })
    }

    fn by_flips(
        &mut self,
        f: usize,
        sides: &Sides<P>,
        boundary: &[[VertexId; 2]],
        order: FlipOrder,
    ) -> Result<DeletionCounts, Blocked> {
        let corners = self.faces(f, boundary);
        let ConstrainedMesh {
            mesh,
            subpolygons,
            scratch,
            ..
        } = &mut *self.cdt;
        let faces: Vec<Face> = corners.iter().map(|&c| face(mesh.facet(c))).collect();
        let (subsegments, subpolygons) = (&self.plc.subsegments, &*subpolygons);
        let kept = Kept {
            edge: &|[a, b]| subsegments.segment_of(a, b).is_some(),
            triangle: &|t| subpolygons.get(&t).is_some_and(|&g| g as usize != f),
        };
        let deleted = flip_delete(mesh, sides, &corners, kept, order, &mut scratch.flips);
        self.cdt.created(&deleted.tets);
        if let Some(blocked) = deleted.blocked {
            return Err(blocked);
        }
        for t in &faces {
            self.cdt.subpolygons.remove(t);
        }
        Ok(DeletionCounts {
            subpolygons: faces.len() as u64,
            removed: deleted.before.len() as u64,
            created: deleted.tets.len() as u64,
            flips: deleted.counts,
        })
    }

    /// Deletes a polygon that is flat only to rounding by flips of faces that are not locally Delaunay, in any order.
    fn by_repairs(&mut self, f: usize, boundary: &[[VertexId; 2]]) -> Option<DeletionCounts> {
        let corners = self.faces(f, boundary);
        let (repairs, [removed, created]) = delete_whole(self.plc, self.cdt, &corners)?;
        let flips = FlipCounts {
            two_three: repairs.two_three,
            three_two: repairs.three_two,
            four_four: repairs.four_four,
            ..FlipCounts::default()
        };
        Some(DeletionCounts {
            subpolygons: corners.len() as u64,
            removed,
            created,
            flips,
        })
    }

    /// The triangles of f, found from its boundary inwards.
    fn faces(&self, f: usize, boundary: &[[VertexId; 2]]) -> Vec<Corner> {
        let mut faces = Vec::new();
        let mut found: FxHashSet<Face> = FxHashSet::default();
        let mut seen: FxHashSet<[VertexId; 2]> = FxHashSet::default();
        let mut open: Vec<([VertexId; 2], Option<TetId>)> =
            boundary.iter().map(|&e| (e, None)).collect();
        while let Some(([a, b], near)) = open.pop() {
            if !seen.insert([a.min(b), a.max(b)]) {
                continue;
            }
            let start = near
                .or_else(|| self.cdt.incidence.tet_at_edge(&self.cdt.mesh, a, b))
                .expect("every subsegment is an edge of the mesh");
            for t in self.cdt.mesh.around(start, a, b) {
                let c = self.cdt.mesh.exit_around(t, a, b);
                let [x, y, z] = face(self.cdt.mesh.facet(c));
                if self.cdt.subpolygons.get(&[x, y, z]) == Some(&(f as u32))
                    && found.insert([x, y, z])
                {
                    faces.push(c);
                    open.extend([[x, y], [x, z], [y, z]].map(|e| (e, Some(t))));
                }
            }
        }
        faces
    }

    /// What is in the way, in the terms of the input.
    fn obstacle(&self, blocked: Blocked) -> Obstacle {
        match blocked {
            Blocked::Edge([a, b]) => {
                let s = self.plc.subsegments.segment_of(a, b);
                let s = s.expect("only subsegments are kept") as usize;
                Obstacle::Segment(self.plc.pieces.complex.segments[s].ends)
            }
            Blocked::Triangle(t) => {
                let g = self.cdt.subpolygons[&t] as usize;
                Obstacle::Polygon(self.plc.pieces.complex.polygons[g].facets.clone())
            }
            Blocked::NoFlip(t) => Obstacle::NoFlip(t),
            Blocked::TooLate(t) => Obstacle::TooLate(t),
        }
    }
}
