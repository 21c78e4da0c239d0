//! The complex that the algorithms work on: distinct vertices, segments, and flat or nearly flat polygons whose
//! boundary edges know on which side the polygon lies.

use crate::mesh::VertexId;

/// A checked PLC. Every vertex id in it is a representative: duplicates have been replaced by the first vertex with the
/// same coordinates.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Complex {
    /// `representative[v]` is the first vertex with the coordinates of v; v itself unless v is a duplicate.
    pub representative: Vec<VertexId>,
    /// Every segment once, with its marker (the first non-zero one given), in order of first appearance.
    pub segments: Vec<crate::exchange::Segment>,
    /// How many of the segments, the last ones, are no segments of the input but diagonals of polygons that are flat
    /// only to rounding ([`Complex::triangulate_not_flat`]).
    pub diagonals: usize,
    /// The polygons to be inserted.
    pub polygons: Vec<Polygon>,
}

/// A polygon f: one facet of the input, or several coplanar adjacent ones that were merged.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Polygon {
    /// The directed boundary edges: the polygon lies to the left of each edge a→b, for one who looks from the side
    /// from which [`Polygon::frame`] turns counterclockwise (the *left side* of the paper: orient3d(a, b, c, v) with
    /// the frame abc is positive there). A segment that floats in f is here in both directions. Sorted.
    pub edges: Vec<[VertexId; 2]>,
    /// All vertices of f: those of its edges and those that float in it. Sorted.
    pub vertices: Vec<VertexId>,
    /// Three vertices of f that are not collinear, chosen to make their triangle large, so that all others are close to
    /// its plane (paper §3.2).
    pub frame: [VertexId; 3],
    /// Whether all vertices of f lie exactly on the plane of the frame.
    pub flat: bool,
    /// The input facets that f consists of, by index in [`crate::exchange::Plc::facets`].
    pub facets: Vec<usize>,
    /// The marker of those facets, which is the same for all of them.
    pub marker: i64,
}
