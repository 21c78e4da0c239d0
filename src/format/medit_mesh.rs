//! Tetrahedral meshes in Medit's ASCII files, `.mesh` (Frey, *MEDIT: An interactive mesh visualization software*, INRIA
//! RT-0253, 2001), as other programs write them.
//!
//! Read are `Vertices`, `Tetrahedra`, `Triangles` and `Edges` with their references, which are the markers of faces and
//! edges and the attributes of regions. Other sections are skipped up to the next word that is no number. What the file
//! says is not judged. Vertices count from 1. Time and memory are linear in the size of the file, whatever it
//! announces.

use super::MeshLineError;
use super::text::{Syntax, Text};
use crate::exchange::{ExportedEdge, ExportedFace, ExportedMesh};
use crate::mesh::VertexId;
use std::str::FromStr;

/// The line of a mistake, from 1, and what is wrong there.
pub(super) type Mistake = (usize, MeshLineError);

/// Reads a mesh.
pub(super) fn read(bytes: &[u8]) -> Result<ExportedMesh, Mistake> {
    let mut reader = Reader {
        text: Text::new(bytes, Syntax::Hash),
        mesh: ExportedMesh {
            first_index: 1,
            ..ExportedMesh::default()
        },
        corners: Vec::new(),
    };
    let mut name = reader.word();
    while let Some(section) = name {
        name = reader.section(section)?;
    }
    reader.finish()
}

/// Elements whose vertices may come after them.
struct Corner {
    line: usize,
    number: i64,
}

struct Reader<'a> {
    text: Text<'a>,
    mesh: ExportedMesh,
    /// All corners of tetrahedra, faces and edges, to be compared with the number of vertices in the end.
    corners: Vec<Corner>,
}

impl<'a> Reader<'a> {
    /// The next word of the file.
    fn word(&mut self) -> Option<&'a [u8]> {
        loop {
            match self.text.token() {
                Some(word) => return Some(word),
                None if self.text.advance() => {}
                None => return None,
            }
        }
    }

    fn here<T>(&self, reason: MeshLineError) -> Result<T, Mistake> {
        Err((self.text.number_of_line(), reason))
    }

    fn number<T: FromStr>(&mut self, what: &'static str) -> Result<T, Mistake> {
        let Some(word) = self.word() else {
            return self.here(MeshLineError::Missing(what));
        };
        let text = String::from_utf8_lossy(word);
        match text.parse() {
            Ok(number) => Ok(number),
            Err(_) => self.here(MeshLineError::BadNumber {
                what,
                found: text.into_owned(),
            }),
        }
    }

    /// Reads or skips a section; the name of the next one.
    fn section(&mut self, name: &[u8]) -> Result<Option<&'a [u8]>, Mistake> {
        match &name.to_ascii_lowercase()[..] {
            b"end" => return Ok(None),
            b"meshversionformatted" => {
                self.number::<i64>("the version")?;
            }
            b"dimension" => {
                let dimension = self.number::<usize>("the dimension")?;
                if dimension != 3 {
                    return self.here(MeshLineError::Dimension(dimension));
                }
            }
            b"vertices" => {
                for _ in 0..self.number::<usize>("the number of vertices")? {
                    let mut at = [0.0f64; 3];
                    for x in &mut at {
                        *x = self.number("a coordinate")?;
                        if !x.is_finite() {
                            return self.here(MeshLineError::NotFinite {
                                what: "a coordinate",
                                found: x.to_string(),
                            });
                        }
                    }
                    self.number::<f64>("the reference of a vertex")?;
                    self.mesh.vertices.push(at);
                }
                let count = self.mesh.vertices.len();
                if count >= VertexId::INFINITE.index() {
                    return self.here(MeshLineError::TooManyVertices(count));
                }
            }
            b"tetrahedra" => {
                for _ in 0..self.number::<usize>("the number of tetrahedra")? {
                    let tet = self.corners()?;
                    let region = self.number("the reference of a tetrahedron")?;
                    self.mesh.tets.push(tet);
                    self.mesh.regions.push(region);
                }
            }
            b"triangles" => {
                for _ in 0..self.number::<usize>("the number of triangles")? {
                    let vertices = self.corners()?;
                    let marker = self.number("the reference of a triangle")?;
                    self.mesh.faces.push(ExportedFace { vertices, marker });
                }
            }
            b"edges" => {
                for _ in 0..self.number::<usize>("the number of edges")? {
                    let vertices = self.corners()?;
                    let marker = self.number("the reference of an edge")?;
                    self.mesh.edges.push(ExportedEdge { vertices, marker });
                }
            }
            _ => return Ok(self.skip()),
        }
        Ok(self.word())
    }

    /// Drops numbers up to the next word that is none.
    fn skip(&mut self) -> Option<&'a [u8]> {
        loop {
            let word = self.word()?;
            if word[0].is_ascii_alphabetic() {
                return Some(word);
            }
        }
    }

    /// The corners of an element, from 0; what is out of range is found in the end.
    fn corners<const N: usize>(&mut self) -> Result<[VertexId; N], Mistake> {
        let mut corners = [VertexId(0); N];
        for corner in &mut corners {
            let number: i64 = self.number("a vertex")?;
            // A number that no vertex can have stays one.
            *corner = VertexId(u32::try_from(number.saturating_sub(1)).unwrap_or(u32::MAX));
            let line = self.text.number_of_line();
            self.corners.push(Corner { line, number });
        }
        Ok(corners)
    }

    fn finish(self) -> Result<ExportedMesh, Mistake> {
        let count = self.mesh.vertices.len();
        let exists = |n: i64| usize::try_from(n).is_ok_and(|n| (1..=count).contains(&n));
        match self.corners.iter().find(|c| !exists(c.number)) {
            Some(corner) => Err((
                corner.line,
                MeshLineError::NoSuchVertex {
                    found: corner.number,
                    first: 1,
                    count,
                },
            )),
            None => Ok(self.mesh),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ONE: &str = "MeshVersionFormatted 2\nDimension\n3\nCorners 1\n1\n# four\nVertices 4\n0 0 0 0 1 0 0 0\n\
                       0 1 0 7\n0 0 1 0\nTetrahedra\n1\n1 2 3 4 5\nTriangles 1\n1 2 3 -9\nEdges 1\n1 2 4\nEnd\nmore";

    #[test]
    fn sections_are_read_and_others_skipped() {
        let mesh = read(ONE.as_bytes()).expect("a mesh");
        assert_eq!((mesh.vertices.len(), mesh.tets.len()), (4, 1));
        assert_eq!(mesh.vertices[2], [0.0, 1.0, 0.0]);
        assert_eq!(mesh.tets[0], [0, 1, 2, 3].map(VertexId));
        assert_eq!(mesh.regions, [5.0]);
        assert_eq!((mesh.faces[0].marker, mesh.edges[0].marker), (-9, 4));
    }

    #[test]
    fn mistakes_have_a_line() {
        let with =
            |from: &str, to: &str| read(ONE.replace(from, to).as_bytes()).expect_err("a mistake");
        let (line, reason) = with("1 2 3 4 5", "1 2 3 5 5");
        assert_eq!(line, 13);
        assert!(matches!(
            reason,
            MeshLineError::NoSuchVertex { found: 5, .. }
        ));
        assert!(matches!(
            with("1 2 3 4 5", "0 2 3 4 5").1,
            MeshLineError::NoSuchVertex { found: 0, .. }
        ));
        assert!(matches!(
            with("0 1 0 7", "0 x 0 7").1,
            MeshLineError::BadNumber { .. }
        ));
        assert!(matches!(
            with("0 1 0 7", "0 inf 0 7").1,
            MeshLineError::NotFinite { .. }
        ));
        assert!(matches!(
            with("\n3\n", "\n2\n").1,
            MeshLineError::Dimension(2)
        ));
        assert!(matches!(
            with("\n1 2 4\nEnd\nmore", "\n1 2").1,
            MeshLineError::Missing(_)
        ));
    }
}
