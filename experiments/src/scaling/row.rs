//! The rows of `scaling.csv`.

use crate::outcome;
use serde::Serialize;

/// One size. The README of the package has the meaning of the columns.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Row {
    pub input: &'static str,
    pub size: usize,
    pub outcome: &'static str,
    pub tetrahedra: Option<usize>,
    pub steiner_points: Option<usize>,
    pub seconds: Option<f64>,
    pub microseconds_each: Option<f64>,
    pub peak_mebibytes: Option<f64>,
    pub bytes_per_tetrahedron: Option<f64>,
}

impl Row {
    /// Whether the run succeeded.
    pub fn is_ok(&self) -> bool {
        self.outcome == outcome::OK
    }

    /// For messages.
    pub fn name(&self) -> String {
        format!("{}/{}", self.input, self.size)
    }
}

/// The rows for people.
pub fn table(rows: &[Row]) -> String {
    let mut text = format!(
        "{:<12} {:>9} {:>10} {:>9} {:>10} {:>8} {:>10}  outcome\n",
        "input", "size", "tets", "seconds", "µs each", "MiB", "bytes/tet"
    );
    let number = |x: Option<f64>| x.map_or("–".to_string(), |x| format!("{x:.3}"));
    for r in rows {
        text += &format!(
            "{:<12} {:>9} {:>10} {:>9} {:>10} {:>8} {:>10}  {}\n",
            r.input,
            r.size,
            r.tetrahedra.map_or("–".to_string(), |n| n.to_string()),
            number(r.seconds),
            number(r.microseconds_each),
            r.peak_mebibytes
                .map_or("–".to_string(), |m| format!("{m:.0}")),
            number(r.bytes_per_tetrahedron),
            r.outcome
        );
    }
    text
}
