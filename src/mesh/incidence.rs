//! One tetrahedron at each vertex, so that the star of a vertex is found without a search.

use super::{TetId, TetMesh, VertexId};
use rustc_hash::FxHashSet;

/// For each vertex a finite tetrahedron that has it, as long as the mesh's changes are reported by
/// [`Incidence::update`].
#[derive(Clone, Debug, Default)]
pub struct Incidence {
    tet_at: Vec<TetId>,
}

/// In place of a tetrahedron of vertices that are not in the mesh.
const NONE: TetId = TetId(u32::MAX);

impl Incidence {
    /// The incidence of a whole mesh whose vertices have ids below `n`.
    pub fn new(mesh: &TetMesh, n: usize) -> Incidence {
        let mut incidence = Incidence {
            tet_at: vec![NONE; n],
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
                self.tet_at.resize(v.index() + 1, NONE);
            }
            self.tet_at[v.index()] = t;
        }
    }

    /// A finite tetrahedron at `v`, or `None` if `v` is not in the mesh.
    pub fn tet_at(&self, v: VertexId) -> Option<TetId> {
        let t = self.tet_at.get(v.index()).copied();
        t.filter(|&t| t != NONE)
    }

    /// A tetrahedron with the edge ab, by a search of both stars in turn: time linear in the size of the smaller one,
    /// as one of the ends may be the hub of very many edges.
    pub fn tet_at_edge(&self, mesh: &TetMesh, a: VertexId, b: VertexId) -> Option<TetId> {
        let mut stars = (self.walk(mesh, a), self.walk(mesh, b));
        loop {
            for (star, other) in [(&mut stars.0, b), (&mut stars.1, a)] {
                let t = star.next()?;
                if mesh.slot_of(t, other).is_some() {
                    return Some(t);
                }
            }
        }
    }

    /// All tetrahedra at `v`, ghosts included. Time linear in their number.
    pub fn star(&self, mesh: &TetMesh, v: VertexId) -> Vec<TetId> {
        self.walk(mesh, v).collect()
    }

    fn walk<'a>(&self, mesh: &'a TetMesh, v: VertexId) -> StarWalk<'a> {
        let mut found = Vec::with_capacity(FEW);
        found.extend(self.tet_at(v));
        StarWalk {
            mesh,
            v,
            found,
            seen: FxHashSet::default(),
            next: 0,
        }
    }
}

/// Most stars have fewer tetrahedra; among so many a scan is faster than a hash table.
const FEW: usize = 64;

/// The tetrahedra at `v`, breadth first.
struct StarWalk<'a> {
    mesh: &'a TetMesh,
    v: VertexId,
    found: Vec<TetId>,
    /// Those found, from [`FEW`] of them on.
    seen: FxHashSet<TetId>,
    next: usize,
}

impl StarWalk<'_> {
    #[inline]
    fn find(&mut self, t: TetId) {
        if self.found.len() < FEW {
            // All of them, several at a time: a search that stops at the first one is slower.
            if !self.found.iter().fold(false, |found, &s| found | (s == t)) {
                self.mesh.prefetch(t);
                self.found.push(t);
            }
            return;
        }
        if self.seen.is_empty() {
            self.seen.extend(&self.found);
        }
        if self.seen.insert(t) {
            self.found.push(t);
        }
    }
}

impl Iterator for StarWalk<'_> {
    type Item = TetId;

    #[inline]
    fn next(&mut self) -> Option<TetId> {
        let &t = self.found.get(self.next)?;
        self.next += 1;
        let (mesh, v) = (self.mesh, self.v);
        let vertices = mesh.vertices(t);
        for slot in (0..4).filter(|&slot| vertices[slot] != v) {
            self.find(mesh.neighbor(t.corner(slot)));
        }
        Some(t)
    }
}
