//! The command `survey`: every outcome is a row, rows survive interruption, and shards make up the whole.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use tempfile::TempDir;

type Row = BTreeMap<String, String>;

/// Two rooms with a wall between them and a block left out.
const ROOMS: &str = include_str!("../../examples/rooms.poly");

/// Boxes as an OFF file.
fn boxes(list: &[[[f64; 3]; 2]]) -> String {
    const FACES: [[usize; 4]; 6] = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let mut text = format!("OFF\n{} {} 0\n", 8 * list.len(), 6 * list.len());
    for corners in list {
        for i in 0..8 {
            let [x, y, z] = std::array::from_fn(|axis| corners[i >> axis & 1][axis]);
            writeln!(text, "{x} {y} {z}").expect("a string");
        }
    }
    for first in (0..list.len()).map(|i| 8 * i) {
        for [a, b, c, d] in FACES.map(|face| face.map(|v| v + first)) {
            writeln!(text, "4 {a} {b} {c} {d}").expect("a string");
        }
    }
    text
}

/// A grid of boxes that do not touch: its vertices alone take a while.
fn crowd(n: usize) -> String {
    let at = |i: usize| (i as f64) * 2.0;
    let corner = |i: usize| [at(i % n), at(i / n % n), at(i / n / n)];
    let one = |i: usize| [corner(i), corner(i).map(|x| x + 1.0)];
    boxes(&(0..n * n * n).map(one).collect::<Vec<_>>())
}

struct Place {
    directory: TempDir,
}

impl Place {
    /// A collection with one model for each outcome that needs no tight limit.
    fn new() -> Place {
        let place = Place {
            directory: tempfile::tempdir().expect("a temporary directory"),
        };
        let cube = [[0.0; 3], [1.0; 3]];
        let apart = [[2.0; 3], [3.0; 3]];
        let across = [[0.5; 3], [1.5; 3]];
        for (name, text) in [
            ("good/rooms.poly", ROOMS.to_owned()),
            ("good/cube.OFF", boxes(&[cube])),
            ("good/two, with a comma.off", boxes(&[cube, apart])),
            ("bad/crossing.off", boxes(&[cube, across])),
            ("bad/malformed.stl", "solid nothing\nfacet\n".to_owned()),
            (
                "bad/flat.off",
                "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n".to_owned(),
            ),
            ("none.txt", "no model".to_owned()),
        ] {
            let path = place.path("models").join(name);
            std::fs::create_dir_all(path.parent().expect("a directory")).expect("it is made");
            std::fs::write(path, text).expect("a file");
        }
        place
    }

    fn path(&self, name: &str) -> PathBuf {
        self.directory.path().join(name)
    }

    fn survey(&self, arguments: &[&str]) -> Output {
        let mut command = Command::new(env!("CARGO_BIN_EXE_tetflip"));
        let command = command.arg("survey").args(arguments);
        command
            .current_dir(self.directory.path())
            .output()
            .expect("the program starts")
    }

    fn surveys(&self, arguments: &[&str]) -> String {
        let output = self.survey(arguments);
        assert!(output.status.success(), "{output:?}");
        String::from_utf8(output.stdout).expect("UTF-8")
    }

    fn rows(&self, name: &str) -> Vec<Row> {
        rows(&self.path(name))
    }
}

fn rows(path: &Path) -> Vec<Row> {
    let mut reader = csv::Reader::from_path(path).expect("a table");
    reader
        .deserialize()
        .map(|row| row.expect("a row"))
        .collect()
}

/// What does not depend on the clock or the state of the machine.
fn lasting(rows: &[Row]) -> Vec<Row> {
    let fleeting = |name: &String| name.starts_with("seconds") || name == "peak_mib";
    let mut rows = rows.to_vec();
    for row in &mut rows {
        row.retain(|name, _| !fleeting(name));
    }
    rows.sort();
    rows
}

#[test]
fn every_outcome_is_a_row() {
    let place = Place::new();
    let methods = "cavity,flip:filtered,flip:exact";
    let said = place.surveys(&["models", "-o", "t.csv", "--methods", methods]);
    let rows = place.rows("t.csv");
    let key = |row: &Row| {
        (
            row["file"].clone(),
            row["insertion"].clone(),
            row["times"].clone(),
        )
    };
    assert_eq!(rows.len(), 18, "{rows:?}");
    assert_eq!(rows.iter().map(key).collect::<BTreeSet<_>>().len(), 18);
    for row in &rows {
        let outcome = (row["outcome"].as_str(), row["kind"].as_str());
        let expected = match row["file"].as_str() {
            "bad/malformed.stl" => ("unreadable", outcome.1),
            "bad/flat.off" => ("degenerate", "TooFew"),
            "bad/crossing.off" => ("invalid", outcome.1),
            _ => ("ok", ""),
        };
        assert_eq!(outcome, expected, "{row:?}");
        let made = outcome.0 == "ok";
        assert_eq!(row["message"].is_empty(), made, "{row:?}");
        assert_eq!(row["verified"], if made { "yes" } else { "" });
        assert_eq!(row["equal"], if made { "yes" } else { "" });
        assert_eq!(row["mesh_hash"].is_empty(), !made);
        assert_eq!(row["steiner"], "rounded");
    }
    let room = rows.iter().find(|row| row["file"] == "good/rooms.poly");
    let room = room.expect("its first row");
    for (column, word) in [
        ("insertion", "cavity"),
        ("format", "poly"),
        ("vertices", "20"),
        ("facets", "17"),
        ("steiner_points", "0"),
        ("tetrahedra", "42"),
        ("flips", "0"),
        ("regions", "2"),
        ("segments", "32"),
        ("violations", "0"),
    ] {
        assert_eq!(room[column], word, "{column}");
    }
    assert_eq!(room["bytes"], ROOMS.len().to_string());
    for line in said.lines().skip(1) {
        let words: Vec<&str> = line.split_whitespace().collect();
        // ok, invalid, degenerate, unreadable, verified
        assert_eq!(&words[2..8], &["6", "3", "1", "1", "1", "3"], "{said}");
    }
    assert_eq!(said.lines().count(), 4, "{said}");
}

#[test]
fn the_check_is_a_method_without_a_mesh() {
    let place = Place::new();
    let said = place.surveys(&["models", "-o", "t.csv", "--methods=check,flip"]);
    let checks: BTreeMap<String, Row> = place
        .rows("t.csv")
        .into_iter()
        .filter(|row| row["insertion"] == "check")
        .map(|row| (row["file"].clone(), row))
        .collect();
    assert_eq!(checks.len(), 6);
    for (file, outcome) in [
        ("good/rooms.poly", "ok"),
        ("good/cube.OFF", "ok"),
        ("bad/crossing.off", "invalid"),
        ("bad/malformed.stl", "unreadable"),
    ] {
        let row = &checks[file];
        assert_eq!(row["outcome"], outcome, "{row:?}");
        for column in ["steiner", "equal", "verified", "tetrahedra", "mesh_hash"] {
            assert_eq!(row[column], "", "{column}");
        }
        let wrong = outcome == "invalid";
        assert_eq!(row["violations"] != "0", wrong, "{row:?}");
        assert_eq!(row["defects"].is_empty(), !wrong, "{row:?}");
    }
    // Methods and check agree: nothing to look at.
    assert_eq!(said.lines().count(), 3, "{said}");
}

#[test]
fn limits_end_one_run_and_not_the_survey() {
    let place = Place::new();
    std::fs::write(place.path("models/large.off"), crowd(30)).expect("a file");
    let run = |limit: &[&str], table: &str| -> Vec<Row> {
        let mut arguments = vec!["models", "-o", table, "--methods=cavity,flip", "--jobs=2"];
        arguments.extend(limit);
        let said = place.surveys(&arguments);
        assert!(said.contains("large.off  cavity rounded  "), "{said}");
        let (large, others): (Vec<Row>, Vec<Row>) = place
            .rows(table)
            .into_iter()
            .partition(|row| row["file"] == "large.off");
        assert_eq!((large.len(), others.len()), (2, 12));
        let lost = |row: &&Row| ["timeout", "memory", "crash"].contains(&row["outcome"].as_str());
        assert_eq!(others.iter().find(lost), None);
        large
    };
    // Not even this program gets through two hundred thousand vertices in that time; the others take a thousandth of
    // it.
    for row in run(&["--timeout=2"], "time.csv") {
        assert_eq!(row["outcome"], "timeout", "{row:?}");
        assert_eq!(row["limit_seconds"], "2");
    }
    if cfg!(target_os = "linux") {
        for row in run(&["--memory=64"], "memory.csv") {
            assert_eq!(row["outcome"], "memory", "{row:?}");
            assert!(row["message"].contains("64 MiB"), "{row:?}");
        }
    }
}

#[test]
fn a_table_that_was_cut_anywhere_is_completed() {
    let place = Place::new();
    let arguments = ["models", "-o", "t.csv", "--methods=cavity,flip", "--jobs=2"];
    let said = place.surveys(&arguments);
    let whole = std::fs::read(place.path("t.csv")).expect("the table");
    let expected = lasting(&place.rows("t.csv"));
    let header = whole.iter().position(|&b| b == b'\n').expect("a header") + 1;
    let cuts = [0, 1, header - 1, header, header + 1, whole.len() - 1]
        .into_iter()
        .chain((1..12).map(|i| header + (whole.len() - header) * i / 12));
    for cut in cuts {
        std::fs::write(place.path("t.csv"), &whole[..cut]).expect("it is written");
        let again = place.surveys(&arguments);
        assert_eq!(lasting(&place.rows("t.csv")), expected, "cut at {cut}");
        assert_eq!(again.lines().count(), said.lines().count());
        // What was whole has not been made again, not even its seconds have changed.
        let kept = whole[..cut].iter().rposition(|&b| b == b'\n');
        let kept = &whole[..kept.map_or(0, |i| i + 1)];
        let table = std::fs::read(place.path("t.csv")).expect("the table");
        assert!(table.starts_with(kept), "cut at {cut}");
    }
    // Another method: only its rows are new.
    place.surveys(&["models", "-o", "t.csv", "--methods=cavity,flip,flip:exact"]);
    let rows = place.rows("t.csv");
    assert_eq!(rows.len(), expected.len() / 2 * 3);
    let new = |row: &&Row| row["times"] == "exact" && row["outcome"] == "ok";
    assert_eq!(rows.iter().filter(new).count(), 3);
    assert!(rows.iter().filter(new).all(|row| row["equal"] == "yes"));
}

/// Kills the survey as nothing can prevent it, again and again, until it gets through.
#[test]
fn a_killed_survey_is_completed() {
    let place = Place::new();
    place.surveys(&["models", "-o", "t.csv", "--methods=cavity,flip"]);
    let expected = lasting(&place.rows("t.csv"));
    for milliseconds in (10..).step_by(7) {
        let mut child = Command::new(env!("CARGO_BIN_EXE_tetflip"))
            .args(["survey", "models", "-o", "k.csv", "--methods=cavity,flip"])
            .args(["--jobs=2", "-q"])
            .current_dir(place.directory.path())
            .spawn()
            .expect("the program starts");
        std::thread::sleep(std::time::Duration::from_millis(milliseconds));
        child.kill().expect("it is our child");
        if child.wait().expect("it has ended").success() {
            break;
        }
    }
    assert_eq!(lasting(&place.rows("k.csv")), expected);
}

/// A table without what depends on the clock and the machine, as text: header, order and all.
fn lasting_text(path: &Path) -> String {
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .from_path(path)
        .expect("a table");
    let records: Vec<csv::StringRecord> = reader.records().map(|r| r.expect("a row")).collect();
    let fleeting =
        |i: &usize| records[0][*i].starts_with("seconds") || &records[0][*i] == "peak_mib";
    let kept: Vec<usize> = (0..records[0].len()).filter(|i| !fleeting(i)).collect();
    let line = |r: &csv::StringRecord| kept.iter().map(|&i| &r[i]).collect::<Vec<_>>().join("\t");
    records.iter().map(line).collect::<Vec<_>>().join("\n")
}

#[test]
fn the_merged_tables_of_all_shards_are_the_table() {
    let place = Place::new();
    let methods = "--methods=flip,cavity";
    let output = place.survey(&["models", "-o", "t.csv", methods, "--quiet"]);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(
        said,
        "note[skipped-files]: 1 file is no model and skipped: 1 .txt\n"
    );
    let expected = lasting_text(&place.path("t.csv"));
    for shard in ["1/3", "2/3", "3/3"] {
        let name = format!("{}.csv", &shard[..1]);
        place.surveys(&["models", "-o", &name, methods, "--shard", shard]);
        assert!(
            place.rows(&name).len() < place.rows("t.csv").len(),
            "{shard}"
        );
    }
    let said = place.surveys(&["--merge", "3.csv", "1.csv", "2.csv", "-o", "all.csv"]);
    assert!(said.starts_with("method"), "{said}");
    assert_eq!(lasting_text(&place.path("all.csv")), expected);
    // What is merged is a table like any other, and what it has already is noted.
    place.surveys(&["models", "-o", "all.csv", methods]);
    let output = place.survey(&["--merge", "all.csv", "1.csv", "-o", "again.csv", "--quiet"]);
    assert!(
        String::from_utf8_lossy(&output.stderr).starts_with("note[repeated-rows]: "),
        "{output:?}"
    );
    assert_eq!(lasting_text(&place.path("again.csv")), expected);
}

#[test]
fn tables_that_do_not_belong_together_are_refused() {
    let place = Place::new();
    place.surveys(&["models/good", "-o", "a.csv", "--methods=flip"]);
    let table = std::fs::read_to_string(place.path("a.csv")).expect("a table");
    let refuses = |other: &str, output: &str, part: &str| {
        std::fs::write(place.path("b.csv"), other).expect("a file");
        let refused = place.survey(&["--merge", "a.csv", "b.csv", "-o", output]);
        let said = String::from_utf8_lossy(&refused.stderr).into_owned();
        assert_eq!(refused.status.code(), Some(2), "{said}");
        assert!(said.contains(part), "{said}");
        assert!(!place.path("all.csv").exists());
    };
    let other = table.replacen(",ok,", ",refused,", 1);
    refuses(&other, "all.csv", "outcome is `refused`, not `ok`");
    refuses(
        &table[..table.len() - 1],
        "all.csv",
        "its last line is torn",
    );
    refuses("a,b\n1,2\n", "all.csv", "not the table of a survey");
    refuses(&table, "a.csv", "is an input and would be overwritten");
    let two = place.survey(&["models", "models", "-o", "all.csv"]);
    assert_eq!(two.status.code(), Some(2));
}

#[test]
fn every_format_is_a_model() {
    let place = Place::new();
    let models = place.path("formats");
    std::fs::create_dir(&models).expect("a directory");
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    let node = "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n";
    for (name, text) in [
        ("a.obj", obj),
        ("points.node", node),
        ("rooms.poly", ROOMS),
        ("rooms.node", node),
    ] {
        std::fs::write(models.join(name), text).expect("a file");
    }
    let output = place.survey(&[
        "formats",
        "-o",
        "t.csv",
        "--methods=cavity",
        "--quiet",
        "--hull",
    ]);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(
        said,
        "note[skipped-files]: 1 file is no model and skipped: 1 .node of another file\n"
    );
    let rows = place.rows("t.csv");
    let outcomes: Vec<_> = rows.iter().map(|r| (&*r["file"], &*r["outcome"])).collect();
    assert_eq!(
        outcomes,
        [("a.obj", "ok"), ("points.node", "ok"), ("rooms.poly", "ok")]
    );
}

#[test]
fn what_is_no_table_or_no_longer_the_model_is_refused() {
    let place = Place::new();
    let refuses = |part: &str| {
        let before = std::fs::read(place.path("t.csv")).expect("a file");
        let output = place.survey(&["models", "-o", "t.csv"]);
        assert_eq!(output.status.code(), Some(2), "{output:?}");
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(said.contains(part), "{said}");
        let after = std::fs::read(place.path("t.csv")).expect("a file");
        assert_eq!(before, after);
    };
    std::fs::write(place.path("t.csv"), "a,b\n1,2").expect("a file");
    refuses("not the table of a survey");
    std::fs::write(place.path("t.csv"), "").expect("a file");
    place.surveys(&["models", "-o", "t.csv", "--methods=flip"]);
    let whole = std::fs::read_to_string(place.path("t.csv")).expect("the table");
    std::fs::write(place.path("t.csv"), format!("{whole}a,b\n{whole}")).expect("a file");
    refuses("line 8: not a row");
    std::fs::write(place.path("t.csv"), whole).expect("a file");
    std::fs::write(place.path("models/good/cube.OFF"), "OFF").expect("a file");
    refuses("good/cube.OFF has changed");
    let output = place.survey(&["nowhere", "-o", "u.csv"]);
    assert_eq!(output.status.code(), Some(2), "{output:?}");
    assert!(!place.path("u.csv").exists());
}

/// With a program in TetGen's place that is none.
#[test]
fn another_program_that_fails_is_an_outcome() {
    let place = Place::new();
    let arguments = ["models/good/cube.OFF", "-o", "t.csv", "--methods=cavity"];
    let arguments = [&arguments[..], &["--compare=tetgen", "--tetgen=./none"]].concat();
    place.surveys(&arguments);
    let outcomes: Vec<[String; 4]> = place
        .rows("t.csv")
        .iter()
        .map(|row| ["file", "insertion", "outcome", "kind"].map(|c| row[c].clone()))
        .collect();
    assert_eq!(
        outcomes,
        [
            ["cube.OFF", "cavity", "ok", ""],
            ["cube.OFF", "tetgen", "error", "NotStarted"],
            ["cube.OFF", "tetgen-flip", "error", "NotStarted"],
        ]
    );
}
