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
    seconds: 30,
    run,
};

fn run(context: &Context) -> Result<Answer, Box<dyn Error>> {
    let plan = if context.quick {
        Plan::quick()
    } else {
        Plan::full()
    };
    let rows = measure_all(&plan, context);
    let summaries = row::summaries(&rows, &METHODS, &context.commit);
    let results = &context.results;
    Ok(Answer {
        text: row::table(&rows, &summaries),
        files: vec![
            results.rows("growth", &rows)?,
            results.rows("growth-summary", &summaries)?,
            results.text("growth.svg", &plots::growth(&rows, &METHODS)?)?,
        ],
        expectations: expect::expectations(&rows),
    })
}

/// All sizes.
fn measure_all(plan: &Plan, context: &Context) -> Vec<Row> {
    let bar = context.bar(plan.sizes.iter().sum());
    let mut rows = Vec::new();
    for &size in &plan.sizes {
        bar.set_message(format!("about {size} crossing tetrahedra"));
        let measured = measure::measure(plan::slab(size), &METHODS, &plan.effort(size));
        rows.extend(measured.into_iter().map(|row| Row {
            commit: context.commit.clone(),
            ..row
        }));
        bar.inc(size);
    }
    bar.finish_and_clear();
    rows
}
