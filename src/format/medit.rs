//! Medit's ASCII files, `.mesh` (Frey, *MEDIT: An interactive mesh visualization software*, INRIA RT-0253, 2001).
//!
//! Read are `Vertices`, `Triangles`, `Quadrilaterals` and `Edges`; the references of the last three become markers.
//! What says nothing about the shape (corners, ridges, normals, …) is skipped by its number of words, each of which
//! must be a number. The tetrahedra and other solids of a volume mesh are skipped, too, if its surface is in the file;
//! else the file is refused. Words are separated by any blanks; vertices count from 1. The word `End` must be there, so
//! that a file that was cut is noticed. The binary variant, `.meshb`, is refused.

use super::ahead::{Rows, read_ahead};
use super::error::{FormatError, Place, Reason};
use super::poly::{marker_of, vertex};
use super::text::Text;
use crate::exchange::{Facet, Note, Plc, Segment};
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
pub fn read_medit(bytes: &[u8]) -> Result<(Plc, Vec<Note>), FormatError> {
    if bytes.starts_with(b"\x01\0\0\0") || bytes.starts_with(b"\0\0\0\x01") {
        return Err(FormatError::Malformed {
            place: Place::Byte(0),
            reason: Reason::Unsupported("binary Medit files (.meshb) are"),
        });
    }
    let mut reader = Reader {
        text: Text::new(bytes, true),
        plc: Plc {
            first_index: 1,
            ..Plc::default()
        },
        dimension: false,
        solids: false,
    };
    reader.head()?;
    while reader.section()? {}
    reader.text.end_file()?;
    Ok((reader.finish()?, Vec::new()))
}

struct Reader<'a> {
    text: Text<'a>,
    plc: Plc,
    /// Whether it was given.
    dimension: bool,
    solids: bool,
}

impl Reader<'_> {
    fn head(&mut self) -> Result<(), FormatError> {
        const HEAD: &str = "MeshVersionFormatted";
        let token = self.text.anywhere(HEAD)?;
        if !token.eq_ignore_ascii_case(HEAD.as_bytes()) {
            return Err(self.text.bad(token, HEAD));
        }
        let token = self.text.anywhere("the version")?;
        if !(1..=4).contains(&self.text.integer(token)?) {
            return Err(self.text.bad(token, "a version from 1 to 4"));
        }
        Ok(())
    }

    /// Reads a section; false at the end.
    fn section(&mut self) -> Result<bool, FormatError> {
        let token = self.text.anywhere("End")?;
        let keyword = token.to_ascii_lowercase();
        let skipped = |list: &[(&str, u64)]| {
            let same = |&&(name, _): &&(&str, u64)| name.as_bytes() == keyword;
            list.iter().find(same).map(|&(_, numbers)| numbers)
        };
        match &keyword[..] {
            b"end" => return Ok(false),
            b"dimension" => self.dimension()?,
            b"vertices" => self.vertices()?,
            b"triangles" => self.facets::<3>()?,
            b"quadrilaterals" => self.facets::<4>()?,
            b"edges" => self.edges()?,
            _ => {
                if let Some(numbers) = skipped(&SKIPPED) {
                    self.skip(numbers)?;
                } else if let Some(numbers) = skipped(&SOLIDS) {
                    self.solids |= self.skip(numbers)?;
                } else {
                    return Err(self.text.bad(token, "a known keyword of a Medit file"));
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
        let vertices = &mut self.plc.vertices;
        read_ahead(&mut self.text, count, vertices, vertex_and_reference);
        while Rows::len(vertices) < count {
            vertex_and_reference(&mut self.text, vertices)?;
        }
        Ok(())
    }

    fn facets<const N: usize>(&mut self) -> Result<(), FormatError> {
        let count = self.count("the number of faces")?;
        let vertices = self.plc.vertices.len();
        let read = |text: &mut Text, facets: &mut Vec<Facet>| {
            let (polygon, marker) = element::<N>(text, vertices)?;
            facets.push(Facet {
                polygons: vec![polygon.to_vec()],
                marker,
                ..Facet::default()
            });
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

    fn finish(self) -> Result<Plc, FormatError> {
        if self.plc.vertices.is_empty() {
            return Err(self.text.error(Reason::NoVertices));
        }
        if self.solids && self.plc.facets.is_empty() {
            let reason = Reason::Unsupported("volume meshes without their surface are");
            return Err(self.text.error(reason));
        }
        Ok(self.plc)
    }
}

fn vertex_and_reference(text: &mut Text, vertices: &mut Vec<[f64; 3]>) -> Result<(), FormatError> {
    let mut point = [0.0; 3];
    for x in &mut point {
        let token = text.anywhere("a coordinate")?;
        *x = text.real(token)?;
    }
    let token = text.anywhere("the reference of a vertex")?;
    text.integer(token)?;
    vertices.push(point);
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
        *v = vertex(text, token, 1, count)?;
    }
    let token = text.anywhere("a reference")?;
    Ok((vertices, marker_of(text, token)?))
}
