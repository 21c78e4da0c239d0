//! The plots: the paper's two and the full range. Only successful runs are points.

use super::tetgen;
use crate::fig9::row::Row;
use crate::method::Method;
use crate::plot::{Plot, PlotError, Scale, Series};
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
        let has_exact_times = |m: Method| ["exact", "rug"].contains(&m.times().as_str());
        let shown = methods
            .iter()
            .filter(|&&m| self.exact || !has_exact_times(m));
        let series = shown.map(|&method| Series {
            name: method.to_string(),
            points: self.points(rows, method),
        });
        let plot = Plot {
            title: "Inserting a rectangle into a Delaunay tetrahedralization".to_string(),
            x_label: "crossing tetrahedra".to_string(),
            y_label: "median time in milliseconds".to_string(),
            scale: self.scale,
            series: series.collect(),
            guides: Vec::new(),
        };
        plot.svg()
    }

    fn points(&self, rows: &[Row], method: Method) -> Vec<(f64, f64)> {
        let shown = rows
            .iter()
            .filter(|r| r.is_of(method) && r.is_ok() && self.crossing.contains(&r.crossing_tets));
        let points = shown.filter_map(|r| Some((r.crossing_tets as f64, r.median_seconds? * 1e3)));
        points.collect()
    }
}

/// Cavities and filtered flips beside TetGen's two modes, all sizes.
///
/// # Errors
/// If there is no point.
pub fn beside_tetgen(rows: &[Row], tetgen: &[tetgen::Row]) -> Result<String, PlotError> {
    let full = FIGURES.last().expect("there are figures");
    let ours = Method::all().into_iter();
    let ours = ours.filter(|m| m.insertion() == "cavity" || m.times() == "filtered");
    let ours = ours.map(|method| Series {
        name: method.to_string(),
        points: full.points(rows, method),
    });
    let theirs = tetgen::MODES.iter().map(|&(mode, _)| {
        let of_mode = tetgen.iter().filter(|r| r.mode == mode);
        let point = |r: &tetgen::Row| Some((r.crossing_tets as f64, r.median_seconds? * 1e3));
        Series {
            name: format!("TetGen {mode}"),
            points: of_mode.filter_map(point).filter(|p| p.1 > 0.0).collect(),
        }
    });
    let plot = Plot {
        title: "Inserting a rectangle, beside TetGen".to_string(),
        x_label: "crossing tetrahedra".to_string(),
        y_label: "median time in milliseconds".to_string(),
        scale: Scale::Log,
        series: ours.chain(theirs).collect(),
        guides: Vec::new(),
    };
    plot.svg()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Slab;

    fn row(crossing_tets: u64, outcome: &'static str) -> Row {
        let slab = Slab {
            vertices: 10,
            half_height: 1.0,
            seed: 1,
        };
        Row {
            crossing_tets,
            outcome,
            median_seconds: Some(0.002),
            ..Row::new(slab, Method::all()[0])
        }
    }

    #[test]
    fn points_are_successes_in_the_range() {
        let rows = [
            row(101, "ok"),
            row(500, "ok"),
            row(600, "stuck"),
            row(1841, "ok"),
        ];
        let (paper, rounded) = (&FIGURES[2], &FIGURES[3]);
        assert_eq!(paper.points(&rows, Method::all()[0]), [(500.0, 2.0)]);
        assert!(paper.points(&rows, Method::all()[1]).is_empty());
        assert!(
            paper
                .svg(&rows, &Method::all())
                .unwrap()
                .contains("flip exact")
        );
        let svg = rounded.svg(&rows, &Method::all()).unwrap();
        assert!(svg.contains("flip f64") && !svg.contains("flip exact"));
        assert_eq!(
            paper.svg(&rows[..1], &Method::all()),
            Err(PlotError::NoPoints)
        );
    }
}
