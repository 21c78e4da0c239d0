//! The tetrahedra fill the domain, neither more nor less.
//!
//! *Inside*: every boundary face covers a facet, so that nothing ends but at a facet; every bounded component of the
//! empty space ([`super::shells`]) holds a hole point, and no hole point is in a tetrahedron. The facets outside the domain
//! count as walls of the empty space, so that a closed chamber without tetrahedra is found, too.
//!
//! *Hull*: the outer boundary is convex ([`super::hull`]) and all of the input is in the mesh; voids are as above, but a
//! hole point may be meshed, as there are two opinions on what a hole is in a mesh that keeps its convex hull.
//!
//! In both cases the volumes of the tetrahedra add up to the volume that the boundary encloses. Six times the volume of a
//! tetrahedron is the sum of the cones from the origin over its four faces, and the cones over a face from both sides
//! cancel. So this follows where every face has at most two tetrahedra, on opposite sides ([`super::adjacency`]), and
//! is checked where that does not hold.

use super::facets::Cover;
use super::segments::{self, Fate};
use super::shells::{Shell, Shells};
use super::sums::Cones;
use super::{Case, Domain, Findings, Violation, hull};
use crate::number::{Dyadic, Exact, Number, Sign};
use std::cmp::Ordering;

pub(super) fn check(case: &Case, fates: &[Fate], cover: &Cover, findings: &mut Findings) {
    volume(case, findings);
    let found = Shells::new(case, &cover.outside);
    for edge in &found.contradictions {
        findings.report(Violation::BoundaryNotEmbedded {
            edge: edge.map(|v| case.place(v)),
        });
    }
    let with = |sign| {
        found
            .shells
            .iter()
            .filter(move |s| s.volume.exact_sign() == sign)
            .collect::<Vec<&Shell>>()
    };
    let (outer, voids) = (with(Sign::Positive), with(Sign::Negative));
    let is_hull = match case.options.domain {
        Domain::Hull => true,
        Domain::Inside => false,
        Domain::Auto => {
            let open = case.tables.boundary().any(|(f, _)| !cover.constrained[f]);
            let mut holes = case.input.holes.iter();
            let mut trial = findings.trial();
            (open || holes.any(|&h| !case.locator.containing(h).is_empty())) && {
                hull::check(case, &outer, &mut trial);
                trial.is_empty()
            }
        }
    };
    findings.counts.domain = if is_hull {
        Domain::Hull
    } else {
        Domain::Inside
    };
    if is_hull {
        hull::check(case, &outer, findings);
        all_input_is_meshed(case, fates, cover, findings);
    } else {
        boundary_on_facets(case, cover, &outer, findings);
    }
    boundary_on_facets(case, cover, &voids, findings);
    holes(case, &voids, is_hull, findings);
}

fn volume(case: &Case, findings: &mut Findings) {
    // The inward normal makes the cone over a face negative.
    let mut boundary = Cones::new();
    for (_, face) in case.tables.boundary() {
        let [a, b, c] = case.tables.inward(face.sides[0]);
        boundary.add(case.points, [a, c, b]);
    }
    let boundary = boundary.volume();
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
            tet: face.sides[0].0 as usize,
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

/// Every void holds a hole point, and no hole point is meshed. A hole point is in the innermost of the voids around it,
/// since nested shells have decreasing volumes.
fn holes(case: &Case, voids: &[&Shell], is_hull: bool, findings: &mut Findings) {
    let mut has_hole = vec![false; voids.len()];
    for (h, &hole) in case.input.holes.iter().enumerate() {
        if let Some(&tet) = case.locator.containing(hole).first() {
            if is_hull {
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
