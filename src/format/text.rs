//! Words and numbers of a text file, with line numbers.
//!
//! Lines end with LF, CRLF or CR; a comment runs from `#` to the end of its line (not in STL); lines without a word are
//! skipped. Nothing is allocated by a count that a file announces.

use super::error::{FormatError, Place, Reason};

/// A reader of the words of a text file.
#[derive(Clone)]
pub(super) struct Text<'a> {
    /// What follows the current line.
    rest: &'a [u8],
    /// What is left of the current line.
    line: &'a [u8],
    /// The number of the current line, from 1.
    number: usize,
    comments: bool,
}

impl<'a> Text<'a> {
    /// Before the first line. A UTF-8 byte order mark is skipped.
    pub fn new(bytes: &'a [u8], comments: bool) -> Text<'a> {
        Text {
            rest: bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes),
            line: &[],
            number: 0,
            comments,
        }
    }

    /// Before the first line of a piece of the file, from which its lines are counted.
    pub fn piece(&self, bytes: &'a [u8]) -> Text<'a> {
        Text {
            rest: bytes,
            line: &[],
            number: 0,
            comments: self.comments,
        }
    }

    /// Drops the rest of the current line, and some bytes, which are so many lines.
    pub fn skip(&mut self, bytes: usize, lines: usize) {
        self.rest = &self.rest[bytes..];
        self.line = &[];
        self.number += lines;
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
        let end = |b: &u8| matches!(b, b'\n' | b'\r');
        let length = self.rest.iter().position(end).unwrap_or(self.rest.len());
        let (line, tail) = self.rest.split_at(length);
        self.rest = match tail {
            [b'\r', b'\n', rest @ ..] | [_, rest @ ..] => rest,
            [] => &[],
        };
        self.number += 1;
        self.line = match line.iter().position(|&b| b == b'#') {
            Some(comment) if self.comments => &line[..comment],
            _ => line,
        };
        true
    }

    /// Whether the current line has one more word.
    pub fn has_word(&self) -> bool {
        !self.line.trim_ascii().is_empty()
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

    /// The next word of the current line.
    pub fn token(&mut self) -> Option<&'a [u8]> {
        let line = self.line.trim_ascii_start();
        let length = line.iter().position(u8::is_ascii_whitespace);
        let (token, rest) = line.split_at(length.unwrap_or(line.len()));
        self.line = rest;
        (!token.is_empty()).then_some(token)
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
    pub fn real(&self, token: &[u8]) -> Result<f64, FormatError> {
        let x = self.number(token)?;
        if x.is_finite() {
            Ok(x)
        } else {
            Err(self.error(Reason::NotFinite(shorten(token))))
        }
    }

    /// A number, finite or not.
    pub fn number(&self, token: &[u8]) -> Result<f64, FormatError> {
        self.parse(token, "a number")
    }

    /// A whole number.
    pub fn integer(&self, token: &[u8]) -> Result<i64, FormatError> {
        match whole(token) {
            Some(number) => Ok(number),
            None => self.parse(token, "a whole number"),
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

    fn parse<T: std::str::FromStr>(
        &self,
        token: &[u8],
        expected: &'static str,
    ) -> Result<T, FormatError> {
        let value = std::str::from_utf8(token).ok().and_then(|t| t.parse().ok());
        value.ok_or_else(|| {
            if has_decimal_comma(token) {
                self.error(Reason::DecimalComma(shorten(token)))
            } else {
                self.bad(token, expected)
            }
        })
    }

    /// The line of the current word.
    pub fn place(&self) -> Place {
        Place::Line(self.number.max(1))
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
            place: self.place(),
            reason,
        }
    }
}

/// The whole number that a word with few digits is, as most are; `str::parse` would say the same.
pub(super) fn whole(token: &[u8]) -> Option<i64> {
    let digits = token.strip_prefix(b"-").unwrap_or(token);
    if !(1..=18).contains(&digits.len()) {
        return None;
    }
    let mut number = 0;
    for digit in digits {
        match digit.wrapping_sub(b'0') {
            digit @ 0..=9 => number = 10 * number + i64::from(digit),
            _ => return None,
        }
    }
    Some(if digits.len() < token.len() {
        -number
    } else {
        number
    })
}

/// Whether a word is a number but for a comma: `1,5` or `-2,50e3`.
fn has_decimal_comma(token: &[u8]) -> bool {
    let text = std::str::from_utf8(token).unwrap_or_default();
    let (whole, fraction) = text.split_once(',').unwrap_or_default();
    let digit = |c: Option<char>| c.is_some_and(|c| c.is_ascii_digit());
    digit(whole.chars().next_back())
        && digit(fraction.chars().next())
        && text.replacen(',', ".", 1).parse::<f64>().is_ok()
}

/// The first 40 characters of a word, which in a binary file can be very long.
pub(super) fn shorten(token: &[u8]) -> String {
    let text = String::from_utf8_lossy(&token[..token.len().min(160)]);
    text.chars().take(40).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_lines_of_all_endings() {
        let mut text = Text::new(b"\xef\xbb\xbfa\r\n\r\n# b\rc # d\n\n e", true);
        let mut seen = Vec::new();
        while text.advance() {
            seen.push((text.number, text.token().unwrap()));
            assert_eq!(text.token(), None);
        }
        assert_eq!(seen, [(1, &b"a"[..]), (4, &b"c"[..]), (6, &b"e"[..])]);
    }

    #[test]
    fn numbers_are_strict() {
        let text = Text::new(b"", true);
        assert_eq!(text.real(b"-1.5e3").unwrap(), -1500.0);
        for bad in [
            &b"1.0x"[..],
            b"1,0",
            b"nan",
            b"-inf",
            b"1e999",
            b"\xff",
            b"",
        ] {
            assert!(text.real(bad).is_err(), "{bad:?}");
        }
        for comma in [&b"1,5"[..], b"-2,50e3"] {
            let reason = Reason::DecimalComma(shorten(comma));
            assert_eq!(
                text.real(comma).unwrap_err().to_string(),
                text.error(reason).to_string()
            );
        }
        for bad in [
            &b"1.0"[..],
            b"0x1",
            b"99999999999999999999",
            b"-",
            b"--1",
            b"+-1",
        ] {
            assert!(text.integer(bad).is_err(), "{bad:?}");
        }
        for good in [
            "0",
            "-0",
            "+7",
            "-12",
            "000000000000000000000012",
            "999999999999999999",
            "-9223372036854775808",
        ] {
            let number = text.integer(good.as_bytes()).unwrap();
            assert_eq!(number, good.parse::<i64>().unwrap());
        }
        assert!(text.count(b"-1", "it").is_err());
    }
}
