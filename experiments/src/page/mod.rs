//! `report.html`: the results, beside the paper's, on one page that needs nothing else: no network, no other file.
//!
//! It has every table and plot of a directory of results (`contents`), what the README of this package says of them
//! (`guide`), the paper's numbers (`beside`, `claims`), and a viewer in which one can step through insertions flip by
//! flip, in exact order and with rounded times side by side (`scenes`). The page is a function of the files and of
//! these sources: the same results give the same bytes. What is missing is named on the page.

mod beside;
mod claims;
mod contents;
mod figures;
mod files;
mod film;
mod guide;
mod html;
mod picture;
mod scenes;
mod section;
mod table;

use crate::frame::record::RecordError;
use contents::sections;
use files::Files;
use guide::Guide;
use html::{escape, script_json};
use section::absent;
use std::path::{Path, PathBuf};

/// The page's own style and programs, and the library of the viewer; `viewer/README.md` tells where that is from.
const STYLE: &str = include_str!("assets/page.css");
const LIBRARY: &str = include_str!("viewer/ogl.min.js");
const PROGRAMS: [&str; 6] = [
    include_str!("assets/tables.js"),
    include_str!("viewer/film.js"),
    include_str!("viewer/stage.js"),
    include_str!("viewer/tell.js"),
    include_str!("viewer/viewer.js"),
    include_str!("viewer/selftest.js"),
];
const VIEWER: &str = include_str!("viewer/viewer.html");

/// Writes the page of a directory of results, `report.html` in it unless told otherwise, and returns its path.
///
/// # Errors
/// If there is no such directory, or if the page cannot be written.
pub fn write(directory: &Path, output: Option<PathBuf>) -> Result<PathBuf, RecordError> {
    let output = output.unwrap_or_else(|| directory.join("report.html"));
    std::fs::read_dir(directory)
        .map_err(|source| io_error(directory, source))
        .and_then(|_| {
            std::fs::write(&output, page(directory)).map_err(|source| io_error(&output, source))
        })?;
    Ok(output)
}

fn io_error(path: &Path, source: std::io::Error) -> RecordError {
    RecordError::Io {
        path: path.to_path_buf(),
        source,
    }
}

/// The page of a directory of results.
pub fn page(directory: &Path) -> String {
    let (files, guide) = (Files::of(directory), Guide::of_package());
    let paper = paper_section(&files);
    let contents = sections();
    let sections = contents.iter().map(|s| section::html(s, &files, &guide));
    let sections: Vec<String> = sections.collect();
    let runs = section::runs(&files, &guide);
    let others = section::others(&files, &guide);
    let scenes = serde_json::to_string(&scenes::all()).expect("numbers and names");
    let link = |s: &contents::Section| format!("<a href=\"#{}\">{}</a>\n", s.stem, escape(s.title));
    let links: String = contents.iter().map(link).collect();
    let missing = quick(&files) + &missing(&files);
    let programs = PROGRAMS.join("\n");
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; \
         script-src 'unsafe-inline'; img-src data:\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"color-scheme\" content=\"light dark\">\n\
         <link rel=\"icon\" href=\"data:,\">\n\
         <title>tetflip: results of the experiments</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n\
         <header>\n<h1>tetflip: results of the experiments</h1>\n\
         <p class=\"lead\">Constrained Delaunay tetrahedralizations by exact flips and by cavity retriangulation, \
         after Si and Shewchuk, “Incrementally constructing and updating constrained Delaunay tetrahedralizations \
         with finite-precision coordinates” (“the paper”).</p>\n{}</header>\n\
         <nav aria-label=\"Contents\">\n<a href=\"#paper\">The paper and these results</a>\n<a \
         href=\"#viewer\">Flips, step by step</a>\n{links}\
         <a href=\"#runs\">Runs</a>\n</nav>\n<main>\n{missing}{paper}{VIEWER}{}{others}{runs}</main>\n\
         <script type=\"application/json\" id=\"scenes\">{}</script>\n<script>\n{LIBRARY}</script>\n\
         <script>\n(() => {{\n\"use strict\";\n{programs}\n}})();\n</script>\n</body>\n</html>\n",
        machine(&files),
        sections.concat(),
        script_json(&scenes),
    )
}

/// The machine, as `MACHINE.txt` has it.
fn machine(files: &Files) -> String {
    let text = match files.text("MACHINE.txt") {
        Ok(text) => text,
        Err(missing) => return absent(&missing),
    };
    let pairs = text.lines().filter_map(|line| line.split_once(": "));
    let pairs = pairs.map(|(key, value)| {
        format!(
            "<div><dt>{}</dt><dd>{}</dd></div>",
            escape(key),
            escape(value)
        )
    });
    format!("<dl class=\"machine\">{}</dl>\n", pairs.collect::<String>())
}

/// The paper's numbers, and ours where they can be put beside them.
fn paper_section(files: &Files) -> String {
    format!(
        "<section id=\"paper\">\n<h2>The paper and these results</h2>\n\
         <p>Its machine was a laptop with a 2.8 GHz Intel processor and 4 GB of memory, its programs were compiled by \
         g++ 4.4 with -O3. Seconds of two machines cannot be compared; ratios can.</p>\n{}<p class=\"caption\">The \
         paper’s <strong>Table 1</strong>, statistics for CDT construction by TetGen 1.5.0 on models of the INRIA \
         GAMMA repository, and <span class=\"ours\">beside it, in colour, these results</span>: \
         <code>table1.csv</code>, the same model where it was at hand, else one of its kind and size, with flips and \
         cavities of this library.</p>\n{}{}</section>\n",
        claims::html(files),
        beside::table_1(files.table("table1").ok().as_ref()),
        beside::table_2(
            "The paper’s <strong>Table 2</strong>: proportion of the time of polygon insertion."
        ),
    )
}

/// Says that times mean little, if some are of the quick form.
fn quick(files: &Files) -> String {
    let ledger = files.table("RUNS").ok();
    let is_quick = ledger.is_some_and(|t| {
        t.all()
            .any(|row| row.text("form").is_ok_and(|f| f == "quick"))
    });
    if !is_quick {
        return String::new();
    }
    absent(
        "Some of these results are of the quick form, whose times and ratios of times mean little",
    )
}

fn missing(files: &Files) -> String {
    let missing = files.missing();
    if missing.is_empty() {
        return String::new();
    }
    absent(&format!("Not in these results: {}", missing.join(", ")))
}
