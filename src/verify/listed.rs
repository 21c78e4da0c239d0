//! The faces and edges that the mesh lists are faces and edges of its tetrahedra.

use super::{Case, Findings, Violation};

pub(super) fn check(case: &Case, findings: &mut Findings) {
    for (index, face) in case.mesh.faces.iter().enumerate() {
        if case.tables.find_face(face.vertices).is_none() {
            findings.report(Violation::ListedNotInMesh {
                element: "face",
                index,
            });
        }
    }
    for (index, edge) in case.mesh.edges.iter().enumerate() {
        if !case.tables.has_edge(edge.vertices) {
            findings.report(Violation::ListedNotInMesh {
                element: "edge",
                index,
            });
        }
    }
}
