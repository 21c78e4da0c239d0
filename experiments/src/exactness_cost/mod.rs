//! The price of exactness.
//!
//! **Question.** What do exact flip times cost, relative to the paper's rounded ones, on vertices in general position and on
//! those that make nearly every comparison a tie? How often do float enclosures decide, how often exact quotients, how
//! often the perturbation? How do flips compare with cavity retriangulation and with gift wrapping?
//!
//! **Inputs.** One rectangle through a random slab, through lattices, or through a sphere of integer points
//! ([`input`]), with 100 to 100 000 crossing tetrahedra. A row is the insertion of the rectangle by one method.
//!
//! **Columns.** [`row::Row`], [`summary::Summary`], [`summary::Target`]; the README of this package has their meaning.
//! Seconds are wall clock of the insertion alone, in one thread; all methods are timed in turns in one run. A run with
//! rounded times can fail; its time, which includes the undoing, still counts.
//!
//! **Expected.** All but rounded flips always succeed; every success is verified and all of one input are the same mesh
//! ([`expect`]), asserted at the end. The project's targets for times are reported as reached or missed, not asserted.

mod expect;
mod input;
mod measure;
mod plan;
mod row;
mod summary;

use crate::experiment::{Answer, Context, Experiment};
use crate::outcome;
use input::Input;
use plan::Plan;
use row::Row;
use std::error::Error;

/// The question and its cost.
pub const EXPERIMENT: Experiment = Experiment {
    name: "exactness_cost",
    question: "cost of exact flip times by number type, on random and on degenerate vertices",
    seconds: 125,
    run,
};

fn run(context: &Context) -> Result<Answer, Box<dyn Error>> {
    let plan = context.plan(Plan::quick, Plan::full);
    let rows = measure_all(&plan, context);
    let methods = plan::methods();
    let summaries = summary::summaries(&rows, &methods);
    let targets = summary::targets(&summaries);
    Ok(Answer {
        text: format!(
            "Times relative to flips with f64 times:\n\n{}\n{}\n{}",
            summary::table(&summaries, &methods),
            summary::targets_text(&targets),
            outcome::failures(&rows, |r| (r.name(), r.outcome, r.left))
        ),
        files: vec![
            context.record("exactness_cost", &rows)?,
            context.record("exactness_cost-summary", &summaries)?,
            context.record("exactness_cost-targets", &targets)?,
        ],
        expectations: expect::expectations(&rows),
    })
}

/// All inputs.
fn measure_all(plan: &Plan, context: &Context) -> Vec<Row> {
    context.measure(&plan.inputs, plan::weight, Input::name, |input| {
        measure::measure(input, &plan::methods_for(input.about), &plan.effort)
    })
}
