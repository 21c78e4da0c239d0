//! Files: PLCs in, in the formats of TetGen (`.poly`, `.smesh`, `.node`), OFF and STL; meshes out and in.
//!
//! Every reader takes the bytes of a file and gives a [`Plc`] or a [`FormatError`] with a line or an offset. Readers are
//! linear in the file's size whatever its header says, and check the syntax alone; [`crate::plc::Complex::new`] checks
//! the geometry.

mod conflicts_vtu;
mod error;
mod mesh_error;
mod mesh_file;
mod off;
mod poly;
mod poly_file;
mod stl;
mod tetgen_mesh;
mod text;
mod vtu;

pub use conflicts_vtu::write_conflicts;
pub use error::{FormatError, Place, Reason};
pub use mesh_error::{MeshFileError, MeshLineError, UnwritableMesh};
pub use mesh_file::{mesh_paths, read_mesh, write_mesh};
pub use off::read_off;
pub use poly::{read_node, read_poly, read_smesh};
pub use poly_file::write_poly;
pub use stl::read_stl;

use crate::plc::Plc;
use std::path::Path;

/// Reads a file in the format that its extension names: `.poly`, `.smesh`, `.node`, `.off` or `.stl` in either case.
pub fn read_plc(path: &Path) -> Result<Plc, FormatError> {
    let extension = path.extension().unwrap_or_default().to_string_lossy();
    // The vertices of a .poly or .smesh file may be in a .node file beside it.
    let nodes = || bytes_of(&path.with_extension("node"));
    match extension.to_ascii_lowercase().as_str() {
        "poly" => read_poly(&bytes_of(path)?, nodes),
        "smesh" => read_smesh(&bytes_of(path)?, nodes),
        "node" => read_node(&bytes_of(path)?),
        "off" => read_off(&bytes_of(path)?),
        "stl" => read_stl(&bytes_of(path)?),
        _ => Err(FormatError::UnknownExtension(extension.into_owned())),
    }
}

fn bytes_of(path: &Path) -> Result<Vec<u8>, FormatError> {
    std::fs::read(path).map_err(|source| FormatError::Io {
        path: path.to_owned(),
        source,
    })
}
