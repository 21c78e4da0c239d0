//! Piecewise linear complexes: what a user gives (paper §2).

mod complex;
mod types;

pub use complex::{Complex, Polygon};
pub use types::{Facet, Plc, Region, Segment};
