//! How an insertion sees R and f: which tetrahedra fill R, and on which side of f their vertices are.

use crate::mesh::{TetId, VertexId};
use crate::predicate::PointStore;
use crate::recover::region::{Side, Sides};
use crate::recover::tables::Table;

/// What an insertion by flips asks about R and f.
pub trait RegionView {
    /// Which of a tetrahedron's vertices are left and which are right of f, as bits.
    fn left_and_right(&self, vertices: &[VertexId; 4]) -> [u8; 2];

    /// Whether a vertex is one of f's.
    fn is_on(&self, v: VertexId) -> bool;

    /// Whether a tetrahedron, which may be a ghost or gone, is among those that fill R.
    fn contains(&self, t: TetId) -> bool;

    /// A flip has put a tetrahedron into R.
    fn enter(&mut self, t: TetId);

    /// A flip has removed a tetrahedron.
    fn leave(&mut self, t: TetId);
}

/// A region in the mesh as it is.
pub(super) struct InMesh<'a, P> {
    sides: &'a Sides<'a, P>,
    /// Which tetrahedra fill R now.
    marks: &'a mut Table<bool>,
}

impl<'a, P> InMesh<'a, P> {
    /// The given tetrahedra. `marks` is a table that is kept from region to region for its memory.
    pub(super) fn new(
        sides: &'a Sides<'a, P>,
        tets: &[TetId],
        marks: &'a mut Table<bool>,
    ) -> InMesh<'a, P> {
        marks.clear();
        for t in tets {
            marks.set(t.index(), true);
        }
        InMesh { sides, marks }
    }

    /// The tetrahedra that fill R, sorted.
    pub(super) fn tets(&self) -> Vec<TetId> {
        self.marks.ids().into_iter().map(TetId).collect()
    }
}

impl<P: PointStore> RegionView for InMesh<'_, P> {
    #[inline]
    fn left_and_right(&self, vertices: &[VertexId; 4]) -> [u8; 2] {
        self.sides.left_and_right(vertices)
    }

    #[inline]
    fn is_on(&self, v: VertexId) -> bool {
        self.sides.of(v) == Side::On
    }

    #[inline]
    fn contains(&self, t: TetId) -> bool {
        self.marks.get(t.index())
    }

    #[inline]
    fn enter(&mut self, t: TetId) {
        self.marks.set(t.index(), true);
    }

    #[inline]
    fn leave(&mut self, t: TetId) {
        self.marks.reset(t.index());
    }
}
