//! The plots: the paper's two and the full range. Only successful runs are points.

use super::Row;
use super::tetgen;
use crate::measure::method::Method;
use crate::pictures::plot::{Plot, PlotError, Scale, Series};
use std::ops::RangeInclusive;

/// One plot of the experiment.
pub struct Figure {
    /// The name of its file.
    pub file: &'static str,
    /// The numbers of crossing tetrahedra that it shows.
    pub crossing: RangeInclusive<u64>,
    /// Its axes.
    pub scale: Scale,
    /// Whether it shows flips whose times are exact numbers throughout. Beside them the others look alike.
    pub exact: bool,
}

/// The range of the paper's left plot is not stated; that of its right plot is said to go from 102 to 1,840.
const SMALL: RangeInclusive<u64> = 0..=102;
const PAPER: RangeInclusive<u64> = 102..=1840;

/// Each range once with all methods; those of the paper also without exact times.
pub const FIGURES: [Figure; 5] = [
    linear("fig9-small.svg", SMALL, true),
    linear("fig9-small-rounded.svg", SMALL, false),
    linear("fig9-paper.svg", PAPER, true),
    linear("fig9-paper-rounded.svg", PAPER, false),
    Figure {
        file: "fig9-full.svg",
        crossing: 0..=u64::MAX,
        scale: Scale::Log,
        exact: true,
    },
];

const fn linear(file: &'static str, crossing: RangeInclusive<u64>, exact: bool) -> Figure {
    Figure {
        file,
        crossing,
        scale: Scale::Linear,
        exact,
    }
}

impl Figure {
    /// The plot of the rows in its range, as SVG.
    ///
    /// # Errors
    /// If there are none.
    pub fn svg(&self, rows: &[Row], methods: &[Method]) -> Result<String, PlotError> {
        let is_exact = |m: &Method| ["exact", "rug"].contains(&m.times().as_str());
        let shown = methods.iter().filter(|m| self.exact || !is_exact(m));
        let series = shown.map(|&method| Series::new(method, self.points(rows, method)));
        plot(
            "Inserting a rectangle into a Delaunay tetrahedralization",
            self.scale,
            series.collect(),
        )
    }

    fn points(&self, rows: &[Row], method: Method) -> Vec<(f64, f64)> {
        let shown = rows
            .iter()
            .filter(|r| r.is_of(method) && self.crossing.contains(&r.scene.crossing_tets));
        shown
            .filter_map(|r| Some((r.scene.crossing_tets as f64, r.seconds()? * 1e3)))
            .collect()
    }
}

fn plot(title: &'static str, scale: Scale, series: Vec<Series>) -> Result<String, PlotError> {
    let plot = Plot {
        title,
        x_label: "crossing tetrahedra",
        y_label: "median time in milliseconds",
        scale,
        series,
        guides: Vec::new(),
    };
    plot.svg()
}

/// Cavities and filtered flips beside TetGen's two modes, all sizes.
///
/// # Errors
/// If there is no point.
pub fn beside_tetgen(rows: &[Row], tetgen: &[tetgen::Row]) -> Result<String, PlotError> {
    let full = FIGURES.last().expect("there are figures");
    let ours = Method::all().into_iter();
    let ours = ours.filter(|m| m.insertion() == "cavity" || m.times() == "filtered");
    let ours = ours.map(|method| Series::new(method, full.points(rows, method)));
    let theirs = tetgen::MODES.iter().map(|&(mode, _)| {
        let of_mode = tetgen.iter().filter(|r| r.mode == mode);
        let point = |r: &tetgen::Row| Some((r.crossing_tets as f64, r.median_seconds? * 1e3));
        Series::new(
            format!("TetGen {mode}"),
            of_mode.filter_map(point).filter(|p| p.1 > 0.0),
        )
    });
    plot(
        "Inserting a rectangle, beside TetGen",
        Scale::Log,
        ours.chain(theirs).collect(),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::inputs::slab::Slab;

    #[test]
    fn points_are_successes_in_the_range() {
        let methods = Method::all();
        let row = |crossing_tets: u64, outcome| {
            let mut row = Row::new(Slab::crossing(30), methods[0]);
            row.scene.crossing_tets = crossing_tets;
            (row.timed.median_seconds, row.end.outcome) = (Some(0.002), outcome);
            row
        };
        let rows = [
            row(101, "ok"),
            row(500, "ok"),
            row(600, "stuck"),
            row(1841, "ok"),
        ];
        let (paper, rounded) = (&FIGURES[2], &FIGURES[3]);
        assert_eq!(paper.points(&rows, methods[0]), [(500.0, 2.0)]);
        assert!(paper.points(&rows, methods[1]).is_empty());
        assert!(paper.svg(&rows, &methods).unwrap().contains("flip exact"));
        let svg = rounded.svg(&rows, &methods).unwrap();
        assert!(svg.contains("flip f64:plain") && !svg.contains("flip exact"));
        assert_eq!(paper.svg(&rows[..1], &methods), Err(PlotError::NoPoints));
    }
}
