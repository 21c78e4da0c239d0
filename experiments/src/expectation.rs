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
    checks: &[Check<Row>],
    name: impl Fn(&Row) -> String,
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn breakers_are_named() {
        let small = |x: &i32| *x < 10;
        let checks: [Check<i32>; 2] = [("small", &small), ("odd", &|x| x % 2 == 1)];
        let found = check_rows(&[1, 12, 3], &checks, i32::to_string);
        assert!(
            !found[0].holds()
                && found[0]
                    == Expectation {
                        statement: "small",
                        broken_by: vec!["12".into()]
                    }
        );
        assert_eq!(text(&found[..1]), "[BROKEN] small\n  not: 12\n");
        assert_eq!(
            text(&check_rows(&[1], &checks, i32::to_string)),
            "[ok] small\n[ok] odd\n"
        );
    }
}
