//! What the program refuses, with which exit status and message; nothing is written then.

use crate::program::input::{CUBE, FLAT, Point, ROOMS, off, poly, stl};
use crate::program::place::Place;
use std::fmt::Write;
use std::process::Command;

#[test]
fn an_open_surface_is_refused_with_its_edges() {
    let place = Place::with(&[("open.off", &off(5))]);
    // The missing face is 1 3 7 5.
    let edges = [
        "4 edges",
        "1-3, 1-5, 3-7, 5-7",
        "--hull",
        "check open.off -o",
    ];
    place.refuses("mesh open.off -o x.node --quiet", 2, &edges);
    place
        .run("mesh open.off -o y.node --hull --verify")
        .ends_with(0);
    place
        .run("verify open.off y.node --domain hull")
        .ends_with(0);
    place.run("check open.off -o bad.vtu").ends_with(0);
    let picture = String::from_utf8(place.bytes("bad.vtu")).expect("UTF-8");
    assert!(picture.contains(r#"NumberOfCells="4""#), "{picture}");
}

#[test]
fn nothing_but_vertices_encloses_nothing() {
    let place = Place::with(&[("p.node", "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n")]);
    place.refuses("mesh p.node -o x.node", 2, &["enclose nothing", "--hull"]);
    place.run("mesh p.node -o x.node --hull").ends_with(0);
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
        ("cube.step", "ISO-10303-21;\n"),
    ]);
    for command in ["mesh", "delaunay"] {
        let to = "-o x.node";
        place.refuses(
            &format!("{command} none.poly {to}"),
            2,
            &["none.poly", "cannot read"],
        );
        place.refuses(
            &format!("{command} cube.step {to}"),
            2,
            &["cube.step", "\"step\"", ".poly", "looks like a STEP file"],
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
        let strict = |file: &str| mesh(file) + " --strict";
        place.refuses(&mesh("bar.poly"), 2, &["invalid PLC", "facet 6 (2 4 8 6)"]);
        place.refuses(
            &mesh("bowtie.off"),
            2,
            &["edges", "facet 0 (0 3 2 1)", "cross"],
        );
        place.refuses(&mesh("wires.poly"), 2, &["edge 1-2", "edge 3-4", "cross"]);
        place.refuses(
            &strict("touch.poly"),
            2,
            &["inside facet 6 (2 4 8 6), which does not have it"],
        );
        place.refuses(&strict("edge.poly"), 2, &["lies on edge"]);
        place.refuses(
            &strict("twice.poly"),
            2,
            &["facet 1 (1 3 4 2)", "facet 7", "the same"],
        );
    }
    for file in ["touch.poly", "edge.poly", "twice.poly"] {
        place
            .run(&format!("mesh {file} --hull -o y.node"))
            .ends_with(0);
        place
            .run(&format!("verify {file} y.node --domain hull"))
            .ends_with(0);
    }
}

/// After a rotation facets are flat only to rounding, and slivers of the convex hull look as if they crossed them.
#[test]
fn a_rotated_box_is_meshed() {
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
        run.ends_with(0);
    }
}

#[test]
fn bad_usage_ends_with_2() {
    let place = Place::with(&[("a.poly", &poly(&[CUBE], &[]))]);
    place.refuses("mesh a.poly -o x.txt", 2, &["x.txt", ".node", ".vtu"]);
    place.refuses("mesh a.poly -o none/x.node", 2, &["none"]);
    place.refuses("mesh a.poly --report none/r.json", 2, &["none"]);
    #[cfg(not(feature = "rug"))]
    {
        let run = place.run("mesh a.poly --times rug -o x.node").ends_with(2);
        assert!(run.stderr().contains("--features rug"), "{}", run.stderr());
    }
    for insert in ["cavity", "gift-wrap"] {
        place.refuses(
            &format!("mesh a.poly --insert {insert} --times exact"),
            2,
            &["--times exact", "--insert flip"],
        );
    }
    let run = place.run("mesh a.poly --times bits:31").ends_with(2);
    assert!(run.stderr().contains("8, 11, 14, 16"), "{}", run.stderr());
    for arguments in [
        "",
        "mesh",
        "frobnicate a.poly",
        "mesh a.poly --insert magic",
        "mesh a.poly --times magic",
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

/// A prism with its corners on a sphere, and a seventh vertex, on which flips with times in `f64` get stuck.
pub const PRISM: &str = "7 3 0 0\n\
    0 1.3078065480124408 1.3779478464061732 -0.5394744828808755\n\
    1 1.8112690899167683 1.0202704609080397 -1.6376913668019157\n\
    2 0.4649072456801425 -0.3282048520190928 -1.8157287244026517\n\
    3 1.6542434170044296 1.053176664204991 -0.6994603458649746\n\
    4 0.3078815727678037 -0.2952986487221416 -0.8774977034657107\n\
    5 -0.038555296224185076 0.029472533479040663 -0.7175118404816117\n\
    6 0.3143400366393333 -0.30606522139760983 -1.2501464545143133\n\
    1 1\n\
    1 0 0\n\
    3 4 2 5\n\
    0\n\
    0\n";

#[test]
fn failed_flips_leave_their_region_to_try_again() {
    let place = Place::with(&[("a.poly", PRISM)]);
    let run = place
        .run("mesh a.poly --hull --times f64:plain -o x.node")
        .ends_with(1);
    let again =
        "tetflip mesh x.failure.poly --hull --precision exact --insert flip --times f64:plain";
    assert!(
        run.stderr().ends_with(&format!("{again}\n")),
        "{}",
        run.stderr()
    );
    assert_eq!(place.names(), ["a.poly", "x.failure.poly"]);
    let again = again.strip_prefix("tetflip ").expect("the program");
    place.refuses(again, 1, &["7 crossing tetrahedra left", "--output"]);
    // The region is the input now, and not overwritten.
    place.refuses(
        &format!("{again} -o x.node"),
        2,
        &["x.failure.poly", "overwritten"],
    );
    place
        .run("mesh x.failure.poly --hull --verify")
        .ends_with(0);
    place.refuses("mesh a.poly --hull --times f64:plain", 1, &["--output"]);
}

#[cfg(unix)]
#[test]
fn closed_pipes_do_not_change_the_exit_status() {
    let place = Place::with(&[("a.poly", &poly(&[CUBE], &[])), ("flat.off", FLAT)]);
    for (arguments, status) in [
        ("mesh a.poly", 0),
        ("mesh flat.off", 2),
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

#[test]
fn bad_input_is_explained() {
    // A small box inside the cube, one face of which lies inside one of the cube's, but is not declared there.
    let inside: [Point; 2] = [[0.25, 0.25, 0.0], [0.75, 0.75, 0.5]];
    let place = Place::with(&[
        ("cube.poly", &poly(&[CUBE], &[])),
        ("bad.poly", &poly(&[CUBE, inside], &[])),
    ]);
    place.run("check cube.poly").ends_with(0);
    let named = ["facet 1 (1 3 4 2)", "facet 7 (9 11 12 10)", "overlap"];
    let explained = [&named[..], &["tetflip check bad.poly"]].concat();
    place.refuses("mesh bad.poly -o x.node --strict", 2, &explained);
    place.run("mesh bad.poly -o good.node").ends_with(0);
    place.run("verify bad.poly good.node").ends_with(0);
    place.run("check bad.poly").ends_with(2);
    place.run("check bad.poly -o bad.vtu --max 1").ends_with(2);
    let picture = String::from_utf8(place.bytes("bad.vtu")).expect("UTF-8");
    assert!(picture.contains(r#"Name="pair""#) && picture.trim_end().ends_with("</VTKFile>"));
    place.refuses("check bad.poly -o bad.ele", 2, &["bad.ele", ".vtu"]);
    place.refuses("check none.poly", 2, &["none.poly", "cannot read"]);
    let output = Command::new(env!("CARGO_BIN_EXE_tetflip"))
        .args(["check", "bad.poly", "--json"])
        .current_dir(place.directory.path())
        .output()
        .expect("the program starts");
    let found: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(found["valid"], false);
    let conflicts = found["conflicts"].as_array().expect("a list");
    assert_eq!(conflicts[0]["kind"], "facets-overlap");
    assert_eq!(conflicts[0]["parts"][1]["facet"], 7);
    // The face itself, and the four beside it that stand on it.
    assert_eq!(conflicts.len(), 5);
}
