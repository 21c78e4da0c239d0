//! `tetflip generate`: models that `check` and `mesh` accept, the same ones every time.

use crate::program::place::Place;

#[test]
fn a_generated_model_is_checked_meshed_and_verified() {
    let place = Place::with(&[]);
    let run = place
        .run("generate crankcase --seed 3 --size 300 -o a.poly")
        .ends_with(0);
    let summary = run.stdout();
    assert!(summary.starts_with("crankcase, seed 3: "), "{summary}");
    assert!(
        summary.ends_with(" 0 segments, 0 holes, 4 regions\n"),
        "{summary}"
    );
    place.run("check a.poly").ends_with(0);
    let run = place.run("mesh a.poly -o a.node --verify").ends_with(0);
    assert!(run.stdout().ends_with("; verified\n"), "{}", run.stdout());
    place
        .run("generate crankcase --seed 3 --size 300 -o b.poly -q")
        .ends_with(0);
    assert_eq!(place.bytes("a.poly"), place.bytes("b.poly"));
    place
        .run("generate crankcase --seed 4 --size 300 -o c.poly")
        .ends_with(0);
    assert_ne!(place.bytes("a.poly"), place.bytes("c.poly"));
}

#[test]
fn what_there_is_is_listed() {
    let place = Place::with(&[]);
    let list = place.run("generate --list").ends_with(0).stdout();
    let words = list.lines().map(|line| line.split_whitespace().next());
    for kind in words {
        let kind = kind.expect("a name");
        place
            .run(&format!("generate {kind} --size 20 -o x.poly"))
            .ends_with(0);
    }
    assert_eq!(list.lines().count(), tetflip::generate::Kind::ALL.len());
}

#[test]
fn what_cannot_be_made_is_refused() {
    let place = Place::with(&[]);
    place.refuses("generate maze -o x.off", 2, &["x.off", ".poly"]);
    place.refuses("generate maze -o no/x.poly", 2, &["x.poly"]);
    for arguments in [
        "generate",
        "generate maze",
        "generate mazes -o x.poly",
        "generate maze --size 0 -o x.poly",
        "generate maze --size 1000000000 -o x.poly",
        "generate maze --list",
    ] {
        place.run(arguments).ends_with(2);
    }
    assert!(place.names().is_empty());
}
