//! What the rows must say. Of times nothing is asserted: they are the machine's.

use crate::expectation::{Check, Expectation, check_rows};
use crate::fig9::row::Row;
use crate::method::Method;

/// All expectations.
pub fn expectations(rows: &[Row]) -> Vec<Expectation> {
    let is_safe = |row: &Row| {
        let mut methods = Method::all().into_iter();
        methods.any(|m| m.always_succeeds() && row.is_of(m))
    };
    let checks: [Check<Row>; 7] = [
        ("cavities and exact flips always succeed", &|r| {
            r.is_ok() || !is_safe(r)
        }),
        ("every result is verified to be the CDT", &|r| {
            !r.is_ok() || r.verified == Some(true)
        }),
        ("all results of one scene are equal", &|r| {
            !r.is_ok() || r.agrees == Some(true)
        }),
        ("exact flips need none of the paper's patches", &|r| {
            let patches = [
                r.postponed,
                r.discarded_outside,
                r.non_crossing,
                r.overflows,
            ];
            !is_safe(r) || patches == [0; 4]
        }),
        ("no cavity is left to flips", &|r| r.cavity_fallbacks == 0),
        ("every scene has one region and no Steiner point", &|r| {
            (r.regions, r.steiner_points) == (1, 0)
        }),
        ("repetitions repeat counts and outcome", &|r| r.repeatable),
    ];
    check_rows(rows, &checks, Row::name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Slab;

    const SLAB: Slab = Slab {
        vertices: 10,
        half_height: 1.0,
        seed: 3,
    };

    fn good(method: usize) -> Row {
        Row {
            outcome: "ok",
            regions: 1,
            repeatable: true,
            agrees: Some(true),
            verified: Some(true),
            ..Row::new(SLAB, Method::all()[method])
        }
    }

    /// Which expectations a row breaks.
    fn broken(row: Row) -> Vec<usize> {
        let all = expectations(&[good(0), row]);
        let broken = all
            .iter()
            .enumerate()
            .filter(|(_, e)| !e.broken_by.is_empty());
        broken.map(|(i, _)| i).collect()
    }

    #[test]
    fn each_expectation_can_fail() {
        let (cavity, exact) = (0, 3);
        assert!(broken(good(exact)).is_empty());
        let stuck = Row {
            outcome: "stuck",
            agrees: None,
            verified: None,
            ..good(exact)
        };
        assert_eq!(broken(stuck), [0]);
        let verified = [Some(false), None];
        for verified in verified {
            assert_eq!(
                broken(Row {
                    verified,
                    ..good(1)
                }),
                [1]
            );
        }
        let agrees = Some(false);
        assert_eq!(broken(Row { agrees, ..good(2) }), [2]);
        let postponed = 1;
        assert_eq!(
            broken(Row {
                postponed,
                ..good(exact)
            }),
            [3]
        );
        let cavity_fallbacks = 1;
        assert_eq!(
            broken(Row {
                cavity_fallbacks,
                ..good(cavity)
            }),
            [4]
        );
        assert_eq!(
            broken(Row {
                regions: 2,
                ..good(cavity)
            }),
            [5]
        );
        assert_eq!(
            broken(Row {
                steiner_points: 1,
                ..good(cavity)
            }),
            [5]
        );
        assert_eq!(
            broken(Row {
                repeatable: false,
                ..good(1)
            }),
            [6]
        );
    }

    #[test]
    fn rounded_times_may_fail_and_may_be_patched() {
        let stuck = Row {
            outcome: "stuck",
            postponed: 3,
            agrees: None,
            verified: None,
            ..good(2)
        };
        assert!(broken(stuck).is_empty());
        let breaker = expectations(&[Row {
            regions: 0,
            ..good(1)
        }]);
        assert_eq!(breaker[5].broken_by, ["10 vertices, seed 3, flip f32"]);
    }
}
