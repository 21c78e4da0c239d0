//! Region attributes: constant up to constrained faces, and as the region points say.
//!
//! Only where mesh and PLC have any: without region points, programs number the parts as they like.

use crate::threads;
use crate::verify::case::Case;
use crate::verify::verdict::Findings;
use crate::verify::violation::Violation;

/// Fewer faces are one thread's work.
const FEW: usize = 1 << 16;

/// Two tetrahedra with different attributes on both sides of a face that covers no facet.
pub(crate) type Leak = ([usize; 2], [f64; 2]);

/// Whether regions are compared.
fn are_known(case: &Case) -> bool {
    !case.mesh.regions.is_empty() && !case.plc.regions.is_empty()
}

/// Whether a face has different attributes on its sides, so that it has to be on a facet.
pub(crate) fn separates(case: &Case, f: usize) -> bool {
    are_known(case) && leak(case, f).is_some()
}

fn leak(case: &Case, f: usize) -> Option<Leak> {
    let tets = case.tables.faces[f].both()?.map(|side| side.tet());
    let found = tets.map(|t| case.mesh.regions[t]);
    (found[0] != found[1]).then_some((tets, found))
}

/// The faces that separate attributes without being `constrained`.
pub(crate) fn leaks(case: &Case, constrained: &[bool]) -> Vec<Leak> {
    if !are_known(case) {
        return Vec::new();
    }
    threads::collect(constrained.len(), FEW, |f, leaks| {
        if !constrained[f] {
            leaks.extend(leak(case, f));
        }
    })
}

/// `leaks` are those of the faces that were found to cover the facets.
pub(crate) fn check(case: &Case, leaks: &[Leak], findings: &mut Findings) {
    let attributes = &case.mesh.regions;
    if !are_known(case) {
        return;
    }
    for &(tets, attributes) in leaks {
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
