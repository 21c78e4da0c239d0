//! Why a polygon was not deleted.

use super::{Names, displays_with_ids};
use crate::exchange::Plc;
use crate::mesh::VertexId;

/// Why a polygon was not deleted. The mesh has the tetrahedra that it had.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum DeletionRefused {
    /// The complex has no polygon of this index.
    NoSuchPolygon(usize),
    /// The polygon is not in the mesh: it has not been inserted, or has been deleted already.
    NotInserted {
        /// The facets of the polygon.
        facets: Vec<usize>,
    },
    /// There is no CDT of these vertices without the polygon, but with the other constraints.
    NoCdt {
        /// The facets of the polygon.
        facets: Vec<usize>,
        /// What shows it.
        obstacle: Obstacle,
    },
    /// The polygon is flat only to rounding, and flips do not lead to a CDT without it. There may be one.
    NotFlat {
        /// The facets of the polygon.
        facets: Vec<usize>,
        /// Where they failed.
        obstacle: Obstacle,
    },
}

/// What is in the way of a deletion.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Obstacle {
    /// This segment, given by its ends, or a part of it would have to vanish.
    Segment([VertexId; 2]),
    /// A triangle of the polygon made of these facets would have to vanish.
    Polygon(Vec<usize>),
    /// The tetrahedra around this triangle, which is not locally Delaunay, cannot be flipped.
    NoFlip([VertexId; 3]),
    /// This triangle would not be locally Delaunay, and it is not its turn to be flipped.
    TooLate([VertexId; 3]),
}

impl DeletionRefused {
    /// The message, with vertices and facets numbered as in the user's file.
    pub fn describe(&self, plc: &Plc) -> String {
        self.text(Names::of(plc))
    }

    fn text(&self, names: Names) -> String {
        match self {
            DeletionRefused::NoSuchPolygon(index) => format!("there is no polygon {index}"),
            DeletionRefused::NotInserted { facets } => format!(
                "the polygon made of {} is not in the mesh",
                names.facets(facets)
            ),
            DeletionRefused::NoCdt { facets, obstacle } => format!(
                "without the polygon made of {} there is no CDT: {}",
                names.facets(facets),
                obstacle.text(names)
            ),
            DeletionRefused::NotFlat { facets, obstacle } => format!(
                "the polygon made of {} is not exactly flat, and flips cannot delete it: {}",
                names.facets(facets),
                obstacle.text(names)
            ),
        }
    }
}

impl Obstacle {
    fn text(&self, names: Names) -> String {
        match self {
            Obstacle::Segment(ends) => {
                format!("it holds the segment {} in place", names.edge(*ends))
            }
            Obstacle::Polygon(facets) => {
                format!(
                    "it holds the polygon made of {} in place",
                    names.facets(facets)
                )
            }
            Obstacle::NoFlip(t) => {
                format!("the triangle {} cannot be flipped", names.triangle(*t))
            }
            Obstacle::TooLate(t) => format!(
                "the triangle {} would not be locally Delaunay",
                names.triangle(*t)
            ),
        }
    }
}

displays_with_ids!(DeletionRefused);
displays_with_ids!(Obstacle);
