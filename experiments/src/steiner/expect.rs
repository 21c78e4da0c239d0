//! What the rows must say. Of the number of points, and of other programs, next to nothing is asserted.

use crate::expectation::{Check, Expectation, check_rows};
use crate::steiner::measure::TETFLIP;
use crate::steiner::row::Row;

/// Steiner points for each segment of a built-in model, at most. Recovery that is about to run away has more.
const MOST_PER_SEGMENT: usize = 200;

/// All expectations.
pub fn expectations(rows: &[Row]) -> Vec<Expectation> {
    let ours = |r: &Row| r.method == TETFLIP;
    let built_in = |r: &Row| ours(r) && r.source == crate::steiner::BUILT_IN;
    let few = |r: &Row| r.steiner_points <= r.segments.map(|n| MOST_PER_SEGMENT * n);
    let checks: [Check<Row>; 3] = [
        ("segment recovery ends on every built-in model", &|r| {
            !built_in(r) || r.is_ok()
        }),
        ("with a bounded number of points for each segment", &|r| {
            !built_in(r) || !r.is_ok() || few(r)
        }),
        ("every mesh is verified to be the CDT", &|r| {
            !ours(r) || r.verified != Some(false)
        }),
    ];
    check_rows(rows, &checks, Row::name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_expectation_can_fail() {
        let good = Row {
            source: crate::steiner::BUILT_IN,
            method: TETFLIP.to_string(),
            segments: Some(2),
            steiner_points: Some(7),
            outcome: "ok",
            verified: Some(true),
            ..Row::default()
        };
        let broken = |row: Row| {
            let all = expectations(&[good.clone(), row]).into_iter().enumerate();
            let broken = all.filter(|(_, e)| !e.holds()).map(|(i, _)| i);
            broken.collect::<Vec<usize>>()
        };
        assert!(broken(good.clone()).is_empty());
        let mut bad = good.clone();
        (bad.outcome, bad.verified) = ("segment-too-short", None);
        assert_eq!(broken(bad), [0]);
        let mut bad = good.clone();
        bad.steiner_points = Some(1000);
        assert_eq!(broken(bad), [1]);
        let mut bad = good.clone();
        bad.verified = Some(false);
        assert_eq!(broken(bad), [2]);
    }
}
