//! The boundary of the mesh does not cross itself, where its faces are not exactly on facets.
//!
//! Faces that are exactly on facets do not cross each other, as facets intersect in common segments and vertices only
//! (where facets overlap in one plane, their faces do not overlap: [`super::facets`]). A Steiner point within the
//! tolerance of its facet, or a facet that is not exactly flat, may be nearer to another facet than that. So each
//! such face of the boundary is compared with all faces of the boundary near it, exactly: two triangles without a
//! common edge meet beyond their common vertex iff an edge of one meets the other, where edge and triangle have no
//! common vertex. Two with a common edge are sorted around it ([`super::domain::shells`]).
//!
//! Together with [`super::adjacency`] this means that no two tetrahedra overlap, whatever the tolerance is.

use crate::mesh::VertexId;
use crate::number::Sign;
use crate::threads;
use crate::verify::case::Case;
use crate::verify::claims::facets::covering::Cover;
use crate::verify::lookup::boxes::Boxes;
use crate::verify::signs::points::Points;
use crate::verify::verdict::Findings;
use crate::verify::violation::Violation;

/// Fewer faces are one thread's work.
const FEW: usize = 1 << 10;

pub(crate) fn check(case: &Case, cover: &Cover, findings: &mut Findings) {
    if case.tolerance == 0.0 && !cover.has_uneven() {
        return;
    }
    let faces: Vec<usize> = case.tables.boundary().map(|(f, _)| f).collect();
    let is_suspect = |&f: &usize| {
        let mut vertices = case.tables.faces[f].key.into_iter();
        // A boundary face on no facet is either on a star-shaped hull or a violation by itself.
        let steiner = case.tolerance > 0.0 && vertices.any(|v| !case.input.is_site(v));
        cover.constrained[f] && (steiner || cover.is_uneven(f))
    };
    let suspects: Vec<bool> = faces.iter().map(is_suspect).collect();
    let asked: Vec<usize> = (0..faces.len()).filter(|&i| suspects[i]).collect();
    findings.counts.faces_compared = asked.len();
    if asked.is_empty() {
        return;
    }
    let key = |i: usize| case.tables.faces[faces[i]].key;
    // The faces on one group of facets are projected one to one onto it, and do not cross each other.
    let is_of_other = |i: usize, j: usize| {
        let [own, other] = [i, j].map(|i| cover.first_facet_at(faces[i]));
        own.is_none() || own != other
    };
    let tree = Boxes::new(
        (0..faces.len())
            .map(|i| case.points.bounds(&key(i)))
            .collect(),
    );
    let parts = threads::in_parts(asked.len(), FEW, |range| {
        let (mut crossing, mut near) = (Vec::new(), Vec::new());
        for &i in &asked[range] {
            tree.meeting(i, &mut near);
            near.sort_unstable();
            let others = near.iter().map(|&j| j as usize);
            let others = others.filter(|&j| (j > i || !suspects[j]) && is_of_other(i, j));
            crossing.extend(
                others
                    .filter(|&j| cross(case.points, key(i), key(j)))
                    .map(|j| [i, j]),
            );
        }
        crossing
    });
    for pair in parts.into_iter().flatten() {
        findings.report(Violation::BoundaryCrosses {
            faces: pair.map(|i| key(i).map(|v| case.place(v))),
            tets: pair.map(|i| case.tables.faces[faces[i]].first().tet()),
        });
    }
}

/// Whether two triangles without a common edge meet beyond their common vertex, if they have one.
fn cross(points: &Points, t: [VertexId; 3], u: [VertexId; 3]) -> bool {
    let common = t.iter().filter(|v| u.contains(v)).count();
    if common > 1 || are_apart(points, t, u) || are_apart(points, u, t) {
        return false;
    }
    let edges = |[a, b, c]: [VertexId; 3]| [[a, b], [b, c], [a, c]];
    let meets = |t: [VertexId; 3], u: [VertexId; 3]| {
        let mut free = edges(t)
            .into_iter()
            .filter(|e| !e.iter().any(|v| u.contains(v)));
        free.any(|edge| pierces(points, edge, u))
    };
    meets(t, u) || meets(u, t)
}

/// Whether one triangle is on one side of the plane of the other, and touches this in a common vertex at most.
fn are_apart(points: &Points, t: [VertexId; 3], u: [VertexId; 3]) -> bool {
    let [a, b, c] = t;
    let others = u.into_iter().filter(|v| !t.contains(v));
    let mut sides = others.map(|v| points.orient([a, b, c, v]));
    let Some(first) = sides.next().filter(|s| !s.is_zero()) else {
        return false;
    };
    sides.all(|s| s == first)
}

/// Whether a closed segment and a closed triangle meet.
fn pierces(points: &Points, [p, q]: [VertexId; 2], [a, b, c]: [VertexId; 3]) -> bool {
    let sides = [p, q].map(|v| points.orient([a, b, c, v]));
    match sides {
        [Sign::Zero, Sign::Zero] => return meet_in_plane(points, [p, q], [a, b, c]),
        [s, t] if s == t => return false,
        _ => {}
    }
    let turns = [[a, b], [b, c], [c, a]].map(|[v, w]| points.orient([p, q, v, w]));
    !(turns.contains(&Sign::Positive) && turns.contains(&Sign::Negative))
}

/// The same for a segment in the plane of the triangle: separated by a line through an edge of the triangle, or by that
/// of the segment, or not at all.
fn meet_in_plane(points: &Points, [p, q]: [VertexId; 2], [a, b, c]: [VertexId; 3]) -> bool {
    let axes = [[0, 1], [1, 2], [2, 0]];
    let Some(axes) = axes
        .into_iter()
        .find(|&axes| !points.orient2d(axes, [a, b, c]).is_zero())
    else {
        return false;
    };
    let side = |v, w, x| points.orient2d(axes, [v, w, x]);
    let inner = side(a, b, c);
    let mut edges = [[a, b], [b, c], [c, a]].into_iter();
    let is_outside = |s: Sign| !s.is_zero() && s != inner;
    if edges.any(|[v, w]| is_outside(side(v, w, p)) && is_outside(side(v, w, q))) {
        return false;
    }
    let sides = [a, b, c].map(|v| side(p, q, v));
    sides.contains(&Sign::Zero) || !sides.iter().all(|&s| s == sides[0])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn crosses(t: [[f64; 3]; 3], u: [[f64; 3]; 3], common: usize) -> bool {
        let points = Points::new([t, u].concat());
        let [d, e, f] = [3, 4, 5].map(VertexId);
        let u = [[d, e, f], [VertexId(0), e, f]][common];
        let found = cross(&points, [0, 1, 2].map(VertexId), u);
        assert_eq!(found, cross(&points, u, [0, 1, 2].map(VertexId)));
        found
    }

    #[test]
    fn triangles_cross_or_not() {
        let flat = [[0., 0., 0.], [4., 0., 0.], [0., 4., 0.]];
        let through = [[1., 1., -1.], [1., 1., 1.], [9., 9., 1.]];
        assert!(crosses(flat, through, 0));
        assert!(!crosses(
            flat,
            through.map(|[x, y, z]| [x + 2., y + 2., z]),
            0
        ));
        assert!(!crosses(flat, through.map(|[x, y, z]| [x, y, z + 1.5]), 0));
        // Touching is meeting.
        assert!(crosses(flat, through.map(|[x, y, z]| [x, y, z + 1.]), 0));
        // From a common vertex down through the triangle, or beside it.
        assert!(crosses(flat, [[0.; 3], [2., 1., 1.], [2., 1., -1.]], 1));
        assert!(!crosses(flat, [[0.; 3], [2., -1., 1.], [2., -1., -1.]], 1));
        // In one plane: apart, overlapping, one inside the other, with a common vertex.
        assert!(!crosses(
            flat,
            [[3., 3., 0.], [5., 3., 0.], [3., 5., 0.]],
            0
        ));
        assert!(crosses(flat, [[1., 1., 0.], [5., 3., 0.], [3., 5., 0.]], 0));
        assert!(crosses(flat, [[1., 1., 0.], [1., 2., 0.], [2., 1., 0.]], 0));
        assert!(!crosses(flat, [[0.; 3], [-1., 2., 0.], [-2., 1., 0.]], 1));
        assert!(crosses(flat, [[0.; 3], [1., 9., 0.], [9., 1., 0.]], 1));
    }
}
