//! The failures of rounded flips, to look at.
//!
//! **Question.** What do flips with rounded times leave behind when they get stuck, in the smallest cases, and in the
//! failure case of the paper's §3.4?
//!
//! **Inputs.** The families of `flip_order`; of each and each number type the smallest input on which flips get stuck,
//! of a number of seeds. And `prism/end:78`, the paper's failure case rebuilt
//! ([`crate::families::prism::paper_failure`]).
//!
//! **Columns.** [`Row`]; the README of this package has their meaning.
//!
//! **Expected.** The paper's case ends in Schönhardt's polyhedron, and flips in exact order succeed on all inputs of
//! the gallery.

mod draw;
mod search;

use crate::frame::{About, Answer, Context, Expectation, Experiment, Failed, check_rows};
use search::Case;
use serde::Serialize;

/// The question.
pub struct Failures;

impl Experiment for Failures {
    fn about(&self) -> About {
        About {
            name: "failures",
            question: "the smallest failures of rounded flips, in pictures (paper, failure case of §3.4)",
            seconds: 10,
        }
    }

    fn run(&self, context: &Context) -> Result<Answer, Failed> {
        let cases = search::gallery(if context.quick { 8 } else { 200 }, context);
        let mut answer = context.answer();
        let mut rows = Vec::new();
        for (i, case) in cases.iter().enumerate() {
            let mut row = Row::new(case, i == 0);
            if let Some(svg) = draw::picture(case) {
                let m = &case.member;
                let input = format!("{}-{}-{}", m.family(), m.subfamily(), m.seed);
                let times = case.times.to_string().replace(':', "-");
                row.picture = format!("failures-{input}-{times}.svg");
                answer.file(&row.picture, &svg)?;
            }
            rows.push(row);
        }
        answer.csv(
            "failures",
            &rows,
            "input times vertices crossing_tets left class",
        )?;
        answer.say("experiments replay INPUT --times TIMES tells how it happens");
        answer.expectations = expectations(&rows);
        Ok(answer)
    }
}

/// `failures.csv`: one failure. The README of the package has the meaning of the columns.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
struct Row {
    input: String,
    papers: bool,
    family: &'static str,
    times: String,
    vertices: usize,
    polygons: usize,
    crossing_tets: usize,
    events: usize,
    outcome: &'static str,
    left: usize,
    class: &'static str,
    piece_tets: usize,
    piece_vertices: usize,
    exact_succeeds: bool,
    picture: String,
}

impl Row {
    fn new(case: &Case, papers: bool) -> Row {
        let piece = case.pieces.first();
        let complex = case.cdt.complex();
        Row {
            input: case.member.to_string(),
            papers,
            family: case.member.family(),
            times: case.times.to_string(),
            vertices: complex.representative.len(),
            polygons: complex.polygons.len(),
            crossing_tets: case.insertion.before.len(),
            events: case.insertion.events.len(),
            outcome: case.outcome,
            left: case.left,
            class: piece.map_or("", |p| p.class.name()),
            piece_tets: piece.map_or(0, |p| p.tets.len()),
            piece_vertices: piece.map_or(0, |p| p.vertices),
            exact_succeeds: case.exact_succeeds,
            picture: String::new(),
        }
    }
}

fn expectations(rows: &[Row]) -> Vec<Expectation> {
    let name = |r: &Row| format!("{}, {}", r.input, r.times);
    let mut all = check_rows(
        rows,
        name,
        &[
            ("flips in exact order succeed on every input", &|r| {
                r.exact_succeeds
            }),
            (
                "the paper's failure case ends in Schönhardt's polyhedron",
                &|r| !r.papers || (r.outcome, r.class) == ("stuck", "schoenhardt"),
            ),
        ],
    );
    let missing = !rows.iter().any(|r| r.papers && r.input == search::PAPERS);
    all.push(Expectation {
        statement: "the paper's failure case fails",
        broken_by: missing
            .then(|| search::PAPERS.to_string())
            .into_iter()
            .collect(),
    });
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::expectation::assert_each_can_fail;

    #[test]
    fn each_can_fail() {
        let papers = Row {
            input: search::PAPERS.to_string(),
            papers: true,
            outcome: "stuck",
            class: "schoenhardt",
            exact_succeeds: true,
            ..Row::default()
        };
        assert_each_can_fail(
            expectations,
            &[papers],
            &[
                (&|r| r.exact_succeeds = false, &[0]),
                (&|r| r.class = "undecided", &[1]),
                (&|r| r.papers = false, &[2]),
            ],
        );
    }
}
