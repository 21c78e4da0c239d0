//! Wavefront OBJ files (*Advanced Visualizer Manual*, appendix B1: Object Files).
//!
//! Read are vertices `v x y z` (a weight or a colour after them is checked to be numbers and ignored), faces
//! `f`, whose corners may be `v`, `v/vt`, `v//vn` or `v/vt/vn` and count from 1, or backwards from the last vertex if
//! negative, and polylines `l`, which become segments. Points `p` are vertices anyway. Normals, texture coordinates and
//! whatever words programs have added are skipped; curves and surfaces are refused, since to skip
//! them would lose geometry. A line that ends with a backslash goes on in the next.
//!
//! Faces and lines of different objects `o`, groups `g` or materials `usemtl` have different markers; see
//! [`super::labels`].
//!
//! Why not the crate `tobj` (4.0): its errors have no place, it joins objects and splits vertices by material and
//! normal, and it does not know continued lines.

use super::ahead::{Rows, read_ahead};
use super::error::{FilePosition, FormatError, Reason};
use super::faces;
use super::labels::{Label, Labels};
use super::text::{Syntax, Text};
use crate::exchange::{Facet, Note, NoteCode, Plc, Segment};
use crate::mesh::VertexId;

/// Reads an OBJ file.
///
/// # Errors
/// If it is malformed, or has curves or surfaces.
pub fn read_obj(bytes: &[u8]) -> Result<(Plc, Vec<Note>), FormatError> {
    let mut text = Text::new(bytes, Syntax::Hash);
    let mut objects = Objects::default();
    read_ahead(&mut text, u64::MAX, &mut objects, statement);
    while text.advance() {
        statement(&mut text, &mut objects)?;
    }
    let plc = finish(&text, objects)?;
    Ok((plc, text.into_notes()))
}

/// What statements come to.
#[derive(Default)]
struct Objects {
    vertices: Vec<[f64; 3]>,
    facets: Vec<Facet>,
    segments: Vec<Segment>,
    labels: Labels,
    /// The largest index that named a vertex still to come, and its place.
    ahead: Option<(i64, FilePosition)>,
    /// Whether there are statements before them, so that vertices cannot be counted backwards.
    is_piece: bool,
    /// Whether the last statement of a piece goes on after it.
    is_cut: bool,
}

impl Rows for Objects {
    fn piece(&self) -> Objects {
        Objects {
            is_piece: true,
            ..Objects::default()
        }
    }

    fn len(&self) -> u64 {
        (self.vertices.len() + self.facets.len() + self.segments.len()) as u64
    }

    fn append(&mut self, next: Objects) -> bool {
        let vertices = self.vertices.len() + next.vertices.len();
        // That a vertex is still to come has to be remembered with its line.
        let is_ahead = |(index, _)| index > vertices as i64;
        if vertices >= u32::MAX as usize || next.ahead.is_some_and(is_ahead) {
            return false;
        }
        self.labels
            .append([self.facets.len(), self.segments.len()], next.labels);
        self.vertices.extend(next.vertices);
        self.facets.extend(next.facets);
        self.segments.extend(next.segments);
        true
    }
}

fn statement(text: &mut Text, objects: &mut Objects) -> Result<(), FormatError> {
    Reader { text, objects }.statement()
}

fn finish(text: &Text, objects: Objects) -> Result<Plc, FormatError> {
    let last = objects.vertices.len() as i64;
    if last == 0 {
        return Err(text.error(Reason::NoVertices));
    }
    match objects.ahead {
        Some((index, at)) if index > last => Err(FormatError::Malformed {
            at,
            reason: Reason::IndexOutOfRange {
                index,
                first: 1,
                last,
            },
        }),
        _ => {
            let mut plc = Plc {
                first_index: 1,
                vertices: objects.vertices,
                facets: objects.facets,
                segments: objects.segments,
                ..Plc::default()
            };
            objects.labels.mark(&mut plc);
            Ok(plc)
        }
    }
}

struct Reader<'t, 'a> {
    text: &'t mut Text<'a>,
    objects: &'t mut Objects,
}

impl<'a> Reader<'_, 'a> {
    fn statement(&mut self) -> Result<(), FormatError> {
        const CURVES: [&[u8]; 11] = [
            b"cstype", b"curv", b"curv2", b"surf", b"bzp", b"bsp", b"cdc", b"cdp", b"res", b"call",
            b"csh",
        ];
        let Some(keyword) = self.word() else {
            return self.end();
        };
        match keyword {
            b"v" | b"V" => self.position()?,
            b"f" | b"F" | b"fo" => self.face()?,
            b"l" | b"L" => {
                let line = self.corners()?;
                if line.len() < 2 {
                    return Err(self
                        .text
                        .error(Reason::LineEnds("the second vertex of a line")));
                }
                let ends = line.windows(2).map(|pair| [pair[0], pair[1]]);
                let segments = ends.map(|ends| Segment { ends, marker: 0 });
                self.objects.segments.extend(segments);
            }
            b"p" | b"P" => {
                self.corners()?;
            }
            b"o" | b"O" => self.label(Label::Object),
            b"g" | b"G" => self.label(Label::Group),
            b"usemtl" => self.label(Label::Material),
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
        self.end()
    }

    /// The statement is whole.
    fn end(&self) -> Result<(), FormatError> {
        match self.objects.is_cut {
            true => Err(self.text.error(Reason::Truncated("a statement"))),
            false => Ok(()),
        }
    }

    /// The next word of the statement.
    fn word(&mut self) -> Option<&'a [u8]> {
        loop {
            let token = self.text.token()?;
            match token.strip_suffix(b"\\") {
                Some(head) if !self.text.has_word() => {
                    self.objects.is_cut |= !self.text.next_line() && self.objects.is_piece;
                    if !head.is_empty() {
                        return Some(head);
                    }
                }
                _ => return Some(token),
            }
        }
    }

    /// The words that are left are the name of what follows.
    fn label(&mut self, kind: Label) {
        let mut name = Vec::new();
        while let Some(word) = self.word() {
            name.push(String::from_utf8_lossy(word));
        }
        let at = [self.objects.facets.len(), self.objects.segments.len()];
        self.objects.labels.begin(at, kind, &name.join(" "));
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
        let count = self.objects.vertices.len() as u64 + 1;
        if count >= u64::from(u32::MAX) {
            return Err(self.text.error(Reason::TooManyVertices(count)));
        }
        self.objects.vertices.push(point);
        Ok(())
    }

    fn face(&mut self) -> Result<(), FormatError> {
        let mut polygon = self.corners()?;
        if let Some(reason) = faces::too_short(polygon.len() as u64) {
            return Err(self.text.error(reason));
        }
        // By numbers alone: in a piece of the file coordinates are not known.
        if faces::open_ring(&mut polygon, &[]) {
            self.text.forgive(NoteCode::ClosedRing);
        }
        self.objects.facets.push(faces::facet(polygon, 0));
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
        let text = &*self.text;
        let bad = || text.bad(token, "a corner: v, v/vt, v//vn or v/vt/vn");
        let index = text.integer(first).map_err(|_| bad())?;
        for (i, part) in parts.enumerate() {
            if i == 2 || !part.is_empty() && text.integer(part).is_err() {
                return Err(bad());
            }
        }
        let last = self.objects.vertices.len() as i64;
        if index < 0 && self.objects.is_piece {
            return Err(bad());
        }
        let number = if index < 0 { last + 1 + index } else { index };
        if number < 1 || number >= i64::from(u32::MAX) {
            return Err(text.error(Reason::IndexOutOfRange {
                index,
                first: 1,
                last,
            }));
        }
        if number > last && self.objects.ahead.is_none_or(|(far, _)| number > far) {
            self.objects.ahead = Some((number, text.position()));
        }
        Ok(VertexId::new((number - 1) as usize))
    }
}
