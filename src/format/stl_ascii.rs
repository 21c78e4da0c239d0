//! ASCII STL files: `solid`, its facets, `endsolid`, and perhaps more solids. Words are separated by any blanks;
//! names and normals end with their lines, or before a facet that begins on the same line.

use super::ahead::read_aligned;
use super::error::FormatError;
use super::stl::Merged;
use super::text::{Syntax, Text};
use crate::exchange::{Note, NoteCode};

/// Reads the solids.
pub(super) fn read_ascii(bytes: &[u8], mesh: &mut Merged) -> Result<Vec<Note>, FormatError> {
    let mut text = Text::new(bytes, Syntax::Plain);
    // Where lines do not begin with facets, looking ahead is of no use.
    let mut helps = true;
    while text.has_word() || text.advance() {
        let begins = !mesh.in_solid;
        statement(&mut text, mesh)?;
        if begins && helps {
            let more = text.rest().len();
            read_aligned(&mut text, u64::MAX, mesh, statement, first_facet);
            helps = text.rest().len() < more;
        }
    }
    if mesh.in_solid {
        text.forgive(NoteCode::Keywords);
    }
    Ok(text.into_notes())
}

/// Reads a facet, or that a solid begins or ends. Some writers put several solids into one file.
fn statement(text: &mut Text, mesh: &mut Merged) -> Result<(), FormatError> {
    let expected = if mesh.in_solid {
        "facet or endsolid"
    } else {
        "solid"
    };
    let token = text.anywhere(expected)?;
    if token.eq_ignore_ascii_case(b"facet") {
        if !mesh.in_solid {
            text.forgive(NoteCode::Keywords);
            mesh.begin_solid(String::new());
        }
        facet(text, mesh)
    } else if token.eq_ignore_ascii_case(b"solid") {
        if mesh.in_solid {
            text.forgive(NoteCode::Keywords);
        }
        let name = name(text, &[b"facet"]);
        mesh.begin_solid(name);
        Ok(())
    } else if mesh.in_solid && is_end(text, token, b"solid") {
        name(text, &[b"solid", b"facet"]);
        mesh.in_solid = false;
        Ok(())
    } else {
        Err(text.bad(token, expected))
    }
}

/// The rest of the line: a name. It ends before a word that begins what follows, if `facet` and `normal` follow, too.
fn name(text: &mut Text, words: &[&[u8]]) -> String {
    let line = text.line();
    let mut starts = vec![];
    let mut at = 0;
    for word in line.split(u8::is_ascii_whitespace) {
        starts.push((at, word));
        at += word.len() + 1;
    }
    starts.retain(|(_, word)| !word.is_empty());
    let is = |word: &[u8], with: &[u8]| word.eq_ignore_ascii_case(with);
    let facets = starts
        .windows(2)
        .any(|pair| is(pair[0].1, b"facet") && is(pair[1].1, b"normal"));
    let next = starts
        .iter()
        .find(|(_, word)| words.iter().any(|with| is(word, with)));
    let end = next.filter(|_| facets).map_or(line.len(), |&(at, _)| at);
    text.skip_in_line(end);
    let name = String::from_utf8_lossy(line[..end].trim_ascii());
    name.chars().take(200).collect()
}

/// Whether a word is `end` and another one, or `end` before that one, which then is read, too.
fn is_end(text: &mut Text, token: &[u8], of: &[u8]) -> bool {
    let head = token.get(..3).unwrap_or_default();
    if !head.eq_ignore_ascii_case(b"end") {
        return false;
    }
    if token.len() > 3 {
        return token[3..].eq_ignore_ascii_case(of);
    }
    let mark = text.mark();
    if text
        .token()
        .is_some_and(|word| word.eq_ignore_ascii_case(of))
    {
        text.forgive(NoteCode::Keywords);
        return true;
    }
    text.return_to(mark);
    false
}

/// Reads what follows the word `facet`.
fn facet(text: &mut Text, mesh: &mut Merged) -> Result<(), FormatError> {
    skip_normal(text);
    keyword(text, "outer")?;
    keyword(text, "loop")?;
    let mut corners = [[0.0; 3]; 3];
    for corner in &mut corners {
        keyword(text, "vertex")?;
        *corner = text.point()?;
    }
    let mark = text.mark();
    if !ends(text) {
        text.return_to(mark);
        forgive_ends(text, mesh)?;
    }
    mesh.triangle(corners).map_err(|reason| text.error(reason))
}

/// The normal, which may well be NaN, fills its line, unless all of a loop is on one line.
fn skip_normal(text: &mut Text) {
    let line = text.line().trim_ascii_end();
    if line.last().is_some_and(u8::is_ascii_digit) && !line.contains(&b'v') {
        return text.skip_line();
    }
    let outer = line
        .windows(5)
        .position(|word| word.eq_ignore_ascii_case(b"outer"));
    match outer {
        Some(at) => text.skip_in_line(at),
        None => text.skip_line(),
    }
}

/// Whether `endloop` and `endfacet` follow, as they should.
fn ends(text: &mut Text) -> bool {
    [&b"endloop"[..], b"endfacet"].iter().all(|word| {
        let token = text.anywhere("endloop").unwrap_or_default();
        token.eq_ignore_ascii_case(word)
    })
}

/// Reads what there is of the end of a facet.
#[cold]
fn forgive_ends(text: &mut Text, mesh: &Merged) -> Result<(), FormatError> {
    for (word, end) in [(&b"loop"[..], "endloop"), (b"facet", "endfacet")] {
        let mark = text.mark();
        if !text.has_word() && !text.advance() {
            // It may follow in the next piece of the file.
            if mesh.is_piece() {
                return text.anywhere(end).map(|_| ());
            }
            text.forgive(NoteCode::Keywords);
            continue;
        }
        let token = text.here(end)?;
        if is_end(text, token, word) {
            continue;
        }
        let follows = [&b"facet"[..], b"endfacet", b"endsolid", b"solid", b"end"];
        if !follows.iter().any(|f| token.eq_ignore_ascii_case(f)) {
            return Err(text.bad(token, end));
        }
        text.forgive(NoteCode::Keywords);
        text.return_to(mark);
    }
    Ok(())
}

/// Where a facet begins, if that is soon.
fn first_facet(bytes: &[u8]) -> usize {
    const LINES: usize = 16;
    let mut text = Text::new(bytes, Syntax::Plain);
    let size = bytes.len();
    for _ in 0..LINES {
        let mark = text.mark();
        text.next_line();
        let token = text.token().unwrap_or_default();
        if token.eq_ignore_ascii_case(b"facet") {
            text.return_to(mark);
            break;
        }
    }
    text.offset(size)
}

fn keyword(text: &mut Text, word: &'static str) -> Result<(), FormatError> {
    let token = text.anywhere(word)?;
    if token.eq_ignore_ascii_case(word.as_bytes()) {
        Ok(())
    } else {
        Err(text.bad(token, word))
    }
}
