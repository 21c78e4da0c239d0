//! Each face has one or two tetrahedra, and two lie on opposite sides of it.
//!
//! # Why the tetrahedra do not overlap
//! Let all tetrahedra be positive, and let B be the faces with one tetrahedron, oriented outwards. If the two
//! tetrahedra of every other face lie on opposite sides, these faces cancel in the boundary of the sum of all
//! tetrahedra, which is then B. For a point x on no face, the number of tetrahedra that contain x is the degree of
//! that sum at x, and therefore the winding number of B around x. It changes by one, exactly, where x crosses a face
//! of B, and nowhere else. So the tetrahedra do not overlap iff the winding number of B is 0 or 1 everywhere. Two
//! more facts prove that:
//!
//! 1. the faces of B do not cross each other: where the outside is removed, they are on facets of the PLC, which
//!    intersect in common segments and vertices only (a premise: the PLC is valid; and coplanar faces are excluded
//!    from overlapping by the areas in [`super::facets`]); where the hull is kept, B is star-shaped
//!    ([`super::domain::hull`]);
//! 2. on the outer side of each face of B there is no tetrahedron: the winding number is 0 there and 1 on the inner
//!    side. Every region of space without B has a whole face of B on its boundary by 1, so that each has winding
//!    number 0 or 1.
//!
//! The outer sides of the faces of one shell ([`super::domain::shells`]) are joined across edges, where they look
//! into one empty wedge, which no face of B divides by 1. So the winding number is the same outside all of them, and
//! fact 2 is checked for one face of each shell ([`super::domain::winding`], called by [`super::domain`]). Where the
//! tetrahedra do not even match at their faces, this file says instead which tetrahedra contain the centroids of
//! boundary faces of others.
//!
//! Where the hull is kept there may be tetrahedra in its voids; all their vertices are in the hull
//! ([`super::domain`]), and they end at facets, so that their faces do not cross those of the hull either.
//!
//! # Within a tolerance
//! With a tolerance above zero, faces of B with rounded vertices are on their facets up to it only, and so are faces
//! on facets that are not exactly flat. That these do not cross others is looked at face by face
//! ([`super::crossings`]), so that fact 1 holds with any tolerance.

use crate::verify::case::Case;
use crate::verify::lookup::locate;
use crate::verify::verdict::Findings;
use crate::verify::violation::Violation;

pub(crate) fn check(case: &Case, findings: &mut Findings) {
    let tables = &case.tables;
    findings.counts.faces = tables.total;
    findings.counts.boundary_faces = tables.boundary().len();
    for &f in &tables.crowded {
        findings.report(Violation::CrowdedFace {
            face: tables.faces[f].key.map(|v| case.place(v)),
            tets: tables.tets_at(f),
        });
    }
    for &f in &tables.same_side {
        let face = &tables.faces[f];
        let Some(sides) = face
            .both()
            .filter(|_| tables.crowded.binary_search(&f).is_err())
        else {
            continue;
        };
        findings.report(Violation::SameSide {
            face: face.key.map(|v| case.place(v)),
            tets: sides.map(|side| side.tet()),
        });
    }
    if !findings.is_manifold() {
        let boundary: Vec<usize> = tables.boundary().map(|(f, _)| f).collect();
        overlaps(case, &boundary, findings);
    }
}

/// Reports the tetrahedra that contain the centroids of boundary faces of others.
pub(crate) fn overlaps(case: &Case, boundary: &[usize], findings: &mut Findings) {
    for (f, other) in locate::around_faces(case.points, case.tables, boundary) {
        let tets = [case.tables.faces[f].first().tet(), other];
        findings.report(Violation::Overlap { tets });
    }
}
