//! Piecewise linear complexes: what a user gives ([`Plc`], paper §2), and what the algorithms take ([`Complex`]).

mod build;
mod complex;
mod crossing;
mod error;
mod facet;
mod frame;
mod merge;
mod open;
mod plane;
mod subdivision;
mod triangulate;

pub(crate) use build::representatives;
pub use complex::{Complex, Polygon};
pub use error::{EdgeName, FacetName, PlcError, VertexName};
pub(crate) use facet::{FacetInput, undirected};
pub(crate) use plane::{Projected, Projection, in_box, on_segment, orient2d, orient3d};
