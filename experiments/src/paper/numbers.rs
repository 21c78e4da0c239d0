//! `numbers.tex`: a command for each number of the text, with its source; and the sentences that say more than a
//! number. Both are read from tables, `numbers.txt` and `claims.txt`, which say what is asked of which file.

use super::number::Format;
use super::sheets::Sheets;
use super::table::escaped;
use crate::frame::query::Rows;
use crate::frame::sheet::{Sheet, SheetError};
use std::collections::BTreeSet;
use std::fmt;

/// A line is a comment, empty, or has fields with bars between them.
fn lines(table: &str) -> impl Iterator<Item = Vec<&str>> {
    let lines = table
        .lines()
        .filter(|l| !l.starts_with('#') && !l.trim().is_empty());
    lines.map(|line| line.split('|').map(str::trim).collect())
}

/// The commands of a table.
///
/// # Errors
/// If something is missing.
///
/// # Panics
/// If the table cannot be understood, or defines a command twice.
pub fn commands(table: &str, sheets: &Sheets) -> Result<String, SheetError> {
    let mut commands = Commands::default();
    // Whether the numbers are there: always, until the first line with a switch.
    let (mut is_there, mut is_optional) = (true, false);
    for line in lines(table) {
        match line[..] {
            [switch] => {
                let parts = switch
                    .strip_prefix("[if ")
                    .and_then(|s| s.strip_suffix(']')?.split_once(": "));
                let (name, wanted) = parts.unwrap_or_else(|| panic!("{switch}: no switch"));
                is_there = sheets.wanted(wanted)?.is_some();
                is_optional = true;
                let file = wanted.split(',').next().unwrap_or(wanted);
                commands.switch(name, is_there, &format!("{file}.csv"));
            }
            [name, stem, rows, value, format] if is_there => {
                let number = Number {
                    name,
                    rows,
                    value,
                    format,
                    is_optional,
                };
                number.define(sheets.get(stem)?, &mut commands)?;
            }
            [_, _, _, _, _] => {}
            _ => panic!("{line:?}: not a line of the table"),
        }
    }
    Ok(commands.text)
}

struct Number<'a> {
    name: &'a str,
    rows: &'a str,
    value: &'a str,
    format: &'a str,
    /// Whether it may be of nothing: then it is a dash.
    is_optional: bool,
}

impl Number<'_> {
    fn define(&self, sheet: &Sheet, commands: &mut Commands) -> Result<(), SheetError> {
        let Number { name, value, .. } = *self;
        let colon = if self.rows.is_empty() { "" } else { "; " };
        let source = format!("{}: {}{colon}{value}", sheet.file, self.rows);
        let rows = Rows::all(sheet).only(self.rows)?;
        let missing = || SheetError::NoRows {
            wanted: source.clone(),
        };
        if self.format == "text" {
            let text = rows.text(value)?;
            match (text, self.is_optional) {
                ("", false) => return Err(missing()),
                ("", true) => commands.define(name, "--", &source),
                _ => commands.define(name, &escaped(text), &source),
            }
            return Ok(());
        }
        let format = Format::of(self.format);
        if !value.starts_with("range") {
            let number = rows.optional(value)?;
            if number.is_none() && !self.is_optional {
                return Err(missing());
            }
            commands.define(name, &format.print(number), &source);
            return Ok(());
        }
        let mut values = rows.values(value)?;
        if values.is_empty() && !self.is_optional {
            return Err(missing());
        }
        values.sort_by(f64::total_cmp);
        let ends = [
            ("Least", "the least", values.first()),
            ("Most", "the greatest", values.last()),
        ];
        for (end, what, value) in ends {
            let value = format.print(value.copied());
            commands.define(
                &format!("{name}{end}"),
                &value,
                &format!("{source}; {what}"),
            );
        }
        Ok(())
    }
}

/// The commands so far.
#[derive(Default)]
struct Commands {
    text: String,
    names: BTreeSet<String>,
}

impl Commands {
    fn define(&mut self, name: &str, value: &str, source: &str) {
        let letters = !name.is_empty() && name.bytes().all(|b| b.is_ascii_alphabetic());
        assert!(letters, "TeX commands have letters only: {name}");
        assert!(self.names.insert(name.to_string()), "two commands {name}");
        self.text += &format!("% {source}\n\\newcommand{{\\{name}}}{{{value}}}\n");
    }

    /// `\ifNAME`: whether an optional experiment has been run.
    fn switch(&mut self, name: &str, on: bool, source: &str) {
        assert!(
            self.names.insert(format!("if{name}")),
            "two switches {name}"
        );
        self.text += &format!("% whether there is {source}\n\\newif\\if{name}\\{name}{on}\n");
    }
}

/// A sentence, and what in the results contradicts it.
#[derive(Clone, Debug, PartialEq)]
pub struct Claim {
    /// What the paper says.
    pub sentence: String,
    /// The rows that say otherwise.
    pub contradictions: Vec<String>,
}

impl Claim {
    /// Whether nothing contradicts it.
    pub fn holds(&self) -> bool {
        self.contradictions.is_empty()
    }
}

impl fmt::Display for Claim {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let first: Vec<&str> = self
            .contradictions
            .iter()
            .take(5)
            .map(String::as_str)
            .collect();
        write!(
            f,
            "the paper says that {}, but: {}",
            self.sentence,
            first.join("; ")
        )
    }
}

/// The claims of a table.
///
/// # Errors
/// If something is missing.
///
/// # Panics
/// If the table cannot be understood.
pub fn claims(table: &str, sheets: &Sheets) -> Result<Vec<Claim>, SheetError> {
    let mut claims = Vec::new();
    for line in lines(table) {
        let [sentence, stem, rows, must] = line[..] else {
            panic!("{line:?}: not a line of the table");
        };
        // A question mark: only if there is such a file.
        let sheet = match stem.strip_suffix('?') {
            Some(stem) => sheets.optional(stem),
            None => Some(sheets.get(stem)?),
        };
        let Some(sheet) = sheet else { continue };
        let all = Rows::all(sheet).only(rows)?;
        let mut contradictions = Vec::new();
        for condition in must.split(',') {
            let good: BTreeSet<usize> =
                all.only(condition)?.rows.iter().map(|r| r.line()).collect();
            let bad = all
                .rows
                .iter()
                .map(|r| r.line())
                .filter(|line| !good.contains(line));
            contradictions.extend(
                bad.map(|line| format!("{}, line {line}: not {}", sheet.file, condition.trim())),
            );
        }
        if all.rows.is_empty() {
            contradictions.push(format!("{}: no rows with {rows}", sheet.file));
        }
        claims.push(Claim {
            sentence: sentence.to_string(),
            contradictions,
        });
    }
    Ok(claims)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sheets() -> Sheets {
        let text = "x,y,ok,version\n1,0.5,true,1.5_a\n2,0.25,true,\n";
        Sheets::of([("a", Sheet::parse("a.csv", text).expect("a CSV"))])
    }

    #[test]
    fn commands_have_sources() {
        let table = "# comment\nA | a | x=1 | only(y) | ratio\nB | a | | least(y) | percent\nC | a | x>0 | range(x) | \
                     whole\n\
                     V | a | | version | text\n[if D: b]\nE | b | | sum(x) | whole\n[if F: a, distinct(x) > 1]\n\
                     G | a | x=7 | version | text\nH | a | x=7 | range(y) | ratio\n";
        let expected = "% a.csv: x=1; only(y)\n\\newcommand{\\A}{0.50}\n\
            % a.csv: least(y)\n\\newcommand{\\B}{25.0\\,\\%}\n\
            % a.csv: x>0; range(x); the least\n\\newcommand{\\CLeast}{1}\n\
            % a.csv: x>0; range(x); the greatest\n\\newcommand{\\CMost}{2}\n\
            % a.csv: version\n\\newcommand{\\V}{1.5\\_a}\n\
            % whether there is b.csv\n\\newif\\ifD\\Dfalse\n\
            % whether there is a.csv\n\\newif\\ifF\\Ftrue\n\
            % a.csv: x=7; version\n\\newcommand{\\G}{--}\n\
            % a.csv: x=7; range(y); the least\n\\newcommand{\\HLeast}{--}\n\
            % a.csv: x=7; range(y); the greatest\n\\newcommand{\\HMost}{--}\n";
        assert_eq!(commands(table, &sheets()).expect("complete"), expected);
        let none = commands("E | a | x=7 | range(y) | whole\n", &sheets()).expect_err("no rows");
        assert_eq!(none.to_string(), "no rows: a.csv: x=7; range(y)");
    }

    #[test]
    #[should_panic(expected = "letters only")]
    fn names_have_letters_only() {
        let _ = commands("Fig9 | a | | sum(1) | whole\n", &sheets());
    }

    #[test]
    #[should_panic(expected = "two commands")]
    fn names_are_different() {
        let _ = commands(
            "A | a | | sum(1) | whole\nA | a | | sum(1) | whole\n",
            &sheets(),
        );
    }

    #[test]
    fn each_claim_can_be_contradicted() {
        let table = "s | a | | ok=true, y>=0.5\nt | a | x=7 | ok=true\nu | b? | | ok=true\nv | a | x=2 | ok=true\n";
        let claims = claims(table, &sheets()).expect("complete");
        let contradictions: Vec<_> = claims.iter().map(|c| c.contradictions.join("; ")).collect();
        assert_eq!(
            contradictions,
            ["a.csv, line 3: not y>=0.5", "a.csv: no rows with x=7", ""]
        );
        assert!(!claims[0].holds() && claims[2].holds());
    }
}
