//! Numbers of `exactness_cost-summary.csv` and `exactness_cost-targets.csv`.

use super::Builder;
use super::number::{percent, ratio, significant, whole};
use super::table::{Table, escaped};
use crate::frame::sheet::{PaperError, Row, Sheet};
use std::path::Path;

/// Adds them.
pub fn add(builder: &mut Builder, results: &Path) -> Result<(), PaperError> {
    let summary = Sheet::read(results, "exactness_cost-summary")?;
    let targets = Sheet::read(results, "exactness_cost-targets")?;
    let table = table(&summary)?;
    builder.file("cost-table.tex", table);
    ranges(builder, &summary)?;
    let m = &mut builder.macros;
    let all = targets.all().count();
    let reached = targets.rows(&[("reached", "true")])?.len();
    m.whole(
        "CostTargets",
        all as f64,
        "exactness_cost-targets.csv: rows",
    );
    m.whole(
        "CostTargetsReached",
        reached as f64,
        "exactness_cost-targets.csv: rows with reached=true",
    );
    Ok(())
}

/// The size classes of an input, in order of size.
fn sizes<'a>(summary: &'a Sheet, input: &str) -> Result<Vec<&'a str>, PaperError> {
    let mut sizes: Vec<&str> = Vec::new();
    for row in summary.rows(&[("input", input)])? {
        let about = row.text("about")?;
        if !sizes.contains(&about) {
            sizes.push(about);
        }
    }
    Ok(sizes)
}

/// The smallest and the largest size of each input.
fn table(summary: &Sheet) -> Result<String, PaperError> {
    let heads = [
        "input",
        "size",
        "\\fsixtyfour{} ok",
        "\\fsixtyfour",
        "filtered",
        "cavity",
        "$\\frac{\\text{filtered}}{\\text{\\fsixtyfour}}$",
        "$\\frac{\\text{filtered}}{\\text{cavity}}$",
        "floats",
        "quotients",
        "perturbation",
    ];
    let mut table = Table::new("@{}lrrrrrrrrrr@{}", &heads);
    for input in summary.values("input")? {
        let sizes = sizes(summary, input)?;
        for about in [sizes[0], sizes[sizes.len() - 1]] {
            let row =
                |method| summary.row(&[("input", input), ("about", about), ("method", method)]);
            let (float, filtered, cavity) =
                (row("flip f64")?, row("flip filtered")?, row("cavity")?);
            let ms =
                |row: &Row| Ok::<_, PaperError>(significant(row.number("median_milliseconds")?, 2));
            let part = |column| Ok::<_, PaperError>(percent(filtered.number(column)?));
            table.row(&[
                escaped(input),
                whole(filtered.number("about")?),
                format!("{} of {}", float.text("succeeded")?, float.text("inputs")?),
                ms(&float)?,
                ms(&filtered)?,
                ms(&cavity)?,
                ratio(filtered.number("ratio_to_f64")?),
                ratio(filtered.number("ratio_to_cavity")?),
                part("by_floats")?,
                part("by_exact_quotients")?,
                part("by_perturbation")?,
            ]);
        }
    }
    let source = "exactness_cost-summary.csv: smallest and largest `about`; succeeded, median_milliseconds, ratio_to_f64, \
        ratio_to_cavity, by_floats, by_exact_quotients, by_perturbation in percent";
    Ok(table.into_text(source))
}

fn ranges(builder: &mut Builder, summary: &Sheet) -> Result<(), PaperError> {
    let kinds = [
        ("Slab", "slab"),
        ("Lattice", "lattice/"),
        ("Tenths", "tenths/"),
        ("Sphere", "sphere"),
    ];
    for (name, prefix) in kinds {
        let of = |method: &str, column: &str| {
            let mut values = Vec::new();
            for row in summary.rows(&[("method", method)])? {
                if row.text("input")?.starts_with(prefix) {
                    values.extend(row.optional(column)?);
                }
            }
            Ok::<_, PaperError>(values)
        };
        let source = |method: &str, column: &str| {
            format!("exactness_cost-summary.csv: input={prefix}*, method={method}; {column}")
        };
        let m = &mut builder.macros;
        let mut range = |what: &str, method, column, print| {
            let values = of(method, column)?;
            m.range(
                &format!("Cost{name}{what}"),
                &values,
                print,
                &source(method, column),
            )?;
            Ok::<_, PaperError>(())
        };
        range(
            "FilteredOverFloats",
            "flip filtered",
            "ratio_to_f64",
            ratio as fn(f64) -> String,
        )?;
        range(
            "FilteredOverCavity",
            "flip filtered",
            "ratio_to_cavity",
            ratio,
        )?;
        range("Ties", "flip filtered", "by_perturbation", percent)?;
        range("ByFloats", "flip filtered", "by_floats", percent)?;
    }
    let wraps: Result<Vec<f64>, _> = summary
        .rows(&[("method", "gift-wrap")])?
        .iter()
        .map(|r| r.number("ratio_to_cavity"))
        .collect();
    builder.macros.range(
        "CostWrapOverCavity",
        &wraps?,
        ratio,
        "exactness_cost-summary.csv: method=gift-wrap; ratio_to_cavity",
    )?;
    let mut rational = Vec::new();
    for row in summary.rows(&[("method", "flip rational")])? {
        rational.push(row.number("ratio_to_f64")?);
    }
    if !rational.is_empty() {
        builder.macros.range(
            "CostRationalOverFloats",
            &rational,
            ratio,
            "exactness_cost-summary.csv: method=flip rational; ratio_to_f64",
        )?;
    }
    let mut fast = Vec::new();
    for row in summary.rows(&[("input", "sphere"), ("method", "flip filtered")])? {
        let ratio = row.number("ratio_to_cavity")?;
        if ratio < 3.0 {
            fast.push(format!(
                "exactness_cost-summary.csv: sphere; ratio_to_cavity {ratio}"
            ));
        }
    }
    builder.claim(
        "on cospherical points cavities are much faster (abstract, conclusion)",
        fast,
    );
    let mut failed = Vec::new();
    for method in ["flip filtered", "flip exact", "cavity", "gift-wrap"] {
        for row in summary.rows(&[("method", method)])? {
            if row.text("inputs")? != row.text("succeeded")? {
                failed.push(format!(
                    "exactness_cost-summary.csv: {} {} {method}",
                    row.text("input")?,
                    row.text("about")?
                ));
            }
        }
    }
    builder.claim("exact methods succeed on degenerate vertices", failed);
    Ok(())
}
