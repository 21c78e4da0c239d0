//! The generated part of the paper: tables, points of plots, and a command for every number in its text, from the CSV files of
//! the results.
//!
//! `experiments paper` writes them to `paper/generated`; `--check` compares instead. A file or a row that is missing is an
//! error that names it, except for the experiments that need other programs or hours (`optional`): in their place the
//! paper says that they have not been run. Sentences that numbers could contradict are claims (`claims`). The same results give the
//! same bytes.

mod claims;
mod cost;
mod fig9;
mod fig9_tetgen;
mod flip_order;
mod growth;
mod lint;
mod machine;
mod macros;
mod number;
mod optional;
mod table;
mod table1;
mod updates;

pub use crate::frame::sheet::PaperError;
pub use claims::Claim;
pub use lint::{Finding, digits};

use macros::Macros;
use std::collections::BTreeMap;
use std::path::Path;

/// What is generated.
#[derive(Clone, Debug, Default)]
pub struct Generated {
    /// Contents by file name.
    pub files: BTreeMap<String, String>,
    /// Sentences of the paper, and whether the results bear them out.
    pub claims: Vec<Claim>,
}

/// The files under construction.
#[derive(Clone, Debug, Default)]
struct Builder {
    macros: Macros,
    generated: Generated,
}

impl Builder {
    fn file(&mut self, name: &str, text: String) {
        let before = self.generated.files.insert(name.to_string(), text);
        assert!(before.is_none(), "two files {name}");
    }

    /// A sentence that the paper says, and what contradicts it.
    fn claim(&mut self, sentence: &str, contradictions: Vec<String>) {
        self.generated.claims.push(Claim {
            sentence: sentence.to_string(),
            contradictions,
        });
    }
}

/// Everything, from a directory of results.
///
/// # Errors
/// If a file, a column or a row is missing.
pub fn generate(results: &Path) -> Result<Generated, PaperError> {
    let mut builder = Builder::default();
    machine::add(&mut builder, results)?;
    fig9::add(&mut builder, results)?;
    flip_order::add(&mut builder, results)?;
    cost::add(&mut builder, results)?;
    growth::add(&mut builder, results)?;
    optional::add(&mut builder, results)?;
    let Builder {
        macros,
        mut generated,
    } = builder;
    generated
        .files
        .insert("numbers.tex".to_string(), macros.into_text());
    Ok(generated)
}

/// Writes the files to a directory, and returns how many.
///
/// # Errors
/// If they cannot be written.
pub fn write(generated: &Generated, directory: &Path) -> Result<usize, PaperError> {
    let refused = |path: &Path| {
        let path = path.to_path_buf();
        move |source| PaperError::Io { path, source }
    };
    std::fs::create_dir_all(directory).map_err(refused(directory))?;
    for (name, text) in &generated.files {
        let path = directory.join(name);
        std::fs::write(&path, text).map_err(refused(&path))?;
    }
    Ok(generated.files.len())
}

/// The files of a directory that differ from what would be generated, are missing, or too many.
///
/// # Errors
/// If the directory cannot be read.
pub fn stale(generated: &Generated, directory: &Path) -> Result<Vec<String>, PaperError> {
    let mut stale = Vec::new();
    for (name, text) in &generated.files {
        match std::fs::read_to_string(directory.join(name)) {
            Ok(old) if old == *text => {}
            Ok(_) => stale.push(format!("{name}: differs")),
            Err(_) => stale.push(format!("{name}: missing")),
        }
    }
    let entries = std::fs::read_dir(directory).map_err(|source| PaperError::Io {
        path: directory.to_path_buf(),
        source,
    })?;
    for entry in entries.flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        if !generated.files.contains_key(&name) {
            stale.push(format!("{name}: not generated"));
        }
    }
    stale.sort();
    Ok(stale)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::PathBuf;

    fn results() -> PathBuf {
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../results")
    }

    #[test]
    fn the_results_make_the_paper() {
        let generated = generate(&results()).expect("complete results");
        assert_eq!(
            generated.files,
            generate(&results()).expect("the same").files
        );
        for (name, text) in &generated.files {
            assert!(!text.contains("NaN"), "{name}");
        }
        let directory = tempfile::tempdir().expect("a directory");
        write(&generated, directory.path()).expect("written");
        assert!(
            stale(&generated, directory.path())
                .expect("read")
                .is_empty()
        );
        std::fs::write(directory.path().join("numbers.tex"), "").expect("written");
        std::fs::write(directory.path().join("old.tex"), "").expect("written");
        let found = stale(&generated, directory.path()).expect("read");
        assert_eq!(found, ["numbers.tex: differs", "old.tex: not generated"]);
    }

    #[test]
    fn a_missing_file_is_named() {
        let empty = tempfile::tempdir().expect("a directory");
        let error = generate(empty.path()).expect_err("no results");
        assert!(error.to_string().starts_with("MACHINE.txt"), "{error}");
        std::fs::write(
            empty.path().join("MACHINE.txt"),
            "cpu: a\ncores: 1\nrustc: b\n",
        )
        .expect("written");
        let error = generate(empty.path()).expect_err("no results");
        assert!(error.to_string().starts_with("fig9"), "{error}");
    }

    /// All LaTeX files of the paper, with their texts.
    fn sources() -> Vec<(PathBuf, String)> {
        let paper = Path::new(env!("CARGO_MANIFEST_DIR")).join("../paper");
        let files = [paper.clone(), paper.join("figures")]
            .into_iter()
            .flat_map(|directory| std::fs::read_dir(directory).expect("the paper").flatten());
        let tex = files
            .map(|entry| entry.path())
            .filter(|p| p.extension().is_some_and(|e| e == "tex"));
        tex.map(|path| {
            let text = std::fs::read_to_string(&path).expect("text");
            (path, text)
        })
        .collect()
    }

    /// Words after every `before`, which end where TeX's names end.
    fn words<'a>(text: &'a str, before: &'a str) -> impl Iterator<Item = &'a str> {
        let parts = text.split(before).skip(1);
        parts.map(|part| {
            let end = part.find(|c: char| !(c.is_ascii_alphanumeric() || "-.".contains(c)));
            &part[..end.unwrap_or(part.len())]
        })
    }

    /// Without this a misspelt file or command would be found only by who builds the PDF.
    #[test]
    fn the_text_uses_what_there_is() {
        let generated = generate(&results()).expect("complete results");
        let numbers = &generated.files["numbers.tex"];
        let optional = [
            "Rivals", "Scaling", "Steiner", "TableOne", "TableTwo", "Failures", "Modes", "Updates",
        ];
        let needed = ["Machine", "FigNine", "Order", "Case", "Cost", "Growth"];
        let (mut files, mut commands) = (0, 0);
        for (path, text) in sources() {
            let tables = words(&text, "\\fitted{").map(|name| format!("{name}.tex"));
            let points = words(&text, "{generated/").filter(|name| name.ends_with(".dat"));
            for name in tables.chain(points.map(str::to_string)) {
                let missing = !generated.files.contains_key(&name);
                assert!(!missing, "{}: {name}", path.display());
                files += 1;
            }
            for name in words(&text, "\\").map(|name| name.trim_end_matches('.')) {
                if needed.iter().any(|start| name.starts_with(start)) {
                    let defined = numbers.contains(&format!("\\newcommand{{\\{name}}}"));
                    assert!(defined, "{}: \\{name}", path.display());
                    commands += 1;
                }
            }
        }
        assert!(
            files > 10 && commands > 50,
            "{files} files, {commands} commands"
        );
        for experiment in optional {
            assert!(
                numbers.contains(&format!("\\newif\\if{experiment}")),
                "{experiment}"
            );
        }
    }
}
