//! Beside other programs.
//!
//! **Question.** How long does this library take, and how much memory, compared with TetGen (1.5 and 1.6) and HXT on
//! the same inputs, on the same machine, at the same time?
//!
//! **Inputs.** Point sets ([`crate::inputs::points`]), generated models, the scenes of `fig9`, and models of the user's
//! ([`plan`]). A row is one program on one input; all programs take turns on an input, each in a process of its own.
//!
//! **Columns.** [`row::Row`], `row::Target`; the README of this package has their meaning. Seconds are processor
//! time, as all programs tell it of themselves, of the algorithm alone: reading and writing files is left out.
//!
//! **Expected.** We succeed on every input, and on points in general position all programs give the same number of
//! tetrahedra; asserted at the end. Of times nothing is asserted: the targets are reached or missed.

mod measure;
mod plan;
mod row;
mod summary;
mod targets;

use crate::frame::{About, Answer, Context, Experiment, Failed};
use crate::rivals::contestant::contestants;
use plan::{Input, Plan};
use row::Row;

/// The question.
pub struct Rivals;

impl Experiment for Rivals {
    fn about(&self) -> About {
        About {
            name: "rivals",
            question: "processor time and memory beside TetGen and HXT, where they are installed",
            seconds: 310,
        }
    }

    fn run(&self, context: &Context) -> Result<Answer, Failed> {
        let mut plan = context.plan(Plan::quick, Plan::full);
        if let Some(directory) = &context.models {
            plan.add_models(directory)?;
        }
        let (programs, missing) = contestants(context);
        let directory = tempfile::tempdir()?;
        let measure = |input: &Input| match input.write(directory.path()) {
            Ok(files) => measure::measure(input, &files, &programs, plan.rounds, context.limit),
            Err(_) => vec![Row::not_written(input.name.clone(), input.kind.word())],
        };
        let mut rows = context.measure(&plan.inputs, |_| 1, |input| input.name.clone(), measure);
        row::add_ratios(&mut rows);
        let targets = targets::targets(&rows);
        let mut answer = context.answer();
        let shown = "input program method threads seconds polygon_seconds peak_mebibytes tetrahedra outcome";
        answer.csv("rivals", &rows, shown)?;
        let summaries = summary::summaries(&rows);
        if !summaries.is_empty() {
            let shown = "kind method beside common sum_ratio geometric_mean median worst slower_on";
            answer.csv("rivals-summary", &summaries, shown)?;
        }
        if !targets.is_empty() {
            answer.csv("rivals-targets", &targets, "reached measured bound what")?;
        }
        missing
            .iter()
            .for_each(|what| answer.say(format!("skipped: {what}")));
        answer.expectations = row::expectations(&rows);
        Ok(answer)
    }
}
