//! The triangles of the mesh that lie on polygons, the *subpolygons*, by their vertices.

use crate::mesh::VertexId;
use rustc_hash::FxHashMap;

/// The vertices of a triangle in ascending order.
pub type Face = [VertexId; 3];

/// The subpolygons, each with the number of its polygon.
pub type Subpolygons = FxHashMap<Face, u32>;

/// A triangle's vertices in ascending order.
pub fn face(mut facet: [VertexId; 3]) -> Face {
    facet.sort_unstable();
    facet
}
