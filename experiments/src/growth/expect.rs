//! What the rows must say. Of times nothing is asserted.

use crate::expectation::{Check, Expectation, check_rows};
use crate::growth::row::Row;

/// All expectations.
pub fn expectations(rows: &[Row]) -> Vec<Expectation> {
    let checks: [Check<Row>; 4] = [
        ("both methods succeed at every size", &|r| r.is_ok()),
        ("they give the same tetrahedra", &|r| {
            r.agrees != Some(false)
        }),
        (
            "one region, no Steiner point, nothing left to another method",
            &|r| !r.is_ok() || (r.regions, r.steiner_points, r.fallbacks) == (1, 0, 0),
        ),
        ("repetitions repeat counts and outcome", &|r| {
            !r.is_ok() || r.repeatable
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
            outcome: "ok",
            regions: 1,
            repeatable: true,
            agrees: Some(true),
            ..Row::default()
        };
        let broken = |row: Row| {
            let all = expectations(&[good.clone(), row]).into_iter().enumerate();
            let broken = all.filter(|(_, e)| !e.holds()).map(|(i, _)| i);
            broken.collect::<Vec<usize>>()
        };
        assert!(broken(good.clone()).is_empty());
        let mut bad = good.clone();
        (bad.outcome, bad.agrees) = ("stuck", None);
        assert_eq!(broken(bad), [0]);
        let mut bad = good.clone();
        bad.agrees = Some(false);
        assert_eq!(broken(bad), [1]);
        let mut bad = good.clone();
        bad.fallbacks = 1;
        assert_eq!(broken(bad), [2]);
        let mut bad = good.clone();
        bad.repeatable = false;
        assert_eq!(broken(bad), [3]);
    }
}
