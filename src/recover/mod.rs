//! From the Delaunay tetrahedralization of a PLC's vertices to its CDT: segments, then polygons, one missing region at
//! a time, then inside and outside.
//!
//! Each module uses only those above it in this list:
//!
//! - [`tables`], [`method`], [`subpolygons`]: what the others share.
//! - [`segments`]: Steiner points until every segment is a chain of edges.
//! - [`flatten`]: polygons that are flat only to rounding, in pieces that are exactly flat, or fit as they are.
//! - [`region`]: which parts of a polygon are missing, and the tetrahedra that it cuts there.
//! - [`retriangulate`]: new tetrahedra for a region, by cavities or by gift wrapping.
//! - [`flips`]: new tetrahedra for a region, by flips.
//! - `workspace`: what polygons are inserted into and deleted from.
//! - [`polygons`]: all polygons, by any of these.
//! - [`domain`]: which tetrahedra are inside.
//! - [`output`]: what is checked and changed before the mesh is exported.

pub mod domain;
pub mod flatten;
pub mod flips;
pub mod method;
pub mod output;
pub mod polygons;
pub mod region;
pub mod retriangulate;
pub mod segments;
pub mod subpolygons;
pub mod tables;
pub(crate) mod workspace;
