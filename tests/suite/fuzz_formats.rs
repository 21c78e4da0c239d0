//! Readers on files that nobody meant: random bytes, and valid files of each format that were cut, spliced and edited.
//! No reader panics, none allocates or loops by a count that a header announces, and what is accepted is in range.
//!
//! `PROPTEST_CASES=1000000 cargo test --release --test suite fuzz_formats` looks harder.

use proptest::prelude::*;
use std::time::{Duration, Instant};
use tetflip::exchange::{Note, Plc};
use tetflip::format::{
    FormatError, read_medit, read_mesh, read_node, read_obj, read_off, read_ply, read_poly,
    read_smesh, read_stl,
};

const POLY: &str = "# a tetrahedron, a crack and a wire
6 3 1 1
1  0 0 0  7 1
2  4 0 0  7 1
3  4 4 0  7 1
4  0 4 0  7 1
5  2 2 4  7 1
6  1 1 0  7 1
4 1
3 1 9
4  1 2
   3 4
2 1 6
1 6
1  2.0 2.0 0.0
1 0 1
3 1 2 5
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
    "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n3 1\n3 0 1 2 5\n4 3 2\n 1 0\n2 0 3 6\n0\n0\n";
const NODE: &str = "3 3 1 1\n1 0 0 0 4 1\n2 1e-3 -2.5e+2 .3 5 0\n3 1 2 3 6 0\n";
const OFF: &str =
    "COFF # c\r\n4 2 0\r\n0 0 0 255 0 0\r\n1 0 0\r\n0 1 0\r\n0 0 1\r\n3 0 1 2 0.5\r\n3 2 1 3\r\n";
const STL: &str = "solid a\nfacet normal 0 0 nan\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n\
    endfacet\n\
    facet normal 0 0 1\nouter loop\nvertex -0 -0.0 0\nvertex 0 1e0 0\nvertex 0 0 1\nendloop\nendfacet\nendsolid a\n";
const PLY: &str = "ply\nformat ascii 1.0\ncomment c\nelement vertex 4\nproperty float x\nproperty double y\n\
    property int z\n\
    property list uchar float w\nelement face 2\nproperty list uchar int vertex_indices\nproperty uchar r\n\
    element e 2\n\
    element edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n0 0 0 2 1 1\n1 0 0 0\n0 1 0 1 nan\n\
    0 0 1 0\n\
    3 0 1 2 9\n4 0 1 2 3 9\n0 3\n";
const PLY_HEADER: &str = "element vertex 4\nproperty float x\nproperty double y\nproperty short z\n\
    property list uchar ushort \
    w\nelement face 2\nproperty list uint16 int32 vertex_index\nelement edge 1\nproperty uchar vertex1\nproperty uint \
    vertex2\nend_header\n";
const OBJ: &str = "# c\nmtllib a.mtl\no a\nv 0 0 0 1.0\nv 1 0 0 0.5 0.5 0.5\nv 0 \\\n 1 0\nvt 0 0\nvn 0 0 1\n\
    f 1/1/1 2//1 3/1\n\
    v 0 0 0.1\nf -1 -4 2\nl 1 2 -1\np 1 2\n";
const MEDIT: &str = "MeshVersionFormatted 2\nDimension 3\n# c\nVertices\n4\n0 0 0 1\n1 0 0 1\n0 1 0 1\n0 0 1 1\n\
    Triangles 2\n\
    1 2 3 7\n2 1 4 7\nQuadrilaterals 1\n1 2 3 4 8\nEdges 1\n1 4 2\nCorners 2 1 2\nNormals 1\n0 0 1\nTetrahedra 1\n\
    1 2 3 4 0\n\
    End\n";

fn stl_binary() -> Vec<u8> {
    let mut bytes = b"solid or not".to_vec();
    bytes.resize(80, b' ');
    bytes.extend(2u32.to_le_bytes());
    for k in 0..2u8 {
        bytes.extend([0; 12]);
        for x in [0, 0, 0, 1, 0, 0, 0, 1, k] {
            bytes.extend(f32::from(x).to_le_bytes());
        }
        bytes.extend([0; 2]);
    }
    bytes
}

fn off_binary(big: bool) -> Vec<u8> {
    let mut bytes = b"NOFF BINARY\n".to_vec();
    let mut words: Vec<u32> = vec![4, 2, 6];
    for p in [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]] {
        words.extend(p.map(|x: u8| f32::from(x).to_bits()));
        words.extend([0, 0, 1]);
    }
    words.extend([3, 0, 1, 2, 0, 4, 0, 1, 2, 3, 2, 7, 7]);
    for word in words {
        bytes.extend(if big {
            word.to_be_bytes()
        } else {
            word.to_le_bytes()
        });
    }
    bytes
}

fn ply_binary(big: bool) -> Vec<u8> {
    let format = if big { "big" } else { "little" };
    let mut bytes = format!("ply\nformat binary_{format}_endian 1.0\n{PLY_HEADER}").into_bytes();
    // Numbers of so many bytes, the least significant first.
    let mut put = |mut number: Vec<u8>| {
        if big {
            number.reverse();
        }
        bytes.extend(number);
    };
    for [x, y, z] in [[0u8, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]] {
        put(f32::from(x).to_le_bytes().to_vec());
        put(f64::from(y).to_le_bytes().to_vec());
        put(vec![z, 0]);
        put(vec![1]);
        put(vec![7, 7]);
    }
    for face in [&[0u8, 1, 2][..], &[3, 2, 1, 0]] {
        put(vec![face.len() as u8, 0]);
        face.iter().for_each(|&v| put(vec![v, 0, 0, 0]));
    }
    put(vec![0]);
    put(vec![3, 0, 0, 0]);
    bytes
}

const NUMBERS: &str = "4, 3, 1, 1\n5 0 0 0 1.0D+00 7\n9, 1, 0, 0, 2\n-3 0 1 0 3 4 5\n6,0,0,1,0,0\n2 0\n1\n\
    4 5 9 6 5 // c\n1 0 7\n\
    3 -3 6 9\n0\n0\n# part 5\n0 1\n\0";
const OFF_WORDS: &str =
    "NCOFF 3 1 0 0 0 0 1 2 3 4 5 6 7 1 0 0 1 2 3 4 5 6 7 0 1 0 1 2 3 4 5 6 7 3 0 1 2";
const STL_BARE: &str = "! c\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nend loop\n\
    facet\nouter loop\n\
    vertex 0 0 0\nvertex 1 0 0\nvertex 0 0 1\nend facet\nend solid\nsolid b\n\
    facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 \
    1 0 vertex 0 1 0";
const PLY_STRIPS: &str = "ply { c }\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n\
    property float z\n\
    element tristrips 1\nproperty list int int vertex_indices\nelement face 2\nproperty list uchar int vertex_index\n\
    property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n0 0 0 { c }\n1 0 0\n0 1 0\n0 0 1\n\
    6 0 1 2 3 -1 0\n4 0 1 2 0 255 0 0\n3 1 2 3 0 0 255\n";
const OBJ_NAMES: &str =
    "o a\nv 0, 0, 0\nv 1 0 0\nv 0 1.d0 0\nv 0 0 1\ng b c\nf 1 2 3 1\nusemtl d\nf 1 2 4\nl 1 4\n";
const MEDIT_BAMG: &str = "MeshVersionFormatted 0 Dimension 3 Vertices 4 0 0 0 1 1 0 0 9 0 1 0 1 0 0 1 1 \
    Identifier \"a b\" Geometry \n\
    \"c\" VertexOnGeometricVertex 1 1 1\nQuadrilaterals 1\n1 2 3 1 8\nTetrahedra 1 1 2 3 4 0";

/// Valid files of every format, and files that need forgiving.
fn seeds() -> Vec<Vec<u8>> {
    let texts = [
        POLY, SMESH, NODE, OFF, STL, PLY, OBJ, MEDIT, NUMBERS, OFF_WORDS, STL_BARE, PLY_STRIPS,
        OBJ_NAMES, MEDIT_BAMG,
    ];
    let mut seeds: Vec<Vec<u8>> = texts.iter().map(|t| t.as_bytes().to_vec()).collect();
    seeds.push(stl_binary());
    for big in [false, true] {
        seeds.extend([off_binary(big), ply_binary(big)]);
    }
    seeds
}

fn read_with_all(bytes: &[u8]) -> Vec<Result<(Plc, Vec<Note>), FormatError>> {
    let node = || Ok(bytes.to_vec());
    vec![
        read_poly(bytes, node),
        read_smesh(bytes, node),
        read_node(bytes),
        read_off(bytes),
        read_stl(bytes),
        read_ply(bytes),
        read_obj(bytes),
        read_medit(bytes),
    ]
}

/// No reader panics; what one accepts is in range and finite, and no larger than the file; what it refuses it can say.
fn check(bytes: &[u8]) {
    for result in read_with_all(bytes) {
        let (plc, notes) = match result {
            Ok(read) => read,
            Err(error) => {
                assert!(error.to_string().len() < 1000, "{error}");
                continue;
            }
        };
        check_notes(&plc, &notes);
        assert!(!plc.vertices.is_empty());
        assert!(plc.vertices.iter().flatten().all(|x| x.is_finite()));
        let polygons = plc.facets.iter().flat_map(|f| &f.polygons);
        let corners: Vec<_> = polygons.flatten().copied().collect();
        let ends = plc.segments.iter().flat_map(|s| s.ends);
        let given = plc.vertices.len() + plc.facets.len() + corners.len() + plc.segments.len();
        // A corner of a strip can make a triangle.
        assert!(given <= 5 * bytes.len());
        for v in corners.into_iter().chain(ends) {
            assert!(v.index() < plc.vertices.len());
        }
    }
}

/// Notes have a place, and numbers, attributes and markers are there for all vertices or for none.
fn check_notes(plc: &Plc, notes: &[Note]) {
    for note in notes {
        assert!(note.count > 0 && note.text.len() < 2000, "{note}");
        assert!(note.lines.is_sorted() && note.lines.len() <= note.count.min(Note::LISTED));
        assert!(
            !note.lines.is_empty() || note.text.contains("byte"),
            "{note}"
        );
    }
    let vertices = plc.vertices.len();
    assert!([0, vertices].contains(&plc.numbers.len()));
    assert!([0, vertices].contains(&plc.vertex_markers.len()));
    let attributes = &plc.attributes;
    assert_eq!(attributes.values.len(), attributes.per_vertex * vertices);
}

#[test]
fn the_seeds_are_valid() {
    for (i, seed) in seeds().iter().enumerate() {
        let accepted = read_with_all(seed).iter().filter(|r| r.is_ok()).count();
        assert!(accepted >= 1, "seed {i}: {:?}", read_with_all(seed));
    }
}

/// Kilobytes of address space that this process has had at most, where that can be asked.
fn peak() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|l| l.starts_with("VmPeak:"))?;
    line.split_whitespace().nth(1)?.parse().ok()
}

/// Every number of every file replaced by an absurd one: nothing is allocated for it, and nothing waits for it.
#[test]
fn absurd_counts_cost_nothing() {
    let start = Instant::now();
    let before = peak();
    for seed in seeds() {
        let digits: Vec<usize> = (0..seed.len())
            .filter(|&i| seed[i].is_ascii_digit() && !(i > 0 && seed[i - 1].is_ascii_digit()))
            .collect();
        for &at in &digits {
            for number in [
                "4000000000",
                "4294967295",
                "9223372036854775807",
                "-1",
                "1e300",
            ] {
                let end = seed[at..].iter().position(|b| !b.is_ascii_digit());
                let rest = &seed[end.map_or(seed.len(), |n| at + n)..];
                check(&[&seed[..at], number.as_bytes(), rest].concat());
            }
        }
        for at in 0..seed.len().saturating_sub(3) {
            for number in [
                [255; 4],
                [127, 255, 255, 255],
                [255, 255, 255, 127],
                [0, 0, 0, 128],
            ] {
                let mut bytes = seed.clone();
                bytes[at..at + 4].copy_from_slice(&number);
                check(&bytes);
            }
        }
    }
    assert!(start.elapsed() < Duration::from_secs(60));
    if let (Some(before), Some(after)) = (before, peak()) {
        assert!(after < before + 512 * 1024, "{before} to {after} kB");
    }
}

#[derive(Clone, Debug)]
enum Edit {
    Flip(usize, u8),
    Insert(usize, u8),
    Remove(usize, usize),
    Truncate(usize),
    /// Another word in the place of the word at some offset.
    Word(usize, String),
    /// A piece of any seed.
    Splice(usize, usize, usize, usize),
    Repeat(usize, usize),
}

fn word() -> impl Strategy<Value = String> {
    let words = [
        "\n",
        "\r",
        "\r\n",
        "#",
        "\\",
        "\t",
        "/",
        "//",
        "-",
        "OFF",
        "nOFF",
        "4OFF",
        "BINARY",
        "solid",
        "facet",
        "endsolid",
        "vertex",
        "endloop",
        "nan",
        "inf",
        "1e999",
        "-1",
        "0",
        "4000000000",
        "4294967295",
        "9223372036854775807",
        "18446744073709551616",
        "1.5",
        "1,5",
        "0x1p3",
        "1.0x",
        "\0",
        "\u{feff}",
        "ply",
        "element",
        "property",
        "list",
        "uchar",
        "double",
        "end_header",
        "tristrips",
        "v",
        "f",
        "l",
        "End",
        "Vertices",
        "Triangles",
        "Dimension",
        ",",
        "1,2,3",
        "1.0D+00",
        "//",
        "!",
        "{",
        "}",
        "\"",
        "end",
        "g",
        "usemtl",
        "label",
        "int64",
        "é",
    ];
    prop_oneof![
        prop::sample::select(words.to_vec()).prop_map(str::to_owned),
        (-9i32..9).prop_map(|i| i.to_string()),
    ]
}

fn edit() -> impl Strategy<Value = Edit> {
    let at = || 0usize..1000;
    prop_oneof![
        (at(), any::<u8>()).prop_map(|(i, b)| Edit::Flip(i, b)),
        (at(), any::<u8>()).prop_map(|(i, b)| Edit::Insert(i, b)),
        (at(), 1usize..20).prop_map(|(i, n)| Edit::Remove(i, n)),
        at().prop_map(Edit::Truncate),
        (at(), word()).prop_map(|(i, w)| Edit::Word(i, w)),
        (at(), word()).prop_map(|(i, w)| Edit::Word(i, w)),
        (at(), 0usize..40, at(), 0usize..80).prop_map(|(i, s, j, n)| Edit::Splice(i, s, j, n)),
        (at(), 1usize..40).prop_map(|(i, n)| Edit::Repeat(i, n)),
    ]
}

fn apply(bytes: &mut Vec<u8>, edit: &Edit) {
    let length = bytes.len();
    let at = |i: usize| i % length.max(1);
    let piece = |i: usize, n: usize| at(i)..(at(i) + n).min(length);
    match edit {
        _ if length == 0 => {}
        Edit::Flip(i, byte) => bytes[at(*i)] ^= byte,
        Edit::Insert(i, byte) => bytes.insert(at(*i), *byte),
        Edit::Remove(i, n) => drop(bytes.drain(piece(*i, *n))),
        Edit::Truncate(i) => bytes.truncate(at(*i)),
        Edit::Word(i, word) => {
            let blank = |b: &u8| b.is_ascii_whitespace();
            let start = bytes[..at(*i)].iter().rposition(blank).map_or(0, |k| k + 1);
            let end = bytes[start..].iter().position(blank);
            let end = end.map_or(length, |k| start + k);
            bytes.splice(start..end, word.bytes());
        }
        Edit::Splice(i, seed, j, n) => {
            let seeds = seeds();
            let other = &seeds[seed % seeds.len()];
            let from = j % other.len();
            let piece = other[from..(from + n).min(other.len())].to_vec();
            bytes.splice(at(*i)..at(*i), piece);
        }
        Edit::Repeat(i, n) => {
            let piece = bytes[piece(*i, *n)].to_vec();
            bytes.splice(at(*i)..at(*i), piece);
        }
    }
}

proptest! {
    #[test]
    fn random_bytes(bytes: Vec<u8>) {
        check(&bytes);
    }

    #[test]
    fn random_words(words in prop::collection::vec(word(), 0..60)) {
        check(words.join(" ").as_bytes());
    }

    /// After a magic word, so that the readers go on.
    #[test]
    fn random_bytes_after_a_header(bytes: Vec<u8>, seed in 0usize..40, at in 0usize..300) {
        let seeds = seeds();
        let seed = &seeds[seed % seeds.len()];
        check(&[&seed[..at.min(seed.len())], &bytes].concat());
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: ProptestConfig::default().cases.max(2000),
        ..ProptestConfig::default()
    })]

    #[test]
    fn edited_files(seed in 0usize..40, edits in prop::collection::vec(edit(), 0..8)) {
        let seeds = seeds();
        let mut bytes = seeds[seed % seeds.len()].clone();
        for edit in &edits {
            apply(&mut bytes, edit);
        }
        check(&bytes);
    }
}

const MESH: [(&str, &str); 4] = [
    (
        "node",
        "# c\n5 3 1 1\n1 0 0 0 9 1\n2 1 0 0 9 1\n3 0 1 0 9 1\n4 0 0 1 9 1\n5 1, 1, 1, 9, 1\n",
    ),
    ("ele", "2 4 1\n1 1 2 3 4 10\n2 2 3 4 5 20\n"),
    ("face", "2 1\n1 1 2 3 -1\n2 2 3 4 7\n"),
    ("edge", "2 1\n1 1 2 -1\n2 2 3 0\n"),
];

proptest! {
    /// The files of a mesh.
    #[test]
    fn edited_meshes(edits in prop::collection::vec((0usize..4, edit()), 0..6)) {
        let place = tempfile::tempdir().expect("a temporary directory");
        let mut files = MESH.map(|(_, text)| text.as_bytes().to_vec());
        for (file, edit) in &edits {
            apply(&mut files[*file], edit);
        }
        for ((extension, _), bytes) in MESH.iter().zip(&files) {
            std::fs::write(place.path().join("m").with_extension(extension), bytes).expect("a file");
        }
        match read_mesh(&place.path().join("m.node")) {
            Ok(mesh) => {
                let ids = mesh.tets.iter().flatten();
                let ids = ids.chain(mesh.faces.iter().flat_map(|f| &f.vertices));
                let mut ids = ids.chain(mesh.edges.iter().flat_map(|e| &e.vertices));
                assert!(ids.all(|v| v.index() < mesh.vertices.len()));
                assert!(mesh.vertices.iter().flatten().all(|x| x.is_finite()));
            }
            Err(error) => {
                // Names the file.
                assert!(!edits.is_empty() && error.to_string().contains("m."), "{error}");
            }
        }
    }
}
