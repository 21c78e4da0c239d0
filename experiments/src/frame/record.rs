//! Results on disk: CSV rows and text. A file is complete or it is not there: it is written under a temporary name and
//! renamed.

use super::machine::Machine;
use serde::Serialize;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Results could not be recorded.
#[derive(Debug, Error)]
pub enum RecordError {
    /// The operating system refused.
    #[error("{}: {source}", .path.display())]
    Io {
        /// The file or directory.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// Rows that CSV cannot hold (maps, or unequal lengths).
    #[error("{}: {source}", .path.display())]
    Csv {
        /// The file.
        path: PathBuf,
        /// Why.
        source: csv::Error,
    },
    /// An experiment without a row has not taken place.
    #[error("{}: no rows", .path.display())]
    NoRows {
        /// The file.
        path: PathBuf,
    },
}

/// A directory of results.
#[derive(Clone, Debug)]
pub struct Results {
    directory: PathBuf,
}

impl Results {
    /// Makes the directory, unless it exists, and writes [`Machine::detect`] to `MACHINE.txt` in it.
    ///
    /// # Errors
    /// If the directory or the file cannot be written.
    pub fn create(directory: &Path) -> Result<Results, RecordError> {
        let path = directory.to_path_buf();
        if let Err(source) = std::fs::create_dir_all(directory) {
            return Err(RecordError::Io { path, source });
        }
        let results = Results { directory: path };
        results.text("MACHINE.txt", &Machine::detect().to_string())?;
        Ok(results)
    }

    /// The directory.
    pub fn directory(&self) -> &Path {
        &self.directory
    }

    /// Writes `STEM.csv` with the names of the fields as its header, and returns its path.
    ///
    /// # Errors
    /// If there are no rows, if they are no CSV, or if the file cannot be written.
    pub fn rows<T: Serialize>(&self, stem: &str, rows: &[T]) -> Result<PathBuf, RecordError> {
        let name = format!("{stem}.csv");
        let path = self.directory.join(&name);
        if rows.is_empty() {
            return Err(RecordError::NoRows { path });
        }
        let text = csv_text(rows).map_err(|source| RecordError::Csv { path, source })?;
        self.text(&name, &text)
    }

    /// Writes a text file, for instance `STEM.svg`, and returns its path.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn text(&self, name: &str, text: &str) -> Result<PathBuf, RecordError> {
        let path = self.directory.join(name);
        match write_at_once(&self.directory, &path, text.as_bytes()) {
            Ok(()) => Ok(path),
            Err(source) => Err(RecordError::Io { path, source }),
        }
    }
}

/// Rows as CSV, with the names of the fields as its header.
///
/// # Errors
/// If CSV cannot hold them.
pub fn csv_text<T: Serialize>(rows: &[T]) -> Result<String, csv::Error> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        writer.serialize(row)?;
    }
    let bytes = writer.into_inner().map_err(|e| e.into_error())?;
    Ok(String::from_utf8(bytes).expect("made of strings"))
}

fn write_at_once(directory: &Path, path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".tetflip-");
    // The permissions of any new file; a temporary one is private by default.
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    let mut file = builder.tempfile_in(directory)?;
    file.write_all(bytes)?;
    file.persist(path)?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use tempfile::TempDir;

    #[derive(Serialize)]
    struct Row {
        method: &'static str,
        seconds: f64,
        steiner: Option<u32>,
    }

    const ROWS: [Row; 2] = [
        Row {
            method: "flip",
            seconds: 1.5e-7,
            steiner: None,
        },
        Row {
            method: "a \"cavity\", so to speak",
            seconds: 0.1,
            steiner: Some(3),
        },
    ];

    #[test]
    fn rows_and_machine() {
        let directory = TempDir::new().unwrap();
        let path = directory.path().join("a/b");
        let results = Results::create(&path).unwrap();
        let csv = results.rows("fig9", &ROWS).unwrap();
        assert_eq!(csv, path.join("fig9.csv"));
        let text = std::fs::read_to_string(csv).unwrap();
        let expected =
            "method,seconds,steiner\nflip,1.5e-7,\n\"a \"\"cavity\"\", so to speak\",0.1,3\n";
        assert_eq!(text, expected);
        // Written again, it is replaced as a whole; no temporary file stays.
        results.rows("fig9", &ROWS[..1]).unwrap();
        let entries = std::fs::read_dir(&path).unwrap();
        let mut names: Vec<_> = entries.map(|e| e.unwrap().file_name()).collect();
        names.sort();
        assert_eq!(names, ["MACHINE.txt", "fig9.csv"]);
    }

    #[test]
    fn a_failed_recording_keeps_the_old_rows() {
        let directory = TempDir::new().unwrap();
        let results = Results::create(directory.path()).unwrap();
        let csv = results.rows("t", &ROWS).unwrap();
        let old = std::fs::read_to_string(&csv).unwrap();
        let none = results.rows::<Row>("t", &[]);
        assert!(matches!(none, Err(RecordError::NoRows { .. })));
        let unequal = results.rows("t", &[vec![1, 2], vec![1]]);
        assert!(matches!(unequal, Err(RecordError::Csv { .. })));
        assert_eq!(std::fs::read_to_string(&csv).unwrap(), old);
        let nowhere = results.rows("no/such", &ROWS);
        assert!(matches!(nowhere, Err(RecordError::Io { .. })));
    }
}
