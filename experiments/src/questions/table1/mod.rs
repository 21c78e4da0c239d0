//! Table 1: statistics of the construction of CDTs.
//!
//! **Question.** How many Steiner points, recovered subpolygons, flips and crossing tetrahedra are there in models as
//! people make them, and what does each phase cost? In the paper, polygons take 4 to 16 per cent of the time, and the
//! two algorithms differ by less than one per cent of it.
//!
//! **Inputs.** Generated models of the kinds and sizes of the paper's columns, and others ([`crate::inputs::suite`]);
//! with `--models DIR` every file of a directory that has facets.
//!
//! **Columns.** [`Row`], in the order of the paper's rows (1) to (16); the README of this package has their meaning.
//!
//! **Expected.** All built-in models have a CDT, cavities, flips and gift wrapping end in the same tetrahedra, and the
//! verifier accepts them; asserted at the end. Nothing is asserted of times.

mod measure;
pub mod paper;

use crate::frame::{About, Answer, Context, Expectation, Experiment, Failed, check_rows};
use crate::inputs::suite::{self, Model};
use crate::measure::outcome;
use paper::{Column, TABLE_1};
use serde::Serialize;

/// The table.
pub struct Table1;

impl Experiment for Table1 {
    fn about(&self) -> About {
        About {
            name: "table1",
            question: "counts and times of whole CDTs, beside the paper's (Table 1)",
            seconds: 30,
        }
    }

    fn run(&self, context: &Context) -> Result<Answer, Failed> {
        let rounds = if context.quick { 1 } else { 5 };
        let measure = |model: &Model| vec![measure::measure(model, rounds)];
        let measured = context.measure(&suite::all(context)?, |_| 1, |m| m.name.clone(), measure);
        let mut rows: Vec<Row> = TABLE_1.iter().map(Row::of_paper).collect();
        rows.extend(measured);
        let mut answer = context.answer();
        let shown = "model beside vertices steiner_points tetrahedra subpolygons recovered flips crossing_tets \
                     largest_region delaunay_seconds segment_seconds cavity_seconds flip_seconds total_seconds outcome";
        answer.csv("table1", &rows, shown)?;
        answer.expectations = expectations(&rows);
        Ok(answer)
    }
}

/// `table1.csv`: one model. The README of the package has the meaning of the columns.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
struct Row {
    source: &'static str,
    model: String,
    beside: &'static str,
    vertices: usize,
    facets: Option<usize>,
    polygons: usize,
    steiner: &'static str,
    steiner_points: usize,
    tetrahedra: usize,
    subpolygons: usize,
    recovered: u64,
    most_recovered: u64,
    flips: u64,
    crossing_tets: u64,
    largest_region: u64,
    mean_region: Option<f64>,
    delaunay_seconds: Option<f64>,
    segment_seconds: Option<f64>,
    cavity_seconds: Option<f64>,
    flip_seconds: Option<f64>,
    gift_wrap_seconds: Option<f64>,
    total_seconds: Option<f64>,
    outcome: &'static str,
    agrees: Option<bool>,
    verified: Option<bool>,
}

impl Row {
    /// A column of the paper.
    fn of_paper(column: &Column) -> Row {
        let [vertices, polygons, steiner_points, tetrahedra, subpolygons] = column.sizes;
        let [
            recovered,
            most_recovered,
            flips,
            crossing_tets,
            largest_region,
        ] = column.regions;
        let [delaunay, segments, cavities, flip_times, all] = column.seconds.map(Some);
        Row {
            source: "paper",
            model: column.name.to_string(),
            beside: column.name,
            vertices,
            polygons,
            steiner_points,
            tetrahedra,
            subpolygons,
            recovered,
            most_recovered,
            flips,
            crossing_tets,
            largest_region,
            mean_region: Some(column.mean_region),
            delaunay_seconds: delaunay,
            segment_seconds: segments,
            cavity_seconds: cavities,
            flip_seconds: flip_times,
            total_seconds: all,
            outcome: outcome::OK,
            ..Row::default()
        }
    }
}

/// Of times nothing is asserted.
fn expectations(rows: &[Row]) -> Vec<Expectation> {
    let made = |r: &Row| r.source == "generated";
    let is_ok = |r: &Row| r.outcome == outcome::OK;
    check_rows(
        rows,
        |r| r.model.clone(),
        &[
            ("every built-in model has a CDT", &|r| !made(r) || is_ok(r)),
            (
                "cavities, flips and gift wrapping give the same tetrahedra",
                &|r| r.agrees != Some(false),
            ),
            ("every mesh is verified", &|r| r.verified != Some(false)),
            ("the verifier was asked", &|r| {
                !made(r) || !is_ok(r) || r.verified.is_some()
            }),
        ],
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::expectation::assert_each_can_fail;

    #[test]
    fn each_can_fail() {
        let (agrees, verified) = (Some(true), Some(true));
        let good = Row {
            source: "generated",
            outcome: outcome::OK,
            agrees,
            verified,
            ..Row::default()
        };
        assert_each_can_fail(
            expectations,
            &[good],
            &[
                (&|r| r.outcome = "not-flat", &[0]),
                (&|r| r.agrees = Some(false), &[1]),
                (&|r| r.verified = Some(false), &[2]),
                (&|r| r.verified = None, &[3]),
            ],
        );
    }
}
