//! The last phase: what of the tetrahedralization is written, as arrays.

use super::Cdt;
use crate::error::{Failure, GaveUp};
use crate::exchange::Plc;
use crate::exchange::{ExactPosition, ExportedEdge, ExportedFace, ExportedMesh};
use crate::mesh::{SimplexIndex, TetId, VertexId, canonical_tet, sort_by_least};
use crate::predicate::{DoublePoints, PointStore};
use crate::recover::domain::{keeps_edge, mark_domain};
use crate::recover::output::embedding::check_embedding;
use crate::recover::output::rounding::round;
use crate::recover::output::shims::Repair;
use crate::recover::subpolygons::face;
use crate::report::{Phase, Report};
use crate::threads;
use std::borrow::Cow;

/// Fewer tetrahedra are one thread's work.
const FEW: usize = 1 << 15;

impl Cdt {
    /// The mesh as arrays: what the facets enclose without holes, or the convex hull. Tetrahedra, faces and edges are
    /// in an order that depends on their vertices alone, so that equal meshes give equal files.
    ///
    /// # Errors
    /// [`InvalidPlc`](crate::error::InvalidPlc) if polygons of the input overlap, or have something inside that they do
    /// not declare; [`GaveUp::NothingInside`] if nothing would be left.
    pub fn export(
        &mut self,
        plc: &Plc,
        keep_hull: bool,
        report: &mut Report,
    ) -> Result<ExportedMesh, Failure> {
        report.time(Phase::Domain, |report| {
            check_embedding(
                &self.plc.pieces.complex,
                &self.plc.subsegments,
                (&self.cdt.subpolygons, self.plc.points.len()),
                &self.cdt.inserted,
            )?;
            let n = self.plc.points.len();
            let walls = SimplexIndex::of_triangles(n, self.cdt.subpolygons.iter());
            let marks = mark_domain(plc, &self.plc.points, &self.cdt.mesh, &walls, keep_hull)?;
            let mut repair = Repair {
                points: &self.plc.points,
                mesh: Cow::Borrowed(&self.cdt.mesh),
                incidence: Cow::Borrowed(&self.cdt.incidence),
                subpolygons: Cow::Borrowed(&self.cdt.subpolygons),
                marks,
                pieces: &self.plc.pieces,
                subsegments: &self.plc.subsegments,
            };
            report.flattening.shims = repair.run(!keep_hull);
            let walls = match &repair.subpolygons {
                Cow::Borrowed(_) => walls,
                Cow::Owned(moved) => SimplexIndex::of_triangles(n, moved.iter()),
            };
            let (mesh, marks) = (&*repair.mesh, &repair.marks);
            let mut tets = threads::collect(mesh.capacity(), FEW, |i, tets| {
                let t = TetId::new(i);
                if marks.kept[i] && mesh.is_alive(t) && !mesh.is_ghost(t) {
                    tets.push((canonical_tet(mesh.vertices(t)), t));
                }
            });
            if tets.is_empty() {
                return Err(GaveUp::NothingInside.into());
            }
            sort_by_least(&mut tets, n, |tet| tet.0[0], |tet| tet.0);
            let vertices: Vec<[VertexId; 4]> = tets.iter().map(|&(v, _)| v).collect();
            let rounding = round(&self.plc.points, &vertices);
            report.moved_by_rounding = rounding.moved;
            report.spoilt_by_rounding = rounding.spoilt;
            let faces = self.faces(&repair, &walls);
            let mesh = ExportedMesh {
                first_index: plc.first_index,
                vertices: rounding.coordinates,
                exact: self.exact_positions(),
                regions: if marks.region.is_empty() {
                    Vec::new()
                } else {
                    tets.iter().map(|(_, t)| marks.region[t.index()]).collect()
                },
                edges: self.edges(&repair, &faces),
                faces,
                tets: vertices,
                ..ExportedMesh::default()
            };
            report.output_tets = mesh.tets.len();
            report.output_faces = mesh.faces.len();
            Ok(mesh)
        })
    }

    /// Where the points are whose coordinates are no doubles.
    fn exact_positions(&self) -> Vec<ExactPosition> {
        let first = self.complex.representative.len();
        let steiner = (first..self.plc.points.len()).map(VertexId::new);
        let rounded = steiner.filter(|&v| !self.plc.points.is_double(v));
        let position = |vertex: VertexId| {
            let (ends, t) = self.plc.subsegments.place_of_steiner(vertex)?;
            Some(ExactPosition { vertex, ends, t })
        };
        rounded
            .map(|v| position(v).expect("only points on segments are no doubles"))
            .collect()
    }

    /// The subpolygons of the domain with their markers, and the faces of its boundary.
    fn faces(&self, written: &Repair<DoublePoints>, walls: &SimplexIndex<2>) -> Vec<ExportedFace> {
        let (mesh, marks) = (&*written.mesh, &written.marks);
        let mut faces = threads::collect(mesh.capacity(), FEW, |i, faces| {
            let t = TetId::new(i);
            if !marks.kept[i] || !mesh.is_alive(t) || mesh.is_ghost(t) {
                return;
            }
            for c in (0..4).map(|slot| t.corner(slot)) {
                let n = mesh.neighbor(c);
                // Ghosts are not kept.
                let boundary = !marks.kept[n.index()];
                if !boundary && n < t {
                    continue;
                }
                let facet = mesh.facet(c);
                let polygon = walls.triangle(facet);
                if polygon.is_some() || boundary {
                    let marker =
                        polygon.map_or(0, |f| self.plc.pieces.complex.polygons[f as usize].marker);
                    let vertices = face(facet);
                    faces.push(ExportedFace { vertices, marker });
                }
            }
        });
        let n = self.plc.points.len();
        sort_by_least(&mut faces, n, |f| f.vertices[0], |f| f.vertices);
        faces
    }

    /// The subsegments of the domain, whose faces are given, with their markers.
    fn edges(&self, written: &Repair<DoublePoints>, faces: &[ExportedFace]) -> Vec<ExportedEdge> {
        let n = self.plc.points.len();
        let mut markers = Vec::new();
        let mut ends: Vec<[VertexId; 2]> = Vec::new();
        let given = self.complex.segments.len() - self.complex.diagonals;
        for (s, segment) in self.complex.segments[..given].iter().enumerate() {
            let mut chain = self.plc.subsegments.chain(s as u32);
            let mut last = chain.next();
            for v in chain {
                ends.extend(last.replace(v).map(|u| [u.min(v), u.max(v)]));
            }
            markers.resize(ends.len(), segment.marker);
        }
        // Where a face is written, its edges are. Of the others the tetrahedra decide.
        let mut kept = vec![false; ends.len()];
        let index = SimplexIndex::of_edges(n, &ends);
        for &ExportedFace { vertices, .. } in faces {
            let [a, b, c] = vertices;
            for i in [[a, b], [a, c], [b, c]].map(|[a, b]| index.edge(a, b)) {
                i.into_iter().for_each(|i| kept[i as usize] = true);
            }
        }
        let (mesh, incidence) = (&written.mesh, &written.incidence);
        let mut edges: Vec<ExportedEdge> = Vec::with_capacity(ends.len());
        for (i, (vertices, marker)) in ends.into_iter().zip(markers).enumerate() {
            let [a, b] = vertices;
            if kept[i] || keeps_edge(mesh, incidence, &written.marks, a, b) {
                edges.push(ExportedEdge { vertices, marker });
            }
        }
        sort_by_least(&mut edges, n, |e| e.vertices[0], |e| e.vertices);
        edges
    }
}
