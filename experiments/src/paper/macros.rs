//! `numbers.tex`: one `\newcommand` for each number of the text, with its source.

use super::number;
use crate::frame::sheet::PaperError;
use std::collections::BTreeSet;

/// The commands so far.
#[derive(Clone, Debug, Default)]
pub struct Macros {
    text: String,
    names: BTreeSet<String>,
}

impl Macros {
    /// Defines a command whose source is a file, rows and columns.
    ///
    /// # Panics
    /// If TeX would not take the name, or if there is such a command already: the generator is wrong then.
    pub fn define(&mut self, name: &str, value: &str, source: &str) {
        let letters = name.bytes().all(|b| b.is_ascii_alphabetic());
        assert!(
            letters && !name.is_empty(),
            "TeX commands have letters only: {name}"
        );
        assert!(self.names.insert(name.to_string()), "two commands {name}");
        self.text += &format!("% {source}\n\\newcommand{{\\{name}}}{{{value}}}\n");
    }

    /// A count.
    pub fn whole(&mut self, name: &str, value: f64, source: &str) {
        self.define(name, &number::whole(value), source);
    }

    /// A ratio.
    pub fn ratio(&mut self, name: &str, value: f64, source: &str) {
        self.define(name, &number::ratio(value), source);
    }

    /// A part of 1, in percent, with the sign.
    pub fn percent(&mut self, name: &str, part: f64, source: &str) {
        self.define(name, &format!("{}\\,\\%", number::percent(part)), source);
    }

    /// Two significant digits.
    pub fn rough(&mut self, name: &str, value: f64, source: &str) {
        self.define(name, &number::significant(value, 2), source);
    }

    /// The least and the greatest of some numbers, as `NAMELeast` and `NAMEMost`.
    ///
    /// # Errors
    /// If there are none.
    pub fn range(
        &mut self,
        name: &str,
        values: &[f64],
        print: fn(f64) -> String,
        source: &str,
    ) -> Result<(), PaperError> {
        let least = values.iter().copied().min_by(f64::total_cmp);
        let most = values.iter().copied().max_by(f64::total_cmp);
        let (Some(least), Some(most)) = (least, most) else {
            return Err(PaperError::NoRows {
                wanted: source.to_string(),
            });
        };
        let (least_source, most_source) = (
            format!("{source}; the least"),
            format!("{source}; the greatest"),
        );
        self.define(&format!("{name}Least"), &print(least), &least_source);
        self.define(&format!("{name}Most"), &print(most), &most_source);
        Ok(())
    }

    /// `\ifNAME`: whether an optional experiment has been run.
    pub fn switch(&mut self, name: &str, on: bool, source: &str) {
        assert!(
            self.names.insert(format!("if{name}")),
            "two switches {name}"
        );
        let state = if on { "true" } else { "false" };
        self.text += &format!("% whether there is {source}\n\\newif\\if{name}\\{name}{state}\n");
    }

    /// The file.
    pub fn into_text(self) -> String {
        self.text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commands_have_sources() {
        let mut macros = Macros::default();
        macros.ratio("A", 0.5, "a.csv: x=1; y");
        macros.percent("B", 0.25, "b.csv");
        let range = macros.range("C", &[3.0, 1.0, 2.0], number::whole, "c.csv: y");
        range.expect("three numbers");
        let none = macros
            .range("E", &[], number::whole, "e.csv: x=1; y")
            .expect_err("no numbers");
        assert_eq!(none.to_string(), "no rows: e.csv: x=1; y");
        macros.switch("D", false, "d.csv");
        let expected = "% a.csv: x=1; y\n\\newcommand{\\A}{0.50}\n\
            % b.csv\n\\newcommand{\\B}{25.0\\,\\%}\n\
            % c.csv: y; the least\n\\newcommand{\\CLeast}{1}\n\
            % c.csv: y; the greatest\n\\newcommand{\\CMost}{3}\n\
            % whether there is d.csv\n\\newif\\ifD\\Dfalse\n";
        assert_eq!(macros.into_text(), expected);
    }

    #[test]
    #[should_panic(expected = "letters only")]
    fn names_have_letters_only() {
        Macros::default().whole("Fig9", 1.0, "");
    }

    #[test]
    #[should_panic(expected = "two commands")]
    fn names_are_different() {
        let mut macros = Macros::default();
        macros.whole("A", 1.0, "");
        macros.whole("A", 2.0, "");
    }
}
