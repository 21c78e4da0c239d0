//! What the page shows, in which order: `contents.txt`. A new experiment needs a section there.

/// The text of the list.
const CONTENTS: &str = include_str!("contents.txt");

/// A file of results.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    /// How it is shown.
    pub how: How,
    /// Its name without an extension.
    pub name: &'static str,
    /// Its caption.
    pub caption: &'static str,
}

/// How a file is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum How {
    /// `NAME.svg`.
    Figure,
    /// The pictures of a directory.
    Pictures,
    /// `NAME.csv`, to be read.
    Table,
    /// `NAME.csv`, to be looked things up in: all rows, or those that keep a condition.
    Rows(&'static str),
    /// One column of `NAME.csv` by two others.
    Pivot(Pivot),
}

/// One column of a CSV file by two others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pivot {
    /// Only rows that keep this condition.
    pub only: &'static str,
    /// The columns whose values are the rows, and the columns.
    pub by: [&'static str; 2],
    /// Which of the latter, in this order, with spaces between them.
    pub columns: &'static str,
    /// The column that is shown.
    pub value: &'static str,
}

impl Part {
    /// The file.
    pub fn file(&self) -> String {
        match self.how {
            How::Figure => format!("{}.svg", self.name),
            How::Pictures => format!("{}/", self.name),
            _ => format!("{}.csv", self.name),
        }
    }
}

/// One experiment.
#[derive(Clone, Debug)]
pub struct Section {
    /// Its stem.
    pub stem: &'static str,
    /// The heading.
    pub title: &'static str,
    /// Its files.
    pub parts: Vec<Part>,
}

/// All sections, in the order of the page.
///
/// # Panics
/// If the list cannot be understood.
pub fn sections() -> Vec<Section> {
    let mut sections: Vec<Section> = Vec::new();
    for line in CONTENTS
        .lines()
        .filter(|l| !l.starts_with('#') && !l.is_empty())
    {
        let fields: Vec<&'static str> = line.split('|').map(str::trim).collect();
        let how = match fields[..] {
            ["section", stem, title] => {
                sections.push(Section {
                    stem,
                    title,
                    parts: Vec::new(),
                });
                continue;
            }
            ["figure", _, _] => How::Figure,
            ["pictures", _, _] => How::Pictures,
            ["table", _, _] => How::Table,
            ["rows", _, _] => How::Rows(""),
            ["rows", _, _, only] => How::Rows(only),
            ["pivot", _, _, only, down, across, value] => {
                let (across, columns) = across.split_once(": ").expect("a column and its values");
                How::Pivot(Pivot {
                    only,
                    by: [down, across],
                    columns,
                    value,
                })
            }
            _ => panic!("{line}: not a line of the list"),
        };
        let section = sections.last_mut().expect("a section comes first");
        section.parts.push(Part {
            how,
            name: fields[1],
            caption: fields[2],
        });
    }
    sections
}

/// The names of files that are shown elsewhere on the page.
pub const SHOWN_ELSEWHERE: [&str; 1] = ["RUNS.csv"];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::registry::ALL;
    use std::collections::BTreeSet;

    #[test]
    fn every_experiment_has_a_section_and_every_file_one_place() {
        let sections = sections();
        for e in ALL.map(|e| e.about()) {
            assert!(
                sections.iter().any(|s| s.stem == e.name),
                "{} has no section",
                e.name
            );
        }
        let parts = sections.iter().flat_map(|s| &s.parts);
        let parts = parts.filter(|p| !matches!(p.how, How::Pivot(_)));
        let files: Vec<String> = parts.map(Part::file).collect();
        let distinct: BTreeSet<&String> = files.iter().collect();
        assert_eq!(distinct.len(), files.len());
    }
}
