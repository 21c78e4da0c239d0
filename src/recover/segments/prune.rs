//! Removal of Steiner points that turned out unnecessary.
//!
//! A Steiner point can be removed if its two neighbours on the segment are then joined by an edge. Its other edges are
//! no subsegments, and the edges around its star stay, so nothing else has to be looked at. Every removal is exact, and
//! the mesh stays the Delaunay tetrahedralization of what is left; no point is left that could be removed alone.
//!
//! Each trial tetrahedralizes the neighbours of one point ([`crate::delaunay::filling`]), unless three of these are
//! seen to obstruct the edge that is to appear ([`super::obstruction`]), as they nearly always do; after a removal
//! those around are tried again.

use super::obstruction::is_obstructed;
use super::recovery::Recovered;
use crate::delaunay::filling;
use crate::mesh::{Incidence, TetId, TetMesh, VertexId};
use crate::predicate::{GrowingStore, PointStore};
use crate::recover::tables::Stamps;

impl Recovered {
    /// Without the Steiner points that are not needed. The others keep their order, and with it the perturbation, but
    /// are numbered anew.
    pub(super) fn pruned<P: GrowingStore>(mut self, points: &mut P) -> Recovered {
        let first = self.subsegments.first_steiner();
        let count = self.subsegments.steiner_count();
        let mut gone = vec![false; count];
        let mut waiting = vec![true; count];
        // A stack: the last one, which was inserted when least was known, comes first.
        let mut stack: Vec<usize> = (0..count).collect();
        let mut star = Star::default();
        while let Some(i) = stack.pop() {
            waiting[i] = false;
            if gone[i] {
                continue;
            }
            let Some(neighbours) = self.remove(points, VertexId::new(first + i), &mut star) else {
                continue;
            };
            gone[i] = true;
            for v in neighbours {
                let Some(j) = v.index().checked_sub(first) else {
                    continue;
                };
                if !gone[j] && !waiting[j] {
                    waiting[j] = true;
                    stack.push(j);
                }
            }
        }
        if gone.contains(&true) {
            self.renumber(points, &gone);
        }
        self
    }

    /// Removes the Steiner point v if its segment does not need it, and returns the vertices around.
    fn remove<P: PointStore>(
        &mut self,
        points: &P,
        v: VertexId,
        star: &mut Star,
    ) -> Option<Vec<VertexId>> {
        let mesh = &mut self.delaunay.mesh;
        let [a, b] = self.subsegments.around(v);
        let tet = self.incidence.tet_at(v);
        star.begin(
            mesh,
            points.len(),
            tet.expect("a Steiner point is in the mesh"),
            [a, b, v],
        );
        // Mostly some of the neighbours are enough.
        let mut enough = FEW;
        loop {
            let all = star.collect(mesh, v, enough);
            if is_obstructed(points, [a, b], &star.link) {
                return None;
            }
            if all {
                break;
            }
            enough *= 2;
        }
        let star = &mut star.tets;
        star.sort_unstable();
        let filling = filling(points, mesh, star, v)?;
        let joins = |t: &[VertexId; 4]| t.contains(&a) && t.contains(&b);
        if !filling.iter().any(joins) {
            return None;
        }
        let created = mesh.replace(star, &filling);
        self.incidence.update(mesh, &created);
        self.subsegments.join_at(v);
        let mut neighbours: Vec<VertexId> = filling
            .into_iter()
            .flatten()
            .filter(|w| !w.is_infinite())
            .collect();
        neighbours.sort_unstable();
        neighbours.dedup();
        Some(neighbours)
    }

    fn renumber<P: GrowingStore>(&mut self, points: &mut P, gone: &[bool]) {
        let first = self.subsegments.first_steiner();
        let ids = self.subsegments.compact(gone);
        points.truncate(first);
        self.subsegments.push_all(points);
        let mesh = &mut self.delaunay.mesh;
        mesh.rename_vertices(|v| match v.index().checked_sub(first) {
            Some(i) => ids[i].expect("the mesh has only vertices that are left"),
            None => v,
        });
        self.incidence = Incidence::new(mesh, points.len());
    }
}

/// Among how many neighbours those that obstruct an edge are looked for first.
const FEW: usize = 8;

/// The tetrahedra at a vertex and its neighbours, as far as they are known. Memory is used again.
#[derive(Default)]
struct Star {
    /// Breadth first.
    tets: Vec<TetId>,
    /// How many of them have been looked at.
    next: usize,
    /// The neighbours, without some.
    link: Vec<VertexId>,
    found: Stamps,
    seen: Stamps,
}

impl Star {
    /// Starts with a tetrahedron; the given vertices do not count. There are ids of vertices below n.
    fn begin(&mut self, mesh: &TetMesh, n: usize, first: TetId, without: [VertexId; 3]) {
        self.tets.clear();
        self.next = 0;
        self.link.clear();
        self.found.clear(mesh.capacity());
        self.found.insert(first.index());
        self.tets.push(first);
        self.seen.clear(n);
        for v in without {
            self.seen.insert(v.index());
        }
        for v in mesh.vertices(first) {
            self.note(v);
        }
    }

    fn note(&mut self, v: VertexId) {
        if !v.is_infinite() && self.seen.insert(v.index()) {
            self.link.push(v);
        }
    }

    /// Goes on around v until there are enough neighbours; whether these are all.
    fn collect(&mut self, mesh: &TetMesh, v: VertexId, enough: usize) -> bool {
        while let Some(&t) = self.tets.get(self.next) {
            if self.link.len() >= enough {
                return false;
            }
            self.next += 1;
            let vertices = mesh.vertices(t);
            for slot in (0..4).filter(|&slot| vertices[slot] != v) {
                let across = mesh.twin(t.corner(slot));
                if self.found.insert(across.tet().index()) {
                    mesh.prefetch(across.tet());
                    self.tets.push(across.tet());
                    self.note(mesh.vertex(across));
                }
            }
        }
        true
    }
}
