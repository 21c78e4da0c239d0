//! Tables in which elements of the mesh and of facets are looked up: faces and edges by vertices, tetrahedra and
//! cells by points.

pub(crate) mod area;
pub(crate) mod boxes;
pub(crate) mod directions;
pub(crate) mod gather;
pub(crate) mod locate;
pub(crate) mod places;
pub(crate) mod slabs;
pub(crate) mod spheres;
pub(crate) mod surface;
pub(crate) mod sweep;
pub(crate) mod tables;
