//! PLCs from files and from bytes: which reader reads what, by name and by content.

use super::sniff;
use super::{
    FormatError, read_medit, read_node, read_obj, read_off, read_ply, read_poly, read_smesh,
    read_stl, sibling,
};
use crate::exchange::{Note, NoteCode, Plc};
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// A format of PLCs, by the extension of its files.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum PlcFormat {
    /// TetGen's facets of polygons.
    Poly,
    /// TetGen's facets of one polygon each.
    Smesh,
    /// TetGen's vertices.
    Node,
    /// Geomview's polygons.
    Off,
    /// Triangles.
    Stl,
    /// Stanford's polygons.
    Ply,
    /// Wavefront's polygons.
    Obj,
    /// Medit's surface meshes (`.mesh`).
    Medit,
}

impl PlcFormat {
    /// All of them, with the extensions of their files.
    pub const ALL: [(PlcFormat, &'static str); 8] = [
        (PlcFormat::Poly, "poly"),
        (PlcFormat::Smesh, "smesh"),
        (PlcFormat::Node, "node"),
        (PlcFormat::Off, "off"),
        (PlcFormat::Stl, "stl"),
        (PlcFormat::Ply, "ply"),
        (PlcFormat::Obj, "obj"),
        (PlcFormat::Medit, "mesh"),
    ];
}

impl FromStr for PlcFormat {
    type Err = FormatError;

    /// The format of an extension, without its point and in either case.
    fn from_str(extension: &str) -> Result<PlcFormat, FormatError> {
        let lower = match &extension.to_ascii_lowercase()[..] {
            // Binary, which the reader refuses.
            "meshb" => "mesh".to_owned(),
            other => other.to_owned(),
        };
        let known = PlcFormat::ALL.iter().find(|(_, name)| *name == lower);
        known
            .map(|&(format, _)| format)
            .ok_or_else(|| FormatError::UnknownExtension(extension.to_owned()))
    }
}

/// Reads a file in the format that its extension names, in either case: `.poly`, `.smesh`, `.node`, `.off`, `.stl`,
/// `.ply`, `.obj` or `.mesh`. What a file without an extension is, is seen by its content, and said in a note.
///
/// # Errors
/// If the file cannot be read or is malformed; and if it then looks like a file of another format, the error says so.
pub fn read_plc(path: &Path) -> Result<(Plc, Vec<Note>), FormatError> {
    read_plc_as(path, None)
}

/// Reads a file in a format, if one is given, whatever its name; else as [`read_plc`] does.
///
/// # Errors
/// Those of [`read_plc`].
pub fn read_plc_as(
    path: &Path,
    format: Option<PlcFormat>,
) -> Result<(Plc, Vec<Note>), FormatError> {
    let bytes = bytes_of(path)?;
    // The vertices of a .poly or .smesh file may be in a .node file beside it.
    let nodes = || {
        let bytes = bytes_of(&node_path(path))?;
        sniff::refuse_packed(&bytes)?;
        Ok(bytes)
    };
    let of_name = || path.extension().map(|e| e.to_string_lossy().parse());
    let format = match format.map(Ok).or_else(of_name).transpose() {
        Ok(format) => format,
        Err(error) => {
            sniff::refuse_packed(&bytes)?;
            return Err(explain(error, None, &bytes));
        }
    };
    read(&bytes, format, nodes)
}

/// Reads a PLC from the bytes of one file. Without a format, what it is is seen by its content, and said in a note.
///
/// # Errors
/// If it is malformed; if no format is given and it looks like none; or if its vertices are in a `.node` file.
pub fn read_plc_bytes(
    bytes: &[u8],
    format: Option<PlcFormat>,
) -> Result<(Plc, Vec<Note>), FormatError> {
    read(bytes, format, || Err(FormatError::NodesElsewhere))
}

fn read(
    bytes: &[u8],
    format: Option<PlcFormat>,
    nodes: impl FnOnce() -> Result<Vec<u8>, FormatError>,
) -> Result<(Plc, Vec<Note>), FormatError> {
    sniff::refuse_packed(bytes)?;
    let mut seen = None;
    let format = match (format, sniff::looks_like(bytes)) {
        (Some(format), _) => format,
        (None, Some((Some(format), name))) => {
            seen = Some(name);
            format
        }
        (None, _) => {
            let error = FormatError::UnknownExtension(String::new());
            return Err(explain(error, None, bytes));
        }
    };
    let result = match format {
        PlcFormat::Poly => read_poly(bytes, nodes),
        PlcFormat::Smesh => read_smesh(bytes, nodes),
        PlcFormat::Node => read_node(bytes),
        PlcFormat::Off => read_off(bytes),
        PlcFormat::Stl => read_stl(bytes),
        PlcFormat::Ply => read_ply(bytes),
        PlcFormat::Obj => read_obj(bytes),
        PlcFormat::Medit => read_medit(bytes),
    };
    let (plc, mut notes) = result.map_err(|error| explain(error, Some(format), bytes))?;
    if let Some(name) = seen {
        let text = format!("no format is given; the file looks like {name} and is read as one");
        notes.insert(0, Note::new(NoteCode::FormatByContent, 1, text));
    }
    Ok((plc, notes))
}

/// The error, with what the file looks like if that is something else.
fn explain(error: FormatError, format: Option<PlcFormat>, bytes: &[u8]) -> FormatError {
    match sniff::looks_like(bytes) {
        Some((other, found)) if other.is_none() || other != format => FormatError::LooksLike {
            error: Box::new(error),
            found,
        },
        _ => error,
    }
}

/// The file that holds the vertices of a `.poly` or `.smesh` file whose own list of vertices is empty.
pub fn node_path(path: &Path) -> PathBuf {
    sibling(path, "node")
}

fn bytes_of(path: &Path) -> Result<Vec<u8>, FormatError> {
    std::fs::read(path).map_err(|source| FormatError::Io {
        path: path.to_owned(),
        source,
    })
}
