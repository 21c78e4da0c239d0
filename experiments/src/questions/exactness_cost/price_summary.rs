//! `exactness_cost-price-summary.csv`: medians by input, size class and arm, with intervals; and what the rows must
//! say.

use super::price::{FILTERED, Row};
use crate::frame::{Expectation, check_rows};
use crate::measure::outcome;
use crate::measure::sample::{median, rounded};
use serde::Serialize;

/// One arm in one size class. The README of the package has the meaning of the columns.
#[allow(missing_docs)]
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Summary {
    pub input: &'static str,
    pub about: u64,
    pub arm: &'static str,
    pub inputs: usize,
    pub succeeded: usize,
    pub median_microseconds_per_tet: Option<f64>,
    pub filtered_over_arm: Option<f64>,
    pub low: Option<f64>,
    pub high: Option<f64>,
    pub least: Option<f64>,
    pub most: Option<f64>,
}

/// In the order of the rows.
pub fn summaries(rows: &[Row]) -> Vec<Summary> {
    let mut summaries: Vec<Summary> = Vec::new();
    for row in rows {
        let key = (row.input, row.about, row.arm);
        if summaries.iter().any(|s| (s.input, s.about, s.arm) == key) {
            continue;
        }
        let of_class = rows.iter().filter(|r| (r.input, r.about, r.arm) == key);
        let good: Vec<&Row> = of_class
            .clone()
            .filter(|r| r.outcome == outcome::OK)
            .collect();
        let mut ratios: Vec<f64> = good.iter().filter_map(|r| r.filtered_over_arm).collect();
        ratios.sort_unstable_by(f64::total_cmp);
        let per_tet = good
            .iter()
            .filter_map(|r| Some(r.median_seconds? * 1e6 / r.crossing_tets as f64));
        let interval = interval_of_median(ratios.len());
        summaries.push(Summary {
            input: row.input,
            about: row.about,
            arm: row.arm,
            inputs: of_class.count(),
            succeeded: good.len(),
            median_microseconds_per_tet: median(&per_tet.collect::<Vec<_>>()).map(rounded),
            filtered_over_arm: median(&ratios).map(rounded),
            low: interval.map(|i| ratios[i]),
            high: interval.map(|i| ratios[ratios.len() - 1 - i]),
            least: ratios.first().copied(),
            most: ratios.last().copied(),
        });
    }
    summaries
}

/// The place i in a sorted sample of n such that the median of what it was drawn from lies between the i-th least and
/// the i-th greatest with a probability of 95 % at least, whatever the distribution; none if n is too small. (Each of
/// the sample is above the median with probability 1/2.)
fn interval_of_median(n: usize) -> Option<usize> {
    let mut probability = 0.5f64.powi(i32::try_from(n).ok()?);
    let (mut below, mut place) = (probability, None);
    for i in 0..n / 2 {
        // `below` is the probability that at most i of the sample are below the median.
        if below > 0.025 {
            break;
        }
        place = Some(i);
        probability *= (n - i) as f64 / (i + 1) as f64;
        below += probability;
    }
    place
}

/// What the rows must say. Nothing is asserted of times.
pub fn expectations(rows: &[Row]) -> Vec<Expectation> {
    let is_exact = |r: &Row| [FILTERED, "no-integers", "no-enclosures"].contains(&r.arm);
    check_rows(
        rows,
        |r| format!("{}:{} of about {}, {}", r.input, r.seed, r.about, r.arm),
        &[
            ("the exact orders succeed, with the same tetrahedra", &|r| {
                !is_exact(r) || r.outcome == outcome::OK
            }),
            (
                "in general position all orders succeed, with the same tetrahedra",
                &|r| r.input != "generic" || r.outcome == outcome::OK,
            ),
        ],
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::expectation::assert_each_can_fail;

    fn row(seed: u64, arm: &'static str, ratio: f64) -> Row {
        Row {
            input: "generic",
            about: 100,
            seed,
            crossing_tets: 100,
            arm,
            median_seconds: Some(1e-4),
            filtered_over_arm: Some(ratio),
            outcome: outcome::OK,
            ..Row::default()
        }
    }

    #[test]
    fn intervals_are_those_of_the_sign_test() {
        // From tables of the binomial distribution.
        for (n, place) in [
            (5, None),
            (6, Some(0)),
            (9, Some(1)),
            (12, Some(2)),
            (24, Some(6)),
        ] {
            assert_eq!(interval_of_median(n), place, "{n}");
        }
    }

    #[test]
    fn medians_of_successes() {
        let mut rows: Vec<Row> = (1..=9).map(|i| row(i, "rounded-keys", i as f64)).collect();
        rows.push(Row {
            outcome: "flip-order",
            median_seconds: None,
            filtered_over_arm: None,
            ..row(10, "rounded-keys", 0.0)
        });
        let summary = &summaries(&rows)[0];
        assert_eq!((summary.inputs, summary.succeeded), (10, 9));
        let ends = [
            summary.least,
            summary.low,
            summary.filtered_over_arm,
            summary.high,
            summary.most,
        ];
        assert_eq!(ends, [1.0, 2.0, 5.0, 8.0, 9.0].map(Some));
        assert_eq!(summary.median_microseconds_per_tet, Some(1.0));
        let good = [row(1, "rounded-keys", 1.0), row(1, FILTERED, 1.0)];
        assert_each_can_fail(
            expectations,
            &good,
            &[(&|r| r.outcome = "flip-order", &[0, 1])],
        );
    }
}
