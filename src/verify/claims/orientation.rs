//! Every tetrahedron has a positive volume, det[b−a, c−a, d−a] > 0. A mesh all of whose tetrahedra are negative follows
//! the other convention, and is read as its mirror image in the order of vertices.

use crate::mesh::VertexId;
use crate::number::Sign;
use crate::threads;
use crate::verify::place::Place;
use crate::verify::signs::points::Points;
use crate::verify::verdict::Findings;
use crate::verify::violation::Violation;
use std::borrow::Cow;

/// Fewer tetrahedra are one thread's work.
const FEW: usize = 1 << 14;

/// How far ahead of their use points are asked for.
const AHEAD: usize = 6;

/// Checks the signs, and turns the tetrahedra of a mesh with the other convention.
pub(crate) fn check<'a>(
    points: &Points,
    tets: &'a [[VertexId; 4]],
    findings: &mut Findings,
) -> Cow<'a, [[VertexId; 4]]> {
    let mut tets = Cow::Borrowed(tets);
    let parts = threads::in_parts(tets.len(), FEW, |range| {
        // Negative, zero, positive; and those that rounding spoils.
        let mut counts = [0; 4];
        for t in range {
            if let Some(ahead) = tets.get(t + AHEAD) {
                ahead[1..].iter().for_each(|&v| points.prefetch(v));
            }
            let tet = tets[t];
            let sign = points.orient(tet);
            counts[match sign {
                Sign::Negative => 0,
                Sign::Zero => 1,
                Sign::Positive => 2,
            }] += 1;
            if !points.are_doubles() {
                let rounded = points.orient_rounded(tet);
                counts[3] += usize::from(rounded.is_some_and(|s| s != sign));
            }
        }
        counts
    });
    let sum = |i: usize| parts.iter().map(|counts| counts[i]).sum::<usize>();
    let [negative, flat, positive, spoilt] = [0, 1, 2, 3].map(sum);
    findings.counts.spoilt_by_rounding = spoilt;
    if positive == 0 && negative > 0 {
        findings.counts.turned = true;
        tets.to_mut().iter_mut().for_each(|t| t.swap(2, 3));
    }
    let wrong = if findings.counts.turned { 0 } else { negative };
    if wrong + flat > 0 {
        for (t, &tet) in tets.iter().enumerate() {
            let sign = points.orient(tet);
            if !sign.is_positive() {
                findings.report(Violation::Orientation {
                    tet: t,
                    flat: sign.is_zero(),
                    vertices: tet.map(|id| Place {
                        id,
                        at: points.at(id),
                    }),
                });
            }
        }
    }
    tets
}
