//! What is known of a polygon before anything is done: whether it is a triangle of the mesh already, and whether a
//! segment or another polygon crosses it, which in a valid PLC none does.

use super::PolygonInsertion;
use crate::error::{Failure, InvalidPlc, NotFlatReason};
use crate::mesh::{TetId, VertexId};
use crate::plc::Polygon;
use crate::predicate::PointStore;
use crate::recover::region::{Region, Side, Sides};
use crate::recover::subpolygons::{Face, face};

/// How many tetrahedra at a vertex are looked at for one that has another vertex, too, without a hash table.
const MOST_LOOKS: usize = 40;

impl<P: PointStore> PolygonInsertion<'_, P> {
    /// The polygon, if it is a triangle of the mesh that no Steiner point divides and that is found soon: what the
    /// search would find, too, and the common case of surfaces in triangles.
    pub(super) fn triangle_in_mesh(&mut self, polygon: &Polygon) -> Option<Face> {
        let &[a, b, c] = polygon.vertices.as_slice() else {
            return None;
        };
        let is_whole = |e: &[VertexId; 2]| self.subsegments.segment_of(e[0], e[1]).is_some();
        if polygon.edges.len() != 3 || !polygon.edges.iter().all(is_whole) {
            return None;
        }
        // The star of a, until one of its tetrahedra has b, and then around ab.
        let star = &mut self.scratch.star;
        star.clear();
        star.extend(self.incidence.tet_at(a));
        let mut next = 0;
        while next < MOST_LOOKS {
            let &t = star.get(next)?;
            next += 1;
            let (vertices, twins) = self.mesh.tet(t);
            if vertices.contains(&b) {
                let mut around = self.mesh.around(t, a, b);
                let has_c = |t: TetId| self.mesh.slot_of(t, c).is_some();
                return around.any(has_c).then_some([a, b, c]);
            }
            for (v, twin) in vertices.iter().zip(twins) {
                if *v != a && !star.contains(&twin.tet()) {
                    star.push(twin.tet());
                }
            }
        }
        None
    }

    /// In a valid PLC no segment and no other polygon crosses f.
    pub(super) fn check_crossings(
        &self,
        f: usize,
        sides: &Sides<P>,
        flat: bool,
        region: &Region,
    ) -> Result<(), Failure> {
        let certain = |vertices: &[VertexId]| {
            flat && vertices
                .iter()
                .all(|&v| self.subsegments.segment_of_steiner(v).is_none())
        };
        let facets = || self.complex.polygons[f].facets.clone();
        let segments = match self.may_be_crossed(sides, region) {
            true => Some(region.crossing_edges(self.mesh, sides)),
            false => None,
        };
        for segment in segments.into_iter().flatten() {
            let [a, b] = segment;
            if let Some(s) = self.subsegments.segment_of(a, b) {
                return Err(if certain(&segment) {
                    let facets = facets();
                    InvalidPlc::SegmentThroughPolygon { facets, segment }.into()
                } else {
                    let segment = self.complex.segments[s as usize].ends;
                    self.not_flat(f, NotFlatReason::CrossedBySegment { segment })
                });
            }
        }
        if self.subpolygons.is_empty() {
            return Ok(());
        }
        for c in region.crossing_triangles(self.mesh, sides) {
            let facet = self.mesh.facet(c);
            if let Some(&other) = self.subpolygons.get(&face(facet)) {
                let second = self.complex.polygons[other as usize].facets.clone();
                return Err(if certain(&facet) {
                    InvalidPlc::PolygonsIntersect {
                        first: facets(),
                        second,
                    }
                    .into()
                } else {
                    self.not_flat(f, NotFlatReason::CrossedByPolygon { facets: second })
                });
            }
        }
        Ok(())
    }

    /// `false` if no subsegment is among the crossing edges of the region, and there are so few that one look at each
    /// tells: the sides of the region's vertices are known, and two of them must differ.
    fn may_be_crossed(&self, sides: &Sides<P>, region: &Region) -> bool {
        let few = self.complex.segments.len() + self.subsegments.steiner_count();
        if few > region.tets.len() {
            return true;
        }
        let side = |v: VertexId| match sides.known(v) {
            Some(Side::Left) => 1,
            Some(Side::Right) => 2,
            _ => 0,
        };
        (0..self.complex.segments.len() as u32).any(|s| {
            let mut last = 0;
            self.subsegments
                .chain(s)
                .map(side)
                .any(|side| std::mem::replace(&mut last, side) | side == 3)
        })
    }
}
