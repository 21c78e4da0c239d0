//! Region attributes: constant up to constrained faces, and as the region points say.
//!
//! Only where mesh and PLC have any: without region points, programs number the parts as they like.

use crate::threads;
use crate::verify::case::Case;
use crate::verify::verdict::Findings;
use crate::verify::violation::Violation;

/// Fewer faces are one thread's work.
const FEW: usize = 1 << 16;

pub(crate) fn check(case: &Case, constrained: &[bool], findings: &mut Findings) {
    let attributes = &case.mesh.regions;
    if attributes.is_empty() || case.plc.regions.is_empty() {
        return;
    }
    let faces = &case.tables.faces;
    let leaks = threads::collect(faces.len(), FEW, |f, leaks| {
        let Some(sides) = faces[f].both().filter(|_| !constrained[f]) else {
            return;
        };
        let tets = sides.map(|side| side.tet());
        let found = tets.map(|t| attributes[t]);
        if found[0] != found[1] {
            leaks.push((tets, found));
        }
    });
    for (tets, attributes) in leaks {
        findings.report(Violation::RegionLeaks { tets, attributes });
    }
    for (i, (region, &point)) in case.plc.regions.iter().zip(&case.input.regions).enumerate() {
        // A point on a face between two regions names either.
        let around = case.locator.containing(point);
        let Some(&tet) = around.first() else { continue };
        findings.counts.regions += 1;
        if around.iter().all(|&t| attributes[t] != region.attribute) {
            findings.report(Violation::WrongRegion {
                region: i,
                tet,
                expected: region.attribute,
                found: attributes[tet],
            });
        }
    }
}
