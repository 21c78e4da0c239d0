//! The models of a collection, and which of them are a shard's.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use tetflip::exchange::{Note, NoteCode};
use tetflip::format::EXTENSIONS;
use walkdir::WalkDir;

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

/// All models below a directory (or the one file), in the order of their names, and a note of the files that are none.
///
/// A `.node` file is a model, a set of points, unless it belongs to another file of its stem: it may hold the vertices
/// of a `.poly` or `.smesh` file, or those of a mesh.
///
/// # Errors
/// What cannot be listed, or has a name that is no Unicode: a table could not tell it from others.
pub(super) fn models(collection: &Path) -> Result<(Vec<Model>, Option<Note>), String> {
    let (mut list, mut skipped) = (Vec::new(), BTreeMap::<String, usize>::new());
    for entry in WalkDir::new(collection).follow_links(true) {
        let entry = entry.map_err(|error| error.to_string())?;
        if !entry.file_type().is_file() {
            continue;
        }
        let path = entry.path();
        let model = Model {
            name: name(collection, path)
                .ok_or_else(|| format!("{} is no Unicode", path.display()))?,
            path: path.to_owned(),
            bytes: entry.metadata().map_err(|error| error.to_string())?.len(),
        };
        let format = model.format();
        if !EXTENSIONS.contains(&&*format) {
            let kind = if format.is_empty() {
                "no extension".to_owned()
            } else {
                format!(".{format}")
            };
            *skipped.entry(kind).or_default() += 1;
        } else if format == "node" && ["poly", "smesh", "ele"].iter().any(|e| sibling(path, e)) {
            *skipped
                .entry(".node of another file".to_owned())
                .or_default() += 1;
        } else {
            list.push(model);
        }
    }
    list.sort_by(|a, b| a.name.cmp(&b.name));
    Ok((list, note(&skipped)))
}

/// The path in a collection, with `/`; that of a single file is its name. `None` if it is no Unicode.
fn name(collection: &Path, path: &Path) -> Option<String> {
    let inner = path
        .strip_prefix(collection)
        .ok()
        .filter(|p| *p != Path::new(""));
    let inner = inner.or(path.file_name().map(Path::new))?;
    let words: Option<Vec<&str>> = inner.iter().map(|word| word.to_str()).collect();
    Some(words?.join("/"))
}

/// Whether there is a file with the same stem and this extension, in either case.
fn sibling(path: &Path, extension: &str) -> bool {
    [extension.to_owned(), extension.to_uppercase()]
        .iter()
        .any(|e| path.with_extension(e).exists())
}

fn note(skipped: &BTreeMap<String, usize>) -> Option<Note> {
    let count = skipped.values().sum();
    let kinds: Vec<String> = skipped
        .iter()
        .map(|(kind, n)| format!("{n} {kind}"))
        .collect();
    let files = if count == 1 {
        "1 file is"
    } else {
        &*format!("{count} files are")
    };
    let text = format!("{files} no model and skipped: {}", kinds.join(", "));
    (count > 0).then(|| Note::new(NoteCode::SkippedFiles, count, text))
}
