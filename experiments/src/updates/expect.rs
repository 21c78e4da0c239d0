//! What the rows must say. Of times nothing is asserted.

use super::row::Row;
use crate::expectation::{Check, Expectation, check_rows};

/// All expectations.
pub fn expectations(rows: &[Row]) -> Vec<Expectation> {
    let built_in = |r: &Row| r.source != "models";
    let checks: [Check<Row>; 4] = [
        ("every built-in input succeeds", &|r| {
            !built_in(r) || r.is_ok()
        }),
        ("no deletion of a flat polygon is refused", &|r| {
            r.refused <= r.not_flat
        }),
        ("a scene without its polygon is what it was before", &|r| {
            r.without_is_before != Some(false)
        }),
        ("in the end every mesh is what it was", &|r| {
            r.same != Some(false)
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
            without_is_before: Some(true),
            same: Some(true),
            ..Row::default()
        };
        let broken = |row: Row| {
            let all = expectations(&[good.clone(), row]).into_iter().enumerate();
            let broken = all.filter(|(_, e)| !e.holds()).map(|(i, _)| i);
            broken.collect::<Vec<usize>>()
        };
        assert!(broken(good.clone()).is_empty());
        let mut bad = good.clone();
        bad.outcome = "stuck";
        assert_eq!(broken(bad), [0]);
        let mut bad = good.clone();
        bad.refused = 1;
        assert_eq!(broken(bad), [1]);
        let mut bad = good.clone();
        bad.without_is_before = Some(false);
        assert_eq!(broken(bad), [2]);
        let mut bad = good.clone();
        bad.same = Some(false);
        assert_eq!(broken(bad), [3]);
    }
}
