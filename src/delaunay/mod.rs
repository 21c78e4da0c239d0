//! Incremental Delaunay tetrahedralization (Bowyer 1981, Watson 1981; paper §3.3): locate by walking, find the conflict
//! zone, replace it by the star of the new vertex.
//!
//! Because insphere is perturbed and never zero, the result is *the* Delaunay tetrahedralization of the vertex set: it
//! does not depend on the order of insertion, and lattices and cospherical sets need no special case. Perturbing
//! weights alone suffices: if p lies on the plane of a facet between two tetrahedra, both insphere signs reduce to the
//! same in-circle sign in that plane, so the conflict zone never has p on the plane of a boundary facet.
//!
//! The convex hull is closed by ghost tetrahedra. A ghost abc∞ is in conflict with p iff p lies strictly beyond abc,
//! or on the plane of abc and inside the circumcircle of abc, that is, inside the circumsphere of the finite neighbour.

mod build;
mod insert;
mod large;
mod local;
mod of_points;
mod order;
mod parallel;
mod removal;
mod star;

pub use build::DelaunayError;
#[doc(hidden)]
pub use build::{delaunay, delaunay_by};
#[doc(hidden)]
pub use insert::Delaunay;
pub(crate) use local::is_locally_delaunay;
pub use of_points::{PointsDelaunay, delaunay_of_points};
pub(crate) use removal::filling;
