//! What is asked of the rows of a CSV file, as text: which rows, and what of them.
//!
//! *Which rows*: conditions with commas between them, `times=f64, crossing_from>0`. The operators are `=`, `!=`, `<`,
//! `<=`, `>` and `>=`; numbers are compared as numbers, other words with `=` and `!=` alone; `bits:*` are the words
//! that begin so; `@inputs` is what the column `inputs` of the row holds; nothing after `=` is an empty cell.
//!
//! *What of them*: arithmetic of columns within an aggregate, and arithmetic of aggregates: `sum(inputs - ok) /
//! sum(inputs)`. Aggregates are `sum`, `least`, `most`, `median`, `first`, `last`, `only` (of exactly one row) and
//! `distinct`; they may choose among the rows, `sum[times=f64](queued)`, and skip empty cells, `sum?(seconds)`. In a
//! row there are also `abs` and `log2`; a comparison with `>` is 1 or 0.

use super::sheet::{Row, Sheet, SheetError};
use crate::measure::sample::median;

/// Some rows of a sheet.
#[derive(Clone, Debug)]
pub struct Rows<'a> {
    sheet: &'a Sheet,
    /// The rows, in the order of the sheet.
    pub rows: Vec<Row<'a>>,
}

impl<'a> Rows<'a> {
    /// All rows of a sheet.
    pub fn all(sheet: &'a Sheet) -> Rows<'a> {
        Rows {
            sheet,
            rows: sheet.all().collect(),
        }
    }

    /// Those that keep all conditions.
    ///
    /// # Errors
    /// If there is no such column.
    pub fn only(&self, conditions: &str) -> Result<Rows<'a>, SheetError> {
        let mut rows = Vec::new();
        for &row in &self.rows {
            if keeps(&row, conditions)? {
                rows.push(row);
            }
        }
        Ok(Rows {
            sheet: self.sheet,
            rows,
        })
    }

    /// The rows by what they have in a column, in order of appearance.
    ///
    /// # Errors
    /// If there is no such column.
    pub fn by(&self, column: &str) -> Result<Vec<(&'a str, Rows<'a>)>, SheetError> {
        let mut groups: Vec<(&str, Rows)> = Vec::new();
        for &row in &self.rows {
            let value = row.text(column)?;
            match groups.iter_mut().find(|g| g.0 == value) {
                Some((_, rows)) => rows.rows.push(row),
                None => groups.push((
                    value,
                    Rows {
                        sheet: self.sheet,
                        rows: vec![row],
                    },
                )),
            }
        }
        Ok(groups)
    }

    /// What the first row has in a column; an empty text if there is no row.
    ///
    /// # Errors
    /// If there is no such column.
    pub fn text(&self, column: &str) -> Result<&'a str, SheetError> {
        self.rows.first().map_or(Ok(""), |row| row.text(column))
    }

    /// What is asked for.
    ///
    /// # Errors
    /// If there is no such column, or nothing that can be counted.
    ///
    /// # Panics
    /// If the question cannot be understood: that is a fault of who asks.
    pub fn number(&self, question: &str) -> Result<f64, SheetError> {
        let number = self.optional(question)?;
        number.ok_or_else(|| self.nothing(question))
    }

    /// The same; `None` if it is of empty cells, or of no rows.
    ///
    /// # Errors
    /// If there is no such column.
    pub fn optional(&self, question: &str) -> Result<Option<f64>, SheetError> {
        self.value(&parsed(question))
    }

    /// All values of `aggregate(…)`, whatever the aggregate is.
    ///
    /// # Errors
    /// If there is no such column.
    pub fn values(&self, question: &str) -> Result<Vec<f64>, SheetError> {
        match parsed(question) {
            Expression::Aggregate {
                among, skip, of, ..
            } => self.all_values(&among, skip, &of),
            _ => panic!("{question}: no aggregate"),
        }
    }

    fn nothing(&self, wanted: &str) -> SheetError {
        SheetError::NoRows {
            wanted: format!("{}: {wanted}", self.sheet.file),
        }
    }

    fn all_values(&self, among: &str, skip: bool, of: &Expression) -> Result<Vec<f64>, SheetError> {
        let mut values = Vec::new();
        for row in self.only(among)?.rows {
            match of.of_row(&row)? {
                None if !skip => return Err(self.nothing(&format!("{among} {of:?}"))),
                value => values.extend(value),
            }
        }
        Ok(values)
    }

    fn value(&self, question: &Expression) -> Result<Option<f64>, SheetError> {
        let (name, among, skip, of) = match question {
            Expression::Number(x) => return Ok(Some(*x)),
            Expression::Binary(operator, a, b) => {
                let pair = self.value(a)?.zip(self.value(b)?);
                return Ok(pair.map(|(a, b)| calculated(*operator, a, b)));
            }
            Expression::Aggregate {
                name,
                among,
                skip,
                of,
            } => (&**name, among, *skip, of),
            other => panic!("{other:?} is of a row"),
        };
        if let ("distinct", Expression::Column(column)) = (name, &**of) {
            return Ok(Some(self.only(among)?.by(column)?.len() as f64));
        }
        let values = self.all_values(among, skip, of)?;
        Ok(match name {
            "sum" => Some(values.iter().sum()),
            "least" => values.into_iter().min_by(f64::total_cmp),
            "most" => values.into_iter().max_by(f64::total_cmp),
            "median" => median(&values),
            "first" => values.first().copied(),
            "last" => values.last().copied(),
            "only" if values.len() > 1 => return Err(self.not_one(among, values.len())),
            "only" => values.first().copied(),
            other => panic!("{other}: no such aggregate"),
        })
    }

    fn not_one(&self, among: &str, found: usize) -> SheetError {
        SheetError::NotOneRow {
            file: self.sheet.file.clone(),
            wanted: among.to_string(),
            found,
        }
    }
}

/// Whether a row keeps all conditions.
fn keeps(row: &Row, conditions: &str) -> Result<bool, SheetError> {
    for condition in conditions
        .split(',')
        .map(str::trim)
        .filter(|c| !c.is_empty())
    {
        let operator = ["!=", "<=", ">=", "=", "<", ">"]
            .into_iter()
            .find(|o| condition.contains(o));
        let operator = operator.unwrap_or_else(|| panic!("{condition}: no condition"));
        let (column, wanted) = condition.split_once(operator).expect("it is there");
        let value = row.text(column.trim())?;
        let wanted = match wanted.trim().strip_prefix('@') {
            Some(other) => row.text(other)?,
            None => wanted.trim(),
        };
        let numbers = value.parse::<f64>().ok().zip(wanted.parse::<f64>().ok());
        let same = match (numbers, wanted.strip_suffix('*')) {
            (Some((a, b)), _) => a == b,
            (None, Some(start)) => value.starts_with(start),
            (None, None) => value == wanted,
        };
        let keeps = match (operator, numbers) {
            ("=", _) => same,
            ("!=", _) => !same,
            ("<", Some((a, b))) => a < b,
            ("<=", Some((a, b))) => a <= b,
            (">", Some((a, b))) => a > b,
            (">=", Some((a, b))) => a >= b,
            // An empty cell is neither more nor less than a number.
            _ => false,
        };
        if !keeps {
            return Ok(false);
        }
    }
    Ok(true)
}

#[derive(Clone, Debug, PartialEq)]
enum Expression {
    Number(f64),
    Column(String),
    OfRow(String, Box<Expression>),
    Aggregate {
        name: String,
        among: String,
        skip: bool,
        of: Box<Expression>,
    },
    Binary(char, Box<Expression>, Box<Expression>),
}

impl Expression {
    fn of_row(&self, row: &Row) -> Result<Option<f64>, SheetError> {
        match self {
            Expression::Number(x) => Ok(Some(*x)),
            Expression::Column(name) => row.optional(name),
            Expression::OfRow(name, of) => {
                let value = of.of_row(row)?;
                Ok(value.map(|x| if name == "abs" { x.abs() } else { x.log2() }))
            }
            Expression::Binary(operator, a, b) => {
                let pair = a.of_row(row)?.zip(b.of_row(row)?);
                Ok(pair.map(|(a, b)| calculated(*operator, a, b)))
            }
            Expression::Aggregate { name, .. } => panic!("{name} is of several rows"),
        }
    }
}

fn calculated(operator: char, a: f64, b: f64) -> f64 {
    match operator {
        '+' => a + b,
        '-' => a - b,
        '*' => a * b,
        '/' => a / b,
        _ => f64::from(u8::from(a > b)),
    }
}

/// The expression of a text.
fn parsed(text: &str) -> Expression {
    let mut parser = Parser { text, left: text };
    let expression = parser.expression(0);
    assert!(
        parser.left.trim().is_empty(),
        "{text}: what is `{}`?",
        parser.left
    );
    expression
}

struct Parser<'a> {
    text: &'a str,
    left: &'a str,
}

/// From those that bind least.
const OPERATORS: [&[char]; 3] = [&['>'], &['+', '-'], &['*', '/']];

impl Parser<'_> {
    fn take(&mut self, wanted: &[char]) -> Option<char> {
        let left = self.left.trim_start();
        let first = left.chars().next().filter(|c| wanted.contains(c))?;
        self.left = &left[1..];
        Some(first)
    }

    fn until(&mut self, end: char) -> String {
        let parts = self.left.split_once(end);
        let (before, after) = parts.unwrap_or_else(|| panic!("{}: no {end}", self.text));
        self.left = after;
        before.to_string()
    }

    fn expression(&mut self, level: usize) -> Expression {
        let Some(&operators) = OPERATORS.get(level) else {
            return self.atom();
        };
        let mut left = self.expression(level + 1);
        while let Some(operator) = self.take(operators) {
            let right = self.expression(level + 1);
            left = Expression::Binary(operator, Box::new(left), Box::new(right));
        }
        left
    }

    fn atom(&mut self) -> Expression {
        if self.take(&['(']).is_some() {
            let inner = self.expression(0);
            assert!(self.take(&[')']).is_some(), "{}: no )", self.text);
            return inner;
        }
        let left = self.left.trim_start();
        let end = left.find(|c: char| !(c.is_alphanumeric() || "_.".contains(c)));
        let (word, rest) = left.split_at(end.unwrap_or(left.len()));
        assert!(!word.is_empty(), "{}: nothing before `{rest}`", self.text);
        self.left = rest;
        if let Ok(x) = word.parse() {
            return Expression::Number(x);
        }
        let skip = self.take(&['?']).is_some();
        let among = if self.take(&['[']).is_some() {
            self.until(']')
        } else {
            String::new()
        };
        if self.take(&['(']).is_none() {
            return Expression::Column(word.to_string());
        }
        let of = Box::new(self.expression(0));
        assert!(self.take(&[')']).is_some(), "{}: no )", self.text);
        match word {
            "abs" | "log2" => Expression::OfRow(word.to_string(), of),
            name => Expression::Aggregate {
                name: name.to_string(),
                among,
                skip,
                of,
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sheet() -> Sheet {
        let text = "times,n,seconds,outcome\nf64,10,0.5,ok\nbits:8,20,,stuck\nbits:16,30,2.5,ok\n";
        Sheet::parse("a.csv", text).expect("a CSV")
    }

    #[test]
    fn questions_are_answered() {
        let sheet = sheet();
        let rows = Rows::all(&sheet);
        let cases = [
            ("sum(n)", 60.0),
            ("sum[times=bits:*](n) / sum(1)", 50.0 / 3.0),
            ("most?(seconds) - least?(seconds)", 2.0),
            ("median(n + 1)", 21.0),
            ("first(n * 2 - 1)", 19.0),
            ("last(abs(n - 40))", 10.0),
            ("only[n>=30, outcome=ok](log2(n + 2))", 5.0),
            ("sum(n - 5 > 10)", 2.0),
            ("sum[outcome!=ok](1)", 1.0),
            ("sum[seconds=](n)", 20.0),
            ("distinct(outcome)", 2.0),
            ("sum[n=@n](1)", 3.0),
        ];
        for (question, answer) in cases {
            assert_eq!(rows.number(question).expect(question), answer, "{question}");
        }
        assert_eq!(rows.values("range?(seconds)").expect("values"), [0.5, 2.5]);
        let groups = rows.by("outcome").expect("a column");
        assert_eq!((groups[0].0, groups[0].1.rows.len()), ("ok", 2));
    }

    #[test]
    fn what_is_missing_is_said() {
        let sheet = sheet();
        let rows = Rows::all(&sheet);
        let error = |question| rows.number(question).expect_err("an error").to_string();
        assert!(error("sum(seconds)").starts_with("no rows: a.csv: "));
        assert_eq!(
            error("only[outcome=ok](n)"),
            "a.csv: 2 rows with outcome=ok, one is needed"
        );
        assert_eq!(error("sum(flips)"), "a.csv: no column `flips`");
        assert_eq!(error("least[n>99](n)"), "no rows: a.csv: least[n>99](n)");
        assert_eq!(rows.optional("most[n>99](n)").expect("nothing"), None);
    }
}
