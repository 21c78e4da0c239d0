//! Many lines of numbers to a file: formatted in blocks by all threads, written in order. The bytes are the same with
//! any number of threads.

use super::mesh_file::Shortest;
use rayon::prelude::*;
use std::io::{self, Write};

/// Elements that one thread formats at a time.
const BLOCK: usize = 4096;

/// Blocks that are held in memory at the same time.
const BLOCKS: usize = 32;

/// A line, or several, being formatted.
#[derive(Default)]
pub(super) struct Lines {
    text: Vec<u8>,
    digits: itoa::Buffer,
}

impl Lines {
    /// A whole number.
    pub fn number(&mut self, number: u64) {
        self.text
            .extend_from_slice(self.digits.format(number).as_bytes());
    }

    /// The same after a space.
    pub fn next(&mut self, number: u64) {
        self.text.push(b' ');
        self.number(number);
    }

    /// A marker after a space.
    pub fn next_marker(&mut self, marker: i64) {
        self.text.push(b' ');
        self.text
            .extend_from_slice(self.digits.format(marker).as_bytes());
    }

    /// A double after a space.
    pub fn next_double(&mut self, x: f64) {
        write!(self.text, " {}", Shortest(x)).expect("memory takes what is written");
    }

    /// The end of the line.
    pub fn end(&mut self) {
        self.text.push(b'\n');
    }
}

/// Writes what `format` makes of each item, which it gets with its place.
pub(super) fn write_lines<T: Sync>(
    out: &mut dyn Write,
    items: &[T],
    format: impl Fn(&mut Lines, usize, &T) + Sync,
) -> io::Result<()> {
    let block = |(block, items): (usize, &[T])| {
        let mut line = Lines::default();
        for (i, item) in items.iter().enumerate() {
            format(&mut line, block * BLOCK + i, item);
        }
        line.text
    };
    let blocks: Vec<(usize, &[T])> = items.chunks(BLOCK).enumerate().collect();
    for some in blocks.chunks(BLOCKS) {
        // A thread pool is not worth while for a few lines.
        let texts: Vec<Vec<u8>> = match some {
            [one] => vec![block(*one)],
            _ => some.par_iter().map(|&one| block(one)).collect(),
        };
        texts.iter().try_for_each(|text| out.write_all(text))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_keep_their_order() {
        let items: Vec<i64> = (0..300_000).map(|i| i % 7 - 3).collect();
        let mut out = Vec::new();
        write_lines(&mut out, &items, |line, i, &marker| {
            line.number(i as u64);
            line.next_double(0.1);
            line.next_marker(marker);
            line.end();
        })
        .expect("memory");
        let text = String::from_utf8(out).expect("digits");
        let expected: String = (0..300_000)
            .map(|i| format!("{i} 0.1 {}\n", i % 7 - 3))
            .collect();
        assert!(text == expected);
    }
}
