//! Where a polygon that cannot be cut into flat pieces gets a Steiner point (paper §3.1, end: the usual encroachment
//! rules of Delaunay refinement).
//!
//! A choice, not a decision: floats do.

use super::cells::Cell;
use super::plane::Plane;
use crate::mesh::VertexId;
use crate::number::vector::{cross, dot, minus, square};
use crate::predicate::PointStore;
use crate::recover::segments::Request;

/// The most vertices of a cell among which a Delaunay triangle is searched.
const MOST_TRIED: usize = 256;

/// A Steiner point for a cell of a polygon with the boundary subsegments `boundary`, and the radius of the circle
/// around it that has no vertex of the cell.
///
/// The circumcenter of the largest Delaunay triangle of the cell's vertices, on the plane of the polygon's frame: that
/// of a small triangle is not where the polygon is. If it is in the diametral sphere of a subsegment of the boundary,
/// or beyond one, the subsegment is split instead.
pub(super) fn for_cell<P: PointStore>(
    points: &P,
    plane: &Plane<P>,
    cell: &Cell,
    boundary: &[[VertexId; 2]],
    frame: [VertexId; 3],
) -> Option<(Request, f64)> {
    let vertices = cell.vertices();
    let at = |v: VertexId| points.rounded(v);
    let tried = &vertices[..vertices.len().min(MOST_TRIED)];
    let edges = &cell.edges[..cell.edges.len().min(MOST_TRIED)];
    let mut best: Option<(f64, [f64; 3], [VertexId; 3])> = None;
    for &[a, b] in edges {
        // The Delaunay triangle at ab has the vertex that sees it under the largest angle.
        let left = tried.iter().filter(|&&c| plane.turn(a, b, c).is_positive());
        let angle = |c: VertexId| sight(at(c), at(a), at(b));
        let apex = left.min_by(|&&c, &&d| angle(c).total_cmp(&angle(d)));
        let Some(&c) = apex else { continue };
        let Some((center, radius)) = circumcenter(at(a), at(b), at(c)) else {
            continue;
        };
        if best.is_none_or(|(r, _, _)| radius > r) {
            best = Some((radius, center, [a, b, c]));
        }
    }
    let longest = |edges: &mut dyn Iterator<Item = &[VertexId; 2]>| {
        edges
            .map(|&[a, b]| (square(minus(at(a), at(b))), [a.min(b), a.max(b)]))
            .max_by(|x, y| x.0.total_cmp(&y.0).then(y.1.cmp(&x.1)))
            .map(|(square, e)| (Request::Split(e), square.sqrt()))
    };
    let (radius, center, [a, b, c]) = best?;
    let center = onto_plane(center, frame.map(at));
    let mut encroached = boundary
        .iter()
        .filter(|&&[a, b]| dot(minus(at(a), center), minus(at(b), center)) <= 0.0);
    if let Some(split) = longest(&mut encroached) {
        return Some(split);
    }
    if is_inside(plane, boundary, center) {
        return Some((Request::Point(center), radius));
    }
    // An edge that hides the center from the triangle.
    let middle = [0, 1, 2].map(|k| (at(a)[k] + at(b)[k] + at(c)[k]) / 3.0);
    let [m, z] = [middle, center].map(|p| plane.project(p));
    let mut between = boundary.iter().filter(|e| {
        let [p, q] = e.map(|v| plane.rounded(v));
        let turn = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| {
            (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        };
        turn(m, z, p) * turn(m, z, q) <= 0.0 && turn(p, q, m) * turn(p, q, z) <= 0.0
    });
    longest(&mut between).or_else(|| {
        let mut own = cell.edges.iter().filter(|e| boundary.contains(e));
        longest(&mut own)
    })
}

/// Whether a point is inside closed walks, in rounded projection.
fn is_inside<P: PointStore>(plane: &Plane<P>, edges: &[[VertexId; 2]], p: [f64; 3]) -> bool {
    let [x, y] = plane.project(p);
    let crossings = edges.iter().filter(|e| {
        let [[ax, ay], [bx, by]] = e.map(|v| plane.rounded(v));
        (ay > y) != (by > y) && x < ax + (bx - ax) * ((y - ay) / (by - ay))
    });
    crossings.count() % 2 == 1
}

/// The projection of a point onto the plane of three others.
fn onto_plane(p: [f64; 3], [a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
    let (u, v) = (minus(b, a), minus(c, a));
    let scale = u.iter().chain(&v).fold(0.0f64, |m, x| m.max(x.abs()));
    let normal = cross(u.map(|x| x / scale), v.map(|x| x / scale));
    let off = dot(minus(p, a), normal) / dot(normal, normal);
    let moved: [f64; 3] = std::array::from_fn(|k| p[k] - off * normal[k]);
    if moved.iter().all(|x| x.is_finite()) {
        moved
    } else {
        p
    }
}

/// The center and radius of the smallest sphere through three points.
fn circumcenter(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> Option<([f64; 3], f64)> {
    let (u, v) = (minus(b, a), minus(c, a));
    let scale = u.iter().chain(&v).fold(0.0f64, |m, x| m.max(x.abs()));
    let (u, v) = (u.map(|x| x / scale), v.map(|x| x / scale));
    let normal = cross(u, v);
    let twice = 2.0 * dot(normal, normal);
    let (uu, vv) = (dot(u, u), dot(v, v));
    let (p, q) = (cross(v, normal), cross(normal, u));
    let offset: [f64; 3] = std::array::from_fn(|k| (uu * p[k] + vv * q[k]) / twice * scale);
    let center: [f64; 3] = std::array::from_fn(|k| a[k] + offset[k]);
    let radius = square(offset).sqrt();
    (center.iter().all(|x| x.is_finite()) && radius.is_finite()).then_some((center, radius))
}

fn sight(p: [f64; 3], a: [f64; 3], b: [f64; 3]) -> f64 {
    crate::recover::segments::angle_measure(p, a, b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn circumcenters_of_triangles_in_space() {
        let (center, radius) =
            circumcenter([1., 0., 1.], [0., 2., 1.], [0., 0., 1.]).expect("a triangle");
        assert_eq!((center, radius), ([0.5, 1.0, 1.0], 1.25f64.sqrt()));
        assert_eq!(circumcenter([0.; 3], [1.; 3], [2.; 3]), None);
    }

    #[test]
    fn points_go_to_the_plane() {
        let frame = [[0., 0., 1.], [4., 0., 1.], [0., 2., 3.]];
        assert_eq!(onto_plane([1., 2., 2.], frame), [1., 1.5, 2.5]);
        assert_eq!(onto_plane([1., 2., 2.], [[0.; 3]; 3]), [1., 2., 2.]);
    }
}
