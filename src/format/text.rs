//! Words and numbers of a text file, with line numbers.
//!
//! Lines end with LF, CRLF or CR; lines without a word are skipped. A comment runs from `#` to the end of its line
//! (but in STL and PLY). Nothing is allocated by a count that a file announces.
//!
//! Forgiven, each with a note that names the lines:
//! - a comma after a number, or before it, if there is a blank on the other side or if the whole line has commas and
//!   no blanks between its fields. Any other comma within a word is an error, because it is more likely a decimal one;
//! - exponents as Fortran writes them, `1.5D+00`;
//! - comments from `!`, `//` or, in STL and PLY, `#`, where a word would begin;
//! - NUL and control-Z bytes at the end of the file, as old systems leave them.

use super::error::{FilePosition, FormatError, Reason};
use super::forgiven::Forgiven;
use super::numerals::{fortran, has_decimal_comma, is_separated_by_commas, shorten, whole};
use crate::exchange::{Note, NoteCode};

/// A reader of the words of a text file.
#[derive(Clone)]
pub(super) struct Text<'a> {
    /// What follows the current line.
    rest: &'a [u8],
    /// The current line.
    whole: &'a [u8],
    /// What is left of the current line.
    line: &'a [u8],
    /// The number of the current line, from 1.
    number: usize,
    /// How many bytes at the end of the file say nothing.
    padding: usize,
    syntax: Syntax,
    forgiven: Forgiven,
}

/// What is a comment.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Syntax {
    /// From `#` to the end of the line, wherever it stands.
    Hash,
    /// Nothing.
    Plain,
    /// What is in braces on one line.
    Braces,
}

/// What a byte is where a word begins or ends.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd)]
enum Class {
    /// A part of a word.
    Word,
    /// A part of a word, but the beginning of a comment if a word would begin.
    Comment,
    Comma,
    Blank,
}

const CLASSES: [Class; 256] = {
    let mut classes = [Class::Word; 256];
    let mut i = 0;
    while i < 256 {
        classes[i] = match i as u8 {
            b'#' | b'!' | b'/' | b'{' => Class::Comment,
            b',' => Class::Comma,
            b if b.is_ascii_whitespace() => Class::Blank,
            _ => Class::Word,
        };
        i += 1;
    }
    classes
};

fn class(byte: u8) -> Class {
    CLASSES[usize::from(byte)]
}

impl<'a> Text<'a> {
    /// Before the first line. A UTF-8 byte order mark is skipped.
    pub fn new(bytes: &'a [u8], syntax: Syntax) -> Text<'a> {
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        let used = bytes.iter().rposition(|b| !matches!(b, 0 | 0x1a));
        let rest = &bytes[..used.map_or(0, |last| last + 1)];
        Text {
            rest,
            whole: &[],
            line: &[],
            number: 0,
            padding: bytes.len() - rest.len(),
            syntax,
            forgiven: Forgiven::default(),
        }
    }

    /// Before the first line of a piece of the file, from which its lines are counted.
    pub fn piece(&self, bytes: &'a [u8]) -> Text<'a> {
        Text {
            rest: bytes,
            whole: &[],
            line: &[],
            number: 0,
            padding: 0,
            syntax: self.syntax,
            forgiven: Forgiven::default(),
        }
    }

    /// Goes to the end of a piece of the file that was read for itself.
    pub fn skip_piece(&mut self, bytes: usize, piece: Text<'a>) {
        self.forgiven.append(self.number, piece.forgiven);
        self.rest = &self.rest[bytes..];
        self.line = &[];
        self.number += piece.number;
    }

    /// Remembers that something on the current line is forgiven.
    pub fn forgive(&mut self, code: NoteCode) {
        self.forgiven.add(code, self.number.max(1));
    }

    /// The same, with what it is called.
    pub fn forgive_named(&mut self, code: NoteCode, name: String) {
        self.forgiven.add_named(code, self.number.max(1), name);
    }

    /// The same of a line that is behind, but not before one of an earlier call for the kind.
    pub fn forgive_line(&mut self, code: NoteCode, line: usize) {
        self.forgiven.add(code, line);
    }

    /// The same, with what it is called.
    pub fn forgive_at(&mut self, code: NoteCode, line: usize, name: String) {
        self.forgiven.add_named(code, line, name);
    }

    /// Notes on what was forgiven in the whole file.
    pub fn into_notes(mut self) -> Vec<Note> {
        if self.padding > 0 {
            self.forgive(NoteCode::TrailingData);
        }
        self.forgiven.into_notes()
    }

    /// Notes on what was forgiven in what was read, where the rest of the file is no text.
    pub fn into_notes_of_header(self) -> Vec<Note> {
        self.forgiven.into_notes()
    }

    /// Where the text of a file of so many bytes ends.
    pub fn end(&self, size: usize) -> usize {
        size - self.padding
    }

    /// How many bytes of the file, which has so many, are behind.
    pub fn offset(&self, size: usize) -> usize {
        size - self.padding - self.rest.len()
    }

    /// Goes to the next line that has a word; false at the end of the file.
    pub fn advance(&mut self) -> bool {
        while self.next_line() {
            if self.has_word() {
                return true;
            }
        }
        false
    }

    /// Goes to the next line, blank or not; false at the end of the file.
    pub fn next_line(&mut self) -> bool {
        if self.rest.is_empty() {
            self.line = &[];
            return false;
        }
        let stop = |b: &u8| matches!(b, b'\n' | b'\r' | b'#');
        let length = self.rest.iter().position(stop).unwrap_or(self.rest.len());
        let (mut line, mut tail) = self.rest.split_at(length);
        if let [b'#', ..] = tail {
            let end = |b: &u8| matches!(b, b'\n' | b'\r');
            let more = tail.iter().position(end).unwrap_or(tail.len());
            tail = &tail[more..];
            if self.syntax != Syntax::Hash {
                line = &self.rest[..length + more];
            }
        }
        self.rest = match tail {
            [b'\r', b'\n', rest @ ..] | [_, rest @ ..] => rest,
            [] => &[],
        };
        self.number += 1;
        self.whole = line;
        self.line = line;
        true
    }

    /// Whether the current line has one more word. Blanks and comments before it are dropped.
    pub fn has_word(&mut self) -> bool {
        loop {
            let line = self.line;
            let start = line.iter().position(|&b| class(b) != Class::Blank);
            let Some(start) = start else {
                self.line = &[];
                return false;
            };
            self.line = &line[start..];
            if class(line[start]) == Class::Word || !self.skip_special() {
                return true;
            }
        }
    }

    /// Skips a comment, or a comma before a number; false if a word begins.
    #[cold]
    fn skip_special(&mut self) -> bool {
        let line = self.line;
        match line {
            [b'#' | b'!', ..] | [b'/', b'/', ..] => {
                self.forgive(NoteCode::ForeignComment);
                self.line = &[];
            }
            [b'{', ..] if self.syntax == Syntax::Braces => {
                let Some(end) = line.iter().position(|&b| b == b'}') else {
                    return false;
                };
                self.line = &line[end + 1..];
            }
            // Not two commas, nor one where the line begins: something is missing.
            [b',', rest @ ..] => {
                let before = &self.whole[..self.whole.len() - line.len()];
                if matches!(before.trim_ascii_end().last(), None | Some(b',')) {
                    return false;
                }
                self.forgive(NoteCode::CommaSeparator);
                self.line = rest;
            }
            _ => return false,
        }
        true
    }

    /// The number of the current line, from 1.
    pub fn number_of_line(&self) -> usize {
        self.number
    }

    /// What is left of the current line.
    pub fn line(&self) -> &'a [u8] {
        self.line
    }

    /// What follows the current line.
    pub fn rest(&self) -> &'a [u8] {
        self.rest
    }

    /// Goes to the next line that has a word.
    pub fn begin(&mut self, what: &'static str) -> Result<(), FormatError> {
        if self.advance() {
            Ok(())
        } else {
            Err(self.error(Reason::Truncated(what)))
        }
    }

    /// Drops the rest of the current line.
    pub fn skip_line(&mut self) {
        self.line = &[];
    }

    /// Goes on within the current line, after so many more of its bytes.
    pub fn skip_in_line(&mut self, bytes: usize) {
        self.line = &self.line[bytes..];
    }

    /// The next word of the current line.
    pub fn token(&mut self) -> Option<&'a [u8]> {
        if !self.has_word() {
            return None;
        }
        let line = self.line;
        let end = line.iter().position(|&b| class(b) >= Class::Comma);
        let (token, rest) = line.split_at(end.unwrap_or(line.len()));
        self.line = rest;
        if let [b',', ..] = rest {
            return Some(self.before_comma(line, token));
        }
        Some(token)
    }

    /// The word that begins a part of the line, and has a comma after it or within it.
    #[cold]
    fn before_comma(&mut self, line: &'a [u8], token: &'a [u8]) -> &'a [u8] {
        let rest = &self.line[1..];
        let is_end = rest.first().is_none_or(|&b| class(b) == Class::Blank);
        if !token.is_empty() && (is_end || is_separated_by_commas(self.whole)) {
            self.forgive(NoteCode::CommaSeparator);
            self.line = rest;
            return token;
        }
        let end = line.iter().position(|&b| class(b) == Class::Blank);
        let (word, rest) = line.split_at(end.unwrap_or(line.len()));
        self.line = rest;
        word
    }

    /// Whether nothing but commas, without blanks, stands between the fields of the current line.
    pub fn is_separated_by_commas(&self) -> bool {
        self.forgiven.is_on(NoteCode::CommaSeparator, self.number)
            && is_separated_by_commas(self.whole)
    }

    /// Where the reading is, to come back to.
    pub fn mark(&self) -> Mark<'a> {
        Mark {
            rest: self.rest,
            whole: self.whole,
            line: self.line,
            number: self.number,
        }
    }

    /// Comes back.
    pub fn return_to(&mut self, mark: Mark<'a>) {
        self.rest = mark.rest;
        self.whole = mark.whole;
        self.line = mark.line;
        self.number = mark.number;
    }

    /// The next word, which must be on the current line.
    pub fn here(&mut self, what: &'static str) -> Result<&'a [u8], FormatError> {
        self.token()
            .ok_or_else(|| self.error(Reason::LineEnds(what)))
    }

    /// The next word on this line or a later one.
    pub fn anywhere(&mut self, what: &'static str) -> Result<&'a [u8], FormatError> {
        loop {
            if let Some(token) = self.token() {
                return Ok(token);
            }
            self.begin(what)?;
        }
    }

    /// The current line has no more words.
    pub fn end_line(&mut self) -> Result<(), FormatError> {
        match self.token() {
            Some(token) => Err(self.error(Reason::Trailing(shorten(token)))),
            None => Ok(()),
        }
    }

    /// The file has no more words.
    pub fn end_file(&mut self) -> Result<(), FormatError> {
        self.end_line()?;
        self.advance();
        self.end_line()
    }

    /// A finite number.
    pub fn real(&mut self, token: &[u8]) -> Result<f64, FormatError> {
        let x = self.number(token)?;
        if x.is_finite() {
            Ok(x)
        } else {
            Err(self.error(Reason::NotFinite(shorten(token))))
        }
    }

    /// A number, finite or not.
    pub fn number(&mut self, token: &[u8]) -> Result<f64, FormatError> {
        let value = std::str::from_utf8(token).ok().and_then(|t| t.parse().ok());
        if let Some(x) = value {
            return Ok(x);
        }
        if let Some(x) = fortran(token) {
            self.forgive(NoteCode::FortranExponent);
            return Ok(x);
        }
        Err(self.no_number(token, "a number"))
    }

    /// A whole number.
    pub fn integer(&self, token: &[u8]) -> Result<i64, FormatError> {
        match whole(token) {
            Some(number) => Ok(number),
            None => {
                let value = std::str::from_utf8(token).ok().and_then(|t| t.parse().ok());
                value.ok_or_else(|| self.no_number(token, "a whole number"))
            }
        }
    }

    /// A whole number from 0.
    pub fn count(&self, token: &[u8], what: &'static str) -> Result<u64, FormatError> {
        let count = self.integer(token)?;
        u64::try_from(count).map_err(|_| self.error(Reason::NegativeCount { what, count }))
    }

    /// A number of vertices.
    pub fn vertex_count(&self, token: &[u8]) -> Result<u64, FormatError> {
        let count = self.count(token, "the number of vertices")?;
        // The last ids are not ordinary vertices.
        if count < u64::from(u32::MAX) {
            Ok(count)
        } else {
            Err(self.error(Reason::TooManyVertices(count)))
        }
    }

    /// Three finite numbers on the current line.
    pub fn point(&mut self) -> Result<[f64; 3], FormatError> {
        let mut point = [0.0; 3];
        for x in &mut point {
            let token = self.here("a coordinate")?;
            *x = self.real(token)?;
        }
        Ok(point)
    }

    #[cold]
    fn no_number(&self, token: &[u8], expected: &'static str) -> FormatError {
        if has_decimal_comma(token) {
            self.error(Reason::DecimalComma(shorten(token)))
        } else {
            self.bad(token, expected)
        }
    }

    /// The line of the current word.
    pub fn position(&self) -> FilePosition {
        FilePosition::Line(self.number.max(1))
    }

    /// The error that `token` is not what was `expected`.
    pub fn bad(&self, token: &[u8], expected: &'static str) -> FormatError {
        self.error(Reason::BadToken {
            token: shorten(token),
            expected,
        })
    }

    /// An error at the current line.
    pub fn error(&self, reason: Reason) -> FormatError {
        FormatError::Malformed {
            at: self.position(),
            reason,
        }
    }
}

/// A place in a text to which its reader can come back.
#[derive(Clone, Copy)]
pub(super) struct Mark<'a> {
    rest: &'a [u8],
    whole: &'a [u8],
    line: &'a [u8],
    number: usize,
}

#[cfg(test)]
#[path = "text_tests.rs"]
mod tests;
