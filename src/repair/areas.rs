//! A part of a plane as a facet: closed walks, and a hole point in every part that they enclose and that is not meant.

use crate::check::triangulate;
use crate::exchange::Facet;
use crate::mesh::VertexId;
use crate::plc::{Face, Faces, Polygon, Projected, Projection, choose_frame, sorted, undirected};

/// A facet with the area, the floating edges and vertices, and the orientation of a polygon that is exactly flat;
/// `None` if some hole is too small for a hole point with doubles as coordinates.
///
/// A hole point is rounded, and so are projections of it along other axes: what the facet becomes is to be compared
/// with what was wanted. O(k log k) for k edges and few holes.
pub(super) fn facet_of(points: &[[f64; 3]], polygon: &Polygon) -> Option<Facet> {
    let frame = polygon.frame.map(|v| points[v.index()]);
    let (projection, sign) = Projection::of(frame).expect("a frame is not collinear");
    let plane = Projected { points, projection };
    // With the polygon on the left in the projection.
    let mut left = polygon.edges.clone();
    if sign.is_negative() {
        left.iter_mut().for_each(|edge| edge.reverse());
        left.sort_unstable();
    }
    let mut edges: Vec<_> = left.iter().copied().map(undirected).collect();
    edges.sort_unstable();
    edges.dedup();
    let mut facet = Facet {
        marker: polygon.marker,
        ..Facet::default()
    };
    for face in Faces::new(&plane, &edges).list {
        let first = face.edges().next().expect("a face has a boundary");
        if left.binary_search(&first).is_ok() {
            facet.polygons.extend(face.walks);
        } else {
            facet.holes.push(interior_point(&plane, &face)?);
        }
    }
    if sign.is_negative() {
        facet.polygons.iter_mut().for_each(|walk| walk.reverse());
    }
    let ends = sorted(edges.concat());
    let floating = polygon.vertices.iter().copied();
    let floating = floating.filter(|v| ends.binary_search(v).is_err());
    facet.polygons.extend(floating.map(|v| vec![v]));
    Some(facet)
}

/// The polygon that a face is, counterclockwise in the projection. `floating` are more vertices of it.
pub(super) fn polygon_of(plane: &Projected, face: &Face, floating: &[VertexId]) -> Polygon {
    let mut edges: Vec<_> = face.edges().collect();
    edges.sort_unstable();
    let vertices = sorted([&face.walks.concat(), floating].concat());
    let frame = choose_frame(plane.points, &vertices);
    let [a, b, c] = frame.expect("a face is not collinear");
    let counterclockwise = plane.orient([a, b, c]).is_positive();
    Polygon {
        edges,
        vertices,
        frame: if counterclockwise {
            [a, b, c]
        } else {
            [a, c, b]
        },
        flat: true,
        facets: Vec::new(),
        marker: 0,
    }
}

/// A point with doubles as coordinates that is in the interior of a face in the projection: the centroid of a large
/// triangle.
fn interior_point(plane: &Projected, face: &Face) -> Option<[f64; 3]> {
    let mut triangles = triangulate(plane, &polygon_of(plane, face, &[]));
    let size = |t: &[VertexId; 3]| {
        let [[au, av], [bu, bv], [cu, cv]] = t.map(|v| plane.at(v));
        let [bu, bv, cu, cv] = [
            bu * 0.5 - au * 0.5,
            bv * 0.5 - av * 0.5,
            cu * 0.5 - au * 0.5,
            cv * 0.5 - av * 0.5,
        ];
        (bu * cv - bv * cu).abs()
    };
    triangles.sort_by(|s, t| size(t).total_cmp(&size(s)).then(s.cmp(t)));
    let centroid = |t: [VertexId; 3]| {
        let [a, b, c] = t.map(|v| plane.points[v.index()]);
        [0, 1, 2].map(|k| a[k] / 3.0 + b[k] / 3.0 + c[k] / 3.0)
    };
    let is_inside = |t: [VertexId; 3], p: [f64; 3]| {
        let [a, b, c] = t.map(|v| plane.at(v));
        let at = plane.projection.point(p);
        let sides = [(a, b), (b, c), (c, a)];
        sides
            .iter()
            .all(|&(p, q)| crate::plc::orient2d(p, q, at).is_positive())
    };
    let mut points = triangles.into_iter().map(|t| (t, centroid(t)));
    points.find(|&(t, p)| is_inside(t, p)).map(|(_, p)| p)
}
