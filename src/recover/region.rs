//! The region R of a missing region of a polygon f: the tetrahedra whose interiors f cuts (paper §3).

use super::side::{Side, Sides};
use crate::mesh::{Corner, TetId, TetMesh, VertexId};
use crate::predicate::PointStore;
use rustc_hash::FxHashSet;

/// The crossing tetrahedra of one missing region, connected by crossing triangles.
#[derive(Clone, Debug, Default)]
pub struct Region {
    /// The tetrahedra of R, sorted.
    pub tets: Vec<TetId>,
}

impl Region {
    /// Grows R from one of its tetrahedra. f cannot end inside a tetrahedron, because its edges are edges of the mesh, so
    /// every crossing triangle of a tetrahedron of R leads to another one.
    pub fn grow<P: PointStore>(mesh: &TetMesh, sides: &Sides<P>, seed: TetId) -> Region {
        let mut tets = vec![seed];
        let mut seen: FxHashSet<TetId> = tets.iter().copied().collect();
        let mut next = 0;
        while let Some(&t) = tets.get(next) {
            next += 1;
            for slot in 0..4 {
                let c = t.corner(slot);
                let n = mesh.neighbor(c);
                if !mesh.is_ghost(n) && sides.crosses(&mesh.facet(c)) && seen.insert(n) {
                    tets.push(n);
                }
            }
        }
        tets.sort_unstable();
        Region { tets }
    }

    /// Whether t is in R.
    pub fn contains(&self, t: TetId) -> bool {
        self.tets.binary_search(&t).is_ok()
    }

    /// The crossing triangles between two tetrahedra of R, each once. (If f is flat all of them are; one that is not may
    /// cut through a facet of the convex hull.)
    pub fn crossing_triangles<P: PointStore>(
        &self,
        mesh: &TetMesh,
        sides: &Sides<P>,
    ) -> Vec<Corner> {
        let corners = self
            .tets
            .iter()
            .flat_map(|&t| (0..4).map(move |slot| t.corner(slot)));
        corners
            .filter(|&c| c < mesh.twin(c) && !mesh.is_ghost(mesh.neighbor(c)))
            .filter(|&c| sides.crosses(&mesh.facet(c)))
            .collect()
    }

    /// The crossing edges l–r, l on the left, in order of their first tetrahedron; repeated.
    pub fn crossing_edges<P: PointStore>(
        &self,
        mesh: &TetMesh,
        sides: &Sides<P>,
    ) -> Vec<[VertexId; 2]> {
        let mut edges = Vec::new();
        for &t in &self.tets {
            let v = mesh.vertices(t);
            for l in v.into_iter().filter(|&l| sides.of(l) == Side::Left) {
                edges.extend(
                    v.into_iter()
                        .filter(|&r| sides.of(r) == Side::Right)
                        .map(|r| [l, r]),
                );
            }
        }
        edges
    }

    /// The facets of R's boundary, as corners of its tetrahedra.
    pub fn boundary(&self, mesh: &TetMesh) -> Vec<Corner> {
        let corners = self
            .tets
            .iter()
            .flat_map(|&t| (0..4).map(move |slot| t.corner(slot)));
        corners
            .filter(|&c| !self.contains(mesh.neighbor(c)))
            .collect()
    }
}
