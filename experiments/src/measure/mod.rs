//! How runs are made, timed and counted.

pub mod method;
pub mod outcome;
pub mod rounds;
pub mod sample;
pub mod threads;
pub mod wilson;
