//! What the rows must say. Of times nothing is asserted.

use super::row::Row;
use crate::expectation::{Check, Expectation, check_rows};

/// All expectations.
pub fn expectations(rows: &[Row]) -> Vec<Expectation> {
    let made = |r: &Row| r.source == "generated";
    let checks: [Check<Row>; 4] = [
        ("every built-in model has a CDT", &|r| !made(r) || r.is_ok()),
        (
            "cavities, flips and gift wrapping give the same tetrahedra",
            &|r| r.agrees != Some(false),
        ),
        ("every mesh is verified", &|r| r.verified != Some(false)),
        ("the verifier was asked", &|r| {
            !made(r) || !r.is_ok() || r.verified.is_some()
        }),
    ];
    check_rows(rows, &checks, |r| r.model.clone())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::outcome;

    #[test]
    fn each_can_be_broken() {
        let good = Row {
            source: "generated",
            outcome: outcome::OK,
            agrees: Some(true),
            verified: Some(true),
            ..Row::default()
        };
        let broken = |row| -> Vec<bool> {
            let found = expectations(&[row]);
            found.iter().map(|e| !e.holds()).collect()
        };
        assert_eq!(broken(good.clone()), [false; 4]);
        let outcome = "not-flat";
        assert_eq!(
            broken(Row {
                outcome,
                ..good.clone()
            }),
            [true, false, false, false]
        );
        let no = Some(false);
        assert_eq!(
            broken(Row {
                agrees: no,
                ..good.clone()
            }),
            [false, true, false, false]
        );
        assert_eq!(
            broken(Row {
                verified: no,
                ..good.clone()
            }),
            [false, false, true, false]
        );
        assert_eq!(
            broken(Row {
                verified: None,
                ..good
            }),
            [false, false, false, true]
        );
    }
}
