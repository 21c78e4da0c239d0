//! The mesh covers a convex body: the outer boundary is convex at every edge and star-shaped.
//!
//! Let p be the centroid of a tetrahedron that no other tetrahedron covers, and let p be on the inner side of every face
//! of the outer shell B (which the code checks). The winding number of B around p is the number of faces that a ray from p
//! crosses, as all are crossed outwards; it is also the number of tetrahedra around p (cavities apart), which is one. So
//! every ray crosses B once, and B is star-shaped and embedded. An embedded closed surface that is locally convex at
//! every edge bounds a convex body (Tietze, Nakajima). O(n) exact signs.
//!
//! Rounded Steiner points on edges of the hull make dents. A vertex outside of a neighbouring face is accepted if it is
//! within the tolerance of its plane and if one of the four vertices is a Steiner point; this is counted.

use super::shells::Shell;
use super::{Case, Findings, Violation};
use crate::mesh::VertexId;

/// `outer`: the shells of positive volume.
pub(super) fn check(case: &Case, outer: &[&Shell], findings: &mut Findings) {
    let centre = case.tables.tets[0];
    for other in case.locator.around_first() {
        findings.report(Violation::Overlap { tets: [0, other] });
    }
    let faces = outer.iter().map(|shell| shell.faces.len()).sum::<usize>();
    let mut around: Vec<([VertexId; 2], usize)> = Vec::with_capacity(3 * faces);
    for &f in outer.iter().flat_map(|shell| &shell.faces) {
        let face = &case.tables.faces[f];
        let inward = case.tables.inward(face.sides[0]);
        if !case.points.side(inward, &centre).is_positive() {
            findings.report(Violation::HullNotConvex {
                face: inward.map(|v| case.place(v)),
                apex: case.place(centre[0]),
            });
        }
        let [a, b, c] = face.key;
        // The key is sorted.
        around.extend([([a, b], f), ([b, c], f), ([a, c], f)]);
    }
    // Stable: faces stay in order.
    around.sort_by_key(|&(edge, _)| edge);
    for faces in around.chunk_by(|x, y| x.0 == y.0) {
        let edge = faces[0].0;
        let [(_, f), (_, g)] = *faces else {
            findings.report(Violation::HullNotManifold {
                edge: edge.map(|v| case.place(v)),
                faces: faces.len(),
            });
            continue;
        };
        check_edge(case, edge, [f, g], findings);
    }
}

fn check_edge(case: &Case, edge: [VertexId; 2], [f, g]: [usize; 2], findings: &mut Findings) {
    let [face, other] = [f, g].map(|i| &case.tables.faces[i]);
    let inward = case.tables.inward(face.sides[0]);
    let apex = *other
        .key
        .iter()
        .find(|v| !edge.contains(v))
        .expect("a face has a vertex off its edge");
    if !case
        .points
        .orient([inward[0], inward[1], inward[2], apex])
        .is_negative()
    {
        return;
    }
    let steiner = face
        .key
        .iter()
        .chain([&apex])
        .any(|&v| !case.input.is_site(v));
    if steiner && case.points.near_plane(inward, apex, case.tolerance) {
        findings.counts.hull_dents += 1;
    } else {
        findings.report(Violation::HullNotConvex {
            face: inward.map(|v| case.place(v)),
            apex: case.place(apex),
        });
    }
}
