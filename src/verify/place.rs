//! A vertex as texts show it.

use crate::mesh::VertexId;
use std::fmt;

/// A vertex and where it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Its index in the mesh (in the PLC where the text says so, or where it is in no tetrahedron).
    pub id: VertexId,
    /// Its coordinates.
    pub at: [f64; 3],
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y, z] = self.at;
        write!(f, "v{} ({x}, {y}, {z})", self.id.0)
    }
}
