//! Each face has one or two tetrahedra, and two lie on opposite sides of it.
//!
//! # Why the tetrahedra do not overlap
//! Let all tetrahedra be positive, and let B be the faces with one tetrahedron, oriented outwards. If the two tetrahedra
//! of every other face lie on opposite sides, these faces cancel in the boundary of the sum of all tetrahedra, which
//! is then B. For a point x on no face, the number of tetrahedra that contain x is the degree of that sum at x, and
//! therefore the winding number of B around x. It changes by one, exactly, where x crosses a face of B, and nowhere else.
//! So the tetrahedra do not overlap iff the winding number of B is 0 or 1 everywhere. Two more facts prove that:
//!
//! 1. the faces of B do not cross each other: where the outside is removed, they are on facets of the PLC, which
//!    intersect in common segments and vertices only (a premise: the PLC is valid; and coplanar faces are excluded
//!    from overlapping by the areas in [`super::facets`]); where the hull is kept, B is star-shaped ([`super::hull`]);
//! 2. on the outer side of the centroid of each face of B there is no tetrahedron: the winding number is 0 there and 1
//!    on the inner side. Every region of space without B has a whole face of B on its boundary by 1, so that each has
//!    winding number 0 or 1.
//!
//! Fact 2 is checked here: the closure of no tetrahedron but its own contains the centroid of a boundary face.

use super::{Case, Findings, Violation};

pub(super) fn check(case: &Case, findings: &mut Findings) {
    let tables = &case.tables;
    findings.counts.faces = tables.faces.len();
    for face in &tables.faces {
        let [a, b] = face.sides;
        if face.tets > 2 {
            let [p, q, _] = face.key;
            let tets = tables.star(p).iter().map(|&t| t as usize);
            let has = |t: &usize| face.key.iter().all(|v| tables.tets[*t].contains(v));
            debug_assert!(tables.star(q).len() >= 3);
            findings.report(Violation::CrowdedFace {
                face: face.key.map(|v| case.place(v)),
                tets: tets.filter(has).collect(),
            });
        } else if face.tets == 2 && is_even(tables.inward(a)) == is_even(tables.inward(b)) {
            findings.report(Violation::SameSide {
                face: face.key.map(|v| case.place(v)),
                tets: [a.0 as usize, b.0 as usize],
            });
        }
    }
    let mut others = case.locator.around_boundary().iter().peekable();
    for (i, (_, face)) in tables.boundary().enumerate() {
        findings.counts.boundary_faces += 1;
        let own = face.sides[0].0 as usize;
        while let Some(&(_, other)) = others.next_if(|&&(query, _)| query as usize == i) {
            let tets = [own, other as usize];
            findings.report(Violation::Overlap { tets });
        }
    }
}

/// Whether the three are an even permutation of their sorted order.
fn is_even<T: Ord>([a, b, c]: [T; 3]) -> bool {
    let inversions = usize::from(a > b) + usize::from(a > c) + usize::from(b > c);
    inversions.is_multiple_of(2)
}
