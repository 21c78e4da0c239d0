//! A tetrahedral mesh as files hold it: plain arrays, no adjacency. Written by [`crate::format`], read back by it,
//! and checked by [`crate::verify`], whoever made it.

use super::{Attributes, Facet};
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
    /// What the faces lie on and between; empty if that is not known.
    pub face_table: FaceTable,
    /// The number of the region of each tetrahedron, from 1 on: parts of the domain that facets divide, in the order of
    /// their first tetrahedra. Empty if they are not known.
    pub region_numbers: Vec<u32>,
    /// The edges that lie on input segments.
    pub edges: Vec<ExportedEdge>,
    /// The number in the input of each of its vertices that is in the mesh, and the vertex. Empty if all vertices of
    /// the input are there and numbered like the mesh's.
    pub renumbered: Vec<(i64, VertexId)>,
}

/// What the faces of a mesh lie on and between.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FaceTable {
    /// The regions on both sides of each face: the one from which the face looks clockwise, and the one from which it
    /// looks counterclockwise. 0 is what is not in the mesh.
    pub sides: Vec<[u32; 2]>,
    /// The polygon that each face lies on, counted from 1; 0 for a face of the convex hull that is on none.
    pub polygons: Vec<u32>,
    /// The input facets, by index, that each polygon consists of: one, or several that are coplanar.
    pub facets: Vec<Vec<usize>>,
    /// The polygons whose facets have several markers, since facets of the input overlap there, counted from 1, and
    /// these markers; increasing.
    pub markers: Vec<(u32, Vec<i64>)>,
}

impl FaceTable {
    /// Lists the markers of polygons whose facets have several. `facets` are those of the input.
    pub(crate) fn add_markers(&mut self, facets: &[Facet]) {
        for (polygon, own) in (1..).zip(&self.facets) {
            let mut markers: Vec<i64> = own.iter().map(|&f| facets[f].marker).collect();
            markers.sort_unstable();
            markers.dedup();
            if markers.len() > 1 {
                self.markers.push((polygon, markers));
            }
        }
    }
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

/// A triangular face with the marker of its input facet. It is counterclockwise for one who looks at it from outside of
/// the mesh or, where both sides are in it, from the region with the higher number.
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
