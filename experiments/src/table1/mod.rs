//! Table 1: statistics of the construction of CDTs.
//!
//! **Question.** How many Steiner points, recovered subpolygons, flips and crossing tetrahedra are there in models as people
//! make them, and what does each phase cost? In the paper, polygons take 4 to 16 per cent of the time, and the two algorithms
//! differ by less than one per cent of it.
//!
//! **Inputs.** Generated models of the kinds and sizes of the paper's columns, and others ([`crate::suite`]); with `--models
//! DIR` every file of a directory that has facets.
//!
//! **Columns.** [`row::Row`], in the order of the paper's rows (1) to (16); the README of this package has their meaning.
//!
//! **Expected.** All built-in models have a CDT, cavities, flips and gift wrapping end in the same tetrahedra, and the verifier accepts
//! them ([`expect`]); asserted at the end. Nothing is asserted of times.

mod expect;
mod measure;
pub mod paper;
mod row;

use crate::experiment::{Answer, Context, Experiment};
use crate::suite;
use row::Row;
use std::error::Error;

/// The table.
pub const EXPERIMENT: Experiment = Experiment {
    name: "table1",
    question: "counts and times of whole CDTs, beside the paper's (Table 1)",
    seconds: 30,
    run,
};

fn run(context: &Context) -> Result<Answer, Box<dyn Error>> {
    let mut models = suite::built_in(context.quick);
    if let Some(directory) = &context.models {
        models.extend(suite::of_directory(directory)?);
    }
    let bar = context.bar(models.len() as u64);
    let rounds = if context.quick { 1 } else { 5 };
    let mut rows: Vec<Row> = paper::TABLE_1.iter().map(Row::of_paper).collect();
    for model in &models {
        bar.set_message(model.name.clone());
        rows.push(measure::measure(model, rounds));
        bar.inc(1);
    }
    bar.finish_and_clear();
    Ok(Answer {
        text: row::table(&rows),
        files: vec![context.record("table1", &rows)?],
        expectations: expect::expectations(&rows),
    })
}
