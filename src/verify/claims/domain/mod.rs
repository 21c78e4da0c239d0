//! The tetrahedra fill the domain, neither more nor less.
//!
//! *Inside*: every boundary face covers a facet, so that nothing ends but at a facet; every bounded component of the
//! empty space ([`shells`]) holds a hole point, and no hole point is in a tetrahedron. The facets outside the domain
//! count as walls of the empty space, so that a closed chamber without tetrahedra is found, too.
//!
//! *Hull*: the outer boundary is convex ([`hull`]) and all of the input is in the mesh; voids are as above, and so is
//! what is in them, but if the hull was asked for a hole point may be meshed, as there are two opinions on what a hole
//! is in a mesh that keeps its convex hull.
//!
//! If nothing was asked for, the inside is expected, unless there is none: if every tetrahedron is reached from outside
//! without crossing a facet.
//!
//! In both cases the volumes of the tetrahedra add up to the volume that the boundary encloses. Six times the volume
//! of a tetrahedron is the sum of the cones from the origin over its four faces, and the cones over a face from both
//! sides cancel. So this follows where every face has at most two tetrahedra, on opposite sides
//! ([`super::adjacency`]), and is checked where that does not hold.

mod hull;
pub(crate) mod shells;
mod winding;

use crate::mesh::VertexId;
use crate::number::{Dyadic, Exact, Number, Sign};
use crate::verify::case::Case;
use crate::verify::claims::adjacency;
use crate::verify::claims::domain::shells::{Shell, Shells};
use crate::verify::claims::domain::winding::Boundary;
use crate::verify::claims::facets::covering::Cover;
use crate::verify::claims::segments::{self, Fate};
use crate::verify::lookup::tables::INWARD;
use crate::verify::options::Domain;
use crate::verify::verdict::Findings;
use crate::verify::violation::Violation;
use std::cmp::Ordering;

pub(crate) fn check(case: &Case, fates: &[Fate], cover: &Cover, findings: &mut Findings) {
    let found = Shells::new(case, &cover.outside);
    volume(case, &found, findings);
    for edge in &found.contradictions {
        findings.report(Violation::BoundaryNotEmbedded {
            edge: edge.map(|v| case.place(v)),
        });
    }
    if findings.is_manifold() {
        no_overlaps(case, &found, findings);
    }
    let with = |sign| {
        found
            .shells
            .iter()
            .filter(move |s| s.volume.exact_sign() == sign)
            .collect::<Vec<&Shell>>()
    };
    let (outer, voids) = (with(Sign::Positive), with(Sign::Negative));
    // A surface that is embedded bounds a solid or a void. Only sheets of facets, which are no faces of tetrahedra,
    // have the volume zero; of a shell with faces nothing that follows would be asked.
    for shell in with(Sign::Zero) {
        if let Some(&f) = shell.faces.first() {
            findings.report(Violation::BoundaryWithoutVolume {
                face: case.tables.faces[f].key.map(|v| case.place(v)),
            });
        }
    }
    let hull = |findings: &mut Findings| {
        // What is in voids of the largest is no part of the hull, and ends at facets.
        let (islands, bodies) = islands(case, &outer);
        let faces = bodies.iter().flat_map(|shell| shell.faces.iter().copied());
        let boundary = Boundary::new(case, faces.collect(), 1);
        hull::check(case, &bodies, &boundary, findings);
        boundary_on_facets(case, cover, &islands, findings);
    };
    let is_hull = match case.options.domain {
        Domain::Hull => true,
        Domain::Inside => false,
        Domain::Auto => {
            let is_open = case.plc.facets.is_empty()
                || case.tables.boundary().any(|(f, _)| !cover.constrained[f]);
            let mut trial = findings.trial();
            is_open && {
                hull(&mut trial);
                findings.counts.fills_hull = trial.is_empty();
                trial.is_empty() && enclose_nothing(case, cover)
            }
        }
    };
    findings.counts.domain = if is_hull {
        Domain::Hull
    } else {
        Domain::Inside
    };
    if is_hull {
        hull(findings);
        all_input_is_meshed(case, fates, cover, findings);
    } else {
        boundary_on_facets(case, cover, &outer, findings);
    }
    boundary_on_facets(case, cover, &voids, findings);
    holes(case, &voids, case.options.domain == Domain::Hull, findings);
}

/// Whether all tetrahedra are reached from faces of the boundary that are on no facet, without crossing a facet.
fn enclose_nothing(case: &Case, cover: &Cover) -> bool {
    if case.plc.facets.is_empty() {
        return true;
    }
    let tables = case.tables;
    let open = tables.boundary().filter(|(f, _)| !cover.constrained[*f]);
    let mut stack: Vec<usize> = open.map(|(_, face)| face.first().tet()).collect();
    if stack.is_empty() {
        return false;
    }
    let mut reached = vec![false; tables.tets.len()];
    let mut count = 0;
    while let Some(t) = stack.pop() {
        if std::mem::replace(&mut reached[t], true) {
            continue;
        }
        count += 1;
        for corners in INWARD {
            let face = tables.find_face(corners.map(|k| tables.tets[t][k]));
            let f = face.expect("the face of a tetrahedron");
            if let Some(sides) = tables.faces[f].both().filter(|_| !cover.constrained[f]) {
                stack.extend(sides.map(|side| side.tet()));
            }
        }
    }
    count == tables.tets.len()
}

/// The shells of positive volume: those all of whose vertices are on the largest one or inside; and it and the others.
///
/// Where the largest is convex, which is asked next, an island is thus in the hull, where only faces on facets are,
/// which do not cross each other. A vertex on the surface of the largest that is none of its vertices may count as
/// outside: what the tetrahedra of a hull do not match is no island.
fn islands<'s>(case: &Case, outer: &[&'s Shell]) -> (Vec<&'s Shell>, Vec<&'s Shell>) {
    let smaller = |s: &Shell, t: &Shell| (t.volume.clone() - &s.volume).exact_sign().is_positive();
    let shells = outer.iter().copied();
    let Some(largest) = shells.reduce(|s, t| if smaller(s, t) { t } else { s }) else {
        return (Vec::new(), Vec::new());
    };
    if outer.len() == 1 {
        return (Vec::new(), outer.to_vec());
    }
    let on_largest = vertices_of(largest);
    let others = outer.iter().filter(|shell| !std::ptr::eq(**shell, largest));
    let questions = others.map(|shell| shell.triangles.len()).sum();
    let hull = Boundary::new(case, largest.faces.clone(), questions);
    outer.iter().copied().partition(|shell| {
        let is_in_hull =
            |v: &VertexId| on_largest.binary_search(v).is_ok() || hull.winding(&[*v]) == Some(1);
        !std::ptr::eq(*shell, largest) && vertices_of(shell).iter().all(is_in_hull)
    })
}

/// The vertices of a shell in ascending order.
fn vertices_of(shell: &Shell) -> Vec<VertexId> {
    let mut vertices: Vec<VertexId> = shell.triangles.iter().flatten().copied().collect();
    vertices.sort_unstable();
    vertices.dedup();
    vertices
}

/// Outside of each shell there is no tetrahedron ([`super::adjacency`]).
fn no_overlaps(case: &Case, found: &Shells, findings: &mut Findings) {
    let all = case.tables.boundary().map(|(f, _)| f);
    let boundary = Boundary::new(case, all.collect(), found.shells.len());
    for shell in found.shells.iter().filter(|s| !s.faces.is_empty()) {
        let winding = shell.faces.iter().find_map(|&f| boundary.outside(f));
        if winding != Some(0) {
            adjacency::overlaps(case, &shell.faces, findings);
        }
    }
}

fn volume(case: &Case, found: &Shells, findings: &mut Findings) {
    // Every boundary face has its outer side in one shell, and the two sides of other walls cancel.
    let volumes = found.shells.iter().map(|shell| &shell.volume);
    let boundary = volumes.fold(Dyadic::ZERO, |sum, volume| sum + volume);
    if findings.is_manifold() {
        findings.counts.volume = boundary.to_f64() / 6.0;
        return;
    }
    let tets = case
        .tables
        .tets
        .iter()
        .fold(Dyadic::ZERO, |sum, &t| sum + &case.points.volume(t));
    findings.counts.volume = tets.to_f64() / 6.0;
    if tets != boundary {
        findings.report(Violation::Volume {
            tets: tets.to_f64() / 6.0,
            boundary: boundary.to_f64() / 6.0,
        });
    }
}

fn boundary_on_facets(case: &Case, cover: &Cover, shells: &[&Shell], findings: &mut Findings) {
    for &f in shells
        .iter()
        .flat_map(|shell| &shell.faces)
        .filter(|&&f| !cover.constrained[f])
    {
        let face = &case.tables.faces[f];
        findings.report(Violation::BoundaryNotOnFacet {
            face: face.key.map(|v| case.place(v)),
            tet: face.first().tet(),
        });
    }
}

/// Nothing of the input is outside the convex hull.
fn all_input_is_meshed(case: &Case, fates: &[Fate], cover: &Cover, findings: &mut Findings) {
    let mut seen = vec![false; case.input.is_site.len()];
    for (i, &site) in case.input.site_of.iter().enumerate() {
        if !std::mem::replace(&mut seen[site.index()], true)
            && !case.tables.is_used(site)
            && case.locator.containing(site).is_empty()
        {
            findings.report(Violation::MissingVertex {
                vertex: case.named(i, site),
                tet: None,
            });
        }
    }
    for (e, _) in fates
        .iter()
        .enumerate()
        .filter(|(_, fate)| **fate == Fate::Outside)
    {
        segments::report(case, e, findings);
    }
    for part in &cover.outside {
        let [a, b, _] = part.frame;
        findings.report(Violation::FacetNotCovered {
            facets: vec![part.facet],
            edge: [a, b].map(|v| case.place(v)),
            faces: 0,
            expected: 1,
        });
    }
}

/// Every void holds a hole point, and no hole point is meshed, unless the hull was asked for. A hole point is in the
/// innermost of the voids around it, since nested shells have decreasing volumes.
fn holes(case: &Case, voids: &[&Shell], may_be_meshed: bool, findings: &mut Findings) {
    let mut has_hole = vec![false; voids.len()];
    for (h, &hole) in case.input.holes.iter().enumerate() {
        if let Some(&tet) = case.locator.containing(hole).first() {
            if may_be_meshed {
                findings.counts.holes_meshed += 1;
            } else {
                findings.report(Violation::HoleMeshed {
                    hole: h,
                    at: case.points.at(hole),
                    tet,
                });
            }
            continue;
        }
        let around = (0..voids.len()).filter(|&i| voids[i].surrounds(case, hole));
        let smaller = |&i: &usize, &j: &usize| match (voids[i].volume.clone() - &voids[j].volume)
            .exact_sign()
        {
            // Volumes of voids are negative.
            Sign::Positive => Ordering::Less,
            Sign::Negative => Ordering::Greater,
            Sign::Zero => Ordering::Equal,
        };
        if let Some(innermost) = around.min_by(smaller) {
            has_hole[innermost] = true;
        }
    }
    findings.counts.voids = voids.len();
    for (void, _) in voids.iter().zip(has_hole).filter(|(_, has_hole)| !has_hole) {
        findings.report(Violation::MissingPart {
            volume: -void.volume.to_f64() / 6.0,
            faces: void.walls,
            at: case.place(void.triangles[0][0]),
        });
    }
}
