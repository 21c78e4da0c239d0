//! What readers forgive, and how they say it: for each kind a small file, the code of its note, and its line.

use tetflip::exchange::{Note, NoteCode, Plc};
use tetflip::format::{
    FormatError, read_medit, read_node, read_obj, read_off, read_ply, read_poly, read_smesh,
    read_stl,
};

type Reading = Result<(Plc, Vec<Note>), FormatError>;

fn poly(bytes: &[u8]) -> Reading {
    read_poly(bytes, || Ok(Vec::new()))
}

fn smesh(bytes: &[u8]) -> Reading {
    read_smesh(bytes, || Ok(Vec::new()))
}

const NODE: &str = "4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n";
const FACETS: &str = "1 1\n1 0 7\n3 1 2 3\n0\n0\n";
const OFF: &str = "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 2 1 3\n";
const FACET: &str = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
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
    let noteless = none.iter().all(|note| note.code == NoteCode::VolumeElements);
    assert!(noteless, "{none:?} in {good:?}");
    let (plc, notes) = read(text.as_bytes()).unwrap_or_else(|e| panic!("{e} in {text:?}"));
    assert_eq!(plc, expected, "{text:?}");
    let [note] = &notes[..] else {
        panic!("{notes:?} of {text:?}");
    };
    assert_eq!((note.code, &note.lines[..]), (code, &[line][..]), "{text:?}");
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

#[test]
fn exponents_of_fortran() {
    let code = NoteCode::FortranExponent;
    replaced(poly, &whole_poly(), "2 1 0 0", "2 1.0D+00 0d0 0", code, 3);
    replaced(read_off, OFF, "0 1 0\n", "0 .1d1 0\n", code, 5);
    replaced(read_stl, &stl(), "vertex 1 0 0", "vertex +1.D0 0 0", code, 5);
    replaced(read_ply, PLY, "1 0 0\n", "10d-1 0 0\n", code, 11);
    replaced(read_obj, OBJ, "v 0 1 0", "v 0 1.D0 0", code, 3);
    replaced(read_medit, MEDIT, "0 1 0 0", "0 1.D0 0 0", code, 7);
    // Two numbers, or an exponent without its letter?
    assert!(read_off(OFF.replacen("1 0 0", "1.0-100 0 0", 1).as_bytes()).is_err());
}

#[test]
fn commas_as_separators() {
    let code = NoteCode::CommaSeparator;
    replaced(poly, &whole_poly(), "2 1 0 0", "2, 1, 0, 0", code, 3);
    replaced(poly, &whole_poly(), "2 1 0 0", "2,1,0,0", code, 3);
    replaced(poly, &whole_poly(), "2 1 0 0", "2 ,1 , 0\t,0", code, 3);
    replaced(poly, &whole_poly(), "1 1\n", "1,1\n", code, 6);
    replaced(read_off, OFF, "0 1 0\n", "0,1,0\n", code, 5);
    replaced(read_off, OFF, "4 2 0\n", "4, 2, 0,\n", code, 2);
    replaced(read_stl, &stl(), "vertex 1 0 0", "vertex 1, 0, 0", code, 5);
    replaced(read_ply, PLY, "1 0 0\n", "1, 0, 0\n", code, 11);
    replaced(read_obj, OBJ, "f 1 2 3", "f 1, 2, 3", code, 5);
    replaced(read_medit, MEDIT, "1 2 3 7", "1, 2, 3, 7", code, 11);
    let all: String = whole_poly().lines().map(|line| line.replace(' ', ", ") + "\n").collect();
    let (_, notes) = poly(all.as_bytes()).expect("commas everywhere");
    assert_eq!((notes.len(), notes[0].count), (1, 8));
}

/// A comma within a word is more likely a decimal one, and two commas have something missing between them.
#[test]
fn ambiguous_commas_are_errors() {
    for row in ["0 1,5 0", "0,5 1,5 0,5", "0,5, 1,5, 0,5", "0,5,1,5,0,5", "1,000,000", "0,,1 0", ",0,1,0", "0;1;0"] {
        let text = OFF.replacen("0 1 0\n", &format!("{row}\n"), 1);
        assert!(read_off(text.as_bytes()).is_err(), "{row}");
        let text = whole_poly().replacen("3 0 1 0\n", &format!("3 {row}\n"), 1);
        assert!(poly(text.as_bytes()).is_err(), "{row}");
    }
    for row in ["2,1,5,0,5,0,5", "2,1,0", "2,100,000"] {
        let text = whole_poly().replacen("2 1 0 0", row, 1);
        assert!(poly(text.as_bytes()).is_err(), "{row}");
    }
}

#[test]
fn comments_of_other_formats() {
    let code = NoteCode::ForeignComment;
    for comment in ["// a comment", "! a comment, too"] {
        replaced(poly, &whole_poly(), "2 1 0 0", &format!("2 1 0 0 {comment}"), code, 3);
        replaced(read_off, OFF, "0 1 0\n", &format!("{comment}\n0 1 0\n"), code, 5);
        replaced(read_stl, &stl(), "facet", &format!("{comment}\nfacet"), code, 2);
        replaced(read_ply, PLY, "0 1 0\n", &format!("{comment}\n0 1 0\n"), code, 12);
        replaced(read_obj, OBJ, "f 1", &format!("{comment}\nf 1"), code, 5);
        replaced(read_medit, MEDIT, "Triangles", &format!("{comment}\nTriangles"), code, 9);
    }
    replaced(read_stl, &stl(), "facet", "# a comment\nfacet", code, 2);
    replaced(read_ply, PLY, "0 1 0\n", "0 1 0 # a comment\n", code, 12);
    // What the format itself has needs no note.
    for (text, comment) in [(OFF, "# c\n"), (OBJ, "#\n"), (MEDIT, " # c\n")] {
        assert!(text.contains('\n') && comment.ends_with('\n'));
    }
    let (_, notes) = read_off(OFF.replace('\n', " # c\r\n").as_bytes()).expect("comments");
    assert!(notes.is_empty());
}

/// Comments as the paper on PLY has them.
#[test]
fn braces_in_ply() {
    let (expected, _) = read_ply(PLY.as_bytes()).expect("a good file");
    let text = PLY
        .replacen("element vertex 4", "element vertex 4 { define \"vertex\" element }", 1)
        .replacen("vertex_indices", "vertex_indices { a list }", 1)
        .replacen("0 0 0\n", "0 0 0 { start of vertex list }\n{ on a line }\n", 1)
        .replacen("3 2 1 3", "{ last } 3 2 1 3", 1);
    let (plc, notes) = read_ply(text.as_bytes()).expect("braces");
    assert_eq!((plc, notes), (expected, vec![]));
    assert!(read_ply(text.replacen("{ last }", "{ last", 1).as_bytes()).is_err());
}

#[test]
fn keywords_of_stl() {
    let code = NoteCode::Keywords;
    let good = stl();
    replaced(read_stl, &good, "endsolid a", "end solid a", code, 16);
    replaced(read_stl, &good, "endloop", "End Loop", code, 7);
    replaced(read_stl, &good, "endfacet", "end facet", code, 8);
    replaced(read_stl, &good, "endfacet\n", "", code, 8);
    replaced(read_stl, &good, "endloop\n", "", code, 7);
    replaced(read_stl, &good, "endloop\nendfacet\n", "", code, 7);
    replaced(read_stl, &good, "endsolid a\n", "", code, 15);
    replaced(read_stl, &good, "solid a\n", "", code, 1);
    let bare = good.replace("endloop\n", "").replace("endfacet\n", "").replace("endsolid a\n", "");
    let (plc, notes) = read_stl(bare.as_bytes()).expect("no end at all");
    assert_eq!(plc, read_stl(good.as_bytes()).expect("a good file").0);
    assert_eq!((notes.len(), notes[0].code), (1, code));
    // A corner too many, or too few.
    let more = good.replacen("endloop", "vertex 9 9 9\nendloop", 1);
    assert!(read_stl(more.as_bytes()).is_err());
    let fewer = bare.replacen("vertex 0 1 0\n", "", 1);
    assert!(read_stl(fewer.as_bytes()).is_err());
}

#[test]
fn stl_on_one_line() {
    let text = stl().replace('\n', " ");
    let (plc, notes) = read_stl(text.as_bytes()).expect("one line");
    assert_eq!((plc, notes), read_stl(stl().as_bytes()).expect("a good file"));
    let two = format!("{text}{text}");
    assert_eq!(read_stl(two.as_bytes()).expect("two solids").0.marker_names.len(), 2);
}

/// Each solid has its marker and its name, whether or not its end is there.
#[test]
fn solids_of_stl() {
    let two = format!("solid first one\n{FACET}endsolid\nsolid empty\nendsolid\nSOLID b\n{FACET}{FACET}endsolid b\n");
    for text in [two.clone(), two.replacen("endsolid\n", "", 1)] {
        let (plc, _) = read_stl(text.as_bytes()).expect("solids");
        let markers: Vec<i64> = plc.facets.iter().map(|f| f.marker).collect();
        assert_eq!(markers, [1, 2, 2]);
        let names = [(1, "first one".to_owned()), (2, "b".to_owned())];
        assert_eq!(plc.marker_names, names);
    }
    let (plc, _) = read_stl(stl().as_bytes()).expect("one solid");
    assert!(plc.marker_names.is_empty() && plc.facets.iter().all(|f| f.marker == 0));
}

#[test]
fn byte_order_marks_and_padding() {
    let texts: [(fn(&[u8]) -> Reading, String); 8] = [
        (poly, whole_poly()),
        (read_node, NODE.to_owned()),
        (smesh, format!("{NODE}1 1\n3 1 2 3 7\n0\n0\n")),
        (read_off, OFF.to_owned()),
        (read_stl, stl()),
        (read_ply, PLY.to_owned()),
        (read_obj, OBJ.to_owned()),
        (read_medit, MEDIT.to_owned()),
    ];
    for (read, text) in texts {
        let (expected, none) = read(text.as_bytes()).expect("a good file");
        assert!(none.is_empty());
        for marked in [
            format!("\u{feff}{text}"),
            text.replace('\n', "\r"),
            text.replace('\n', "\r\n").replace(' ', "\t  "),
            text.trim_end().to_owned(),
            format!("\n\n {text}\n \n"),
        ] {
            assert_eq!(read(marked.as_bytes()).expect("the same"), (expected.clone(), vec![]));
        }
        let lines = text.lines().count();
        for end in ["\0", "\0\0\0", "\u{1a}", "\0\u{1a}\0"] {
            forgiven(read, &format!("{text}{end}"), &text, NoteCode::TrailingData, lines);
        }
    }
}

fn binary_stl(end: &[u8]) -> Reading {
    let mut bytes = vec![b' '; 80];
    bytes.extend(1u32.to_le_bytes());
    bytes.extend([0; 12]);
    let corners = [[0.0f32, 0.5, 0.25], [1.0, 0.5, 0.25], [0.0, 1.5, 0.25]];
    bytes.extend(corners.as_flattened().iter().flat_map(|x| x.to_le_bytes()));
    bytes.extend([0; 2]);
    bytes.extend(end);
    read_stl(&bytes)
}

/// Bytes that cannot be a triangle are ignored; others mean that the number of triangles is wrong.
#[test]
fn bytes_after_the_last_triangle() {
    let (expected, none) = binary_stl(&[]).expect("a good file");
    assert!(none.is_empty());
    let text = [b'x'; 30].repeat(3);
    for end in [&[1u8][..], &[1, 2, 3, 4, 5, 6, 7, 8, 9, 0], &[0; 500], &text] {
        let (plc, notes) = binary_stl(end).expect("bytes that say nothing");
        assert_eq!(plc, expected);
        assert_eq!((notes.len(), notes[0].code), (1, NoteCode::TrailingData));
        assert!(notes[0].text.contains(&format!("{} byte", end.len())), "{}", notes[0]);
        assert!(notes[0].text.contains("from byte 134 on"), "{}", notes[0]);
    }
    let triangle: Vec<u8> = (0..50).collect();
    assert!(binary_stl(&triangle).is_err());
}

#[test]
fn sections_of_medit() {
    let unknown = "Identifier\n\"G=dom;1, Date: 21/04\nEnd\"\nVertexOnGeometricVertex 1\n1 1\n";
    let (expected, _) = read_medit(MEDIT.as_bytes()).expect("a good file");
    let text = MEDIT.replacen("Triangles", &format!("{unknown}Triangles"), 1);
    let (plc, notes) = read_medit(text.as_bytes()).expect("sections of bamg");
    assert_eq!(plc, expected);
    let [note] = &notes[..] else {
        panic!("{notes:?}");
    };
    assert_eq!((note.code, &note.lines[..]), (NoteCode::UnknownSection, &[9, 12][..]));
    assert!(note.text.contains("Identifier, VertexOnGeometricVertex"), "{note}");

    replaced(read_medit, MEDIT, "End\n", "", NoteCode::Keywords, 12);
    replaced(read_medit, MEDIT, "End\n", "End\nand more\n", NoteCode::TrailingData, 14);
    for version in ["0", "7"] {
        let head = format!("Formatted {version}");
        replaced(read_medit, MEDIT, "Formatted 2", &head, NoteCode::FormatVersion, 1);
    }
    let tets = "Tetrahedra 1\n1 2 3 4 0\nEnd";
    replaced(read_medit, MEDIT, "End", tets, NoteCode::VolumeElements, 13);
    let extra = "Corners 2\n1 2\nRequiredVertices 1 1\nRidges 1\n1\nEdges 1\n1 2 5\nEnd";
    let (plc, notes) = read_medit(MEDIT.replacen("End", extra, 1).as_bytes()).expect("corners");
    assert!(notes.is_empty() && plc.segments[0].marker == 5);
    // What is skipped may hold the surface; and a number where a keyword should be means that a count is wrong.
    assert!(read_medit(MEDIT.replacen("Triangles", "TrianglesP2", 1).as_bytes()).is_err());
    assert!(read_medit(MEDIT.replacen("Triangles\n2", "Triangles\n1", 1).as_bytes()).is_err());
    assert!(read_medit(MEDIT.replacen("Triangles\n2", "Triangles\n3", 1).as_bytes()).is_err());
}

#[test]
fn references_of_medit_are_markers_of_vertices() {
    let (plc, _) = read_medit(MEDIT.replacen("0 0 1 0", "0 0 1 99999999999", 1).as_bytes()).expect("64 bits");
    assert_eq!(plc.vertex_markers, [0, 0, 0, 99999999999]);
    assert!(read_medit(MEDIT.as_bytes()).expect("a good file").0.vertex_markers.is_empty());
}

#[test]
fn words_on_any_lines() {
    let code = NoteCode::LineBreaks;
    let one_line = OFF.replace('\n', " ");
    forgiven(read_off, &one_line, OFF, code, 1);
    replaced(read_off, OFF, "0 0 0\n1 0 0\n", "0 0 0 1 0\n0 ", code, 2);
    replaced(read_off, OFF, "4 2 0\n", "4\n2\n0\n", code, 3);
    let (head, body) = PLY.split_once("end_header\n").expect("a header");
    let body = body.replace('\n', " ");
    forgiven(read_ply, &format!("{head}end_header\n{body}"), PLY, code, 10);
    forgiven(read_ply, &format!("{} end_header {body}", head.replace('\n', " ")), PLY, code, 1);
    // Medit has no lines.
    let (plc, notes) = read_medit(MEDIT.replace('\n', " ").as_bytes()).expect("one line");
    assert_eq!((plc, notes), read_medit(MEDIT.as_bytes()).expect("a good file"));
    // Every word must be used.
    assert!(read_off(format!("{one_line} 1").as_bytes()).is_err());
    assert!(read_ply(format!("{head}end_header\n{body} 1").as_bytes()).is_err());
}

#[test]
fn vertices_numbered_from_anywhere() {
    let from = |first: i64| {
        let node = (0..4).map(|i| format!("{} {} {} {}\n", first + i, i == 1, i == 2, i == 3));
        let node = node.collect::<String>().replace("false", "0").replace("true", "1");
        let corners = [0, 1, 2].map(|i| (first + i).to_string()).join(" ");
        poly(format!("4 3\n{node}1 1\n1 0 7\n3 {corners}\n").as_bytes()).expect("a good file")
    };
    let (expected, _) = poly(whole_poly().as_bytes()).expect("a good file");
    for first in [0, 1, 5, 1000, -7, 1 << 40] {
        let (plc, notes) = from(first);
        assert!(notes.is_empty(), "{notes:?}");
        assert_eq!((&plc.vertices, &plc.facets), (&expected.vertices, &expected.facets));
        let numbers: Vec<i64> = (first..first + 4).collect();
        match first {
            0..=1000 => assert_eq!((i64::from(plc.first_index), plc.numbers), (first, vec![])),
            _ => assert_eq!(plc.numbers, numbers),
        }
    }
}

#[test]
fn vertices_numbered_with_gaps() {
    let text = "4 3\n10 0 0 0\n20 1 0 0\n3 0 1 0\n4 0 0 1\n1 1\n1 0 7\n3 10 20 3\n";
    let (plc, notes) = poly(text.as_bytes()).expect("numbers");
    let (expected, _) = poly(whole_poly().as_bytes()).expect("a good file");
    assert_eq!((&plc.vertices, &plc.facets), (&expected.vertices, &expected.facets));
    assert_eq!((plc.first_index, &plc.numbers[..]), (1, &[10, 20, 3, 4][..]));
    assert_eq!((notes[0].code, &notes[0].lines[..]), (NoteCode::VertexNumbers, &[3, 4][..]));
    for bad in ["3 10 20 5", "3 10 20 0"] {
        let error = poly(text.replacen("3 10 20 3", bad, 1).as_bytes()).expect_err("no vertex");
        assert!(error.to_string().contains("numbered from 3 to 20"), "{error}");
    }
    assert!(poly(text.replacen("4 0 0 1", "20 0 0 1", 1).as_bytes()).is_err());
}

#[test]
fn attributes_and_markers_of_vertices() {
    let node = "3 3 2 1\n1 0 0 0 1.5 -2 7\n2 1 0 0 3 4 -9999999999\n3 0 1 0 5 6 0\n";
    let (plc, notes) = read_node(node.as_bytes()).expect("a good file");
    assert!(notes.is_empty());
    assert_eq!(plc.attributes.per_vertex, 2);
    assert_eq!(plc.attributes.values, [1.5, -2.0, 3.0, 4.0, 5.0, 6.0]);
    assert_eq!(plc.vertex_markers, [7, -9999999999, 0]);
    let beside = || Ok(node.as_bytes().to_vec());
    let (both, _) = read_poly(b"0 3\n1 0\n1\n3 1 2 3\n", beside).expect("a good file");
    assert_eq!((both.attributes, both.vertex_markers), (plc.attributes, plc.vertex_markers));

    let zero = node.replacen("5 6 0", "5 0 0", 1);
    replaced(read_node, &zero, "5 0 0", "5", NoteCode::MissingColumns, 4);
    replaced(read_node, node, "5 6 0", "5 6 0 8 9", NoteCode::ExtraColumns, 4);
    let (plc, _) = read_node(node.replacen("1.5 -2 7", "1.5 -2 7.0", 1).as_bytes()).expect("7.0");
    assert_eq!(plc.vertex_markers[0], 7);
    assert!(read_node(node.replacen("1.5 -2 7", "1.5 -2 7.5", 1).as_bytes()).is_err());
    assert!(read_node(node.replacen("1.5", "nan", 1).as_bytes()).is_err());
    assert!(read_node(b"1 3 4000000000 1\n1 0 0 0\n").is_err());
}

#[test]
fn notes_of_the_node_file_say_so() {
    let node = || Ok(b"3 3\n1 0 0 0\n2 1.0d0 0 0\n3 0 1 0\n".to_vec());
    let (_, notes) = read_poly(b"0 3\n1 0\n1\n3 1 2 3\n", node).expect("a good file");
    assert!(notes[0].text.starts_with("in the .node file of the vertices: "), "{}", notes[0]);
    assert_eq!(notes[0].lines, [3]);
}

#[test]
fn rings_that_are_closed_by_hand() {
    let code = NoteCode::ClosedRing;
    let poly_text = whole_poly();
    replaced(poly, &poly_text, "3 1 2 3", "4 1 2 3 1", code, 8);
    replaced(read_off, OFF, "3 2 1 3", "4 2 1 3 2", code, 8);
    replaced(read_ply, PLY, "3 2 1 3", "4 2 1 3 2", code, 15);
    replaced(read_obj, OBJ, "f 3 2 4", "f 3 2 4 3", code, 6);
    replaced(read_medit, &MEDIT.replacen("End", "Quadrilaterals 0 End", 1), "Triangles\n2\n1 2 3 7\n3 2 4 7",
        "Quadrilaterals 1 1 2 3 1 7 Triangles 1\n3 2 4 7", code, 9);
    // By its coordinates.
    let again = OFF.replacen("4 2 0", "5 2 0", 1).replacen("3 0 1 2", "0 0 0\n3 0 1 2", 1);
    replaced(read_off, &again, "3 0 1 2", "4 0 1 2 4", code, 8);
    // What is degenerate otherwise is not for the reader.
    let (plc, notes) = read_off(OFF.replacen("3 0 1 2", "3 0 1 0", 1).as_bytes()).expect("a face");
    assert!(notes.is_empty() && plc.facets[0].polygons[0].len() == 3);
}

#[test]
fn what_follows_the_last_region() {
    let good = whole_poly();
    let code = NoteCode::TrailingData;
    forgiven(poly, &format!("{good}# part 5\n0 1\n"), &good, code, 12);
    forgiven(poly, &format!("{good}2\n1 0 5\n2 0 7\n"), &good, code, 11);
    // One more region, perhaps: then the number of them is wrong.
    assert!(poly(format!("{good}1 .5 .5 .5 3 -1\n").as_bytes()).is_err());
    let unmarked = good.replacen("1 1\n1 0 7", "1 0\n1 0 0", 1);
    replaced(poly, &unmarked, "1 0 0\n3", "1 0 7\n3", NoteCode::ExtraColumns, 7);
}

#[test]
fn strips_of_triangles() {
    let text = PLY
        .replacen("element face 2", "element tristrips 1", 1)
        .replacen("3 0 1 2\n3 2 1 3\n", "12 0 1 2 3 3 0 -1 0 1 3 3 3\n", 1);
    let (plc, notes) = read_ply(text.as_bytes()).expect("strips");
    let triangles: Vec<[u32; 3]> = plc
        .facets
        .iter()
        .map(|f| [0, 1, 2].map(|i| f.polygons[0][i].0))
        .collect();
    assert_eq!(triangles, [[0, 1, 2], [2, 1, 3], [0, 1, 3]]);
    assert!(notes.is_empty());
    assert!(read_ply(text.replacen("12 0", "12 4", 1).as_bytes()).is_err());
    assert!(read_ply(text.replacen("-1", "-2", 1).as_bytes()).is_err());
}

#[test]
fn labels_and_colours_of_ply() {
    let with = |properties: &str, first: &str, second: &str| {
        let text = PLY
            .replacen("vertex_indices\n", &format!("vertex_indices\n{properties}"), 1)
            .replacen("3 0 1 2", &format!("3 0 1 2 {first}"), 1)
            .replacen("3 2 1 3", &format!("3 2 1 3 {second}"), 1);
        let (plc, notes) = read_ply(text.as_bytes()).expect("a good file");
        assert!(notes.is_empty());
        (plc.facets.iter().map(|f| f.marker).collect::<Vec<_>>(), plc.marker_names)
    };
    assert_eq!(with("property int64 label\n", "-8", "9999999999"), (vec![-8, 9999999999], vec![]));
    let colours = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    let names = vec![(1, "255 0 9".to_owned()), (2, "0 0 0".to_owned())];
    assert_eq!(with(colours, "255 0 9", "0 0 0"), (vec![1, 2], names));
    assert_eq!(with(colours, "1 2 3", "1 2 3"), (vec![0, 0], vec![]));
    let both = format!("{colours}property uchar label\nproperty double quality\n");
    assert_eq!(with(&both, "1 2 3 6 .5", "0 0 0 7 nan"), (vec![6, 7], vec![]));
}

#[test]
fn groups_of_obj() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\no box\ng side \\\n wall\nf 3 2 4\nusemtl red\nf 1 2 4\nl 1 4\n\
        g side wall\nusemtl\nf 1 3 4\n";
    let (plc, notes) = read_obj(text.as_bytes()).expect("groups");
    assert!(notes.is_empty());
    let markers: Vec<i64> = plc.facets.iter().map(|f| f.marker).collect();
    assert_eq!((&markers[..], plc.segments[0].marker), (&[0, 1, 2, 1][..], 2));
    let names = [(1, "box/side wall".to_owned()), (2, "box/side wall/red".to_owned())];
    assert_eq!(plc.marker_names, names);
}

#[test]
fn off_with_prefixes_in_any_order() {
    for (head, extra) in [("NCOFF", 7), ("CNOFF", 7), ("CSTOFF", 6)] {
        let rows = OFF.replacen("OFF", head, 1);
        assert!(read_off(rows.as_bytes()).is_ok(), "{head}");
        let numbers = " 0.5".repeat(extra);
        let words = rows
            .replacen("0 0 0\n1 0 0\n0 1 0\n0 0 1\n", &["0 0 0", "1 0 0", "0 1 0", "0 0 1", ""].join(&format!("{numbers}\n")), 1)
            .replace('\n', " ");
        assert_eq!(read_off(words.as_bytes()).expect(head).0, read_off(OFF.as_bytes()).expect("a good file").0);
    }
    assert!(read_off(OFF.replacen("OFF", "4OFF", 1).as_bytes()).is_err());
}
