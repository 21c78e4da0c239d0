//! Numbers of `fig9.csv` and `fig9-summary.csv`.

use super::Builder;
use super::number::{ratio, significant, whole};
use super::table::Table;
use crate::frame::sheet::{PaperError, Row, Sheet};
use std::path::Path;

const CAVITY: [&str; 2] = ["cavity", ""];
const F64: [&str; 2] = ["flip", "f64"];
const FILTERED: [&str; 2] = ["flip", "filtered"];
const EXACT: [&str; 2] = ["flip", "exact"];

/// The size classes by their lower bounds, and the method's row in each.
fn classes<'a>(sheet: &'a Sheet, method: [&str; 2]) -> Result<Vec<Row<'a>>, PaperError> {
    let mut rows = Vec::new();
    for from in sheet.values("crossing_from")? {
        let [insertion, times] = method;
        let key = [
            ("crossing_from", from),
            ("insertion", insertion),
            ("times", times),
        ];
        rows.push(sheet.row(&key)?);
    }
    Ok(rows)
}

fn numbers(rows: &[Row], column: &str) -> Result<Vec<f64>, PaperError> {
    rows.iter().map(|row| row.number(column)).collect()
}

/// Adds them.
pub fn add(builder: &mut Builder, results: &Path) -> Result<(), PaperError> {
    let summary = Sheet::read(results, "fig9-summary")?;
    let scenes = Sheet::read(results, "fig9")?;
    let table = table(&summary)?;
    builder.file("fig9-table.tex", table);
    ratios(builder, &summary)?;
    counts(builder, &scenes)?;
    for (name, [insertion, times]) in [
        ("cavity", CAVITY),
        ("f64", F64),
        ("filtered", FILTERED),
        ("exact", EXACT),
    ] {
        let mut text =
            format!("% fig9.csv: {insertion} {times}; crossing_tets, median_seconds in ms\nn ms\n");
        for row in scenes.rows(&[
            ("insertion", insertion),
            ("times", times),
            ("outcome", "ok"),
        ])? {
            let ms = row.number("median_seconds")? * 1e3;
            text += &format!("{} {ms:.4e}\n", row.text("crossing_tets")?);
        }
        builder.file(&format!("fig9-{name}.dat"), text);
    }
    Ok(())
}

fn table(summary: &Sheet) -> Result<String, PaperError> {
    let heads = [
        "crossing tetrahedra",
        "scenes",
        "cavity",
        "\\fsixtyfour",
        "filtered",
        "exact",
        "$\\frac{\\text{\\fsixtyfour}}{\\text{cavity}}$",
        "$\\frac{\\text{filtered}}{\\text{\\fsixtyfour}}$",
        "$\\frac{\\text{filtered}}{\\text{cavity}}$",
        "$\\frac{\\text{exact}}{\\text{filtered}}$",
    ];
    let mut table = Table::new("@{}lrrrrrrrrr@{}", &heads);
    let methods = [CAVITY, F64, FILTERED, EXACT];
    let [cavity, float, filtered, exact] = methods.map(|method| classes(summary, method));
    let (cavity, float, filtered, exact) = (cavity?, float?, filtered?, exact?);
    for i in 0..cavity.len() {
        let from = whole(cavity[i].number("crossing_from")?);
        let class = match cavity[i].optional("crossing_below")? {
            Some(below) => format!("{from} -- {}", whole(below - 1.0)),
            None => format!("{from} and more"),
        };
        let mut cells = vec![class, cavity[i].text("scenes")?.to_string()];
        for method in [&cavity, &float, &filtered, &exact] {
            cells.push(significant(method[i].number("median_milliseconds")?, 2));
        }
        cells.push(ratio(float[i].number("ratio_to_cavity")?));
        cells.push(ratio(filtered[i].number("ratio_to_f64")?));
        cells.push(ratio(filtered[i].number("ratio_to_cavity")?));
        cells.push(ratio(1.0 / filtered[i].number("ratio_to_exact")?));
        table.row(&cells);
    }
    Ok(table.into_text(
        "fig9-summary.csv: median_milliseconds, ratio_to_cavity, ratio_to_f64, 1/ratio_to_exact",
    ))
}

fn ratios(builder: &mut Builder, summary: &Sheet) -> Result<(), PaperError> {
    let (float, filtered) = (classes(summary, F64)?, classes(summary, FILTERED)?);
    let (cavity, exact) = (classes(summary, CAVITY)?, classes(summary, EXACT)?);
    let m = &mut builder.macros;
    let all = "all classes of fig9-summary.csv";
    let mut range = |name: &str, rows: &[Row], method: &str, column: &str| {
        let values = numbers(rows, column)?;
        m.range(name, &values, ratio, &format!("{all}: {method}; {column}"))?;
        Ok::<_, PaperError>(values)
    };
    range(
        "FigNineFilteredOverFloats",
        &filtered,
        "flip filtered",
        "ratio_to_f64",
    )?;
    range(
        "FigNineFilteredOverCavity",
        &filtered,
        "flip filtered",
        "ratio_to_cavity",
    )?;
    range(
        "FigNineFloatsOverCavity",
        &float,
        "flip f64",
        "ratio_to_cavity",
    )?;
    range(
        "FigNineExactOverCavity",
        &exact,
        "flip exact",
        "ratio_to_cavity",
    )?;
    range(
        "FigNineCavityPerTet",
        &cavity,
        "cavity",
        "median_microseconds_per_tet",
    )?;
    range(
        "FigNineFilteredPerTet",
        &filtered,
        "flip filtered",
        "median_microseconds_per_tet",
    )?;
    let over_filtered: Vec<f64> = numbers(&filtered, "ratio_to_exact")?;
    let over_filtered: Vec<f64> = over_filtered.iter().map(|r| 1.0 / r).collect();
    let source = format!("{all}: flip filtered; 1/ratio_to_exact");
    m.range("FigNineExactOverFiltered", &over_filtered, ratio, &source)?;
    for (name, at) in [("Small", 0), ("Large", filtered.len() - 1)] {
        let from = filtered[at].text("crossing_from")?;
        for (method, rows) in [("Filtered", &filtered), ("Floats", &float)] {
            let value = rows[at].number("ratio_to_cavity")?;
            let source =
                format!("fig9-summary.csv: crossing_from={from}, flip {method}; ratio_to_cavity");
            m.ratio(&format!("FigNineRatio{method}Cavity{name}"), value, &source);
        }
    }
    // The range of the right plot of the original's Fig. 9 is about this class.
    let key = [
        ("crossing_from", "1000"),
        ("insertion", "flip"),
        ("times", "f64"),
    ];
    let paper = summary.row(&key)?.number("ratio_to_cavity")?;
    m.ratio(
        "FigNineRatioFloatsCavityPaper",
        paper,
        "fig9-summary.csv: crossing_from=1000, flip f64; ratio_to_cavity",
    );
    // In the smallest class insertions take some tens of microseconds, whatever the times.
    let slow = numbers(&filtered[1..], "ratio_to_f64")?;
    let slow = slow.iter().filter(|&&r| r > 1.2);
    let slow = slow
        .map(|r| format!("fig9-summary.csv: filtered/f64 {r}"))
        .collect();
    builder.claim(
        "the exact order costs little where floats suffice (introduction)",
        slow,
    );
    let slower = over_filtered.iter().filter(|&&r| r <= 1.0);
    let slower = slower
        .map(|r| format!("fig9-summary.csv: exact/filtered {r}"))
        .collect();
    builder.claim(
        "filtered times are faster than exact numbers throughout, in every class",
        slower,
    );
    Ok(())
}

fn counts(builder: &mut Builder, scenes: &Sheet) -> Result<(), PaperError> {
    let of =
        |[insertion, times]: [&str; 2]| scenes.rows(&[("insertion", insertion), ("times", times)]);
    let (cavity, float, filtered) = (of(CAVITY)?, of(F64)?, of(FILTERED)?);
    let m = &mut builder.macros;
    m.whole(
        "FigNineScenes",
        cavity.len() as f64,
        "fig9.csv: cavity; rows",
    );
    let sizes = numbers(&cavity, "crossing_tets")?;
    m.range(
        "FigNineCrossing",
        &sizes,
        whole,
        "fig9.csv: cavity; crossing_tets",
    )?;
    let half_height = cavity
        .iter()
        .map(|r| r.text("half_height"))
        .collect::<Result<Vec<_>, _>>()?;
    m.define(
        "FigNineHalfHeight",
        half_height.first().unwrap_or(&"--"),
        "fig9.csv: half_height",
    );
    let patches = ["postponed", "discarded_outside", "non_crossing"];
    let patched = |rows: &[Row]| {
        let mut count = 0.0;
        for row in rows {
            let sum: f64 = numbers(&[*row], patches[0])?[0]
                + row.number(patches[1])?
                + row.number(patches[2])?;
            count += f64::from(u8::from(sum > 0.0));
        }
        Ok::<f64, PaperError>(count)
    };
    let source = "fig9.csv: rows with postponed + discarded_outside + non_crossing > 0";
    m.whole(
        "FigNinePatchedFloats",
        patched(&float)?,
        &format!("{source}; flip f64"),
    );
    let sum = |rows: &[Row], column| Ok::<f64, PaperError>(numbers(rows, column)?.iter().sum());
    let (queued_float, queued) = (sum(&float, "queued")?, sum(&filtered, "queued")?);
    m.ratio(
        "FigNineQueuedFloatsOverFiltered",
        queued_float / queued,
        "fig9.csv: sums of queued, flip f64 / flip filtered",
    );
    m.percent(
        "FigNineStaleFloats",
        sum(&float, "stale")? / queued_float,
        "fig9.csv: sums of stale / queued, flip f64",
    );
    m.percent(
        "FigNineStaleFiltered",
        sum(&filtered, "stale")? / queued,
        "fig9.csv: sums of stale / queued, flip filtered",
    );
    let mut flips = 0.0;
    for kind in ["two_three", "three_two", "four_four"] {
        flips += sum(&filtered, kind)?;
    }
    m.rough(
        "FigNineFlipsPerTet",
        flips / sum(&filtered, "crossing_tets")?,
        "fig9.csv: sums of flips / crossing_tets, flip filtered",
    );
    let bad = |row: &Row| {
        let fine = row.text("outcome")? == "ok"
            && row.text("verified")? == "true"
            && row.text("agrees")? == "true";
        let name = format!(
            "fig9.csv: {} {} of {} vertices, seed {}",
            row.text("insertion")?,
            row.text("times")?,
            row.text("vertices")?,
            row.text("seed")?
        );
        Ok::<_, PaperError>((!fine).then_some(name))
    };
    let mut contradictions = Vec::new();
    for row in cavity
        .iter()
        .chain(&float)
        .chain(&filtered)
        .chain(&of(EXACT)?)
    {
        contradictions.extend(bad(row)?);
    }
    builder.claim(
        "on random vertices all methods succeed, agree and are verified",
        contradictions,
    );
    if patched(&filtered)? > 0.0 {
        builder.claim(
            "exact order needs no patch",
            vec!["fig9.csv: flip filtered".to_string()],
        );
    }
    Ok(())
}
