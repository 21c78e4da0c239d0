//! Meshes to files and back, by the extension of the path.
//!
//! Invariant: a file that bears its final name is complete. Every file is written beside its place under a temporary
//! name; only when all of them are, they are renamed. (The renaming of four files is not one step: if the second
//! rename fails, the first stands. What is likely to make it fail, a directory of that name, is looked for before.)
//!
//! Extensions may be written in capitals, and then the other files' are as well: `M.ELE` stands beside `M.NODE`.

use super::{MeshFileError, UnwritableMesh, medit_mesh, sibling, tetgen_mesh, vtu};
use crate::exchange::ExportedMesh;
use crate::mesh::VertexId;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// Writes a mesh and returns the paths written.
///
/// `NAME.node`, `NAME.ele`, `NAME.face` or `NAME.edge`, whichever is given, writes all four, for TetGen and its
/// friends; every double is read back bit by bit as it was. If some vertices are exactly elsewhere, `NAME.steiner`
/// says where; otherwise a file of that name is removed, since it would be about another mesh. `NAME.vtu` writes one
/// file for ParaView, which [`read_mesh`] does not read.
///
/// # Errors
/// If the extension is another, if the mesh names vertices that it does not have or holds numbers that are not
/// finite, or if a file cannot be written. Nothing is written in the first two cases, and no file is left half written
/// in the third.
pub fn write_mesh(path: &Path, mesh: &ExportedMesh) -> Result<Vec<PathBuf>, MeshFileError> {
    let format = Format::to_write(path)?;
    check(mesh)?;
    let mut staged: Vec<Staged> = match format {
        Format::TetGen => [
            stage(sibling(path, "node"), |out| {
                tetgen_mesh::write_node(out, mesh)
            })?,
            stage(sibling(path, "ele"), |out| {
                tetgen_mesh::write_ele(out, mesh)
            })?,
            stage(sibling(path, "face"), |out| {
                tetgen_mesh::write_face(out, mesh)
            })?,
            stage(sibling(path, "edge"), |out| {
                tetgen_mesh::write_edge(out, mesh)
            })?,
        ]
        .into(),
        Format::Vtu => vec![stage(path.to_path_buf(), |out| vtu::write(out, mesh))?],
    };
    let exact = sibling(path, "steiner");
    let has_exact = matches!(format, Format::TetGen) && !mesh.exact.is_empty();
    if has_exact {
        staged.push(stage(exact.clone(), |out| {
            tetgen_mesh::write_steiner(out, mesh)
        })?);
    }
    staged.iter().try_for_each(Staged::check_place)?;
    if matches!(format, Format::TetGen)
        && !has_exact
        && let Err(source) = std::fs::remove_file(&exact)
        && source.kind() != io::ErrorKind::NotFound
    {
        return Err(MeshFileError::Io {
            path: exact,
            source,
        });
    }
    staged.into_iter().map(Staged::publish).collect()
}

/// Writes a file of any kind, which is complete or, if that fails, not there (or as it was). What is no file but a
/// pipe or a terminal is written to as it stands.
///
/// # Errors
/// If it cannot be written.
pub fn write_complete(path: &Path, bytes: &[u8]) -> Result<(), MeshFileError> {
    if path.metadata().is_ok_and(|place| !place.is_file()) {
        return std::fs::write(path, bytes).map_err(|source| MeshFileError::Io {
            path: path.to_path_buf(),
            source,
        });
    }
    let staged = stage(path.to_path_buf(), |out| out.write_all(bytes))?;
    staged.publish().map(|_| ())
}

/// The files that [`write_mesh`] writes for `path`.
///
/// # Errors
/// If the extension names no format that can be written.
pub fn mesh_paths(path: &Path) -> Result<Vec<PathBuf>, MeshFileError> {
    Ok(match Format::to_write(path)? {
        Format::TetGen => ["node", "ele", "face", "edge", "steiner"]
            .map(|extension| sibling(path, extension))
            .into(),
        Format::Vtu => vec![path.to_path_buf()],
    })
}

/// Reads `NAME.node` and `NAME.ele`, and `NAME.face`, `NAME.edge` and `NAME.steiner` if they exist; `path` is any of
/// the first four. Or reads `NAME.mesh`, one ASCII file of Medit.
///
/// Files of TetGen are read as well as ours: comments, marks and attributes of vertices and the extra columns of `-nn`
/// are skipped; of several attributes of a tetrahedron the last is the region's, where TetGen puts it. What the
/// files say is not judged: orientation, repeated vertices and all geometry are for a verifier.
///
/// # Errors
/// If a file cannot be read, or a line of it is wrong; the error names file and line.
pub fn read_mesh(path: &Path) -> Result<ExportedMesh, MeshFileError> {
    let extension = path.extension().and_then(|e| e.to_str());
    match extension.and_then(Format::of_extension) {
        Some(Format::TetGen) => tetgen_mesh::read(path),
        None if extension.is_some_and(|e| e.eq_ignore_ascii_case("mesh")) => {
            let bytes = std::fs::read(path).map_err(|source| MeshFileError::Io {
                path: path.to_path_buf(),
                source,
            })?;
            medit_mesh::read(&bytes).map_err(|(line, reason)| MeshFileError::Line {
                path: path.to_path_buf(),
                line,
                reason,
            })
        }
        Some(Format::Vtu) | None => Err(MeshFileError::ReadExtension {
            path: path.to_path_buf(),
        }),
    }
}

enum Format {
    TetGen,
    Vtu,
}

impl Format {
    fn to_write(path: &Path) -> Result<Format, MeshFileError> {
        let extension = path.extension().and_then(|e| e.to_str());
        extension
            .and_then(Format::of_extension)
            .ok_or_else(|| MeshFileError::WriteExtension {
                path: path.to_path_buf(),
            })
    }

    fn of_extension(extension: &str) -> Option<Format> {
        match &extension.to_ascii_lowercase()[..] {
            "node" | "ele" | "face" | "edge" => Some(Format::TetGen),
            "vtu" => Some(Format::Vtu),
            _ => None,
        }
    }
}

/// A double in the fewest digits that are read back as the same double.
pub(super) struct Shortest(pub f64);

impl std::fmt::Display for Shortest {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let size = self.0.abs();
        if size == 0.0 || (1e-4..1e15).contains(&size) {
            write!(f, "{}", self.0)
        } else {
            write!(f, "{:e}", self.0)
        }
    }
}

/// Everything that a writer takes for granted.
fn check(mesh: &ExportedMesh) -> Result<(), UnwritableMesh> {
    fn first_bad<T>(items: &[T], good: impl Fn(&T) -> bool) -> Option<usize> {
        items.iter().position(|item| !good(item))
    }
    let exists = |v: &VertexId| v.index() < mesh.vertices.len();
    if mesh.first_index > 1 {
        return Err(UnwritableMesh::FirstIndex(mesh.first_index));
    }
    if !mesh.regions.is_empty() && mesh.regions.len() != mesh.tets.len() {
        return Err(UnwritableMesh::RegionCount {
            regions: mesh.regions.len(),
            tets: mesh.tets.len(),
        });
    }
    let bad = [
        first_bad(&mesh.vertices, |p| p.iter().all(|x| x.is_finite())).map(UnwritableMesh::Vertex),
        first_bad(&mesh.regions, |x| x.is_finite()).map(UnwritableMesh::Region),
        first_bad(&mesh.tets, |t| t.iter().all(exists)).map(UnwritableMesh::Tet),
        first_bad(&mesh.faces, |f| f.vertices.iter().all(exists)).map(UnwritableMesh::Face),
        first_bad(&mesh.edges, |e| e.vertices.iter().all(exists)).map(UnwritableMesh::Edge),
        first_bad(&mesh.exact, |p| {
            exists(&p.vertex)
                && p.ends.iter().all(exists)
                && p.t.value.is_finite()
                && p.t.rest.is_finite()
        })
        .map(UnwritableMesh::ExactPosition),
    ];
    bad.into_iter().flatten().next().map_or(Ok(()), Err)
}

/// A file that is complete but still has a temporary name. Dropped, it is gone.
pub(super) struct Staged {
    file: NamedTempFile,
    path: PathBuf,
}

impl Staged {
    /// A directory cannot be replaced.
    fn check_place(&self) -> Result<(), MeshFileError> {
        if self.path.is_dir() {
            return Err(MeshFileError::Io {
                path: self.path.clone(),
                source: io::ErrorKind::IsADirectory.into(),
            });
        }
        Ok(())
    }

    pub fn publish(self) -> Result<PathBuf, MeshFileError> {
        match self.file.persist(&self.path) {
            Ok(_) => Ok(self.path),
            Err(error) => Err(MeshFileError::Io {
                path: self.path,
                source: error.error,
            }),
        }
    }
}

pub(super) fn stage(
    path: PathBuf,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<Staged, MeshFileError> {
    let written = || -> io::Result<NamedTempFile> {
        let file = temporary_beside(&path)?;
        let mut out = BufWriter::new(&file);
        write(&mut out)?;
        out.flush()?;
        drop(out);
        Ok(file)
    };
    match written() {
        Ok(file) => Ok(Staged { file, path }),
        Err(source) => Err(MeshFileError::Io { path, source }),
    }
}

/// A temporary file in the directory of `path`, so that it can be renamed to it, with the permissions of any new file
/// (temporary files are private by default).
fn temporary_beside(path: &Path) -> io::Result<NamedTempFile> {
    let directory = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".tetflip-");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(directory)
}
