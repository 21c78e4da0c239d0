//! OFF files (Geomview manual, section "OFF files").
//!
//! `OFF` with any of the prefixes ST, C, N (whose texture coordinates, colours and normals are ignored), or no header
//! at all; then the numbers of vertices and faces and possibly of edges; one line per vertex, one per face. What
//! follows the three coordinates or the corners in a line are colours, and ignored. Vertices count from 0.
//!
//! A file whose lines are not rows may still be one if its words are read one after the other, whatever the line
//! breaks: three numbers for a vertex, and those that the prefix announces; for a face its corners alone. That is
//! tried only if the lines make no sense, or if vertices begin on the line of the counts, and must use every word of
//! the file. The number of edges is left out only where those of vertices and faces are alone on a line.
//!
//! The dimension of `nOFF` stands before the counts, and must be 3; `4OFF` is refused. An error is whatever is left
//! over after the last face, because then a count is wrong. After `OFF BINARY` see [`super::off_binary`].

use super::ahead::{Rows, read_ahead};
use super::error::{FormatError, Reason};
use super::faces;
use super::off_binary::read_binary;
use super::text::{Syntax, Text};
use crate::exchange::{Facet, Note, NoteCode, Plc};

/// Reads an OFF file.
///
/// # Errors
/// If it is malformed.
pub fn read_off(bytes: &[u8]) -> Result<(Plc, Vec<Note>), FormatError> {
    let mut text = Text::new(bytes, Syntax::Hash);
    let header = match header(&mut text)? {
        Header::Text(header) => header,
        Header::Binary { extra } => {
            let (plc, more) = read_binary(bytes, text.offset(bytes.len()), extra)?;
            let mut notes = text.into_notes_of_header();
            notes.extend(more);
            return Ok((plc, notes));
        }
    };
    let mut by_lines = text.clone();
    let error = match lines(&mut by_lines, header) {
        Ok(plc) => return Ok((plc, by_lines.into_notes())),
        Err(error) => error,
    };
    match words(&mut text, header) {
        Ok(plc) => Ok((plc, text.into_notes())),
        Err(_) => Err(error),
    }
}

/// What is known after the header.
enum Header {
    Text(TextHeader),
    /// Numbers follow in binary, and so many bytes follow the coordinates of a vertex.
    Binary {
        extra: u64,
    },
}

#[derive(Clone, Copy)]
struct TextHeader {
    /// The number of vertices.
    vertices: u64,
    /// How many numbers the prefix announces after the coordinates of a vertex.
    extra: u64,
}

/// Reads the header, if there is one, and the number of vertices.
fn header(text: &mut Text) -> Result<Header, FormatError> {
    let mut token = text.anywhere("the header OFF")?;
    let mut extra = 0;
    if token[0].is_ascii_alphabetic() || token.len() > 1 && token.ends_with(b"OFF") {
        extra = prefix(text, token)?;
        let is_alone = !text.has_word();
        token = text.anywhere("the number of vertices")?;
        if !is_alone && token.eq_ignore_ascii_case(b"BINARY") {
            text.end_line()?;
            return Ok(Header::Binary { extra: 4 * extra });
        }
    }
    let vertices = text.vertex_count(token)?;
    Ok(Header::Text(TextHeader { vertices, extra }))
}

/// The header is `[ST][C][N][4][n]OFF`, where 4 and n stand for dimensions other than 3. Returns how many numbers
/// texture coordinates, colour and normal of a vertex are.
fn prefix(text: &mut Text, token: &[u8]) -> Result<u64, FormatError> {
    if token == b"nOFF" {
        let token = text.anywhere("the dimension")?;
        return match text.integer(token)? {
            3 => Ok(0),
            dimension => Err(text.error(Reason::Dimension(dimension))),
        };
    }
    let word = token.to_ascii_uppercase();
    let not_off = |text: &Text| text.bad(token, "OFF, COFF, NOFF or STOFF");
    let Some(mut prefix) = word.strip_suffix(b"OFF") else {
        return Err(not_off(text));
    };
    let mut extra = 0;
    let mut parts = vec![(&b"ST"[..], 2), (b"C", 4), (b"N", 3)];
    // The manual has them in this order, files in any.
    while let Some(i) = parts.iter().position(|(part, _)| prefix.starts_with(part)) {
        let (part, size) = parts.remove(i);
        prefix = &prefix[part.len()..];
        extra += size;
    }
    match prefix {
        b"" => Ok(extra),
        b"4" => Err(text.error(Reason::Dimension(4))),
        _ => Err(not_off(text)),
    }
}

/// Reads what follows the number of vertices, as lines.
fn lines(text: &mut Text, header: TextHeader) -> Result<Plc, FormatError> {
    let vertices = header.vertices;
    let faces = face_count(text)?;
    // The number of edges is often wrong, and needed by nobody.
    if let Some(token) = text.token() {
        text.count(token, "the number of edges")?;
    }
    text.end_line()?;
    if vertices == 0 {
        return Err(text.error(Reason::NoVertices));
    }

    let mut plc = Plc::default();
    read_ahead(text, vertices, &mut plc.vertices, vertex);
    while Rows::len(&plc.vertices) < vertices {
        text.begin("a vertex")?;
        vertex(text, &mut plc.vertices)?;
    }
    let points = &plc.vertices;
    let face = |text: &mut Text, facets: &mut Vec<Facet>| {
        face(text, points, facets)?;
        text.skip_line();
        Ok(())
    };
    read_ahead(text, faces, &mut plc.facets, face);
    while Rows::len(&plc.facets) < faces {
        text.begin("a face")?;
        face(text, &mut plc.facets)?;
    }
    text.end_file()?;
    Ok(plc)
}

/// Reads what follows the number of vertices, whatever the line breaks.
fn words(text: &mut Text, header: TextHeader) -> Result<Plc, FormatError> {
    let line = text.number_of_line();
    let faces = face_count(text)?;
    text.forgive(NoteCode::LineBreaks);
    // It is left out where the numbers of vertices and faces have a line for themselves. Else it must be there: a
    // coordinate that is missing further on would shift all others.
    if text.number_of_line() > line || text.has_word() {
        let token = text.anywhere("the number of edges")?;
        text.count(token, "the number of edges")?;
    }
    let mut plc = Plc::default();
    for _ in 0..header.vertices {
        let mut point = [0.0; 3];
        for x in &mut point {
            let token = text.anywhere("a coordinate")?;
            *x = text.real(token)?;
        }
        for _ in 0..header.extra {
            let token = text.anywhere("a normal or a colour")?;
            text.number(token)?;
        }
        plc.vertices.push(point);
    }
    for _ in 0..faces {
        if !text.has_word() {
            text.begin("a face")?;
        }
        face(text, &plc.vertices, &mut plc.facets)?;
    }
    text.end_file()?;
    match header.vertices {
        0 => Err(text.error(Reason::NoVertices)),
        _ => Ok(plc),
    }
}

fn face_count(text: &mut Text) -> Result<u64, FormatError> {
    let token = text.anywhere("the number of faces")?;
    text.count(token, "the number of faces")
}

fn vertex(text: &mut Text, vertices: &mut Vec<[f64; 3]>) -> Result<(), FormatError> {
    vertices.push(text.point()?);
    // Else they may be decimal commas, and what is left coordinates.
    if text.has_word() && text.is_separated_by_commas() {
        text.end_line()?;
    }
    text.skip_line();
    Ok(())
}

fn face(
    text: &mut Text,
    vertices: &[[f64; 3]],
    facets: &mut Vec<Facet>,
) -> Result<(), FormatError> {
    let token = text.here("the number of corners")?;
    let count = text.count(token, "the number of corners")?;
    if let Some(reason) = faces::too_short(count) {
        return Err(text.error(reason));
    }
    let mut polygon = Vec::new();
    for _ in 0..count {
        let token = text.anywhere("a corner")?;
        polygon.push(faces::vertex(text, token, 0, vertices.len())?);
    }
    faces::open_ring_noted(text, &mut polygon, vertices);
    facets.push(faces::facet(polygon, 0));
    Ok(())
}
