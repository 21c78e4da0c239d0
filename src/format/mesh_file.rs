//! Meshes to files and back, by the extension of the path.
//!
//! Invariant: a file that bears its final name is complete. Every file is written beside its place under a temporary
//! name; only when all of them are, they are renamed. (The renaming of four files is not one step: if the second
//! rename fails, the first stands. What is likely to make it fail, a directory of that name, is looked for before.)
//!
//! Extensions may be written in capitals, and then the other files' are as well: `M.ELE` stands beside `M.NODE`.

use super::staged::{Staged, stage};
use super::{MeshFileError, UnwritableMesh, medit_mesh, sibling, tetgen_mesh, tetgen_writer, vtu};
use crate::exchange::ExportedMesh;
use crate::mesh::VertexId;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// Writes a mesh and returns the paths written.
///
/// `NAME.node`, `NAME.ele`, `NAME.face` or `NAME.edge`, whichever is given, writes all four, for TetGen and its
/// friends; every double is read back bit by bit as it was. Beside them stand, where there is something to say,
/// `NAME.facets` (what the faces lie on and between), `NAME.steiner` (where vertices are exactly, if that is not
/// where their coordinates are) and `NAME.map` (old and new numbers of vertices); otherwise files of these names are
/// removed, since they would be about another mesh. `NAME.vtu` writes one file for ParaView, which [`read_mesh`] does
/// not read.
///
/// # Errors
/// If the extension is another, if the mesh names vertices that it does not have or holds numbers that are not
/// finite, or if a file cannot be written. Nothing is written in the first two cases, and no file is left half written
/// in the third.
pub fn write_mesh(path: &Path, mesh: &ExportedMesh) -> Result<Vec<PathBuf>, MeshFileError> {
    let format = Format::to_write(path)?;
    check(mesh)?;
    let mut staged = Vec::new();
    let mut absent = Vec::new();
    match format {
        Format::Vtu => staged.push(stage(path.to_path_buf(), |out| vtu::write(out, mesh))?),
        Format::TetGen => {
            for (extension, write, is_there) in TETGEN {
                let path = sibling(path, extension);
                if is_there(mesh) {
                    staged.push(stage(path, |out| write(out, mesh))?);
                } else {
                    absent.push(path);
                }
            }
        }
    }
    staged.iter().try_for_each(Staged::check_place)?;
    for path in absent {
        if let Err(source) = std::fs::remove_file(&path)
            && source.kind() != io::ErrorKind::NotFound
        {
            return Err(MeshFileError::Io { path, source });
        }
    }
    staged.into_iter().map(Staged::publish).collect()
}

/// Writes a mesh in a format that is one file to wherever it shall go; `format` is the extension of such files, "vtu".
///
/// # Errors
/// If the format is another, if the mesh is not one that a file can hold (then nothing has been written), or if `out`
/// refuses.
pub fn write_mesh_to(
    out: &mut dyn Write,
    format: &str,
    mesh: &ExportedMesh,
) -> Result<(), MeshFileError> {
    if !matches!(Format::of_extension(format), Some(Format::Vtu)) {
        return Err(MeshFileError::SingleFile {
            format: format.to_owned(),
        });
    }
    check(mesh)?;
    let mut out = BufWriter::new(out);
    let written = vtu::write(&mut out, mesh).and_then(|()| out.flush());
    written.map_err(|source| MeshFileError::Io {
        path: PathBuf::from("-"),
        source,
    })
}

type IsThere = fn(&ExportedMesh) -> bool;
type Writer = fn(&mut dyn Write, &ExportedMesh) -> io::Result<()>;

/// The files of a mesh in TetGen's format, and ours beside them: extension, writer, and whether a mesh has such a file.
const TETGEN: [(&str, Writer, IsThere); 7] = [
    ("node", tetgen_writer::write_node, |_| true),
    ("ele", tetgen_writer::write_ele, |_| true),
    ("face", tetgen_writer::write_face, |_| true),
    ("edge", tetgen_writer::write_edge, |_| true),
    ("facets", tetgen_writer::write_facets, |mesh| {
        !mesh.face_table.sides.is_empty()
    }),
    ("steiner", tetgen_writer::write_steiner, |mesh| {
        !mesh.exact.is_empty()
    }),
    ("map", tetgen_writer::write_map, |mesh| {
        !mesh.renumbered.is_empty()
    }),
];

/// The files that [`write_mesh`] writes for `path`.
///
/// # Errors
/// If the extension names no format that can be written.
pub fn mesh_paths(path: &Path) -> Result<Vec<PathBuf>, MeshFileError> {
    Ok(match Format::to_write(path)? {
        Format::TetGen => TETGEN
            .iter()
            .map(|(extension, ..)| sibling(path, extension))
            .collect(),
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
    let first = u64::from(mesh.first_index);
    if first + mesh.vertices.len() as u64 > u64::from(u32::MAX) {
        return Err(UnwritableMesh::FirstIndex(mesh.first_index));
    }
    if !mesh.regions.is_empty() && mesh.regions.len() != mesh.tets.len() {
        return Err(UnwritableMesh::RegionCount {
            regions: mesh.regions.len(),
            tets: mesh.tets.len(),
        });
    }
    check_rows(mesh)?;
    let columns = mesh.attributes.per_vertex.max(1);
    let polygons = &mesh.face_table.facets;
    let on_polygon = |&polygon: &u32| {
        let facets = polygon.checked_sub(1).map(|f| polygons.get(f as usize));
        facets.is_none_or(|facets| facets.is_some_and(|facets| !facets.is_empty()))
    };
    let bad = [
        first_bad(&mesh.attributes.values, |x| x.is_finite())
            .map(|i| UnwritableMesh::Attribute(i / columns)),
        first_bad(&mesh.face_table.polygons, on_polygon).map(UnwritableMesh::FacePolygon),
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

/// Tables have as many rows as what they are about, or none.
fn check_rows(mesh: &ExportedMesh) -> Result<(), UnwritableMesh> {
    let (vertices, faces, tets) = (mesh.vertices.len(), mesh.faces.len(), mesh.tets.len());
    let numbers = mesh.attributes.per_vertex.saturating_mul(vertices);
    let values = mesh.attributes.values.len();
    let table = &mesh.face_table;
    let known = !table.sides.is_empty();
    let if_any = |rows: usize, expected: usize| if rows == 0 { 0 } else { expected };
    for (what, rows, expected) in [
        ("attributes of vertices", values, numbers),
        (
            "markers of vertices",
            mesh.vertex_markers.len(),
            if_any(mesh.vertex_markers.len(), vertices),
        ),
        (
            "rows in the table of faces",
            table.sides.len(),
            if_any(table.sides.len(), faces),
        ),
        (
            "polygons in the table of faces",
            table.polygons.len(),
            table.sides.len(),
        ),
        (
            "numbers of regions",
            mesh.region_numbers.len(),
            match known {
                true => tets,
                false => if_any(mesh.region_numbers.len(), tets),
            },
        ),
    ] {
        if rows != expected {
            return Err(UnwritableMesh::RowCount {
                what,
                rows,
                expected,
            });
        }
    }
    Ok(())
}
