//! Growth over three orders of magnitude.
//!
//! **Question.** How do the times of flips in exact order and of cavity retriangulation grow with the size of the region?
//! Flips need O(n log n) time for n flips (Shewchuk 2003), cavities little more than linear time in practice.
//!
//! **Inputs.** The scene of the paper's Fig. 8 ([`crate::scene`]) with 1000 to 1 000 000 crossing
//! tetrahedra, one seed. A row is the insertion of the rectangle by one method.
//!
//! **Columns.** [`row::Row`], [`row::Summary`]; the README of this package has their meaning. Seconds are wall clock of the
//! insertion alone, in one thread.
//!
//! **Expected.** Both methods succeed at every size and give the same tetrahedra ([`expect`]); asserted at the end. Nothing
//! is asserted of times.

mod expect;
mod fit;
mod measure;
mod plan;
mod plots;
mod row;

use crate::experiment::{Answer, Context, Experiment};
pub use plan::slab;
use plan::{METHODS, Plan};
use row::Row;
use std::error::Error;

/// The question and its cost.
pub const EXPERIMENT: Experiment = Experiment {
    name: "growth",
    question: "growth of the times of flips and of cavities up to a million crossing tetrahedra",
    seconds: 15,
    run,
};

fn run(context: &Context) -> Result<Answer, Box<dyn Error>> {
    let plan = context.plan(Plan::quick, Plan::full);
    let rows = measure_all(&plan, context);
    let summaries = row::summaries(&rows, &METHODS);
    let results = &context.results;
    Ok(Answer {
        text: row::table(&rows, &summaries),
        files: vec![
            context.record("growth", &rows)?,
            context.record("growth-summary", &summaries)?,
            results.text("growth.svg", &plots::growth(&rows, &METHODS)?)?,
        ],
        expectations: expect::expectations(&rows),
    })
}

/// All sizes.
fn measure_all(plan: &Plan, context: &Context) -> Vec<Row> {
    let name = |size: &u64| format!("about {size} crossing tetrahedra");
    context.measure(
        &plan.sizes,
        |&size| size,
        name,
        |&size| measure::measure(plan::slab(size), &METHODS, &plan.effort(size)),
    )
}
