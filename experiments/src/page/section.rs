//! The sections of the page: what is said of an experiment, how it ended, its plots, its tables.

use super::contents::{How, Part, SHOWN_ELSEWHERE, Section, sections};
use super::figures;
use super::files::Files;
use super::guide::Guide;
use super::html::{escape, inline};
use super::table::{self, Table};
use crate::frame::query::Rows;
use crate::registry::ALL;
use std::fmt::Write;

/// One section, in HTML.
pub fn html(section: &Section, files: &Files, guide: &Guide) -> String {
    let stem = section.stem;
    let mut html = format!(
        "<section id=\"{stem}\">\n<h2>{}</h2>\n",
        escape(section.title)
    );
    for (word, class) in [
        ("Question.", "question"),
        ("Inputs.", "inputs"),
        ("Expected", "expected"),
    ] {
        if let Some(text) = guide.paragraph(stem, word) {
            let label = word.trim_end_matches('.');
            let _ = writeln!(
                html,
                "<p class=\"{class}\"><b>{label}</b> <span>{}</span></p>",
                inline(text)
            );
        }
    }
    if guide.paragraph(stem, "Question.").is_none()
        && let Some(e) = ALL.map(|e| e.about()).iter().find(|e| e.name == stem)
    {
        let question = escape(e.question);
        let _ = writeln!(
            html,
            "<p class=\"question\"><b>Question</b> <span>{question}</span></p>"
        );
    }
    html += &outcome(stem, files);
    let (mut figures, mut tables) = (String::new(), String::new());
    for Part { how, name, caption } in &section.parts {
        match how {
            How::Figure => match figures::plot(files, name, caption) {
                Ok(figure) => figures += &figure,
                Err(missing) => tables += &absent(&missing),
            },
            How::Pictures => {
                let html = figures::pictures(files, name, caption);
                tables += &html.unwrap_or_else(|missing| absent(&missing));
            }
            How::Pivot(pivot) => {
                let table = files.table(name);
                let html =
                    table.and_then(|t| table::pivot(&t, caption, pivot).map_err(|e| e.to_string()));
                tables += &html.unwrap_or_else(|missing| absent(&missing));
            }
            How::Table => tables += &table(files, guide, stem, name, caption),
            How::Rows(only) => tables += &rows(files, guide, stem, (name, caption), only),
        }
    }
    for name in unnamed(files, Some(stem)) {
        match name.rsplit_once('.') {
            Some((name, "svg")) => match figures::plot(files, name, "") {
                Ok(figure) => figures += &figure,
                Err(missing) => tables += &absent(&missing),
            },
            Some((name, _)) => tables += &rows(files, guide, stem, (name, "More rows."), ""),
            None => {}
        }
    }
    if !figures.is_empty() {
        let _ = writeln!(html, "<div class=\"figures\">\n{figures}</div>");
    }
    html + &tables + "</section>\n"
}

/// How the experiment ended, by `RUNS.csv`.
fn outcome(stem: &str, files: &Files) -> String {
    if !ALL.iter().any(|e| e.about().name == stem) {
        return String::new();
    }
    let ledger = match files.table("RUNS") {
        Ok(ledger) => ledger,
        Err(missing) => {
            return absent(&format!(
                "{missing}: how this experiment ended is not known"
            ));
        }
    };
    let entry = Rows::all(&ledger).only(&format!("experiment={stem}")).ok();
    let of = |column| {
        entry
            .as_ref()
            .and_then(|e| e.text(column).ok())
            .unwrap_or("")
    };
    let text = match of("outcome") {
        "ok" => "every expectation holds",
        "broken" => "an expectation does not hold",
        "failed" => "it could not be completed",
        _ => return absent("RUNS.csv has no entry of this experiment"),
    };
    let class = if of("outcome") == "ok" { "good" } else { "bad" };
    format!(
        "<p class=\"outcome\"><b>Outcome</b> <span><span class=\"{class}\">{text}</span> ({} form, {} s, commit \
         <code>{}</code>).</span></p>\n",
        escape(of("form")),
        escape(of("seconds")),
        escape(of("commit").get(..12).unwrap_or(of("commit")))
    )
}

fn table(files: &Files, guide: &Guide, stem: &str, name: &str, caption: &str) -> String {
    match files.table(name) {
        Ok(sheet) => {
            let caption = format!("{} {}", escape(caption), link(name));
            Table::html(&sheet, guide, stem, name, &caption)
        }
        Err(missing) => absent(&missing),
    }
}

/// All rows, or those that keep a condition, folded away.
fn rows(
    files: &Files,
    guide: &Guide,
    stem: &str,
    (name, caption): (&str, &str),
    only: &str,
) -> String {
    let mut sheet = match files.table(name) {
        Ok(sheet) => sheet,
        Err(missing) => return absent(&missing),
    };
    let all = sheet.cells.len();
    if let Ok(kept) = Rows::all(&sheet).only(only) {
        let places = kept.rows.iter().map(|row| row.line() - 2);
        sheet.cells = places.map(|i| sheet.cells[i].clone()).collect();
    }
    let shown = match sheet.cells.len() {
        n if n == all => format!("{all} rows"),
        n => format!("{n} of {all} rows"),
    };
    let (caption, table) = (escape(caption), Table::html(&sheet, guide, stem, name, ""));
    format!(
        "<details><summary>{caption} {}, {shown}</summary>\n{table}</details>\n",
        link(name)
    )
}

/// The file itself, beside the page.
fn link(name: &str) -> String {
    format!("<a href=\"{name}.csv\"><code>{name}.csv</code></a>")
}

/// The ledger, with the questions.
pub fn runs(files: &Files, guide: &Guide) -> String {
    let questions: String = ALL
        .iter()
        .map(|e| {
            let e = e.about();
            format!(
                "<div><dt>{}</dt><dd>{}</dd></div>",
                e.name,
                escape(e.question)
            )
        })
        .collect();
    format!(
        "<section id=\"runs\">\n<h2>Runs</h2>\n<dl class=\"machine\">{questions}</dl>\n{}</section>\n",
        table(
            files,
            guide,
            "runs",
            "RUNS",
            "Which experiment was run, at which commit, and how it ended."
        )
    )
}

/// Files that belong to no section.
pub fn others(files: &Files, guide: &Guide) -> String {
    let mut html = String::new();
    for name in unnamed(files, None) {
        html += &match name.rsplit_once('.') {
            Some((stem, "svg")) => figures::plot(files, stem, "").unwrap_or_else(|e| absent(&e)),
            Some((stem, _)) => table(files, guide, stem, stem, ""),
            None => String::new(),
        };
    }
    if html.is_empty() {
        return html;
    }
    format!("<section id=\"others\">\n<h2>Other files</h2>\n{html}</section>\n")
}

/// Files that no section names, but whose names begin with the stem of this section and a hyphen, or with none's.
fn unnamed(files: &Files, stem: Option<&str>) -> Vec<String> {
    let sections = sections();
    let parts = sections.iter().flat_map(|s| &s.parts);
    let known: Vec<String> = parts.map(Part::file).collect();
    let belongs = |name: &String, stem: &str| {
        let rest = name.strip_prefix(stem);
        rest.is_some_and(|r| r.starts_with('-'))
    };
    let stem_of = |name: &String| {
        sections
            .iter()
            .map(|s| s.stem)
            .find(|stem| belongs(name, stem))
    };
    let mut names = files.present();
    names.retain(|n| {
        !known.contains(n) && !SHOWN_ELSEWHERE.contains(&n.as_str()) && stem_of(n) == stem
    });
    names
}

/// Says that something is missing.
pub fn absent(what: &str) -> String {
    format!("<p class=\"missing\">{}.</p>\n", escape(what))
}
