//! The rows of the tables. The README of this package explains the columns.

use super::trial::Seen;
use crate::frame::{Expectation, check_rows};
use crate::measure::{outcome, wilson};
use serde::Serialize;
use tetflip::recover::polygons::FlipOrder;

/// What does not depend on the arm.
#[allow(missing_docs)]
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct OfModel {
    pub source: &'static str,
    pub model: String,
    pub vertices: usize,
    pub facets: usize,
    pub polygons: usize,
    pub steiner: &'static str,
    pub steiner_points: usize,
    pub regions: u64,
    pub not_flat: u64,
    pub crossing_tets: u64,
    pub largest_region: u64,
    pub agrees: Option<bool>,
    pub outcome: &'static str,
}

/// Which arm.
#[allow(missing_docs)]
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct OfArm {
    pub times: String,
}

/// What it made of the model's regions.
#[allow(missing_docs)]
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Counts {
    pub tried: u64,
    pub tied_regions: u64,
    pub circuit_tied_regions: u64,
    pub failed_regions: u64,
    pub failed_tied: u64,
    pub stuck: u64,
    pub not_delaunay: u64,
    pub patched_regions: u64,
    pub flips: u64,
    pub discarded_outside: u64,
    pub non_crossing: u64,
    pub postponed: u64,
}

/// `flip_models.csv`: one arm on one model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Row {
    pub of_model: OfModel,
    pub arm: OfArm,
    pub counts: Counts,
    is_exact: bool,
}

crate::row_of_groups!(Row: of_model, arm, counts);

impl Row {
    /// Of an arm that has not met any region.
    pub fn new(of_model: &OfModel, arm: FlipOrder) -> Row {
        Row {
            of_model: of_model.clone(),
            arm: OfArm {
                times: arm.to_string(),
            },
            is_exact: arm.is_exact(),
            ..Row::default()
        }
    }

    /// Counts what it made of regions.
    pub fn count(&mut self, seen: &[Seen]) {
        let count = |is: &dyn Fn(&Seen) -> bool| seen.iter().filter(|s| is(s)).count() as u64;
        let sum = |of: fn(&Seen) -> u64| seen.iter().map(of).sum::<u64>();
        self.counts = Counts {
            tried: seen.len() as u64,
            tied_regions: count(&|s| s.exact_ties > 0),
            circuit_tied_regions: count(&|s| s.circuit_ties > 0),
            failed_regions: count(&|s| !s.is_ok()),
            failed_tied: count(&|s| !s.is_ok() && s.exact_ties > 0),
            stuck: count(&|s| s.outcome == "stuck"),
            not_delaunay: count(&|s| s.outcome == "not-delaunay"),
            patched_regions: count(&Seen::is_patched),
            flips: sum(|s| s.counts.flips()),
            discarded_outside: sum(|s| s.counts.discarded_outside),
            non_crossing: sum(|s| s.counts.non_crossing),
            postponed: sum(|s| s.counts.postponed),
        };
    }

    /// Whether the model has a CDT by the exact order, so that the arm met all its regions.
    pub fn is_ok(&self) -> bool {
        self.of_model.outcome == outcome::OK
    }
}

/// `flip_models-summary.csv`: one arm on all models of a source.
#[allow(missing_docs)]
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Summary {
    pub source: &'static str,
    pub times: String,
    pub models: u64,
    pub left_out: u64,
    pub models_with_regions: u64,
    pub models_with_ties: u64,
    pub regions: u64,
    pub tied_regions: u64,
    pub not_flat: u64,
    pub patched_regions: u64,
    pub failed_regions: u64,
    pub failed_tied: u64,
    pub failed_models: u64,
    pub model_rate: f64,
    pub model_low: f64,
    pub model_high: f64,
}

/// One row per source and arm. Only models with a region count in rates.
pub fn summaries(rows: &[Row], arms: &[FlipOrder]) -> Vec<Summary> {
    let mut summaries = Vec::new();
    for source in ["generated", "models"] {
        for arm in arms {
            let times = arm.to_string();
            let is_of = |r: &&Row| r.of_model.source == source && r.arm.times == times;
            let all: Vec<&Row> = rows.iter().filter(is_of).collect();
            if all.is_empty() {
                continue;
            }
            let good: Vec<&Row> = all.iter().copied().filter(|r| r.is_ok()).collect();
            let count = |is: fn(&Row) -> bool| good.iter().filter(|r| is(r)).count() as u64;
            let sum = |of: fn(&Row) -> u64| good.iter().map(|r| of(r)).sum::<u64>();
            let with_regions = count(|r| r.counts.tried > 0);
            let failed_models = count(|r| r.counts.failed_regions > 0);
            let [low, high] = wilson::interval(failed_models, with_regions);
            let six = |x: f64| (x * 1e6).round() / 1e6;
            summaries.push(Summary {
                source,
                models: good.len() as u64,
                left_out: (all.len() - good.len()) as u64,
                models_with_regions: with_regions,
                models_with_ties: count(|r| r.counts.tied_regions > 0),
                regions: sum(|r| r.counts.tried),
                tied_regions: sum(|r| r.counts.tied_regions),
                not_flat: sum(|r| r.of_model.not_flat),
                patched_regions: sum(|r| r.counts.patched_regions),
                failed_regions: sum(|r| r.counts.failed_regions),
                failed_tied: sum(|r| r.counts.failed_tied),
                failed_models,
                model_rate: six(failed_models as f64 / with_regions.max(1) as f64),
                model_low: six(low),
                model_high: six(high),
                times,
            });
        }
    }
    summaries
}

/// What the rows must say.
pub fn expectations(rows: &[Row]) -> Vec<Expectation> {
    check_rows(
        rows,
        |r| format!("{} with {}", r.of_model.model, r.arm.times),
        &[
            ("every generated model has a CDT", &|r| {
                r.is_ok() || r.of_model.source != "generated"
            }),
            (
                "cavity retriangulation ends in the tetrahedra of the exact order, where all polygons are flat",
                &|r| r.of_model.agrees != Some(false),
            ),
            (
                "the exact orders insert every region, without a patch",
                &|r| !r.is_exact || (r.counts.failed_regions, r.counts.patched_regions) == (0, 0),
            ),
            ("every arm meets every region of a flat polygon", &|r| {
                !r.is_ok() || r.counts.tried + r.of_model.not_flat >= r.of_model.regions
            }),
        ],
    )
}

#[cfg(test)]
mod tests {
    use super::super::arms;
    use super::*;
    use crate::frame::expectation::assert_each_can_fail;

    fn row(arm: FlipOrder, failed: u64) -> Row {
        let of_model = OfModel {
            source: "generated",
            regions: 5,
            outcome: outcome::OK,
            ..OfModel::default()
        };
        let counts = Counts {
            tried: 5,
            tied_regions: 2,
            failed_regions: failed,
            failed_tied: failed,
            ..Counts::default()
        };
        Row {
            counts,
            ..Row::new(&of_model, arm)
        }
    }

    #[test]
    fn rates_are_of_models_and_each_expectation_can_fail() {
        let arms = arms();
        let exact = arms.iter().copied().find(|a| a.is_exact()).expect("one");
        let rounded = arms.iter().copied().find(|a| !a.is_exact()).expect("one");
        let rows = [row(rounded, 3), row(rounded, 0), row(exact, 0)];
        let of_rounded = &summaries(&rows, &[rounded])[0];
        assert_eq!((of_rounded.models, of_rounded.regions), (2, 10));
        assert_eq!(
            (of_rounded.failed_models, of_rounded.failed_regions),
            (1, 3)
        );
        assert!(of_rounded.model_low < 0.5 && of_rounded.model_high > 0.5);
        assert_each_can_fail(
            expectations,
            &rows,
            &[
                (&|r| r.of_model.outcome = "stuck", &[0]),
                (&|r| r.of_model.agrees = Some(false), &[1]),
                (&|r| r.counts.failed_regions = 1, &[2]),
                (&|r| r.counts.tried = 4, &[3]),
            ],
        );
    }
}
