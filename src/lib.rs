//! tetflip: constrained Delaunay tetrahedralizations (CDTs) of piecewise linear complexes (PLCs), after
//! Si & Shewchuk, *Incrementally Constructing and Updating Constrained Delaunay Tetrahedralizations with Finite
//! Precision Coordinates*. Polygons are inserted by cavity retriangulation, by gift wrapping, or by bistellar flips,
//! whose order is exact or, to reproduce the paper, rounded.
//!
//! ```text
//! file ── format ──▶ Plc ── plc ──▶ Complex ── delaunay ──▶ Delaunay of the vertices
//!                                                             │ recover::segments (Steiner points)
//!                                                             ▼
//!                                                  recover::polygons: cavity | gift wrapping | flips
//!                                                             │ recover::domain
//!                                                             ▼
//! files ◀── format ── ExportedMesh ◀───────────────── cdt::Cdt::export
//!                          └──▶ verify: Plc + ExportedMesh ──▶ Verdict (exact, by its own means)
//! ```
//!
//! [`mesh`](fn@mesh) is all of it in one call; [`cdt`] is that picture as code, one call per phase. At the bottom are
//! `number`, which knows no mesh, and `mesh` (topology alone), which knows no number. `predicate` has the signs of
//! points, which it names by the ids of the mesh; `delaunay` and `recover` build on all three. `ARCHITECTURE.md` draws
//! the layers.
//!
//! Every sign that decides anything is exact, for all finite doubles. The library neither panics on user input nor
//! prints: bad input and an algorithm that gave up are values ([`error::Failure`]); counts, seconds and notes are a
//! struct ([`report::Report`]).
//!
//! Work on many vertices, tetrahedra or lines is shared by all threads of the current [`rayon`] pool. The results do
//! not depend on their number.
//!
//! # Example
//!
//! ```
#![doc = include_str!("../examples/cube.rs")]
//! ```

pub mod cdt;
pub mod check;
pub mod delaunay;
pub mod error;
pub mod exchange;
pub mod format;
pub mod generate;
#[allow(unsafe_code)]
mod machine;
pub mod mesh;
pub mod number;
pub mod repair;
pub mod report;
mod threads;
pub mod verify;

// What the experiments and the tests look into: not for users, and without promises. What users need of it is exported
// again by `cdt`, `error` and `report`.
#[doc(hidden)]
pub mod clock;
#[doc(hidden)]
pub mod kinetic;
#[doc(hidden)]
pub mod lab;
#[doc(hidden)]
pub mod plc;
#[doc(hidden)]
pub mod predicate;
#[doc(hidden)]
pub mod recover;
#[doc(hidden)]
pub mod update;

pub use cdt::mesh;
