//! `scaling.svg`: seconds against size, with a line n log n.

use super::plan::Work;
use super::row::Row;
use crate::plot::{Plot, PlotError, Scale, Series};

/// The plot. The line goes through the first point of each input.
///
/// # Errors
/// If nothing has succeeded.
pub fn seconds(rows: &[Row]) -> Result<String, PlotError> {
    let series = Work::ALL.map(|work| {
        let rows = rows.iter().filter(|r| r.input == work.word());
        let point = |r: &Row| Some((r.size as f64, r.seconds.filter(|&s| s > 0.0)?));
        Series {
            name: work.word().to_string(),
            points: rows.filter_map(point).collect(),
        }
    });
    let series: Vec<Series> = series.into();
    let guides = series.iter().take(1).map(n_log_n).collect();
    let plot = Plot {
        title: "Points, or facets, to a mesh".to_string(),
        x_label: "points n, or facets n".to_string(),
        y_label: "seconds".to_string(),
        scale: Scale::Log,
        series,
        guides,
    };
    plot.svg()
}

fn n_log_n(series: &Series) -> Series {
    let line = series.points.first().map(|&(n0, t0)| {
        let points = series.points.iter();
        points
            .map(move |&(n, _)| (n, t0 * n * n.ln() / (n0 * n0.ln())))
            .collect()
    });
    Series {
        name: "n log n".to_string(),
        points: line.unwrap_or_default(),
    }
}
