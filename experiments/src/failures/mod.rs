//! The failures of rounded flips, to look at.
//!
//! **Question.** What do flips with rounded times leave behind when they get stuck, in the smallest cases, and in the failure
//! case of the paper's §3.4?
//!
//! **Inputs.** The families of `flip_order`; of each and each number type the smallest input on which flips get stuck, of a
//! number of seeds. And `prism/end:78`, the paper's failure case rebuilt ([`crate::family::prism::paper_failure`]).
//!
//! **Columns.** [`row::Row`]; the README of this package has their meaning.
//!
//! **Expected.** The paper's case ends in Schönhardt's polyhedron, and flips in exact order succeed on all inputs of the
//! gallery ([`expect`]).

mod draw;
mod expect;
mod row;
mod search;

use crate::experiment::{Answer, Context, Experiment};
use row::Row;
use std::error::Error;

/// The question and its cost.
pub const EXPERIMENT: Experiment = Experiment {
    name: "failures",
    question: "the smallest failures of rounded flips, in pictures (paper, failure case of §3.4)",
    seconds: 10,
    run,
};

fn run(context: &Context) -> Result<Answer, Box<dyn Error>> {
    let seeds = if context.quick { 8 } else { 200 };
    let cases = search::gallery(seeds, context);
    let results = &context.results;
    let mut files = Vec::new();
    let mut rows = Vec::new();
    for (i, case) in cases.iter().enumerate() {
        let picture = draw::picture(case).map(|svg| {
            let name = format!("failures-{}-{}.svg", case.short_name(), case.times_name());
            results.text(&name, &svg).map(|path| (name, path))
        });
        let (name, path) = picture.transpose()?.unzip();
        files.extend(path);
        rows.push(Row::new(case, i == 0, name.unwrap_or_default()));
    }
    files.push(context.record("failures", &rows)?);
    Ok(Answer {
        text: row::table(&rows),
        files,
        expectations: expect::expectations(&rows),
    })
}
