//! What the experiments have in common: scenes, methods and their outcomes, results as CSV rows, plots.

pub mod expectation;
pub mod family;
pub mod method;
pub mod order;
pub mod outcome;
pub mod plot;
pub mod record;
pub mod sample;
pub mod scene;
pub mod schoenhardt;
pub mod turns;
