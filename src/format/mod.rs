//! Files: PLCs in, in the formats of TetGen (`.poly`, `.smesh`, `.node`), OFF, STL, PLY, OBJ and Medit (`.mesh`);
//! meshes out and in.
//!
//! Every reader takes the bytes of a file and gives a [`Plc`](crate::exchange::Plc) with notes on what was forgiven, or
//! a [`FormatError`] with a line or an offset. Readers are linear in the file's size whatever its header says, and
//! check the syntax alone; [`crate::plc::Complex::new`] checks the geometry. What a reader accepts has at least one
//! vertex, finite coordinates, and no corner out of range.

mod ahead;
mod bytes;
mod conflicts_vtu;
mod error;
mod faces;
mod forgiven;
mod labels;
mod lines;
mod medit;
mod medit_mesh;
mod mesh_error;
mod mesh_file;
mod nodes;
mod numerals;
mod obj;
mod off;
mod off_binary;
mod plc_file;
mod ply;
mod ply_body;
mod ply_header;
mod poly;
mod poly_file;
mod sniff;
mod staged;
mod stl;
mod stl_ascii;
mod stl_binary;
mod tetgen_mesh;
mod tetgen_writer;
mod text;
mod vertices;
mod vtu;

pub use conflicts_vtu::write_conflicts;
pub use error::{FilePosition, FormatError, Reason};
pub use medit::read_medit;
pub use mesh_error::{MeshFileError, MeshLineError, UnwritableMesh};
#[doc(hidden)]
pub use mesh_file::mesh_paths;
pub use mesh_file::{read_mesh, write_mesh, write_mesh_to};
pub use obj::read_obj;
pub use off::read_off;
pub use plc_file::{PlcFormat, node_path, read_plc, read_plc_as, read_plc_bytes};
pub use ply::read_ply;
pub use poly::{read_node, read_poly, read_smesh};
pub use poly_file::write_poly;
#[doc(hidden)]
pub use staged::write_complete;
pub use stl::read_stl;

use std::path::{Path, PathBuf};

/// The extensions of what [`read_plc`] reads.
pub const EXTENSIONS: [&str; 8] = ["mesh", "node", "obj", "off", "ply", "poly", "smesh", "stl"];

/// The file of the same stem with another extension: in capitals if that of `path` is.
fn sibling(path: &Path, extension: &str) -> PathBuf {
    let given = path.extension().unwrap_or_default().to_string_lossy();
    if given.chars().any(char::is_uppercase) && !given.chars().any(char::is_lowercase) {
        path.with_extension(extension.to_ascii_uppercase())
    } else {
        path.with_extension(extension)
    }
}
