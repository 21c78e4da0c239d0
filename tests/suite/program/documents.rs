//! The README says what the program does.

use crate::program::input::{FLAT, ROOMS, off};
use crate::program::place::Place;

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
    let place = Place::with(&[("rooms.poly", ROOMS), ("flat.off", FLAT)]);
    place
        .run("mesh rooms.poly --verify --report r.json")
        .ends_with(0);
    let report: serde_json::Value = serde_json::from_slice(&place.bytes("r.json")).expect("JSON");
    assert_eq!(report["input"], "rooms.poly");
    assert_eq!(report["outcome"], "ok");
    assert_eq!(
        report["insertion"],
        serde_json::json!({ "flip": "filtered" })
    );
    assert_eq!(
        (&report["input_vertices"], &report["segments"]),
        (&20.into(), &32.into())
    );
    let mut names = Vec::new();
    fields(&report, "", &mut names);
    let readme = include_str!("../../../README.md");
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
    place.run("mesh flat.off --report r.json").ends_with(2);
    let report: serde_json::Value = serde_json::from_slice(&place.bytes("r.json")).expect("JSON");
    assert!(
        report["outcome"]
            .as_str()
            .expect("a text")
            .contains("lie on one plane")
    );
}

/// The README shows commands after `$ ` in blocks marked `console`, and what they print.
#[test]
fn the_readme_shows_what_the_program_prints() {
    let place = Place::with(&[("open.off", &off(5))]);
    std::fs::create_dir(place.path("examples")).expect("a directory");
    std::fs::write(place.path("examples/rooms.poly"), ROOMS).expect("a file");
    let mut commands = 0;
    let blocks = include_str!("../../../README.md")
        .split("```console\n")
        .skip(1);
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
