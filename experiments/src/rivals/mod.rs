//! Beside other programs.
//!
//! **Question.** How long does this library take, and how much memory, compared with TetGen and HXT on the same inputs, on
//! the same machine, at the same time?
//!
//! **Inputs.** Point sets ([`points`]), generated models, the scenes of `fig9`, and models of the user's ([`plan`]). A row is
//! one program on one input; all programs take turns on an input, each in a process of its own.
//!
//! **Columns.** [`row::Row`], [`row::Target`]; the README of this package has their meaning. Seconds are processor time, as
//! all programs tell it of themselves, of the algorithm alone: reading and writing files is left out.
//!
//! **Expected.** We succeed on every input, and on points in general position all programs give the same number of
//! tetrahedra ([`expect`]); asserted at the end. Of times nothing is asserted: the targets are reached or missed.

mod contestant;
mod expect;
mod measure;
mod ours;
mod plan;
pub mod points;
pub mod process;
mod row;
pub mod tetgen;

pub use ours::take_part;
pub use process::{limited, number_after, processor_seconds, run as run_limited};

use crate::experiment::{Answer, Context, Experiment};
use contestant::contestants;
use plan::Plan;
use std::error::Error;

/// The question and its cost.
pub const EXPERIMENT: Experiment = Experiment {
    name: "rivals",
    question: "processor time and memory beside TetGen and HXT, where they are installed",
    seconds: 310,
    run,
};

fn run(context: &Context) -> Result<Answer, Box<dyn Error>> {
    let mut plan = if context.quick {
        Plan::quick()
    } else {
        Plan::full()
    };
    if let Some(directory) = &context.models {
        plan.add_models(directory)?;
    }
    let (programs, missing) = contestants(context);
    let bar = context.bar(plan.inputs.len() as u64);
    let directory = tempfile::tempdir()?;
    let mut rows = Vec::new();
    for input in &plan.inputs {
        bar.set_message(input.name.clone());
        let files = input.write(directory.path())?;
        rows.extend(measure::measure(
            input,
            &files,
            &programs,
            plan.rounds,
            context.limit,
        ));
        bar.inc(1);
    }
    bar.finish_and_clear();
    row::add_ratios(&mut rows);
    let targets = row::targets(&rows);
    let mut files = vec![context.record("rivals", &rows)?];
    if !targets.is_empty() {
        files.push(context.record("rivals-targets", &targets)?);
    }
    let skipped: String = missing
        .iter()
        .map(|what| format!("skipped: {what}\n"))
        .collect();
    Ok(Answer {
        text: format!(
            "{}\n{}\n{skipped}",
            row::table(&rows),
            row::targets_text(&targets)
        ),
        files,
        expectations: expect::expectations(&rows),
    })
}
