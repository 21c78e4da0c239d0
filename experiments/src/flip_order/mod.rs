//! The order of flips, rounded and exact (§3.3 and the failure case of §3.4).
//!
//! **Question.** How often do flips come off the queue in the wrong order when their times are rounded, what do the
//! paper's three patches make of it, how often does the insertion fail, and what is left then? Does the exact order, with the
//! perturbation, always succeed?
//!
//! **Inputs.** Small PLCs of nine families ([`crate::family`]) that make ties, near ties and large rounding
//! errors; every polygon is exactly flat.
//!
//! **Columns.** [`row::Summary`], [`row::FailureRow`]; the README of this package has their meaning.
//!
//! **Expected.** Every exact number type succeeds on every input, without a patch and without an inversion, and ends in the
//! tetrahedra of cavity retriangulation ([`expect`]). Rounded times may fail. Asserted at the end.

mod expect;
pub(crate) mod measure;
pub mod plan;
mod plots;
pub mod replay;
mod row;

use crate::experiment::{Answer, Context, Experiment};
use crate::family::Member;
use crate::threads;
use measure::Measured;
use plan::Plan;
use std::error::Error;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The question and its cost.
pub const EXPERIMENT: Experiment = Experiment {
    name: "flip_order",
    question: "what becomes of flips whose times are rounded (paper, §3.3, failure case of §3.4)",
    seconds: 65,
    run,
};

fn run(context: &Context) -> Result<Answer, Box<dyn Error>> {
    let plan = context.plan(Plan::quick, Plan::full);
    let inputs = measure_all(&plan, context);
    let rows = row::summaries(&inputs, &plan);
    let failures = row::failures(&inputs);
    let runs: usize = inputs.iter().map(|m| m.runs.len()).sum();
    let results = &context.results;
    Ok(Answer {
        text: format!(
            "{}\n\n{} inputs, {runs} runs, {} failed",
            row::table(&rows, &plan),
            inputs.len(),
            failures.len()
        ),
        files: vec![
            context.record("flip_order", &rows)?,
            context.record("flip_order-failures", &failures)?,
            results.text("flip_order-precision.svg", &plots::precision(&rows)?)?,
        ],
        expectations: expect::expectations(&inputs),
    })
}

/// All inputs, on all processors, in the order of the plan.
fn measure_all(plan: &Plan, context: &Context) -> Vec<Measured> {
    let members = Member::all(plan.seeds);
    let bar = context.bar(members.len() as u64);
    let next = AtomicUsize::new(0);
    let work = || {
        let mut measured = Vec::new();
        while let Some(&member) = members.get(next.fetch_add(1, Ordering::Relaxed)) {
            measured.push(measure::measure(member, plan));
            bar.inc(1);
        }
        measured
    };
    let mut inputs = threads::on_all_processors(work).concat();
    bar.finish_and_clear();
    inputs.sort_by_key(|m| m.member.key());
    inputs
}
