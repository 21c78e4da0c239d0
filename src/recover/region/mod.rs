//! The region R of a missing region of a polygon f: the tetrahedra whose interiors f cuts (paper §3).

mod as_plc;
pub mod missing;
mod sides;
pub mod surface;

pub use as_plc::region_as_plc;
pub use sides::{Side, SideTable, Sides, corners, crossing_facets};

use super::subpolygons::{Face, Subpolygons, face};
use super::tables::Table;
use crate::mesh::{Corner, TetId, TetMesh, VertexId};
use crate::predicate::PointStore;

/// The crossing tetrahedra of one missing region, connected by crossing triangles.
#[derive(Clone, Debug, Default)]
pub struct Region {
    /// The tetrahedra of R, sorted.
    pub tets: Vec<TetId>,
    /// The same as a table.
    marks: Table<bool>,
}

impl Region {
    /// Grows R from one of its tetrahedra. f cannot end inside a tetrahedron, because its edges are edges of the mesh,
    /// so every crossing triangle of a tetrahedron of R leads to another one.
    pub fn grow<P: PointStore>(mesh: &TetMesh, sides: &Sides<P>, seed: TetId) -> Region {
        Region::default().regrown(mesh, sides, seed)
    }

    /// Another region, in the memory of this one.
    pub fn regrown<P: PointStore>(self, mesh: &TetMesh, sides: &Sides<P>, seed: TetId) -> Region {
        let Region {
            mut tets,
            mut marks,
        } = self;
        marks.clear();
        marks.set(seed.index(), true);
        tets.clear();
        tets.push(seed);
        let mut next = 0;
        while let Some(&t) = tets.get(next) {
            next += 1;
            let (vertices, twins) = mesh.tet(t);
            for c in corners(t, sides.crossing_facets(vertices)) {
                let n = twins[c.slot()].tet();
                if !marks.get(n.index()) && !mesh.is_ghost(n) {
                    marks.set(n.index(), true);
                    tets.push(n);
                }
            }
        }
        tets.sort_unstable();
        Region { tets, marks }
    }

    /// The region that consists of the given tetrahedra, sorted.
    pub fn of(tets: Vec<TetId>) -> Region {
        let mut marks = Table::default();
        for t in &tets {
            marks.set(t.index(), true);
        }
        Region { tets, marks }
    }

    /// Whether t is in R.
    #[inline]
    pub fn contains(&self, t: TetId) -> bool {
        self.marks.get(t.index())
    }

    /// The crossing triangles between two tetrahedra of R, each once. (If f is flat all of them are; one that is not
    /// may cut through a facet of the convex hull.)
    pub fn crossing_triangles<P: PointStore>(
        &self,
        mesh: &TetMesh,
        sides: &Sides<P>,
    ) -> Vec<Corner> {
        let mut triangles = Vec::with_capacity(2 * self.tets.len());
        for &t in &self.tets {
            let (vertices, twins) = mesh.tet(t);
            for c in corners(t, sides.crossing_facets(vertices)) {
                if c < twins[c.slot()] && !mesh.is_ghost(twins[c.slot()].tet()) {
                    triangles.push(c);
                }
            }
        }
        triangles
    }

    /// The crossing edges l–r, l on the left, in order of their first tetrahedron; repeated.
    pub fn crossing_edges<'a, P: PointStore>(
        &'a self,
        mesh: &'a TetMesh,
        sides: &'a Sides<P>,
    ) -> impl Iterator<Item = [VertexId; 2]> + 'a {
        self.tets.iter().flat_map(move |&t| {
            let v = mesh.vertices(t);
            let [left, right] = sides.left_and_right(&v);
            let ends = move |set: u8| corners(t, set).map(move |c| v[c.slot()]);
            ends(left).flat_map(move |l| ends(right).map(move |r| [l, r]))
        })
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

    /// The subpolygons between two tetrahedra of R.
    pub fn inner_subpolygons(&self, mesh: &TetMesh, subpolygons: &Subpolygons) -> Vec<Face> {
        if subpolygons.is_empty() {
            return Vec::new();
        }
        let corners = self
            .tets
            .iter()
            .flat_map(|&t| (0..4).map(move |slot| t.corner(slot)));
        corners
            .filter(|&c| c < mesh.twin(c) && self.contains(mesh.neighbor(c)))
            .map(|c| face(mesh.facet(c)))
            .filter(|t| subpolygons.contains_key(t))
            .collect()
    }
}
