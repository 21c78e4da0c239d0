//! Which triangles a polygon is made of, during its insertion and at its end.

use super::{Current, PolygonInsertion};
use crate::delaunay::is_locally_delaunay;
use crate::mesh::{TetId, TetMesh, VertexId};
use crate::predicate::PointStore;
use crate::recover::region::{Side, Sides};
use crate::recover::subpolygons::{Face, face};
use rustc_hash::FxHashSet;

impl<P: PointStore> PolygonInsertion<'_, P> {
    /// Notes the triangles with which the insertion of a region covered f.
    pub(super) fn cover(&mut self, f: &Current<P>, faces: &[[VertexId; 3]]) {
        self.counts.recovered += faces.len() as u64;
        self.counts.most_recovered = self.counts.most_recovered.max(faces.len() as u64);
        self.note(f, faces);
    }

    /// Notes triangles of f that are in the mesh.
    pub(super) fn note(&mut self, f: &Current<P>, faces: &[[VertexId; 3]]) {
        self.noted.extend(faces.iter().map(|&t| face(t)));
        let on_f = faces.iter().map(|&t| (face(t), f.f as u32));
        self.cdt.subpolygons.extend(on_f);
    }

    /// Makes `faces`, found by the last search, the subpolygons of f, and no others that insertions have noted.
    pub(super) fn settle(&mut self, f: &Current<P>, faces: &[[VertexId; 3]]) {
        for t in std::mem::take(&mut self.noted) {
            self.cdt.subpolygons.remove(&t);
        }
        let on_f = faces.iter().map(|&t| (face(t), f.f as u32));
        self.cdt.subpolygons.extend(on_f);
    }

    /// Whether a triangle is gone from the mesh or is locally Delaunay in it.
    pub(super) fn is_gone_or_locally_delaunay(&self, [a, b, c]: Face) -> bool {
        let mesh = &self.cdt.mesh;
        let Some(t) = self.cdt.incidence.tet_at_edge(mesh, a, b) else {
            return true;
        };
        let mut around = mesh.around(t, a, b);
        let with_triangle = around.find(|&t| mesh.slot_of(t, c).is_some());
        with_triangle.is_none_or(|t| {
            let apex = mesh.vertices(t).iter().position(|v| ![a, b, c].contains(v));
            let corner = t.corner(apex.expect("three of four vertices are those"));
            mesh.is_ghost(t) || is_locally_delaunay(&self.plc.points, mesh, corner)
        })
    }
}

/// Whether triangles have `boundary` as their boundary, and every other edge once in each direction. They are seen from
/// the left, from where the polygon lies to the left of its boundary.
pub(super) fn covers_simply(faces: &[[VertexId; 3]], boundary: &[[VertexId; 2]]) -> bool {
    let mut open: FxHashSet<[VertexId; 2]> = FxHashSet::default();
    let edges = faces.iter().flat_map(|&[a, b, c]| [[b, a], [a, c], [c, b]]);
    let border = boundary.iter().map(|&[a, b]| [b, a]);
    let mut simple = true;
    for [a, b] in edges.chain(border) {
        if !open.remove(&[b, a]) {
            simple &= open.insert([a, b]);
        }
    }
    simple && open.is_empty()
}

/// How many tetrahedra have all their vertices on f, which is flat only to rounding.
pub(super) fn count_shims<P: PointStore>(mesh: &TetMesh, sides: &Sides<P>, tets: &[TetId]) -> u64 {
    let is_shim = |&&t: &&TetId| mesh.vertices(t).iter().all(|&v| sides.of(v) == Side::On);
    tets.iter().filter(is_shim).count() as u64
}
