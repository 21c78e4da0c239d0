//! Files: meshes out and in.

mod mesh_error;
mod mesh_file;
mod tetgen_mesh;
mod vtu;

pub use mesh_error::{MeshFileError, MeshLineError, UnwritableMesh};
pub use mesh_file::{read_mesh, write_mesh};
