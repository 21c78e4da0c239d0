//! Changes to a CDT that is there: what is inserted into it or deleted from it, with the time depending on the part of
//! the mesh that changes, not on its size.

mod delete_polygon;

pub use delete_polygon::DeletionCounts;
pub(crate) use delete_polygon::PolygonDeletion;
