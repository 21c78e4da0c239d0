//! Files: names in capitals, other formats, and what is left where a run fails or an earlier one did.

use crate::program::input::{BOX_FACES, CUBE, box_corners, poly};
use crate::program::place::Place;
use crate::program::refusals::PRISM;
use std::fmt::Write;

/// The cube of [`poly`] as vertices and faces, with the given words before each, and its numbers counted from `first`.
fn list(vertex: &str, face: &str, first: usize, reference: &str) -> (String, String) {
    let (mut vertices, mut faces) = (String::new(), String::new());
    for [x, y, z] in box_corners(CUBE) {
        writeln!(vertices, "{vertex}{x} {y} {z}{reference}").expect("a string");
    }
    for f in BOX_FACES {
        let [a, b, c, d] = f.map(|v| v + first);
        writeln!(faces, "{face}{a} {b} {c} {d}{reference}").expect("a string");
    }
    (vertices, faces)
}

#[test]
fn ply_obj_and_medit_are_meshed_and_verified() {
    let (v, f) = list("v ", "f ", 1, "");
    let obj = v + &f;
    let (v, f) = list("", "", 1, " 0");
    let medit =
        format!("MeshVersionFormatted 1\nDimension 3\nVertices 8\n{v}Quadrilaterals 6\n{f}End\n");
    let (v, f) = list("", "4 ", 0, "");
    let ply = format!(
        "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n\
         element face 6\n\
         property list uchar int vertex_indices\nend_header\n{v}{f}"
    );
    let place = Place::with(&[("a.obj", &obj), ("b.mesh", &medit), ("C.PLY", &ply)]);
    for input in ["a.obj", "b.mesh", "C.PLY"] {
        let run = place
            .run(&format!("mesh {input} -o x.node --verify"))
            .ends_with(0);
        let said = run.stdout();
        assert!(
            said.starts_with("8 vertices (0 Steiner points), "),
            "{said}"
        );
        assert!(said.ends_with("; verified\n"), "{said}");
        place.run(&format!("verify {input} x.node")).ends_with(0);
    }
}

#[test]
fn names_in_capitals_are_the_same_formats() {
    let place = Place::with(&[("A.POLY", &poly(&[CUBE], &[]))]);
    place.run("mesh A.POLY -o X.NODE").ends_with(0);
    place.run("mesh A.POLY -o Y.VTU").ends_with(0);
    place.run("verify A.POLY X.ELE").ends_with(0);
    place.run("mesh A.POLY -o z.Node").ends_with(0);
    let all = [
        "A.POLY", "X.EDGE", "X.ELE", "X.FACE", "X.FACETS", "X.NODE", "Y.VTU", "z.edge", "z.ele",
        "z.face", "z.facets", "z.node",
    ];
    assert_eq!(place.names(), all);
    assert_eq!(place.bytes("X.ELE"), place.bytes("z.ele"));
}

#[test]
fn a_success_removes_the_region_of_an_earlier_failure() {
    let place = Place::with(&[("a.poly", PRISM)]);
    place
        .run("mesh a.poly --hull --times f64:plain -o x.node")
        .ends_with(1);
    assert_eq!(place.names(), ["a.poly", "x.failure.poly"]);
    // Another output is another run.
    place.run("mesh a.poly --hull -o y.vtu").ends_with(0);
    assert_eq!(place.names(), ["a.poly", "x.failure.poly", "y.vtu"]);
    place.run("mesh a.poly --hull -o x.vtu").ends_with(0);
    assert_eq!(place.names(), ["a.poly", "x.vtu", "y.vtu"]);
}

#[test]
fn a_place_that_is_taken_leaves_nothing_written() {
    let place = Place::with(&[("a.poly", &poly(&[CUBE], &[]))]);
    std::fs::create_dir(place.path("x.face")).expect("a directory");
    place.refuses("mesh a.poly -o x.node", 2, &["x.face", "directory"]);
    place.refuses("mesh a.poly -o none/x.node", 2, &["none"]);
    place.refuses("mesh a.poly -o y.node --report none/r.json", 2, &["r.json"]);
    place
        .run("mesh a.poly -o y.vtu --report r.json")
        .ends_with(0);
    assert_eq!(place.names(), ["a.poly", "r.json", "x.face", "y.vtu"]);
}
