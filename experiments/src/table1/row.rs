//! The rows of `table1.csv`: a column of the paper's table each.

use super::paper::Column;
use crate::outcome;
use serde::Serialize;

/// One model. The README of the package has the meaning of the columns.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Row {
    pub source: &'static str,
    pub model: String,
    pub beside: &'static str,
    pub vertices: usize,
    pub facets: Option<usize>,
    pub polygons: usize,
    pub steiner: &'static str,
    pub steiner_points: usize,
    pub tetrahedra: usize,
    pub subpolygons: usize,
    pub recovered: u64,
    pub most_recovered: u64,
    pub flips: u64,
    pub crossing_tets: u64,
    pub largest_region: u64,
    pub mean_region: Option<f64>,
    pub delaunay_seconds: Option<f64>,
    pub segment_seconds: Option<f64>,
    pub cavity_seconds: Option<f64>,
    pub flip_seconds: Option<f64>,
    pub gift_wrap_seconds: Option<f64>,
    pub total_seconds: Option<f64>,
    pub outcome: &'static str,
    pub agrees: Option<bool>,
    pub verified: Option<bool>,
}

/// The column `source` of the paper's numbers.
pub const PAPER: &str = "paper";

impl Row {
    /// A column of the paper.
    pub fn of_paper(column: &Column) -> Row {
        let [delaunay, segments, cavities, flips, all] = column.seconds.map(Some);
        Row {
            source: PAPER,
            model: column.name.to_string(),
            beside: column.name,
            vertices: column.vertices,
            polygons: column.polygons,
            steiner_points: column.steiner_points,
            tetrahedra: column.tetrahedra,
            subpolygons: column.subpolygons,
            recovered: column.recovered,
            most_recovered: column.most_recovered,
            flips: column.flips,
            crossing_tets: column.crossing_tets,
            largest_region: column.largest_region,
            mean_region: Some(column.mean_region),
            delaunay_seconds: delaunay,
            segment_seconds: segments,
            cavity_seconds: cavities,
            flip_seconds: flips,
            total_seconds: all,
            outcome: outcome::OK,
            ..Row::default()
        }
    }

    /// Whether it succeeded, by all algorithms.
    pub fn is_ok(&self) -> bool {
        self.outcome == outcome::OK
    }
}

/// The rows for people.
pub fn table(rows: &[Row]) -> String {
    let mut text = format!(
        "{:<22} {:<14} {:>8} {:>8} {:>8} {:>8} {:>7} {:>7} {:>7} {:>7} {:>8} {:>8} {:>8} {:>8} {:>8}  outcome\n",
        "model",
        "beside",
        "vertices",
        "Steiner",
        "tets",
        "subpol.",
        "recov.",
        "flips",
        "cross.",
        "largest",
        "Delaunay",
        "segments",
        "cavities",
        "flips",
        "all"
    );
    let number = |x: Option<f64>| x.map_or("–".to_string(), |x| format!("{x:.4}"));
    for r in rows {
        text += &format!(
            "{:<22} {:<14} {:>8} {:>8} {:>8} {:>8} {:>7} {:>7} {:>7} {:>7} {:>8} {:>8} {:>8} {:>8} {:>8}  {}\n",
            r.model,
            r.beside,
            r.vertices,
            r.steiner_points,
            r.tetrahedra,
            r.subpolygons,
            r.recovered,
            r.flips,
            r.crossing_tets,
            r.largest_region,
            number(r.delaunay_seconds),
            number(r.segment_seconds),
            number(r.cavity_seconds),
            number(r.flip_seconds),
            number(r.total_seconds),
            r.outcome
        );
    }
    text
}
