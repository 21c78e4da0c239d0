//! `growth.svg`: seconds against vertices, with a line n log n.

use crate::growth::row::Row;
use crate::method::Method;
use crate::plot::{Plot, PlotError, Scale, Series};

/// The plot. The line goes through the first point of the first method.
///
/// # Errors
/// If nothing has succeeded.
pub fn growth(rows: &[Row], methods: &[Method]) -> Result<String, PlotError> {
    let series = methods.iter().map(|method| {
        let name = method.to_string();
        let points = rows.iter().filter(|r| r.method == name);
        Series {
            points: points.filter_map(Row::point).collect(),
            name,
        }
    });
    let series: Vec<Series> = series.collect();
    let guides = series.iter().take(1).map(guide).collect();
    let plot = Plot {
        title: "Inserting a rectangle into a Delaunay tetrahedralization".to_string(),
        x_label: "vertices n".to_string(),
        y_label: "median seconds".to_string(),
        scale: Scale::Log,
        series,
        guides,
    };
    plot.svg()
}

fn guide(series: &Series) -> Series {
    let points = series.points.iter().map(|&(n, _)| {
        let (n0, t0) = series.points[0];
        (n, t0 * n * n.ln() / (n0 * n0.ln()))
    });
    Series {
        name: "n log n".to_string(),
        points: points.collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::growth::plan::METHODS;

    #[test]
    fn the_guide_starts_at_the_first_point() {
        let row = |vertices, median_seconds| Row {
            vertices,
            median_seconds,
            outcome: "ok",
            method: METHODS[0].to_string(),
            ..Row::default()
        };
        let rows = [row(10, Some(1.0)), row(100, Some(15.0))];
        let series = Series {
            name: String::new(),
            points: rows.iter().filter_map(Row::point).collect(),
        };
        let guide = guide(&series).points;
        assert_eq!(guide[0], (10.0, 1.0));
        assert!(
            (guide[1].1 - 20.0).abs() < 1e-9,
            "ten times as many, twice the logarithm"
        );
        assert!(growth(&rows, &METHODS).unwrap().contains("n log n"));
        assert_eq!(growth(&[], &METHODS), Err(PlotError::NoPoints));
    }
}
