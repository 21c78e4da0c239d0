//! Every face that is on no facet is locally Delaunay: the apex of one tetrahedron is not inside the circumsphere of
//! the other, exactly and without perturbation (five points on a sphere are accepted).
//!
//! By the constrained Delaunay lemma (Shewchuk 2008, General-dimensional constrained Delaunay and constrained regular
//! triangulations) this makes a tetrahedralization that covers all facets the constrained Delaunay one.
//!
//! Each face is looked at once, when it is found ([`super::super::lookup::tables`]): those with one smallest vertex
//! together, so that their points are at hand.

use crate::threads;
use crate::verify::case::Case;
use crate::verify::lookup::spheres::side_of_sphere;
use crate::verify::verdict::Findings;
use crate::verify::violation::Violation;

/// Fewer faces are one thread's work.
const FEW: usize = 1 << 16;

/// Whether a face is on the boundary, or neither of its apexes is inside the circumsphere of the other tetrahedron.
pub(crate) fn is_locally_delaunay(case: &Case, f: usize) -> bool {
    !side_of_sphere(case.points, &case.tables.faces[f]).is_positive()
}

/// Counts the faces that are on no facet, and reports those that are not locally Delaunay, unless any triangulation
/// will do. `constrained[f]`: face f is one of those that cover a facet. `facet_of(f)`: a facet whose vertices it
/// has.
pub(crate) fn check(
    case: &Case,
    constrained: &[bool],
    facet_of: impl Fn(usize) -> Option<usize>,
    findings: &mut Findings,
) {
    let (faces, spheres) = (&case.tables.faces, &case.tables.spheres);
    let inner = case.tables.total - case.tables.boundary().len();
    let is_covering = |f: usize| constrained[f] && faces[f].is_shared();
    let covering = threads::count(faces.len(), FEW, is_covering);
    findings.counts.unconstrained_faces = inner - covering;
    if case.options.any_triangulation {
        return;
    }
    let free = |f: &&usize| !constrained[**f];
    let cospherical = spheres.cospherical.iter().filter(free).count();
    findings.counts.cospherical_faces = cospherical + spheres.cospherical_elsewhere;
    for &f in spheres.violated.iter().filter(free) {
        let face = &faces[f];
        let Some(sides) = face.both() else { continue };
        findings.report(Violation::NotLocallyDelaunay {
            face: face.key.map(|v| case.place(v)),
            tets: sides.map(|side| side.tet()),
            apexes: face.apexes.map(|v| case.place(v)),
            facet: facet_of(f),
        });
    }
}
