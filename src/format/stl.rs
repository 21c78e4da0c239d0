//! STL files, ASCII and binary (3D Systems, *Stereolithography Interface Specification*, 1988).
//!
//! A file is binary iff its size is 84 + 50n, where n is the little-endian number in the bytes 80 to 83. Neither half
//! of this is enough: the header of a binary file may start with `solid`, and an ASCII file can have any size. (An
//! ASCII file has at least 0x09090909 there, so it would have to be larger than 7 GB to be mistaken.)
//!
//! Corners with the same coordinates become one vertex, where −0 = 0. Normals are ignored. Vertices count from 0.
//!
//! Why not the crate `stl_io`: it takes every file that starts with `solid ` for ASCII and every other one for binary,
//! so it misreads binary files with such a header and ASCII files with a blank before it; it reads ASCII coordinates as
//! `f32`; and its errors have no place.

use super::ahead::{Rows, read_aligned};
use super::error::{FormatError, Place, Reason};
use super::text::Text;
use crate::exchange::{Facet, Note, Plc};
use crate::mesh::VertexId;
use rustc_hash::FxHashMap;

const HEADER: usize = 84;
const TRIANGLE: usize = 50;

/// Reads an STL file.
pub fn read_stl(bytes: &[u8]) -> Result<(Plc, Vec<Note>), FormatError> {
    let mut mesh = Merged::default();
    let solid = bytes
        .trim_ascii_start()
        .get(..5)
        .is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    // A NUL byte is no text: a binary file that was cut.
    if binary_size(bytes) == Some(bytes.len() as u64) || !solid || bytes.contains(&0) {
        read_binary(bytes, &mut mesh)?;
    } else {
        read_ascii(bytes, &mut mesh)?;
    }
    if mesh.plc.vertices.is_empty() {
        return Err(FormatError::Malformed {
            place: Place::Byte(bytes.len()),
            reason: Reason::NoVertices,
        });
    }
    Ok((mesh.plc, Vec::new()))
}

/// The size that the header announces.
fn binary_size(bytes: &[u8]) -> Option<u64> {
    let count = bytes.get(HEADER - 4..HEADER)?;
    let count = u32::from_le_bytes(count.try_into().expect("four bytes"));
    Some(HEADER as u64 + TRIANGLE as u64 * u64::from(count))
}

fn read_binary(bytes: &[u8], mesh: &mut Merged) -> Result<(), FormatError> {
    let error = |offset, reason| FormatError::Malformed {
        place: Place::Byte(offset),
        reason,
    };
    let found = bytes.len() as u64;
    let Some(expected) = binary_size(bytes) else {
        return Err(error(bytes.len(), Reason::Truncated("the header")));
    };
    if expected != found {
        let triangles = ((expected - HEADER as u64) / TRIANGLE as u64) as u32;
        let reason = Reason::StlSize {
            triangles,
            expected,
            found,
        };
        return Err(error(HEADER - 4, reason));
    }
    for (i, triangle) in bytes[HEADER..].chunks_exact(TRIANGLE).enumerate() {
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
    Ok(())
}

fn read_ascii(bytes: &[u8], mesh: &mut Merged) -> Result<(), FormatError> {
    let mut text = Text::new(bytes, false);
    // Where lines do not begin with facets, looking ahead is of no use.
    let mut helps = true;
    while mesh.in_solid || text.advance() {
        let begins = !mesh.in_solid;
        statement(&mut text, mesh)?;
        if begins && helps {
            let more = text.rest().len();
            read_aligned(&mut text, u64::MAX, mesh, statement, first_facet);
            helps = text.rest().len() < more;
        }
    }
    Ok(())
}

/// Reads a facet, or that a solid begins or ends. Some writers put several solids into one file.
fn statement(text: &mut Text, mesh: &mut Merged) -> Result<(), FormatError> {
    if !mesh.in_solid {
        keyword(text, &["solid"])?;
        text.skip_line();
        mesh.in_solid = true;
        return Ok(());
    }
    let token = text.anywhere("facet or endsolid")?;
    if token.eq_ignore_ascii_case(b"endsolid") {
        text.skip_line();
        mesh.in_solid = false;
        return Ok(());
    }
    if !token.eq_ignore_ascii_case(b"facet") {
        return Err(text.bad(token, "facet or endsolid"));
    }
    // The normal, which may well be NaN.
    text.skip_line();
    keyword(text, &["outer", "loop"])?;
    let mut corners = [[0.0; 3]; 3];
    for corner in &mut corners {
        keyword(text, &["vertex"])?;
        *corner = text.point()?;
    }
    keyword(text, &["endloop", "endfacet"])?;
    mesh.triangle(corners).map_err(|reason| text.error(reason))
}

/// Where a facet begins, if that is soon.
fn first_facet(bytes: &[u8]) -> usize {
    const LINES: usize = 16;
    let mut text = Text::new(bytes, false);
    for _ in 0..LINES {
        let mut line = text.clone();
        line.next_line();
        let token = line.token().unwrap_or_default();
        if token.eq_ignore_ascii_case(b"facet") {
            break;
        }
        text = line;
    }
    bytes.len() - text.rest().len()
}

fn keyword(text: &mut Text, words: &[&'static str]) -> Result<(), FormatError> {
    for &word in words {
        let token = text.anywhere(word)?;
        if !token.eq_ignore_ascii_case(word.as_bytes()) {
            return Err(text.bad(token, word));
        }
    }
    Ok(())
}

/// A PLC of triangles, and its vertices by coordinates.
#[derive(Default)]
struct Merged {
    plc: Plc,
    ids: FxHashMap<[u64; 3], VertexId>,
    /// In a text: whether a solid has begun and not ended.
    in_solid: bool,
    /// In the middle of a text: the triangles, to be merged with those before.
    loose: Option<Vec<[[f64; 3]; 3]>>,
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
        let loose = self.loose.as_ref().map_or(0, Vec::len);
        (self.plc.facets.len() + loose) as u64
    }

    fn append(&mut self, next: Merged) -> bool {
        let triangles = next.loose.unwrap_or_default();
        let vertices = self.plc.vertices.len() + 3 * triangles.len();
        if !self.in_solid || vertices >= u32::MAX as usize {
            return false;
        }
        triangles.into_iter().for_each(|corners| self.add(corners));
        self.in_solid = next.in_solid;
        true
    }
}

impl Merged {
    fn triangle(&mut self, corners: [[f64; 3]; 3]) -> Result<(), Reason> {
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
}
