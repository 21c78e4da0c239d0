//! Many rows of a text file, read by all threads: the file is cut at line ends, and the pieces are read at once.
//!
//! Each format has one function that reads a row, and a loop that calls it for one row after the other. Before the
//! loop, [`read_ahead`] lets threads call it for whole pieces, as if each began with a row, and takes what they read
//! in the order of the file, as long as every piece began where the one before it had ended cleanly. It stops before
//! the first piece in which anything is wrong, or with which there would not be too few rows, and the loop goes on
//! from there. So rows, notes and errors, with their lines, are those of the loop alone, whatever the number of
//! threads.

use super::text::Text;
use rayon::prelude::*;

/// Bytes that one thread reads at a time, about.
#[cfg(not(test))]
fn piece_size() -> usize {
    1 << 17
}

/// Bytes of a row, if it is one of the shortest that occur.
const SHORTEST: usize = 64;

/// Pieces for each thread that are held in memory at the same time.
const EACH: usize = 16;

/// Rows of a file.
pub(super) trait Rows: Send {
    /// No rows, to be read in the middle of the file.
    fn piece(&self) -> Self;

    /// How many there are.
    fn len(&self) -> u64;

    /// Appends those of the piece of the file that follows. If they cannot follow, it says so and appends nothing.
    fn append(&mut self, next: Self) -> bool;
}

impl<T: Send> Rows for Vec<T> {
    fn piece(&self) -> Vec<T> {
        Vec::new()
    }

    fn len(&self) -> u64 {
        Vec::len(self) as u64
    }

    fn append(&mut self, next: Vec<T>) -> bool {
        self.extend(next);
        true
    }
}

/// Reads rows, each of which begins with a word on a new line: some of them, fewer than there are if there are `count`.
/// Returns the line in which the last of them ends, or 0 if there is none.
pub(super) fn read_ahead<'a, R: Rows, E>(
    text: &mut Text<'a>,
    count: u64,
    rows: &mut R,
    read: impl Fn(&mut Text<'a>, &mut R) -> Result<(), E> + Sync,
) -> usize {
    read_aligned(text, count, rows, read, |_| 0)
}

/// The same where rows may be longer than a line: `align` guesses how many bytes after the beginning of a line the next
/// row begins.
pub(super) fn read_aligned<'a, R: Rows, E>(
    text: &mut Text<'a>,
    count: u64,
    rows: &mut R,
    read: impl Fn(&mut Text<'a>, &mut R) -> Result<(), E> + Sync,
    align: impl Fn(&[u8]) -> usize,
) -> usize {
    read_pieces(text, count, rows, read, align, piece_size())
}

fn read_pieces<'a, R: Rows, E>(
    text: &mut Text<'a>,
    count: u64,
    rows: &mut R,
    read: impl Fn(&mut Text<'a>, &mut R) -> Result<(), E> + Sync,
    align: impl Fn(&[u8]) -> usize,
    size: usize,
) -> usize {
    let (mut last, mut most) = (0, 0);
    let (start, before) = (text.rest().len(), rows.len());
    // The pool is not even started for a small file, nor asked about a few rows, of which there may be many lists.
    let is_worthwhile = |text: &mut Text, left: u64| {
        let large = text.rest().len() >= 2 * size && left >= (size / SHORTEST) as u64;
        large && !text.has_word() && rayon::current_num_threads() > 1
    };
    while is_worthwhile(text, count - rows.len()) {
        let threads = rayon::current_num_threads();
        most = (2 * most).clamp(threads, EACH * threads);
        if rows.len() > before {
            // What the rows that are left will take, as those so far did.
            let bytes = (start - text.rest().len()) as u128 * u128::from(count - rows.len());
            let pieces = bytes / u128::from(rows.len() - before) / size as u128;
            most = most.min(
                usize::try_from(pieces)
                    .unwrap_or(usize::MAX)
                    .saturating_add(1),
            );
        }
        let pieces = pieces(text.rest(), size, most, &align).into_iter();
        let pieces: Vec<(&[u8], R)> = pieces.map(|piece| (piece, rows.piece())).collect();
        let shared = &*text;
        let read_piece = |(piece, mut rows): (&'a [u8], R)| {
            let mut text = shared.piece(piece);
            let mut last = 0;
            while text.has_word() || text.advance() {
                read(&mut text, &mut rows).ok()?;
                last = text.number_of_line();
            }
            Some((rows, last, piece.len(), text))
        };
        let found: Vec<Option<_>> = pieces.into_par_iter().map(read_piece).collect();
        for piece in found {
            let Some((next, line, bytes, piece)) = piece else {
                return last;
            };
            if rows.len() + next.len() >= count || !rows.append(next) {
                return last;
            }
            if line > 0 {
                last = text.number_of_line() + line;
            }
            text.skip_piece(bytes, piece);
        }
    }
    last
}

/// The first pieces of some lines, each of about the size and ending at a line end.
fn pieces(mut rest: &[u8], size: usize, most: usize, align: impl Fn(&[u8]) -> usize) -> Vec<&[u8]> {
    let mut pieces = Vec::new();
    while !rest.is_empty() && pieces.len() < most {
        let end = |b: &u8| matches!(b, b'\n' | b'\r');
        let start = size.min(rest.len());
        let line_end = rest[start..].iter().position(end).map(|i| start + i);
        let next = match line_end {
            None => rest.len(),
            Some(i) if rest[i..].starts_with(b"\r\n") => i + 2,
            Some(i) => i + 1,
        };
        let (piece, tail) = rest.split_at(next + align(&rest[next..]));
        pieces.push(piece);
        rest = tail;
    }
    pieces
}

#[cfg(test)]
use tests::piece_size;

#[cfg(test)]
#[path = "ahead_tests.rs"]
pub(super) mod tests;
