//! The program: what it accepts, refuses, writes and says. Exit status 0 is success, 1 that the algorithm gave up or a
//! verification failed, 2 bad input or usage; whatever fails leaves no file behind.

use std::fmt::Write;
use std::path::PathBuf;
use std::process::{Command, Output};
use tempfile::TempDir;

/// Two rooms with a wall between them and a block left out; the example of the README.
const ROOMS: &str = include_str!("../examples/rooms.poly");

/// A directory with an input file, and a program to run in it.
struct Place {
    directory: TempDir,
}

impl Place {
    fn with(files: &[(&str, &str)]) -> Place {
        let directory = tempfile::tempdir().expect("a temporary directory");
        for (name, text) in files {
            std::fs::write(directory.path().join(name), text).expect("a file in it");
        }
        Place { directory }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.directory.path().join(name)
    }

    fn bytes(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.directory.path()).expect("the directory");
        let mut names: Vec<String> = entries
            .map(|e| {
                e.expect("an entry")
                    .file_name()
                    .into_string()
                    .expect("UTF-8")
            })
            .collect();
        names.sort();
        names
    }

    /// Runs `tetflip` with the words of `arguments`.
    fn run(&self, arguments: &str) -> Run {
        let output = Command::new(env!("CARGO_BIN_EXE_tetflip"))
            .args(arguments.split_whitespace())
            .current_dir(self.directory.path())
            .output()
            .expect("the program starts");
        Run {
            arguments: arguments.to_owned(),
            output,
        }
    }

    /// Runs `tetflip`, which must refuse with `status` and a message that holds all of `parts`, and leave no new file.
    fn refuses(&self, arguments: &str, status: i32, parts: &[&str]) {
        let before = self.names();
        let run = self.run(arguments).ends_with(status);
        for part in parts {
            assert!(
                run.stderr().contains(part),
                "{arguments}: {part:?} is not in {:?}",
                run.stderr()
            );
        }
        assert!(run.stderr().starts_with("tetflip: "), "{}", run.stderr());
        assert_eq!(run.stdout(), "", "{arguments}");
        assert_eq!(self.names(), before, "{arguments} leaves files");
    }
}

struct Run {
    arguments: String,
    output: Output,
}

impl Run {
    fn ends_with(self, status: i32) -> Run {
        let code = self.output.status.code();
        assert_eq!(code, Some(status), "{}: {}", self.arguments, self.stderr());
        self
    }

    fn stdout(&self) -> String {
        String::from_utf8(self.output.stdout.clone()).expect("UTF-8")
    }

    fn stderr(&self) -> String {
        String::from_utf8(self.output.stderr.clone()).expect("UTF-8")
    }
}

type Point = [f64; 3];

/// The corners of a box, by the bits of their number: x, y, z.
fn box_corners([low, high]: [Point; 2]) -> Vec<Point> {
    let corner = |i: usize| {
        std::array::from_fn(|axis| {
            if i >> axis & 1 == 1 {
                high[axis]
            } else {
                low[axis]
            }
        })
    };
    (0..8).map(corner).collect()
}

/// The faces of a box, seen from outside.
const BOX_FACES: [[usize; 4]; 6] = [
    [0, 2, 3, 1],
    [4, 5, 7, 6],
    [0, 1, 5, 4],
    [2, 6, 7, 3],
    [0, 4, 6, 2],
    [1, 3, 7, 5],
];

const CUBE: [Point; 2] = [[0.0; 3], [1.0; 3]];

/// Boxes as a .poly file with a list of hole points. Vertices count from 1.
fn poly(boxes: &[[Point; 2]], holes: &[Point]) -> String {
    let mut text = format!("{} 3 0 0\n", 8 * boxes.len());
    for (i, [x, y, z]) in boxes.iter().flat_map(|&b| box_corners(b)).enumerate() {
        writeln!(text, "{} {x} {y} {z}", i + 1).expect("a string");
    }
    writeln!(text, "{} 0", 6 * boxes.len()).expect("a string");
    for first in (0..boxes.len()).map(|b| 8 * b + 1) {
        for face in BOX_FACES {
            let [a, b, c, d] = face.map(|v| v + first);
            writeln!(text, "1\n4 {a} {b} {c} {d}").expect("a string");
        }
    }
    writeln!(text, "{}", holes.len()).expect("a string");
    for (i, [x, y, z]) in holes.iter().enumerate() {
        writeln!(text, "{} {x} {y} {z}", i + 1).expect("a string");
    }
    text
}

/// The first `faces` faces of the cube as an OFF file.
fn off(faces: usize) -> String {
    let mut text = format!("OFF\n8 {faces} 0\n");
    for [x, y, z] in box_corners(CUBE) {
        writeln!(text, "{x} {y} {z}").expect("a string");
    }
    for [a, b, c, d] in &BOX_FACES[..faces] {
        writeln!(text, "4 {a} {b} {c} {d}").expect("a string");
    }
    text
}

/// The cube as an ASCII STL file of twelve triangles.
fn stl() -> String {
    let corners = box_corners(CUBE);
    let mut text = "solid cube\n".to_owned();
    for [a, b, c, d] in BOX_FACES {
        for triangle in [[a, b, c], [a, c, d]] {
            text += "facet normal 0 0 0\nouter loop\n";
            for [x, y, z] in triangle.map(|v| corners[v]) {
                writeln!(text, "vertex {x} {y} {z}").expect("a string");
            }
            text += "endloop\nendfacet\n";
        }
    }
    text + "endsolid cube\n"
}

/// How many elements the header of a mesh file announces.
fn count(place: &Place, name: &str) -> usize {
    let text = String::from_utf8(place.bytes(name)).expect("UTF-8");
    let first = text.split_whitespace().next().expect("a header");
    first.parse().expect("a count")
}

#[test]
fn a_cube_in_every_format_is_meshed_and_verified() {
    let place = Place::with(&[
        ("a.poly", &poly(&[CUBE], &[])),
        ("b.off", &off(6)),
        ("c.stl", &stl()),
    ]);
    for input in ["a.poly", "b.off", "c.stl"] {
        let run = place
            .run(&format!("mesh {input} -o x.node --verify"))
            .ends_with(0);
        assert!(
            run.stdout().starts_with("8 vertices (0 Steiner points), "),
            "{}",
            run.stdout()
        );
        assert!(run.stdout().ends_with("; verified\n"), "{}", run.stdout());
        assert_eq!(run.stderr(), "");
        // Coplanar triangles are merged: whatever their diagonals, twelve edges and twelve faces.
        assert_eq!(count(&place, "x.node"), 8);
        assert_eq!(count(&place, "x.face"), 12);
        assert_eq!(count(&place, "x.edge"), 12);
        let run = place.run(&format!("verify {input} x.node")).ends_with(0);
        assert!(run.stdout().ends_with("\naccepted\n"), "{}", run.stdout());
    }
    let all = [
        "a.poly", "b.off", "c.stl", "x.edge", "x.ele", "x.face", "x.node",
    ];
    assert_eq!(place.names(), all);
}

#[test]
fn without_merging_the_diagonals_are_edges() {
    let place = Place::with(&[("c.stl", &stl())]);
    place
        .run("mesh c.stl -o x.node --no-merge --verify")
        .ends_with(0);
    // Twelve edges and six diagonals, each divided by its Steiner points.
    let steiner = count(&place, "x.node") - 8;
    assert_eq!(count(&place, "x.edge"), 18 + steiner);
}

#[test]
fn a_hole_is_left_open_and_a_wall_divides_regions() {
    let outer = [[0.0; 3], [3.0; 3]];
    let inner = [[1.0; 3], [2.0; 3]];
    let place = Place::with(&[
        ("solid.poly", &poly(&[outer, inner], &[])),
        ("hollow.poly", &poly(&[outer, inner], &[[1.5; 3]])),
        ("rooms.poly", ROOMS),
    ]);
    for (input, volume) in [("solid.poly", 27), ("hollow.poly", 26), ("rooms.poly", 15)] {
        place.run(&format!("mesh {input} -o x.node")).ends_with(0);
        let run = place
            .run(&format!("verify {input} x.node --domain inside"))
            .ends_with(0);
        let expected = format!(", volume {volume}, domain: inside of the facets\n");
        assert!(run.stdout().contains(&expected), "{}", run.stdout());
    }
    let ele = String::from_utf8(place.bytes("x.ele")).expect("UTF-8");
    let regions = ele
        .lines()
        .skip(1)
        .map(|line| line.rsplit(' ').next().expect("a word"));
    let first = regions.clone().filter(|&r| r == "10").count();
    let second = regions.clone().filter(|&r| r == "20").count();
    assert!(
        first >= 5 && second > first && first + second == count(&place, "x.ele"),
        "{ele}"
    );
    // A mesh without the hole is none of the PLC with the hole.
    place.run("mesh solid.poly -o x.node").ends_with(0);
    let run = place
        .run("verify hollow.poly x.node --domain inside")
        .ends_with(1);
    assert!(run.stdout().ends_with("\nrefused\n"), "{}", run.stdout());
    assert!(run.stderr().contains("not a CDT"), "{}", run.stderr());
}

#[test]
fn an_open_surface_needs_the_hull() {
    let place = Place::with(&[("open.off", &off(5))]);
    place.refuses(
        "mesh open.off -o x.node",
        1,
        &["gave up", "open surface", "--hull"],
    );
    place
        .run("mesh open.off -o x.node --hull --verify")
        .ends_with(0);
    place.run("verify open.off x.node").ends_with(0);
}

#[test]
fn cavities_and_flips_write_the_same_bytes_on_every_run() {
    // The wall is missing from the Delaunay tetrahedralization: the block's corners are too near.
    let place = Place::with(&[("rooms.poly", ROOMS)]);
    let mut written: Vec<Vec<Vec<u8>>> = Vec::new();
    for way in ["cavity", "flip", "flip --times exact", "flip", "cavity"] {
        let run = place
            .run(&format!("mesh rooms.poly -o x.node --insert {way}"))
            .ends_with(0);
        let flips = !run.stdout().contains("; 0 flips");
        assert_eq!(flips, way != "cavity", "{way}: {}", run.stdout());
        written.push(
            ["x.node", "x.ele", "x.face", "x.edge"]
                .map(|name| place.bytes(name))
                .into(),
        );
        for name in ["x.node", "x.ele", "x.face", "x.edge"] {
            std::fs::remove_file(place.path(name)).expect("it was written");
        }
    }
    assert!(written.iter().all(|files| *files == written[0]));
}

#[test]
fn any_of_the_four_names_writes_all_four_and_vtu_writes_one() {
    let cube = poly(&[CUBE], &[]);
    for name in ["node", "ele", "face", "edge"] {
        let place = Place::with(&[("a.poly", &cube)]);
        place.run(&format!("mesh a.poly -o x.{name}")).ends_with(0);
        assert_eq!(
            place.names(),
            ["a.poly", "x.edge", "x.ele", "x.face", "x.node"]
        );
        place.run(&format!("verify a.poly x.{name}")).ends_with(0);
    }
    let place = Place::with(&[("a.poly", &cube)]);
    place.run("mesh a.poly -o x.vtu").ends_with(0);
    assert_eq!(place.names(), ["a.poly", "x.vtu"]);
    assert!(place.bytes("x.vtu").starts_with(b"<?xml"));
    place.refuses("verify a.poly x.vtu", 2, &["x.vtu", ".node"]);
}

#[test]
fn without_output_nothing_is_written() {
    let place = Place::with(&[("a.poly", &poly(&[CUBE], &[]))]);
    place.run("mesh a.poly").ends_with(0);
    place.run("delaunay a.poly").ends_with(0);
    assert_eq!(place.names(), ["a.poly"]);
}

#[test]
fn quiet_is_silent() {
    let place = Place::with(&[("a.poly", &poly(&[CUBE], &[])), ("open.off", &off(5))]);
    for arguments in [
        "mesh a.poly -o x.node --verify --quiet",
        "mesh a.poly -q",
        "verify a.poly x.node -q",
        "delaunay a.poly -q",
    ] {
        let run = place.run(arguments).ends_with(0);
        assert_eq!(
            (run.stdout(), run.stderr()),
            (String::new(), String::new()),
            "{arguments}"
        );
    }
    // What goes wrong is said all the same.
    place.refuses("mesh open.off --quiet", 1, &["--hull"]);
}

#[test]
fn delaunay_reports_duplicates() {
    let nodes = "6 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n4 1 0 0\n5 -0 0 1\n";
    let place = Place::with(&[("p.node", nodes)]);
    let run = place.run("delaunay p.node -o x.node").ends_with(0);
    assert_eq!(
        run.stdout(),
        "4 distinct vertices (2 duplicates merged), 1 tetrahedra\n"
    );
    // All vertices are written, so that numbers keep their meaning.
    assert_eq!(count(&place, "x.node"), 6);
    assert_eq!(count(&place, "x.ele"), 1);
    place.run("verify p.node x.node --domain hull").ends_with(0);
}

#[test]
fn outputs_do_not_replace_inputs() {
    let facets = poly(&[CUBE], &[]);
    let nodes: Vec<&str> = facets.lines().take(9).collect();
    let rest: Vec<&str> = facets.lines().skip(9).collect();
    let place = Place::with(&[
        ("cube.node", &nodes.join("\n")),
        ("cube.poly", &format!("0 3 0 0\n{}", rest.join("\n"))),
        ("box.poly", &facets),
    ]);
    let before = place.bytes("cube.node");
    place.refuses("mesh cube.poly -o cube.ele", 2, &["cube.node is an input"]);
    place.refuses(
        "delaunay cube.node -o ./cube.node",
        2,
        &["cube.node is an input"],
    );
    place.refuses(
        "mesh cube.poly --report cube.poly",
        2,
        &["cube.poly is an input"],
    );
    assert_eq!(place.bytes("cube.node"), before);
    // This file has its own vertices, and a mesh may be written again.
    place.run("mesh box.poly -o box.node").ends_with(0);
    place.run("mesh box.poly -o box.node").ends_with(0);
}

#[test]
fn bad_files_are_refused_by_line() {
    let cube = poly(&[CUBE], &[]);
    let lines: Vec<&str> = cube.lines().collect();
    let place = Place::with(&[
        ("cut.poly", &lines[..14].join("\n")),
        ("nan.poly", &cube.replacen("3 0 1 0", "3 0 nan 0", 1)),
        ("range.poly", &cube.replacen("4 1 3 4 2", "4 1 3 99 2", 1)),
        ("word.off", &off(6).replacen("1 1 0", "1 l 0", 1)),
        ("cut.stl", &stl()[..300]),
        ("empty.node", ""),
        ("cube.obj", "v 0 0 0\n"),
    ]);
    for command in ["mesh", "delaunay"] {
        let to = "-o x.node";
        place.refuses(
            &format!("{command} none.poly {to}"),
            2,
            &["none.poly", "cannot read"],
        );
        place.refuses(
            &format!("{command} cube.obj {to}"),
            2,
            &["cube.obj", "\"obj\"", ".poly"],
        );
        place.refuses(
            &format!("{command} cut.poly {to}"),
            2,
            &["cut.poly", "line 14"],
        );
        place.refuses(&format!("{command} nan.poly {to}"), 2, &["line 4", "nan"]);
        place.refuses(
            &format!("{command} range.poly {to}"),
            2,
            &["line 12", "no vertex 99"],
        );
        place.refuses(&format!("{command} word.off {to}"), 2, &["line 6", "\"l\""]);
        place.refuses(&format!("{command} cut.stl {to}"), 2, &["cut.stl", "line "]);
        place.refuses(
            &format!("{command} empty.node {to}"),
            2,
            &["empty.node", "the file ends"],
        );
    }
    place.refuses("verify none.poly cut.node", 2, &["none.poly"]);
}

#[test]
fn bad_mesh_files_are_refused_by_line() {
    let place = Place::with(&[("a.poly", &poly(&[CUBE], &[]))]);
    place.refuses("verify a.poly x.node", 2, &["x.node"]);
    place.run("mesh a.poly -o x.node").ends_with(0);
    let ele = String::from_utf8(place.bytes("x.ele")).expect("UTF-8");
    let (header, first) = (ele.lines().next(), ele.lines().nth(1));
    let (header, first) = (header.expect("a header"), first.expect("a tetrahedron"));
    std::fs::write(place.path("x.ele"), ele.replacen(first, "1 1 2 3 9", 1)).expect("a file");
    place.refuses(
        "verify a.poly x.node",
        2,
        &["x.ele:2", "vertex 9 does not exist"],
    );
    std::fs::write(place.path("x.ele"), format!("{header}\n")).expect("a file");
    place.refuses("verify a.poly x.node", 2, &["x.ele", "the file ends"]);
}

#[test]
fn vertices_that_do_not_span_space_are_refused() {
    let flat = "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";
    let line = "4 3 0 0\n0 0 0 0\n1 1 1 1\n2 2 2 2\n3 3 3 3\n";
    let few = "4 3 0 0\n0 0 0 0\n1 1 1 1\n2 0 1 0\n3 0 0 0\n";
    let place = Place::with(&[("flat.off", flat), ("line.node", line), ("few.node", few)]);
    for command in ["mesh", "mesh --hull", "delaunay"] {
        place.refuses(
            &format!("{command} flat.off -o x.node"),
            2,
            &["4 vertices lie on one plane"],
        );
        place.refuses(
            &format!("{command} line.node -o x.node"),
            2,
            &["4 vertices lie on one line"],
        );
        place.refuses(
            &format!("{command} few.node -o x.node"),
            2,
            &["3 distinct vertices"],
        );
    }
}

#[test]
fn intersections_are_refused_by_name() {
    // A bar through the face x = 1 of the cube, whose corners are 2 4 8 6.
    let bar = [[0.5, 0.25, 0.25], [1.5, 0.75, 0.75]];
    // A bowtie, two wires that cross, a vertex in a face that does not have it, one on an edge.
    let bowtie = off(6).replacen("4 0 2 3 1", "4 0 3 2 1", 1);
    let wires = "4 3 0 0\n1 0 0 0\n2 2 2 0\n3 2 0 0\n4 0 2 0\n2 0\n1\n2 1 2\n1\n2 3 4\n0\n";
    let wires =
        wires
            .replacen("4 3 0 0", "5 3 0 0", 1)
            .replacen("4 0 2 0\n", "4 0 2 0\n5 0 0 1\n", 1);
    let touch = [[1.0, 0.25, 0.25], [1.5, 0.75, 0.75]];
    let on_edge = [[1.0, 0.0, 0.5], [2.0, 1.0, 0.75]];
    let place = Place::with(&[
        ("bar.poly", &poly(&[CUBE, bar], &[])),
        ("bowtie.off", &bowtie),
        ("wires.poly", &wires),
        ("touch.poly", &poly(&[CUBE, touch], &[])),
        ("edge.poly", &poly(&[CUBE, on_edge], &[])),
        ("twice.poly", &poly(&[CUBE, CUBE], &[])),
    ]);
    for way in ["cavity", "flip"] {
        let mesh = |file: &str| format!("mesh {file} --insert {way} -o x.node --hull");
        place.refuses(&mesh("bar.poly"), 2, &["invalid PLC", "facet 6 (2 4 8 6)"]);
        place.refuses(
            &mesh("bowtie.off"),
            2,
            &["edges", "facet 0 (0 3 2 1)", "cross"],
        );
        place.refuses(
            &mesh("wires.poly"),
            2,
            &["segments", "1-2", "3-4", "intersect"],
        );
        place.refuses(&mesh("touch.poly"), 2, &["interior of facet 6 (2 4 8 6)"]);
        place.refuses(&mesh("edge.poly"), 2, &["lies in the interior of segment"]);
        place.refuses(
            &mesh("twice.poly"),
            2,
            &["facet 1 (1 3 4 2)", "facet 7", "the same"],
        );
    }
}

/// After a rotation facets are flat only to rounding. That may be too hard, but it is no intersection, and vertex 1, on
/// the line of the edge 2-3, must not be found inside the facet of that edge.
#[test]
fn a_rotated_box_is_not_called_invalid() {
    let (cos, sin) = (0.955336489125606, 0.29552020666133955);
    let rotate = |[x, y, z]: Point| {
        let (x, y) = (cos * x - sin * y, sin * x + cos * y);
        [x, cos * y - sin * z, sin * y + cos * z]
    };
    let mut text = String::new();
    for line in ROOMS.lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        // Vertices, the hole and the regions have their point after a number; the lines of facets begin with 1 0 or 4.
        let point = |i: usize| words[i].parse::<f64>().expect("a coordinate");
        if line.starts_with('#')
            || words.len() < 4
            || line.starts_with("1 0 ")
            || words[0] == "4" && words.len() == 5
            || line == "20 3 0 0"
        {
            writeln!(text, "{line}").expect("a string");
        } else {
            let [x, y, z] = rotate([point(1), point(2), point(3)]);
            let rest = words[4..].join(" ");
            writeln!(text, "{} {x} {y} {z} {rest}", words[0]).expect("a string");
        }
    }
    let place = Place::with(&[("rotated.poly", &text)]);
    for way in ["cavity", "flip"] {
        let run = place.run(&format!("mesh rotated.poly --insert {way} --verify"));
        if run.output.status.code() != Some(0) {
            let run = run.ends_with(1);
            assert!(
                run.stderr().contains("not exactly flat"),
                "{}",
                run.stderr()
            );
        }
    }
}

#[test]
fn bad_usage_ends_with_2() {
    let place = Place::with(&[("a.poly", &poly(&[CUBE], &[]))]);
    place.refuses("mesh a.poly -o x.txt", 2, &["x.txt", ".node", ".vtu"]);
    place.refuses("mesh a.poly -o none/x.node", 2, &["none"]);
    place.refuses("mesh a.poly --report none/r.json", 2, &["none"]);
    #[cfg(not(feature = "rug"))]
    place.refuses("mesh a.poly --times rug -o x.node", 2, &["--features rug"]);
    for arguments in [
        "",
        "mesh",
        "frobnicate a.poly",
        "mesh a.poly --insert magic",
        "verify a.poly",
        "verify a.poly x.node --tolerance nan",
        "verify a.poly x.node --merge-angle 720",
    ] {
        let run = place.run(arguments).ends_with(2);
        assert!(run.stderr().contains("--help"), "{}", run.stderr());
    }
    assert_eq!(place.names(), ["a.poly"]);
    place.run("--help").ends_with(0);
    assert!(
        place
            .run("--version")
            .ends_with(0)
            .stdout()
            .starts_with("tetflip ")
    );
}

#[cfg(feature = "rug")]
#[test]
fn rug_times_give_the_same_files() {
    let place = Place::with(&[("rooms.poly", ROOMS)]);
    place
        .run("mesh rooms.poly -o x.node --times rug")
        .ends_with(0);
    place
        .run("mesh rooms.poly -o y.node --times exact")
        .ends_with(0);
    for name in ["node", "ele", "face", "edge"] {
        assert_eq!(
            place.bytes(&format!("x.{name}")),
            place.bytes(&format!("y.{name}"))
        );
    }
}

/// The fields of an object, and those of the objects in it after its name and a dot.
fn fields(value: &serde_json::Value, prefix: &str, names: &mut Vec<String>) {
    for (name, value) in value.as_object().expect("an object") {
        let name = format!("{prefix}{name}");
        match value {
            serde_json::Value::Object(_) if name != "insertion" => {
                fields(value, &format!("{name}."), names);
            }
            _ => names.push(name),
        }
    }
}

#[test]
fn the_report_has_the_documented_fields() {
    let place = Place::with(&[("rooms.poly", ROOMS), ("open.off", &off(5))]);
    place.run("mesh rooms.poly --report r.json").ends_with(0);
    let report: serde_json::Value = serde_json::from_slice(&place.bytes("r.json")).expect("JSON");
    assert_eq!(report["input"], "rooms.poly");
    assert_eq!(report["outcome"], "ok");
    assert_eq!(report["insertion"], serde_json::json!({ "flip": "exact" }));
    assert_eq!(
        (&report["input_vertices"], &report["segments"]),
        (&20.into(), &32.into())
    );
    let mut names = Vec::new();
    fields(&report, "", &mut names);
    let readme = include_str!("../README.md");
    let documented: Vec<&str> = readme
        .lines()
        .skip_while(|line| *line != "| field of the report | meaning |")
        .skip(2)
        .take_while(|line| line.starts_with("| `"))
        .filter_map(|line| line.split('`').nth(1))
        .collect();
    names.sort();
    let mut sorted = documented.clone();
    sorted.sort_unstable();
    assert_eq!(names, sorted);
    // A failure is reported, too.
    place.run("mesh open.off --report r.json").ends_with(1);
    let report: serde_json::Value = serde_json::from_slice(&place.bytes("r.json")).expect("JSON");
    assert!(
        report["outcome"]
            .as_str()
            .expect("a text")
            .starts_with("gave up: ")
    );
}

/// The README shows commands after `$ ` in blocks marked `console`, and what they print.
#[test]
fn the_readme_shows_what_the_program_prints() {
    let place = Place::with(&[("open.off", &off(5))]);
    std::fs::create_dir(place.path("examples")).expect("a directory");
    std::fs::write(place.path("examples/rooms.poly"), ROOMS).expect("a file");
    let mut commands = 0;
    let blocks = include_str!("../README.md").split("```console\n").skip(1);
    for block in blocks.map(|b| b.split("```").next().expect("a block")) {
        for shown in block.split("$ ").skip(1) {
            let (command, expected) = shown.split_once('\n').expect("a line");
            let run = place.run(command.strip_prefix("tetflip ").expect("a command of ours"));
            assert_eq!(run.stdout() + &run.stderr(), expected, "{command}");
            commands += 1;
        }
    }
    assert!(commands >= 3, "the README shows commands");
}

#[cfg(unix)]
#[test]
fn closed_pipes_do_not_change_the_exit_status() {
    let place = Place::with(&[("a.poly", &poly(&[CUBE], &[])), ("open.off", &off(5))]);
    for (arguments, status) in [
        ("mesh a.poly", 0),
        ("mesh open.off", 1),
        ("mesh none.off", 2),
    ] {
        // A pipe that nobody reads.
        let closed = || {
            let (reader, writer) = std::io::pipe().expect("a pipe");
            drop(reader);
            writer
        };
        let ended = Command::new(env!("CARGO_BIN_EXE_tetflip"))
            .args(arguments.split_whitespace())
            .current_dir(place.directory.path())
            .stdout(closed())
            .stderr(closed())
            .status()
            .expect("the program starts");
        assert_eq!(ended.code(), Some(status), "{arguments}");
    }
}
