//! The rows of `updates.csv`.

use crate::outcome;
use serde::Serialize;

/// One scene or model. The README of the package has the meaning of the columns.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Row {
    pub source: &'static str,
    pub model: String,
    pub vertices: usize,
    pub polygons: usize,
    pub updated: usize,
    pub not_flat: usize,
    pub refused: usize,
    pub rounds: usize,
    pub crossing_tets: u64,
    pub insertion_flips: u64,
    pub deletion_flips: u64,
    pub delete_seconds: Option<f64>,
    pub cavity_seconds: Option<f64>,
    pub flip_seconds: Option<f64>,
    pub build_seconds: Option<f64>,
    pub delete_over_flips: Option<f64>,
    pub update_over_build: Option<f64>,
    pub outcome: &'static str,
    pub without_is_before: Option<bool>,
    pub same: Option<bool>,
}

impl Row {
    /// Whether nothing failed.
    pub fn is_ok(&self) -> bool {
        self.outcome == outcome::OK
    }

    /// For messages.
    pub fn name(&self) -> String {
        self.model.clone()
    }
}

/// The rows for people.
pub fn table(rows: &[Row]) -> String {
    let mut text = format!(
        "{:<20} {:>8} {:>7} {:>9} {:>11} {:>11} {:>11} {:>9} {:>12}  outcome\n",
        "model",
        "updated",
        "refused",
        "crossing",
        "delete ms",
        "cavity ms",
        "flips ms",
        "del/flips",
        "update/build"
    );
    let ms = |x: Option<f64>| x.map_or("–".to_string(), |s| format!("{:.3}", s * 1e3));
    let ratio = |x: Option<f64>| x.map_or("–".to_string(), |x| format!("{x:.3}"));
    let small = |x: Option<f64>| x.map_or("–".to_string(), |x| format!("{x:.2e}"));
    for r in rows {
        text += &format!(
            "{:<20} {:>8} {:>7} {:>9} {:>11} {:>11} {:>11} {:>9} {:>12}  {}\n",
            r.model,
            r.updated,
            r.refused,
            r.crossing_tets,
            ms(r.delete_seconds),
            ms(r.cavity_seconds),
            ms(r.flip_seconds),
            ratio(r.delete_over_flips),
            small(r.update_over_build),
            r.outcome
        );
    }
    text
}
