//! The readers of TetGen's files, OFF and STL: what they must accept, and what they must refuse and where. The other
//! formats are in `surface_formats`, random files in `fuzz_formats`.

use tetflip::exchange::{Note, Plc};
use tetflip::format::{
    FilePosition, FormatError, Reason, read_node, read_off, read_plc, read_poly, read_smesh,
    read_stl, write_poly,
};
use tetflip::mesh::VertexId;

const POLY: &str = "# a pyramid with a window, a crack, and a wire
6 3 1 1   # attributes and markers
1  0 0 0  7 1
2  4 0 0  7 1

3  4 4 0  7 1
4  0 4 0  7 1
5  2 2 4  7 1
6  1 1 0  7 1
6 1
3 1 9 # polygons, holes, marker
4  1 2
   3 4
2 1 6
1 6
1  2.0 2.0 0.0
1 0 1
3 1 2 5
1 0 2
3 2 3 5
1
3 3 4 5
1 0 -4
2 4 5
1 0 5
1 6
1
1 1 1 1
2
1 0.5 0.5 0.5 10 -1
2 1.5 0.5 0.5 20 0.25
";

const SMESH: &str =
    "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n3 1\n3 0 1 2 5\n4 3 2\n 1 0\n2 0 3 6\n0\n";

const OFF: &str = "OFF # tetrahedron\r\n4 2\r\n\r\n0 0 0 255 0 0\r\n1 0 0\r\n# c\r\n0 1 0\r\n0 0 1\r\n\
    3 0 1 2 0.5 0.5 0.5\r\n3 2 1 3 # c\r\n";

const STL: &str = " solid a name\r\nfacet normal 0 0 nan\r\nouter loop\r\nvertex 0 0 0\r\nvertex 1 0 0\r\n\
    vertex 0 1 0\r\nendloop\r\nendfacet\r\n\
    facet normal 0 0 1\r\n OUTER LOOP\r\nvertex -0 -0.0 0\r\nvertex 0 1e0 0\r\nvertex 0 0 1\r\nendloop\r\nendfacet\r\n\
    endsolid a name\r\n";

fn poly(text: &str) -> Result<(Plc, Vec<Note>), FormatError> {
    read_poly(text.as_bytes(), || {
        Ok(b"3 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n".to_vec())
    })
}

fn binary_stl(header: &[u8], triangles: &[[[f32; 3]; 3]]) -> Vec<u8> {
    let mut bytes = header.to_vec();
    bytes.resize(80, b' ');
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for triangle in triangles {
        bytes.extend([0; 12]);
        bytes.extend(triangle.iter().flatten().flat_map(|x| x.to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

fn ids<const N: usize>(ids: [u32; N]) -> Vec<VertexId> {
    ids.map(VertexId).to_vec()
}

/// The line and the reason of a refusal.
fn refusal(result: Result<(Plc, Vec<Note>), FormatError>) -> (FilePosition, Reason) {
    match result {
        Err(FormatError::Malformed { at, reason }) => (at, reason),
        other => panic!("{other:?}"),
    }
}

#[test]
fn poly_has_all_its_parts() {
    let (plc, _) = poly(POLY).unwrap();
    assert_eq!((plc.first_index, plc.vertices.len()), (1, 6));
    assert_eq!(plc.vertices[4], [2.0, 2.0, 4.0]);
    assert_eq!(plc.facets.len(), 4);
    let base = &plc.facets[0];
    assert_eq!(base.polygons, [ids([0, 1, 2, 3]), ids([0, 5]), ids([5])]);
    assert_eq!((base.holes[0], base.marker), ([2.0, 2.0, 0.0], 9));
    assert_eq!(plc.facets[3].marker, 0);
    assert_eq!(plc.segments.len(), 1);
    assert_eq!(plc.segments[0].ends.to_vec(), ids([3, 4]));
    assert_eq!(plc.segments[0].marker, -4);
    assert_eq!(plc.holes, [[1.0; 3]]);
    assert_eq!(plc.regions[0].max_volume, None);
    assert_eq!(
        (plc.regions[1].attribute, plc.regions[1].max_volume),
        (20.0, Some(0.25))
    );
}

/// Shortest digits, every sign of zero, subnormal numbers, all sections.
#[test]
fn poly_is_written_as_it_is_read() {
    let place = tempfile::tempdir().expect("a temporary directory");
    let path = place.path().join("a.poly");
    let (mut plc, _) = poly(POLY).expect("a good file");
    plc.vertices[1] = [0.1, -5e-324, 1.7976931348623157e308];
    plc.vertices[2] = [-0.0, 1e15, 4f64.next_up()];
    write_poly(&path, &plc).expect("a writable directory");
    let (read, _) = read_plc(&path).expect("what was written");
    assert_eq!(read, plc);
    assert!(read.vertices[2][0].is_sign_negative());
}

#[test]
fn smesh_counts_from_zero() {
    let (plc, _) = read_smesh(SMESH.as_bytes(), || unreachable!("vertices are here")).unwrap();
    assert_eq!(plc.first_index, 0);
    assert_eq!(plc.facets[0].polygons, [ids([0, 1, 2])]);
    assert_eq!(plc.facets[0].marker, 5);
    assert_eq!(plc.facets[1].polygons, [ids([3, 2, 1, 0])]);
    assert_eq!(plc.facets[1].marker, 0);
    assert_eq!(
        (plc.segments[0].ends.to_vec(), plc.segments[0].marker),
        (ids([0, 3]), 6)
    );
}

#[test]
fn empty_vertex_list_refers_to_the_node_file() {
    let (plc, _) = poly("0 3 0 0\n1 0\n1\n3 0 1 2\n").unwrap();
    assert_eq!(
        (plc.first_index, plc.vertices.len(), plc.facets.len()),
        (0, 3, 1)
    );
    let nodes = |text: &'static str| read_poly(b"0 3\n0\n", || Ok(text.into()));
    assert!(matches!(nodes("0 3 0 0\n"), Err(FormatError::NodeFile(_))));
    assert!(matches!(
        nodes("2 3 0 0\n1 0 0 x"),
        Err(FormatError::NodeFile(_))
    ));
}

#[test]
fn poly_may_end_at_a_section() {
    let head = "3 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n";
    for tail in [
        "1 1\n1 0 1\n3 1 2 3",
        "1 0\n1\n3 1 2 3\n0\n",
        "1 0\n1\n3 1 2 3\n0\n0\n",
    ] {
        assert!(poly(&format!("{head}{tail}")).is_ok(), "{tail}");
    }
}

#[test]
fn poly_says_where_it_is_wrong() {
    use Reason::*;
    let head = "3 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n";
    let index = |index| IndexOutOfRange {
        index,
        first: 1,
        last: 3,
    };
    let negative = |what| NegativeCount { what, count: -2 };
    let token = |token: &str, expected| BadToken {
        token: token.into(),
        expected,
    };
    for (tail, line, reason) in [
        ("", 4, Truncated("the number of facets")),
        ("1 0\n1\n", 6, Truncated("a polygon")),
        ("1 0\n1\n3 1 2", 7, Truncated("a corner")),
        ("1 0\n1 0\n3 1 2 4\n", 7, index(4)),
        ("1 0\n1 0\n3 0 1 2\n", 7, index(0)),
        ("-2\n", 5, negative("the number of facets")),
        ("1\n1\n-2 1\n", 7, negative("the number of corners")),
        ("1\n1\n3 1 2 3 1\n", 7, Trailing("1".into())),
        ("1\n1\n3 1 2 3.0\n", 7, token("3.0", "a whole number")),
        ("1\n0\n", 6, EmptyFacet),
        ("1\n1\n0\n", 7, EmptyFacet),
        ("1\n1 1\n3 1 2 3\n1 0 0\n", 8, LineEnds("a coordinate")),
        ("99999999999999999\n1\n3 1 2 3\n", 7, Truncated("a facet")),
        ("1\n1\n99999999999999999 1\n", 7, Truncated("a corner")),
        ("1\n1\n3 1 2 3\n1\n", 8, Truncated("a hole")),
        (
            "1\n1\n3 1 2 3\n0\n1\n1 0 0 0\n",
            10,
            LineEnds("the attribute of a region"),
        ),
        (
            "1\n1\n3 1 2 3\n0\n0\n1 2 3 4 5 6\n",
            10,
            Trailing("1".into()),
        ),
    ] {
        let (place, found) = refusal(poly(&format!("{head}{tail}")));
        assert_eq!((place, found), (FilePosition::Line(line), reason), "{tail}");
    }
    let other = |text: &str| refusal(poly(text)).1;
    assert_eq!(other(""), Truncated("the number of vertices"));
    assert_eq!(other("3 2\n"), Dimension(2));
    assert_eq!(other("1 3\n1 0 inf 0\n"), NotFinite("inf".into()));
    assert_eq!(other("1 3\n1 0 1.0x 0\n"), token("1.0x", "a number"));
    assert_eq!(other("2 3\n3 0 0 0\n3 0 0 0\n"), NumberTwice(3));
    assert_eq!(other("4294967295 3\n"), TooManyVertices(4294967295));
}

#[test]
fn node_is_points_alone() {
    let (plc, _) = read_node(b"2 3 0 1\n1 0 0 0 4\n2 1e-3 2 3 5\n").unwrap();
    assert_eq!(plc.vertices, [[0.0; 3], [1e-3, 2.0, 3.0]]);
    assert_eq!(
        refusal(read_node(b"1 3\n1 0 0 0\n1 0 0 0\n")).0,
        FilePosition::Line(3)
    );
}

#[test]
fn off_variants() {
    let (plc, _) = read_off(OFF.as_bytes()).unwrap();
    assert_eq!((plc.vertices.len(), plc.facets.len()), (4, 2));
    assert_eq!(plc.facets[1].polygons, [ids([2, 1, 3])]);
    let rest = "3 1 0\n0 0 0 9 9\n1 0 0\n0 1 0\n3 0 1 2 255\n";
    for head in [
        "OFF ",
        "COFF\n",
        "NOFF\n",
        "STOFF\n",
        "STCNOFF\n",
        "off\n#\n",
        "",
        "\u{feff}OFF\n",
    ] {
        let (plc, _) = read_off(format!("{head}{rest}").as_bytes()).expect(head);
        assert_eq!((plc.vertices.len(), plc.facets.len()), (3, 1));
    }
}

#[test]
fn off_says_where_it_is_wrong() {
    use Reason::*;
    let vertices = "0 0 0\n1 0 0\n0 1 0\n";
    let index = |index| IndexOutOfRange {
        index,
        first: 0,
        last: 2,
    };
    let not_off = BadToken {
        token: "ply".into(),
        expected: "OFF, COFF, NOFF or STOFF",
    };
    for (text, line, reason) in [
        ("ply\n".into(), 1, not_off),
        ("nOFF 4 1 0 0\n".into(), 1, Dimension(4)),
        ("4OFF\n1 0 0\n".into(), 1, Dimension(4)),
        ("OFF\n0 0 0\n".into(), 2, NoVertices),
        (
            "OFF\n3 -1 0\n".into(),
            2,
            NegativeCount {
                what: "the number of faces",
                count: -1,
            },
        ),
        (
            format!("OFF\n3 2 0\n{vertices}3 0 1 2\n"),
            6,
            Truncated("a face"),
        ),
        (
            format!("OFF\n3 0 0\n{vertices}3 0 1 2\n"),
            6,
            Trailing("3".into()),
        ),
        (format!("OFF\n3 1 0\n{vertices}2 0 1\n"), 6, ShortFace(2)),
        (format!("OFF\n3 1 0\n{vertices}1 0\n"), 6, ShortFace(1)),
        (format!("OFF\n3 1 0\n{vertices}0\n"), 6, EmptyFacet),
        (format!("OFF\n3 1 0\n{vertices}3 0 1 3\n"), 6, index(3)),
        (format!("OFF\n3 1 0\n{vertices}3 0 1 -1\n"), 6, index(-1)),
        ("OFF\n1 0 0\n0 NaN 0\n".into(), 3, NotFinite("NaN".into())),
        ("OFF\n1 0 0\n0 0\n".into(), 3, LineEnds("a coordinate")),
    ] {
        assert_eq!(
            refusal(read_off(text.as_bytes())),
            (FilePosition::Line(line), reason),
            "{text}"
        );
    }
}

#[test]
fn stl_merges_equal_corners() {
    let (plc, _) = read_stl(STL.as_bytes()).unwrap();
    assert_eq!(plc.vertices.len(), 4);
    assert_eq!(plc.facets[1].polygons, [ids([0, 2, 3])]);
    let a = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.1, 0.0]];
    let b = [[-0.0, 0.0, 0.0], [0.0, 0.1, 0.0], [0.0, 0.0, 1.0]];
    // The header of a binary file may pretend that it is text.
    for header in ["", "solid facet normal"] {
        let (plc, _) = read_stl(&binary_stl(header.as_bytes(), &[a, b])).unwrap();
        assert_eq!((plc.vertices.len(), plc.facets.len()), (4, 2));
        assert_eq!(plc.vertices[2][1], f64::from(0.1f32));
    }
}

#[test]
fn ascii_stl_of_any_size_is_ascii() {
    for n in 0..50 {
        let text = format!("{STL}{}", " ".repeat(n));
        assert!(read_stl(text.as_bytes()).is_ok(), "{n}");
    }
}

#[test]
fn stl_says_where_it_is_wrong() {
    let mut nan = binary_stl(b"", &[[[0.0, 0.0, 0.0], [1.0, f32::NAN, 0.0], [0.0; 3]]]);
    assert_eq!(refusal(read_stl(&nan)).0, FilePosition::Byte(84 + 12 + 16));
    nan.pop();
    let size = Reason::StlSize {
        triangles: 1,
        expected: 134,
        found: 133,
    };
    assert_eq!(refusal(read_stl(&nan)), (FilePosition::Byte(80), size));
    let mut huge = binary_stl(b"part", &[]);
    huge[80..84].fill(255);
    assert!(matches!(refusal(read_stl(&huge)).1, Reason::StlSize { .. }));
    assert_eq!(refusal(read_stl(b"")).1, Reason::Truncated("the header"));
    assert_eq!(
        refusal(read_stl(b"solid\nendsolid\n")).1,
        Reason::NoVertices
    );
    for cut in ["outer loop", "vertex 0 1e0", "vertex 0 0 1"] {
        let text = STL.replace("OUTER", "outer");
        let (text, _) = text.rsplit_once(cut).expect("a word of the last facet");
        assert!(
            matches!(refusal(read_stl(text.as_bytes())).1, Reason::Truncated(_)),
            "{cut}"
        );
    }
    let quad = STL.replacen("endloop", "vertex 0 0 9\nendloop", 1);
    assert_eq!(refusal(read_stl(quad.as_bytes())).0, FilePosition::Line(7));
}
