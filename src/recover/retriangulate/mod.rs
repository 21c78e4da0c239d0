//! New tetrahedra for the region R of a polygon, all at once: by cavities or by gift wrapping.

mod boundary;
pub mod cavity;
pub mod gift_wrap;
mod visibility;

use super::subpolygons::Face;
use crate::mesh::{Corner, TetId, TetMesh, VertexId};

/// A retriangulation of R and of what the cavities swallowed, ready to be put into the mesh.
#[derive(Clone, Debug)]
pub struct Retriangulation {
    /// The tetrahedra to remove, sorted.
    pub old: Vec<TetId>,
    /// The tetrahedra that take their place.
    pub new: Vec<[VertexId; 4]>,
    /// What lies across their facets, if that is known.
    pub gluing: Option<Gluing>,
    /// The triangles of f.
    pub faces: Vec<[VertexId; 3]>,
    /// The triangles of other polygons that vanish.
    pub displaced: Vec<Face>,
    /// How many tetrahedra the cavities swallowed.
    pub swallowed: usize,
}

/// What lies across the facets of new tetrahedra, which are named by their indices instead of ids.
#[derive(Clone, Debug)]
pub struct Gluing {
    /// Other new tetrahedra, or none.
    pub across: Vec<[Corner; 4]>,
    /// The other corners of new tetrahedra, each with that of a tetrahedron that stays in the mesh.
    pub outside: Vec<(Corner, Corner)>,
}

impl Retriangulation {
    /// Puts the new tetrahedra into the place of the old ones. Returns their ids, in order.
    pub fn put_into(&self, mesh: &mut TetMesh) -> Vec<TetId> {
        debug_assert!(mesh.can_replace(&self.old, &self.new));
        let Some(gluing) = &self.gluing else {
            return mesh.replace(&self.old, &self.new);
        };
        for &t in &self.old {
            mesh.remove(t);
        }
        let ids: Vec<TetId> = self.new.iter().map(|&v| mesh.add(v)).collect();
        let corner = |c: Corner| ids[c.tet().index()].corner(c.slot());
        for (&t, across) in ids.iter().zip(&gluing.across) {
            for (slot, &across) in across.iter().enumerate() {
                if across != Corner::NONE {
                    mesh.set_twin(t.corner(slot), corner(across));
                }
            }
        }
        for &(new, old) in &gluing.outside {
            mesh.glue(corner(new), old);
        }
        ids
    }
}
