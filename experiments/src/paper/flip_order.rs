//! Numbers of `flip_order.csv` and `flip_order-failures.csv`.

use super::Builder;
use super::number::whole;
use super::table::Table;
use crate::frame::sheet::{PaperError, Row, Sheet};
use std::path::Path;

/// The number types whose order is exact.
const EXACT: [&str; 2] = ["filtered", "exact"];

/// Adds them.
pub fn add(builder: &mut Builder, results: &Path) -> Result<(), PaperError> {
    let sheet = Sheet::read(results, "flip_order")?;
    let failures = Sheet::read(results, "flip_order-failures")?;
    let table = by_family(&sheet)?;
    builder.file("flip-order-families.tex", table);
    let table = by_outcome(&sheet)?;
    builder.file("flip-order-outcomes.tex", table);
    let points = precision(&sheet)?;
    builder.file("flip-order-precision.dat", points);
    totals(builder, &sheet)?;
    samples(builder, &sheet)?;
    failure_case(builder, &failures)?;
    claims(builder, &sheet)
}

/// The rows of all families for a number type.
fn families<'a>(sheet: &'a Sheet, times: &str) -> Result<Vec<Row<'a>>, PaperError> {
    let mut rows = Vec::new();
    for family in sheet.values("family")? {
        rows.push(sheet.row(&[("family", family), ("subfamily", "all"), ("times", times)])?);
    }
    Ok(rows)
}

fn failed(row: &Row) -> Result<f64, PaperError> {
    Ok(row.number("inputs")? - row.number("ok")?)
}

fn sum(rows: &[Row], column: &str) -> Result<f64, PaperError> {
    let numbers: Result<Vec<f64>, _> = rows.iter().map(|r| r.number(column)).collect();
    Ok(numbers?.iter().sum())
}

fn by_family(sheet: &Sheet) -> Result<String, PaperError> {
    let heads = [
        "family",
        "inputs",
        "\\fthirtytwo",
        "\\fsixtyfour",
        "106 bits",
        "256 bits",
        "naive",
        "filtered",
        "exact",
    ];
    let columns = [
        "f32", "f64", "bits:106", "bits:256", "naive", "filtered", "exact",
    ];
    let mut table = Table::new("@{}lrrrrrrrr@{}", &heads);
    let mut all: Vec<[f64; 2]> = vec![[0.0; 2]; columns.len()];
    let cell = |[failed, inputs]: [f64; 2], of: f64| match inputs < of {
        true => format!("{} of {}", whole(failed), whole(inputs)),
        false => whole(failed),
    };
    let mut total = 0.0;
    for family in sheet.values("family")? {
        let row = |times| sheet.row(&[("family", family), ("subfamily", "all"), ("times", times)]);
        let inputs = row("exact")?.number("inputs")?;
        total += inputs;
        let mut cells = vec![family.to_string(), whole(inputs)];
        for (times, sum) in columns.iter().zip(&mut all) {
            let row = row(times)?;
            let counts = [failed(&row)?, row.number("inputs")?];
            cells.push(cell(counts, inputs));
            *sum = [sum[0] + counts[0], sum[1] + counts[1]];
        }
        table.row(&cells);
    }
    table.rule();
    let mut cells = vec!["all".to_string(), whole(total)];
    cells.extend(all.iter().map(|&counts| cell(counts, total)));
    table.row(&cells);
    Ok(table.into_text("flip_order.csv: subfamily=all; inputs - ok"))
}

fn by_outcome(sheet: &Sheet) -> Result<String, PaperError> {
    let outcomes = [
        (
            "not_delaunay",
            "crossing tetrahedra gone, faces not locally Delaunay",
        ),
        (
            "stuck_schoenhardt",
            "stuck: half of what is left is Sch\\\"onhardt's polyhedron",
        ),
        (
            "stuck_no_tetrahedralization",
            "stuck: what is left has no tetrahedralization",
        ),
        (
            "stuck_tetrahedralizable",
            "stuck: what is left has one that was not found",
        ),
        ("stuck_undecided", "stuck: too large for the search"),
        ("inverted", "inverted tetrahedra"),
        ("endless", "flips go round in circles"),
    ];
    let types = ["f32", "f64", "naive"];
    let mut table = Table::new(
        "@{}lrrr@{}",
        &[
            "outcome of failed insertions",
            "\\fthirtytwo",
            "\\fsixtyfour",
            "naive",
        ],
    );
    let rows: Result<Vec<_>, _> = types.iter().map(|times| families(sheet, times)).collect();
    let rows = rows?;
    for (column, name) in outcomes {
        let counts: Result<Vec<f64>, _> = rows.iter().map(|rows| sum(rows, column)).collect();
        let cells = counts?.into_iter().map(whole);
        table.row(
            &std::iter::once(name.to_string())
                .chain(cells)
                .collect::<Vec<_>>(),
        );
    }
    table.rule();
    let mut cells = vec!["all failures".to_string()];
    for rows in &rows {
        let all: Result<Vec<f64>, _> = rows.iter().map(failed).collect();
        cells.push(whole(all?.iter().sum()));
    }
    table.row(&cells);
    Ok(table.into_text("flip_order.csv: subfamily=all; sums over families"))
}

/// The families of the plot of failures against precision: those of which some fail in some `bits:N`.
fn precision(sheet: &Sheet) -> Result<String, PaperError> {
    let types: Vec<&str> = sheet
        .values("times")?
        .into_iter()
        .filter(|t| t.starts_with("bits:"))
        .collect();
    let names = sheet.values("family")?;
    let columns: Vec<String> = names.iter().map(|n| n.replace('-', "")).collect();
    let mut text = format!(
        "% flip_order.csv: subfamily=all; failure_rate in percent by precision\nbits {}\n",
        columns.join(" ")
    );
    for times in types {
        text += times.trim_start_matches("bits:");
        for row in families(sheet, times)? {
            text += &format!(" {:.3}", row.number("failure_rate")? * 100.0);
        }
        text.push('\n');
    }
    Ok(text)
}

fn totals(builder: &mut Builder, sheet: &Sheet) -> Result<(), PaperError> {
    let m = &mut builder.macros;
    let count = sheet.values("family")?.len();
    m.whole(
        "OrderFamilies",
        count as f64,
        "flip_order.csv: values of family",
    );
    for (name, times) in [
        ("ThirtyTwo", "f32"),
        ("SixtyFour", "f64"),
        ("Naive", "naive"),
        ("Filtered", "filtered"),
    ] {
        let rows = families(sheet, times)?;
        let source = format!("flip_order.csv: subfamily=all, times={times}; sums of");
        let inputs = sum(&rows, "inputs")?;
        let failed: Result<Vec<f64>, _> = rows.iter().map(failed).collect();
        let failed: f64 = failed?.iter().sum();
        if times == "f64" {
            m.whole("OrderInputs", inputs, &format!("{source} inputs"));
            m.whole(
                "OrderEvents",
                sum(&rows, "events")?,
                &format!("{source} events"),
            );
            let with_events = sum(&rows, "with_events")?;
            let part = |column| Ok::<f64, PaperError>(sum(&rows, column)? / with_events);
            m.percent(
                "OrderInvertedRuns",
                part("inverted_runs")?,
                &format!("{source} inverted_runs / with_events"),
            );
            m.percent(
                "OrderFirstPatch",
                part("discarded_outside_runs")?,
                &format!("{source} discarded_outside_runs / with_events"),
            );
            m.percent(
                "OrderSecondPatch",
                part("non_crossing_runs")?,
                &format!("{source} non_crossing_runs / with_events"),
            );
            m.percent(
                "OrderThirdPatch",
                part("postponed_runs")?,
                &format!("{source} postponed_runs / with_events"),
            );
            m.whole(
                "OrderSchoenhardt",
                sum(&rows, "stuck_schoenhardt")?,
                &format!("{source} stuck_schoenhardt"),
            );
            m.whole(
                "OrderNotDelaunay",
                sum(&rows, "not_delaunay")?,
                &format!("{source} not_delaunay"),
            );
            m.whole(
                "OrderStuck",
                sum(&rows, "stuck")?,
                &format!("{source} stuck"),
            );
            let longest: Result<Vec<f64>, _> =
                rows.iter().map(|r| r.number("longest_list")).collect();
            let longest = longest?.into_iter().fold(0.0, f64::max);
            m.whole(
                "OrderLongestList",
                longest,
                "flip_order.csv: subfamily=all, times=f64; the greatest longest_list",
            );
        }
        if times == "filtered" {
            m.percent(
                "OrderTies",
                sum(&rows, "exact_ties")? / sum(&rows, "events")?,
                &format!("{source} exact_ties / events"),
            );
            continue;
        }
        m.whole(
            &format!("OrderFailures{name}"),
            failed,
            &format!("{source} inputs - ok"),
        );
        m.percent(
            &format!("OrderFailureRate{name}"),
            failed / inputs,
            &format!("{source} inputs - ok over inputs"),
        );
    }
    let worst = ["sphere", "near-coplanar", "lattice"];
    for (family, name) in worst.iter().zip(["Sphere", "NearCoplanar", "Lattice"]) {
        let key = [("family", *family), ("subfamily", "all"), ("times", "f64")];
        let rate = sheet.row(&key)?.number("failure_rate")?;
        m.percent(
            &format!("OrderRate{name}"),
            rate,
            &format!("flip_order.csv: family={family}, subfamily=all, times=f64; failure_rate"),
        );
    }
    Ok(())
}

/// What more bits do, on the sample of the inputs that has them.
fn samples(builder: &mut Builder, sheet: &Sheet) -> Result<(), PaperError> {
    let m = &mut builder.macros;
    for (name, bits) in [
        ("FiftyThree", "53"),
        ("SixtyFour", "64"),
        ("Double", "106"),
        ("Most", "256"),
    ] {
        let times = format!("bits:{bits}");
        let rows = families(sheet, &times)?;
        let failures: Result<Vec<f64>, _> = rows.iter().map(failed).collect();
        let failures: f64 = failures?.iter().sum();
        let source = format!("flip_order.csv: subfamily=all, times={times}; sums");
        m.whole(
            &format!("OrderFailuresBits{name}"),
            failures,
            &format!("{source} of inputs - ok"),
        );
        if bits == "256" {
            m.whole(
                "OrderSample",
                sum(&rows, "inputs")?,
                &format!("{source} of inputs"),
            );
            let key = [
                ("family", "sphere"),
                ("subfamily", "all"),
                ("times", "bits:256"),
            ];
            let rate = sheet.row(&key)?.number("failure_rate")?;
            m.percent(
                "OrderRateBitsMostSphere",
                rate,
                "flip_order.csv: family=sphere, subfamily=all, times=bits:256; failure_rate",
            );
        }
    }
    let types = sheet.values("times")?;
    let bits = types
        .iter()
        .filter_map(|t| t.strip_prefix("bits:")?.parse::<f64>().ok());
    let bits: Vec<f64> = bits.collect();
    m.range(
        "OrderPrecision",
        &bits,
        whole,
        "flip_order.csv: times=bits:N",
    )?;
    Ok(())
}

fn failure_case(builder: &mut Builder, failures: &Sheet) -> Result<(), PaperError> {
    let row = failures.row(&[("input", "prism/end:78"), ("times", "f64")])?;
    let source = "flip_order-failures.csv: input=prism/end:78, times=f64;";
    for (name, column) in [
        ("Vertices", "vertices"),
        ("Left", "left"),
        ("List", "longest_list"),
        ("Kendall", "kendall"),
    ] {
        builder.macros.whole(
            &format!("Case{name}"),
            row.number(column)?,
            &format!("{source} {column}"),
        );
    }
    let class = row.text("class")?;
    let other = (class != "schoenhardt").then(|| format!("{source} class={class}"));
    builder.claim(
        "the failure case ends in Schönhardt's polyhedron",
        other.into_iter().collect(),
    );
    Ok(())
}

fn claims(builder: &mut Builder, sheet: &Sheet) -> Result<(), PaperError> {
    let mut unexpected = Vec::new();
    for times in EXACT {
        for row in families(sheet, times)? {
            for column in [
                "failure_rate",
                "adjacent_inversions",
                "postponed",
                "discarded_outside",
                "non_crossing",
            ] {
                if row.number(column)? != 0.0 {
                    unexpected.push(format!(
                        "flip_order.csv: {} {times}; {column}",
                        row.text("family")?
                    ));
                }
            }
        }
    }
    builder.claim(
        "in exact order every insertion succeeds, without a patch",
        unexpected,
    );
    let row =
        |family, times| sheet.row(&[("family", family), ("subfamily", "all"), ("times", times)]);
    let mut unexpected = Vec::new();
    for family in ["near-coplanar", "lattice", "prism"] {
        if row(family, "bits:106")?.number("failure_rate")? != 0.0 {
            unexpected.push(format!("flip_order.csv: {family} bits:106 fails"));
        }
        if row(family, "f64")?.number("failure_rate")? == 0.0 {
            unexpected.push(format!("flip_order.csv: {family} f64 does not fail"));
        }
    }
    builder.claim("twice the precision cures near ties", unexpected);
    let cured = row("sphere", "bits:256")?.number("failure_rate")? == 0.0;
    let cured = cured.then(|| "flip_order.csv: sphere bits:256 does not fail".to_string());
    builder.claim("no precision cures ties", cured.into_iter().collect());
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn families_are_columns_of_the_plot() {
        let text = "family,subfamily,times,failure_rate\n\
            a-b,all,bits:8,0.5\na-b,all,f64,0.1\nc,all,bits:8,0.0\nc,all,f64,0.2\n";
        let sheet = Sheet::parse("flip_order.csv", text).expect("a CSV");
        let points = precision(&sheet).expect("complete");
        assert!(points.ends_with("bits ab c\n8 50.000 0.000\n"), "{points}");
    }
}
