//! What a reader forgives: by kind and line while it reads, as notes when it is done.

use crate::exchange::{Note, NoteCode};

/// What has been forgiven, in the order of the first of each kind.
#[derive(Clone, Default)]
pub(super) struct Forgiven {
    kinds: Vec<Kind>,
}

/// All of one kind.
#[derive(Clone)]
struct Kind {
    code: NoteCode,
    /// On how many lines.
    count: usize,
    /// The first of them.
    lines: Vec<usize>,
    /// The last of them.
    last: usize,
    /// What they are called in the file, each once.
    names: Vec<String>,
}

impl Forgiven {
    /// Something of a kind on a line, which is not before those of earlier calls. Several on one line count as one.
    #[cold]
    pub fn add(&mut self, code: NoteCode, line: usize) {
        let kind = self.kind(code);
        if kind.last == line {
            return;
        }
        kind.last = line;
        kind.count += 1;
        if kind.lines.len() < Note::LISTED {
            kind.lines.push(line);
        }
    }

    /// The same, with what it is called in the file.
    #[cold]
    pub fn add_named(&mut self, code: NoteCode, line: usize, name: String) {
        self.add(code, line);
        self.kind(code).name(name);
    }

    /// Those of a piece of the file that begins after a line.
    pub fn append(&mut self, after: usize, piece: Forgiven) {
        for next in piece.kinds {
            let kind = self.kind(next.code);
            kind.last = after + next.last;
            kind.count += next.count;
            let room = Note::LISTED - kind.lines.len();
            let lines = next.lines.iter().take(room);
            kind.lines.extend(lines.map(|line| after + line));
            next.names.into_iter().for_each(|name| kind.name(name));
        }
    }

    /// Whether there is something of a kind on a line, the last that has been read.
    pub fn is_on(&self, code: NoteCode, line: usize) -> bool {
        self.kinds.iter().any(|k| k.code == code && k.last == line)
    }

    fn kind(&mut self, code: NoteCode) -> &mut Kind {
        let known = self.kinds.iter().position(|kind| kind.code == code);
        let at = known.unwrap_or(self.kinds.len());
        if known.is_none() {
            self.kinds.push(Kind {
                code,
                count: 0,
                lines: Vec::new(),
                last: 0,
                names: Vec::new(),
            });
        }
        &mut self.kinds[at]
    }

    /// One note for each kind.
    pub fn into_notes(self) -> Vec<Note> {
        self.kinds.into_iter().map(Kind::into_note).collect()
    }
}

impl Kind {
    fn name(&mut self, name: String) {
        if self.names.len() < Note::LISTED && !self.names.contains(&name) {
            self.names.push(name);
        }
    }

    fn into_note(self) -> Note {
        let mut text = sentence(self.code).to_owned();
        if !self.names.is_empty() {
            text = format!("{text}: {}", self.names.join(", "));
        }
        text = format!("{text} ({})", places(&self.lines, self.count));
        Note::new(self.code, self.count, text).at_lines(self.lines)
    }
}

/// What is said of a kind.
fn sentence(code: NoteCode) -> &'static str {
    match code {
        NoteCode::FortranExponent => "exponents with the letter D are read as those with E",
        NoteCode::CommaSeparator => "commas between numbers are read as blanks",
        NoteCode::ForeignComment => "comments of a kind that the format does not have are skipped",
        NoteCode::Keywords => "keywords that are missing or in two words are taken as read",
        NoteCode::TrailingData => "what follows the end is ignored",
        NoteCode::UnknownSection => "sections that are not known are skipped",
        NoteCode::VolumeElements => "solid elements are ignored: the surface counts",
        NoteCode::FormatVersion => "a version that the format does not have is read as the others",
        NoteCode::VertexNumbers => {
            "vertices are not numbered one after the other: corners are vertices of those numbers"
        }
        NoteCode::ClosedRing => "polygons that end with their first corner are read without it",
        NoteCode::MissingColumns => "attributes or markers that are missing are read as 0",
        NoteCode::ExtraColumns => "columns that the header does not announce are ignored",
        NoteCode::LineBreaks => "lines do not begin with rows: the words are read one by one",
        _ => "forgiven",
    }
}

/// The first lines, and how many there are.
pub(super) fn places(lines: &[usize], count: usize) -> String {
    const SHOWN: usize = 3;
    let shown: Vec<String> = lines.iter().take(SHOWN).map(usize::to_string).collect();
    match (&shown[..], count) {
        ([line], 1) => format!("line {line}"),
        (shown, count) if count <= SHOWN => format!("lines {}", shown.join(", ")),
        (shown, count) => format!("lines {}, …, {count} in all", shown.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_are_appended_as_if_read_at_once() {
        let (mut whole, mut first, mut second) = <(Forgiven, Forgiven, Forgiven)>::default();
        for line in 1..=50 {
            whole.add(NoteCode::CommaSeparator, line);
            let piece = if line <= 15 { &mut first } else { &mut second };
            piece.add(NoteCode::CommaSeparator, line - 15 * usize::from(line > 15));
        }
        whole.add_named(NoteCode::UnknownSection, 50, "A".to_owned());
        second.add_named(NoteCode::UnknownSection, 35, "A".to_owned());
        first.append(15, second);
        let notes = first.into_notes();
        assert_eq!(notes, whole.into_notes());
        assert_eq!(notes[0].count, 50);
        assert!(notes[0].text.ends_with("(lines 1, 2, 3, …, 50 in all)"));
        assert!(notes[1].text.ends_with(": A (line 50)"));
    }

    #[test]
    fn a_line_counts_once() {
        let mut forgiven = Forgiven::default();
        forgiven.add(NoteCode::FortranExponent, 3);
        forgiven.add(NoteCode::FortranExponent, 3);
        assert!(forgiven.is_on(NoteCode::FortranExponent, 3));
        assert_eq!(forgiven.into_notes()[0].lines, [3]);
    }
}
