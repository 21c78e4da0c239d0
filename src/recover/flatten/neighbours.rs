//! The edges of the Delaunay tetrahedralization at the vertices of polygons that are cut.
//!
//! A vertex is on several polygons, and may be the hub of very many edges: its star is walked once, and again only
//! after it has changed. Linear in the stars that are asked for.

use crate::mesh::{Incidence, TetId, TetMesh, VertexId};
use rustc_hash::FxHashSet;

/// For each vertex that was asked for, its neighbours of greater id.
#[derive(Default)]
pub(super) struct Neighbours {
    of: Vec<Option<Box<[VertexId]>>>,
    /// The round in which a tetrahedron was last seen, and a vertex.
    seen_tets: Vec<u32>,
    seen: Vec<u32>,
    round: u32,
    /// Memory used again.
    open: Vec<TetId>,
    found: Vec<VertexId>,
}

impl Neighbours {
    /// To be called with all vertices whose stars have changed.
    pub(super) fn forget(&mut self, touched: &FxHashSet<VertexId>) {
        for v in touched {
            if let Some(list) = self.of.get_mut(v.index()) {
                *list = None;
            }
        }
    }

    /// The finite neighbours of v with greater ids, ascending.
    pub(super) fn of(&mut self, mesh: &TetMesh, incidence: &Incidence, v: VertexId) -> &[VertexId] {
        if self.of.len() <= v.index() {
            self.of.resize(v.index() + 1, None);
        }
        if self.of[v.index()].is_none() {
            self.of[v.index()] = Some(self.walk(mesh, incidence, v));
        }
        self.of[v.index()].as_deref().expect("it has been walked")
    }

    fn walk(&mut self, mesh: &TetMesh, incidence: &Incidence, v: VertexId) -> Box<[VertexId]> {
        if self.seen_tets.len() < mesh.capacity() {
            self.seen_tets.resize(mesh.capacity(), 0);
        }
        self.round += 1;
        let round = self.round;
        self.found.clear();
        self.open.clear();
        if let Some(t) = incidence.tet_at(v) {
            self.seen_tets[t.index()] = round;
            self.open.push(t);
        }
        // First in, first out: what has been found is on its way from memory meanwhile.
        let mut next = 0;
        while let Some(&t) = self.open.get(next) {
            next += 1;
            let vertices = mesh.vertices(t);
            for (slot, &w) in vertices.iter().enumerate() {
                if w == v {
                    continue;
                }
                let n = mesh.neighbor(t.corner(slot));
                if std::mem::replace(&mut self.seen_tets[n.index()], round) != round {
                    mesh.prefetch(n);
                    self.open.push(n);
                }
                if w < v || w.is_infinite() {
                    continue;
                }
                if self.seen.len() <= w.index() {
                    self.seen.resize(w.index() + 1, 0);
                }
                if std::mem::replace(&mut self.seen[w.index()], round) != round {
                    self.found.push(w);
                }
            }
        }
        self.found.sort_unstable();
        Box::from(&self.found[..])
    }
}
