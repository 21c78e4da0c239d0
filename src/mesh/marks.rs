//! Marks of tetrahedra, for the search of an insertion: one bit of the first vertex each.

use super::topology::Tet;
use super::{Corner, TetId, TetMesh, VertexId};

/// The bit of the first vertex that is turned over in a marked tetrahedron. In ids below 2^30, and in that of the
/// vertex at infinity, it equals the next higher bit.
const MARK: u32 = 1 << 30;

impl TetMesh {
    /// Whether `t` is marked; and its vertices, which are those of a tetrahedron only if it is not.
    #[inline]
    pub(crate) fn unless_marked(&self, t: TetId) -> (bool, [VertexId; 4]) {
        let vertices = self.tets[t.index()].vertices;
        let VertexId(first) = vertices[0];
        ((first ^ (first >> 1)) & MARK != 0, vertices)
    }

    /// Marks `t`, or takes its mark away. A marked tetrahedron must not be looked at but by [`TetMesh::unless_marked`]
    /// and [`TetMesh::marked`].
    #[inline]
    pub(crate) fn toggle_mark(&mut self, t: TetId) {
        self.tets[t.index()].vertices[0].0 ^= MARK;
    }

    /// The vertices of a marked tetrahedron and what lies across the facets opposite to them: one cache line, read
    /// once.
    #[inline]
    pub(crate) fn marked(&self, t: TetId) -> ([VertexId; 4], [Corner; 4]) {
        let Tet { vertices, twins } = self.tets[t.index()];
        let [VertexId(first), b, c, d] = vertices;
        ([VertexId(first ^ MARK), b, c, d], twins)
    }
}
