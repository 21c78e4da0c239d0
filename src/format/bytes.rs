//! Numbers of a binary file, with offsets. Nothing is allocated by a count that a file announces.

use super::error::{FilePosition, FormatError, Reason};
use crate::exchange::{Note, NoteCode};

/// A reader of the numbers of a binary file.
#[derive(Clone)]
pub(super) struct Bytes<'a> {
    all: &'a [u8],
    /// The offset of what comes next.
    at: usize,
    /// The offset of the last number.
    last: usize,
    big_endian: bool,
    /// How many polygons ended with their first corner, and the offset of the first.
    closed_rings: (usize, usize),
}

impl<'a> Bytes<'a> {
    /// The bytes of a file from offset `at` on.
    pub fn new(all: &'a [u8], at: usize, big_endian: bool) -> Bytes<'a> {
        Bytes {
            all,
            at,
            last: at,
            big_endian,
            closed_rings: (0, 0),
        }
    }

    /// The next `N` bytes, the most significant one first.
    pub fn take<const N: usize>(&mut self, what: &'static str) -> Result<[u8; N], FormatError> {
        self.last = self.at;
        let Some((bytes, _)) = self.all[self.at..].split_first_chunk::<N>() else {
            self.last = self.all.len();
            return Err(self.error(Reason::Truncated(what)));
        };
        self.at += N;
        let mut bytes = *bytes;
        if !self.big_endian {
            bytes.reverse();
        }
        Ok(bytes)
    }

    /// A finite single, exactly.
    pub fn single(&mut self, what: &'static str) -> Result<f64, FormatError> {
        let x = f32::from_be_bytes(self.take(what)?);
        self.finite(f64::from(x))
    }

    /// A finite double.
    pub fn double(&mut self, what: &'static str) -> Result<f64, FormatError> {
        let x = f64::from_be_bytes(self.take(what)?);
        self.finite(x)
    }

    fn finite(&self, x: f64) -> Result<f64, FormatError> {
        if x.is_finite() {
            Ok(x)
        } else {
            Err(self.error(Reason::NotFinite(x.to_string())))
        }
    }

    /// A signed number of 32 bits.
    pub fn int(&mut self, what: &'static str) -> Result<i64, FormatError> {
        Ok(i64::from(i32::from_be_bytes(self.take(what)?)))
    }

    /// Skips `count` bytes.
    pub fn skip(&mut self, count: u64, what: &'static str) -> Result<(), FormatError> {
        let end = usize::try_from(count)
            .ok()
            .and_then(|count| self.at.checked_add(count))
            .filter(|&end| end <= self.all.len());
        match end {
            Some(end) => {
                (self.last, self.at) = (self.at, end);
                Ok(())
            }
            None => {
                self.last = self.all.len();
                Err(self.error(Reason::Truncated(what)))
            }
        }
    }

    /// Remembers a polygon that ended with its first corner, at the last number.
    pub fn forgive_closed_ring(&mut self) {
        let (count, first) = &mut self.closed_rings;
        if *count == 0 {
            *first = self.last;
        }
        *count += 1;
    }

    /// Notes on what was forgiven.
    pub fn notes(&self) -> Vec<Note> {
        let (count, first) = self.closed_rings;
        if count == 0 {
            return Vec::new();
        }
        let text = format!(
            "{count} polygons end with their first corner and are read without it (the first of them at byte {first})"
        );
        vec![Note::new(NoteCode::ClosedRing, count, text)]
    }

    /// The offset of what comes next.
    pub fn offset(&self) -> usize {
        self.at
    }

    /// The bytes that are left.
    pub fn rest(&self) -> &'a [u8] {
        &self.all[self.at..]
    }

    /// The file ends here, but for line feeds.
    pub fn end(&mut self) -> Result<(), FormatError> {
        let rest = self.rest();
        if rest.iter().all(|b| matches!(b, b'\r' | b'\n')) {
            return Ok(());
        }
        self.last = self.at;
        Err(self.error(Reason::Trailing(format!("{} bytes", rest.len()))))
    }

    /// An error at the last number.
    pub fn error(&self, reason: Reason) -> FormatError {
        FormatError::Malformed {
            at: FilePosition::Byte(self.last),
            reason,
        }
    }
}
