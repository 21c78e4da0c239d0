//! The tetrahedra and their adjacency (after Boissonnat, Devillers, Pion, Teillaud & Yvinec 2002; corners after
//! Attene's layout).
//!
//! Conventions of the whole crate: positive means det[b−a, c−a, d−a] > 0; every stored finite tetrahedron is positive;
//! facet `i` of a tetrahedron is opposite its vertex `i`.
//!
//! Invariants: `twin(twin(c)) == c`; `c` and `twin(c)` see the same three vertices, in opposite order; a hull facet is
//! closed by a ghost tetrahedron with one infinite vertex, so that every facet has exactly two tetrahedra.
//!
//! Memory: 32 bytes per tetrahedron, that is 16 for the vertices and 16 for the twins, each with its slot in the two
//! low bits; a mark, for the search of an insertion, is one bit of the first vertex.

use super::{Corner, TetId, VertexId, any_infinite};
use crate::machine::prefetch;
use rayon::prelude::*;

/// `FACET[i]` completes `i` to an even permutation of 0123, so `[i, FACET[i]..]` keeps orientation.
pub const FACET: [[usize; 3]; 4] = [[1, 2, 3], [0, 3, 2], [3, 0, 1], [1, 0, 2]];

/// `NEXT[i][j] = k` where `ijkl` is even: leave through facet `k` to turn around the edge i→j.
pub const NEXT: [[usize; 4]; 4] = [[4, 2, 3, 1], [3, 4, 0, 2], [1, 3, 4, 0], [2, 0, 1, 4]];

/// A tetrahedralization of a closed 3-sphere: finite tetrahedra and ghosts. See the module's invariants.
#[derive(Clone, Debug, Default)]
pub struct TetMesh {
    pub(super) tets: Vec<Tet>,
    pub(super) free: Vec<TetId>,
}

/// Vertices and twins side by side: a step across a facet touches one cache line.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub(super) struct Tet {
    pub(super) vertices: [VertexId; 4],
    pub(super) twins: [Corner; 4],
}

/// Several threads are only worth starting for so many tetrahedra.
const MANY: usize = 1 << 17;

/// A removed tetrahedron, until its id is used again.
pub(super) const DEAD: [VertexId; 4] = [VertexId::INFINITE; 4];

impl TetMesh {
    /// An empty mesh.
    pub fn new() -> TetMesh {
        TetMesh::default()
    }

    /// Room for `n` tetrahedra without further allocation.
    pub fn reserve(&mut self, n: usize) {
        self.tets.reserve(n);
    }

    /// Removes everything, keeping the memory.
    pub fn clear(&mut self) {
        self.tets.clear();
        self.free.clear();
    }

    /// One more than the largest id in use: the length of a side table indexed by [`TetId`].
    #[inline]
    pub fn capacity(&self) -> usize {
        self.tets.len()
    }

    /// The number of tetrahedra, ghosts included.
    pub fn len(&self) -> usize {
        self.tets.len() - self.free.len()
    }

    /// Whether there is no tetrahedron.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// All tetrahedra, ghosts included, in order of id.
    pub fn all(&self) -> impl Iterator<Item = TetId> + '_ {
        (0..self.tets.len())
            .map(TetId::new)
            .filter(|&t| self.is_alive(t))
    }

    /// The finite tetrahedra, in order of id.
    pub fn finite(&self) -> impl Iterator<Item = TetId> + '_ {
        self.all().filter(|&t| !self.is_ghost(t))
    }

    /// The four vertices.
    #[inline]
    pub fn vertices(&self, t: TetId) -> [VertexId; 4] {
        self.tets[t.index()].vertices
    }

    /// The four vertices, and what lies across the facets opposite to them: one cache line.
    #[inline]
    pub fn tet(&self, t: TetId) -> (&[VertexId; 4], &[Corner; 4]) {
        let Tet { vertices, twins } = &self.tets[t.index()];
        (vertices, twins)
    }

    /// Whether `t` is in the mesh.
    #[inline]
    pub fn is_alive(&self, t: TetId) -> bool {
        self.tets[t.index()].vertices != DEAD
    }

    /// Whether `t` has the infinite vertex.
    #[inline]
    pub fn is_ghost(&self, t: TetId) -> bool {
        any_infinite(self.tets[t.index()].vertices)
    }

    /// The vertex at corner `c`.
    #[inline]
    pub fn vertex(&self, c: Corner) -> VertexId {
        self.tets[c.tet().index()].vertices[c.slot()]
    }

    /// The three vertices of the facet opposite `c`; with the vertex at `c` in front they keep the orientation.
    #[inline]
    pub fn facet(&self, c: Corner) -> [VertexId; 3] {
        let v = &self.tets[c.tet().index()].vertices;
        let [i, j, k] = FACET[c.slot()];
        [v[i], v[j], v[k]]
    }

    /// The same facet seen from the other side: the corner of the neighbour that is opposite to it.
    #[inline]
    pub fn twin(&self, c: Corner) -> Corner {
        self.tets[c.tet().index()].twins[c.slot()]
    }

    /// The neighbour across the facet opposite `c`.
    #[inline]
    pub fn neighbor(&self, c: Corner) -> TetId {
        self.twin(c).tet()
    }

    /// The vertex of the neighbour across the facet opposite `c` that is not on that facet.
    #[inline]
    pub fn apex_across(&self, c: Corner) -> VertexId {
        self.vertex(self.twin(c))
    }

    /// The slot of `v` in `t`, if it is a vertex of `t`.
    #[inline]
    pub fn slot_of(&self, t: TetId, v: VertexId) -> Option<usize> {
        self.tets[t.index()].vertices.iter().position(|&w| w == v)
    }

    /// The corner of `t` at `v`, a vertex of `t`.
    #[inline]
    pub fn corner_of(&self, t: TetId, v: VertexId) -> Corner {
        t.corner(slot_of(&self.tets[t.index()].vertices, v))
    }

    /// Whether `t` has all of the given vertices.
    #[inline]
    pub fn has_vertices(&self, t: TetId, vertices: &[VertexId]) -> bool {
        vertices.iter().all(|&v| self.slot_of(t, v).is_some())
    }

    /// The tetrahedra around the directed edge a→b, starting with `t`, each left through the facet that `NEXT` names.
    pub fn around(&self, t: TetId, a: VertexId, b: VertexId) -> impl Iterator<Item = TetId> + '_ {
        let next =
            move |&s: &TetId| Some(self.neighbor(self.exit_around(s, a, b))).filter(|&n| n != t);
        std::iter::successors(Some(t), next)
    }

    /// The facet of `t` through which one leaves it when turning around its edge a→b in positive sense.
    #[inline]
    pub fn exit_around(&self, t: TetId, a: VertexId, b: VertexId) -> Corner {
        let i = self.slot_of(t, a).expect("a is a vertex of t");
        let j = self.slot_of(t, b).expect("b is a vertex of t");
        t.corner(NEXT[i][j])
    }

    /// A new tetrahedron, not glued to anything yet.
    #[inline]
    pub fn add(&mut self, vertices: [VertexId; 4]) -> TetId {
        let tet = Tet {
            vertices,
            twins: [Corner::NONE; 4],
        };
        if let Some(t) = self.free.pop() {
            self.tets[t.index()] = tet;
            return t;
        }
        let t = TetId::new(self.tets.len());
        assert!(t.0 < 1 << 30, "fewer than 2^30 tetrahedra");
        self.tets.push(tet);
        t
    }

    /// Removes `t`. The facets of its neighbours still name it, until they are glued anew.
    #[inline]
    pub fn remove(&mut self, t: TetId) {
        self.tets[t.index()].vertices = DEAD;
        self.free.push(t);
    }

    /// Gives every finite vertex a new id.
    pub fn rename_vertices(&mut self, new_id: impl Fn(VertexId) -> VertexId + Sync) {
        let rename = |tet: &mut Tet| {
            for v in &mut tet.vertices {
                if !v.is_infinite() {
                    *v = new_id(*v);
                }
            }
        };
        if self.tets.len() < MANY {
            self.tets.iter_mut().for_each(rename);
        } else {
            self.tets
                .par_iter_mut()
                .with_min_len(MANY / 8)
                .for_each(rename);
        }
    }

    /// Declares that `c` and `d` are the two sides of one facet.
    #[inline]
    pub fn glue(&mut self, c: Corner, d: Corner) {
        self.tets[c.tet().index()].twins[c.slot()] = d;
        self.tets[d.tet().index()].twins[d.slot()] = c;
    }

    /// Lets the processor fetch the neighbours of `t`, which will be looked at soon.
    #[inline]
    pub(crate) fn prefetch_neighbors(&self, t: TetId) {
        for twin in self.tets[t.index()].twins {
            prefetch(&self.tets, twin.tet().index());
        }
    }

    /// Lets the processor fetch `t`, which will be looked at soon.
    #[inline]
    pub(crate) fn prefetch(&self, t: TetId) {
        prefetch(&self.tets, t.index());
    }

    /// Gives `t` new vertices and lets its facets name `twins` without the converse.
    #[inline]
    pub(crate) fn overwrite(&mut self, t: TetId, vertices: [VertexId; 4], twins: [Corner; 4]) {
        self.tets[t.index()] = Tet { vertices, twins };
    }

    /// Lets `c` name `d` without the converse.
    #[inline]
    pub(crate) fn set_twin(&mut self, c: Corner, d: Corner) {
        self.tets[c.tet().index()].twins[c.slot()] = d;
    }

    /// Gives `t` new vertices and what lies across its facets, which is told the converse.
    #[inline]
    pub(super) fn put(&mut self, t: TetId, vertices: [VertexId; 4], across: [Corner; 4]) {
        self.tets[t.index()] = Tet {
            vertices,
            twins: across,
        };
        for (slot, c) in across.into_iter().enumerate() {
            self.tets[c.tet().index()].twins[c.slot()] = t.corner(slot);
        }
    }
}

/// The slot of `v`, one of the four vertices. Without branches: this is asked in the innermost loops, and cannot be
/// predicted.
#[inline(always)]
pub(crate) fn slot_of(vertices: &[VertexId; 4], v: VertexId) -> usize {
    debug_assert!(vertices.contains(&v), "v is one of the vertices");
    // Written out, as in all such loops: array::map is not always inlined.
    let [_, b, c, d] = *vertices;
    (usize::from(b == v) | usize::from(c == v) << 1 | (3 * usize::from(d == v))) & 3
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parity(p: [usize; 4]) -> bool {
        let inversions = (0..4).flat_map(|i| (i + 1..4).map(move |j| (i, j)));
        inversions.filter(|&(i, j)| p[i] > p[j]).count() % 2 == 0
    }

    #[test]
    fn tables_are_even_permutations() {
        for i in 0..4 {
            let [j, k, l] = FACET[i];
            assert!(parity([i, j, k, l]));
            for j in (0..4).filter(|&j| j != i) {
                let k = NEXT[i][j];
                assert!(parity([i, j, k, 6 - i - j - k]));
            }
        }
    }

    fn ids<const N: usize>(v: [u32; N]) -> [VertexId; N] {
        v.map(VertexId)
    }

    /// The boundary of a 4-simplex: five tetrahedra, one of them taken as the ghost.
    fn sphere() -> TetMesh {
        let mut mesh = TetMesh::new();
        let seed = mesh.add(ids([0, 1, 2, 3]));
        let mirror = mesh.add(ids([1, 0, 2, 3]));
        for slot in 0..4 {
            let c = seed.corner(slot);
            let d = mesh.corner_of(mirror, mesh.vertex(c));
            mesh.glue(c, d);
        }
        let with_infinity = |slot: usize| {
            let mut v = mesh.vertices(mirror);
            v[slot] = VertexId::INFINITE;
            v
        };
        let ghosts = [0, 1, 2, 3].map(with_infinity);
        mesh.replace(&[mirror], &ghosts);
        mesh
    }

    #[test]
    fn replace_keeps_the_invariants() {
        let mesh = sphere();
        assert_eq!(mesh.check(), Ok(()));
        assert_eq!(mesh.len(), 5);
        let t = mesh.finite().next().expect("one finite tetrahedron");
        assert_eq!(mesh.around(t, VertexId(0), VertexId(1)).count(), 3);
    }
}
