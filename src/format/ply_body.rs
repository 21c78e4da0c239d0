//! What follows the header of a PLY file: numbers, as text or binary.

use super::bytes::Bytes;
use super::error::{FormatError, Reason};
use super::ply_header::{Role, Type};
use super::text::Text;
use crate::exchange::NoteCode;
use crate::mesh::VertexId;

/// What follows the header.
pub(super) enum Body<'t, 'a> {
    /// One element per line.
    Lines(&'t mut Text<'a>),
    /// Elements whose words may be on any lines.
    Words(&'t mut Text<'a>),
    Binary(Bytes<'a>),
}

impl<'a> Body<'_, 'a> {
    /// Goes to the next element.
    pub fn begin(&mut self, role: Role) -> Result<(), FormatError> {
        match self {
            Body::Lines(text) => text.begin(match role {
                Role::Vertex => "a vertex",
                Role::Face => "a face",
                Role::Edge => "an edge",
                Role::Strips => "a strip",
                Role::Other => "an element",
            }),
            Body::Words(_) | Body::Binary(_) => Ok(()),
        }
    }

    pub fn real(&mut self, kind: Type) -> Result<f64, FormatError> {
        const WHAT: &str = "a coordinate";
        if let Body::Binary(bytes) = self {
            return match kind {
                Type::F32 => bytes.single(WHAT),
                Type::F64 => bytes.double(WHAT),
                // More than 53 bits are rounded, as they are in a text.
                _ => Ok(whole(bytes, kind, WHAT)? as f64),
            };
        }
        let (text, token) = self.token(WHAT)?;
        text.real(token)
    }

    pub fn integer(&mut self, kind: Type, what: &'static str) -> Result<i64, FormatError> {
        if let Body::Binary(bytes) = self {
            return whole(bytes, kind, what);
        }
        let (text, token) = self.token(what)?;
        text.integer(token)
    }

    /// The text and its next word.
    fn token(&mut self, what: &'static str) -> Result<(&mut Text<'a>, &'a [u8]), FormatError> {
        match self {
            Body::Lines(text) => {
                let token = text.here(what)?;
                Ok((text, token))
            }
            Body::Words(text) => {
                let token = text.anywhere(what)?;
                Ok((text, token))
            }
            Body::Binary(bytes) => Err(bytes.error(Reason::Truncated(what))),
        }
    }

    pub fn count(&mut self, kind: Type, what: &'static str) -> Result<u64, FormatError> {
        let count = self.integer(kind, what)?;
        u64::try_from(count).map_err(|_| self.error(Reason::NegativeCount { what, count }))
    }

    pub fn vertex(&mut self, kind: Type, vertices: u64) -> Result<VertexId, FormatError> {
        let index = self.integer(kind, "a vertex")?;
        self.id(index, vertices)
    }

    /// A vertex, or none for −1.
    pub fn vertex_or_end(
        &mut self,
        kind: Type,
        vertices: u64,
    ) -> Result<Option<VertexId>, FormatError> {
        match self.integer(kind, "a vertex")? {
            -1 => Ok(None),
            index => self.id(index, vertices).map(Some),
        }
    }

    fn id(&self, index: i64, vertices: u64) -> Result<VertexId, FormatError> {
        let id = u32::try_from(index).map(VertexId);
        id.ok()
            .filter(|&id| u64::from(id.0) < vertices)
            .ok_or_else(|| {
                self.error(Reason::IndexOutOfRange {
                    index,
                    first: 0,
                    last: vertices as i64 - 1,
                })
            })
    }

    /// Skips numbers of no use to us.
    pub fn skip(&mut self, count: u64, kind: Type) -> Result<(), FormatError> {
        const WHAT: &str = "a property";
        if let Body::Binary(bytes) = self {
            return bytes.skip(count.saturating_mul(kind.size()), WHAT);
        }
        (0..count).try_for_each(|_| self.token(WHAT).map(|_| ()))
    }

    /// The element ends.
    pub fn end(&mut self) -> Result<(), FormatError> {
        match self {
            Body::Lines(text) => text.end_line(),
            Body::Words(_) | Body::Binary(_) => Ok(()),
        }
    }

    /// Remembers a polygon that ended with its first corner.
    pub fn forgive_closed_ring(&mut self) {
        match self {
            Body::Lines(text) | Body::Words(text) => text.forgive(NoteCode::ClosedRing),
            Body::Binary(bytes) => bytes.forgive_closed_ring(),
        }
    }

    pub fn error(&self, reason: Reason) -> FormatError {
        match self {
            Body::Lines(text) | Body::Words(text) => text.error(reason),
            Body::Binary(bytes) => bytes.error(reason),
        }
    }
}

/// A whole number. Only reals have other types, and they are not asked for as whole numbers.
fn whole(bytes: &mut Bytes, kind: Type, what: &'static str) -> Result<i64, FormatError> {
    Ok(match kind {
        Type::I8 => i64::from(i8::from_be_bytes(bytes.take(what)?)),
        Type::U8 => i64::from(u8::from_be_bytes(bytes.take(what)?)),
        Type::I16 => i64::from(i16::from_be_bytes(bytes.take(what)?)),
        Type::U16 => i64::from(u16::from_be_bytes(bytes.take(what)?)),
        Type::I32 => i64::from(i32::from_be_bytes(bytes.take(what)?)),
        Type::U32 => i64::from(u32::from_be_bytes(bytes.take(what)?)),
        Type::I64 => i64::from_be_bytes(bytes.take(what)?),
        Type::U64 => {
            let number = u64::from_be_bytes(bytes.take(what)?);
            let too_large = || Reason::BadToken {
                token: number.to_string(),
                expected: "a whole number below 2^63",
            };
            i64::try_from(number).map_err(|_| bytes.error(too_large()))?
        }
        Type::F32 | Type::F64 => unreachable!("the header has been checked"),
    })
}
