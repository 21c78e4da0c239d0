//! The tetrahedral mesh: topology alone. Nothing here knows a coordinate or a number type.

mod canonical;
mod check;
mod flip;
mod ids;
mod incidence;
mod least;
mod marks;
mod parts;
mod replace;
mod topology;

pub(crate) use canonical::{canonical_face, canonical_tet};
#[doc(hidden)]
pub use check::TopologyError;
pub(crate) use flip::behind;
pub use ids::VertexId;
pub(crate) use ids::any_infinite;
#[doc(hidden)]
pub use ids::{Corner, TetId};
#[doc(hidden)]
pub use incidence::Incidence;
pub(crate) use least::{Groups, SimplexIndex, sort_by_least};
pub(crate) use parts::{WALL, is_wall};
pub(crate) use topology::slot_of;
#[doc(hidden)]
pub use topology::{FACET, NEXT, TetMesh};

#[cfg(test)]
impl TetMesh {
    /// The finite tetrahedra by their vertices in ascending order, sorted: equal for equal tetrahedralizations.
    pub(crate) fn sorted_tets(&self) -> Vec<[VertexId; 4]> {
        let ascending = |t| {
            let mut v = self.vertices(t);
            v.sort_unstable();
            v
        };
        let mut tets: Vec<[VertexId; 4]> = self.finite().map(ascending).collect();
        tets.sort_unstable();
        tets
    }
}
