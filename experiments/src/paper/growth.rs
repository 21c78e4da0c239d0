//! Numbers of `growth.csv` and `growth-summary.csv`.

use super::Builder;
use super::number::{percent, ratio, significant, whole};
use crate::frame::sheet::{PaperError, Sheet};
use std::path::Path;

const METHODS: [(&str, &str, &str); 2] = [
    ("Filtered", "flip filtered", "growth-flips.dat"),
    ("Cavity", "cavity", "growth-cavity.dat"),
];

/// Adds them.
pub fn add(builder: &mut Builder, results: &Path) -> Result<(), PaperError> {
    let sheet = Sheet::read(results, "growth")?;
    let summary = Sheet::read(results, "growth-summary")?;
    let mut broken = Vec::new();
    for (name, method, file) in METHODS {
        let rows = sheet.rows(&[("method", method)])?;
        let mut text = format!(
            "% growth.csv: method={method}; crossing_tets, median_seconds, microseconds_per_tet\nn s us\n"
        );
        let (mut per_tet, mut sizes) = (Vec::new(), Vec::new());
        for row in &rows {
            let (n, us) = (
                row.number("crossing_tets")?,
                row.number("microseconds_per_tet")?,
            );
            text += &format!("{n} {:.4e} {us:.3}\n", row.number("median_seconds")?);
            per_tet.push(us);
            sizes.push(n);
            if row.text("outcome")? != "ok" || row.text("agrees")? != "true" {
                broken.push(format!("growth.csv: {method} at {n}"));
            }
        }
        builder.file(file, text);
        let m = &mut builder.macros;
        m.range(
            &format!("Growth{name}PerTet"),
            &per_tet,
            |x| significant(x, 2),
            &format!("growth.csv: method={method}; microseconds_per_tet"),
        )?;
        let fit = summary.rows(&[("method", method)])?;
        // The first row of a method is the fit through all sizes.
        let fit = match fit.first() {
            Some(row) => *row,
            None => summary.row(&[("method", method)])?,
        };
        m.ratio(
            &format!("GrowthExponent{name}"),
            fit.number("exponent")?,
            &format!("growth-summary.csv: method={method}, all sizes; exponent"),
        );
        m.ratio(
            &format!("GrowthWorst{name}"),
            fit.number("worst_factor")?,
            &format!("growth-summary.csv: method={method}, all sizes; worst_factor"),
        );
        if method == "cavity" {
            continue;
        }
        m.range(
            "GrowthCrossing",
            &sizes,
            whole,
            "growth.csv: flip filtered; crossing_tets",
        )?;
        let (mut comparisons, mut exact) = (Vec::new(), Vec::new());
        for row in &rows {
            let (n, c) = (row.number("crossing_tets")?, row.number("comparisons")?);
            comparisons.push(c / (n * n.log2()));
            exact.push(row.number("compared_exactly")? / c);
        }
        m.range(
            "GrowthComparisons",
            &comparisons,
            |x| significant(x, 2),
            "growth.csv: flip filtered; comparisons / (n log2 n), n = crossing_tets",
        )?;
        m.range(
            "GrowthComparedExactly",
            &exact,
            percent,
            "growth.csv: flip filtered; compared_exactly / comparisons, percent",
        )?;
        let (last, first) = (sizes.len() - 1, 0);
        m.ratio(
            "GrowthPerTetRatio",
            per_tet[last] / per_tet[first],
            "growth.csv: flip filtered; microseconds_per_tet, last / first",
        );
    }
    let at = |method: &str| {
        let rows = sheet.rows(&[("method", method)])?;
        rows.last().map_or(Ok(0.0), |r| r.number("median_seconds"))
    };
    let last = at("flip filtered")? / at("cavity")?;
    builder.macros.define(
        "GrowthLastFilteredOverCavity",
        &ratio(last),
        "growth.csv: last size; median_seconds, flip filtered / cavity",
    );
    builder.claim(
        "flips and cavities end in the same tetrahedra at every size",
        broken,
    );
    Ok(())
}
