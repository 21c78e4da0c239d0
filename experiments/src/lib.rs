//! What the experiments have in common: scenes, results as CSV rows, plots.

pub mod plot;
pub mod record;
pub mod scene;
