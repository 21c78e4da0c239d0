//! The readers of PLY, OBJ, Medit and binary OFF: the same cube in all of them, what they refuse and where, and what
//! `read_plc` says of files that are not what their name says.

mod ply;

use tetflip::exchange::{Note, Plc};
use tetflip::format::{
    FilePosition, FormatError, Reason, read_medit, read_obj, read_off, read_plc,
};
use tetflip::mesh::VertexId;

const FACES: [[u32; 4]; 6] = [
    [0, 2, 3, 1],
    [4, 5, 7, 6],
    [0, 1, 5, 4],
    [2, 6, 7, 3],
    [0, 4, 6, 2],
    [1, 3, 7, 5],
];

/// A cube with an edge of 0.1 as a double, the square root of 2 above the ground.
fn corners() -> Vec<[f64; 3]> {
    let bit = |i: u32, k: u32| f64::from(i >> k & 1) * 0.1;
    (0..8)
        .map(|i| [bit(i, 0), bit(i, 1), 2f64.sqrt() + bit(i, 2)])
        .collect()
}

fn is_the_cube(plc: &Plc, first_index: u32, vertices: &[[f64; 3]]) {
    assert_eq!(plc.first_index, first_index);
    assert_eq!(plc.vertices, vertices);
    assert_eq!(plc.facets.len(), 6);
    for (facet, face) in plc.facets.iter().zip(FACES) {
        assert_eq!(facet.polygons, [face.map(VertexId).to_vec()]);
        assert!(facet.holes.is_empty());
    }
}

fn refusal(result: Result<(Plc, Vec<Note>), FormatError>) -> (FilePosition, Reason) {
    match result {
        Err(FormatError::Malformed { at, reason }) => (at, reason),
        other => panic!("{other:?}"),
    }
}

fn token(token: &str, expected: &'static str) -> Reason {
    let token = token.into();
    Reason::BadToken { token, expected }
}

fn index(index: i64, first: i64, last: i64) -> Reason {
    Reason::IndexOutOfRange { index, first, last }
}

fn negative(what: &'static str) -> Reason {
    Reason::NegativeCount { what, count: -2 }
}

/// The bytes of a number, least significant first, in the order of the file.
fn ordered<const N: usize>(mut bytes: [u8; N], big: bool) -> [u8; N] {
    if big {
        bytes.reverse();
    }
    bytes
}

const OBJ: &str = "# a tetrahedron\r\nmtllib a b.mtl\no caf\u{e9}\nv 0 0 0 1.0\nv 1 0 0 0.5 0.5 0.5\n\
    v 0 \\\n  1 0\nvt 0 0\nvn 0 0 1\ng a\\\n b\nusemtl x#y\ns off\nf 1/1/1 2//1 3/1\nv 0 0 0.1 1 0 0 0\nF -1 -4 2\\\n\n\
    f 2 3 4\nf 4 3 5\nl 1 2 5 -1\np 1 2\nv 9 9 9\nmy_own_word 1 2";

#[test]
fn obj_has_all_its_parts() {
    for text in [OBJ.to_owned(), OBJ.replace('\n', "\r\n")] {
        let (plc, _) = read_obj(text.as_bytes()).expect("a good file");
        assert_eq!(plc.first_index, 1);
        let expected = [
            [0.0; 3],
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, 0.0, 0.1],
            [9.0; 3],
        ];
        assert_eq!(plc.vertices, expected);
        let faces: Vec<_> = plc.facets.iter().map(|f| f.polygons[0].clone()).collect();
        let expected = [[0, 1, 2], [3, 0, 1], [1, 2, 3], [3, 2, 4]];
        assert_eq!(faces, expected.map(|f| f.map(VertexId).to_vec()));
        let segments: Vec<_> = plc.segments.iter().map(|s| s.ends.map(|v| v.0)).collect();
        assert_eq!(segments, [[0, 1], [1, 4], [4, 3]]);
    }
}

#[test]
fn obj_says_where_it_is_wrong() {
    use Reason::*;
    let corner = |word| token(word, "a corner: v, v/vt, v//vn or v/vt/vn");
    let head = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (tail, line, reason) in [
        ("f 1 2\n", 4, ShortFace(2)),
        ("f\n", 4, EmptyFacet),
        ("f 1 2 0\n", 4, index(0, 1, 3)),
        ("f 1 2 -4\n", 4, index(-4, 1, 3)),
        ("f 1 2 9\nf 1 2 3\n", 4, index(9, 1, 3)),
        ("f 1 5 2\nv 0 0 1\nf 5 1 2", 4, index(5, 1, 4)),
        ("f 1 2 99999999999\n", 4, index(99999999999, 1, 3)),
        ("f 1 2 3.0\n", 4, corner("3.0")),
        ("f 1 2 3/x\n", 4, corner("3/x")),
        ("f 1 2 3/1/1/1\n", 4, corner("3/1/1/1")),
        ("f 1 2 /3\n", 4, corner("/3")),
        ("l 1\n", 4, LineEnds("the second vertex of a line")),
        ("v 1 2\n", 4, LineEnds("a coordinate")),
        ("v 1 2 x\n", 4, token("x", "a number")),
        ("v 1 2 3 x\n", 4, token("x", "a number")),
        ("v 1 2 1e999\n", 4, NotFinite("1e999".into())),
        ("v 1,5 2 3\n", 4, DecimalComma("1,5".into())),
        ("v 0x1 2 3\n", 4, token("0x1", "a number")),
        ("f 1 2\n3\n", 4, ShortFace(2)),
        ("vt 1\n3\n", 5, token("3", "a keyword of an OBJ file")),
        ("cstype bezier\n", 4, Unsupported("curves and surfaces are")),
    ] {
        let result = read_obj(format!("{head}{tail}").as_bytes());
        assert_eq!(
            refusal(result),
            (FilePosition::Line(line), reason),
            "{tail}"
        );
    }
    assert_eq!(refusal(read_obj(b"# nothing\n")).1, NoVertices);
}

fn medit() -> String {
    let mut text = "# a cube\nMeshVersionFormatted 2 Dimension\n3\n\nVertices\n8\n".to_owned();
    for [x, y, z] in corners() {
        text += &format!("{x} {y} {z} 7\n");
    }
    text += "Quadrilaterals 6\n";
    for (i, face) in FACES.iter().enumerate() {
        let [a, b, c, d] = face.map(|v| v + 1);
        text += &format!("{a} {b} {c} {d} {i}\n");
    }
    text + "Corners 2 1 2\nNormals\n1\n0 nan 1\nTetrahedra 1\n1 2 3 4 0\nEdges 1\n1 8 -5\nEnd\n"
}

#[test]
fn medit_has_all_its_parts() {
    let text = medit();
    for text in [text.clone(), text.replace('\n', "\r\n")] {
        let (plc, _) = read_medit(text.as_bytes()).expect("a good file");
        is_the_cube(&plc, 1, &corners());
        assert_eq!(plc.facets[5].marker, 5);
        assert_eq!(plc.segments[0].ends, [VertexId(0), VertexId(7)]);
        assert_eq!(plc.segments[0].marker, -5);
    }
    // Line breaks mean nothing but the ends of comments.
    let (_, text) = text.split_once('\n').expect("a comment");
    is_the_cube(
        &read_medit(text.replace('\n', "\t").as_bytes()).unwrap().0,
        1,
        &corners(),
    );
}

#[test]
fn medit_says_where_it_is_wrong() {
    use Reason::*;
    let text = medit();
    let known = "a known keyword of a Medit file";
    let cases: [(&str, &str, usize, Reason); 11] = [
        (
            "MeshVersionFormatted",
            "Mesh",
            2,
            token("Mesh", "MeshVersionFormatted"),
        ),
        ("Dimension\n3", "Dimension\n2", 3, Dimension(2)),
        ("Dimension\n3", "", 4, Missing("Dimension 3 is")),
        ("Vertices\n8", "Vertices\n7", 14, token("0.1", known)),
        (
            "Vertices\n8",
            "Vertices\n9",
            15,
            token("Quadrilaterals", "a number"),
        ),
        (
            "Vertices\n8",
            "Vertices\n4294967294",
            15,
            token("Quadrilaterals", "a number"),
        ),
        (
            "Vertices\n8",
            "Vertices\n-2",
            6,
            negative("the number of vertices"),
        ),
        ("1 3 4 2 0", "1 3 4 9 0", 16, index(9, 1, 8)),
        ("1 3 4 2 0", "1 3 4 0 0", 16, index(0, 1, 8)),
        (
            "1 3 4 2 0",
            "1 3 4 2 9223372036854775808",
            16,
            token("9223372036854775808", "a whole number"),
        ),
        ("Corners 2", "Corners 3", 23, token("Normals", "a number")),
    ];
    for (from, to, line, reason) in cases {
        assert!(text.contains(from), "{from}");
        let result = read_medit(text.replacen(from, to, 1).as_bytes());
        assert_eq!(refusal(result), (FilePosition::Line(line), reason), "{to}");
    }
    let head = "MeshVersionFormatted 1\nDimension 3\n";
    let other = |tail: &str| refusal(read_medit(format!("{head}{tail}").as_bytes())).1;
    assert_eq!(other("End"), NoVertices);
    let first = Missing("the section Vertices, which must come first, is");
    assert_eq!(other("Triangles 1 1 1 1 0"), first);
    let volume = "Vertices 4 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 0 Tetrahedra 1 1 2 3 4 0 End";
    assert_eq!(
        other(volume),
        Unsupported("volume meshes without their surface are")
    );
    let binary = refusal(read_medit(b"\x01\0\0\0\x02\0\0\0"));
    assert_eq!(
        binary,
        (
            FilePosition::Byte(0),
            Unsupported("binary Medit files (.meshb) are")
        )
    );
}

fn off_binary(head: &str, extra: usize, big: bool, colours: bool) -> Vec<u8> {
    let mut bytes = format!("{head} BINARY\n").into_bytes();
    let int = |n: u32| ordered(n.to_le_bytes(), big);
    bytes.extend([int(8), int(6), int(0)].concat());
    for point in corners() {
        for x in point {
            bytes.extend(ordered((x as f32).to_le_bytes(), big));
        }
        bytes.extend(vec![63; extra]);
    }
    for (i, face) in FACES.iter().enumerate() {
        bytes.extend(
            [
                int(4),
                int(face[0]),
                int(face[1]),
                int(face[2]),
                int(face[3]),
            ]
            .concat(),
        );
        if colours {
            bytes.extend(int(i as u32));
            bytes.extend(vec![7; 4 * i]);
        }
    }
    bytes
}

#[test]
fn binary_off_of_every_layout() {
    let singles: Vec<[f64; 3]> = corners()
        .iter()
        .map(|p| p.map(|x| f64::from(x as f32)))
        .collect();
    for (head, extra) in [("OFF", 0), ("STCNOFF", 36), ("NOFF", 12)] {
        for (big, colours) in [(true, true), (true, false), (false, true), (false, false)] {
            let bytes = off_binary(head, extra, big, colours);
            is_the_cube(&read_off(&bytes).expect("a good file").0, 0, &singles);
            for length in 0..bytes.len() {
                assert!(read_off(&bytes[..length]).is_err(), "{length}");
            }
            assert!(read_off(&[&bytes[..], b"x"].concat()).is_err());
        }
    }
    let mut bytes = off_binary("OFF", 0, true, true);
    let face = 11 + 12 + 8 * 12;
    bytes[face + 7] = 8;
    assert_eq!(
        refusal(read_off(&bytes)),
        (FilePosition::Byte(face + 4), index(8, 0, 7))
    );
    bytes[15..19].fill(255);
    assert!(matches!(
        refusal(read_off(&bytes)).1,
        Reason::NegativeCount { .. }
    ));
    bytes[15] = 127;
    assert!(matches!(refusal(read_off(&bytes)).1, Reason::Truncated(_)));
}

/// Every reader says which file it is and what it looks like.
#[test]
fn misnamed_and_packed_files_are_named() {
    let place = tempfile::tempdir().expect("a temporary directory");
    let said = |name: &str, bytes: &[u8]| {
        let path = place.path().join(name);
        std::fs::write(&path, bytes).expect("a file");
        read_plc(&path).expect_err("no good file").to_string()
    };
    for extension in ["poly", "smesh", "node", "off", "stl", "ply", "obj", "mesh"] {
        let name = format!("a.{extension}");
        let gzip = said(&name, b"\x1f\x8b\x08\0\0\0");
        assert_eq!(
            gzip,
            "byte 0: the file is compressed (gzip); unpack it first"
        );
        let page = said(&name, b"\n<!DOCTYPE html>\n<html>v 1 2 3</html>");
        assert!(page.contains("looks like a web page"), "{name}: {page}");
        let wide = said(&name, b"\xff\xfeO\0F\0F\0");
        assert!(wide.contains("UTF-16"), "{wide}");
        said(&name, b"");
        let directory = place.path().join(format!("d.{extension}"));
        std::fs::create_dir(&directory).expect("a directory");
        let directory = read_plc(&directory).expect_err("a directory");
        assert!(matches!(directory, FormatError::Io { .. }), "{directory}");
    }
    let off = said("a.stl", b"OFF\n8 6 12\n");
    assert!(
        off.ends_with("looks like an OFF file, whatever its extension)"),
        "{off}"
    );
    let ply = said("a.xyz", b"ply\nformat ascii 1.0\n");
    assert!(
        ply.contains("\"xyz\"") && ply.contains("a PLY file"),
        "{ply}"
    );
    let binary = said("a.meshb", b"\0\0\0\x01\0\0\0\x02");
    assert_eq!(
        binary,
        "byte 0: binary Medit files (.meshb) are not supported"
    );
}

/// `A.POLY` has its vertices in `A.NODE`.
#[test]
fn extensions_in_capitals() {
    let place = tempfile::tempdir().expect("a temporary directory");
    let write = |name: &str, text: &str| {
        let path = place.path().join(name);
        std::fs::write(&path, text).expect("a file");
        path
    };
    write("A.NODE", "3 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n");
    let (plc, _) = read_plc(&write("A.POLY", "0 3 0 0\n1 0\n1\n3 0 1 2\n")).expect("a good file");
    assert_eq!((plc.vertices.len(), plc.facets.len()), (3, 1));
    is_the_cube(
        &read_plc(&write("a.Mesh", &medit())).expect("a good file").0,
        1,
        &corners(),
    );
}
