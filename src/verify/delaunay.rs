//! Every face that is on no facet is locally Delaunay: the apex of one tetrahedron is not inside the circumsphere of the
//! other, exactly and without perturbation (five points on a sphere are accepted).
//!
//! By the constrained Delaunay lemma (Shewchuk 2008, General-dimensional constrained Delaunay and constrained regular
//! triangulations) this makes a tetrahedralization that covers all facets the constrained Delaunay one.

use super::{Case, Findings, Violation};
use crate::number::Sign;

/// `constrained[f]`: face f is one of those that cover a facet. `facet_of(f)`: a facet whose vertices it has.
pub(super) fn check(
    case: &Case,
    constrained: &[bool],
    facet_of: impl Fn(usize) -> Option<usize>,
    findings: &mut Findings,
) {
    for (f, face) in case.tables.faces.iter().enumerate() {
        if face.tets != 2 || constrained[f] {
            continue;
        }
        let [a, b] = face.sides;
        let [p, q, r, s] = case.tables.tets[a.0 as usize];
        findings.counts.unconstrained_faces += 1;
        match case.points.insphere([p, q, r, s, case.tables.apex(b)]) {
            Sign::Positive => findings.report(Violation::NotLocallyDelaunay {
                face: face.key.map(|v| case.place(v)),
                tets: [a, b].map(|side| side.0 as usize),
                apexes: [a, b].map(|side| case.place(case.tables.apex(side))),
                facet: facet_of(f),
            }),
            Sign::Zero => findings.counts.cospherical_faces += 1,
            Sign::Negative => {}
        }
    }
}
