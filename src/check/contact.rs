//! Whether two closed simplices without a common vertex have a common point: vertices, edges and triangles of two
//! facets, in exact arithmetic.
//!
//! Orientations are filtered doubles with exact fallback. What lies in one plane is decided in a projection along a
//! coordinate axis, which is exact, too.

use crate::number::Sign;
use crate::plc::{in_box, on_segment, orient2d, orient3d};

pub(super) type Point = [f64; 3];
type Edge = [Point; 2];
type Triangle = [Point; 3];

/// The coordinates that are left without `axis`.
fn drop(axis: usize, p: Point) -> [f64; 2] {
    [p[(axis + 1) % 3], p[(axis + 2) % 3]]
}

/// A coordinate axis along which three points do not become collinear; `None` if they are.
fn axis_of([a, b, c]: Triangle) -> Option<usize> {
    (0..3).find(|&k| !orient2d(drop(k, a), drop(k, b), drop(k, c)).is_zero())
}

/// Whether a point is on an edge.
pub(super) fn point_on_edge(p: Point, [a, b]: Edge) -> bool {
    // The box in space is the intersection of those in the projections.
    (0..3).all(|k| on_segment(drop(k, p), drop(k, a), drop(k, b)))
}

/// Whether a point is on a triangle that is not degenerate.
pub(super) fn point_on_triangle(p: Point, t: Triangle) -> bool {
    let [a, b, c] = t;
    orient3d([a, b, c, p]).is_zero() && point_in_plane_triangle(p, t)
}

/// The same for a point in the triangle's plane.
fn point_in_plane_triangle(p: Point, t: Triangle) -> bool {
    if boxes_are_apart(&[p], &t) {
        return false;
    }
    let axis = axis_of(t).expect("a triangle is not degenerate");
    let at = drop(axis, p);
    let [a, b, c] = t.map(|v| drop(axis, v));
    same_side([orient2d(a, b, at), orient2d(b, c, at), orient2d(c, a, at)])
}

/// Whether no two of the signs are opposite.
fn same_side(signs: [Sign; 3]) -> bool {
    !(signs.contains(&Sign::Positive) && signs.contains(&Sign::Negative))
}

/// Whether two edges have a common point.
pub(super) fn edges_meet([a, b]: Edge, [c, d]: Edge) -> bool {
    orient3d([a, b, c, d]).is_zero() && plane_edges_meet([a, b], [c, d])
}

/// Whether the bounding boxes of two simplices have no common point, which is quickly seen.
fn boxes_are_apart(s: &[Point], t: &[Point]) -> bool {
    let range = |points: &[Point], k: usize| {
        let coordinates = points.iter().map(|p| p[k]);
        let low = coordinates.clone().fold(f64::INFINITY, f64::min);
        (low, coordinates.fold(f64::NEG_INFINITY, f64::max))
    };
    (0..3).any(|k| {
        let ((low, high), (least, most)) = (range(s, k), range(t, k));
        high < least || most < low
    })
}

/// The same for edges in one plane.
fn plane_edges_meet([a, b]: Edge, [c, d]: Edge) -> bool {
    if boxes_are_apart(&[a, b], &[c, d]) {
        return false;
    }
    match axis_of([a, b, c]).or_else(|| axis_of([a, b, d])) {
        Some(axis) => flat_edges_meet([a, b].map(|p| drop(axis, p)), [c, d].map(|p| drop(axis, p))),
        // All on one line.
        None => [c, d].iter().any(|&p| point_on_edge(p, [a, b])) || point_on_edge(a, [c, d]),
    }
}

fn flat_edges_meet([a, b]: [[f64; 2]; 2], [c, d]: [[f64; 2]; 2]) -> bool {
    let signs = [
        orient2d(c, d, a),
        orient2d(c, d, b),
        orient2d(a, b, c),
        orient2d(a, b, d),
    ];
    let on = |sign: Sign, p, q, r| sign.is_zero() && in_box(p, q, r);
    let opposite = |s: Sign, t: Sign| (s * t).is_negative();
    on(signs[0], a, c, d)
        || on(signs[1], b, c, d)
        || on(signs[2], c, a, b)
        || on(signs[3], d, a, b)
        || opposite(signs[0], signs[1]) && opposite(signs[2], signs[3])
}

/// Whether an edge and a triangle that is not degenerate have a common point.
pub(super) fn edge_meets_triangle([p, q]: Edge, t: Triangle) -> bool {
    let [a, b, c] = t;
    let sides = [p, q].map(|e| orient3d([a, b, c, e]));
    if (sides[0] * sides[1]).is_positive() {
        return false;
    }
    match sides.map(Sign::is_zero) {
        [true, true] => {
            [p, q].iter().any(|&e| point_in_plane_triangle(e, t))
                || [[a, b], [b, c], [c, a]]
                    .iter()
                    .any(|&side| plane_edges_meet([p, q], side))
        }
        [true, false] => point_in_plane_triangle(p, t),
        [false, true] => point_in_plane_triangle(q, t),
        // The line pq passes all three sides of the triangle on the same side, or touches some.
        [false, false] => same_side([
            orient3d([p, q, a, b]),
            orient3d([p, q, b, c]),
            orient3d([p, q, c, a]),
        ]),
    }
}

/// Whether two edges cross in a point that is inside of both.
pub(super) fn edges_cross([a, b]: Edge, [c, d]: Edge) -> bool {
    if !orient3d([a, b, c, d]).is_zero() {
        return false;
    }
    let Some(axis) = axis_of([a, b, c]) else {
        return false;
    };
    on_different_sides_flat([a, b].map(|p| drop(axis, p)), [c, d].map(|p| drop(axis, p)))
        && on_different_sides_flat([c, d].map(|p| drop(axis, p)), [a, b].map(|p| drop(axis, p)))
}

/// Whether two points are strictly on different sides of the line through an edge; all are in one plane.
pub(super) fn on_different_sides([a, b]: Edge, c: Point, d: Point) -> bool {
    let Some(axis) = axis_of([a, b, c]) else {
        return false;
    };
    on_different_sides_flat([a, b].map(|p| drop(axis, p)), [c, d].map(|p| drop(axis, p)))
}

fn on_different_sides_flat([a, b]: [[f64; 2]; 2], [c, d]: [[f64; 2]; 2]) -> bool {
    (orient2d(a, b, c) * orient2d(a, b, d)).is_negative()
}

/// Whether an edge passes through a triangle that is not degenerate in a point that is inside of both.
pub(super) fn edge_pierces([p, q]: Edge, [a, b, c]: Triangle) -> bool {
    let [first, second] = [p, q].map(|e| orient3d([a, b, c, e]));
    if !(first * second).is_negative() {
        return false;
    }
    let signs = [
        orient3d([p, q, a, b]),
        orient3d([p, q, b, c]),
        orient3d([p, q, c, a]),
    ];
    signs.iter().all(|s| s.is_positive()) || signs.iter().all(|s| s.is_negative())
}
