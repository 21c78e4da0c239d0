//! Potential flips: events, and lists of triangles to certify.

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
    pub signs: Signs,
}

/// The signs of a circuit's coefficients c_x, c_y, c_z, where they are known: the bits 0, 1, 2.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug)]
pub struct Signs {
    pub(super) negative: u8,
    pub(super) positive: u8,
    pub(super) zero: u8,
}

impl Signs {
    /// None is known.
    pub const UNKNOWN: Signs = Signs {
        negative: 0,
        positive: 0,
        zero: 0,
    };

    /// Those that are known, as bits.
    #[inline(always)]
    pub(super) fn known(self) -> u8 {
        self.negative | self.positive | self.zero
    }

    /// Notes the sign of c_x, c_y or c_z.
    pub(super) fn set(&mut self, i: usize, sign: Sign) {
        let signs = match sign {
            Sign::Negative => &mut self.negative,
            Sign::Zero => &mut self.zero,
            Sign::Positive => &mut self.positive,
        };
        *signs |= 1 << i;
    }
}

/// v, x, y, z, w of the triangle opposite corner `c`, at v.
#[inline]
pub fn circuit(mesh: &TetMesh, c: Corner) -> [VertexId; 5] {
    let (v, twins) = mesh.tet(c.tet());
    let [i, j, k] = FACET[c.slot()];
    [v[c.slot()], v[i], v[j], v[k], mesh.vertex(twins[c.slot()])]
}

impl Event {
    /// An event of which nothing but the circuit is of interest: for evaluating and comparing times.
    pub fn of_circuit(circuit: [VertexId; 5]) -> Event {
        Event {
            circuit,
            tet: TetId(u32::MAX),
            signs: Signs::UNKNOWN,
        }
    }

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

/// A list of facets, by the opposite corners, that is made without branches: at most those of four tetrahedra.
pub(super) struct Facets {
    corners: [Corner; 16],
    len: usize,
}

impl Default for Facets {
    fn default() -> Facets {
        Facets {
            corners: [Corner::NONE; 16],
            len: 0,
        }
    }
}

impl Facets {
    #[inline(always)]
    pub(super) fn push_if(&mut self, c: Corner, is_chosen: bool) {
        debug_assert!(self.len < 16, "four tetrahedra have 16 facets");
        self.corners[self.len & 15] = c;
        self.len += usize::from(is_chosen);
    }

    #[inline(always)]
    pub(super) fn as_slice(&self) -> &[Corner] {
        &self.corners[..self.len]
    }
}
