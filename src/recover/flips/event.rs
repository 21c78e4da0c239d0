//! A potential flip.

use crate::mesh::{Corner, TetId, TetMesh, VertexId};
use crate::number::Sign;

/// The crossing triangle xyz between the tetrahedra vxyz and wxzy, which must be flipped at some time.
#[derive(Clone, Copy, Debug)]
pub struct Event {
    /// v, x, y, z, w, with vxyz positive.
    pub circuit: [VertexId; 5],
    /// The tetrahedron that was vxyz when the event was made.
    pub tet: TetId,
    /// The signs of the circuit's coefficients c_x, c_y, c_z, where they are known: which kind of flip it is.
    pub signs: [Option<Sign>; 3],
}

/// v, x, y, z, w of the triangle opposite corner `c`, at v.
#[inline]
pub fn circuit(mesh: &TetMesh, c: Corner) -> [VertexId; 5] {
    let [x, y, z] = mesh.facet(c);
    [mesh.vertex(c), x, y, z, mesh.apex_across(c)]
}

impl Event {
    /// The corner at v of the tetrahedron vxyz, if both tetrahedra still exist.
    #[inline]
    pub fn corner_if_alive(&self, mesh: &TetMesh) -> Option<Corner> {
        let [v, x, y, z, w] = self.circuit;
        let c = self.tet.corner(mesh.slot_of(self.tet, v)?);
        (mesh.has_vertices(self.tet, &[x, y, z]) && mesh.apex_across(c) == w).then_some(c)
    }
}
