//! OFF files (Geomview manual, section "OFF files").
//!
//! `OFF` with any of the prefixes ST, C, N (whose texture coordinates, colours and normals are ignored), or no header
//! at all; then the numbers of vertices and faces and possibly of edges; one line per vertex, one per face. What
//! follows the three coordinates or the corners in a line are colours, and ignored. Vertices count from 0.
//!
//! The dimension of `nOFF` stands before the counts, and must be 3; `4OFF` is refused. After `OFF BINARY` see
//! [`super::off_binary`].

use super::ahead::{Rows, read_ahead};
use super::error::{FormatError, Reason};
use super::off_binary::read_binary;
use super::poly;
use super::text::Text;
use crate::exchange::{Facet, Note, Plc};

/// Reads an OFF file.
pub fn read_off(bytes: &[u8]) -> Result<(Plc, Vec<Note>), FormatError> {
    let mut text = Text::new(bytes, true);
    let vertices = match header(&mut text)? {
        Header::Vertices(count) => count,
        Header::Binary { extra } => {
            let plc = read_binary(bytes, bytes.len() - text.rest().len(), extra)?;
            return Ok((plc, Vec::new()));
        }
    };
    let token = text.anywhere("the number of faces")?;
    let faces = text.count(token, "the number of faces")?;
    // The number of edges is often wrong, and needed by nobody.
    if let Some(token) = text.token() {
        text.count(token, "the number of edges")?;
    }
    text.end_line()?;
    if vertices == 0 {
        return Err(text.error(Reason::NoVertices));
    }

    let mut plc = Plc::default();
    read_ahead(&mut text, vertices, &mut plc.vertices, vertex);
    while Rows::len(&plc.vertices) < vertices {
        text.begin("a vertex")?;
        vertex(&mut text, &mut plc.vertices)?;
    }
    let face = |text: &mut Text, facets: &mut Vec<Facet>| face(text, vertices as usize, facets);
    read_ahead(&mut text, faces, &mut plc.facets, face);
    while Rows::len(&plc.facets) < faces {
        text.begin("a face")?;
        face(&mut text, &mut plc.facets)?;
    }
    text.end_file()?;
    Ok((plc, Vec::new()))
}

/// What is known after the header.
enum Header {
    /// The number of vertices.
    Vertices(u64),
    /// Numbers follow in binary, and so many bytes follow the coordinates of a vertex.
    Binary { extra: u64 },
}

/// Reads the header, if there is one, and the number of vertices.
fn header(text: &mut Text) -> Result<Header, FormatError> {
    let mut token = text.anywhere("the header OFF")?;
    if token[0].is_ascii_alphabetic() || token.len() > 1 && token.ends_with(b"OFF") {
        let extra = prefix(text, token)?;
        if text.has_word() {
            token = text.here("BINARY")?;
            if token.eq_ignore_ascii_case(b"BINARY") {
                text.end_line()?;
                return Ok(Header::Binary { extra });
            }
        } else {
            token = text.anywhere("the number of vertices")?;
        }
    }
    text.vertex_count(token).map(Header::Vertices)
}

/// The header is `[ST][C][N][4][n]OFF`, where 4 and n stand for dimensions other than 3. Returns the size of texture
/// coordinates, colour and normal of a vertex in a binary file.
fn prefix(text: &mut Text, token: &[u8]) -> Result<u64, FormatError> {
    if token == b"nOFF" {
        let token = text.anywhere("the dimension")?;
        return match text.integer(token)? {
            3 => Ok(0),
            dimension => Err(text.error(Reason::Dimension(dimension))),
        };
    }
    let word = token.to_ascii_uppercase();
    let not_off = || text.bad(token, "OFF, COFF, NOFF or STOFF");
    let mut prefix = word.strip_suffix(b"OFF").ok_or_else(not_off)?;
    let mut extra = 0;
    for (part, size) in [(&b"ST"[..], 8), (b"C", 16), (b"N", 12)] {
        if let Some(rest) = prefix.strip_prefix(part) {
            prefix = rest;
            extra += size;
        }
    }
    match prefix {
        b"" => Ok(extra),
        b"4" => Err(text.error(Reason::Dimension(4))),
        _ => Err(not_off()),
    }
}

fn vertex(text: &mut Text, vertices: &mut Vec<[f64; 3]>) -> Result<(), FormatError> {
    vertices.push(text.point()?);
    text.skip_line();
    Ok(())
}

fn face(text: &mut Text, vertices: usize, facets: &mut Vec<Facet>) -> Result<(), FormatError> {
    let token = text.here("the number of corners")?;
    let count = text.count(token, "the number of corners")?;
    match count {
        0 => return Err(text.error(Reason::EmptyFacet)),
        1 | 2 => return Err(text.error(Reason::ShortFace(count as i64))),
        _ => {}
    }
    let mut polygon = Vec::new();
    for _ in 0..count {
        let token = text.anywhere("a corner")?;
        polygon.push(poly::vertex(text, token, 0, vertices)?);
    }
    facets.push(Facet {
        polygons: vec![polygon],
        ..Facet::default()
    });
    text.skip_line();
    Ok(())
}
