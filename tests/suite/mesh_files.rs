//! Meshes written and read back, files as TetGen writes them, and files that are broken in every way.

use proptest::prelude::*;
use std::path::Path;
use tempfile::TempDir;
use tetflip::exchange::{ExactPosition, ExportedEdge, ExportedFace, ExportedMesh};
use tetflip::format::{MeshFileError, MeshLineError, UnwritableMesh, read_mesh, write_mesh};
use tetflip::mesh::VertexId;
use tetflip::number::Parameter;

/// Any finite double: every exponent, subnormal, both zeros, and short decimals.
fn finite() -> impl Strategy<Value = f64> {
    prop_oneof![
        prop::num::f64::NORMAL | prop::num::f64::SUBNORMAL | prop::num::f64::ZERO,
        (-1000i32..1000).prop_map(|i| f64::from(i) / 8.0),
        -1.0..1.0,
    ]
}

/// A mesh as far as files care: ids that exist, numbers that are finite.
fn mesh() -> impl Strategy<Value = ExportedMesh> {
    (
        prop::collection::vec(prop::array::uniform3(finite()), 1..20),
        0u32..2,
        any::<bool>(),
    )
        .prop_flat_map(|(vertices, first_index, with_regions)| {
            let id = (0..vertices.len()).prop_map(VertexId::new);
            let tets = prop::collection::vec((prop::array::uniform4(id.clone()), finite()), 0..20);
            let faces =
                prop::collection::vec((prop::array::uniform3(id.clone()), any::<i64>()), 0..20);
            let edges =
                prop::collection::vec((prop::array::uniform2(id.clone()), any::<i64>()), 0..20);
            let exact =
                prop::collection::vec((id.clone(), [id.clone(), id], [finite(), finite()]), 0..5);
            (tets, faces, edges, exact).prop_map(move |(tets, faces, edges, exact)| {
                let (tets, regions): (Vec<_>, Vec<_>) = tets.into_iter().unzip();
                let face = |(vertices, marker)| ExportedFace { vertices, marker };
                let edge = |(vertices, marker)| ExportedEdge { vertices, marker };
                let position = |(vertex, ends, [value, rest]): (_, _, [f64; 2])| {
                    let t = Parameter { value, rest };
                    ExactPosition { vertex, ends, t }
                };
                ExportedMesh {
                    first_index,
                    vertices: vertices.clone(),
                    tets,
                    regions: if with_regions { regions } else { Vec::new() },
                    faces: faces.into_iter().map(face).collect(),
                    edges: edges.into_iter().map(edge).collect(),
                    exact: exact.into_iter().map(position).collect(),
                    ..ExportedMesh::default()
                }
            })
        })
}

fn bits(mesh: &ExportedMesh) -> (Vec<[u64; 3]>, Vec<u64>) {
    let vertices = mesh.vertices.iter().map(|p| p.map(f64::to_bits)).collect();
    (vertices, mesh.regions.iter().map(|x| x.to_bits()).collect())
}

/// A directory with the given files.
fn directory(files: &[(&str, &str)]) -> TempDir {
    let directory = TempDir::new().unwrap();
    for (name, text) in files {
        std::fs::write(directory.path().join(name), text).unwrap();
    }
    directory
}

fn names(directory: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(directory).unwrap();
    let mut names: Vec<String> = entries
        .map(|e| e.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// What is written is read back bit by bit.
    #[test]
    fn meshes_survive_the_round_trip(mesh in mesh(), extension in 0usize..4) {
        let directory = TempDir::new().unwrap();
        let path = directory.path().join(["m.1.node", "m.1.ele", "m.1.face", "m.1.edge"][extension]);
        let written = write_mesh(&path, &mesh).unwrap();
        let exact = usize::from(!mesh.exact.is_empty());
        prop_assert_eq!(written.len(), 4 + exact);
        let all = ["m.1.edge", "m.1.ele", "m.1.face", "m.1.node", "m.1.steiner"];
        prop_assert_eq!(names(directory.path()), &all[..4 + exact]);
        let read = read_mesh(&path).unwrap();
        prop_assert_eq!(bits(&read), bits(&mesh));
        prop_assert_eq!(read, mesh);
    }

    /// Bytes changed, cut off or put in: a mesh or an error, never a panic. What is read can be written again.
    #[test]
    fn broken_files_are_no_panic(
        mesh in mesh(),
        file in 0usize..4,
        changes in prop::collection::vec(
            (any::<prop::sample::Index>(), prop::sample::select(b"0123456789-.#e\n \x00\xff,n".to_vec())),
            1..6,
        ),
        cut in prop::option::of(any::<prop::sample::Index>()),
    ) {
        let directory = TempDir::new().unwrap();
        let path = directory.path().join("m.node");
        let target = &write_mesh(&path, &mesh).unwrap()[file];
        let mut bytes = std::fs::read(target).unwrap();
        for (at, byte) in changes {
            let at = at.index(bytes.len());
            if byte % 2 == 0 { bytes[at] = byte } else { bytes.insert(at, byte) }
        }
        if let Some(cut) = cut {
            bytes.truncate(cut.index(bytes.len()));
        }
        std::fs::write(target, bytes).unwrap();
        match read_mesh(&path) {
            Ok(read) => prop_assert!(write_mesh(&path, &read).is_ok()),
            // Perhaps a line of another file: a changed .node file has other vertices than the others name.
            Err(MeshFileError::Line { line, .. }) => prop_assert!(line > 0),
            Err(error) => prop_assert!(false, "{error}"),
        }
    }
}

/// The cube of TetGen's manual in miniature: from 1, with marks of vertices, attributes of tetrahedra, comments.
const TETGEN: [(&str, &str); 4] = [
    (
        "t.1.node",
        "# a comment\n5  3  0  1\n   1    0  0  0    5\n   2    1  0  0    5\n\n   3    0  1  0    -1  # the mark\n   \
         4    0  0  1    0\r\n   5    1  1  -0.10000000000000001    0\n# Generated by tetgen -pAe t.poly\n",
    ),
    (
        "t.1.ele",
        "2  4  2\n    1       1     2     3     4    9   -3\n    2       3     2     5     4    9   0.25\n# end\n",
    ),
    (
        "t.1.face",
        "2  1\n    1      3     1     2    7        0      5\n    2      4     3     5    0        2     -1\n",
    ),
    ("t.1.edge", "1  1\n    0      2     5  1  1\n"),
];

fn ids<const N: usize>(ids: [u32; N]) -> [VertexId; N] {
    ids.map(VertexId)
}

#[test]
fn files_of_tetgen() {
    let directory = directory(&TETGEN);
    let mesh = read_mesh(&directory.path().join("t.1.face")).unwrap();
    assert_eq!(mesh.first_index, 1);
    assert_eq!(mesh.vertices.len(), 5);
    assert_eq!(mesh.vertices[4], [1.0, 1.0, -0.1]);
    assert_eq!(mesh.tets, [ids([0, 1, 2, 3]), ids([2, 1, 4, 3])]);
    assert_eq!(
        mesh.regions,
        [-3.0, 0.25],
        "the last attribute is the region's"
    );
    let face = |vertices, marker| ExportedFace {
        vertices: ids(vertices),
        marker,
    };
    assert_eq!(mesh.faces, [face([2, 0, 1], 7), face([3, 2, 4], 0)]);
    let vertices = ids([1, 4]);
    assert_eq!(
        mesh.edges,
        [ExportedEdge {
            vertices,
            marker: 1
        }]
    );
}

#[test]
fn zero_based_without_faces_edges_and_marks() {
    let node = "4 3\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n";
    let files = directory(&[("a.node", node), ("a.ele", "1\n0 0 1 2 3\n")]);
    let mesh = read_mesh(&files.path().join("a.ele")).unwrap();
    assert_eq!((mesh.first_index, mesh.tets), (0, vec![ids([0, 1, 2, 3])]));
    assert!(mesh.regions.is_empty() && mesh.faces.is_empty() && mesh.edges.is_empty());

    let neighbours = "1 0\n0 2 1 0 0 -1\n";
    let files = directory(&[("a.node", node), ("a.ele", "0 4 0"), ("a.face", neighbours)]);
    let mesh = read_mesh(&files.path().join("a.ele")).unwrap();
    assert_eq!(
        mesh.faces[0].marker, 0,
        "without marks the next column is a neighbour"
    );
}

/// The text that is written, once to the letter.
#[test]
fn what_is_written() {
    let mesh = ExportedMesh {
        first_index: 1,
        vertices: vec![
            [0.0, 0.1, 1e-5],
            [1.0, 0.0, -2.5e300],
            [0.0, 1.0, 5e-324],
            [-0.0, 100000.0, 1.0],
        ],
        tets: vec![ids([0, 1, 2, 3]), ids([3, 2, 1, 0])],
        regions: vec![20.0, -0.5],
        faces: vec![ExportedFace {
            vertices: ids([0, 1, 2]),
            marker: -7,
        }],
        edges: vec![],
        exact: vec![ExactPosition {
            vertex: VertexId(3),
            ends: ids([0, 1]),
            t: 0.25.into(),
        }],
        ..ExportedMesh::default()
    };
    let directory = TempDir::new().unwrap();
    let written = write_mesh(&directory.path().join("m.face"), &mesh).unwrap();
    let texts: Vec<String> = written
        .iter()
        .map(|path| std::fs::read_to_string(path).unwrap())
        .collect();
    let node = "4 3 0 0\n1 0 0.1 1e-5\n2 1 0 -2.5e300\n3 0 1 5e-324\n4 -0 100000 1\n";
    let ele = "2 4 1\n1 1 2 3 4 20\n2 4 3 2 1 -0.5\n";
    let face = "1 1\n1 1 2 3 -7\n";
    assert_eq!(texts, [node, ele, face, "0 1\n", "1\n4 1 2 0.25\n"]);
}

/// The error of reading `files` with the good ones of TetGen for the rest.
fn error_of(name: &str, text: &str) -> (String, usize, MeshLineError) {
    let directory = directory(&TETGEN);
    std::fs::write(directory.path().join(name), text).unwrap();
    match read_mesh(&directory.path().join("t.1.node")) {
        Err(MeshFileError::Line { path, line, reason }) => {
            let file = path.file_name().unwrap().to_str().unwrap().to_string();
            (file, line, reason)
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn errors_name_file_line_and_reason() {
    use MeshLineError::*;
    let cases = [
        ("t.1.node", "", 1, NoHeader),
        ("t.1.node", "# only\n\n", 1, NoHeader),
        ("t.1.node", "4294967296 3\n", 1, TooManyVertices(1 << 32)),
        ("t.1.node", "2 2 0 0\n", 1, Dimension(2)),
        ("t.1.node", "1\n1 0 0\n", 2, Missing("z")),
        (
            "t.1.node",
            "2\n2 0 0 0\n4 0 0 0\n",
            3,
            VertexNumber {
                found: 4,
                expected: 3,
            },
        ),
        (
            "t.1.node",
            "2\n0 0 0 0\n\n2 0 0 0\n",
            4,
            VertexNumber {
                found: 2,
                expected: 1,
            },
        ),
        ("t.1.ele", "1 10 0\n", 1, NodesPerTet(10)),
        (
            "t.1.ele",
            "1 4 9999999999\n1 1 2 3 4 8\n",
            2,
            Missing("an attribute"),
        ),
        ("t.1.ele", "1 4\n1 1 2 3\n", 2, Missing("a vertex")),
        (
            "t.1.ele",
            "2 4\n1 1 2 3 4\n",
            2,
            TooFewLines {
                promised: 2,
                found: 1,
            },
        ),
        (
            "t.1.ele",
            "1000000000000 4\n",
            1,
            TooFewLines {
                promised: 1_000_000_000_000,
                found: 0,
            },
        ),
        (
            "t.1.ele",
            "1 4\n1 1 2 3 4\n2 1 2 3 4\n",
            3,
            TooManyLines { promised: 1 },
        ),
        (
            "t.1.ele",
            "1 4\n1 1 2 3 6\n",
            2,
            NoSuchVertex {
                found: 6,
                first: 1,
                count: 5,
            },
        ),
        (
            "t.1.face",
            "1 1\n1 0 1 2 6\n",
            2,
            NoSuchVertex {
                found: 0,
                first: 1,
                count: 5,
            },
        ),
        (
            "t.1.edge",
            "1 1\n1 -9223372036854775808 1 2\n",
            2,
            NoSuchVertex {
                found: i64::MIN,
                first: 1,
                count: 5,
            },
        ),
        ("t.1.edge", "1 1\n1 1 2\n", 2, Missing("the marker")),
    ];
    for (file, text, line, reason) in cases {
        assert_eq!(
            error_of(file, text),
            (file.to_string(), line, reason),
            "{file}: {text:?}"
        );
    }
    for (text, found) in [
        ("1\n1 0 nan 0\n", "nan"),
        ("1\n1 0 1e999 0\n", "1e999"),
        ("1\n1 0 -inf 0\n", "-inf"),
    ] {
        let found = found.to_string();
        assert_eq!(error_of("t.1.node", text).2, NotFinite { what: "y", found });
    }
    for (text, found) in [
        ("1 1\n1 1 2 30000000000000000000\n", "30000000000000000000"),
        ("1 1\n1 1 2 0.5\n", "0.5"),
    ] {
        let found = found.to_string();
        assert_eq!(
            error_of("t.1.edge", text).2,
            BadNumber {
                what: "the marker",
                found
            }
        );
    }
    let (_, _, reason) = error_of("t.1.node", "-3 3 0 0\n");
    assert_eq!(reason.to_string(), "the number of vertices cannot be `-3`");
}

#[test]
fn missing_files_and_foreign_extensions() {
    let directory = directory(&TETGEN[..1]);
    let error = read_mesh(&directory.path().join("t.1.node")).unwrap_err();
    assert!(
        matches!(&error, MeshFileError::Io { path, .. } if path.ends_with("t.1.ele")),
        "{error}"
    );
    for name in ["a.off", "a", "a.vtu", ".node"] {
        assert!(
            matches!(
                read_mesh(Path::new(name)),
                Err(MeshFileError::ReadExtension { .. })
            ),
            "{name}"
        );
    }
    let error = write_mesh(Path::new("a.msh"), &ExportedMesh::default()).unwrap_err();
    assert!(matches!(error, MeshFileError::WriteExtension { .. }));
}

#[test]
fn what_no_file_can_hold_is_not_written() {
    let good = ExportedMesh {
        vertices: vec![[0.0; 3]; 4],
        tets: vec![ids([0, 1, 2, 3])],
        ..ExportedMesh::default()
    };
    let bad = |change: fn(&mut ExportedMesh)| {
        let mut mesh = good.clone();
        change(&mut mesh);
        let directory = TempDir::new().unwrap();
        let mut errors = Vec::new();
        for name in ["m.node", "m.vtu"] {
            match write_mesh(&directory.path().join(name), &mesh) {
                Err(MeshFileError::Unwritable(error)) => errors.push(error),
                other => panic!("{other:?}"),
            }
        }
        assert!(names(directory.path()).is_empty());
        assert_eq!(errors[0], errors[1]);
        errors[0]
    };
    assert_eq!(
        bad(|m| m.first_index = u32::MAX),
        UnwritableMesh::FirstIndex(u32::MAX)
    );
    assert_eq!(
        bad(|m| m.vertices[2][1] = f64::NAN),
        UnwritableMesh::Vertex(2)
    );
    assert_eq!(
        bad(|m| m.regions = vec![0.0; 2]),
        UnwritableMesh::RegionCount {
            regions: 2,
            tets: 1
        }
    );
    assert_eq!(
        bad(|m| m.regions = vec![f64::INFINITY]),
        UnwritableMesh::Region(0)
    );
    assert_eq!(bad(|m| m.tets[0][3] = VertexId(4)), UnwritableMesh::Tet(0));
    let face = |m: &mut ExportedMesh| {
        let vertices = [VertexId(0), VertexId(1), VertexId::INFINITE];
        m.faces.push(ExportedFace {
            vertices,
            marker: 0,
        });
    };
    assert_eq!(bad(face), UnwritableMesh::Face(0));
    let edge = |m: &mut ExportedMesh| {
        let vertices = [VertexId(0), VertexId(9)];
        m.edges.push(ExportedEdge {
            vertices,
            marker: 0,
        });
    };
    assert_eq!(bad(edge), UnwritableMesh::Edge(0));
}

/// A write that fails in the middle (a directory bears the name of a file) leaves no temporary file.
#[test]
fn failed_writes_leave_nothing_behind() {
    let directory = TempDir::new().unwrap();
    std::fs::create_dir_all(directory.path().join("m.node/full")).unwrap();
    let error = write_mesh(&directory.path().join("m.ele"), &ExportedMesh::default()).unwrap_err();
    assert!(matches!(error, MeshFileError::Io { path, .. } if path.ends_with("m.node")));
    assert_eq!(names(directory.path()), ["m.node"]);
    let error = write_mesh(
        &directory.path().join("no/such/m.vtu"),
        &ExportedMesh::default(),
    )
    .unwrap_err();
    assert!(matches!(error, MeshFileError::Io { .. }));
}

/// A comma after a field ends it, as in TetGen; one within a number is a decimal comma, not the end of a field.
#[test]
fn decimal_commas_are_no_separators() {
    let node = "4 3 0 0\n1, 0, 0, 0\n2 ,1 0 0\n3 0 1 0,\n4 0 0 1\n";
    let place = directory(&[("a.node", node), ("a.ele", "1 4 0\n1 1 2 3 4\n")]);
    let mesh = read_mesh(&place.path().join("a.node")).expect("a good file");
    assert_eq!(mesh.vertices[1], [1.0, 0.0, 0.0]);
    let decimal = node.replace("4 0 0 1", "4 0,0 0,0 1,0");
    std::fs::write(place.path().join("a.node"), decimal).expect("a file");
    let error = read_mesh(&place.path().join("a.node")).expect_err("commas");
    assert!(
        matches!(
            &error,
            MeshFileError::Line { line: 5, reason: MeshLineError::BadNumber { found, .. }, .. }
                if found == "0,0"
        ),
        "{error}"
    );
}

/// Lines that end with CR alone are lines.
#[test]
fn mesh_files_of_every_line_ending() {
    for ending in ["\n", "\r\n", "\r"] {
        let text = "# c\n4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n".replace('\n', ending);
        let place = directory(&[("a.node", &text), ("a.ele", "1 4 0\n1 1 2 3 4\n")]);
        let mesh = read_mesh(&place.path().join("a.node")).expect("a good file");
        assert_eq!(mesh.vertices.len(), 4);
    }
}
