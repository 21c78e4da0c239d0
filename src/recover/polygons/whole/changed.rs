//! What an insertion has changed so far, so that it can be taken back.

use crate::mesh::{TetId, TetMesh, VertexId};
use crate::recover::workspace::ConstrainedMesh;
use rustc_hash::FxHashSet;

/// The tetrahedra that are gone, and those that fill their space.
#[derive(Default)]
pub(super) struct Changed {
    old: Vec<[VertexId; 4]>,
    new: FxHashSet<TetId>,
}

impl Changed {
    /// To be called before tetrahedra are replaced by others.
    pub(super) fn removes(&mut self, mesh: &TetMesh, tets: &[TetId]) {
        for t in tets {
            if !self.new.remove(t) {
                self.old.push(mesh.vertices(*t));
            }
        }
    }

    /// To be called with the others.
    pub(super) fn creates(&mut self, tets: &[TetId]) {
        self.new.extend(tets);
    }

    /// How many tetrahedra are gone, and how many fill their space.
    pub(super) fn counts(&self) -> [u64; 2] {
        [self.old.len(), self.new.len()].map(|n| n as u64)
    }

    /// The new tetrahedra, ascending.
    pub(super) fn new_tets(&self) -> impl Iterator<Item = TetId> + use<> {
        let mut tets: Vec<TetId> = self.new.iter().copied().collect();
        tets.sort_unstable();
        tets.into_iter()
    }

    /// Takes everything back. The tetrahedra have other ids then.
    pub(super) fn undo(self, cdt: &mut ConstrainedMesh) {
        let new: Vec<TetId> = self.new_tets().collect();
        let restored = cdt.mesh.replace(&new, &self.old);
        cdt.created(&restored);
    }
}
