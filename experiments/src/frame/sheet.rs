//! The CSV files as the paper reads them: cells are found by the values of key columns, and what is missing is named.

use std::path::{Path, PathBuf};
use thiserror::Error;

/// Why the paper's tables cannot be made.
#[derive(Debug, Error)]
pub enum PaperError {
    /// A file cannot be read or written.
    #[error("{}: {source}", .path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// A file of results is missing or is no CSV.
    #[error("{file}: {reason}")]
    Unreadable {
        /// The file.
        file: String,
        /// Why.
        reason: String,
    },
    /// There is not exactly one row with these values.
    #[error("{file}: {found} rows with {wanted}, one is needed")]
    NotOneRow {
        /// The file.
        file: String,
        /// Columns and values.
        wanted: String,
        /// How many there are.
        found: usize,
    },
    /// A range of values of no rows.
    #[error("no rows: {wanted}")]
    NoRows {
        /// The file, its rows and columns.
        wanted: String,
    },
    /// A file has no such column.
    #[error("{file}: no column `{column}`")]
    NoColumn {
        /// The file.
        file: String,
        /// The column.
        column: String,
    },
    /// A cell should hold a number.
    #[error("{file}, line {line}, column `{column}`: `{value}` is no number")]
    NoNumber {
        /// The file.
        file: String,
        /// The line, from 1.
        line: usize,
        /// The column.
        column: String,
        /// What it holds.
        value: String,
    },
}

/// One CSV file.
#[derive(Clone, Debug)]
pub struct Sheet {
    /// Its name, with the extension.
    pub file: String,
    /// The names of the columns.
    pub header: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Sheet {
    /// Reads `STEM.csv` of a directory.
    ///
    /// # Errors
    /// If it is not there or no CSV.
    pub fn read(results: &Path, stem: &str) -> Result<Sheet, PaperError> {
        let file = format!("{stem}.csv");
        let text =
            std::fs::read_to_string(results.join(&file)).map_err(|e| PaperError::Unreadable {
                file: file.clone(),
                reason: e.to_string(),
            })?;
        Sheet::parse(&file, &text)
    }

    /// The same; `None` if there is no such file.
    ///
    /// # Errors
    /// If it is there and no CSV.
    pub fn read_optional(results: &Path, stem: &str) -> Result<Option<Sheet>, PaperError> {
        let there = results.join(format!("{stem}.csv")).exists();
        there.then(|| Sheet::read(results, stem)).transpose()
    }

    /// A sheet from its text.
    ///
    /// # Errors
    /// If it is no CSV.
    pub fn parse(file: &str, text: &str) -> Result<Sheet, PaperError> {
        let unreadable = |e: csv::Error| PaperError::Unreadable {
            file: file.to_string(),
            reason: e.to_string(),
        };
        let strings = |record: &csv::StringRecord| record.iter().map(str::to_string).collect();
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        let header = strings(reader.headers().map_err(unreadable)?);
        let rows = reader.records().map(|r| r.map(|r| strings(&r)));
        let rows = rows.collect::<Result<_, _>>().map_err(unreadable)?;
        Ok(Sheet {
            file: file.to_string(),
            header,
            rows,
        })
    }

    fn column(&self, name: &str) -> Result<usize, PaperError> {
        let found = self.header.iter().position(|column| column == name);
        found.ok_or_else(|| PaperError::NoColumn {
            file: self.file.clone(),
            column: name.to_string(),
        })
    }

    /// The rows that have something in a column.
    ///
    /// # Errors
    /// If there is no such column.
    pub fn filled(mut self, name: &str) -> Result<Sheet, PaperError> {
        let column = self.column(name)?;
        self.rows.retain(|row| !row[column].is_empty());
        Ok(self)
    }

    /// All rows.
    pub fn all(&self) -> impl Iterator<Item = Row<'_>> {
        (0..self.rows.len()).map(|index| Row { sheet: self, index })
    }

    /// The rows in which these columns have these values, none perhaps.
    ///
    /// # Errors
    /// If there is no such column.
    pub fn rows(&self, wanted: &[(&str, &str)]) -> Result<Vec<Row<'_>>, PaperError> {
        let mut keys = Vec::new();
        for (name, value) in wanted {
            keys.push((self.column(name)?, *value));
        }
        let has = |row: &Row| {
            let cells = &self.rows[row.index];
            keys.iter().all(|&(i, value)| cells[i] == value)
        };
        Ok(self.all().filter(has).collect())
    }

    /// The one row in which these columns have these values.
    ///
    /// # Errors
    /// If there is none, or more than one.
    pub fn row(&self, wanted: &[(&str, &str)]) -> Result<Row<'_>, PaperError> {
        match self.rows(wanted)?.as_slice() {
            [row] => Ok(*row),
            rows => Err(PaperError::NotOneRow {
                file: self.file.clone(),
                wanted: described(wanted),
                found: rows.len(),
            }),
        }
    }

    /// The different values of a column, in order of appearance.
    ///
    /// # Errors
    /// If there is no such column.
    pub fn values(&self, column: &str) -> Result<Vec<&str>, PaperError> {
        let i = self.column(column)?;
        let mut values: Vec<&str> = Vec::new();
        for row in &self.rows {
            if !values.contains(&row[i].as_str()) {
                values.push(&row[i]);
            }
        }
        Ok(values)
    }
}

/// Columns and their values, for messages and comments.
pub fn described(wanted: &[(&str, &str)]) -> String {
    let parts: Vec<String> = wanted.iter().map(|(k, v)| format!("{k}={v}")).collect();
    parts.join(", ")
}

/// One row of a sheet.
#[derive(Clone, Copy, Debug)]
pub struct Row<'a> {
    sheet: &'a Sheet,
    index: usize,
}

impl<'a> Row<'a> {
    /// What a column holds.
    ///
    /// # Errors
    /// If there is no such column.
    pub fn text(&self, column: &str) -> Result<&'a str, PaperError> {
        Ok(&self.sheet.rows[self.index][self.sheet.column(column)?])
    }

    /// The number that a column holds.
    ///
    /// # Errors
    /// If there is no such column, or no number in it.
    pub fn number(&self, column: &str) -> Result<f64, PaperError> {
        let value = self.text(column)?;
        value.parse().map_err(|_| PaperError::NoNumber {
            file: self.sheet.file.clone(),
            line: self.index + 2,
            column: column.to_string(),
            value: value.to_string(),
        })
    }

    /// The same; `None` if the cell is empty.
    ///
    /// # Errors
    /// As [`Row::number`].
    pub fn optional(&self, column: &str) -> Result<Option<f64>, PaperError> {
        match self.text(column)?.is_empty() {
            true => Ok(None),
            false => self.number(column).map(Some),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sheet() -> Sheet {
        Sheet::parse("a.csv", "name,kind,value\nx,1,2.5\ny,1,\ny,2,many\n").expect("a CSV")
    }

    #[test]
    fn cells_are_found_by_keys() {
        let sheet = sheet();
        let row = sheet.row(&[("name", "x")]).expect("one row");
        assert_eq!(row.number("value").expect("a number"), 2.5);
        let row = sheet.row(&[("name", "y"), ("kind", "1")]).expect("one row");
        assert_eq!(row.optional("value").expect("empty"), None);
        assert_eq!(sheet.values("kind").expect("a column"), ["1", "2"]);
    }

    #[test]
    fn what_is_missing_is_named() {
        let sheet = sheet();
        let none = sheet.row(&[("name", "z"), ("kind", "1")]);
        let none = none.expect_err("no row").to_string();
        assert_eq!(none, "a.csv: 0 rows with name=z, kind=1, one is needed");
        let two = sheet.row(&[("name", "y")]).expect_err("two rows");
        assert!(two.to_string().starts_with("a.csv: 2 rows with name=y"));
        let column = sheet.row(&[("nam", "y")]).expect_err("no column");
        assert_eq!(column.to_string(), "a.csv: no column `nam`");
        let row = sheet.row(&[("kind", "2")]).expect("one row");
        let number = row.number("value").expect_err("no number");
        let expected = "a.csv, line 4, column `value`: `many` is no number";
        assert_eq!(number.to_string(), expected);
        let file = Sheet::read(Path::new("no/such/directory"), "fig9").expect_err("no file");
        assert!(file.to_string().starts_with("fig9.csv: "), "{file}");
    }

    #[test]
    fn optional_files_may_be_missing() {
        let none = Sheet::read_optional(Path::new("no/such/directory"), "rivals");
        assert!(none.expect("no error").is_none());
    }
}
