//! Geometric predicates: one formula per determinant, filtered and exact evaluation, symbolic perturbation.

pub mod formula;
