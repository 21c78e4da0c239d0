//! Every input vertex in the domain is a vertex of the mesh, at exactly its own coordinates.
//!
//! An input vertex that no tetrahedron uses is accepted only if it lies in no tetrahedron, boundary included: it is
//! then outside the part that was kept. (Where the convex hull is kept, [`super::domain::hull`] reports it
//! nevertheless.)

use crate::mesh::VertexId;
use crate::verify::case::Case;
use crate::verify::verdict::Findings;
use crate::verify::violation::Violation;
use rustc_hash::FxHashMap;

pub(crate) fn check(case: &Case, findings: &mut Findings) {
    for v in (0..case.mesh.vertices.len()).map(VertexId::new) {
        if case.tables.is_used(v) {
            findings.counts.vertices += 1;
            findings.counts.steiner_vertices += usize::from(!case.input.is_site(v));
        }
    }
    for [first, second] in coincident(case) {
        findings.report(Violation::CoincidentVertices {
            first: case.place(first),
            second: case.place(second),
        });
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

/// Different used vertices at one place.
fn coincident(case: &Case) -> Vec<[VertexId; 2]> {
    let mut all = case.input.coincident.clone();
    let coordinates = &case.mesh.vertices;
    // The others, by their coordinates rounded.
    let mut near: FxHashMap<[u64; 3], Vec<VertexId>> = FxHashMap::default();
    for v in case.points.elsewhere() {
        if !case.tables.is_used(v) {
            continue;
        }
        let at = coordinates[v.index()];
        let others = near.entry(at.map(|x| (x + 0.0).to_bits())).or_default();
        let double = case.input.places.at(case.points.coordinates(), at);
        let mut earlier = others.iter().copied().chain(double);
        let same = earlier.find(|&w| case.tables.is_used(w) && case.points.coincide(v, w));
        all.extend(same.map(|w| [w.min(v), w.max(v)]));
        others.push(v);
    }
    all
}
