//! What is checked and changed between the last polygon and the exported mesh.

pub mod embedding;
pub mod rounding;
pub mod shims;
