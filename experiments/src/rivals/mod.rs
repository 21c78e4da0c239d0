//! Other programs, and this library as one of them.

pub mod contestant;
pub mod ours;
pub mod process;
pub mod rival;
