//! Deleting polygons and inserting them again.
//!
//! **Question.** What does it cost to update a CDT, polygon by polygon, compared with building it anew? Does the deletion by
//! flips in the reversed order of their times (Shewchuk 2003) take about as long as the insertion, and does it give
//! back the mesh that was there before?
//!
//! **Inputs.** The scenes of Fig. 8 with 100 to 100 000 crossing tetrahedra, and the generated models of Table 1 ([`crate::suite`]);
//! with `--models DIR` those of a directory. Of a model, up to [`plan::MOST_POLYGONS`] polygons, evenly spread over all, are deleted
//! and inserted by cavity retriangulation, deleted and inserted by flips, one after the other. A row is a scene or a model.
//!
//! **Columns.** [`row::Row`]; the README of this package has their meaning. Seconds are wall clock, in one thread.
//!
//! **Expected.** Nothing fails, no deletion of a flat polygon is refused, a scene without its polygon is what it was before,
//! and in the end every mesh is what it was in the beginning; asserted at the end. Nothing is asserted of times.

mod expect;
mod measure;
mod plan;
mod row;

use crate::experiment::{Answer, Context, Experiment};
use crate::suite;
use measure::Input;
use plan::Plan;
use std::error::Error;

/// The question and its cost.
pub const EXPERIMENT: Experiment = Experiment {
    name: "updates",
    question: "deleting polygons and inserting them again, compared with building anew",
    seconds: 15,
    run,
};

fn run(context: &Context) -> Result<Answer, Box<dyn Error>> {
    let plan = context.plan(Plan::quick, Plan::full);
    let mut inputs: Vec<Input> = plan.scenes.iter().map(|&n| Input::Scene(n)).collect();
    inputs.extend(suite::built_in(context.quick).into_iter().map(Input::Model));
    if let Some(directory) = &context.models {
        inputs.extend(
            suite::of_directory(directory)?
                .into_iter()
                .map(Input::Model),
        );
    }
    let rows = context.measure(
        &inputs,
        |_| 1,
        Input::name,
        |input| measure::measure(input, plan.seconds).into_iter().collect(),
    );
    Ok(Answer {
        text: row::table(&rows),
        files: vec![context.record("updates", &rows)?],
        expectations: expect::expectations(&rows),
    })
}
