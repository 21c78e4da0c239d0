//! tetflip: constrained Delaunay tetrahedralizations (CDTs) of piecewise linear complexes (PLCs), after
//! Si & Shewchuk, *Incrementally Constructing and Updating Constrained Delaunay Tetrahedralizations with Finite
//! Precision Coordinates*.

pub mod cdt;
pub mod delaunay;
pub mod error;
pub mod format;
pub mod mesh;
pub mod number;
pub mod plc;
pub mod predicate;
pub mod recover;
pub mod report;
pub mod verify;
