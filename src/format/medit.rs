//! Medit's ASCII files, `.mesh` (Frey, *MEDIT: An interactive mesh visualization software*, INRIA RT-0253, 2001).
//!
//! Read are `Vertices`, `Triangles`, `Quadrilaterals` and `Edges`; their references become markers. What says nothing
//! about the shape (corners, ridges, normals, …) is skipped by its number of words, each of which must be a number.
//! Words are separated by any blanks; vertices count from 1. The binary variant, `.meshb`, is refused.
//!
//! Forgiven: a version of 0 or above 4; a missing `End`, and what follows it; sections with unknown keywords, such as
//! bamg's, which are skipped up to the next word that begins with a letter and is not in quotation marks; tetrahedra
//! and other solids, if their surface is in the file. An error are a section that is shorter or longer than its
//! number says, vertices without `Dimension 3` before them, elements before the vertices, and a file whose facets are
//! all in sections that are not read.

use super::ahead::{Rows, read_ahead};
use super::error::{FilePosition, FormatError, Reason};
use super::faces;
use super::text::{Syntax, Text};
use crate::exchange::{Facet, Note, NoteCode, Plc, Segment};
use crate::mesh::VertexId;

/// What is skipped: the numbers per element.
const SKIPPED: [(&str, u64); 25] = [
    ("corners", 1),
    ("ridges", 1),
    ("requiredvertices", 1),
    ("requirededges", 1),
    ("requiredtriangles", 1),
    ("requiredquadrilaterals", 1),
    ("normals", 3),
    ("normalatvertices", 2),
    ("normalattrianglevertices", 3),
    ("normalatquadrilateralvertices", 3),
    ("tangents", 3),
    ("tangentatvertices", 2),
    ("tangentatedges", 3),
    ("verticesongeometricvertex", 2),
    ("verticesongeometricedge", 3),
    ("verticesongeometrictriangle", 4),
    ("verticesongeometricquadrilateral", 4),
    ("edgesongeometricedge", 2),
    ("trianglesongeometrictriangle", 2),
    ("quadrilateralsongeometricquadrilateral", 2),
    ("subdomainfromgeom", 4),
    ("subdomainfrommesh", 4),
    ("subdomain", 4),
    ("parallelvertices", 1),
    ("parallelcommunicator", 1),
];

/// Solids: the numbers per element.
const SOLIDS: [(&str, u64); 6] = [
    ("tetrahedra", 5),
    ("hexahedra", 9),
    ("hexaedra", 9),
    ("prisms", 7),
    ("pentahedra", 7),
    ("pyramids", 6),
];

/// Reads a Medit file.
///
/// # Errors
/// If it is malformed, binary, or a volume mesh without its surface.
pub fn read_medit(bytes: &[u8]) -> Result<(Plc, Vec<Note>), FormatError> {
    if bytes.starts_with(b"\x01\0\0\0") || bytes.starts_with(b"\0\0\0\x01") {
        return Err(FormatError::Malformed {
            at: FilePosition::Byte(0),
            reason: Reason::Unsupported("binary Medit files (.meshb) are"),
        });
    }
    let mut reader = Reader {
        text: Text::new(bytes, Syntax::Hash),
        plc: Plc {
            first_index: 1,
            ..Plc::default()
        },
        dimension: false,
        solids: false,
        unknown_faces: false,
    };
    reader.head()?;
    while reader.section()? {}
    reader.finish()
}

struct Reader<'a> {
    text: Text<'a>,
    plc: Plc,
    /// Whether it was given.
    dimension: bool,
    solids: bool,
    /// Whether a section that was skipped may hold faces.
    unknown_faces: bool,
}

impl Reader<'_> {
    fn head(&mut self) -> Result<(), FormatError> {
        const HEAD: &str = "MeshVersionFormatted";
        let token = self.text.anywhere(HEAD)?;
        if !token.eq_ignore_ascii_case(HEAD.as_bytes()) {
            return Err(self.text.bad(token, HEAD));
        }
        let token = self.text.anywhere("the version")?;
        let version = self.text.count(token, "the version")?;
        if !(1..=4).contains(&version) {
            let code = NoteCode::FormatVersion;
            self.text.forgive_named(code, version.to_string());
        }
        Ok(())
    }

    /// Reads a section; false at the end.
    fn section(&mut self) -> Result<bool, FormatError> {
        if !self.text.has_word() && !self.text.advance() {
            self.text.forgive(NoteCode::Keywords);
            return Ok(false);
        }
        let token = self.text.here("End")?;
        let keyword = token.to_ascii_lowercase();
        let skipped = |list: &[(&str, u64)]| {
            let same = |&&(name, _): &&(&str, u64)| name.as_bytes() == keyword;
            list.iter().find(same).map(|&(_, numbers)| numbers)
        };
        match &keyword[..] {
            b"end" => {
                if self.text.has_word() || self.text.advance() {
                    self.text.forgive(NoteCode::TrailingData);
                }
                return Ok(false);
            }
            b"dimension" => self.dimension()?,
            b"vertices" => self.vertices()?,
            b"triangles" => self.facets::<3>()?,
            b"quadrilaterals" => self.facets::<4>()?,
            b"edges" => self.edges()?,
            _ => {
                if let Some(numbers) = skipped(&SKIPPED) {
                    self.skip(numbers)?;
                } else if let Some(numbers) = skipped(&SOLIDS) {
                    let line = self.text.number_of_line();
                    if self.skip(numbers)? {
                        self.solids = true;
                        let name = String::from_utf8_lossy(token).into_owned();
                        self.text.forgive_at(NoteCode::VolumeElements, line, name);
                    }
                } else {
                    self.skip_unknown(token)?;
                }
            }
        }
        Ok(true)
    }

    fn dimension(&mut self) -> Result<(), FormatError> {
        let token = self.text.anywhere("the dimension")?;
        match self.text.integer(token)? {
            3 => self.dimension = true,
            dimension => return Err(self.text.error(Reason::Dimension(dimension))),
        }
        Ok(())
    }

    fn vertices(&mut self) -> Result<(), FormatError> {
        if !self.dimension {
            return Err(self.text.error(Reason::Missing("Dimension 3 is")));
        }
        if !self.plc.vertices.is_empty() {
            return Err(self.text.error(Reason::Twice("Vertices are")));
        }
        let token = self.text.anywhere("the number of vertices")?;
        let count = self.text.vertex_count(token)?;
        let mut vertices = Vertices::default();
        read_ahead(&mut self.text, count, &mut vertices, vertex_and_reference);
        while vertices.len() < count {
            vertex_and_reference(&mut self.text, &mut vertices)?;
        }
        self.plc.vertices = vertices.points;
        if vertices.references.iter().any(|&reference| reference != 0) {
            self.plc.vertex_markers = vertices.references;
        }
        Ok(())
    }

    fn facets<const N: usize>(&mut self) -> Result<(), FormatError> {
        let count = self.count("the number of faces")?;
        let vertices = &self.plc.vertices;
        let read = |text: &mut Text, facets: &mut Vec<Facet>| {
            let (polygon, marker) = element::<N>(text, vertices.len())?;
            let mut polygon = polygon.to_vec();
            faces::open_ring_noted(text, &mut polygon, vertices);
            facets.push(faces::facet(polygon, marker));
            Ok(())
        };
        // There may be facets of an earlier section.
        let mut facets = Vec::new();
        read_ahead(&mut self.text, count, &mut facets, read);
        while Rows::len(&facets) < count {
            read(&mut self.text, &mut facets)?;
        }
        match self.plc.facets.is_empty() {
            true => self.plc.facets = facets,
            false => self.plc.facets.extend(facets),
        }
        Ok(())
    }

    fn edges(&mut self) -> Result<(), FormatError> {
        for _ in 0..self.count("the number of edges")? {
            let (ends, marker) = element::<2>(&mut self.text, self.plc.vertices.len())?;
            self.plc.segments.push(Segment { ends, marker });
        }
        Ok(())
    }

    fn count(&mut self, what: &'static str) -> Result<u64, FormatError> {
        let token = self.text.anywhere(what)?;
        let count = self.text.count(token, what)?;
        if count > 0 && self.plc.vertices.is_empty() {
            let reason = Reason::Missing("the section Vertices, which must come first, is");
            return Err(self.text.error(reason));
        }
        Ok(count)
    }

    /// Skips a section; whether there was anything in it.
    fn skip(&mut self, numbers: u64) -> Result<bool, FormatError> {
        let token = self.text.anywhere("a number of elements")?;
        let count = self.text.count(token, "the number of elements")?;
        // Two loops, since the product may be too large.
        for _ in 0..count {
            for _ in 0..numbers {
                let token = self.text.anywhere("an element")?;
                self.text.number(token)?;
            }
        }
        Ok(count > 0)
    }

    /// Skips a section with an unknown keyword, whose words are numbers or in quotation marks.
    fn skip_unknown(&mut self, token: &[u8]) -> Result<(), FormatError> {
        if !token[0].is_ascii_alphabetic() {
            return Err(self.text.bad(token, "a known keyword of a Medit file"));
        }
        let name: String = String::from_utf8_lossy(token).chars().take(40).collect();
        let of_faces = ["tria", "quad", "poly", "face"];
        let head = name.to_ascii_lowercase();
        self.unknown_faces |= of_faces.iter().any(|word| head.starts_with(word));
        self.text.forgive_named(NoteCode::UnknownSection, name);
        while self.text.has_word() || self.text.advance() {
            let line = self.text.line();
            if line[0] == b'"' {
                let end = line[1..].iter().position(|&b| b == b'"');
                self.text.skip_in_line(end.map_or(line.len(), |i| i + 2));
                continue;
            }
            let mark = self.text.mark();
            let token = self.text.here("a word")?;
            if token[0].is_ascii_alphabetic() && self.text.number(token).is_err() {
                self.text.return_to(mark);
                break;
            }
        }
        Ok(())
    }

    fn finish(self) -> Result<(Plc, Vec<Note>), FormatError> {
        let missing = match self {
            _ if self.plc.vertices.is_empty() => Reason::NoVertices,
            _ if !self.plc.facets.is_empty() => return Ok((self.plc, self.text.into_notes())),
            _ if self.solids => Reason::Unsupported("volume meshes without their surface are"),
            _ if self.unknown_faces => {
                Reason::Unsupported("faces other than Triangles and Quadrilaterals are")
            }
            _ => return Ok((self.plc, self.text.into_notes())),
        };
        Err(self.text.error(missing))
    }
}

/// Vertices and their references.
#[derive(Default)]
struct Vertices {
    points: Vec<[f64; 3]>,
    references: Vec<i64>,
}

impl Rows for Vertices {
    fn piece(&self) -> Vertices {
        Vertices::default()
    }

    fn len(&self) -> u64 {
        self.points.len() as u64
    }

    fn append(&mut self, next: Vertices) -> bool {
        self.points.extend(next.points);
        self.references.extend(next.references);
        true
    }
}

fn vertex_and_reference(text: &mut Text, vertices: &mut Vertices) -> Result<(), FormatError> {
    let mut point = [0.0; 3];
    for x in &mut point {
        let token = text.anywhere("a coordinate")?;
        *x = text.real(token)?;
    }
    let token = text.anywhere("the reference of a vertex")?;
    vertices.references.push(text.integer(token)?);
    vertices.points.push(point);
    Ok(())
}

/// The vertices of an element, of so many, and its reference.
fn element<const N: usize>(
    text: &mut Text,
    count: usize,
) -> Result<([VertexId; N], i64), FormatError> {
    let mut vertices = [VertexId(0); N];
    for v in &mut vertices {
        let token = text.anywhere("a vertex")?;
        *v = faces::vertex(text, token, 1, count)?;
    }
    let token = text.anywhere("a reference")?;
    Ok((vertices, text.integer(token)?))
}
