//! Exact signs and sums of points: filters in doubles, then integers. Knows nothing of meshes.
//!
//! Written without the predicates of the construction on purpose: the filters there and here have their own bounds,
//! so that a mistake in one of them does not decide both what is built and what is accepted. The two are compared
//! with exact numbers, each by tests of its own.

pub(crate) mod accumulator;
pub(crate) mod determinants;
pub(crate) mod distance;
pub(crate) mod filter;
pub(crate) mod fixed;
pub(crate) mod formulas;
pub(crate) mod plane;
pub(crate) mod points;
pub(crate) mod ray;
pub(crate) mod sums;
pub(crate) mod tally;
pub(crate) mod words;
