//! Typed ids: a vertex, a tetrahedron, a corner. No bare integer stands for an element.

use serde::{Deserialize, Serialize};

/// A vertex: its index in the point store, which is also its identity for the symbolic perturbation.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
#[serde(transparent)]
pub struct VertexId(pub u32);

impl VertexId {
    /// The vertex at infinity, shared by all ghost tetrahedra.
    pub const INFINITE: VertexId = VertexId(u32::MAX);

    /// The vertex with index `i`.
    #[inline]
    pub fn new(i: usize) -> VertexId {
        VertexId(u32::try_from(i).expect("fewer than 2^32 vertices"))
    }

    /// The index as a `usize`.
    #[inline]
    pub fn index(self) -> usize {
        self.0 as usize
    }

    /// Whether this is the vertex at infinity.
    #[inline]
    pub fn is_infinite(self) -> bool {
        self == VertexId::INFINITE
    }
}

/// Whether one of the vertices is that at infinity, whose highest bit no other has.
#[inline(always)]
pub(crate) fn any_infinite([a, b, c, d]: [VertexId; 4]) -> bool {
    (a.0 | b.0 | c.0 | d.0) >> 31 != 0
}

impl std::fmt::Display for VertexId {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}", self.0)
    }
}

/// A tetrahedron, finite or ghost: its index in the mesh.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct TetId(pub u32);

impl TetId {
    /// The tetrahedron with index `i`.
    #[inline]
    pub fn new(i: usize) -> TetId {
        TetId(u32::try_from(i).expect("fewer than 2^30 tetrahedra"))
    }

    /// The index as a `usize`.
    #[inline]
    pub fn index(self) -> usize {
        self.0 as usize
    }

    /// Corner `slot` of this tetrahedron, 0 ≤ slot < 4.
    #[inline]
    pub fn corner(self, slot: usize) -> Corner {
        debug_assert!(slot < 4);
        Corner(self.0 << 2 | slot as u32)
    }
}

/// Corner `i` of tetrahedron `t`, and equally the facet of `t` opposite to it: 4t + i.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Corner(pub u32);

impl Corner {
    /// A corner of no tetrahedron: the twin of a facet that is not glued yet.
    pub const NONE: Corner = Corner(u32::MAX);

    /// The tetrahedron of this corner.
    #[inline]
    pub fn tet(self) -> TetId {
        TetId(self.0 >> 2)
    }

    /// The slot, 0 to 3, of this corner in its tetrahedron.
    #[inline]
    pub fn slot(self) -> usize {
        (self.0 & 3) as usize
    }
}
