//! Polygons that are flat only to rounding, as triangles, which are flat: for exact Steiner points, with which
//! everything else is flat, too.
//!
//! The triangulation is the constrained Delaunay triangulation of the polygon in the projection of its frame, whose
//! coordinates are input doubles ([`super::plane`]), so that it is that of the polygon as its checks saw it. The crate
//! `spade` makes it, with exact predicates. Its coordinates must be neither too small nor too large: they are
//! multiplied by a power of two, and what then is too small counts as 0. Whether all triangles are positive, and so
//! whether that has changed anything, is checked with our own signs.

use super::facet::undirected;
use super::plane::{Projected, Projection};
use super::{Complex, FacetName, PlcError, Polygon};
use crate::exchange::{Plc, Segment};
use crate::mesh::VertexId;
use crate::number::Sign;
use crate::number::bits::{exponent, power_of_two};
use rustc_hash::{FxHashMap, FxHashSet};
use spade::handles::FixedVertexHandle;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

impl Complex {
    /// Replaces the polygons that are flat only to rounding by triangles, and returns how many polygons those were. The
    /// diagonals become segments, which are the last ones ([`Complex::diagonals`]).
    ///
    /// # Errors
    /// [`PlcError::NotTriangulated`] if a polygon's projection is too close to degenerate to be triangulated.
    pub fn triangulate_not_flat(&mut self, plc: &Plc) -> Result<usize, PlcError> {
        let mut known: FxHashSet<[VertexId; 2]> =
            self.segments.iter().map(|s| undirected(s.ends)).collect();
        let mut count = 0;
        let mut polygons = Vec::with_capacity(self.polygons.len());
        for polygon in std::mem::take(&mut self.polygons) {
            if polygon.flat {
                polygons.push(polygon);
                continue;
            }
            count += 1;
            let triangles = triangles_of(plc, &polygon)?;
            let edges = triangles.iter().flat_map(|t| &t.edges);
            for ends in edges.map(|&edge| undirected(edge)) {
                if known.insert(ends) {
                    self.segments.push(Segment { ends, marker: 0 });
                    self.diagonals += 1;
                }
            }
            polygons.extend(triangles);
        }
        self.polygons = polygons;
        Ok(count)
    }
}

/// The constrained Delaunay triangulation of a polygon in the projection of its frame, as triangles that turn as it
/// does.
///
/// # Errors
/// As [`Complex::triangulate_not_flat`].
pub(crate) fn triangles_of(plc: &Plc, polygon: &Polygon) -> Result<Vec<Polygon>, PlcError> {
    let points = &plc.vertices;
    let corners = polygon.frame.map(|v| points[v.index()]);
    let (projection, sign) = Projection::of(corners).expect("a frame is not collinear");
    let plane = Projected { points, projection };
    let failed = || degenerate(plc, polygon);
    let triangles = inner_triangles(&plane, polygon, sign).ok_or_else(failed)?;
    let positive = |&[a, b, c]: &[VertexId; 3]| plane.orient([a, b, c]).is_positive();
    if !triangles.iter().all(positive) || !cover(&triangles, polygon, sign) {
        return Err(failed());
    }
    let piece = |[a, b, c]: [VertexId; 3]| {
        // As the polygon's frame turns.
        let frame = if sign.is_positive() {
            [a, b, c]
        } else {
            [a, c, b]
        };
        let [a, b, c] = frame;
        let (mut edges, mut vertices) = (vec![[a, b], [b, c], [c, a]], vec![a, b, c]);
        edges.sort_unstable();
        vertices.sort_unstable();
        Polygon {
            edges,
            vertices,
            frame,
            flat: true,
            facets: polygon.facets.clone(),
            marker: polygon.marker,
        }
    };
    let mut pieces: Vec<Polygon> = triangles.into_iter().map(piece).collect();
    pieces.sort_unstable_by(|p, q| p.vertices.cmp(&q.vertices));
    Ok(pieces)
}

/// The triangles inside the polygon, counterclockwise in the projection.
fn inner_triangles(plane: &Projected, polygon: &Polygon, sign: Sign) -> Option<Vec<[VertexId; 3]>> {
    let at = |v: VertexId| plane.at(v);
    let coordinates = polygon.vertices.iter().flat_map(|&v| at(v));
    let largest = coordinates.fold(0.0f64, |m, x| m.max(x.abs()));
    let scaled = |x: f64| {
        let x = x / power_below(largest);
        if x.abs() < spade::MIN_ALLOWED_VALUE {
            0.0
        } else {
            x
        }
    };
    let mut triangulation = ConstrainedDelaunayTriangulation::<Point2<f64>>::new();
    let mut handle: FxHashMap<VertexId, FixedVertexHandle> = FxHashMap::default();
    let mut vertex: Vec<VertexId> = Vec::new();
    for &v in &polygon.vertices {
        let [x, y] = at(v).map(scaled);
        let h = triangulation.insert(Point2::new(x, y)).ok()?;
        if h.index() != vertex.len() {
            return None;
        }
        handle.insert(v, h);
        vertex.push(v);
    }
    for &[a, b] in &polygon.edges {
        let (from, to) = (handle[&a], handle[&b]);
        if !triangulation.can_add_constraint(from, to) {
            return None;
        }
        triangulation.add_constraint(from, to);
    }
    // From the inner side of the polygon's edges across everything that is no edge of it.
    let mut inside = vec![false; triangulation.num_all_faces()];
    let mut open = Vec::new();
    for &[a, b] in &polygon.edges {
        let [from, to] = if sign.is_positive() { [a, b] } else { [b, a] };
        let edge = triangulation.get_edge_from_neighbors(handle[&from], handle[&to])?;
        open.push(edge.face().as_inner()?.fix());
    }
    let mut triangles = Vec::new();
    while let Some(face) = open.pop() {
        if std::mem::replace(&mut inside[face.index()], true) {
            continue;
        }
        let face = triangulation.face(face);
        triangles.push(face.vertices().map(|v| vertex[v.index()]));
        for edge in face
            .adjacent_edges()
            .iter()
            .filter(|e| !e.is_constraint_edge())
        {
            open.push(edge.rev().face().as_inner()?.fix());
        }
    }
    Some(triangles)
}

/// The largest power of two that is at most x, for x > 0.
fn power_below(x: f64) -> f64 {
    power_of_two(exponent(x))
}

/// Whether the triangles have the polygon's edges as their boundary, and every other edge in both directions.
fn cover(triangles: &[[VertexId; 3]], polygon: &Polygon, sign: Sign) -> bool {
    let mut edges: FxHashSet<[VertexId; 2]> = FxHashSet::default();
    let sides = triangles
        .iter()
        .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let mut simple = true;
    for edge in sides {
        simple &= edges.insert(edge);
    }
    for &[a, b] in &polygon.edges {
        simple &= edges.remove(&if sign.is_positive() { [a, b] } else { [b, a] });
    }
    simple && edges.iter().all(|&[a, b]| edges.contains(&[b, a]))
}

fn degenerate(plc: &Plc, polygon: &Polygon) -> PlcError {
    PlcError::NotTriangulated {
        facet: FacetName::new(plc, polygon.facets[0]),
    }
}
