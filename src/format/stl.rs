//! STL files, ASCII and binary (3D Systems, *Stereolithography Interface Specification*, 1988).
//!
//! A file is binary if its size is 84 + 50n, where n is the little-endian number in the bytes 80 to 83, or if it is
//! not text: if there is a NUL byte in it (not only at its end), or if it begins with neither `solid` nor `facet`.
//! (The header of a binary file may start with `solid`, and an ASCII file can have any size. An ASCII file has at
//! least 0x09090909 there, so it would have to be larger than 7 GB to be mistaken.)
//!
//! Corners with the same coordinates become one vertex, where −0 = 0. Normals are ignored. Vertices count from 0. If
//! there are several solids with triangles in a file, their triangles have the markers 1, 2, …, with the names of the
//! solids; those of a single solid have the marker 0.
//!
//! Forgiven: `end solid` and the like in two words; missing `endloop`, `endfacet`, `endsolid` and first `solid`;
//! comments where a keyword would stand; bytes after the last triangle of a binary file that are not one more
//! triangle: fewer than 50, or text, or all the same. An error are a binary file that is too short, because it was
//! cut, one with more triangles than it says, and loops of more than three vertices.
//!
//! Why not the crate `stl_io`: it takes every file that starts with `solid ` for ASCII and every other one for
//! binary, so it misreads binary files with such a header and ASCII files with a blank before it; it reads ASCII
//! coordinates as `f32`; and its errors have no place.

use super::ahead::Rows;
use super::error::{FilePosition, FormatError, Reason};
use super::stl_ascii::read_ascii;
use super::stl_binary::{announced_size, read_binary};
use super::text::{Syntax, Text};
use crate::exchange::{Facet, Note, Plc};
use crate::mesh::VertexId;
use rustc_hash::FxHashMap;

/// Reads an STL file.
///
/// # Errors
/// If it is malformed, or has no triangles.
pub fn read_stl(bytes: &[u8]) -> Result<(Plc, Vec<Note>), FormatError> {
    let mut mesh = Merged::default();
    let notes = if is_text(bytes) {
        read_ascii(bytes, &mut mesh)?
    } else {
        read_binary(bytes, &mut mesh)?
    };
    if mesh.plc.vertices.is_empty() {
        return Err(FormatError::Malformed {
            at: FilePosition::Byte(bytes.len()),
            reason: Reason::NoVertices,
        });
    }
    Ok((mesh.finish(), notes))
}

fn is_text(bytes: &[u8]) -> bool {
    let mut text = Text::new(bytes, Syntax::Plain);
    let used = &bytes[..text.end(bytes.len())];
    // A NUL byte is no text: a binary file that was cut.
    if announced_size(bytes) == Some(bytes.len() as u64) || used.contains(&0) {
        return false;
    }
    text.advance();
    let word = text.token().unwrap_or_default();
    let begins = |with: &[u8]| {
        word.get(..5)
            .is_some_and(|head| head.eq_ignore_ascii_case(with))
    };
    begins(b"solid") || begins(b"facet")
}

/// A PLC of triangles, and its vertices by coordinates.
#[derive(Default)]
pub(super) struct Merged {
    plc: Plc,
    ids: FxHashMap<[u64; 3], VertexId>,
    /// In a text: whether a solid has begun and not ended.
    pub in_solid: bool,
    /// In the middle of a text: the triangles, to be merged with those before.
    loose: Option<Vec<[[f64; 3]; 3]>>,
    /// How many triangles there are before a solid begins, and its name.
    solids: Vec<(usize, String)>,
}

impl Rows for Merged {
    /// Begins with a facet.
    fn piece(&self) -> Merged {
        Merged {
            in_solid: true,
            loose: Some(Vec::new()),
            ..Merged::default()
        }
    }

    fn len(&self) -> u64 {
        self.count() as u64
    }

    fn append(&mut self, next: Merged) -> bool {
        let triangles = next.loose.unwrap_or_default();
        let vertices = self.plc.vertices.len() + 3 * triangles.len();
        if !self.in_solid || vertices >= u32::MAX as usize {
            return false;
        }
        let before = self.count();
        let solids = next.solids.into_iter();
        self.solids
            .extend(solids.map(|(at, name)| (before + at, name)));
        triangles.into_iter().for_each(|corners| self.add(corners));
        self.in_solid = next.in_solid;
        true
    }
}

impl Merged {
    fn count(&self) -> usize {
        self.plc.facets.len() + self.loose.as_ref().map_or(0, Vec::len)
    }

    /// Whether there may be more triangles than those of this text.
    pub fn is_piece(&self) -> bool {
        self.loose.is_some()
    }

    /// A solid begins.
    pub fn begin_solid(&mut self, name: String) {
        self.in_solid = true;
        self.solids.push((self.count(), name));
    }

    pub fn triangle(&mut self, corners: [[f64; 3]; 3]) -> Result<(), Reason> {
        let count = self.plc.vertices.len() as u64 + 3;
        if count >= u64::from(u32::MAX) {
            return Err(Reason::TooManyVertices(count));
        }
        match &mut self.loose {
            None => self.add(corners),
            Some(loose) => loose.push(corners),
        }
        Ok(())
    }

    fn add(&mut self, corners: [[f64; 3]; 3]) {
        let polygon = corners.map(|point| {
            // −0 + 0 = 0
            let key = point.map(|x| (x + 0.0).to_bits());
            *self.ids.entry(key).or_insert_with(|| {
                self.plc.vertices.push(point);
                VertexId::new(self.plc.vertices.len() - 1)
            })
        });
        self.plc.facets.push(Facet {
            polygons: vec![polygon.to_vec()],
            ..Facet::default()
        });
    }

    /// The PLC, with markers if several solids have triangles.
    fn finish(mut self) -> Plc {
        let all = self.plc.facets.len();
        let ends = self.solids.iter().skip(1).map(|&(at, _)| at).chain([all]);
        let ends: Vec<usize> = ends.collect();
        let solids = self.solids.into_iter().zip(ends);
        let solids: Vec<_> = solids.filter(|((start, _), end)| start < end).collect();
        if solids.len() > 1 {
            for (marker, ((start, name), end)) in (1..).zip(solids) {
                let facets = &mut self.plc.facets[start..end];
                facets.iter_mut().for_each(|facet| facet.marker = marker);
                self.plc.marker_names.push((marker, name));
            }
        }
        self.plc
    }
}
