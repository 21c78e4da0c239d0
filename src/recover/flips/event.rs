//! A potential flip.

use crate::mesh::{Corner, FACET, TetId, TetMesh, VertexId, slot_of};
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
    let (v, twins) = mesh.tet(c.tet());
    let [i, j, k] = FACET[c.slot()];
    [v[c.slot()], v[i], v[j], v[k], mesh.vertex(twins[c.slot()])]
}

impl Event {
    /// The corner at v of the tetrahedron vxyz, if both tetrahedra still exist.
    #[inline]
    pub fn corner_if_alive(&self, mesh: &TetMesh) -> Option<Corner> {
        let (vertices, twins) = mesh.tet(self.tet);
        let [v, x, y, z, w] = self.circuit;
        let [a, b, c, d] = *vertices;
        let has = |p: VertexId| (a == p) | (b == p) | (c == p) | (d == p);
        if !(has(v) & has(x) & has(y) & has(z)) {
            return None;
        }
        let slot = slot_of(vertices, v);
        (mesh.vertex(twins[slot]) == w).then(|| self.tet.corner(slot))
    }
}
