//! Every tetrahedron has a positive volume, det[b−a, c−a, d−a] > 0. A mesh all of whose tetrahedra are negative follows
//! the other convention, and is read as its mirror image in the order of vertices.

use super::points::Points;
use super::{Findings, Place, Violation};
use crate::mesh::VertexId;
use crate::number::Sign;

/// Checks the signs, and turns the tetrahedra of a mesh with the other convention.
pub(super) fn check(points: &Points, tets: &mut [[VertexId; 4]], findings: &mut Findings) {
    let signs: Vec<Sign> = tets.iter().map(|&t| points.orient(t)).collect();
    let spoilt =
        |t: &[VertexId; 4], sign: Sign| points.orient_rounded(*t).is_some_and(|s| s != sign);
    findings.counts.spoilt_by_rounding = tets
        .iter()
        .zip(&signs)
        .filter(|(t, s)| spoilt(t, **s))
        .count();
    findings.counts.tets = tets.len();
    if !signs.contains(&Sign::Positive) && signs.contains(&Sign::Negative) {
        findings.counts.turned = true;
        for t in tets.iter_mut() {
            t.swap(2, 3);
        }
    }
    let wrong = if findings.counts.turned {
        Sign::Positive
    } else {
        Sign::Negative
    };
    for (t, &sign) in signs.iter().enumerate() {
        if sign == wrong || sign.is_zero() {
            findings.report(Violation::Orientation {
                tet: t,
                flat: sign.is_zero(),
                vertices: tets[t].map(|id| Place {
                    id,
                    at: points.at(id),
                }),
            });
        }
    }
}
