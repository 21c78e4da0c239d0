//! The rows of `failures.csv`.

use super::search::Case;
use serde::Serialize;

/// One failure. The README of the package has the meaning of the columns.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Row {
    pub input: String,
    pub papers: bool,
    pub family: &'static str,
    pub times: String,
    pub vertices: usize,
    pub polygons: usize,
    pub crossing_tets: usize,
    pub events: usize,
    pub outcome: &'static str,
    pub left: usize,
    pub class: &'static str,
    pub piece_tets: usize,
    pub piece_vertices: usize,
    pub exact_succeeds: bool,
    pub picture: String,
}

impl Row {
    /// The row of a case.
    pub fn new(case: &Case, papers: bool, picture: String) -> Row {
        let piece = case.pieces.first();
        let complex = case.cdt.complex();
        Row {
            input: case.member.to_string(),
            papers,
            family: case.member.family(),
            times: case.times_name(),
            vertices: complex.representative.len(),
            polygons: complex.polygons.len(),
            crossing_tets: case.insertion.before.len(),
            events: case.insertion.events.len(),
            outcome: case.outcome,
            left: case.left,
            class: piece.map_or("", |p| p.class.name()),
            piece_tets: piece.map_or(0, |p| p.tets.len()),
            piece_vertices: piece.map_or(0, |p| p.vertices),
            exact_succeeds: case.exact_succeeds,
            picture,
        }
    }

    /// For messages.
    pub fn name(&self) -> String {
        format!("{}, {}", self.input, self.times)
    }
}

/// The rows for people.
pub fn table(rows: &[Row]) -> String {
    let mut text = format!(
        "{:<28} {:<5} {:>8} {:>8} {:>5} {:<22} replayed by\n",
        "input", "times", "vertices", "crossing", "left", "class"
    );
    for r in rows {
        text += &format!(
            "{:<28} {:<5} {:>8} {:>8} {:>5} {:<22} replay {} --times {}\n",
            r.input, r.times, r.vertices, r.crossing_tets, r.left, r.class, r.input, r.times
        );
    }
    text
}
