//! The faces that the mesh lists are those on facets, each with a marker of one of its facets.
//!
//! Every face that covers a facet must be listed, if any face is; a face of the boundary that is on no facet may be,
//! where the mesh fills the convex hull. Where a facet is flat only to rounding, more than one surface of faces may
//! cover it ([`super::facets`]): a listed face of any of them is on the facet. Facets that were merged have equal
//! markers; where facets overlap or are equal, a face has the marker of one of them. Where the input has no marker (0),
//! other programs write 1 or −1, which is counted.
//!
//! How the listed vertices turn is not judged but counted: a face of the boundary should be counterclockwise for one
//! who looks from outside, and a face between two regions for one who looks from the one with the larger attribute.

use crate::mesh::VertexId;
use crate::verify::case::Case;
use crate::verify::claims::facets::covering::Cover;
use crate::verify::claims::listed::Listed;
use crate::verify::options::Domain;
use crate::verify::verdict::Findings;
use crate::verify::violation::Violation;

/// The marker of faces without one: ours, and what other programs write instead.
const NONE: i64 = 0;
const INSTEAD: [i64; 2] = [1, -1];

/// `findings` know the domain already.
pub(crate) fn check(case: &Case, listed: &Listed, cover: &Cover, findings: &mut Findings) {
    if case.mesh.faces.is_empty() {
        return;
    }
    let is_hull = findings.counts.domain == Domain::Hull;
    let mut is_listed = vec![false; cover.constrained.len()];
    for (index, (face, f)) in case.mesh.faces.iter().zip(&listed.places).enumerate() {
        let Some(f) = *f else { continue };
        is_listed[f] = true;
        turn(case, f, face.vertices, findings);
        let known = &case.tables.faces[f];
        if cover
            .first_facet_at(f)
            .is_some_and(|facet| case.plc.facets[facet].marker == face.marker)
        {
            findings.counts.markers += 1;
            continue;
        }
        let mut expected = Vec::new();
        if cover.constrained[f] {
            for facet in cover.facets_at(f) {
                expected.extend(case.input.markers_of(case.plc, facet));
            }
        } else if let Some(facet) = cover.facet_of(f) {
            expected.extend(case.input.markers_of(case.plc, facet));
        } else if !known.is_shared() {
            // Where the hull is not kept, the claim on the domain reports the face.
            expected.push(if is_hull { NONE } else { face.marker });
        } else {
            findings.report(Violation::ListedNotOnFacet {
                index,
                face: face.vertices.map(|v| case.place(v)),
            });
            continue;
        }
        if expected.contains(&face.marker) {
            findings.counts.markers += 1;
        } else if expected.contains(&NONE) && INSTEAD.contains(&face.marker) {
            findings.counts.markers_instead += 1;
        } else {
            expected.sort_unstable();
            expected.dedup();
            findings.report(Violation::WrongMarker {
                index,
                face: face.vertices.map(|v| case.place(v)),
                marker: face.marker,
                expected,
            });
        }
    }
    for f in (0..is_listed.len()).filter(|&f| cover.constrained[f] && !is_listed[f]) {
        findings.report(Violation::FaceNotListed {
            face: case.tables.faces[f].key.map(|v| case.place(v)),
            facet: cover.facets_at(f).next().expect("a face on a facet"),
        });
    }
}

/// Counts faces of the boundary, and those that turn the wrong way.
fn turn(case: &Case, f: usize, vertices: [VertexId; 3], findings: &mut Findings) {
    let face = &case.tables.faces[f];
    if face.is_shared() {
        return;
    }
    // The normal of an even permutation of the key points away from a tetrahedron below.
    let [a, b, c] = face.key;
    let is_even = [[a, b, c], [b, c, a], [c, a, b]].contains(&vertices);
    let is_outward = is_even == face.first().is_below();
    findings.counts.faces_turned += 1;
    findings.counts.faces_inward += usize::from(!is_outward);
}
