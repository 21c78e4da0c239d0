//! What the rows must say.

use super::row::Row;
use crate::expectation::{Check, Expectation, check_rows};

/// All expectations.
pub fn expectations(rows: &[Row]) -> Vec<Expectation> {
    let checks: [Check<Row>; 2] = [
        ("flips in exact order succeed on every input", &|r| {
            r.exact_succeeds
        }),
        (
            "the paper's failure case ends in Schönhardt's polyhedron",
            &|r| !r.papers || (r.outcome, r.class) == ("stuck", "schoenhardt"),
        ),
    ];
    let mut all = check_rows(rows, &checks, Row::name);
    let found = rows.iter().any(|r| r.papers && r.input == "prism/end:78");
    all.push(Expectation {
        statement: "the paper's failure case fails",
        broken_by: if found {
            Vec::new()
        } else {
            vec!["prism/end:78".to_string()]
        },
    });
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_can_be_broken() {
        let papers = Row {
            input: "prism/end:78".to_string(),
            papers: true,
            outcome: "stuck",
            class: "schoenhardt",
            exact_succeeds: true,
            ..Row::default()
        };
        let broken =
            |rows: &[Row]| -> Vec<bool> { expectations(rows).iter().map(|e| !e.holds()).collect() };
        assert_eq!(broken(std::slice::from_ref(&papers)), [false; 3]);
        assert_eq!(broken(&[]), [false, false, true]);
        let other = Row {
            exact_succeeds: false,
            papers: false,
            ..papers.clone()
        };
        assert_eq!(broken(&[papers.clone(), other]), [true, false, false]);
        let class = "undecided";
        assert_eq!(broken(&[Row { class, ..papers }]), [false, true, false]);
    }
}
