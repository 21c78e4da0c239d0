//! Geometric predicates: one formula per determinant, filtered and exact evaluation, symbolic perturbation.
//!
//! The algorithms ask a [`PointStore`] for signs: [`DoublePoints`], whose signs are exact, or a view of them whose
//! signs are rounded (`NaivePoints`, for experiments). Only what makes Steiner points needs a [`GrowingStore`].

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
use perturbation::perturbed_sign;
pub use segment_point::Steiner;
pub use store::{GrowingStore, PointStore};
