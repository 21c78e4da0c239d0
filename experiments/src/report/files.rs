//! The files of a directory of results, read on demand. What is asked for and not there is noted.

use super::table::Table;
use std::cell::RefCell;
use std::collections::BTreeSet;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// A directory of results.
pub struct Files {
    directory: PathBuf,
    missing: RefCell<BTreeSet<String>>,
}

impl Files {
    /// The directory; it may lack any file.
    pub fn of(directory: &Path) -> Files {
        Files {
            directory: directory.to_path_buf(),
            missing: RefCell::default(),
        }
    }

    /// A text file; an error says what is wrong with it.
    pub fn text(&self, name: &str) -> Result<String, String> {
        std::fs::read_to_string(self.directory.join(name)).map_err(|error| {
            if error.kind() != ErrorKind::NotFound {
                return format!("{name} cannot be read: {error}");
            }
            self.missing.borrow_mut().insert(name.to_string());
            format!("{name} is missing")
        })
    }

    /// `NAME.csv`.
    pub fn table(&self, name: &str) -> Result<Table, String> {
        let text = self.text(&format!("{name}.csv"))?;
        Table::read(text.as_bytes()).map_err(|error| format!("{name}.csv is no CSV: {error}"))
    }

    /// What has been asked for and was not there, sorted.
    pub fn missing(&self) -> Vec<String> {
        self.missing.borrow().iter().cloned().collect()
    }

    /// All `*.csv` and `*.svg` that there are, sorted.
    pub fn present(&self) -> Vec<String> {
        let entries = std::fs::read_dir(&self.directory).into_iter().flatten();
        let names = entries.filter_map(|e| e.ok()?.file_name().into_string().ok());
        let mut names: Vec<String> = names
            .filter(|n| n.ends_with(".csv") || n.ends_with(".svg"))
            .collect();
        names.sort();
        names
    }
}
