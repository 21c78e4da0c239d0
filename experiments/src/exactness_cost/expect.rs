//! What the rows must say. Of times nothing is asserted: the targets are reported as reached or missed ([`crate::exactness_cost::summary`]).

use crate::exactness_cost::plan::methods;
use crate::exactness_cost::row::Row;
use crate::expectation::{Check, Expectation, check_rows};

/// All expectations.
pub fn expectations(rows: &[Row]) -> Vec<Expectation> {
    let methods = methods();
    let is_safe = |row: &Row| {
        let mut safe = methods.iter().filter(|m| m.always_succeeds());
        safe.any(|m| m.to_string() == row.method)
    };
    let checks: [Check<Row>; 6] = [
        ("all but rounded flips always succeed", &|r| {
            r.is_ok() || !is_safe(r)
        }),
        ("every result is verified to be the CDT", &|r| {
            !r.is_ok() || r.verified == Some(true)
        }),
        ("all results of one input are equal", &|r| {
            !r.is_ok() || r.agrees == Some(true)
        }),
        ("exact flips need none of the paper's patches", &|r| {
            !is_safe(r) || r.patches == 0
        }),
        (
            "no Steiner point, and nothing left to another method",
            &|r| (r.steiner_points, r.fallbacks) == (0, 0),
        ),
        ("repetitions repeat counts and outcome", &|r| r.repeatable),
    ];
    check_rows(rows, &checks, Row::name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exactness_cost::input::{Input, Kind};

    fn good(method: usize) -> Row {
        let input = Input {
            kind: Kind::Slab,
            about: 100,
            seed: 1,
        };
        Row {
            outcome: "ok",
            repeatable: true,
            agrees: Some(true),
            verified: Some(true),
            ..Row::new(&input, methods()[method])
        }
    }

    /// Which expectations a row breaks.
    fn broken(row: Row) -> Vec<usize> {
        let all = expectations(&[good(0), row]).into_iter().enumerate();
        all.filter(|(_, e)| !e.holds()).map(|(i, _)| i).collect()
    }

    #[test]
    fn each_expectation_can_fail() {
        let (f64, filtered) = (0, 2);
        assert!(broken(good(filtered)).is_empty());
        let stuck = |method| Row {
            outcome: "stuck",
            agrees: None,
            verified: None,
            patches: 3,
            ..good(method)
        };
        assert!(broken(stuck(f64)).is_empty(), "rounded times may fail");
        assert_eq!(broken(stuck(filtered)), [0, 3]);
        let mut bad = good(f64);
        bad.verified = Some(false);
        assert_eq!(broken(bad), [1]);
        let mut bad = good(f64);
        bad.agrees = Some(false);
        assert_eq!(broken(bad), [2]);
        let mut bad = good(f64);
        bad.steiner_points = 1;
        assert_eq!(broken(bad), [4]);
        let mut bad = good(f64);
        bad.repeatable = false;
        assert_eq!(broken(bad), [5]);
    }
}
