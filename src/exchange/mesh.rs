//! A tetrahedral mesh as files hold it: plain arrays, no adjacency. Written by [`crate::format`], read back by it,
//! and checked by [`crate::verify`], whoever made it.

use super::Attributes;
use crate::mesh::VertexId;
use crate::number::Parameter;

/// A finished mesh: what `.node/.ele/.face/.edge` files contain.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ExportedMesh {
    /// The index of the first vertex in files, 0 or 1; ids in this struct always count from 0.
    pub first_index: u32,
    /// Coordinates. The vertices of the input come first, in the order of the input, then Steiner points.
    pub vertices: Vec<[f64; 3]>,
    /// The attributes of all vertices.
    pub attributes: Attributes,
    /// The markers of all vertices, 0 for none; empty if no vertex has one.
    pub vertex_markers: Vec<i64>,
    /// The vertices that are exactly elsewhere: their coordinates are rounded.
    pub exact: Vec<ExactPosition>,
    /// Positively oriented tetrahedra: det[b−a, c−a, d−a] > 0, for the exact positions.
    pub tets: Vec<[VertexId; 4]>,
    /// One region attribute per tetrahedron, or empty if the input has no regions.
    pub regions: Vec<f64>,
    /// The faces that lie on input facets (and, where the convex hull is kept, the faces of the hull).
    pub faces: Vec<ExportedFace>,
    /// The edges that lie on input segments.
    pub edges: Vec<ExportedEdge>,
}

/// The exact position a + t(b−a) of a Steiner point whose coordinates are no doubles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExactPosition {
    /// The Steiner point.
    pub vertex: VertexId,
    /// The ends a, b of its segment, vertices whose coordinates are exact.
    pub ends: [VertexId; 2],
    /// t, strictly between 0 and 1.
    pub t: Parameter,
}

/// A triangular face with the marker of its input facet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ExportedFace {
    /// The three vertices.
    pub vertices: [VertexId; 3],
    /// The marker of the input facet; 0 for an unmarked facet and for a hull face that is on no facet.
    pub marker: i64,
}

/// An edge on an input segment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ExportedEdge {
    /// The two vertices.
    pub vertices: [VertexId; 2],
    /// The marker of the input segment, 0 if it has none.
    pub marker: i64,
}
