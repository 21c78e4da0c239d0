//! CSV files of results, as text; what is missing is named. [`super::query`] asks them.

use std::path::PathBuf;
use thiserror::Error;

/// Why nothing can be made of results.
#[derive(Debug, Error)]
pub enum SheetError {
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
    /// A value of no rows, or of an empty cell.
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
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sheet {
    /// Its name, with the extension.
    pub file: String,
    /// The names of the columns.
    pub header: Vec<String>,
    /// The cells, row by row, each as long as the header.
    pub cells: Vec<Vec<String>>,
}

impl Sheet {
    /// A sheet from its text.
    ///
    /// # Errors
    /// If it is no CSV.
    pub fn parse(file: &str, text: &str) -> Result<Sheet, SheetError> {
        let unreadable = |e: csv::Error| SheetError::Unreadable {
            file: file.to_string(),
            reason: e.to_string(),
        };
        let strings = |record: &csv::StringRecord| record.iter().map(str::to_string).collect();
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        let header = strings(reader.headers().map_err(unreadable)?);
        let cells = reader.records().map(|r| r.map(|r| strings(&r)));
        Ok(Sheet {
            file: file.to_string(),
            header,
            cells: cells.collect::<Result<_, _>>().map_err(unreadable)?,
        })
    }

    /// The place of a column.
    ///
    /// # Errors
    /// If there is none of this name.
    pub fn column(&self, name: &str) -> Result<usize, SheetError> {
        let found = self.header.iter().position(|column| column == name);
        found.ok_or_else(|| SheetError::NoColumn {
            file: self.file.clone(),
            column: name.to_string(),
        })
    }

    /// The sheet as CSV.
    pub fn to_csv(&self) -> String {
        let mut writer = csv::Writer::from_writer(Vec::new());
        for record in std::iter::once(&self.header).chain(&self.cells) {
            writer
                .write_record(record)
                .expect("rows as long as the header");
        }
        let bytes = writer.into_inner().expect("writing to memory");
        String::from_utf8(bytes).expect("made of strings")
    }

    /// All rows.
    pub fn all(&self) -> impl Iterator<Item = Row<'_>> {
        (0..self.cells.len()).map(|index| Row { sheet: self, index })
    }
}

/// One row of a sheet.
#[derive(Clone, Copy, Debug)]
pub struct Row<'a> {
    sheet: &'a Sheet,
    index: usize,
}

impl<'a> Row<'a> {
    /// Its line in the file, from 1, if no cell has several lines.
    pub fn line(&self) -> usize {
        self.index + 2
    }

    /// What a column holds.
    ///
    /// # Errors
    /// If there is no such column.
    pub fn text(&self, column: &str) -> Result<&'a str, SheetError> {
        Ok(&self.sheet.cells[self.index][self.sheet.column(column)?])
    }

    /// The number that a column holds.
    ///
    /// # Errors
    /// If there is no such column, or no number in it.
    pub fn number(&self, column: &str) -> Result<f64, SheetError> {
        let value = self.text(column)?;
        value.parse().map_err(|_| SheetError::NoNumber {
            file: self.sheet.file.clone(),
            line: self.line(),
            column: column.to_string(),
            value: value.to_string(),
        })
    }

    /// The same; `None` if the cell is empty.
    ///
    /// # Errors
    /// As [`Row::number`].
    pub fn optional(&self, column: &str) -> Result<Option<f64>, SheetError> {
        match self.text(column)?.is_empty() {
            true => Ok(None),
            false => self.number(column).map(Some),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_missing_is_named() {
        let sheet = Sheet::parse("a.csv", "name,value\nx,2.5\ny,\nz,many\n").expect("a CSV");
        let rows: Vec<Row> = sheet.all().collect();
        assert_eq!(rows[0].number("value").expect("a number"), 2.5);
        assert_eq!(rows[1].optional("value").expect("empty"), None);
        let column = rows[0].text("nam").expect_err("no column");
        assert_eq!(column.to_string(), "a.csv: no column `nam`");
        let number = rows[2].number("value").expect_err("no number").to_string();
        assert_eq!(number, "a.csv, line 4, column `value`: `many` is no number");
        let unequal = Sheet::parse("a.csv", "a,b\n1\n").expect_err("no CSV");
        assert!(unequal.to_string().starts_with("a.csv: "));
    }
}
