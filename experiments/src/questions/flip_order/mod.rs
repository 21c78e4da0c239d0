//! The order of flips, rounded and exact (§3.3 and the failure case of §3.4).
//!
//! **Question.** How often do flips come off the queue in the wrong order when their times are rounded, what do the
//! paper's three patches make of it, how often does the insertion fail, and what is left then? Does the exact order,
//! with the perturbation, always succeed?
//!
//! **Inputs.** Small PLCs of ten families ([`crate::families`]) that make ties, near ties and large rounding
//! errors; every polygon is exactly flat.
//!
//! **Columns.** [`row::Summary`], [`row::FailureRow`]; the README of this package has their meaning.
//!
//! **Expected.** Every exact number type succeeds on every input, without a patch and without an inversion, and ends in
//! the tetrahedra of cavity retriangulation ([`expect`]). Rounded times may fail. Asserted at the end.

pub mod dump;
mod expect;
pub mod measure;
mod merge;
pub mod plan;
pub mod replay;
mod row;

use crate::families::{FAMILIES, Member};
use crate::frame::record::Results;
use crate::frame::{About, Answer, Context, Experiment, Failed};
use crate::pictures::plot::{Plot, PlotError, Scale, Series};
use plan::Plan;
use row::{ALL, Summary};
use std::path::PathBuf;

/// The question.
pub struct FlipOrder;

impl Experiment for FlipOrder {
    fn about(&self) -> About {
        About {
            name: "flip_order",
            question: "what becomes of flips whose times are rounded (paper, §3.3, failure case of §3.4)",
            seconds: 300,
        }
    }

    fn run(&self, context: &Context) -> Result<Answer, Failed> {
        let plan = context.plan(Plan::quick, Plan::full);
        let mut members = Member::of_each_family(plan.per_family);
        if let Some(shard) = context.shard {
            members.retain(|member| shard.has(&member.to_string()));
        }
        let mut inputs =
            context.measure_on_all_processors(&members, |&member| measure::measure(member, &plan));
        inputs.sort_by_key(|m| m.member.key());
        let rows = row::summaries(&inputs, &plan);
        let failures = row::failures(&inputs);
        let mut answer = context.answer();
        answer.say(row::table(&rows, &plan));
        let runs: usize = inputs.iter().map(|m| m.runs.len()).sum();
        answer.say(format!(
            "\n{} inputs, {runs} runs, {} failed",
            inputs.len(),
            failures.len()
        ));
        answer.csv("flip_order", &rows, "")?;
        // A shard may have none, and has no plot.
        if context.shard.is_none() || !failures.is_empty() {
            answer.csv("flip_order-failures", &failures, "")?;
        }
        if context.shard.is_none() {
            answer.file("flip_order-precision.svg", &precision(&rows)?)?;
        }
        answer.expectations = expect::expectations(&inputs);
        Ok(answer)
    }

    fn join(&self, shards: &[PathBuf], results: &Results) -> Result<Vec<PathBuf>, Failed> {
        merge::merge(shards, results)
    }
}

/// The failure rate of times rounded in every operation (`bits:N`) against their precision, by family. Families
/// without a failure at some precision have no point there, because the axes are logarithmic.
fn precision(rows: &[Summary]) -> Result<String, PlotError> {
    let series = FAMILIES.iter().map(|family| {
        let of_family = rows
            .iter()
            .filter(|r| r.family == family.name && r.subfamily == ALL)
            .filter(|r| r.numbers.starts_with("bits:"));
        let points = of_family.filter_map(|r| Some((f64::from(r.precision?), r.failure_rate)));
        Series::new(family.name, points.filter(|&(_, rate)| rate > 0.0))
    });
    let plot = Plot {
        title: "Rounded flip times that do not end in the CDT",
        x_label: "bits of the significand",
        y_label: "part of the inputs",
        scale: Scale::Log,
        series: series.filter(|s| !s.points.is_empty()).collect(),
        guides: Vec::new(),
    };
    plot.svg()
}
