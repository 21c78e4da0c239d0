//! Deleting polygons and inserting them again.
//!
//! **Question.** What does it cost to update a CDT, polygon by polygon, compared with building it anew? Does the
//! deletion by flips in the reversed order of their times (Shewchuk 2003) take about as long as the insertion, and does
//! it give back the mesh that was there before?
//!
//! **Inputs.** The scenes of Fig. 8 with 100 to 100 000 crossing tetrahedra, and the generated models of Table 1
//! ([`crate::inputs::suite`]); with `--models DIR` those of a directory. Of a model, up to [`measure::MOST_POLYGONS`]
//! polygons, evenly spread over all, are deleted and inserted by cavity retriangulation, deleted and inserted by flips,
//! one after the other. A row is a scene or a model.
//!
//! **Columns.** [`Row`]; the README of this package has their meaning. Seconds are wall clock, in one thread.
//!
//! **Expected.** Nothing fails, no deletion of a flat polygon is refused, a scene without its polygon is what it was
//! before, and in the end every mesh is what it was in the beginning; asserted at the end. Nothing is asserted of
//! times.

mod measure;

use crate::frame::{About, Answer, Context, Expectation, Experiment, Failed, check_rows};
use crate::inputs::suite;
use crate::measure::outcome;
use measure::Input;
use serde::Serialize;

/// The question.
pub struct Updates;

impl Experiment for Updates {
    fn about(&self) -> About {
        About {
            name: "updates",
            question: "deleting polygons and inserting them again, compared with building anew",
            seconds: 15,
        }
    }

    fn run(&self, context: &Context) -> Result<Answer, Failed> {
        let scenes: &[u64] = match context.quick {
            true => &[100, 1000],
            false => &[100, 300, 1000, 3000, 10_000, 30_000, 100_000],
        };
        // Rounds of updates are repeated for so long.
        let seconds = if context.quick { 0.0 } else { 0.5 };
        let models = suite::all(context)?.into_iter().map(Input::Model);
        let inputs = scenes.iter().map(|&n| Input::Scene(n)).chain(models);
        let inputs: Vec<Input> = inputs.collect();
        let measure = |input: &Input| measure::measure(input, seconds).into_iter().collect();
        let rows = context.measure(&inputs, |_| 1, Input::name, measure);
        let mut answer = context.answer();
        let shown = "model updated refused crossing_tets delete_seconds cavity_seconds flip_seconds delete_over_flips \
                     update_over_build outcome";
        answer.csv("updates", &rows, shown)?;
        answer.expectations = expectations(&rows);
        Ok(answer)
    }
}

/// `updates.csv`: one scene or model. The README of the package has the meaning of the columns.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
struct Row {
    source: &'static str,
    model: String,
    vertices: usize,
    polygons: usize,
    updated: usize,
    not_flat: usize,
    refused: usize,
    rounds: usize,
    crossing_tets: u64,
    insertion_flips: u64,
    deletion_flips: u64,
    delete_seconds: Option<f64>,
    cavity_seconds: Option<f64>,
    flip_seconds: Option<f64>,
    build_seconds: Option<f64>,
    delete_over_flips: Option<f64>,
    update_over_build: Option<f64>,
    outcome: &'static str,
    without_is_before: Option<bool>,
    same: Option<bool>,
}

fn expectations(rows: &[Row]) -> Vec<Expectation> {
    check_rows(
        rows,
        |r| r.model.clone(),
        &[
            ("every built-in input succeeds", &|r| {
                r.source == "models" || r.outcome == outcome::OK
            }),
            ("no deletion of a flat polygon is refused", &|r| {
                r.refused <= r.not_flat
            }),
            ("a scene without its polygon is what it was before", &|r| {
                r.without_is_before != Some(false)
            }),
            ("in the end every mesh is what it was", &|r| {
                r.same != Some(false)
            }),
        ],
    )
}
