//! What readers forgive, and how they say it: for each kind a small file, the code of its note, and its line.

mod numbers;
mod sections;
mod words;

use tetflip::exchange::{Note, NoteCode, Plc};
use tetflip::format::{
    FormatError, read_medit, read_node, read_obj, read_off, read_ply, read_poly, read_smesh,
    read_stl,
};

type Reading = Result<(Plc, Vec<Note>), FormatError>;

type Reader = fn(&[u8]) -> Reading;

fn poly(bytes: &[u8]) -> Reading {
    read_poly(bytes, || Ok(Vec::new()))
}

fn smesh(bytes: &[u8]) -> Reading {
    read_smesh(bytes, || Ok(Vec::new()))
}

const NODE: &str = "4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n";
const FACETS: &str = "1 1\n1 0 7\n3 1 2 3\n0\n0\n";
const OFF: &str = "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 2 1 3\n";
const FACET: &str =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
const PLY: &str = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
    element face 2\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 2 1 3\n";
const OBJ: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 3 2 4\n";
const MEDIT: &str = "MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n\
    Triangles\n2\n1 2 3 7\n3 2 4 7\nEnd\n";

fn stl() -> String {
    format!("solid a\n{FACET}{FACET}endsolid a\n").replacen("vertex 0 0 0", "vertex 0 0 1", 1)
}

fn whole_poly() -> String {
    format!("{NODE}{FACETS}")
}

/// Two texts are read alike, but the first has one note, on one line.
fn forgiven(read: fn(&[u8]) -> Reading, text: &str, good: &str, code: NoteCode, line: usize) {
    let (expected, none) = read(good.as_bytes()).unwrap_or_else(|e| panic!("{e} in {good:?}"));
    let noteless = none
        .iter()
        .all(|note| note.code == NoteCode::VolumeElements);
    assert!(noteless, "{none:?} in {good:?}");
    let (plc, notes) = read(text.as_bytes()).unwrap_or_else(|e| panic!("{e} in {text:?}"));
    assert_eq!(plc, expected, "{text:?}");
    let [note] = &notes[..] else {
        panic!("{notes:?} of {text:?}");
    };
    assert_eq!(
        (note.code, &note.lines[..]),
        (code, &[line][..]),
        "{text:?}"
    );
    assert!(note.text.ends_with(&format!("(line {line})")), "{note}");
}

/// The same with one word of a good file replaced by others.
fn replaced(
    read: fn(&[u8]) -> Reading,
    good: &str,
    word: &str,
    by: &str,
    code: NoteCode,
    line: usize,
) {
    assert!(good.contains(word), "{word:?} in {good:?}");
    forgiven(read, &good.replacen(word, by, 1), good, code, line);
}
