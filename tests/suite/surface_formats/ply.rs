//! PLY: every encoding and line ending, and where it is wrong.

use super::*;
use tetflip::format::read_ply;

fn ply_header(format: &str, real: &str, counter: &str, whole: &str) -> String {
    format!(
        "ply\nformat {format} 1.0\ncomment caf\u{e9} # no comment sign\nobj_info x\nelement vertex 8\n\
         property uchar red\n\
         property {real} x\nproperty {real} y\nproperty {real} z\nproperty list uchar short weights\nelement face 6\n\
         property list {counter} {whole} vertex_indices\nproperty int id\nelement empty 4000000000\nelement edge 1\n\
         property int vertex1\nproperty int vertex2\nend_header\n"
    )
}

fn ply_ascii() -> String {
    let mut text = ply_header("ascii", "float", "uchar", "int");
    for [x, y, z] in corners() {
        text += &format!("255 {x} {y} {z} 2 -7 8\n");
    }
    for [a, b, c, d] in FACES {
        text += &format!("4 {a} {b} {c} {d} 99\n");
    }
    text + "0 7\n"
}

fn ply_binary(big: bool, double: bool, whole: &str) -> Vec<u8> {
    let format = if big {
        "binary_big_endian"
    } else {
        "binary_little_endian"
    };
    let real = if double { "double" } else { "float32" };
    let mut bytes = ply_header(format, real, "uint16", whole).into_bytes();
    for point in corners() {
        bytes.push(255);
        for x in point {
            if double {
                bytes.extend(ordered(x.to_le_bytes(), big));
            } else {
                bytes.extend(ordered((x as f32).to_le_bytes(), big));
            }
        }
        bytes.extend([1, b'\n', b'\r']);
    }
    for face in FACES {
        bytes.extend(ordered(4u16.to_le_bytes(), big));
        for v in face {
            match whole {
                "uchar" | "int8" => bytes.push(v as u8),
                "short" => bytes.extend(ordered((v as i16).to_le_bytes(), big)),
                _ => bytes.extend(ordered(v.to_le_bytes(), big)),
            }
        }
        bytes.extend([10; 4]);
    }
    bytes.extend([[0; 4], ordered(7i32.to_le_bytes(), big)].concat());
    bytes
}

#[test]
fn ply_of_every_encoding() {
    let text = ply_ascii();
    let singles: Vec<[f64; 3]> = corners()
        .iter()
        .map(|p| p.map(|x| f64::from(x as f32)))
        .collect();
    for ending in ["\n", "\r\n", "\r"] {
        let (plc, _) = read_ply(text.replace('\n', ending).as_bytes()).expect("a good file");
        is_the_cube(&plc, 0, &corners());
        assert_eq!(plc.segments[0].ends, [VertexId(0), VertexId(7)]);
    }
    for big in [false, true] {
        for whole in ["uchar", "int8", "short", "int", "uint32"] {
            let (plc, _) = read_ply(&ply_binary(big, true, whole)).expect("a good file");
            is_the_cube(&plc, 0, &corners());
            assert_eq!(plc.segments[0].ends, [VertexId(0), VertexId(7)]);
            let (plc, _) = read_ply(&ply_binary(big, false, whole)).expect("a good file");
            is_the_cube(&plc, 0, &singles);
        }
    }
    let other_name = text.replace("vertex_indices", "vertex_index");
    is_the_cube(&read_ply(other_name.as_bytes()).unwrap().0, 0, &corners());
}

/// After CR alone, a first byte of 10 belongs to the first number; after CR LF it does not.
#[test]
fn binary_ply_after_every_line_ending() {
    let header = "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty uchar r\nproperty int x\nproperty \
                  char y\nproperty ushort z\nend_header\n";
    for ending in ["\n", "\r\n", "\r"] {
        let mut bytes = header.replace('\n', ending).into_bytes();
        bytes.extend([10, 254, 255, 255, 255, 128, 255, 255]);
        let (plc, _) = read_ply(&bytes).expect(ending);
        assert_eq!(plc.vertices, [[-2.0, -128.0, 65535.0]]);
    }
}

#[test]
fn ply_says_where_it_is_wrong() {
    use Reason::*;
    let text = ply_ascii();
    let cases: [(&str, &str, usize, Reason); 19] = [
        ("ply\n", "plyx\n", 1, token("plyx", "ply")),
        ("1.0", "1.1", 2, token("1.1", "the version 1.0")),
        ("format ascii 1.0\n", "", 17, Missing("the line format is")),
        (
            "vertex 8",
            "vertex -2",
            5,
            negative("the number of vertices"),
        ),
        (
            "vertex 8",
            "vertex 4294967295",
            5,
            TooManyVertices(u32::MAX.into()),
        ),
        ("vertex 8", "vertex 0", 5, NoVertices),
        (
            "float z",
            "float w",
            11,
            Missing("one of the properties x, y and z of vertices is"),
        ),
        ("float z", "float y", 9, Twice("this property is")),
        (
            "uchar int",
            "float int",
            12,
            token("float", "a type of whole numbers"),
        ),
        (
            "uchar int",
            "uchar double",
            12,
            token("double", "a type of whole numbers"),
        ),
        (
            "vertex_indices",
            "corners",
            14,
            Missing("the list vertex_indices of faces is"),
        ),
        (
            "element empty 4000000000",
            "element tristrips 1",
            15,
            Missing("the list vertex_indices of faces is"),
        ),
        (
            "end_header\n",
            "",
            18,
            token(
                "255",
                "format, element, property, comment, obj_info or end_header",
            ),
        ),
        ("4 0 2 3 1 99", "4 0 2 3 8 99", 27, index(8, 0, 7)),
        (
            "4 0 2 3 1 99",
            "-2 0 2 3 1 99",
            27,
            negative("the number of corners"),
        ),
        ("4 0 2 3 1 99", "2 0 2 99", 27, ShortFace(2)),
        ("4 0 2 3 1 99", "4 0 2 3 1", 27, LineEnds("a property")),
        ("4 0 2 3 1 99", "4 0 2 3 1 99 1", 27, Trailing("1".into())),
        ("255 0 0 ", "255 0 1,5 ", 19, DecimalComma("1,5".into())),
    ];
    for (from, to, line, reason) in cases {
        assert!(text.contains(from), "{from}");
        let result = read_ply(text.replacen(from, to, 1).as_bytes());
        assert_eq!(refusal(result), (FilePosition::Line(line), reason), "{to}");
    }
    let more = read_ply((text.clone() + "\n\nx").as_bytes());
    assert_eq!(
        refusal(more),
        (FilePosition::Line(36), Trailing("x".into()))
    );
    let fewer = text.strip_suffix("0 7\n").expect("an edge");
    assert_eq!(refusal(read_ply(fewer.as_bytes())).1, Truncated("an edge"));

    let bytes = ply_binary(true, true, "int");
    let start = ply_header("binary_big_endian", "double", "uint16", "int").len();
    let mut nan = bytes.clone();
    nan[start + 9..start + 17].copy_from_slice(&f64::NAN.to_be_bytes());
    assert_eq!(
        refusal(read_ply(&nan)),
        (FilePosition::Byte(start + 9), NotFinite("NaN".into()))
    );
    let faces = start + 8 * 28;
    let mut range = bytes.clone();
    range[faces + 2] = 128;
    let reason = index(i64::from(i32::MIN), 0, 7);
    assert_eq!(
        refusal(read_ply(&range)),
        (FilePosition::Byte(faces + 2), reason)
    );
    for length in start..bytes.len() {
        let (place, reason) = refusal(read_ply(&bytes[..length]));
        assert!(matches!((place, reason), (FilePosition::Byte(n), Truncated(_)) if n == length));
    }
    let more = [&bytes[..], b"\n\0\n\0\n\0\n\0"].concat();
    assert_eq!(
        refusal(read_ply(&more)),
        (FilePosition::Byte(bytes.len()), Trailing("8 bytes".into()))
    );
    assert!(read_ply(&[&bytes[..], b"\r\n"].concat()).is_ok());
}
