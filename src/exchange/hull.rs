//! A tetrahedralization of a convex hull as arrays.

use super::{ExportedFace, ExportedMesh};
use crate::mesh::{TetMesh, VertexId, canonical_face, canonical_tet, sort_by_least};

impl ExportedMesh {
    /// A tetrahedralization of a convex hull as arrays: its tetrahedra, and the faces of the hull, seen from outside.
    pub fn of_hull(first_index: u32, vertices: Vec<[f64; 3]>, mesh: TetMesh) -> ExportedMesh {
        let n = vertices.len();
        let ghosts = mesh
            .all()
            .filter_map(|t| Some(t.corner(mesh.slot_of(t, VertexId::INFINITE)?)));
        let mut faces: Vec<ExportedFace> = ghosts
            .map(|c| ExportedFace {
                vertices: canonical_face(mesh.facet(mesh.twin(c))),
                marker: 0,
            })
            .collect();
        sort_by_least(&mut faces, n, |f| f.vertices[0], |f| f.vertices);
        let mut tets = Vec::with_capacity(mesh.len() - faces.len());
        tets.extend(mesh.finite().map(|t| canonical_tet(mesh.vertices(t))));
        // Large inputs: what is not needed any more goes before the next array comes.
        drop(mesh);
        sort_by_least(&mut tets, n, |tet| tet[0], |&tet| tet);
        ExportedMesh {
            first_index,
            vertices,
            faces,
            tets,
            ..ExportedMesh::default()
        }
    }
}
