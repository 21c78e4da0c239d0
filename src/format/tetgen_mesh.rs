//! TetGen's mesh files, read: `.node`, `.ele`, `.face`, `.edge`. ([`super::tetgen_writer`] writes them.)
//!
//! Each file is a header, then one numbered line per element; `#` begins a comment, blank lines are skipped.
//!
//! | file | header | line |
//! |---|---|---|
//! | `.node` | count, 3, number of attributes, whether marked | number, x, y, z, attributes, mark |
//! | `.ele` | count, 4, number of attributes | number, four vertices, attributes |
//! | `.face` | count, whether marked | number, three vertices, mark |
//! | `.edge` | count, whether marked | number, two vertices, mark |
//! | `.steiner` | count | vertex, a, b, t, perhaps rest: the vertex is exactly at a + (t + rest)(b−a); our own, only if
//! there are such vertices |
//!
//! Source: Si, *TetGen, a Delaunay-Based Quality Tetrahedral Mesh Generator*, ACM TOMS 41(2), 2015, and the files that
//! TetGen 1.5.0 writes. The orientation of tetrahedra in its `.ele` files is ours, det[b−a, c−a, d−a] > 0, so
//! that vertices keep their order. Time and memory are linear in the size of the files, whatever a header says.

use super::ahead::{Rows, read_ahead};
use super::numerals::whole;
use super::text::{Syntax, Text};
use super::vertices::Vertices;
use super::{MeshFileError, MeshLineError, sibling};
use crate::exchange::{ExactPosition, ExportedEdge, ExportedFace, ExportedMesh};
use crate::mesh::VertexId;
use crate::number::Parameter;
use std::io;
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// Bytes of a file that is worth another thread.
const LARGE: u64 = 1 << 20;

/// Reads the files of the stem of `path`; `.face`, `.edge` and `.steiner` may be missing.
pub(super) fn read(path: &Path) -> Result<ExportedMesh, MeshFileError> {
    let nodes = || read_node(&Source::open(sibling(path, "node"))?);
    let ele = || Source::open(sibling(path, "ele"));
    let size = std::fs::metadata(sibling(path, "ele")).map_or(0, |file| file.len());
    // While one large file is read line by line, the next one comes into memory.
    let (nodes, ele) = match size < LARGE {
        true => (nodes(), ele()),
        false => rayon::join(nodes, ele),
    };
    let (first_index, vertices) = nodes?;
    let numbering = Numbering {
        first: first_index,
        count: vertices.len(),
    };
    let Tets { tets, regions } = read_ele(&ele?, numbering)?;
    let faces = match Source::open_if_exists(sibling(path, "face"))? {
        Some(source) => read_marked(&source, |line, marker| {
            let vertices = numbering.vertices(line)?;
            let marker = marker.read(line)?;
            Ok(ExportedFace { vertices, marker })
        })?,
        None => Vec::new(),
    };
    let edges = match Source::open_if_exists(sibling(path, "edge"))? {
        Some(source) => read_marked(&source, |line, marker| {
            let vertices = numbering.vertices(line)?;
            let marker = marker.read(line)?;
            Ok(ExportedEdge { vertices, marker })
        })?,
        None => Vec::new(),
    };
    let exact = match Source::open_if_exists(sibling(path, "steiner"))? {
        Some(source) => read_steiner(&source, numbering)?,
        None => Vec::new(),
    };
    Ok(ExportedMesh {
        first_index,
        vertices,
        exact,
        tets,
        regions,
        faces,
        edges,
        ..ExportedMesh::default()
    })
}

/// The first index (0 for a file without vertices) and the coordinates.
fn read_node(source: &Source) -> Result<(u32, Vec<[f64; 3]>), MeshFileError> {
    let header = |line: &mut Line| {
        let count = line.number("the number of vertices")?;
        if u32::try_from(count).is_err() {
            return Err(MeshLineError::TooManyVertices(count));
        }
        match line.number_or("the dimension", 3)? {
            3 => Ok((count, ())),
            dimension => Err(MeshLineError::Dimension(dimension)),
        }
    };
    let vertices: Vertices = source.table(header, |line, (), vertices: &mut Vertices| {
        let found = line.integer("the vertex number")?;
        if !vertices.may_have(found) {
            let expected = vertices.expected().unwrap_or(1);
            return Err(MeshLineError::VertexNumber { found, expected });
        }
        let point = [line.finite("x")?, line.finite("y")?, line.finite("z")?];
        vertices.push(found, point);
        Ok(())
    })?;
    // Only numbers that follow one another were let in.
    let first = vertices.first_index().ok_or_else(|| MeshFileError::Line {
        path: source.path.clone(),
        line: 1,
        reason: MeshLineError::TooManyVertices(vertices.points.len()),
    })?;
    Ok((first, vertices.points))
}

/// Tetrahedra and their last attributes, if they have any.
#[derive(Default)]
struct Tets {
    tets: Vec<[VertexId; 4]>,
    regions: Vec<f64>,
}

impl Rows for Tets {
    fn piece(&self) -> Tets {
        Tets::default()
    }

    fn len(&self) -> u64 {
        self.tets.len() as u64
    }

    fn append(&mut self, next: Tets) -> bool {
        self.tets.extend(next.tets);
        self.regions.extend(next.regions);
        true
    }
}

fn read_ele(source: &Source, numbering: Numbering) -> Result<Tets, MeshFileError> {
    let header = |line: &mut Line| {
        let count = line.number("the number of tetrahedra")?;
        match line.number_or("the number of nodes per tetrahedron", 4)? {
            4 => Ok((count, line.number_or("the number of attributes", 0usize)?)),
            nodes => Err(MeshLineError::NodesPerTet(nodes)),
        }
    };
    source.table(header, |line, &attributes, rows: &mut Tets| {
        line.integer("the tetrahedron number")?;
        let tet = numbering.vertices(line)?;
        let mut region = None;
        for _ in 0..attributes {
            region = Some(line.finite("an attribute")?);
        }
        rows.tets.push(tet);
        rows.regions.extend(region);
        Ok(())
    })
}

fn read_steiner(
    source: &Source,
    numbering: Numbering,
) -> Result<Vec<ExactPosition>, MeshFileError> {
    let header = |line: &mut Line| Ok((line.number("the number of exact positions")?, ()));
    source.table(header, |line, (), positions: &mut Vec<_>| {
        let [vertex, a, b] = numbering.vertices(line)?;
        let value = line.finite("t")?;
        let rest = match line.number_or("the rest of t", 0.0)? {
            rest if f64::is_finite(rest) => rest,
            rest => {
                let what = "the rest of t";
                let found = rest.to_string();
                return Err(MeshLineError::NotFinite { what, found });
            }
        };
        let t = Parameter { value, rest };
        positions.push(ExactPosition {
            vertex,
            ends: [a, b],
            t,
        });
        Ok(())
    })
}

/// A `.face` or `.edge` file, with the columns after the mark ignored.
fn read_marked<T: Send>(
    source: &Source,
    read: impl Fn(&mut Line, Marker) -> Result<T, MeshLineError> + Sync,
) -> Result<Vec<T>, MeshFileError> {
    let header = |line: &mut Line| {
        let count = line.number("the number of elements")?;
        let marked: i64 = line.number_or("the flag of markers", 0)?;
        Ok((count, Marker { given: marked != 0 }))
    };
    source.table(header, |line, &marker, elements: &mut Vec<_>| {
        line.integer("the element number")?;
        elements.push(read(line, marker)?);
        Ok(())
    })
}

/// Whether the lines of a file end in a marker.
#[derive(Clone, Copy)]
struct Marker {
    given: bool,
}

impl Marker {
    fn read(self, line: &mut Line) -> Result<i64, MeshLineError> {
        if self.given {
            line.integer("the marker")
        } else {
            Ok(0)
        }
    }
}

/// How the vertices are numbered: first, first + 1, …, first + count − 1.
#[derive(Clone, Copy)]
struct Numbering {
    first: u32,
    count: usize,
}

impl Numbering {
    fn vertices<const N: usize>(self, line: &mut Line) -> Result<[VertexId; N], MeshLineError> {
        let mut vertices = [VertexId(0); N];
        for v in &mut vertices {
            let found = line.integer("a vertex")?;
            let id = found
                .checked_sub(i64::from(self.first))
                .and_then(|i| u32::try_from(i).ok());
            let id = id.map(VertexId).filter(|id| id.index() < self.count);
            *v = id.ok_or(MeshLineError::NoSuchVertex {
                found,
                first: self.first,
                count: self.count,
            })?;
        }
        Ok(vertices)
    }
}

/// A file in memory.
struct Source {
    path: PathBuf,
    bytes: Vec<u8>,
}

impl Source {
    fn open(path: PathBuf) -> Result<Source, MeshFileError> {
        match std::fs::read(&path) {
            Ok(bytes) => Ok(Source { path, bytes }),
            Err(source) => Err(MeshFileError::Io { path, source }),
        }
    }

    fn open_if_exists(path: PathBuf) -> Result<Option<Source>, MeshFileError> {
        match Source::open(path) {
            Err(MeshFileError::Io { source, .. }) if source.kind() == io::ErrorKind::NotFound => {
                Ok(None)
            }
            result => result.map(Some),
        }
    }

    /// Reads the header, which returns the count of the lines to follow, and then each of them.
    fn table<H: Sync, R: Rows + Default>(
        &self,
        header: impl FnOnce(&mut Line) -> Result<(usize, H), MeshLineError>,
        row: impl Fn(&mut Line, &H, &mut R) -> Result<(), MeshLineError> + Sync,
    ) -> Result<R, MeshFileError> {
        let at = |line, reason| MeshFileError::Line {
            path: self.path.clone(),
            line,
            reason,
        };
        let mut text = Text::new(&self.bytes, Syntax::Hash);
        if !text.advance() {
            return Err(at(1, MeshLineError::NoHeader));
        }
        let first = text.number_of_line();
        let (promised, header) =
            header(&mut Line::of(&mut text)).map_err(|reason| at(first, reason))?;
        // No room for `promised` rows is made: a header may promise anything.
        let mut rows = R::default();
        let read = |text: &mut Text, rows: &mut R| row(&mut Line::of(text), &header, rows);
        let mut last = read_ahead(&mut text, promised as u64, &mut rows, read).max(first);
        while text.advance() {
            last = text.number_of_line();
            if rows.len() == promised as u64 {
                return Err(at(last, MeshLineError::TooManyLines { promised }));
            }
            read(&mut text, &mut rows).map_err(|reason| at(last, reason))?;
        }
        match rows.len() as usize {
            found if found < promised => {
                Err(at(last, MeshLineError::TooFewLines { promised, found }))
            }
            _ => Ok(rows),
        }
    }
}

/// What is left of a line: fields between blanks, each of which a comma may end, as TetGen allows. A comma within a
/// field is more likely a decimal one, and no number.
struct Line<'a> {
    rest: &'a [u8],
}

impl<'a> Line<'a> {
    /// The rest of the current line.
    fn of(text: &mut Text<'a>) -> Line<'a> {
        let rest = text.line();
        text.skip_line();
        Line { rest }
    }

    fn next(&mut self) -> Option<&'a [u8]> {
        let blank = |b: &u8| b.is_ascii_whitespace();
        let start = self.rest.iter().position(|b| !blank(b) && *b != b',')?;
        let rest = &self.rest[start..];
        let end = rest.iter().position(blank).unwrap_or(rest.len());
        let (field, rest) = rest.split_at(end);
        self.rest = rest;
        let field = field.strip_suffix(b",").unwrap_or(field);
        Some(field)
    }

    fn number<T: FromStr>(&mut self, what: &'static str) -> Result<T, MeshLineError> {
        let field = self.next().ok_or(MeshLineError::Missing(what))?;
        parse(field, what)
    }

    fn integer(&mut self, what: &'static str) -> Result<i64, MeshLineError> {
        let field = self.next().ok_or(MeshLineError::Missing(what))?;
        whole(field).map_or_else(|| parse(field, what), Ok)
    }

    /// A field at the end of a header that may be left out.
    fn number_or<T: FromStr>(
        &mut self,
        what: &'static str,
        default: T,
    ) -> Result<T, MeshLineError> {
        self.next().map_or(Ok(default), |field| parse(field, what))
    }

    fn finite(&mut self, what: &'static str) -> Result<f64, MeshLineError> {
        let field = self.next().ok_or(MeshLineError::Missing(what))?;
        let x: f64 = parse(field, what)?;
        if x.is_finite() {
            Ok(x)
        } else {
            let found = shown(field);
            Err(MeshLineError::NotFinite { what, found })
        }
    }
}

fn parse<T: FromStr>(field: &[u8], what: &'static str) -> Result<T, MeshLineError> {
    let number = std::str::from_utf8(field)
        .ok()
        .and_then(|text| text.parse().ok());
    number.ok_or_else(|| {
        let found = shown(field);
        MeshLineError::BadNumber { what, found }
    })
}

/// A field for a message, cut where it gets long.
fn shown(field: &[u8]) -> String {
    let text = String::from_utf8_lossy(field);
    text.chars()
        .take(40)
        .flat_map(char::escape_default)
        .collect()
}

/// What is in one file with an extension, of a mesh with 60 vertices that count from 1.
#[cfg(test)]
pub(super) fn read_table(extension: &str, bytes: &[u8]) -> Result<String, String> {
    let source = Source {
        path: PathBuf::from(extension),
        bytes: bytes.to_vec(),
    };
    let numbering = Numbering {
        first: 1,
        count: 60,
    };
    let result = match extension {
        "node" => read_node(&source).map(|found| format!("{found:?}")),
        "ele" => read_ele(&source, numbering)
            .map(|found| format!("{:?} {:?}", found.tets, found.regions)),
        _ => read_marked(&source, |line, marker| {
            Ok((numbering.vertices::<3>(line)?, marker.read(line)?))
        })
        .map(|found| format!("{found:?}")),
    };
    result.map_err(|error| error.to_string())
}
