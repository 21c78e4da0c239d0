//! One tetrahedron at each vertex, so that the star of a vertex is found without a search.

use super::{TetId, TetMesh, VertexId};

/// For each vertex a finite tetrahedron that has it, as long as the mesh's changes are reported by
/// [`Incidence::update`].
#[derive(Clone, Debug, Default)]
pub struct Incidence {
    tet_at: Vec<Option<TetId>>,
}

impl Incidence {
    /// The incidence of a whole mesh whose vertices have ids below `n`.
    pub fn new(mesh: &TetMesh, n: usize) -> Incidence {
        let mut incidence = Incidence {
            tet_at: vec![None; n],
        };
        for t in mesh.finite() {
            incidence.record(mesh, t);
        }
        incidence
    }

    /// To be called with all tetrahedra that an operation created.
    pub fn update(&mut self, mesh: &TetMesh, created: &[TetId]) {
        for &t in created {
            if !mesh.is_ghost(t) {
                self.record(mesh, t);
            }
        }
    }

    fn record(&mut self, mesh: &TetMesh, t: TetId) {
        for v in mesh.vertices(t) {
            if self.tet_at.len() <= v.index() {
                self.tet_at.resize(v.index() + 1, None);
            }
            self.tet_at[v.index()] = Some(t);
        }
    }

    /// A finite tetrahedron at `v`, or `None` if `v` is not in the mesh.
    pub fn tet_at(&self, v: VertexId) -> Option<TetId> {
        self.tet_at.get(v.index()).copied().flatten()
    }

    /// A tetrahedron with the edge ab, by a search of the star of a.
    pub fn tet_at_edge(&self, mesh: &TetMesh, a: VertexId, b: VertexId) -> Option<TetId> {
        self.star(mesh, a)
            .into_iter()
            .find(|&t| mesh.slot_of(t, b).is_some())
    }

    /// All tetrahedra at `v`, ghosts included. Time linear in their number.
    pub fn star(&self, mesh: &TetMesh, v: VertexId) -> Vec<TetId> {
        let Some(first) = self.tet_at(v) else {
            return Vec::new();
        };
        let mut star = vec![first];
        let mut seen = rustc_hash::FxHashSet::default();
        seen.insert(first);
        let mut next = 0;
        while let Some(&t) = star.get(next) {
            next += 1;
            for slot in (0..4).filter(|&slot| mesh.vertices(t)[slot] != v) {
                let n = mesh.neighbor(t.corner(slot));
                if seen.insert(n) {
                    star.push(n);
                }
            }
        }
        star
    }
}
