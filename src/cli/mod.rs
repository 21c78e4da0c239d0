//! The subcommands, one module each, and what they share: reading, writing, and failures with exit statuses.

pub(crate) mod check;
pub(crate) mod delaunay;
pub(crate) mod generate;
mod input;
pub(crate) mod mesh;
mod output;
pub(crate) mod survey;
pub(crate) mod verify;

use input::Input;
use std::io::Write;
use std::path::{Path, PathBuf};
use tetflip::format::{FormatError, mesh_paths, node_path, read_poly, read_smesh};

/// A failure with its exit status.
pub(crate) struct Stop {
    /// What to say.
    pub message: String,
    /// The exit status.
    pub status: u8,
}

impl Stop {
    /// Bad input or usage.
    pub fn input(message: impl ToString) -> Stop {
        Stop {
            message: message.to_string(),
            status: 2,
        }
    }

    /// The algorithm or a verification failed.
    pub fn failed(message: impl ToString) -> Stop {
        Stop {
            message: message.to_string(),
            status: 1,
        }
    }
}

/// Where the region of failed flips goes: beside the mesh that is not made.
pub(crate) fn failure_path(output: &Path) -> PathBuf {
    output.with_extension("failure.poly")
}

/// Refuses outputs that cannot be written, would replace an input, or each other, before any work is done.
fn check_outputs(input: &Input, mesh: Option<&Path>, report: Option<&Path>) -> Result<(), Stop> {
    let mut outputs: Vec<PathBuf> = Vec::new();
    if let Some(path) = mesh {
        outputs.extend(mesh_paths(path).map_err(Stop::input)?);
        outputs.push(failure_path(path));
    }
    if let Some(report) = report {
        if outputs.iter().any(|output| is_same_place(output, report)) {
            let name = report.display();
            return Err(Stop::input(format!(
                "{name} would be both a report and a file of the mesh; choose another name"
            )));
        }
        outputs.push(report.to_path_buf());
    }
    let Some(input) = input.file() else {
        return Ok(());
    };
    let node = node_path(input);
    for output in outputs {
        let replaces = |file: &Path| match (output.canonicalize(), file.canonicalize()) {
            (Ok(output), Ok(file)) => output == file,
            _ => false,
        };
        if replaces(input) || (replaces(&node) && reads_node_file(input)) {
            return Err(Stop::input(format!(
                "{} is an input and would be overwritten; choose another name",
                output.display()
            )));
        }
    }
    Ok(())
}

/// Whether two paths are those of one file, which need not be there.
fn is_same_place(first: &Path, second: &Path) -> bool {
    let full = |path: &Path| {
        path.canonicalize().unwrap_or_else(|_| {
            let parent = path.parent().filter(|p| !p.as_os_str().is_empty());
            let parent = parent.unwrap_or(Path::new("."));
            let parent = parent.canonicalize().unwrap_or(parent.to_path_buf());
            parent.join(path.file_name().unwrap_or_default())
        })
    };
    full(first) == full(second)
}

/// Whether the vertices of a `.poly` or `.smesh` file are in the `.node` file beside it.
fn reads_node_file(input: &Path) -> bool {
    let extension = input.extension().unwrap_or_default().to_ascii_lowercase();
    let bytes = std::fs::read(input).unwrap_or_default();
    let mut asked = false;
    let nodes = || {
        asked = true;
        std::fs::read(node_path(input)).map_err(|source| FormatError::Io {
            path: input.to_owned(),
            source,
        })
    };
    // Errors are reported when the file is read in earnest.
    let _ = match extension.to_str() {
        Some("poly") => read_poly(&bytes, nodes),
        Some("smesh") => read_smesh(&bytes, nodes),
        _ => return false,
    };
    asked
}

/// Prints a line. That nobody reads it (a closed pipe) is no failure of the run.
pub(crate) fn say(line: &str) {
    let _ = writeln!(std::io::stdout(), "{line}");
}

/// Prints a line on stderr: what the user should know even of a quiet run that succeeds.
pub(crate) fn warn(line: &str) {
    let _ = writeln!(std::io::stderr(), "{line}");
}
