//! The mesh covers a convex body: the outer boundary is convex at every edge and star-shaped.
//!
//! Let p be the centroid of a tetrahedron around which B, the boundary, winds once, and let p be on the inner side of
//! every face of the outer shell (which the code checks). A ray from p crosses the outer shell outwards only, as
//! often as that winds around p, which is once (cavities do not wind around p positively). So every ray crosses it
//! once, and it is star-shaped and embedded. An embedded closed surface that is locally convex at every edge bounds a
//! convex body (Tietze, Nakajima). O(n) exact signs.
//!
//! Rounded Steiner points on edges of the hull make dents. A vertex outside of a neighbouring face is accepted if it is
//! within the tolerance of its plane and if one of the four vertices is a Steiner point; this is counted.

use crate::mesh::VertexId;
use crate::verify::case::Case;
use crate::verify::claims::domain::shells::Shell;
use crate::verify::claims::domain::winding::Boundary;
use crate::verify::lookup::locate;
use crate::verify::lookup::tables::sort_by_edge;
use crate::verify::verdict::Findings;
use crate::verify::violation::Violation;

/// `outer`: the shells of positive volume, without those in voids of others.
pub(crate) fn check(case: &Case, outer: &[&Shell], boundary: &Boundary, findings: &mut Findings) {
    let centre = case.tables.tets[0];
    if boundary.winding(&centre) != Some(1) {
        let others = locate::around_first(case.points, case.tables);
        for &other in &others {
            findings.report(Violation::Overlap { tets: [0, other] });
        }
        let mut faces = outer.iter().flat_map(|shell| &shell.faces);
        if let Some(&f) = faces.next().filter(|_| others.is_empty()) {
            findings.report(Violation::HullNotConvex {
                face: case.tables.faces[f].key.map(|v| case.place(v)),
                apex: case.place(centre[0]),
            });
        }
    }
    let faces = outer.iter().map(|shell| shell.faces.len()).sum::<usize>();
    let mut around: Vec<([VertexId; 2], Flap)> = Vec::with_capacity(3 * faces);
    let near_centre = case.points.centroid(&centre);
    for &f in outer.iter().flat_map(|shell| &shell.faces) {
        let face = &case.tables.faces[f];
        let [a, b, c] = face.key;
        // The key is sorted; its tetrahedron is above it or below.
        let is_even = !face.first().is_below();
        let inward = if is_even { [a, b, c] } else { [a, c, b] };
        let side = case.points.side_of(inward, &centre, near_centre);
        if !side.is_positive() {
            findings.report(Violation::HullNotConvex {
                face: inward.map(|v| case.place(v)),
                apex: case.place(centre[0]),
            });
        }
        for (edge, apex, is_inward) in [
            ([a, b], c, is_even),
            ([b, c], a, is_even),
            ([a, c], b, !is_even),
        ] {
            around.push((edge, Flap { apex, is_inward }));
        }
    }
    sort_by_edge(&mut around, case.points.len());
    let mut ahead = around.iter().skip(AHEAD);
    for flaps in around.chunk_by(|x, y| x.0 == y.0) {
        for (edge, flap) in ahead.by_ref().take(flaps.len()) {
            case.points.prefetch(edge[1]);
            case.points.prefetch(flap.apex);
        }
        let edge = flaps[0].0;
        match *flaps {
            [(_, flap), (_, other)] => check_edge(case, edge, flap, other.apex, findings),
            _ => findings.report(Violation::HullNotManifold {
                edge: edge.map(|v| case.place(v)),
                faces: flaps.len(),
            }),
        }
    }
}

/// How far ahead of their use points are asked for.
const AHEAD: usize = 16;

/// A face at an edge ab, a < b.
#[derive(Clone, Copy)]
struct Flap {
    /// Its third vertex c.
    apex: VertexId,
    /// Whether the normal of abc points inwards.
    is_inward: bool,
}

fn check_edge(
    case: &Case,
    edge: [VertexId; 2],
    face: Flap,
    apex: VertexId,
    findings: &mut Findings,
) {
    let [a, b] = edge;
    let inward = match face.is_inward {
        true => [a, b, face.apex],
        false => [b, a, face.apex],
    };
    let [p, q, r] = inward;
    if !case.points.orient([p, q, r, apex]).is_negative() {
        return;
    }
    let steiner = inward
        .iter()
        .chain([&apex])
        .any(|&v| !case.input.is_site(v));
    if steiner && case.points.near_plane(inward, apex, case.tolerance) {
        findings.counts.hull_dents += 1;
    } else {
        findings.report(Violation::HullNotConvex {
            face: inward.map(|v| case.place(v)),
            apex: case.place(apex),
        });
    }
}
