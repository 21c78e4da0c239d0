//! What the rows must say.

use super::row::Row;
use crate::expectation::{Check, Expectation, check_rows};

/// All expectations.
pub fn expectations(rows: &[Row]) -> Vec<Expectation> {
    let checks: [Check<Row>; 2] = [
        ("every size succeeds", &|r| r.is_ok()),
        ("uniform points have 6 to 7 tetrahedra each", &|r| {
            let each = r.tetrahedra.map(|n| n as f64 / r.size as f64);
            r.input != "uniform" || each.is_some_and(|e| (6.0..7.0).contains(&e))
        }),
    ];
    check_rows(rows, &checks, Row::name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::outcome;

    #[test]
    fn each_can_be_broken() {
        let row = |tetrahedra, outcome| Row {
            input: "uniform",
            size: 1000,
            tetrahedra,
            outcome,
            ..Row::default()
        };
        let broken = |row| -> Vec<bool> {
            let found = expectations(&[row]);
            found.iter().map(|e| !e.holds()).collect()
        };
        assert_eq!(broken(row(Some(6500), outcome::OK)), [false, false]);
        assert_eq!(broken(row(Some(5000), outcome::OK)), [false, true]);
        assert_eq!(broken(row(None, "failed")), [true, true]);
    }
}
