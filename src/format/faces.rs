//! What the faces of all formats have in common: corners that are vertices, and rings that are closed by hand.

use super::error::{FormatError, Reason};
use super::text::Text;
use crate::exchange::{Facet, NoteCode};
use crate::mesh::VertexId;

/// The vertex with the given number in a file whose vertices are numbered from `first`.
pub(super) fn vertex(
    text: &Text,
    token: &[u8],
    first: u32,
    count: usize,
) -> Result<VertexId, FormatError> {
    let index = text.integer(token)?;
    let first = i64::from(first);
    let last = first + count as i64 - 1;
    if (first..=last).contains(&index) {
        Ok(VertexId::new((index - first) as usize))
    } else {
        Err(text.error(Reason::IndexOutOfRange { index, first, last }))
    }
}

/// Why a face cannot have so many corners, if it cannot.
pub(super) fn too_short(corners: u64) -> Option<Reason> {
    match corners {
        0 => Some(Reason::EmptyFacet),
        1 | 2 => Some(Reason::ShortFace(corners as i64)),
        _ => None,
    }
}

/// A facet of one polygon without holes.
pub(super) fn facet(polygon: Vec<VertexId>, marker: i64) -> Facet {
    Facet {
        polygons: vec![polygon],
        marker,
        ..Facet::default()
    }
}

/// Drops the last corner if it is the first one again, by its number or its coordinates, and others are enough. Whether
/// that was so.
pub(super) fn open_ring(polygon: &mut Vec<VertexId>, vertices: &[[f64; 3]]) -> bool {
    let &mut [first, _, _, .., last] = &mut polygon[..] else {
        return false;
    };
    let point = |v: VertexId| vertices.get(v.index());
    let closed = first == last || point(first).is_some_and(|p| Some(p) == point(last));
    if closed {
        polygon.pop();
    }
    closed
}

/// The same in a text, with a note.
pub(super) fn open_ring_noted(text: &mut Text, polygon: &mut Vec<VertexId>, vertices: &[[f64; 3]]) {
    if open_ring(polygon, vertices) {
        text.forgive(NoteCode::ClosedRing);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rings_are_opened_once() {
        let vertices = [[0.0; 3], [1.0; 3], [2.0; 3], [0.0, -0.0, 0.0]];
        let opened = |ids: &[u32]| {
            let mut polygon: Vec<VertexId> = ids.iter().copied().map(VertexId).collect();
            let closed = open_ring(&mut polygon, &vertices);
            assert_eq!(closed, polygon.len() < ids.len());
            polygon.len()
        };
        assert_eq!(opened(&[0, 1, 2, 0]), 3);
        assert_eq!(opened(&[0, 1, 2, 3]), 3);
        assert_eq!(opened(&[0, 1, 2, 0, 0]), 4);
        // What is left would be no polygon, or is degenerate otherwise: not for a reader to mend.
        assert_eq!(opened(&[0, 1, 0]), 3);
        assert_eq!(opened(&[0, 1, 1, 2]), 4);
    }
}
