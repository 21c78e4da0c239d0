//! A potential flip on the queue.

use crate::mesh::{Corner, TetId, TetMesh, VertexId};

/// The crossing triangle xyz between the tetrahedra vxyz and wxzy, and when it must be flipped.
#[derive(Clone, Debug)]
pub struct Event<T> {
    /// v, x, y, z, w, with vxyz positive.
    pub circuit: [VertexId; 5],
    /// The tetrahedron that was vxyz when the event was made.
    pub tet: TetId,
    /// The flip time.
    pub time: T,
    /// When the event was queued, for ties between rounded times.
    pub arrival: u64,
}

/// v, x, y, z, w of the triangle opposite corner `c`, at v.
pub fn circuit(mesh: &TetMesh, c: Corner) -> [VertexId; 5] {
    let [x, y, z] = mesh.facet(c);
    [mesh.vertex(c), x, y, z, mesh.apex_across(c)]
}

impl<T> Event<T> {
    /// The corner at v of the tetrahedron vxyz, if both tetrahedra still exist.
    pub fn corner_if_alive(&self, mesh: &TetMesh) -> Option<Corner> {
        let [v, x, y, z, w] = self.circuit;
        let c = self.tet.corner(mesh.slot_of(self.tet, v)?);
        (mesh.has_vertices(self.tet, &[x, y, z]) && mesh.apex_across(c) == w).then_some(c)
    }
}
