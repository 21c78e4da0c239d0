//! PLY files (Turk, *The PLY Polygon File Format*, 1994): ASCII, and binary of both byte orders.
//!
//! Read are the coordinates `x y z` of the element `vertex` (of any type), the list `vertex_indices` or
//! `vertex_index` of `face`, the same of `tristrips`, whose strips of triangles end at −1, and `vertex1 vertex2` of
//! `edge`, which become segments; other properties and elements are skipped. Binary singles are widened exactly. In
//! an ASCII file the digits count, not the declared type: `0.1` is the double nearest to 0.1 even where the header
//! says `float`. Vertices count from 0.
//!
//! The markers of faces are the property `label`, or another one that says what part they belong to (of a type of
//! whole numbers); else, where faces have different colours (of bytes), 1, 2, … in the order of the first face of each.
//!
//! Comments are those of the header, and in ASCII files whatever is in braces on one line. An ASCII file whose lines
//! are not elements is read word by word if that uses every word. Forgiven are bytes after the end of a binary file
//! that are not one more element. An error is whatever is left over in an ASCII file, because then a number is wrong.
//!
//! Why not the crate `ply-rs-bw` (4.0): it rounds `float` in ASCII files to singles, stores one element after the
//! other for any number of elements without properties (a header of 80 bytes fills the memory), does not notice bytes
//! that are left over, and gives up the places of values, which are needed to say where an index is out of range.

use super::ahead::{Rows, read_ahead};
use super::bytes::Bytes;
use super::error::FormatError;
use super::faces;
use super::ply_body::Body;
use super::ply_header::{Element, Encoding, Header, Property, Role, Type, header};
use super::stl_binary::{says_nothing, trailing};
use super::text::{Syntax, Text};
use crate::exchange::{Facet, Note, NoteCode, Plc, Segment};
use crate::mesh::VertexId;
use rustc_hash::FxHashMap;

/// Reads a PLY file.
///
/// # Errors
/// If it is malformed.
pub fn read_ply(bytes: &[u8]) -> Result<(Plc, Vec<Note>), FormatError> {
    let mut text = Text::new(bytes, Syntax::Braces);
    let header = header(&mut text)?;
    let (mut plc, notes) = match header.encoding {
        Encoding::Ascii => ascii(text, &header)?,
        encoding => {
            let start = start_of_numbers(bytes, &text);
            let binary = Bytes::new(bytes, start, encoding == Encoding::BigEndian);
            let mut body = Body::Binary(binary);
            let plc = elements(&mut body, &header)?;
            let mut notes = text.into_notes_of_header();
            notes.extend(end(body, &header)?);
            (plc, notes)
        }
    };
    let is = |test| header.elements.iter().any(|element| element.has(test));
    if is(|p| matches!(p, Property::Colour(..))) && !is(|p| matches!(p, Property::Label(_))) {
        number_colours(&mut plc);
    }
    Ok((plc, notes))
}

/// Reads the numbers of an ASCII file: by lines, or else by words.
fn ascii(text: Text, header: &Header) -> Result<(Plc, Vec<Note>), FormatError> {
    let mut by_lines = text.clone();
    let read = |body: &mut Body| elements(body, header);
    let mut result = by_lines.end_line();
    let mut plc = Plc::default();
    if result.is_ok() {
        result = read(&mut Body::Lines(&mut by_lines)).and_then(|read| {
            plc = read;
            by_lines.end_file()
        });
    }
    let Err(error) = result else {
        return Ok((plc, by_lines.into_notes()));
    };
    let mut by_words = text;
    if !by_words.has_word() {
        by_words.advance();
    }
    by_words.forgive(NoteCode::LineBreaks);
    match read(&mut Body::Words(&mut by_words)) {
        Ok(plc) if by_words.end_file().is_ok() => Ok((plc, by_words.into_notes())),
        _ => Err(error),
    }
}

/// Reads all elements.
fn elements(body: &mut Body, header: &Header) -> Result<Plc, FormatError> {
    let mut plc = Plc::default();
    for element in &header.elements {
        // Else there would be nothing to read, and possibly often.
        if element.properties.is_empty() {
            continue;
        }
        // The coordinates of corners, if vertices come first.
        let points = match element.role {
            Role::Vertex => Vec::new(),
            _ => std::mem::take(&mut plc.vertices),
        };
        let reader = Reader {
            element,
            points: &points,
            vertices: header.vertices,
        };
        let mut rows = Elements { count: 0, plc };
        if let Body::Lines(text) = body {
            let read =
                |text: &mut Text, rows: &mut Elements| reader.read(&mut Body::Lines(text), rows);
            read_ahead(text, element.count, &mut rows, read);
        }
        while rows.count < element.count {
            body.begin(element.role)?;
            reader.read(body, &mut rows)?;
        }
        plc = rows.plc;
        if element.role != Role::Vertex {
            plc.vertices = points;
        }
    }
    Ok(plc)
}

/// What follows the last number of a binary file.
fn end(body: Body, header: &Header) -> Result<Vec<Note>, FormatError> {
    let Body::Binary(mut bytes) = body else {
        return Ok(Vec::new());
    };
    let mut notes = bytes.notes();
    let rest = bytes.rest();
    if rest.iter().all(|b| matches!(b, b'\r' | b'\n')) {
        return Ok(notes);
    }
    let mut last = header.elements.iter().rev();
    let last = last.find(|e| e.count > 0 && !e.properties.is_empty());
    let size = last.map_or(1, Element::least_size);
    if says_nothing(rest, usize::try_from(size).unwrap_or(usize::MAX)) {
        notes.extend(trailing(rest, bytes.offset(), "element"));
        return Ok(notes);
    }
    bytes.end().map(|()| notes)
}

/// Markers in the place of colours. One colour tells nothing apart.
fn number_colours(plc: &mut Plc) {
    let mut numbers: FxHashMap<i64, i64> = FxHashMap::default();
    for facet in &mut plc.facets {
        let next = numbers.len() as i64 + 1;
        let colour = facet.marker;
        facet.marker = *numbers.entry(colour).or_insert(next);
        if facet.marker == next {
            let [r, g, b, a] = unpack(colour);
            let alpha = if a < 0 {
                String::new()
            } else {
                format!(" {a}")
            };
            plc.marker_names.push((next, format!("{r} {g} {b}{alpha}")));
        }
    }
    if numbers.len() <= 1 {
        plc.facets.iter_mut().for_each(|facet| facet.marker = 0);
        plc.marker_names.clear();
    }
}

/// A colour as one number: sixteen bits for each component, which is −1 if there is none.
fn pack(colour: [i64; 4]) -> i64 {
    colour.iter().fold(0, |packed, &part| {
        packed << 16 | (part.clamp(-1, 0x7fff) & 0xffff)
    })
}

fn unpack(packed: i64) -> [i64; 4] {
    [48, 32, 16, 0].map(|shift| i64::from((packed >> shift) as i16))
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
    let at = text.offset(bytes.len());
    let end = bytes.iter().position(|b| matches!(b, b'\r' | b'\n'));
    let cr_alone = end.is_some_and(|i| bytes[i] == b'\r' && bytes.get(i + 1) != Some(&b'\n'));
    if cr_alone && bytes[..at].ends_with(b"\r\n") {
        at - 1
    } else {
        at
    }
}

/// Reads elements of one kind.
struct Reader<'a> {
    element: &'a Element,
    /// The coordinates of the vertices, if they are known.
    points: &'a [[f64; 3]],
    /// How many vertices there are.
    vertices: u64,
}

impl Reader<'_> {
    fn read(&self, body: &mut Body, elements: &mut Elements) -> Result<(), FormatError> {
        let mut point = [0.0; 3];
        let mut ends = [VertexId(0); 2];
        let mut polygon = Vec::new();
        let mut label = None;
        let mut colour = [-1; 4];
        let plc = &mut elements.plc;
        for &property in &self.element.properties {
            match property {
                Property::Coordinate(i, kind) => point[i] = body.real(kind)?,
                Property::End(i, kind) => ends[i] = body.vertex(kind, self.vertices)?,
                Property::Corners(counter, kind) if self.element.role == Role::Strips => {
                    let corners = body.count(counter, "the number of corners of a strip")?;
                    self.strip(body, corners, kind, &mut plc.facets)?;
                }
                Property::Corners(counter, kind) => {
                    let corners = body.count(counter, "the number of corners")?;
                    if let Some(reason) = faces::too_short(corners) {
                        return Err(body.error(reason));
                    }
                    for _ in 0..corners {
                        polygon.push(body.vertex(kind, self.vertices)?);
                    }
                }
                Property::Label(kind) => label = Some(body.integer(kind, "a label")?),
                Property::Colour(i, kind) => colour[i] = body.integer(kind, "a colour")?,
                Property::Other(kind) => body.skip(1, kind)?,
                Property::OtherList(counter, kind) => {
                    let members = body.count(counter, "the length of a list")?;
                    body.skip(members, kind)?;
                }
            }
        }
        match self.element.role {
            Role::Vertex => plc.vertices.push(point),
            Role::Face => {
                if faces::open_ring(&mut polygon, self.points) {
                    body.forgive_closed_ring();
                }
                let has_colour = self.element.has(|p| matches!(p, Property::Colour(..)));
                let marker = label.unwrap_or(if has_colour { pack(colour) } else { 0 });
                plc.facets.push(faces::facet(polygon, marker));
            }
            Role::Edge => plc.segments.push(Segment { ends, marker: 0 }),
            Role::Strips | Role::Other => {}
        }
        body.end()?;
        elements.count += 1;
        Ok(())
    }

    /// Reads strips of triangles: each corner makes a triangle with the two before it, and every second one turns it
    /// round; −1 begins another strip. Triangles with a repeated corner only lead from one place to another.
    fn strip(
        &self,
        body: &mut Body,
        corners: u64,
        kind: Type,
        facets: &mut Vec<Facet>,
    ) -> Result<(), FormatError> {
        let mut before: Vec<VertexId> = Vec::new();
        for _ in 0..corners {
            let Some(v) = body.vertex_or_end(kind, self.vertices)? else {
                before.clear();
                continue;
            };
            before.push(v);
            let &[.., a, b, c] = &before[..] else {
                continue;
            };
            if a == b || b == c || c == a {
                continue;
            }
            let triangle = if before.len() % 2 == 1 {
                [a, b, c]
            } else {
                [b, a, c]
            };
            facets.push(faces::facet(triangle.to_vec(), 0));
        }
        Ok(())
    }
}
