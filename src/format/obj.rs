//! Wavefront OBJ files (*Advanced Visualizer Manual*, appendix B1: Object Files).
//!
//! Read are vertices `v x y z` (a weight or a colour after them is checked to be numbers and ignored), faces
//! `f`, whose corners may be `v`, `v/vt`, `v//vn` or `v/vt/vn` and count from 1, or backwards from the last vertex if
//! negative, and polylines `l`, which become segments. Points `p` are vertices anyway. Groups, materials, normals, texture
//! coordinates and whatever words programs have added are skipped; curves and surfaces are refused, since to skip
//! them would lose geometry. A line that ends with a backslash goes on in the next.
//!
//! Why not the crate `tobj` (4.0): its errors have no place, it joins objects and splits vertices by material and normal,
//! and it does not know continued lines.

use super::error::{FormatError, Place, Reason};
use super::text::Text;
use crate::mesh::VertexId;
use crate::plc::{Facet, Plc, Segment};

/// Reads an OBJ file.
pub fn read_obj(bytes: &[u8]) -> Result<Plc, FormatError> {
    let mut reader = Reader {
        text: Text::new(bytes, true),
        plc: Plc {
            first_index: 1,
            ..Plc::default()
        },
        ahead: None,
    };
    while reader.text.advance() {
        reader.statement()?;
    }
    reader.finish()
}

struct Reader<'a> {
    text: Text<'a>,
    plc: Plc,
    /// The largest index that named a vertex still to come, and its place.
    ahead: Option<(i64, Place)>,
}

impl<'a> Reader<'a> {
    fn statement(&mut self) -> Result<(), FormatError> {
        const CURVES: [&[u8]; 11] = [
            b"cstype", b"curv", b"curv2", b"surf", b"bzp", b"bsp", b"cdc", b"cdp", b"res", b"call",
            b"csh",
        ];
        let Some(keyword) = self.word() else {
            return Ok(());
        };
        match keyword {
            b"v" | b"V" => self.position()?,
            b"f" | b"F" | b"fo" => {
                let polygon = self.corners()?;
                match polygon.len() {
                    0 => return Err(self.text.error(Reason::EmptyFacet)),
                    n @ 1..=2 => return Err(self.text.error(Reason::ShortFace(n as i64))),
                    _ => {}
                }
                self.plc.facets.push(Facet {
                    polygons: vec![polygon],
                    ..Facet::default()
                });
            }
            b"l" | b"L" => {
                let line = self.corners()?;
                if line.len() < 2 {
                    return Err(self
                        .text
                        .error(Reason::LineEnds("the second vertex of a line")));
                }
                let ends = line.windows(2).map(|pair| [pair[0], pair[1]]);
                let segments = ends.map(|ends| Segment { ends, marker: 0 });
                self.plc.segments.extend(segments);
            }
            b"p" | b"P" => {
                self.corners()?;
            }
            _ if CURVES.contains(&keyword) => {
                return Err(self
                    .text
                    .error(Reason::Unsupported("curves and surfaces are")));
            }
            // What is left of a line that was broken.
            _ if matches!(keyword[0], b'0'..=b'9' | b'-' | b'+' | b'.') => {
                return Err(self.text.bad(keyword, "a keyword of an OBJ file"));
            }
            _ => while self.word().is_some() {},
        }
        Ok(())
    }

    /// The next word of the statement.
    fn word(&mut self) -> Option<&'a [u8]> {
        loop {
            let token = self.text.token()?;
            match token.strip_suffix(b"\\") {
                Some(head) if !self.text.has_word() => {
                    self.text.next_line();
                    if !head.is_empty() {
                        return Some(head);
                    }
                }
                _ => return Some(token),
            }
        }
    }

    fn position(&mut self) -> Result<(), FormatError> {
        let mut point = [0.0; 3];
        for x in &mut point {
            let token = self.word();
            let token = token.ok_or_else(|| self.text.error(Reason::LineEnds("a coordinate")))?;
            *x = self.text.real(token)?;
        }
        while let Some(token) = self.word() {
            self.text.number(token)?;
        }
        let count = self.plc.vertices.len() as u64 + 1;
        if count >= u64::from(u32::MAX) {
            return Err(self.text.error(Reason::TooManyVertices(count)));
        }
        self.plc.vertices.push(point);
        Ok(())
    }

    fn corners(&mut self) -> Result<Vec<VertexId>, FormatError> {
        let mut corners = Vec::new();
        while let Some(token) = self.word() {
            corners.push(self.corner(token)?);
        }
        Ok(corners)
    }

    fn corner(&mut self, token: &[u8]) -> Result<VertexId, FormatError> {
        let mut parts = token.split(|&b| b == b'/');
        let first = parts.next().unwrap_or_default();
        let text = &self.text;
        let bad = || text.bad(token, "a corner: v, v/vt, v//vn or v/vt/vn");
        let index = text.integer(first).map_err(|_| bad())?;
        for (i, part) in parts.enumerate() {
            if i == 2 || !part.is_empty() && text.integer(part).is_err() {
                return Err(bad());
            }
        }
        let last = self.plc.vertices.len() as i64;
        let number = if index < 0 { last + 1 + index } else { index };
        if number < 1 || number >= i64::from(u32::MAX) {
            return Err(text.error(Reason::IndexOutOfRange {
                index,
                first: 1,
                last,
            }));
        }
        if number > last && self.ahead.is_none_or(|(far, _)| number > far) {
            self.ahead = Some((number, text.place()));
        }
        Ok(VertexId::new((number - 1) as usize))
    }

    fn finish(self) -> Result<Plc, FormatError> {
        let last = self.plc.vertices.len() as i64;
        if last == 0 {
            return Err(self.text.error(Reason::NoVertices));
        }
        match self.ahead {
            Some((index, place)) if index > last => Err(FormatError::Malformed {
                place,
                reason: Reason::IndexOutOfRange {
                    index,
                    first: 1,
                    last,
                },
            }),
            _ => Ok(self.plc),
        }
    }
}
