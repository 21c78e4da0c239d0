//! The files of a directory of results that the paper is made of.

use crate::frame::query::Rows;
use crate::frame::sheet::{Sheet, SheetError};
use std::collections::BTreeMap;
use std::path::Path;

/// The sheets by their names without `.csv`; the machine is one of them.
pub struct Sheets(BTreeMap<String, Sheet>);

/// The machine, with one column for each key of `MACHINE.txt`.
const MACHINE: &str = "MACHINE";

impl Sheets {
    /// Reads all CSV files of a directory, and `MACHINE.txt`.
    ///
    /// # Errors
    /// If the directory cannot be read, or a file is no CSV.
    pub fn read(results: &Path) -> Result<Sheets, SheetError> {
        let io = |source| SheetError::Io {
            path: results.to_path_buf(),
            source,
        };
        let mut sheets = BTreeMap::new();
        for entry in std::fs::read_dir(results).map_err(io)? {
            let path = entry.map_err(io)?.path();
            let name = path
                .file_name()
                .unwrap_or_default()
                .to_string_lossy()
                .into_owned();
            let read = || std::fs::read_to_string(&path).map_err(io);
            if let Some(stem) = name.strip_suffix(".csv") {
                sheets.insert(stem.to_string(), Sheet::parse(&name, &read()?)?);
            } else if name == "MACHINE.txt" {
                sheets.insert(MACHINE.to_string(), machine(&name, &read()?));
            }
        }
        Ok(Sheets(sheets))
    }

    /// Some sheets.
    #[cfg(test)]
    pub fn of<const N: usize>(sheets: [(&str, Sheet); N]) -> Sheets {
        Sheets(sheets.map(|(stem, sheet)| (stem.to_string(), sheet)).into())
    }

    /// A sheet.
    ///
    /// # Errors
    /// If it is not there.
    pub fn get(&self, stem: &str) -> Result<&Sheet, SheetError> {
        self.optional(stem).ok_or_else(|| SheetError::Unreadable {
            file: format!("{stem}.{}", if stem == MACHINE { "txt" } else { "csv" }),
            reason: "there is no such file".to_string(),
        })
    }

    /// A sheet, if it is there.
    pub fn optional(&self, stem: &str) -> Option<&Sheet> {
        self.0.get(stem)
    }

    /// `STEM`, or `STEM, CONDITION`: the sheet, if it is there and the condition is not 0.
    ///
    /// # Errors
    /// If a column is missing.
    pub fn wanted(&self, wanted: &str) -> Result<Option<&Sheet>, SheetError> {
        let (stem, condition) = wanted.split_once(", ").unwrap_or((wanted, ""));
        match self.optional(stem) {
            Some(sheet) if condition.is_empty() => Ok(Some(sheet)),
            Some(sheet) => Ok((Rows::all(sheet).number(condition)? != 0.0).then_some(sheet)),
            None => Ok(None),
        }
    }
}

/// Lines `key: value`, without what is in parentheses at the end of a value.
fn machine(file: &str, text: &str) -> Sheet {
    let lines = text.lines().filter_map(|line| line.split_once(": "));
    let value = |value: &str| value.split(" (").next().unwrap_or(value).trim().to_string();
    let (header, row) = lines.map(|(key, v)| (key.to_string(), value(v))).unzip();
    Sheet {
        file: file.to_string(),
        header,
        cells: vec![row],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_machine_is_one_row() {
        let text = "cpu: Some_CPU\ncores: 2\nrustc: rustc 1.95.0 (59807616e 2026-04-14)\n";
        let sheet = machine("MACHINE.txt", text);
        let text = |column| Rows::all(&sheet).text(column).expect("a column");
        assert_eq!((text("cpu"), text("rustc")), ("Some_CPU", "rustc 1.95.0"));
    }
}
