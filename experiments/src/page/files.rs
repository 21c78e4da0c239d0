//! The files of a directory of results, read on demand. What is asked for and not there is noted.

use crate::frame::sheet::Sheet;
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
    pub fn table(&self, name: &str) -> Result<Sheet, String> {
        let file = format!("{name}.csv");
        let text = self.text(&file)?;
        Sheet::parse(&file, &text).map_err(|error| format!("{name}.csv is no CSV: {error}"))
    }

    /// The pictures `NAME.png` of a directory beside the results, by name; an error if there are none.
    pub fn pictures(&self, directory: &str) -> Result<Vec<(String, Vec<u8>)>, String> {
        let entries = std::fs::read_dir(self.directory.join(directory));
        let paths = entries
            .into_iter()
            .flatten()
            .filter_map(|e| Some(e.ok()?.path()));
        let mut pictures = Vec::new();
        for path in paths.filter(|p| p.extension().is_some_and(|e| e == "png")) {
            let name = path.file_stem().unwrap_or_default().to_string_lossy();
            let bytes = std::fs::read(&path);
            let bytes = bytes.map_err(|e| format!("{directory}/{name}.png cannot be read: {e}"))?;
            pictures.push((name.to_string(), bytes));
        }
        if pictures.is_empty() {
            let what = format!("{directory}/*.png");
            self.missing.borrow_mut().insert(what.clone());
            return Err(format!("{what} is missing"));
        }
        pictures.sort();
        Ok(pictures)
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
