//! The table of `updates.csv`: polygons deleted and inserted again.

use super::Builder;
use super::number::ratio;
use super::table::of_sheet;
use crate::frame::sheet::{PaperError, Sheet};

const COLUMNS: [(&str, &str); 12] = [
    ("model", "input"),
    ("updated", "polygons"),
    ("crossing_tets", "crossing"),
    ("insertion_flips", "flips in"),
    ("deletion_flips", "flips out"),
    ("delete_seconds", "deletion"),
    ("cavity_seconds", "cavity"),
    ("flip_seconds", "flips"),
    ("build_seconds", "anew"),
    (
        "delete_over_flips",
        "$\\frac{\\text{deletion}}{\\text{flips}}$",
    ),
    ("refused", "refused"),
    ("same", "same"),
];

/// The table, and how much longer deletions take than insertions where nothing but the polygon is there.
pub fn table(builder: &mut Builder, sheet: &Sheet) -> Result<String, PaperError> {
    let mut ratios = Vec::new();
    for row in sheet.rows(&[("source", "scene")])? {
        ratios.extend(row.optional("delete_over_flips")?);
    }
    let source = "updates.csv: source=scene; delete_over_flips";
    builder
        .macros
        .range("UpdatesDeletionOverFlips", &ratios, ratio, source)?;
    of_sheet(sheet, &COLUMNS, false)
}
