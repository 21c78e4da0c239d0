//! Every input vertex in the domain is a vertex of the mesh, at exactly its own coordinates.
//!
//! An input vertex that no tetrahedron uses is accepted only if it lies in no tetrahedron, boundary included: it is then
//! outside the part that was kept. (Where the convex hull is kept, [`super::hull`] reports it nevertheless.)

use super::input::place_key;
use super::{Case, Findings, Violation};
use crate::mesh::VertexId;
use rustc_hash::FxHashMap;

pub(super) fn check(case: &Case, findings: &mut Findings) {
    let mut first: FxHashMap<[u64; 3], VertexId> = FxHashMap::default();
    for v in (0..case.mesh.vertices.len()).map(VertexId::new) {
        if !case.tables.is_used(v) {
            continue;
        }
        findings.counts.vertices += 1;
        findings.counts.steiner_vertices += usize::from(!case.input.is_site(v));
        let w = *first.entry(place_key(case.points.at(v))).or_insert(v);
        if w != v && case.points.coincide(v, w) {
            findings.report(Violation::CoincidentVertices {
                first: case.place(w),
                second: case.place(v),
            });
        }
    }
    let mut seen = vec![false; case.input.is_site.len()];
    for (i, &site) in case.input.site_of.iter().enumerate() {
        if std::mem::replace(&mut seen[site.index()], true) {
            continue;
        }
        findings.counts.input_vertices += 1;
        if case.tables.is_used(site) {
            continue;
        }
        if let Some(&t) = case.locator.containing(site).first() {
            findings.report(Violation::MissingVertex {
                vertex: case.named(i, site),
                tet: Some(t),
            });
        } else {
            findings.counts.input_vertices_outside += 1;
        }
    }
}
