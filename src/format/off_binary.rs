//! Binary OFF files (Geomview manual, section "OFF files"): after the line `OFF BINARY`, the numbers of vertices, faces
//! and edges; per vertex three singles, and those of its normal, colour and texture coordinates if the header announces
//! them; per face the number of its corners, the corners, the number of its colour components, and those.
//!
//! The manual asks for big-endian numbers. Files in the wild are little-endian and have no colour components, not even
//! their number. So there are four layouts; the first one that reads the file to its last byte is taken, the manual's
//! first. (Two of them fit the same file only if it is tiny or made for it: every index and count must be in range
//! in both.)

use super::bytes::Bytes;
use super::error::{FilePosition, FormatError, Reason};
use super::faces;
use crate::exchange::{Note, Plc};
use crate::mesh::VertexId;

/// Reads what follows the line of the header, which ends at offset `at`. `extra` bytes follow the coordinates of each
/// vertex.
pub(super) fn read_binary(
    bytes: &[u8],
    at: usize,
    extra: u64,
) -> Result<(Plc, Vec<Note>), FormatError> {
    let layouts = [(true, true), (true, false), (false, true), (false, false)];
    let mut best: Option<FormatError> = None;
    for (big_endian, face_colours) in layouts {
        match read(Bytes::new(bytes, at, big_endian), face_colours, extra) {
            Ok(read) => return Ok(read),
            // The one that makes sense of most of the file.
            Err(error) if best.as_ref().is_none_or(|b| reach(&error) > reach(b)) => {
                best = Some(error);
            }
            Err(_) => {}
        }
    }
    Err(best.expect("every layout was tried"))
}

/// How far a layout could be read.
fn reach(error: &FormatError) -> usize {
    match error {
        FormatError::Malformed {
            at: FilePosition::Byte(at),
            ..
        } => *at,
        _ => 0,
    }
}

fn read(mut bytes: Bytes, face_colours: bool, extra: u64) -> Result<(Plc, Vec<Note>), FormatError> {
    let vertices = count(&mut bytes, "the number of vertices")?;
    let faces = count(&mut bytes, "the number of faces")?;
    count(&mut bytes, "the number of edges")?;
    // Before anything is read: counts of the wrong byte order are large.
    let room = bytes.rest().len() as u64;
    let least = vertices
        .saturating_mul(12 + extra)
        .saturating_add(faces.saturating_mul(16));
    if least > room {
        return Err(bytes.error(Reason::Truncated("the last vertex or face")));
    }
    if vertices == 0 {
        return Err(bytes.error(Reason::NoVertices));
    }
    let mut plc = Plc::default();
    for _ in 0..vertices {
        let mut point = [0.0; 3];
        for x in &mut point {
            *x = bytes.single("a coordinate")?;
        }
        bytes.skip(extra, "a normal or a colour")?;
        plc.vertices.push(point);
    }
    for _ in 0..faces {
        let mut polygon = corners(&mut bytes, vertices)?;
        if faces::open_ring(&mut polygon, &plc.vertices) {
            bytes.forgive_closed_ring();
        }
        plc.facets.push(faces::facet(polygon, 0));
        if face_colours {
            let colours = count(&mut bytes, "the number of colour components")?;
            bytes.skip(4 * colours, "a colour component")?;
        }
    }
    bytes.end()?;
    Ok((plc, bytes.notes()))
}

fn corners(bytes: &mut Bytes, vertices: u64) -> Result<Vec<VertexId>, FormatError> {
    let count = count(bytes, "the number of corners")?;
    if let Some(reason) = faces::too_short(count) {
        return Err(bytes.error(reason));
    }
    let mut polygon = Vec::new();
    for _ in 0..count {
        let index = bytes.int("a corner")?;
        let id = u32::try_from(index).ok();
        let id = id.filter(|&id| u64::from(id) < vertices);
        polygon.push(VertexId(id.ok_or_else(|| {
            bytes.error(Reason::IndexOutOfRange {
                index,
                first: 0,
                last: vertices as i64 - 1,
            })
        })?));
    }
    Ok(polygon)
}

fn count(bytes: &mut Bytes, what: &'static str) -> Result<u64, FormatError> {
    let count = bytes.int(what)?;
    u64::try_from(count).map_err(|_| bytes.error(Reason::NegativeCount { what, count }))
}
