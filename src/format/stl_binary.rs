//! Binary STL files: a header of 80 bytes, the number of triangles, and 50 bytes for each.

use super::error::{FilePosition, FormatError, Reason};
use super::stl::Merged;
use crate::exchange::{Note, NoteCode};

const HEADER: usize = 84;
const TRIANGLE: usize = 50;

/// The size that the header announces.
pub(super) fn announced_size(bytes: &[u8]) -> Option<u64> {
    let count = bytes.get(HEADER - 4..HEADER)?;
    let count = u32::from_le_bytes(count.try_into().expect("four bytes"));
    Some(HEADER as u64 + TRIANGLE as u64 * u64::from(count))
}

/// Reads the triangles.
pub(super) fn read_binary(bytes: &[u8], mesh: &mut Merged) -> Result<Vec<Note>, FormatError> {
    let error = |offset, reason| FormatError::Malformed {
        at: FilePosition::Byte(offset),
        reason,
    };
    let found = bytes.len() as u64;
    let Some(expected) = announced_size(bytes) else {
        return Err(error(bytes.len(), Reason::Truncated("the header")));
    };
    let announced = (expected - HEADER as u64) / TRIANGLE as u64;
    let fits = match bytes.get(expected as usize..) {
        Some([]) => true,
        Some(rest) => announced > 0 && says_nothing(rest, TRIANGLE),
        None => false,
    };
    if !fits {
        let reason = Reason::StlSize {
            triangles: announced as u32,
            expected,
            found,
        };
        return Err(error(HEADER - 4, reason));
    }
    let (triangles, rest) = bytes.split_at(expected as usize);
    for (i, triangle) in triangles[HEADER..].chunks_exact(TRIANGLE).enumerate() {
        let mut numbers = [0.0; 9];
        // The first twelve bytes are the normal, the last two have no settled meaning.
        for (k, (x, raw)) in numbers
            .iter_mut()
            .zip(triangle[12..].chunks_exact(4))
            .enumerate()
        {
            let value = f32::from_le_bytes(raw.try_into().expect("four bytes"));
            if !value.is_finite() {
                let offset = HEADER + i * TRIANGLE + 12 + 4 * k;
                return Err(error(offset, Reason::NotFinite(value.to_string())));
            }
            *x = f64::from(value);
        }
        let [ax, ay, az, bx, by, bz, cx, cy, cz] = numbers;
        mesh.triangle([[ax, ay, az], [bx, by, bz], [cx, cy, cz]])
            .map_err(|reason| error(HEADER + i * TRIANGLE, reason))?;
    }
    Ok(trailing(rest, triangles.len(), "triangle"))
}

/// Whether bytes after the end of a binary file are no data: fewer than an element takes, or text, or all the same.
pub(super) fn says_nothing(rest: &[u8], element: usize) -> bool {
    let is_text = |b: &u8| b.is_ascii_graphic() || b.is_ascii_whitespace();
    rest.len() < element || rest.iter().all(is_text) || rest.iter().all(|b| *b == rest[0])
}

/// A note on bytes that follow the last element.
pub(super) fn trailing(rest: &[u8], at: usize, last: &str) -> Vec<Note> {
    let count = rest.len();
    if count == 0 {
        return Vec::new();
    }
    let bytes = if count == 1 {
        "byte follows"
    } else {
        "bytes follow"
    };
    let text = format!("{count} {bytes} the last {last}, from byte {at} on, and are ignored");
    vec![Note::new(NoteCode::TrailingData, count, text)]
}
