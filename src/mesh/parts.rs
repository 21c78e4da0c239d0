//! A mesh in parts that can be changed independently, each by a thread of its own.
//!
//! In the mesh of a part, the tetrahedron [`WALL`], without vertices, stands for all those of other parts: what lies
//! across the facets of the interface is its first corner. Invariant, left to whoever changes a part: a tetrahedron
//! that has such a facet stays as it is. Then the parts fit together again whatever else has been done to them.

use super::topology::{DEAD, Tet};
use super::{Corner, TetId, TetMesh, VertexId};
use rayon::prelude::*;

/// What stands for the tetrahedra of other parts.
pub(crate) const WALL: TetId = TetId(0);

/// Whether these are the vertices of [`WALL`].
#[inline]
pub(crate) fn is_wall(vertices: [VertexId; 4]) -> bool {
    vertices == DEAD
}

/// The facets between parts, each as its two corners with their parts.
pub(crate) struct Interface(Vec<[(u32, Corner); 2]>);

impl TetMesh {
    /// Divides the mesh: `part` tells where a tetrahedron with the given vertices goes. `room` is for how many
    /// tetrahedra each part needs memory.
    pub(crate) fn split(
        self,
        room: &[usize],
        part: impl Fn([VertexId; 4]) -> usize,
    ) -> (Vec<TetMesh>, Interface) {
        let empty = |&room: &usize| {
            let mut tets = Vec::with_capacity(room);
            tets.push(Tet {
                vertices: DEAD,
                twins: [Corner::NONE; 4],
            });
            TetMesh {
                tets,
                free: Vec::new(),
            }
        };
        let mut parts: Vec<TetMesh> = room.iter().map(empty).collect();
        let mut places = vec![(u32::MAX, WALL); self.capacity()];
        for t in self.all() {
            let k = part(self.vertices(t));
            places[t.index()] = (k as u32, parts[k].add(self.vertices(t)));
        }
        let mut interface = Vec::new();
        for t in self.all() {
            let (k, here) = places[t.index()];
            for slot in 0..4 {
                let twin = self.twin(t.corner(slot));
                let (other, there) = places[twin.tet().index()];
                let there = there.corner(twin.slot());
                let c = here.corner(slot);
                if other == k {
                    parts[k as usize].set_twin(c, there);
                    continue;
                }
                parts[k as usize].set_twin(c, WALL.corner(0));
                if t < twin.tet() {
                    interface.push([(k, c), (other, there)]);
                }
            }
        }
        (parts, Interface(interface))
    }

    /// The inverse of [`TetMesh::split`].
    pub(crate) fn unite(parts: Vec<TetMesh>, interface: &Interface) -> TetMesh {
        let mut parts = parts.into_iter();
        let mut whole = parts.next().expect("there is a part");
        whole.free.push(WALL);
        let mut shifts = vec![0];
        for part in parts {
            // Its wall stays behind.
            let shift = whole.tets.len() as u32 - 1;
            let moved = part.tets[1..].par_iter().map(|tet| Tet {
                vertices: tet.vertices,
                twins: tet.twins.map(|c| Corner(c.0.wrapping_add(4 * shift))),
            });
            whole.tets.par_extend(moved);
            assert!(whole.tets.len() <= 1 << 30, "fewer than 2^30 tetrahedra");
            let free = part.free.iter().map(|t| TetId(t.0 + shift));
            whole.free.extend(free);
            shifts.push(shift);
        }
        for &sides in &interface.0 {
            let [c, d] = sides.map(|(part, c)| Corner(c.0 + 4 * shifts[part as usize]));
            whole.glue(c, d);
        }
        whole
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Divides a tetrahedron by a vertex inside, the pieces by others, and so on. (Combinatorics only.)
    fn divided(vertices: u32) -> TetMesh {
        let mut mesh = TetMesh::new();
        let seed = [0, 1, 2, 3].map(VertexId);
        let inner = mesh.add(seed);
        let [a, b, c, d] = seed;
        let outer = mesh.add([b, a, c, d]);
        for (slot, v) in seed.into_iter().enumerate() {
            mesh.glue(inner.corner(slot), mesh.corner_of(outer, v));
        }
        for v in (4..vertices).map(VertexId) {
            let all: Vec<TetId> = mesh.all().collect();
            let t = all[v.0 as usize * 7919 % all.len()];
            let pieces = [0, 1, 2, 3].map(|slot: usize| {
                let mut piece = mesh.vertices(t);
                piece[slot] = v;
                piece
            });
            mesh.replace(&[t], &pieces);
        }
        mesh
    }

    #[test]
    fn parts_fit_together_again() {
        let mesh = divided(300);
        assert_eq!(mesh.check(), Ok(()));
        let expected = mesh.sorted_tets();
        let (parts, interface) = mesh.split(&[0; 3], |v| v[1].0 as usize % 3);
        assert!(!interface.0.is_empty());
        // Each part has only its own tetrahedra, and its wall.
        let tets: usize = parts.iter().map(|part| part.finite().count()).sum();
        assert_eq!(tets, expected.len());
        assert!(parts.iter().all(|part| is_wall(part.vertices(WALL))));
        let mesh = TetMesh::unite(parts, &interface);
        assert_eq!(mesh.check(), Ok(()));
        assert_eq!(mesh.sorted_tets(), expected);
    }
}
