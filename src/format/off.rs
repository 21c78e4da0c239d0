//! OFF files (Geomview manual, section "OFF files").
//!
//! `OFF` with any of the prefixes ST, C, N (whose texture coordinates, colours and normals are ignored), or no header at
//! all; then the numbers of vertices and faces and possibly of edges; one line per vertex, one per face. What follows the
//! three coordinates or the corners in a line are colours, and ignored. Vertices count from 0.
//!
//! The binary variant is refused: the manual asks for big-endian numbers, the files in the wild are little-endian.

use super::error::{FormatError, Reason};
use super::poly::vertex;
use super::text::Text;
use crate::plc::{Facet, Plc};

/// Reads an OFF file.
pub fn read_off(bytes: &[u8]) -> Result<Plc, FormatError> {
    let mut text = Text::new(bytes, true);
    let vertices = header(&mut text)?;
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
    for _ in 0..vertices {
        text.begin("a vertex")?;
        plc.vertices.push(text.point()?);
        text.skip_line();
    }
    for _ in 0..faces {
        text.begin("a face")?;
        let face = face(&mut text, plc.vertices.len())?;
        plc.facets.push(face);
        text.skip_line();
    }
    text.end_file()?;
    Ok(plc)
}

/// Reads the header, if there is one, and the number of vertices.
fn header(text: &mut Text) -> Result<u64, FormatError> {
    let mut token = text.anywhere("the header OFF")?;
    if token[0].is_ascii_alphabetic() || token.len() > 1 && token.ends_with(b"OFF") {
        check_prefix(text, token)?;
        token = text.anywhere("the number of vertices")?;
        if token.eq_ignore_ascii_case(b"BINARY") {
            return Err(text.error(Reason::BinaryOff));
        }
    }
    text.vertex_count(token)
}

/// The header is `[ST][C][N][4][n]OFF`, where 4 and n stand for dimensions other than 3.
fn check_prefix(text: &Text, token: &[u8]) -> Result<(), FormatError> {
    let word = token.to_ascii_uppercase();
    let not_off = || text.bad(token, "OFF, COFF, NOFF or STOFF");
    let mut prefix = word.strip_suffix(b"OFF").ok_or_else(not_off)?;
    for part in [&b"ST"[..], b"C", b"N"] {
        prefix = prefix.strip_prefix(part).unwrap_or(prefix);
    }
    match prefix {
        b"" => Ok(()),
        b"4" => Err(text.error(Reason::Dimension(4))),
        _ => Err(not_off()),
    }
}

fn face(text: &mut Text, vertices: usize) -> Result<Facet, FormatError> {
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
        polygon.push(vertex(text, token, 0, vertices)?);
    }
    Ok(Facet {
        polygons: vec![polygon],
        ..Facet::default()
    })
}
