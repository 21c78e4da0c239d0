//! What the rows of an experiment must say, and who says otherwise.

/// A statement and what breaks it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Expectation {
    /// What is expected.
    pub statement: &'static str,
    /// The names of the rows, or inputs, of which it does not hold.
    pub broken_by: Vec<String>,
}

impl Expectation {
    /// Whether nothing breaks it.
    pub fn holds(&self) -> bool {
        self.broken_by.is_empty()
    }
}

/// One expectation: what it says, and the check of a row.
pub type Check<'a, Row> = (&'static str, &'a dyn Fn(&Row) -> bool);

/// What becomes of each check.
pub fn check_rows<Row>(
    rows: &[Row],
    name: impl Fn(&Row) -> String,
    checks: &[Check<Row>],
) -> Vec<Expectation> {
    let of_check = |(statement, holds): &Check<Row>| Expectation {
        statement,
        broken_by: rows.iter().filter(|r| !holds(r)).map(&name).collect(),
    };
    checks.iter().map(of_check).collect()
}

/// A line for each expectation, and one for each breaker.
pub fn text(expectations: &[Expectation]) -> String {
    let mut text = String::new();
    for expectation in expectations {
        let mark = if expectation.holds() { "ok" } else { "BROKEN" };
        text += &format!("[{mark}] {}\n", expectation.statement);
        for name in &expectation.broken_by {
            text += &format!("  not: {name}\n");
        }
    }
    text
}

/// A change of a good row, and the expectations that it breaks.
#[cfg(test)]
pub type Change<'a, Row> = (&'a dyn Fn(&mut Row), &'a [usize]);

/// Asserts that good rows break nothing, that each change of the last one breaks just what is said, and that every
/// expectation is broken by some change: one that cannot fail says nothing.
///
/// # Panics
/// If not.
#[cfg(test)]
pub fn assert_each_can_fail<Row: Clone>(
    expectations: impl Fn(&[Row]) -> Vec<Expectation>,
    good: &[Row],
    changes: &[Change<Row>],
) {
    let broken = |rows: &[Row]| -> Vec<usize> {
        let all = expectations(rows).into_iter().enumerate();
        all.filter(|(_, e)| !e.holds()).map(|(i, _)| i).collect()
    };
    assert_eq!(broken(good), [] as [usize; 0], "good rows");
    let mut can_fail = vec![false; expectations(good).len()];
    for (i, (change, expected)) in changes.iter().enumerate() {
        let mut rows = good.to_vec();
        change(rows.last_mut().expect("a good row"));
        assert_eq!(broken(&rows), *expected, "change {i}");
        expected.iter().for_each(|&e| can_fail[e] = true);
    }
    assert!(can_fail.iter().all(|&can| can), "{can_fail:?}");
}

#[cfg(test)]
mod tests {
    use super::*;

    fn small_and_odd(rows: &[i32]) -> Vec<Expectation> {
        let checks: [Check<i32>; 2] = [("small", &|x| *x < 10), ("odd", &|x| x % 2 == 1)];
        check_rows(rows, i32::to_string, &checks)
    }

    #[test]
    fn breakers_are_named() {
        let found = small_and_odd(&[1, 12, 3]);
        assert!(!found[0].holds() && found[0].broken_by == ["12"]);
        assert_eq!(text(&found[..1]), "[BROKEN] small\n  not: 12\n");
        assert_eq!(text(&small_and_odd(&[1])), "[ok] small\n[ok] odd\n");
    }

    #[test]
    fn each_can_fail() {
        assert_each_can_fail(
            small_and_odd,
            &[1, 3],
            &[(&|x| *x = 4, &[1]), (&|x| *x = 13, &[0])],
        );
    }

    #[test]
    #[should_panic(expected = "[true, false]")]
    fn what_never_fails_is_found() {
        assert_each_can_fail(small_and_odd, &[1], &[(&|x| *x = 13, &[0])]);
    }
}
