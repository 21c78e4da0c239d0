//! Whether two facets are in conflict, by all pairs of their parts, in rationals.

use super::*;

pub(super) type Number = Ratio<i128>;
pub(super) type Point = [Number; 3];

pub(super) fn minus(p: &Point, q: &Point) -> Point {
    [0, 1, 2].map(|k| p[k] - q[k])
}

pub(super) fn cross([a, b, c]: &Point, [x, y, z]: &Point) -> Point {
    [b * z - c * y, c * x - a * z, a * y - b * x]
}

pub(super) fn dot(p: &Point, q: &Point) -> Number {
    (0..3).map(|k| p[k] * q[k]).sum()
}

pub(super) fn is_zero(p: &Point) -> bool {
    p.iter().all(Zero::is_zero)
}

/// Whether a point is in the hull of one, two or three points that are not collinear.
pub(super) fn contains(shape: &[Point], p: &Point) -> bool {
    match shape {
        [a] => a == p,
        [a, b] => {
            let (along, to) = (minus(b, a), minus(p, a));
            let t = dot(&along, &to);
            is_zero(&cross(&along, &to)) && t >= Number::zero() && t <= dot(&along, &along)
        }
        [a, b, c] => {
            let normal = cross(&minus(b, a), &minus(c, a));
            let inward = |p1: &Point, p2: &Point| {
                dot(&cross(&minus(p2, p1), &minus(p, p1)), &normal) >= Number::zero()
            };
            dot(&normal, &minus(p, a)).is_zero() && inward(a, b) && inward(b, c) && inward(c, a)
        }
        _ => unreachable!("at most three points"),
    }
}

/// The edges of a simplex.
pub(super) fn sides(shape: &[Point]) -> Vec<[Point; 2]> {
    match shape {
        [_] => vec![],
        [a, b] => vec![[*a, *b]],
        [a, b, c] => vec![[*a, *b], [*b, *c], [*c, *a]],
        _ => unreachable!("at most three points"),
    }
}

/// Where a segment crosses the plane of a triangle, or the line of an edge in its plane.
pub(super) fn crossing([p, q]: &[Point; 2], shape: &[Point]) -> Option<Point> {
    let along = minus(q, p);
    let normal = match shape {
        [a, b, c] => cross(&minus(b, a), &minus(c, a)),
        // The plane through the edge at right angles to the plane of both.
        [a, b] => {
            let edge = minus(b, a);
            cross(&edge, &cross(&edge, &along))
        }
        _ => return None,
    };
    let speed = dot(&normal, &along);
    if speed.is_zero() {
        return None;
    }
    let t = dot(&normal, &minus(&shape[0], p)) / speed;
    Some([0, 1, 2].map(|k| p[k] + t * along[k]))
}

/// Points whose hull is the intersection of two simplices.
pub(super) fn intersection(s: &[Point], t: &[Point]) -> Vec<Point> {
    let mut found: Vec<Point> = s.iter().chain(t).copied().collect();
    for (one, other) in [(s, t), (t, s)] {
        for side in sides(one) {
            found.extend(crossing(&side, other));
            for edge in sides(other) {
                found.extend(crossing(&side, &edge));
            }
        }
    }
    found.retain(|p| contains(s, p) && contains(t, p));
    found
}

/// A part as it is given: simplices, edges and vertices that it declares.
pub(super) struct Shape {
    pub(super) part: Part,
    pub(super) simplices: Vec<Vec<u32>>,
    pub(super) edges: Vec<[u32; 2]>,
    pub(super) vertices: Vec<u32>,
}

/// Whether two parts intersect elsewhere than in common vertices and edges.
pub(super) fn in_conflict(at: &dyn Fn(u32) -> Point, f: &Shape, g: &Shape) -> bool {
    let common_edges = f.edges.iter().filter(|e| g.edges.contains(e));
    let mut common: Vec<Vec<Point>> = common_edges.map(|e| e.map(at).to_vec()).collect();
    let common_vertices = f.vertices.iter().filter(|v| g.vertices.contains(v));
    common.extend(common_vertices.map(|&v| vec![at(v)]));
    let points = |simplex: &Vec<u32>| -> Vec<Point> { simplex.iter().map(|&v| at(v)).collect() };
    let pairs = f
        .simplices
        .iter()
        .flat_map(|s| g.simplices.iter().map(move |t| (s, t)));
    pairs.into_iter().any(|(s, t)| {
        let found = intersection(&points(s), &points(t));
        let inside = |c: &Vec<Point>| found.iter().all(|p| contains(c, p));
        !found.is_empty() && !common.iter().any(inside)
    })
}
