//! The models of a collection, and which of them are a shard's.

use std::path::{Path, PathBuf};
use walkdir::WalkDir;

/// What is read as a model. A `.node` file has no facets, or belongs to a `.poly` or `.smesh` file.
const EXTENSIONS: [&str; 4] = ["off", "poly", "smesh", "stl"];

/// A file of the collection.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Model {
    /// The path in the collection, with `/`: the name of the model in the table.
    pub name: String,
    /// Where it is.
    pub path: PathBuf,
    /// Its size, which tells whether it is still what a row of the table is about.
    pub bytes: u64,
}

impl Model {
    /// The extension in lower case.
    pub(super) fn format(&self) -> String {
        let extension = self.path.extension().unwrap_or_default();
        extension.to_string_lossy().to_ascii_lowercase()
    }
}

/// All models below a directory (or the one file), in the order of their names.
///
/// # Errors
/// What cannot be listed, or has a name that is no Unicode: a table could not tell it from others.
pub(super) fn models(collection: &Path) -> Result<Vec<Model>, String> {
    let mut list = Vec::new();
    for entry in WalkDir::new(collection).follow_links(true) {
        let entry = entry.map_err(|error| error.to_string())?;
        let path = entry.path();
        let known = path.extension().is_some_and(|extension| {
            EXTENSIONS
                .iter()
                .any(|known| extension.eq_ignore_ascii_case(known))
        });
        if !entry.file_type().is_file() || !known {
            continue;
        }
        let inner = path
            .strip_prefix(collection)
            .ok()
            .filter(|p| *p != Path::new(""));
        let words: Option<Vec<&str>> = inner
            .unwrap_or(Path::new(entry.file_name()))
            .iter()
            .map(|word| word.to_str())
            .collect();
        let metadata = entry.metadata().map_err(|error| error.to_string())?;
        list.push(Model {
            name: words
                .ok_or_else(|| format!("{} is no Unicode", path.display()))?
                .join("/"),
            path: path.to_owned(),
            bytes: metadata.len(),
        });
    }
    list.sort_by(|a, b| a.name.cmp(&b.name));
    Ok(list)
}
