//! Growth of the whole.
//!
//! **Question.** How do time and memory grow with the number of points, up to ten million, and with the number of facets, up
//! to a million?
//!
//! **Inputs.** Uniform points ([`crate::rivals::points`]) and generated surfaces ([`plan`]). A row is one size, in a process
//! of its own.
//!
//! **Columns.** [`row::Row`]; the README of this package has their meaning. Seconds are processor time.
//!
//! **Expected.** Every size succeeds ([`expect`]). Nothing is asserted of times.

mod expect;
mod measure;
mod plan;
mod plots;
mod row;

pub use measure::take_part;

use crate::experiment::{Answer, Context, Experiment};
use plan::{Plan, Task};
use std::error::Error;

/// The question and its cost.
pub const EXPERIMENT: Experiment = Experiment {
    name: "scaling",
    question: "time and memory from a thousand to ten million points, and to a million facets",
    seconds: 45,
    run,
};

fn run(context: &Context) -> Result<Answer, Box<dyn Error>> {
    let plan = context.plan(Plan::quick, Plan::full);
    let weight = |task: &Task| task.size as u64;
    let rows = context.measure(&plan.tasks, weight, Task::name, |task| {
        vec![measure::measure(task, context.limit)]
    });
    let results = &context.results;
    Ok(Answer {
        text: row::table(&rows),
        files: vec![
            context.record("scaling", &rows)?,
            results.text("scaling.svg", &plots::seconds(&rows)?)?,
        ],
        expectations: expect::expectations(&rows),
    })
}
