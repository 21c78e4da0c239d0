//! Stdin and stdout in the place of files, and formats that names do not say.

use super::input::{off, stl};
use super::place::Place;

#[test]
fn stdin_is_read_like_a_file() {
    let place = Place::with(&[("a.off", &off(6))]);
    place.run("mesh a.off -o a.node").ends_with(0);
    let text = place.bytes("a.off");
    let run = place
        .run_with("mesh - --format off -o b.node --verify", &text)
        .ends_with(0);
    assert!(run.stdout().ends_with("; verified\n"), "{}", run.stdout());
    assert_eq!(run.stderr(), "");
    for extension in ["node", "ele", "face", "edge"] {
        let [a, b] = ["a", "b"].map(|stem| place.bytes(&format!("{stem}.{extension}")));
        assert!(a == b, "{extension}");
    }
    let checked = place.run("check a.off").ends_with(0).stdout();
    assert_eq!(
        place
            .run_with("check - --format OFF", &text)
            .ends_with(0)
            .stdout(),
        checked
    );
    let verified = place.run("verify a.off a.node").ends_with(0).stdout();
    let run = place
        .run_with("verify - a.node --format off", &text)
        .ends_with(0);
    assert_eq!(run.stdout(), verified);
    let points = place.run("delaunay a.off").ends_with(0).stdout();
    assert_eq!(
        place
            .run_with("delaunay - --format off", &text)
            .ends_with(0)
            .stdout(),
        points
    );
}

#[test]
fn a_mesh_on_stdout_is_alone_there() {
    let place = Place::with(&[("a.off", &off(6))]);
    place.run("mesh a.off -o a.vtu").ends_with(0);
    place.run("delaunay a.off -o b.vtu").ends_with(0);
    let text = place.bytes("a.off");
    for (command, file) in [("mesh", "a.vtu"), ("delaunay", "b.vtu")] {
        for formats in [
            "--format off",
            "--format off --format vtu",
            "--format vtu --format off",
        ] {
            let run = place
                .run_with(&format!("{command} - -o - {formats}"), &text)
                .ends_with(0);
            assert!(
                run.output.stdout == place.bytes(file),
                "{command} {formats}"
            );
            assert!(run.stderr().contains("8 "), "{}", run.stderr());
        }
        let run = place
            .run(&format!("{command} a.off -o - --format vtu -q"))
            .ends_with(0);
        assert!(run.output.stdout == place.bytes(file), "{command}");
        assert_eq!(run.stderr(), "");
    }
}

#[test]
fn formats_that_are_not_said() {
    let place = Place::with(&[
        ("cube.txt", &stl()),
        ("cube.poly", &stl()),
        ("what.dat", "8 3 0 0\n"),
    ]);
    // By content, with a note; an extension is taken at its word.
    let run = place.run_with("check -", stl().as_bytes()).ends_with(0);
    assert!(
        run.stderr().starts_with("note[format-by-content]: "),
        "{}",
        run.stderr()
    );
    assert!(run.stderr().contains("an STL file"), "{}", run.stderr());
    for name in ["cube.txt", "cube.poly"] {
        let run = place
            .run(&format!("check {name} --format stl"))
            .ends_with(0);
        assert_eq!(run.stderr(), "");
        place.refuses(
            &format!("mesh {name}"),
            2,
            &[name, "looks like an STL file"],
        );
    }
    for (arguments, part) in [
        ("mesh cube.txt --format stl --format off", "given twice"),
        ("mesh cube.txt --format vtu", "--format vtu"),
        ("mesh cube.txt -o - --format stl --format xyz", "xyz"),
        ("check cube.txt --format vtu", "one of poly, smesh"),
        ("delaunay cube.txt -o -", "needs a --format"),
    ] {
        place.refuses(arguments, 2, &[part]);
    }
    place.refuses("mesh what.dat", 2, &["\"dat\"", "--format says what it is"]);
    let run = place.run_with("mesh -", b"8 3 0 0").ends_with(2);
    assert!(
        run.stderr()
            .contains("standard input: it looks like no format"),
        "{}",
        run.stderr()
    );
    let run = place
        .run_with("mesh - --format poly", b"0 3\n1 0\n1\n3 1 2 3\n")
        .ends_with(2);
    assert!(
        run.stderr()
            .contains("standard input: the vertices are in a .node file"),
        "{}",
        run.stderr()
    );
}
