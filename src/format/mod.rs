//! Files: PLCs in, in the formats of TetGen (`.poly`, `.smesh`, `.node`), OFF, STL, PLY, OBJ and Medit (`.mesh`);
//! meshes out and in.
//!
//! Every reader takes the bytes of a file and gives a [`Plc`] with notes on what was forgiven, or a [`FormatError`]
//! with a line or an offset. Readers are linear in the file's size whatever its header says, and check the syntax
//! alone; [`crate::plc::Complex::new`] checks the geometry. What a reader accepts has at least one vertex, finite
//! coordinates, and no corner out of range.

mod ahead;
mod bytes;
mod conflicts_vtu;
mod error;
mod lines;
mod medit;
mod medit_mesh;
mod mesh_error;
mod mesh_file;
mod obj;
mod off;
mod off_binary;
mod ply;
mod ply_header;
mod poly;
mod poly_file;
mod sniff;
mod staged;
mod stl;
mod tetgen_mesh;
mod tetgen_writer;
mod text;
mod vertices;
mod vtu;

pub use conflicts_vtu::write_conflicts;
pub use error::{FormatError, Place, Reason};
pub use medit::read_medit;
pub use mesh_error::{MeshFileError, MeshLineError, UnwritableMesh};
#[doc(hidden)]
pub use mesh_file::mesh_paths;
pub use mesh_file::{read_mesh, write_mesh, write_mesh_to};
pub use obj::read_obj;
pub use off::read_off;
pub use ply::read_ply;
pub use poly::{read_node, read_poly, read_smesh};
pub use poly_file::write_poly;
#[doc(hidden)]
pub use staged::write_complete;
pub use stl::read_stl;

use crate::exchange::{Note, Plc};
use std::path::{Path, PathBuf};

/// The extensions of what [`read_plc`] reads.
pub const EXTENSIONS: [&str; 8] = ["mesh", "node", "obj", "off", "ply", "poly", "smesh", "stl"];

/// Reads a file in the format that its extension names, in either case: `.poly`, `.smesh`, `.node`, `.off`, `.stl`,
/// `.ply`, `.obj` or `.mesh`.
///
/// # Errors
/// If the file cannot be read or is malformed; and if it then looks like a file of another format, the error says so.
pub fn read_plc(path: &Path) -> Result<(Plc, Vec<Note>), FormatError> {
    let given = path.extension().unwrap_or_default().to_string_lossy();
    let extension = match &given.to_ascii_lowercase()[..] {
        // Binary, which the reader refuses.
        "meshb" => "mesh".to_owned(),
        other => other.to_owned(),
    };
    let bytes = bytes_of(path)?;
    sniff::refuse_packed(&bytes)?;
    // The vertices of a .poly or .smesh file may be in a .node file beside it.
    let nodes = || {
        let bytes = bytes_of(&node_path(path))?;
        sniff::refuse_packed(&bytes)?;
        Ok(bytes)
    };
    let result = match &extension[..] {
        "poly" => read_poly(&bytes, nodes),
        "smesh" => read_smesh(&bytes, nodes),
        "node" => read_node(&bytes),
        "off" => read_off(&bytes),
        "stl" => read_stl(&bytes),
        "ply" => read_ply(&bytes),
        "obj" => read_obj(&bytes),
        "mesh" => read_medit(&bytes),
        _ => Err(FormatError::UnknownExtension(given.into_owned())),
    };
    result.map_err(|error| match sniff::looks_like(&bytes) {
        Some((other, found)) if other != Some(&extension[..]) => FormatError::LooksLike {
            error: Box::new(error),
            found,
        },
        _ => error,
    })
}

/// The file that holds the vertices of a `.poly` or `.smesh` file whose own list of vertices is empty.
#[doc(hidden)]
pub fn node_path(path: &Path) -> PathBuf {
    sibling(path, "node")
}

/// The file of the same stem with another extension: in capitals if that of `path` is.
fn sibling(path: &Path, extension: &str) -> PathBuf {
    let given = path.extension().unwrap_or_default().to_string_lossy();
    if given.chars().any(char::is_uppercase) && !given.chars().any(char::is_lowercase) {
        path.with_extension(extension.to_ascii_uppercase())
    } else {
        path.with_extension(extension)
    }
}

fn bytes_of(path: &Path) -> Result<Vec<u8>, FormatError> {
    std::fs::read(path).map_err(|source| FormatError::Io {
        path: path.to_owned(),
        source,
    })
}
