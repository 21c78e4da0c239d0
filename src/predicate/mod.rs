//! Geometric predicates: one formula per determinant, filtered and exact evaluation, symbolic perturbation.
//!
//! The algorithms ask a [`PointStore`] for signs and never see a coordinate, so that a store of exact dyadic points can
//! take the place of [`DoublePoints`].

pub(crate) mod coordinates;
mod double_points;
pub mod formula;
mod integers;
mod naive;
pub(crate) mod pairs;
mod perturbation;
mod range;
mod segment_point;
mod stages;
mod store;

pub use double_points::DoublePoints;
pub use naive::NaivePoints;
pub use perturbation::perturbed_sign;
pub use segment_point::Steiner;
pub use store::PointStore;
