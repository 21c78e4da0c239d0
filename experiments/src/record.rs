//! Results on disk: CSV rows, text, and the machine they were made on. A file is complete or it is not there: it is
//! written under a temporary name and renamed.

use serde::Serialize;
use std::fmt;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::Command;
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
        std::fs::create_dir_all(directory).map_err(|source| RecordError::Io {
            path: directory.to_path_buf(),
            source,
        })?;
        let results = Results {
            directory: directory.to_path_buf(),
        };
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
        let csv_error = |source: csv::Error| RecordError::Csv {
            path: path.clone(),
            source,
        };
        let mut writer = csv::Writer::from_writer(Vec::new());
        for row in rows {
            writer.serialize(row).map_err(csv_error)?;
        }
        let bytes = writer
            .into_inner()
            .map_err(|e| csv_error(e.into_error().into()))?;
        self.bytes(&name, &bytes)
    }

    /// Writes a text file, for instance `STEM.svg`, and returns its path.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn text(&self, name: &str, text: &str) -> Result<PathBuf, RecordError> {
        self.bytes(name, text.as_bytes())
    }

    fn bytes(&self, name: &str, bytes: &[u8]) -> Result<PathBuf, RecordError> {
        let path = self.directory.join(name);
        match write_at_once(&self.directory, &path, bytes) {
            Ok(()) => Ok(path),
            Err(source) => Err(RecordError::Io { path, source }),
        }
    }
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

/// What a time depends on. Displayed as lines `key: value`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Machine {
    /// The model of the processor.
    pub cpu: String,
    /// The number of threads that can run at once.
    pub cores: usize,
    /// The operating system, its kernel and the architecture.
    pub os: String,
    /// The compiler that compiled this program.
    pub rustc: String,
    /// The commit of the source directory at the time of the run, with `-dirty` if tracked files
    /// other than results differ from it.
    pub commit: String,
    /// The version of tetflip.
    pub tetflip: String,
}

impl Machine {
    /// This machine; `unknown` for what it does not tell.
    pub fn detect() -> Machine {
        let unknown = || "unknown".to_string();
        let read = |path: &str| std::fs::read_to_string(path).ok();
        let cpu = read("/proc/cpuinfo").and_then(|text| value_of(&text, "model name", ':'));
        let release = read("/etc/os-release").and_then(|text| value_of(&text, "PRETTY_NAME", '='));
        let kernel = read("/proc/sys/kernel/osrelease").map(|text| text.trim().to_string());
        let system = [release, kernel].into_iter().flatten();
        let os = [std::env::consts::OS.to_string()].into_iter().chain(system);
        let os: Vec<String> = os.chain([std::env::consts::ARCH.to_string()]).collect();
        Machine {
            cpu: cpu.unwrap_or_else(unknown),
            cores: std::thread::available_parallelism().map_or(1, usize::from),
            os: os.join(", "),
            rustc: env!("RUSTC_VERSION").to_string(),
            commit: commit_of(Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap_or_else(unknown),
            tetflip: env!("CARGO_PKG_VERSION").to_string(),
        }
    }
}

impl fmt::Display for Machine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "cpu: {}", self.cpu)?;
        writeln!(f, "cores: {}", self.cores)?;
        writeln!(f, "os: {}", self.os)?;
        writeln!(f, "rustc: {}", self.rustc)?;
        writeln!(f, "commit: {}", self.commit)?;
        writeln!(f, "tetflip: {}", self.tetflip)
    }
}

/// The first value of `key` in lines `key separator value`, without quotes.
fn value_of(text: &str, key: &str, separator: char) -> Option<String> {
    let mut pairs = text.lines().filter_map(|line| line.split_once(separator));
    let (_, value) = pairs.find(|(k, _)| k.trim() == key)?;
    let value = value.trim().trim_matches('"');
    (!value.is_empty()).then(|| value.to_string())
}

/// Results are not sources: they change while experiments run.
fn commit_of(directory: &Path) -> Option<String> {
    let git = |arguments: &[&str]| {
        Command::new("git")
            .arg("-C")
            .arg(directory)
            .args(arguments)
            .output()
            .ok()
    };
    let head = git(&["rev-parse", "HEAD"])?;
    let commit = String::from_utf8(head.stdout).ok()?.trim().to_string();
    if !head.status.success() || commit.is_empty() {
        return None;
    }
    let sources = [":/", ":(top,exclude)results", ":(top,exclude)paper"];
    let same = git(&[&["diff", "--quiet", "HEAD", "--"], &sources[..]].concat())?;
    Some(match same.status.code() {
        Some(0) => commit,
        _ => commit + "-dirty",
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use tempfile::TempDir;

    #[derive(Serialize)]
    struct Row {
        method: &'static str,
        crossing: usize,
        seconds: f64,
        steiner: Option<u32>,
    }

    fn row(method: &'static str, seconds: f64, steiner: Option<u32>) -> Row {
        Row {
            method,
            crossing: 102,
            seconds,
            steiner,
        }
    }

    #[test]
    fn rows_and_machine() {
        let directory = TempDir::new().unwrap();
        let path = directory.path().join("a/b");
        let results = Results::create(&path).unwrap();
        let rows = [
            row("flip", 1.5e-7, None),
            row("a \"cavity\", so to speak", 0.1, Some(3)),
        ];
        let csv = results.rows("fig9", &rows).unwrap();
        assert_eq!(csv, path.join("fig9.csv"));
        let text = std::fs::read_to_string(csv).unwrap();
        let expected = "method,crossing,seconds,steiner\nflip,102,1.5e-7,\n\"a \"\"cavity\"\", so to speak\",102,0.1,3\n";
        assert_eq!(text, expected);
        // Written again, it is replaced as a whole; no temporary file stays.
        results.rows("fig9", &rows[..1]).unwrap();
        let entries = std::fs::read_dir(&path).unwrap();
        let mut names: Vec<_> = entries.map(|e| e.unwrap().file_name()).collect();
        names.sort();
        assert_eq!(names, ["MACHINE.txt", "fig9.csv"]);
        let machine = std::fs::read_to_string(path.join("MACHINE.txt")).unwrap();
        let keys: Vec<&str> = machine
            .lines()
            .filter_map(|line| Some(line.split_once(": ")?.0))
            .collect();
        assert_eq!(keys, ["cpu", "cores", "os", "rustc", "commit", "tetflip"]);
        assert!(machine.contains("rustc: rustc 1."), "{machine}");
    }

    #[test]
    fn a_failed_recording_keeps_the_old_rows() {
        let directory = TempDir::new().unwrap();
        let results = Results::create(directory.path()).unwrap();
        let csv = results.rows("t", &[row("flip", 1.0, None)]).unwrap();
        let old = std::fs::read_to_string(&csv).unwrap();
        assert!(matches!(
            results.rows::<Row>("t", &[]),
            Err(RecordError::NoRows { .. })
        ));
        assert!(matches!(
            results.rows("t", &[vec![1, 2], vec![1]]),
            Err(RecordError::Csv { .. })
        ));
        assert_eq!(std::fs::read_to_string(&csv).unwrap(), old);
        assert!(matches!(
            results.rows("no/such", &[row("", 1.0, None)]),
            Err(RecordError::Io { .. })
        ));
    }

    #[test]
    fn values_in_text() {
        let text = "processor\t: 0\nmodel name\t: A: 1\nmodel name\t: B\n";
        assert_eq!(value_of(text, "model name", ':').as_deref(), Some("A: 1"));
        assert_eq!(
            value_of("X=1\nPRETTY_NAME=\"Some OS\"\n", "PRETTY_NAME", '=').as_deref(),
            Some("Some OS")
        );
        assert_eq!(value_of(text, "flags", ':'), None);
    }

    #[test]
    fn a_missing_directory_has_no_commit() {
        assert_eq!(
            commit_of(&TempDir::new().unwrap().path().join("missing")),
            None
        );
    }
}
