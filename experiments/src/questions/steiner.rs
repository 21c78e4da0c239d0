//! How many Steiner points the segments need.
//!
//! **Question.** How many Steiner points does segment recovery insert, on small angles and on models, compared with
//! other programs, and how many of them lie exactly on their segment?
//!
//! **Inputs.** Built-in families with small angles ([`crate::inputs::angles`]); with `--models DIR` every model of a
//! directory.
//!
//! **Columns.** [`Row`], [`Summary`]; the README of this package has their meaning.
//!
//! **Expected.** Recovery ends on all built-in models, and every mesh is verified; asserted at the end.

use crate::frame::program::{Program, SWITCHES};
use crate::frame::{About, Answer, Context, Expectation, Experiment, Failed, check_rows};
use crate::inputs::{angles, suite};
use crate::measure::outcome;
use crate::measure::sample::rounded;
use serde::Serialize;
use std::collections::BTreeMap;
use std::time::Duration;
use tetflip::cdt::{Cdt, Options};
use tetflip::error::Failure;
use tetflip::exchange::{ExportedMesh, Plc};
use tetflip::report::Report;
use tetflip::verify::{Domain, VerifyOptions, verify};

/// The question.
pub struct Steiner;

/// The column `source` of the families with small angles.
const BUILT_IN: &str = "built-in";

/// The column `method` of this library.
const TETFLIP: &str = "tetflip";

/// A model: its source, its name, and the complex.
type Model = (&'static str, String, Plc);

impl Experiment for Steiner {
    fn about(&self) -> About {
        About {
            name: "steiner",
            question: "Steiner points that segments need, on small angles and on models, here and elsewhere",
            seconds: 15,
        }
    }

    fn run(&self, context: &Context) -> Result<Answer, Failed> {
        let tetgen = context.tetgen.iter().map(|program| Program {
            name: "tetgen".to_string(),
            program: program.clone(),
            switches: SWITCHES.to_string(),
        });
        let rivals: Vec<Program> = tetgen.chain(context.rivals.iter().cloned()).collect();
        let built_in = angles::models(context.quick).into_iter();
        let mut models: Vec<Model> = built_in.map(|(name, plc)| (BUILT_IN, name, plc)).collect();
        for model in suite::all(context)? {
            models.push((model.source, model.name.clone(), model.plc()?));
        }
        let measure = |model: &Model| measure(model, &rivals, context.limit);
        let rows = context.measure(&models, |_| 1, |m| m.1.clone(), measure);
        let mut answer = context.answer();
        answer.csv(
            "steiner",
            &rows,
            "model method steiner_points on_segment seconds outcome",
        )?;
        let shown = "source method models succeeded common common_steiner_points fewest";
        answer.csv("steiner-summary", &summaries(&rows), shown)?;
        answer.expectations = expectations(&rows);
        Ok(answer)
    }
}

/// `steiner.csv`: one method on one model. The README of the package has the meaning of the columns.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
struct Row {
    source: &'static str,
    model: String,
    method: String,
    vertices: usize,
    segments: Option<usize>,
    steiner_points: Option<usize>,
    on_segment: Option<usize>,
    seconds: f64,
    outcome: &'static str,
    verified: Option<bool>,
}

impl Row {
    fn is_ok(&self) -> bool {
        self.outcome == outcome::OK
    }
}

/// One row per method: this library, with the mesh verified, and the rivals.
fn measure((source, name, plc): &Model, rivals: &[Program], limit: Duration) -> Vec<Row> {
    let mut rows = vec![ours(plc)];
    rows.extend(rivals.iter().map(|rival| {
        let run = rival.run(plc, limit);
        Row {
            method: rival.name.clone(),
            steiner_points: run.steiner_points,
            seconds: rounded(run.seconds),
            outcome: run.outcome,
            ..Row::default()
        }
    }));
    for row in &mut rows {
        row.source = source;
        row.model.clone_from(name);
        row.vertices = plc.vertices.len();
    }
    rows
}

/// Segment recovery is what counts: the outcome and the seconds are its own, and polygons that cannot be inserted leave
/// `verified` empty.
fn ours(plc: &Plc) -> Row {
    let mut report = Report::default();
    let result = Cdt::with_segments(plc, true, &mut report);
    let (outcome, counts) = (outcome::word(&result), result.is_ok());
    let mut row = Row {
        method: TETFLIP.to_string(),
        segments: counts.then_some(report.segments),
        steiner_points: counts.then_some(report.steiner_points),
        on_segment: counts.then_some(report.steiner_points_on_segment),
        seconds: rounded(report.seconds.segments),
        outcome,
        ..Row::default()
    };
    if let Ok(mut cdt) = result
        && let Ok(mesh) = mesh(&mut cdt, plc, &mut report)
    {
        let options = VerifyOptions {
            domain: Domain::Hull,
            ..VerifyOptions::default()
        };
        row.verified = Some(verify(plc, &mesh, options).is_ok());
    }
    row
}

fn mesh(cdt: &mut Cdt, plc: &Plc, report: &mut Report) -> Result<ExportedMesh, Failure> {
    cdt.insert_polygons(Options::default().insertion, report, &mut |_| ())?;
    cdt.export(plc, true, report)
}

/// Steiner points for each segment of a built-in model, at most. Recovery that is about to run away has more.
const MOST_PER_SEGMENT: usize = 200;

/// Of the number of points, and of other programs, next to nothing is asserted.
fn expectations(rows: &[Row]) -> Vec<Expectation> {
    let ours = |r: &Row| r.method == TETFLIP;
    let built_in = |r: &Row| ours(r) && r.source == BUILT_IN;
    let few = |r: &Row| r.steiner_points <= r.segments.map(|n| MOST_PER_SEGMENT * n);
    check_rows(
        rows,
        |r| format!("{}, {}", r.model, r.method),
        &[
            ("segment recovery ends on every built-in model", &|r| {
                !built_in(r) || r.is_ok()
            }),
            ("with a bounded number of points for each segment", &|r| {
                !built_in(r) || !r.is_ok() || few(r)
            }),
            ("every mesh is verified to be the CDT", &|r| {
                !ours(r) || r.verified != Some(false)
            }),
        ],
    )
}

/// `steiner-summary.csv`: the sum over the models of one source that all methods have meshed.
#[derive(Clone, Debug, PartialEq, Serialize)]
struct Summary {
    source: &'static str,
    method: String,
    models: usize,
    succeeded: usize,
    common: usize,
    common_steiner_points: usize,
    fewest: usize,
}

/// One summary for each source and method, in order of appearance.
fn summaries(rows: &[Row]) -> Vec<Summary> {
    let mut models: BTreeMap<(&str, &str), Vec<&Row>> = BTreeMap::new();
    for row in rows {
        models
            .entry((row.source, &row.model))
            .or_default()
            .push(row);
    }
    let mut summaries: Vec<Summary> = Vec::new();
    for row in rows {
        let (source, method) = (row.source, row.method.clone());
        let at = summaries
            .iter()
            .position(|s| (s.source, &s.method) == (source, &method));
        let at = at.unwrap_or_else(|| {
            let (models, succeeded, common, common_steiner_points, fewest) = (0, 0, 0, 0, 0);
            summaries.push(Summary {
                source,
                method,
                models,
                succeeded,
                common,
                common_steiner_points,
                fewest,
            });
            summaries.len() - 1
        });
        let of_model = &models[&(row.source, &*row.model)];
        let common = of_model.iter().all(|r| r.is_ok());
        let fewest = common
            && of_model
                .iter()
                .all(|r| row.steiner_points <= r.steiner_points);
        let summary = &mut summaries[at];
        summary.models += 1;
        summary.succeeded += usize::from(row.is_ok());
        summary.common += usize::from(common);
        summary.common_steiner_points += row.steiner_points.filter(|_| common).unwrap_or(0);
        summary.fewest += usize::from(fewest);
    }
    summaries
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::expectation::assert_each_can_fail;

    #[test]
    fn small_models_have_good_rows() {
        let small = angles::models(true)
            .into_iter()
            .filter(|m| m.1.vertices.len() < 20);
        let rows =
            small.flat_map(|(name, plc)| measure(&(BUILT_IN, name, plc), &[], Duration::ZERO));
        let rows: Vec<Row> = rows.collect();
        assert!(rows.len() >= 6 && rows.iter().all(|r| r.verified == Some(true)));
        assert_each_can_fail(
            expectations,
            &rows,
            &[
                (
                    &|r| (r.outcome, r.verified) = ("segment-too-short", None),
                    &[0],
                ),
                (&|r| r.steiner_points = Some(100_000), &[1]),
                (&|r| r.verified = Some(false), &[2]),
            ],
        );
    }

    #[test]
    fn sums_are_over_common_models() {
        let row = |model: &str, method: &str, steiner_points, outcome| Row {
            source: BUILT_IN,
            model: model.to_string(),
            method: method.to_string(),
            steiner_points,
            outcome,
            ..Row::default()
        };
        let rows = [
            row("a", "tetflip", Some(3), "ok"),
            row("a", "other", Some(5), "ok"),
            row("b", "tetflip", Some(70), "ok"),
            row("b", "other", None, "failed"),
        ];
        let sums = summaries(&rows);
        let counts = |s: &Summary| {
            (
                s.models,
                s.succeeded,
                s.common,
                s.common_steiner_points,
                s.fewest,
            )
        };
        assert_eq!(counts(&sums[0]), (2, 2, 1, 3, 1));
        assert_eq!(counts(&sums[1]), (2, 1, 1, 5, 0));
    }
}
