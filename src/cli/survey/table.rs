//! The table of a survey: a CSV file that grows by whole rows and can be taken up again after any interruption.
//!
//! A row is one line (messages are folded), written at once and synchronized to the disk before the next run counts. So
//! all that an interruption can leave is a torn last line, which is cut when the file is opened again. The rows of
//! several shards may simply be concatenated: a header that comes again is skipped.

use super::method::Method;
use super::models::Model;
use super::run::Settings;
use super::worker::Findings;
use csv::StringRecord;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fs::{File, OpenOptions, Permissions, TryLockError};
use std::io::{Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use tetflip::report::Report;

/// How long a message may be, in letters.
const MESSAGE: usize = 400;

/// The columns before the counts of the report.
const COLUMNS: [&str; 33] = [
    "file",
    "format",
    "bytes",
    "hash",
    "insertion",
    "times",
    "steiner",
    "outcome",
    "kind",
    "message",
    "verified",
    "violations",
    "defects",
    "equal",
    "vertices",
    "facets",
    "steiner_points",
    "tetrahedra",
    "flips",
    "regions",
    "mesh_hash",
    "seconds_read",
    "seconds_mesh",
    "seconds_verify",
    "seconds",
    "peak_mib",
    "limit_seconds",
    "limit_mib",
    "domain",
    "merged",
    "checked",
    "program",
    "system",
];

/// What is wrong with a table.
#[derive(Debug, thiserror::Error)]
pub(super) enum TableError {
    #[error("{}: {source}", .path.display())]
    Io {
        path: PathBuf,
        source: std::io::Error,
    },
    #[error("{}: another survey is writing it", .path.display())]
    Busy { path: PathBuf },
    #[error("{}: not the table of a survey by this version; choose another name", .path.display())]
    Header { path: PathBuf },
    #[error("{}, line {line}: not a row of the table", .path.display())]
    Row { path: PathBuf, line: usize },
    #[error("{}: its last line is torn; complete it by the survey that made it", .path.display())]
    Torn { path: PathBuf },
    #[error("{} contradicts another table: {row}", .path.display())]
    Conflict { path: PathBuf, row: String },
}

/// A row, with its columns by name.
#[derive(Clone, Debug)]
pub(super) struct Row(pub StringRecord);

impl Row {
    /// The word in a column of [`COLUMNS`].
    pub(super) fn get(&self, column: &str) -> &str {
        let at = COLUMNS.iter().position(|c| *c == column);
        &self.0[at.expect("a column of the table")]
    }

    /// What tells it apart: the model and the method.
    pub(super) fn key(&self) -> [String; 4] {
        ["file", "insertion", "times", "steiner"].map(|c| self.get(c).to_owned())
    }

    /// Whether the mesh is one of ours.
    pub(super) fn is_ours(&self) -> bool {
        !self.get("insertion").starts_with("tetgen")
    }

    /// The method as words.
    pub(super) fn method(&self) -> String {
        let times = self.get("times");
        let colon = if times.is_empty() { "" } else { ":" };
        let [insertion, steiner] = ["insertion", "steiner"].map(|c| self.get(c));
        let space = if steiner.is_empty() { "" } else { " " };
        format!("{insertion}{colon}{times}{space}{steiner}")
    }
}

/// An open table. The file is locked as long as this lives.
#[derive(Debug)]
pub(super) struct Table {
    path: PathBuf,
    file: File,
    rows: Vec<Row>,
    keys: BTreeSet<[String; 4]>,
    /// The hash of our first mesh of a model and kind of Steiner points.
    first: BTreeMap<[String; 2], String>,
}

impl Table {
    /// Opens a table, or begins one; cuts a torn last line.
    pub(super) fn open(path: &Path) -> Result<Table, TableError> {
        let io = |source| TableError::Io {
            path: path.to_owned(),
            source,
        };
        let mut options = OpenOptions::new();
        options.read(true).write(true).create(true).truncate(false);
        let mut file = options.open(path).map_err(io)?;
        file.try_lock().map_err(|error| match error {
            TryLockError::WouldBlock => TableError::Busy {
                path: path.to_owned(),
            },
            TryLockError::Error(source) => io(source),
        })?;
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes).map_err(io)?;
        let whole = bytes.iter().rposition(|&b| b == b'\n').map_or(0, |i| i + 1);
        let line = line_of(&header());
        // Never cut what is no table of ours.
        if !bytes.starts_with(line.as_bytes()) && !line.as_bytes().starts_with(&bytes) {
            return Err(TableError::Header {
                path: path.to_owned(),
            });
        }
        file.set_len(whole as u64).map_err(io)?;
        file.seek(SeekFrom::End(0)).map_err(io)?;
        let mut table = Table {
            path: path.to_owned(),
            file,
            rows: Vec::new(),
            keys: BTreeSet::new(),
            first: BTreeMap::new(),
        };
        if whole == 0 {
            table.write(&line)?;
        }
        for row in parse(path, &bytes[..whole])? {
            table.push(row);
        }
        Ok(table)
    }

    /// Of two rows of one run, the first counts.
    fn push(&mut self, row: Row) {
        if !self.keys.insert(row.key()) {
            return;
        }
        if row.is_ours() && !row.get("mesh_hash").is_empty() {
            let place = ["file", "steiner"].map(|c| row.get(c).to_owned());
            let first = self.first.entry(place);
            first.or_insert_with(|| row.get("mesh_hash").to_owned());
        }
        self.rows.push(row);
    }

    /// Whether there is a row of this model and method.
    pub(super) fn has(&self, model: &Model, method: Method) -> bool {
        self.keys.contains(&key(model, method))
    }

    pub(super) fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// A model that is no longer what its rows are about.
    pub(super) fn changed<'a>(&self, models: &'a [Model]) -> Option<&'a Model> {
        let sizes: BTreeMap<&str, &str> = self
            .rows
            .iter()
            .map(|row| (row.get("file"), row.get("bytes")))
            .collect();
        models.iter().find(|model| {
            let size = sizes.get(model.name.as_str());
            size.is_some_and(|size| **size != model.bytes.to_string())
        })
    }

    /// Adds a row for good.
    pub(super) fn append(&mut self, run: &Run, settings: &Settings) -> Result<(), TableError> {
        let equal = self.equal(run);
        let row = Row(record(run, settings, equal));
        self.write(&line_of(&row.0))?;
        self.push(row);
        Ok(())
    }

    /// Whether a mesh of ours has the tetrahedra of the first of ours of the same model and Steiner points.
    fn equal(&self, run: &Run) -> &'static str {
        let Some(hash) = run.findings.mesh_hash else {
            return "";
        };
        if run.method.algorithm.is_foreign() {
            return "";
        }
        let steiner = run.method.steiner.to_string();
        let first = self.first.get(&[run.model.name.clone(), steiner]);
        match first {
            Some(first) if *first != hex(hash) => "no",
            _ => "yes",
        }
    }

    fn write(&mut self, line: &str) -> Result<(), TableError> {
        let written = self
            .file
            .write_all(line.as_bytes())
            .and_then(|()| self.file.sync_data());
        written.map_err(|source| TableError::Io {
            path: self.path.clone(),
            source,
        })
    }

    /// Replaces the file by one whose rows are in the order of the models' names: the same whatever ended first.
    pub(super) fn sort(&mut self) -> Result<(), TableError> {
        self.rows.sort_by(|a, b| a.get("file").cmp(b.get("file")));
        let permissions = self.file.metadata().map(|m| m.permissions()).ok();
        write_all(&self.path, &self.rows, permissions)
    }
}

/// The rows of a table without a header, or with several.
pub(super) fn parse(path: &Path, bytes: &[u8]) -> Result<Vec<Row>, TableError> {
    let header = header();
    let mut builder = csv::ReaderBuilder::new();
    let reader = builder.has_headers(false).flexible(true).from_reader(bytes);
    let mut rows = Vec::new();
    for (i, record) in reader.into_records().enumerate() {
        let broken = || TableError::Row {
            path: path.to_owned(),
            line: i + 1,
        };
        let record = record.map_err(|_| broken())?;
        if record == header {
            continue;
        }
        if record.len() != header.len() {
            return Err(broken());
        }
        rows.push(Row(record));
    }
    Ok(rows)
}

/// Writes a whole table at once.
pub(super) fn write_all(
    path: &Path,
    rows: &[Row],
    permissions: Option<Permissions>,
) -> Result<(), TableError> {
    let mut text = line_of(&header());
    for row in rows {
        text += &line_of(&row.0);
    }
    let parent = path.parent().filter(|p| *p != Path::new(""));
    let write = || {
        let mut builder = tempfile::Builder::new();
        // As any new file; a temporary one is private by default.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        let mut staged = builder.tempfile_in(parent.unwrap_or(Path::new(".")))?;
        staged.write_all(text.as_bytes())?;
        if let Some(permissions) = permissions {
            staged.as_file().set_permissions(permissions)?;
        }
        staged.as_file().sync_all()?;
        staged.persist(path).map_err(|error| error.error)?;
        Ok(())
    };
    write().map_err(|source| TableError::Io {
        path: path.to_owned(),
        source,
    })
}

/// A finished run.
#[derive(Clone, Debug)]
pub(super) struct Run<'a> {
    pub model: &'a Model,
    /// Of the model's bytes.
    pub hash: u64,
    pub method: Method,
    pub findings: Findings,
    /// Of the whole process.
    pub seconds: f64,
}

fn key(model: &Model, method: Method) -> [String; 4] {
    let [insertion, times, steiner] = method.columns();
    [model.name.clone(), insertion, times, steiner]
}

/// The columns, then the numbers of the report with the names that they have in its JSON file.
pub(super) fn header() -> StringRecord {
    let mut header: StringRecord = COLUMNS.iter().copied().collect();
    for (name, _) in leaves(&Report::default()) {
        header.push_field(&name);
    }
    header
}

fn record(run: &Run, settings: &Settings, equal: &str) -> StringRecord {
    let Findings {
        outcome,
        kind,
        message,
        verified,
        violations,
        defects,
        vertices,
        facets,
        steiner_points,
        tetrahedra,
        flips,
        regions,
        mesh_hash,
        peak_mib,
        seconds_read,
        seconds_mesh,
        seconds_verify,
        report,
    } = &run.findings;
    let [insertion, times, steiner] = run.method.columns();
    let yes = |is: bool| if is { "yes" } else { "no" }.to_owned();
    let front: [String; COLUMNS.len()] = [
        run.model.name.clone(),
        run.model.format(),
        run.model.bytes.to_string(),
        hex(run.hash),
        insertion,
        times,
        steiner,
        outcome.clone(),
        kind.clone(),
        one_line(message),
        verified.clone(),
        violations.to_string(),
        one_line(defects),
        equal.to_owned(),
        word(vertices),
        word(facets),
        word(steiner_points),
        word(tetrahedra),
        word(flips),
        word(regions),
        mesh_hash.map_or_else(String::new, hex),
        format!("{seconds_read:.6}"),
        format!("{seconds_mesh:.6}"),
        seconds_verify.map_or_else(String::new, |s| format!("{s:.6}")),
        format!("{:.6}", run.seconds),
        peak_mib.map_or_else(String::new, |mib| format!("{mib:.1}")),
        settings.timeout.to_string(),
        settings.memory.to_string(),
        if settings.keep_hull { "hull" } else { "inside" }.to_owned(),
        yes(settings.merge_coplanar),
        yes(settings.verify),
        env!("CARGO_PKG_VERSION").to_owned(),
        format!("{}-{}", std::env::consts::OS, std::env::consts::ARCH),
    ];
    let mut record: StringRecord = front.iter().collect();
    for (name, _) in leaves(&Report::default()) {
        let found = name
            .split('.')
            .try_fold(report, |value, key| value.get(key));
        record.push_field(&found.map_or_else(String::new, Value::to_string));
    }
    record
}

/// The numbers in a report, with their paths in JSON, in the order of the paths.
fn leaves(report: &Report) -> Vec<(String, Value)> {
    fn collect(path: &str, value: &Value, list: &mut Vec<(String, Value)>) {
        match value {
            Value::Object(map) => {
                for (key, value) in map {
                    let path = if path.is_empty() {
                        key.clone()
                    } else {
                        format!("{path}.{key}")
                    };
                    collect(&path, value, list);
                }
            }
            Value::Number(_) => list.push((path.to_owned(), value.clone())),
            _ => {}
        }
    }
    let mut list = Vec::new();
    let value = serde_json::to_value(report).expect("a report is JSON");
    collect("", &value, &mut list);
    // Those that TetGen has, too, are in front already.
    list.retain(|(name, _)| !COLUMNS.contains(&name.as_str()));
    list.sort_by(|a, b| a.0.cmp(&b.0));
    list
}

pub(super) fn line_of(record: &StringRecord) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(record).expect("writing to memory");
    let bytes = writer.into_inner().expect("writing to memory");
    String::from_utf8(bytes).expect("made of strings")
}

fn one_line(text: &str) -> String {
    let letters = text.chars().map(|c| if c.is_control() { ' ' } else { c });
    letters.take(MESSAGE).collect()
}

fn word<T: ToString>(number: &Option<T>) -> String {
    number.as_ref().map_or_else(String::new, T::to_string)
}

fn hex(hash: u64) -> String {
    format!("{hash:016x}")
}
