//! What is measured: scenes, models, and point sets.

pub mod angles;
pub mod points;
pub mod slab;
pub mod suite;
