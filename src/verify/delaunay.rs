//! Every face that is on no facet is locally Delaunay: the apex of one tetrahedron is not inside the circumsphere of the
//! other, exactly and without perturbation (five points on a sphere are accepted).
//!
//! By the constrained Delaunay lemma (Shewchuk 2008, General-dimensional constrained Delaunay and constrained regular
//! triangulations) this makes a tetrahedralization that covers all facets the constrained Delaunay one.

use super::{Case, Findings, Violation};
use crate::number::Sign;

/// Whether a face is on the boundary, or neither of its apexes is inside the circumsphere of the other tetrahedron.
pub(super) fn is_locally_delaunay(case: &Case, f: usize) -> bool {
    let face = &case.tables.faces[f];
    face.tets != 2 || !side_of_sphere(case, f).is_positive()
}

/// The sign of insphere across a face with two tetrahedra.
fn side_of_sphere(case: &Case, f: usize) -> Sign {
    let [a, b] = case.tables.faces[f].sides;
    let [p, q, r, s] = case.tables.tets[a.0 as usize];
    case.points.insphere([p, q, r, s, case.tables.apex(b)])
}

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
        findings.counts.unconstrained_faces += 1;
        match side_of_sphere(case, f) {
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
