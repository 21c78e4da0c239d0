//! Where meshes and reports go: stdout, symbolic links, names that are taken; and notes beside them.

use crate::program::input::{CUBE, off, poly};
use crate::program::place::Place;

#[test]
fn a_mesh_goes_to_stdout_where_a_format_is_given() {
    let place = Place::with(&[("a.off", &off(6))]);
    place.run("mesh a.off -o x.vtu").ends_with(0);
    let run = place.run("mesh a.off -o - --format vtu").ends_with(0);
    assert_eq!(run.output.stdout, place.bytes("x.vtu"));
    assert!(run.stderr().starts_with("8 vertices"), "{}", run.stderr());
    assert_eq!(place.names(), ["a.off", "x.vtu"]);
    place.refuses("mesh a.off -o -", 2, &["--format"]);
    place.refuses("mesh a.off -o - --format node", 2, &["\"node\"", "vtu"]);
    place.refuses("mesh a.off -o y.vtu --format vtu", 2, &["--output -"]);
}

#[test]
fn a_report_does_not_replace_the_mesh() {
    let place = Place::with(&[("a.off", &off(6))]);
    for name in ["x.node", "./x.face", "x.failure.poly"] {
        let arguments = format!("mesh a.off -o x.ele --report {name}");
        place.refuses(&arguments, 2, &[name, "report"]);
    }
    place
        .run("mesh a.off -o x.ele --report x.json")
        .ends_with(0);
}

#[cfg(unix)]
#[test]
fn symbolic_links_are_followed() {
    let place = Place::with(&[("a.off", &off(6))]);
    std::fs::create_dir(place.path("far")).expect("a directory");
    std::os::unix::fs::symlink("far/mesh.vtu", place.path("x.vtu")).expect("a link");
    place.run("mesh a.off -o x.vtu").ends_with(0);
    place.run("mesh a.off -o y.vtu").ends_with(0);
    let link = place.path("x.vtu").symlink_metadata().expect("it is there");
    assert!(link.is_symlink());
    assert_eq!(place.bytes("far/mesh.vtu"), place.bytes("y.vtu"));
}

#[test]
fn a_failed_write_names_the_file_that_was_asked_for() {
    let place = Place::with(&[("a.off", &off(6))]);
    let run = place.run("mesh a.off -o none/x.node").ends_with(2);
    let said = run.stderr();
    assert!(said.contains("none/x.node"), "{said}");
    assert!(!said.contains(".tetflip-"), "{said}");
}

#[test]
fn notes_are_on_stderr_and_in_the_report() {
    // A region point outside, and one with a bound that is not applied.
    let text = poly(&[CUBE], &[]) + "2\n1 5 5 5 1 0.5\n2 0.5 0.5 0.5 2 -1\n";
    let place = Place::with(&[("a.poly", &text)]);
    let run = place
        .run("mesh a.poly -o x.node --quiet --report r.json")
        .ends_with(0);
    let said = run.stderr();
    assert!(said.contains("note[region-outside]: region point (5, 5, 5) is"));
    assert!(said.contains("note[region-volume]: the volume bound 0.5"));
    let report: serde_json::Value = serde_json::from_slice(&place.bytes("r.json")).expect("JSON");
    let notes = report["notes"].as_array().expect("a list");
    let codes: Vec<&str> = notes.iter().filter_map(|n| n["code"].as_str()).collect();
    assert_eq!(codes, ["region-volume", "region-outside"]);
    assert_eq!(notes[1]["points"][0], serde_json::json!([5.0, 5.0, 5.0]));
}

#[test]
fn the_table_of_faces_names_facets_and_regions() {
    let outer = [[0.0; 3], [3.0; 3]];
    let inner = [[1.0; 3], [2.0; 3]];
    let place = Place::with(&[("a.poly", &poly(&[outer, inner], &[]))]);
    place.run("mesh a.poly -o x.node").ends_with(0);
    let table = String::from_utf8(place.bytes("x.facets")).expect("UTF-8");
    let numbers: Vec<Vec<usize>> = table
        .lines()
        .filter(|line| !line.starts_with('#'))
        .map(|line| {
            line.split(' ')
                .map(|w| w.parse().expect("a number"))
                .collect()
        })
        .collect();
    let faces = place.count("x.face");
    assert_eq!(numbers[0], [faces]);
    let (faces, polygons) = numbers[1..].split_at(faces);
    assert_eq!(polygons[0], [12]);
    let facet_of = |polygon: usize| polygons[polygon][1];
    for row in faces {
        let [_, behind, front, polygon] = row[..] else {
            panic!("{row:?}");
        };
        match facet_of(polygon) {
            1..=6 => assert!(behind > 0 && front == 0, "{row:?}"),
            _ => assert_eq!((behind, front), (1, 2), "{row:?}"),
        }
    }
}
