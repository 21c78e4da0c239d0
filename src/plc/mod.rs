//! Piecewise linear complexes: what a user gives ([`Plc`](crate::exchange::Plc), paper §2), and what the algorithms
//! take ([`Complex`]).

mod build;
mod complex;
mod crossing;
mod error;
mod faces;
mod facet;
mod flatness;
mod frame;
mod merge;
mod merge_near;
mod open;
mod plane;
mod subdivision;
mod triangulate;

pub(crate) use build::{loose_edges, merged_polygons, representatives};
pub use complex::{Complex, Polygon};
pub(crate) use crossing::has_conflict;
pub use error::{EdgeName, FacetName, PlcError, VertexName};
pub(crate) use faces::{Face, Faces};
pub(crate) use facet::{FacetInput, sorted, undirected};
pub use flatness::FlatnessRule;
pub(crate) use frame::choose as choose_frame;
pub use merge_near::MergeCounts;
pub(crate) use plane::{Projected, Projection, in_box, on_segment, orient2d, orient3d};
pub(crate) use subdivision::by_angle;
pub(crate) use triangulate::triangles_of;
