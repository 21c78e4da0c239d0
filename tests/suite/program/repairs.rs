//! The program repairs what is exactly repairable, with notes; `--strict` refuses it.

use crate::program::input::{CUBE, poly, stl};
use crate::program::place::Place;

#[test]
fn two_cubes_with_a_wall_each() {
    // The cube again, one to the right, with vertices and markers of its own.
    let cube = poly(&[CUBE], &[]);
    let right = |[x, y, z]: [f64; 3]| [x + 1.0, y, z];
    let both = poly(&[CUBE, CUBE.map(right)], &[]);
    assert!(both.len() > cube.len());
    let place = Place::with(&[("both.poly", &both)]);
    let refusal = ["are the same", "without --strict", "check both.poly"];
    place.refuses("mesh both.poly -o x.node --strict", 2, &refusal);
    let check = place.run("check both.poly").ends_with(2).stdout();
    assert!(check.contains("mesh repairs this"), "{check}");
    for way in ["", " --insert cavity", " --no-merge", " --steiner exact"] {
        let run = place.run(&format!(
            "mesh both.poly -o x.node --verify --report r.json{way}"
        ));
        let run = run.ends_with(0);
        let notes: Vec<String> = run.stderr().lines().map(str::to_owned).collect();
        assert_eq!(notes.len(), 1, "{notes:?}");
        assert!(notes[0].starts_with("note[repeated-facets]: "), "{notes:?}");
        let report = String::from_utf8(place.bytes("r.json")).expect("UTF-8");
        assert!(report.contains("\"repeated-facets\""), "{report}");
        place.run("verify both.poly x.node").ends_with(0);
    }
    let run = place.run("mesh both.poly -o x.node --quiet").ends_with(0);
    assert!(run.stderr().contains("note[repeated-facets]"));
}

#[test]
fn a_facet_of_an_stl_twice() {
    let text = stl();
    let first = text.find("facet").expect("a facet");
    let next = first + text[first..].find("endfacet").expect("its end") + "endfacet\n".len();
    let twice = text[..next].to_owned() + &text[first..];
    let place = Place::with(&[("twice.stl", &twice)]);
    place.run("mesh twice.stl -o x.node --verify").ends_with(0);
    place.run("verify twice.stl x.node").ends_with(0);
    let facets = String::from_utf8(place.bytes("x.facets")).expect("UTF-8");
    // Three triangles of the file on one side of the cube: facets 0, 1 and one more.
    let three = facets.lines().filter(|line| line.split(' ').count() == 4);
    assert!(three.count() > 0, "{facets}");
    place.refuses("mesh twice.stl -o y.node --strict", 2, &["the same"]);
}
