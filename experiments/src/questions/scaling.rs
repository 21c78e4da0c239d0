//! Growth of the whole.
//!
//! **Question.** How do time and memory grow with the number of points, up to ten million, and with the number of
//! facets, up to a million?
//!
//! **Inputs.** Uniform points ([`crate::inputs::points`]) and generated surfaces. A row is one size, in a process
//! of its own.
//!
//! **Columns.** [`Row`]; the README of this package has their meaning. Seconds are processor time.
//!
//! **Expected.** Every size succeeds. Nothing is asserted of times.

use crate::frame::{About, Answer, Context, Expectation, Experiment, Failed, check_rows};
use crate::inputs::points::Spread;
use crate::measure::outcome;
use crate::measure::sample::rounded;
use crate::pictures::plot::{Plot, PlotError, Scale, Series};
use crate::rivals::process::{processor_seconds, run as run_limited};
use serde::Serialize;
use std::time::Duration;
use tetflip::cdt::{Options, tetrahedralize};
use tetflip::delaunay::delaunay;
use tetflip::generate::{Kind, generate};
use tetflip::lab::tetgen::number_after;
use tetflip::mesh::VertexId;
use tetflip::predicate::DoublePoints;
use tetflip::report::Report;

/// The question.
pub struct Scaling;

impl Experiment for Scaling {
    fn about(&self) -> About {
        About {
            name: "scaling",
            question: "time and memory from a thousand to ten million points, and to a million facets",
            seconds: 45,
        }
    }

    fn run(&self, context: &Context) -> Result<Answer, Failed> {
        let tasks = tasks(context.quick);
        let name = |(work, size): &Task| format!("{}/{size}", work.word());
        let measure = |task: &Task| vec![measure(*task, context.limit)];
        let rows = context.measure(&tasks, |task| task.1 as u64, name, measure);
        let mut answer = context.answer();
        let shown = "input size tetrahedra seconds microseconds_each peak_mebibytes bytes_per_tetrahedron outcome";
        answer.csv("scaling", &rows, shown)?;
        answer.file("scaling.svg", &plot(&rows)?)?;
        answer.expectations = expectations(&rows);
        Ok(answer)
    }
}

/// What is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Work {
    /// The Delaunay tetrahedralization of uniform points.
    Points,
    /// The CDT of a generated surface.
    Surface(Kind),
}

impl Work {
    const ALL: [Work; 3] = [
        Work::Points,
        Work::Surface(Kind::Terrain),
        Work::Surface(Kind::Cells),
    ];

    /// The word of tables.
    fn word(self) -> &'static str {
        match self {
            Work::Points => Spread::Cube.word(),
            Work::Surface(kind) => kind.name(),
        }
    }
}

/// Of so many points or facets.
type Task = (Work, usize);

/// Powers of ten from a thousand on, in the order of the rows.
fn tasks(quick: bool) -> Vec<Task> {
    let (points, facets) = if quick { (4, 3) } else { (7, 6) };
    let tasks = Work::ALL.into_iter().flat_map(|work| {
        let last = if work == Work::Points { points } else { facets };
        (3..=last).map(move |e| (work, 10usize.pow(e)))
    });
    tasks.collect()
}

/// `scaling.csv`: one size. The README of the package has the meaning of the columns.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
struct Row {
    input: &'static str,
    size: usize,
    outcome: &'static str,
    tetrahedra: Option<usize>,
    steiner_points: Option<usize>,
    seconds: Option<f64>,
    microseconds_each: Option<f64>,
    peak_mebibytes: Option<f64>,
    bytes_per_tetrahedron: Option<f64>,
}

/// A time for ten million points on a slow machine.
const LEAST_LIMIT: Duration = Duration::from_secs(600);

/// One size, in a process of its own, so that its memory is known.
fn measure((work, size): Task, limit: Duration) -> Row {
    let this = std::env::current_exe().unwrap_or_default();
    let arguments = [
        "scale".to_string(),
        work.word().to_string(),
        size.to_string(),
    ];
    let ran = run_limited(&this.to_string_lossy(), &arguments, limit.max(LEAST_LIMIT));
    let after = |heading| number_after(&ran.text, heading).filter(|_| ran.ok);
    let seconds = after("seconds:");
    let count = |heading| after(heading).map(|n| n as usize);
    let per = |total: Option<f64>, n: usize| Some(rounded(total? / n as f64));
    let tetrahedra = count("tetrahedra:");
    let bytes = ran.peak_mebibytes.map(|m| m * 1024.0 * 1024.0);
    Row {
        input: work.word(),
        size,
        outcome: if seconds.is_some() {
            outcome::OK
        } else {
            "failed"
        },
        tetrahedra,
        steiner_points: count("steiner:"),
        seconds: seconds.map(rounded),
        microseconds_each: per(seconds.map(|s| s * 1e6), size),
        peak_mebibytes: ran.peak_mebibytes.map(rounded),
        bytes_per_tetrahedron: tetrahedra.and_then(|n| per(bytes, n)),
    }
}

/// What the process does.
///
/// # Errors
/// If the word is unknown, or there is no tetrahedralization.
pub fn take_part(word: &str, size: usize) -> Result<(), Failed> {
    let work = Work::ALL.into_iter().find(|w| w.word() == word);
    match work.ok_or_else(|| format!("unknown word {word}"))? {
        Work::Points => {
            let points = DoublePoints::new(Spread::Cube.points(size));
            let all: Vec<VertexId> = (0..size).map(VertexId::new).collect();
            let start = processor_seconds();
            let result = delaunay(&points, &all)?;
            println!("seconds: {}", processor_seconds() - start);
            println!("tetrahedra: {}", result.mesh.finite().count());
        }
        Work::Surface(kind) => {
            let plc = generate(kind, 1, size);
            let mut report = Report::default();
            let start = processor_seconds();
            let mesh = tetrahedralize(&plc, &Options::default(), &mut report, &mut |_| ())
                .map_err(|failure| failure.describe(&plc).to_string())?;
            println!("seconds: {}", processor_seconds() - start);
            println!("tetrahedra: {}", mesh.tets.len());
            println!("steiner: {}", report.steiner_points);
        }
    }
    Ok(())
}

fn expectations(rows: &[Row]) -> Vec<Expectation> {
    let each = |r: &Row| r.tetrahedra.map_or(0.0, |n| n as f64 / r.size as f64);
    check_rows(
        rows,
        |r| format!("{}/{}", r.input, r.size),
        &[
            ("every size succeeds", &|r| r.outcome == outcome::OK),
            ("uniform points have 6 to 7 tetrahedra each", &|r| {
                r.input != "uniform" || (6.0..7.0).contains(&each(r))
            }),
        ],
    )
}

/// `scaling.svg`: seconds against size, with a line n log n through the first point of the first input.
fn plot(rows: &[Row]) -> Result<String, PlotError> {
    let series = Work::ALL.map(|work| {
        let rows = rows.iter().filter(|r| r.input == work.word());
        let point = |r: &Row| Some((r.size as f64, r.seconds.filter(|&s| s > 0.0)?));
        Series::new(work.word(), rows.filter_map(point))
    });
    let plot = Plot {
        title: "Points, or facets, to a mesh",
        x_label: "points n, or facets n",
        y_label: "seconds",
        scale: Scale::Log,
        guides: vec![series[0].n_log_n()],
        series: series.into(),
    };
    plot.svg()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::expectation::assert_each_can_fail;

    #[test]
    fn ten_million_points() {
        let largest = |quick| tasks(quick).iter().map(|t| t.1).max();
        assert_eq!(
            (largest(false), largest(true)),
            (Some(10_000_000), Some(10_000))
        );
    }

    #[test]
    fn each_can_fail() {
        let (tetrahedra, outcome) = (Some(6500), outcome::OK);
        let good = Row {
            input: "uniform",
            size: 1000,
            tetrahedra,
            outcome,
            ..Row::default()
        };
        assert_each_can_fail(
            expectations,
            &[good],
            &[
                (&|r| r.outcome = "failed", &[0]),
                (&|r| r.tetrahedra = Some(5000), &[1]),
            ],
        );
    }
}
