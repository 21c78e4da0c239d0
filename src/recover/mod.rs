//! From the Delaunay tetrahedralization of a PLC's vertices to its CDT: segments, then polygons, one missing region at
//! a time, then inside and outside.

pub mod cavity;
mod crossings;
pub mod deletion;
pub mod domain;
pub mod dump;
pub mod embedding;
pub mod flatten;
pub mod flips;
pub mod gift_wrap;
mod graft;
mod harmless;
mod judge;
pub mod method;
pub mod missing;
mod obstruction;
pub mod polygons;
mod prune;
mod race;
mod reach;
mod recovery;
mod refusal;
pub mod region;
pub mod rounding;
pub mod scout;
pub mod scratch;
mod segment_index;
pub mod segments;
pub mod side;
mod sight;
pub mod split;
pub mod subsegments;
mod turn;
pub mod walls;
