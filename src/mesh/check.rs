//! The check of the mesh's invariants.

use super::{Corner, TetId, TetMesh};

/// A violated invariant of [`TetMesh`].
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
pub enum TopologyError {
    /// A facet is not glued to anything.
    #[error("facet {0:?} is not glued")]
    Open(Corner),
    /// twin(twin(c)) is not c.
    #[error("facet {0:?} is not the twin of its twin")]
    OneSided(Corner),
    /// A corner and its twin see different vertices, or the same in the same order.
    #[error("facet {0:?} and its twin see different vertices")]
    Mismatch(Corner),
    /// A tetrahedron uses a vertex twice.
    #[error("tetrahedron {0:?} uses a vertex twice")]
    Repeated(TetId),
}

impl TetMesh {
    /// Checks the invariants of the adjacency: twins, vertices, and that nothing is open. Linear time.
    ///
    /// # Errors
    /// The first violation, in order of id.
    pub fn check(&self) -> Result<(), TopologyError> {
        for t in self.all() {
            let mut v = self.vertices(t);
            v.sort_unstable();
            if v.windows(2).any(|w| w[0] == w[1]) {
                return Err(TopologyError::Repeated(t));
            }
            for slot in 0..4 {
                let c = t.corner(slot);
                let d = self.twin(c);
                if d == Corner::NONE || !self.is_alive(d.tet()) {
                    return Err(TopologyError::Open(c));
                }
                if self.twin(d) != c {
                    return Err(TopologyError::OneSided(c));
                }
                let [p, q, r] = self.facet(c);
                let seen = self.facet(d);
                if ![[q, p, r], [p, r, q], [r, q, p]].contains(&seen) {
                    return Err(TopologyError::Mismatch(c));
                }
            }
        }
        Ok(())
    }
}
