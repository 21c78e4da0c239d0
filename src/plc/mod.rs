//! Piecewise linear complexes: what a user gives ([`Plc`], paper §2), and what the algorithms take ([`Complex`]).

mod build;
mod complex;
mod crossing;
mod error;
mod facet;
mod frame;
mod merge;
mod plane;
mod subdivision;
mod triangulate;
mod types;

pub use complex::{Complex, Polygon};
pub use error::{EdgeName, FacetName, PlcError, VertexName};
pub use types::{Facet, Plc, Region, Segment};
