//! The program: what it accepts, refuses, writes and says. Exit status 0 is success, 1 that the algorithm gave up or a
//! verification failed, 2 bad input or usage; whatever fails leaves no file behind.

mod determinism;
mod documents;
mod files;
mod generate;
mod input;
mod outputs;
mod place;
mod recorded;
mod refusals;
mod repairs;
mod streams;

use input::{CUBE, FLAT, ROOMS, off, poly, stl};
use place::Place;

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
        assert_eq!(place.count("x.node"), 8);
        assert_eq!(place.count("x.face"), 12);
        assert_eq!(place.count("x.edge"), 12);
        let run = place.run(&format!("verify {input} x.node")).ends_with(0);
        assert!(run.stdout().ends_with("\naccepted\n"), "{}", run.stdout());
    }
    let all = [
        "a.poly", "b.off", "c.stl", "x.edge", "x.ele", "x.face", "x.facets", "x.node",
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
    let steiner = place.count("x.node") - 8;
    assert_eq!(place.count("x.edge"), 18 + steiner);
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
        first >= 5 && second > first && first + second == place.count("x.ele"),
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
            ["a.poly", "x.edge", "x.ele", "x.face", "x.facets", "x.node"]
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
    let place = Place::with(&[("a.poly", &poly(&[CUBE], &[])), ("flat.off", FLAT)]);
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
    place.refuses("mesh flat.off --quiet", 2, &["one plane"]);
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
    assert_eq!(place.count("x.node"), 6);
    assert_eq!(place.count("x.ele"), 1);
    place.run("verify p.node x.node --domain hull").ends_with(0);
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
