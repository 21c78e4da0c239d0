//! The generated part of the paper: tables, points of plots, and a command for every number in its text, from the CSV
//! files of the results.
//!
//! `experiments paper` writes them to `paper/generated`; `--check` compares instead. A file or a row that is missing is
//! an error that names it, except for the experiments that need other programs or hours (`optional`): in their place
//! the paper says that they have not been run. Sentences that numbers could contradict are claims. What the text needs
//! is listed in two tables, `numbers.txt` and `claims.txt`. The same results give the same bytes.

mod figures;
mod lint;
mod needed;
mod number;
mod numbers;
mod optional;
mod sheets;
mod table;

pub use crate::frame::sheet::SheetError;
pub use lint::{Finding, digits};
pub use numbers::Claim;

use sheets::Sheets;
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

/// Everything, from a directory of results.
///
/// # Errors
/// If a file, a column or a row is missing.
pub fn generate(results: &Path) -> Result<Generated, SheetError> {
    let sheets = Sheets::read(results)?;
    let commands = numbers::commands(include_str!("numbers.txt"), &sheets)?;
    let mut files = BTreeMap::from([("numbers.tex".to_string(), commands)]);
    for (name, text) in needed::files(&sheets)?
        .into_iter()
        .chain(figures::files(&sheets, results)?)
        .chain(optional::files(&sheets)?)
    {
        let before = files.insert(name, text);
        assert!(before.is_none(), "two files of one name");
    }
    let claims = numbers::claims(include_str!("claims.txt"), &sheets)?;
    Ok(Generated { files, claims })
}

/// Writes the files to a directory, and returns how many.
///
/// # Errors
/// If they cannot be written.
pub fn write(generated: &Generated, directory: &Path) -> Result<usize, SheetError> {
    let refused = |path: &Path| {
        let path = path.to_path_buf();
        move |source| SheetError::Io { path, source }
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
pub fn stale(generated: &Generated, directory: &Path) -> Result<Vec<String>, SheetError> {
    let mut stale = Vec::new();
    for (name, text) in &generated.files {
        match std::fs::read_to_string(directory.join(name)) {
            Ok(old) if old == *text => {}
            Ok(_) => stale.push(format!("{name}: differs")),
            Err(_) => stale.push(format!("{name}: missing")),
        }
    }
    let entries = std::fs::read_dir(directory).map_err(|source| SheetError::Io {
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
        for (name, text) in &generated.files {
            assert!(!text.contains("NaN"), "{name}");
        }
        let directory = tempfile::tempdir().expect("a directory");
        let path = directory.path();
        write(&generated, path).expect("written");
        assert_eq!(stale(&generated, path).expect("read"), [] as [&str; 0]);
        std::fs::write(path.join("numbers.tex"), "").expect("written");
        std::fs::write(path.join("old.tex"), "").expect("written");
        let found = stale(&generated, path).expect("read");
        assert_eq!(found, ["numbers.tex: differs", "old.tex: not generated"]);
    }

    #[test]
    fn a_missing_file_is_named_and_an_optional_one_is_said() {
        let directory = tempfile::tempdir().expect("a directory");
        let error = || {
            generate(directory.path())
                .expect_err("no results")
                .to_string()
        };
        assert!(error().starts_with("MACHINE.txt"), "{}", error());
        let machine = "cpu: a\ncores: 1\nrustc: b\n";
        std::fs::write(directory.path().join("MACHINE.txt"), machine).expect("written");
        assert!(error().starts_with("fig9-summary.csv"), "{}", error());
        let optional = ["rivals", "steiner", "table1"];
        for entry in std::fs::read_dir(results()).expect("results").flatten() {
            let name = entry.file_name().to_string_lossy().into_owned();
            let is_read = name.ends_with(".csv") || name.ends_with(".svg");
            if is_read && !optional.iter().any(|stem| name.starts_with(stem)) {
                std::fs::copy(entry.path(), directory.path().join(name)).expect("copied");
            }
        }
        std::fs::write(
            directory.path().join("rivals.csv"),
            "input,program\na,tetflip\n",
        )
        .expect("written");
        let generated = generate(directory.path()).expect("what is needed is there");
        let numbers = &generated.files["numbers.tex"];
        for (stem, switch) in [
            ("rivals", "Rivals"),
            ("steiner", "Steiner"),
            ("table1", "TableOne"),
        ] {
            // Alone nothing is compared.
            assert!(
                generated.files[&format!("{stem}-table.tex")].contains("Not measured"),
                "{stem}"
            );
            assert!(
                numbers.contains(&format!("\\newif\\if{switch}\\{switch}false")),
                "{switch}"
            );
        }
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
            "Price", "Modelled",
        ];
        let needed = [
            "Machine",
            "FigNine",
            "Order",
            "Case",
            "Cost",
            "Growth",
            "Quadratic",
        ];
        let (mut files, mut commands) = (0, 0);
        for (path, text) in sources() {
            let tables = words(&text, "\\fitted{").map(|name| format!("{name}.tex"));
            let points = words(&text, "{generated/").filter(|name| name.ends_with(".dat"));
            let pictures = words(&text, "{generated/")
                .filter(|name| name.starts_with("picture"))
                .map(|name| format!("{name}.tex"));
            for name in tables.chain(points.map(str::to_string)).chain(pictures) {
                let optional = ["price", "flip-models"]
                    .iter()
                    .any(|stem| name.starts_with(stem));
                if optional && !generated.files.contains_key(&name) {
                    continue;
                }
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
