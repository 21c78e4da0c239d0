//! What the rows must say. Of times nothing is asserted.

use super::row::Row;
use crate::expectation::{Check, Expectation, check_rows};

/// All expectations.
pub fn expectations(rows: &[Row]) -> Vec<Expectation> {
    let same = |row: &Row| {
        let others = rows
            .iter()
            .filter(|r| r.input == row.input && r.tetrahedra.is_some());
        others.map(|r| r.tetrahedra).all(|n| n == row.tetrahedra)
    };
    let checks: [Check<Row>; 2] = [
        ("this library succeeds on every input but a user's", &|r| {
            !r.is_ours || r.is_ok() || r.kind.starts_with("model")
        }),
        (
            "all programs give equally many tetrahedra for points in general position",
            &|r| !r.generic || r.tetrahedra.is_none() || same(r),
        ),
    ];
    check_rows(rows, &checks, Row::name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::outcome;

    #[test]
    fn each_can_be_broken() {
        let row = |is_ours, generic, tetrahedra, outcome| Row {
            is_ours,
            generic,
            tetrahedra,
            outcome,
            ..Row::default()
        };
        let broken =
            |rows: &[Row]| -> Vec<bool> { expectations(rows).iter().map(|e| !e.holds()).collect() };
        let good = row(true, true, Some(7), outcome::OK);
        assert_eq!(broken(std::slice::from_ref(&good)), [false, false]);
        let other = row(false, true, Some(8), outcome::OK);
        assert_eq!(broken(&[good.clone(), other]), [false, true]);
        let crashed = row(false, true, None, "failed");
        assert_eq!(broken(&[good, crashed]), [false, false]);
        assert_eq!(broken(&[row(true, false, None, "failed")]), [true, false]);
    }
}
