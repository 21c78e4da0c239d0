//! Where a mesh goes: to files, to stdout, or nowhere.

use super::{Stop, say, warn};
use std::io::Write;
use std::path::Path;
use tetflip::exchange::ExportedMesh;
use tetflip::format::{write_mesh, write_mesh_to};

/// The path that stands for stdout.
pub(super) const STDOUT: &str = "-";

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
    /// Of the arguments.
    pub fn new(path: Option<&'a Path>, format: Option<&'a str>) -> Result<Output<'a>, Stop> {
        match (path, format) {
            (Some(path), Some(format)) if path == STDOUT => {
                // Refused before there is work.
                let probe = ExportedMesh::default();
                write_mesh_to(&mut std::io::sink(), format, &probe).map_err(Stop::input)?;
                Ok(Output::Stdout { format })
            }
            (Some(path), None) if path == STDOUT => {
                Err(Stop::input("--output - needs a --format, vtu"))
            }
            (_, Some(_)) => Err(Stop::input("--format is the format of --output -")),
            (Some(path), None) => Ok(Output::Files(path)),
            (None, None) => Ok(Output::Nowhere),
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
