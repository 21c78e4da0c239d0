//! Where a mesh goes: to files, to stdout, or nowhere.

use super::input::Input;
use super::{Stop, say, warn};
use std::io::Write;
use std::path::Path;
use tetflip::exchange::ExportedMesh;
use tetflip::format::{write_mesh, write_mesh_to};

/// The path that stands for stdout.
const STDOUT: &str = "-";

/// Where a mesh goes.
pub(super) enum Output<'a> {
    /// It is only counted.
    Nowhere,
    /// To files of a stem.
    Files(&'a Path),
    /// To stdout, in a format of one file. What else is said goes to stderr.
    Stdout {
        /// The extension of such files.
        format: &'a str,
    },
}

impl<'a> Output<'a> {
    /// Of the arguments. If the input is stdin, with a format, then stdout needs none, since there is but one.
    pub fn new(
        path: Option<&'a Path>,
        formats: &[&'a str],
        input: &Input,
    ) -> Result<Output<'a>, Stop> {
        match (path, formats) {
            (Some(path), &[format]) if path == STDOUT => {
                // Refused before there is work.
                let probe = ExportedMesh::default();
                write_mesh_to(&mut std::io::sink(), format, &probe).map_err(Stop::input)?;
                Ok(Output::Stdout { format })
            }
            (Some(path), []) if path == STDOUT => match input.format_name() {
                Some(_) if input.is_stdin() => Ok(Output::Stdout { format: "vtu" }),
                // A file has its name: the format was meant for stdout.
                Some(format) => Output::new(Some(path), &[format], input),
                None => Err(Stop::input("--output - needs a --format, vtu")),
            },
            (Some(path), []) => Ok(Output::Files(path)),
            (None, []) => Ok(Output::Nowhere),
            (_, [format, ..]) => Err(Stop::input(format!(
                "--format {format} is neither a format of a PLC nor, once, that of --output -"
            ))),
        }
    }

    /// The path of files.
    pub fn path(&self) -> Option<&'a Path> {
        match self {
            Output::Files(path) => Some(path),
            _ => None,
        }
    }

    /// Writes a mesh.
    pub fn save(&self, mesh: &ExportedMesh) -> Result<(), Stop> {
        match self {
            Output::Nowhere => Ok(()),
            Output::Files(path) => write_mesh(path, mesh).map(|_| ()).map_err(Stop::input),
            Output::Stdout { format } => {
                let mut stdout = std::io::stdout().lock();
                write_mesh_to(&mut stdout, format, mesh).map_err(Stop::input)?;
                stdout.flush().map_err(Stop::input)
            }
        }
    }

    /// Prints a summary where it does not get into the mesh.
    pub fn say(&self, line: &str) {
        match self {
            Output::Stdout { .. } => warn(line),
            _ => say(line),
        }
    }
}
