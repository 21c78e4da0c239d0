//! Who may know whom. A room is a directory or a file of `src`, or of a room with rooms of its own; it may use those
//! that stand before it in its list, and no other. ARCHITECTURE.md draws the same picture.

use std::fs;
use std::path::{Path, PathBuf};

/// The rooms of the crate, lowest first.
const ROOMS: &str = "machine threads clock number mesh exchange predicate kinetic delaunay plc error recover update \
                     report check repair cdt format generate verify lab cli lib main";

/// Rooms with rooms of their own, lowest first.
const INNER: [(&str, &str); 2] = [
    (
        "recover",
        "tables subpolygons region retriangulate flips method segments flatten domain output workspace polygons",
    ),
    (
        "verify",
        "place options violation verdict signs lookup input case claims notes",
    ),
];

/// Rooms that may use some of those before them only: the mesh knows no numbers, and the verifier shares next to
/// nothing with what it verifies.
const ONLY: [(&str, &str); 3] = [
    ("number", "machine"),
    ("mesh", "machine threads"),
    ("verify", "machine threads number mesh predicate exchange"),
];

#[test]
fn no_room_uses_one_above_it() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut wrong = Vec::new();
    for file in files(&source) {
        let module = module_of(file.strip_prefix(&source).expect("below src"));
        let text = fs::read_to_string(&file).expect("a source file");
        let code = text
            .split("#[cfg(test)]\nmod tests")
            .next()
            .unwrap_or_default();
        for used in paths(code, &module) {
            if !allowed(&module, &used) {
                wrong.push(format!("{} uses {}", module.join("::"), used.join("::")));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

fn allowed(module: &[String], used: &[String]) -> bool {
    let (Some(from), Some(to)) = (module.first(), used.first()) else {
        return true;
    };
    // Modules inside a file are not followed: what they call `super` is the file.
    if from != to && !to.starts_with(char::is_uppercase) {
        let only = ONLY.iter().find(|(room, _)| room == from);
        return before(ROOMS, to, from)
            && only.is_none_or(|(_, few)| few.split(' ').any(|room| room == to));
    }
    let inner = INNER.iter().find(|(room, _)| room == from);
    let (Some((_, rooms)), Some(from), Some(to)) = (inner, module.get(1), used.get(1)) else {
        return true;
    };
    // What begins with a capital is an item of the outer room.
    from == to || !rooms.split(' ').any(|room| room == to) || before(rooms, to, from)
}

/// Whether the first room is known and stands before the second.
fn before(rooms: &str, first: &str, second: &str) -> bool {
    let place = |name: &str| rooms.split_whitespace().position(|room| room == name);
    place(first).is_some_and(|first| place(second).is_some_and(|second| first < second))
}

/// What the code uses: its paths that begin with `crate` or `super`, those in braces one by one, as modules and items.
fn paths(code: &str, module: &[String]) -> Vec<Vec<String>> {
    let lines = code
        .lines()
        .filter(|line| !line.trim_start().starts_with("//"));
    let code: Vec<&str> = lines.collect();
    let mut paths = Vec::new();
    for piece in code.join("\n").split([
        ';', '(', ')', '<', '>', '&', '[', ']', '=', '|', '!', '?', '-', '#',
    ]) {
        let first = ["crate::", "super::"]
            .iter()
            .filter_map(|start| piece.find(start))
            .min();
        if let Some(at) = first {
            expand(&piece[at..], Vec::new(), &mut paths);
        }
    }
    let begins_here =
        |path: &Vec<String>| matches!(path.first().map(String::as_str), Some("crate" | "super"));
    paths.retain(begins_here);
    paths.iter().map(|path| absolute(path, module)).collect()
}

/// `a::{b, c::{d, e}}` as `a::b`, `a::c::d`, `a::c::e`; returns what follows.
fn expand<'a>(mut rest: &'a str, before: Vec<String>, paths: &mut Vec<Vec<String>>) -> &'a str {
    let mut path = before.clone();
    loop {
        rest = rest.trim_start();
        let end = rest
            .find(|c: char| !(c.is_alphanumeric() || c == '_'))
            .unwrap_or(rest.len());
        let (name, after) = rest.split_at(end);
        path.extend((!name.is_empty()).then(|| name.to_owned()));
        rest = after;
        if let Some(after) = rest.strip_prefix("::") {
            rest = after;
        } else if let Some(after) = rest.strip_prefix('{') {
            rest = after;
            while !rest.is_empty() && !rest.starts_with('}') {
                rest = expand(rest, path.clone(), paths).trim_start();
                rest = rest.strip_prefix(',').unwrap_or(rest).trim_start();
            }
            return rest.strip_prefix('}').unwrap_or(rest);
        } else {
            paths.push(path);
            let end = rest.find([',', '}']).unwrap_or(rest.len());
            return &rest[end..];
        }
    }
}

fn absolute(path: &[String], module: &[String]) -> Vec<String> {
    let mut absolute = if path[0] == "crate" {
        Vec::new()
    } else {
        module.to_vec()
    };
    for name in path {
        match &name[..] {
            "crate" => {}
            "super" => drop(absolute.pop()),
            name => absolute.push(name.to_owned()),
        }
    }
    absolute
}

#[test]
fn paths_in_braces_are_found() {
    let module = ["recover", "flips", "run"].map(str::to_owned);
    let found = paths(
        "use super::{a::{b, C}, super::d};\nfn f() -> crate::e::F {}\n// super::g",
        &module,
    );
    let found: Vec<String> = found.iter().map(|path| path.join("::")).collect();
    assert_eq!(
        found,
        [
            "recover::flips::a::b",
            "recover::flips::a::C",
            "recover::d",
            "e::F"
        ]
    );
}

fn files(directory: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(directory).expect("a directory of sources");
    // Tests in files of their own may use what they like.
    let is_test = |path: &PathBuf| path.to_string_lossy().ends_with("tests.rs");
    let paths = entries
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| !is_test(path));
    paths
        .flat_map(|path| {
            if path.is_dir() {
                files(&path)
            } else {
                vec![path]
            }
        })
        .collect()
}

/// `recover/flips/mod.rs` is recover::flips, `recover/flips/run.rs` is recover::flips::run.
fn module_of(path: &Path) -> Vec<String> {
    let names = path.with_extension("");
    let names = names.iter().map(|name| name.to_string_lossy().into_owned());
    names.filter(|name| name != "mod").collect()
}
