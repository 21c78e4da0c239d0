//! PLY files (Turk, *The PLY Polygon File Format*, 1994): ASCII, and binary of both byte orders.
//!
//! Read are the coordinates `x y z` of the element `vertex` (of any type), the list `vertex_indices` or `vertex_index`
//! of `face`, and `vertex1 vertex2` of `edge`, which become segments; other properties and elements are skipped. Binary
//! singles are widened exactly. In an ASCII file the digits count, not the declared type: `0.1` is the double nearest
//! to
//! 0.1 even where the header says `float`. Vertices count from 0.
//!
//! Why not the crate `ply-rs-bw` (4.0): it rounds `float` in ASCII files to singles, stores one element after the other
//! for any number of elements without properties (a header of 80 bytes fills the memory), does not notice bytes that
//! are left over, and gives up the places of values, which are needed to say where an index is out of range.

use super::ahead::{Rows, read_ahead};
use super::bytes::Bytes;
use super::error::{FormatError, Reason};
use super::ply_header::{Element, Encoding, Property, Role, Type, header};
use super::text::Text;
use crate::exchange::{Facet, Note, Plc, Segment};
use crate::mesh::VertexId;

/// Reads a PLY file.
pub fn read_ply(bytes: &[u8]) -> Result<(Plc, Vec<Note>), FormatError> {
    let mut text = Text::new(bytes, false);
    let header = header(&mut text)?;
    let mut body = match header.encoding {
        Encoding::Ascii => Body::Ascii(&mut text),
        encoding => Body::Binary(Bytes::new(
            bytes,
            start_of_numbers(bytes, &text),
            encoding == Encoding::BigEndian,
        )),
    };
    let mut plc = Plc::default();
    for element in &header.elements {
        // Else there would be nothing to read, and possibly often.
        if element.properties.is_empty() {
            continue;
        }
        let mut elements = Elements {
            count: 0,
            plc: std::mem::take(&mut plc),
        };
        if let Body::Ascii(text) = &mut body {
            let read = |text: &mut Text, elements: &mut Elements| {
                read_element(&mut Body::Ascii(text), element, header.vertices, elements)
            };
            read_ahead(text, element.count, &mut elements, read);
        }
        while elements.count < element.count {
            body.begin(element.role)?;
            read_element(&mut body, element, header.vertices, &mut elements)?;
        }
        plc = elements.plc;
    }
    body.end_file()?;
    Ok((plc, Vec::new()))
}

/// How many elements of one kind have been read, and what all elements come to.
#[derive(Default)]
struct Elements {
    count: u64,
    plc: Plc,
}

impl Rows for Elements {
    fn piece(&self) -> Elements {
        Elements::default()
    }

    fn len(&self) -> u64 {
        self.count
    }

    fn append(&mut self, next: Elements) -> bool {
        self.count += next.count;
        self.plc.vertices.extend(next.plc.vertices);
        self.plc.facets.extend(next.plc.facets);
        self.plc.segments.extend(next.plc.segments);
        true
    }
}

/// The offset of the first byte after the header. If its lines end with CR, an LF after the last one is a number's.
fn start_of_numbers(bytes: &[u8], text: &Text) -> usize {
    let at = bytes.len() - text.rest().len();
    let end = bytes.iter().position(|b| matches!(b, b'\r' | b'\n'));
    let cr_alone = end.is_some_and(|i| bytes[i] == b'\r' && bytes.get(i + 1) != Some(&b'\n'));
    if cr_alone && bytes[..at].ends_with(b"\r\n") {
        at - 1
    } else {
        at
    }
}

fn read_element(
    body: &mut Body,
    element: &Element,
    vertices: u64,
    elements: &mut Elements,
) -> Result<(), FormatError> {
    let mut point = [0.0; 3];
    let mut ends = [VertexId(0); 2];
    let mut polygon = Vec::new();
    for &property in &element.properties {
        match property {
            Property::Coordinate(i, kind) => point[i] = body.real(kind)?,
            Property::End(i, kind) => ends[i] = body.vertex(kind, vertices)?,
            Property::Corners(counter, kind) => {
                let corners = body.count(counter, "the number of corners")?;
                match corners {
                    0 => return Err(body.error(Reason::EmptyFacet)),
                    1 | 2 => return Err(body.error(Reason::ShortFace(corners as i64))),
                    _ => {}
                }
                for _ in 0..corners {
                    polygon.push(body.vertex(kind, vertices)?);
                }
            }
            Property::Other(kind) => body.skip(1, kind)?,
            Property::OtherList(counter, kind) => {
                let members = body.count(counter, "the length of a list")?;
                body.skip(members, kind)?;
            }
        }
    }
    body.end()?;
    elements.count += 1;
    let plc = &mut elements.plc;
    match element.role {
        Role::Vertex => plc.vertices.push(point),
        Role::Face => plc.facets.push(Facet {
            polygons: vec![polygon],
            ..Facet::default()
        }),
        Role::Edge => plc.segments.push(Segment { ends, marker: 0 }),
        Role::Other => {}
    }
    Ok(())
}

/// What follows the header.
enum Body<'t, 'a> {
    /// One element per line.
    Ascii(&'t mut Text<'a>),
    Binary(Bytes<'a>),
}

impl Body<'_, '_> {
    fn begin(&mut self, role: Role) -> Result<(), FormatError> {
        match self {
            Body::Ascii(text) => text.begin(match role {
                Role::Vertex => "a vertex",
                Role::Face => "a face",
                Role::Edge => "an edge",
                Role::Other => "an element",
            }),
            Body::Binary(_) => Ok(()),
        }
    }

    fn real(&mut self, kind: Type) -> Result<f64, FormatError> {
        const WHAT: &str = "a coordinate";
        match self {
            Body::Ascii(text) => {
                let token = text.here(WHAT)?;
                text.real(token)
            }
            Body::Binary(bytes) => match kind {
                Type::F32 => bytes.single(WHAT),
                Type::F64 => bytes.double(WHAT),
                // At most 32 bits.
                _ => Ok(whole(bytes, kind, WHAT)? as f64),
            },
        }
    }

    fn integer(&mut self, kind: Type, what: &'static str) -> Result<i64, FormatError> {
        match self {
            Body::Ascii(text) => {
                let token = text.here(what)?;
                text.integer(token)
            }
            Body::Binary(bytes) => whole(bytes, kind, what),
        }
    }

    fn count(&mut self, kind: Type, what: &'static str) -> Result<u64, FormatError> {
        let count = self.integer(kind, what)?;
        u64::try_from(count).map_err(|_| self.error(Reason::NegativeCount { what, count }))
    }

    fn vertex(&mut self, kind: Type, vertices: u64) -> Result<VertexId, FormatError> {
        let index = self.integer(kind, "a vertex")?;
        let id = u32::try_from(index).map(VertexId);
        id.ok()
            .filter(|&id| u64::from(id.0) < vertices)
            .ok_or_else(|| {
                self.error(Reason::IndexOutOfRange {
                    index,
                    first: 0,
                    last: vertices as i64 - 1,
                })
            })
    }

    fn skip(&mut self, count: u64, kind: Type) -> Result<(), FormatError> {
        const WHAT: &str = "a property";
        match self {
            Body::Ascii(text) => {
                for _ in 0..count {
                    text.here(WHAT)?;
                }
                Ok(())
            }
            // A list has fewer than 2^32 members.
            Body::Binary(bytes) => bytes.skip(count * kind.size(), WHAT),
        }
    }

    fn end(&mut self) -> Result<(), FormatError> {
        match self {
            Body::Ascii(text) => text.end_line(),
            Body::Binary(_) => Ok(()),
        }
    }

    fn end_file(&mut self) -> Result<(), FormatError> {
        match self {
            Body::Ascii(text) => text.end_file(),
            Body::Binary(bytes) => bytes.end(),
        }
    }

    fn error(&self, reason: Reason) -> FormatError {
        match self {
            Body::Ascii(text) => text.error(reason),
            Body::Binary(bytes) => bytes.error(reason),
        }
    }
}

/// A whole number. Only reals have other types, and they are not asked for as whole numbers.
fn whole(bytes: &mut Bytes, kind: Type, what: &'static str) -> Result<i64, FormatError> {
    Ok(match kind {
        Type::I8 => i64::from(i8::from_be_bytes(bytes.take(what)?)),
        Type::U8 => i64::from(u8::from_be_bytes(bytes.take(what)?)),
        Type::I16 => i64::from(i16::from_be_bytes(bytes.take(what)?)),
        Type::U16 => i64::from(u16::from_be_bytes(bytes.take(what)?)),
        Type::I32 => i64::from(i32::from_be_bytes(bytes.take(what)?)),
        Type::U32 => i64::from(u32::from_be_bytes(bytes.take(what)?)),
        Type::F32 | Type::F64 => unreachable!("the header has been checked"),
    })
}
