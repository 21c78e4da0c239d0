//! What is known of a polygon before anything is done: whether it is a triangle of the mesh already, and whether a
//! segment or another polygon crosses it, which in a valid PLC none does.

use super::{Current, PolygonInsertion, not_flat};
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
        let is_whole = |e: &[VertexId; 2]| self.plc.subsegments.segment_of(e[0], e[1]).is_some();
        if polygon.edges.len() != 3 || !polygon.edges.iter().all(is_whole) {
            return None;
        }
        // The star of a, until one of its tetrahedra has b, and then around ab.
        let star = &mut self.cdt.scratch.star;
        star.clear();
        star.extend(self.cdt.incidence.tet_at(a));
        let mut next = 0;
        while next < MOST_LOOKS {
            let &t = star.get(next)?;
            next += 1;
            let (vertices, twins) = self.cdt.mesh.tet(t);
            if vertices.contains(&b) {
                let mut around = self.cdt.mesh.around(t, a, b);
                let has_c = |t: TetId| self.cdt.mesh.slot_of(t, c).is_some();
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
    pub(super) fn check_crossings(&self, f: &Current<P>, region: &Region) -> Result<(), Failure> {
        self.check_segments(f, region)?;
        if self.cdt.subpolygons.is_empty() {
            return Ok(());
        }
        let mesh = &self.cdt.mesh;
        for c in region.crossing_triangles(mesh, &f.sides) {
            let facet = mesh.facet(c);
            if let Some(&other) = self.cdt.subpolygons.get(&face(facet)) {
                let second = self.plc.pieces.complex.polygons[other as usize]
                    .facets
                    .clone();
                return Err(if self.is_certain(f, &facet) {
                    let first = f.polygon.facets.clone();
                    InvalidPlc::PolygonsIntersect { first, second }.into()
                } else {
                    let facets = second;
                    not_flat(f.polygon, NotFlatReason::CrossedByPolygon { facets })
                });
            }
        }
        Ok(())
    }

    fn check_segments(&self, f: &Current<P>, region: &Region) -> Result<(), Failure> {
        if !self.may_be_crossed(&f.sides, region) {
            return Ok(());
        }
        for segment in region.crossing_edges(&self.cdt.mesh, &f.sides) {
            let [a, b] = segment;
            if let Some(s) = self.plc.subsegments.segment_of(a, b) {
                return Err(if self.is_certain(f, &segment) {
                    let facets = f.polygon.facets.clone();
                    InvalidPlc::SegmentThroughPolygon { facets, segment }.into()
                } else {
                    let segment = self.plc.pieces.complex.segments[s as usize].ends;
                    not_flat(f.polygon, NotFlatReason::CrossedBySegment { segment })
                });
            }
        }
        Ok(())
    }

    /// Whether what crosses f crosses the polygon of the input, not only what rounding has made of it.
    fn is_certain(&self, f: &Current<P>, vertices: &[VertexId]) -> bool {
        f.sides.flat && !vertices.iter().any(|&v| self.is_on_segment(v))
    }

    /// `false` if no subsegment is among the crossing edges of the region, and there are so few that one look at each
    /// tells: the sides of the region's vertices are known, and two of them must differ.
    fn may_be_crossed(&self, sides: &Sides<P>, region: &Region) -> bool {
        let few = self.plc.pieces.complex.segments.len() + self.plc.subsegments.steiner_count();
        if few > region.tets.len() {
            return true;
        }
        let side = |v: VertexId| match sides.known(v) {
            Some(Side::Left) => 1,
            Some(Side::Right) => 2,
            _ => 0,
        };
        (0..self.plc.pieces.complex.segments.len() as u32).any(|s| {
            let mut last = 0;
            self.plc
                .subsegments
                .chain(s)
                .map(side)
                .any(|side| std::mem::replace(&mut last, side) | side == 3)
        })
    }
}
