//! What a survey says in the end: how often each method came to which outcome, and what needs to be looked at.

use super::table::Row;
use std::collections::BTreeMap;
use std::fmt::Write;

/// All outcomes, in the order of the summary.
const OUTCOMES: [&str; 11] = [
    "ok",
    "refused",
    "gave up",
    "timeout",
    "memory",
    "crash",
    "error",
    "open",
    "invalid",
    "degenerate",
    "unreadable",
];
/// Those that show that there cannot be a mesh.
const NO_MODEL: [&str; 4] = ["open", "invalid", "degenerate", "unreadable"];

/// The text, with a line break at its end.
pub(super) fn summary(rows: &[Row]) -> String {
    let mut text = outcomes(rows);
    let models = by_model(rows);
    let of = |choose: for<'a> fn(&[&'a Row]) -> Vec<&'a Row>| -> Vec<&Row> {
        models.values().flat_map(|rows| choose(rows)).collect()
    };
    section(
        &mut text,
        "failures on valid input",
        of(|rows| {
            if is_valid(rows) {
                failures(rows)
            } else {
                Vec::new()
            }
        }),
    );
    section(
        &mut text,
        "failures on input that nothing shows to be invalid",
        of(|rows| {
            if is_valid(rows) {
                Vec::new()
            } else {
                failures(rows)
            }
        }),
    );
    section(
        &mut text,
        "statements that the input is wrong, where another method says or shows that it is not",
        of(contradictions),
    );
    let other = rows.iter().filter(|row| row.get("equal") == "no");
    section(
        &mut text,
        "other tetrahedra than the first method's",
        other.collect(),
    );
    text
}

fn by_model(rows: &[Row]) -> BTreeMap<&str, Vec<&Row>> {
    let mut models: BTreeMap<&str, Vec<&Row>> = BTreeMap::new();
    for row in rows {
        models.entry(row.get("file")).or_default().push(row);
    }
    models
}

/// A table: methods by outcomes.
fn outcomes(rows: &[Row]) -> String {
    let mut methods: Vec<String> = Vec::new();
    let mut counts: Vec<BTreeMap<&str, usize>> = Vec::new();
    let mut seconds: Vec<f64> = Vec::new();
    for row in rows {
        let method = row.method();
        let at = methods.iter().position(|m| *m == method);
        let at = at.unwrap_or_else(|| {
            methods.push(method);
            counts.push(BTreeMap::new());
            seconds.push(0.0);
            methods.len() - 1
        });
        for column in ["outcome", "verified"] {
            *counts[at].entry(row.get(column)).or_default() += 1;
        }
        seconds[at] += row.get("seconds_mesh").parse::<f64>().unwrap_or(0.0);
    }
    let mut header = vec!["method".to_owned(), "models".to_owned()];
    let occurring = |o: &&&str| counts.iter().any(|c| c.contains_key(**o));
    let shown: Vec<&str> = OUTCOMES.iter().filter(occurring).copied().collect();
    header.extend(shown.iter().map(ToString::to_string));
    header.extend(["verified".to_owned(), "seconds".to_owned()]);
    let mut table = vec![header];
    for (i, method) in methods.into_iter().enumerate() {
        let count = |word: &str| counts[i].get(word).copied().unwrap_or(0);
        let all: usize = OUTCOMES.iter().map(|o| count(o)).sum();
        let mut line = vec![method, all.to_string()];
        line.extend(shown.iter().map(|o| count(o).to_string()));
        line.push((count("yes") + count("merged")).to_string());
        line.push(format!("{:.1}", seconds[i]));
        table.push(line);
    }
    aligned(&table)
}

/// The first column to the left, numbers to the right.
fn aligned(table: &[Vec<String>]) -> String {
    let width = |column: usize| table.iter().map(|line| line[column].len()).max();
    let mut text = String::new();
    for line in table {
        for (column, word) in line.iter().enumerate() {
            let width = width(column).unwrap_or(0);
            let written = match column {
                0 => write!(text, "{word:<width$}"),
                _ => write!(text, "  {word:>width$}"),
            };
            written.expect("a string");
        }
        text.push('\n');
    }
    text
}

/// Whether the check of the input found nothing.
fn is_valid(rows: &[&Row]) -> bool {
    let check = rows.iter().find(|row| row.get("insertion") == "check");
    check.is_some_and(|row| row.get("outcome") == "ok")
}

/// Whether one of our runs says that there can be no mesh.
fn denies(row: &&&Row) -> bool {
    row.is_ours() && NO_MODEL.contains(&row.get("outcome"))
}

/// Our failures that are no statement about the input, unless another run made one.
fn failures<'a>(rows: &[&'a Row]) -> Vec<&'a Row> {
    if rows.iter().any(|row| denies(&row)) {
        return Vec::new();
    }
    let failed = |row: &&Row| row.is_ours() && row.get("outcome") != "ok";
    rows.iter().copied().filter(failed).collect()
}

/// Our statements that there is no mesh, where there is one, or where the check found nothing that would be in its way.
fn contradictions<'a>(rows: &[&'a Row]) -> Vec<&'a Row> {
    let made = rows.iter().any(|row| row.get("verified") == "yes");
    let valid = is_valid(rows);
    let denials = rows.iter().filter(denies).copied();
    denials
        .filter(|row| made || (valid && row.get("outcome") == "invalid"))
        .collect()
}

fn section(text: &mut String, heading: &str, rows: Vec<&Row>) {
    if rows.is_empty() {
        return;
    }
    *text += &format!("\n{heading}:\n");
    for row in rows {
        let [file, outcome, kind, message] =
            ["file", "outcome", "kind", "message"].map(|c| row.get(c));
        let space = if kind.is_empty() { "" } else { " " };
        *text += &format!(
            "  {file}  {}  {outcome}{space}{kind}  {message}\n",
            row.method()
        );
    }
}
