//! The subcommands, one module each, and what they share: reading, writing, and failures with exit statuses.

pub(crate) mod check;
pub(crate) mod delaunay;
pub(crate) mod generate;
pub(crate) mod mesh;
pub(crate) mod survey;
pub(crate) mod verify;

use std::io::Write;
use std::path::{Path, PathBuf};
use tetflip::exchange::{ExportedMesh, Note, Plc};
use tetflip::format::{
    FormatError, mesh_paths, node_path, read_plc, read_poly, read_smesh, write_mesh,
};

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

/// Reads a PLC and prints the notes of its reader, which are returned, too; the message of a failure names the file.
pub(crate) fn read(path: &Path) -> Result<(Plc, Vec<Note>), Stop> {
    let read = read_plc(path).map_err(|error| match error {
        FormatError::Io { .. } => Stop::input(error),
        error => Stop::input(format!("{}: {error}", path.display())),
    })?;
    read.1.iter().for_each(|note| warn(&note.to_string()));
    Ok(read)
}

/// Writes a mesh, if there is a place for it.
pub(crate) fn save(path: Option<&Path>, mesh: &ExportedMesh) -> Result<(), Stop> {
    match path {
        Some(path) => write_mesh(path, mesh).map(|_| ()).map_err(Stop::input),
        None => Ok(()),
    }
}

/// Refuses outputs that cannot be written or would replace an input, before any work is done.
pub(crate) fn check_outputs(
    input: &Path,
    mesh: Option<&Path>,
    report: Option<&Path>,
) -> Result<(), Stop> {
    let mut outputs: Vec<PathBuf> = report.map(Path::to_path_buf).into_iter().collect();
    if let Some(path) = mesh {
        outputs.extend(mesh_paths(path).map_err(Stop::input)?);
        outputs.push(failure_path(path));
    }
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
