//! Tables of experiments that need other programs, other models or much memory: where their files are missing the paper
//! says so.

use super::needed::File;
use super::number::{Format, whole};
use super::sheets::Sheets;
use super::table::{Column, Table, cell, cells, escaped, not_measured, of_sheet};
use crate::frame::query::Rows;
use crate::frame::sheet::{Sheet, SheetError};
use crate::measure::sample::median;

/// What is asked for, as [`Sheets::wanted`] has it, and what makes a table of it.
type Optional = (&'static str, fn(&Sheet) -> Result<String, SheetError>);

const TABLES: [Optional; 11] = [
    ("table2", |sheet| of_sheet(sheet, "beside!=", &TABLE_2)),
    ("failures", |sheet| of_sheet(sheet, "", &FAILURES)),
    ("table1", table1),
    ("rivals, distinct(program) > 1", rivals),
    ("rivals-summary", |sheet| {
        of_sheet(sheet, "", &RIVALS_SUMMARY)
    }),
    ("rivals-targets", targets),
    ("fig9-tetgen", fig9_tetgen),
    ("updates", |sheet| of_sheet(sheet, "", &UPDATES)),
    ("scaling", scaling),
    ("steiner-summary, distinct(method) > 1", |sheet| {
        of_sheet(sheet, "", &STEINER_SUMMARY)
    }),
    ("steiner", steiner),
];

/// All of them.
///
/// # Errors
/// If a file that is there lacks a column or a row.
pub fn files(sheets: &Sheets) -> Result<Vec<File>, SheetError> {
    let mut files = Vec::new();
    for (wanted, make) in TABLES {
        let stem = wanted.split(',').next().unwrap_or(wanted);
        let text = match sheets.wanted(wanted)? {
            Some(sheet) => make(sheet)?,
            None => not_measured(&format!("{stem}.csv")),
        };
        files.push((format!("{stem}-table.tex"), text));
    }
    if let Some(sheet) = sheets.optional("scaling") {
        files.push(("scaling-plot.tex".to_string(), scaling_plot(sheet)?));
    }
    Ok(files)
}

const TABLE_2: [(&str, &str); 9] = [
    ("beside", "column"),
    ("source", "source"),
    ("insertion", "by"),
    ("cavity_delaunay", "(1)"),
    ("cavity_faces", "(2)"),
    ("polygon_faces", "(3)"),
    ("merging", "(4)"),
    ("queueing", "(5)"),
    ("flipping", "(6)"),
];

const RIVALS_SUMMARY: [(&str, &str); 13] = [
    ("kind", "inputs"),
    ("method", "ours"),
    ("beside", "beside"),
    ("common", "common"),
    ("they_failed", "they fail"),
    ("sum_ratio", "sum"),
    ("geometric_mean", "geometric mean"),
    ("median", "median"),
    ("worst", "worst"),
    ("slower_on", "slower"),
    ("steiner_points", "Steiner points"),
    ("their_steiner_points", "theirs"),
    ("more_steiner_on", "more on"),
];

const FAILURES: [(&str, &str); 10] = [
    ("input", "input"),
    ("times", "times"),
    ("vertices", "vertices"),
    ("crossing_tets", "crossing"),
    ("events", "events"),
    ("left", "left"),
    ("class", "what is left"),
    ("piece_tets", "its tetrahedra"),
    ("piece_vertices", "its vertices"),
    ("exact_succeeds", "exact order succeeds"),
];

const UPDATES: [(&str, &str); 12] = [
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

const STEINER_SUMMARY: [(&str, &str); 7] = [
    ("source", "models"),
    ("method", "program"),
    ("models", "all"),
    ("succeeded", "succeeded"),
    ("common", "in common"),
    ("common_steiner_points", "Steiner points on these"),
    ("fewest", "fewest or equal on"),
];

/// What columns say of rows of success; else how they ended, in the place of the `at`-th one.
fn cells_or_outcome(rows: &Rows, columns: &[Column], at: usize) -> Result<Vec<String>, SheetError> {
    let mut cells = cells(rows, columns)?;
    let outcome = rows.text("outcome")?;
    if !["ok", ""].contains(&outcome) {
        cells[at] = escaped(outcome);
    }
    Ok(cells)
}

const TABLE_1: [Column; 15] = [
    ("vertices", "only?(vertices)", Format::Whole),
    ("polygons", "only?(polygons)", Format::Whole),
    ("Steiner", "only?(steiner_points)", Format::Whole),
    ("tetrahedra", "only?(tetrahedra)", Format::Whole),
    ("subpol.", "only?(subpolygons)", Format::Whole),
    ("recov.", "only?(recovered)", Format::Whole),
    ("flips", "only?(flips)", Format::Whole),
    ("cross.", "only?(crossing_tets)", Format::Whole),
    ("largest", "only?(largest_region)", Format::Whole),
    ("mean", "only?(mean_region)", Format::Whole),
    ("Delaunay", "only?(delaunay_seconds)", Format::Exact),
    ("segments", "only?(segment_seconds)", Format::Exact),
    ("cavities", "only?(cavity_seconds)", Format::Exact),
    ("flips", "only?(flip_seconds)", Format::Exact),
    ("all", "only?(total_seconds)", Format::Exact),
];

/// Each of the original's columns with ours beside it, as rows, then the other built-in models. Of other models only
/// those that the original has are shown.
fn table1(sheet: &Sheet) -> Result<String, SheetError> {
    let mut table = Table::new("lrrrrrrrrrrrrrrr", &["model"], &TABLE_1);
    let mut row = |name: String, rows: &Rows| {
        let cells = cells_or_outcome(rows, &TABLE_1, TABLE_1.len() - 1)?;
        table.row(&[vec![name], cells].concat());
        Ok::<_, SheetError>(())
    };
    let all = Rows::all(sheet);
    for (model, original) in all.only("source=paper")?.by("model")? {
        row(format!("\\emph{{{}}}", escaped(model)), &original)?;
        let beside = all.only(&format!("beside={model}, source!=paper"))?;
        for (model, ours) in beside.by("model")? {
            row(escaped(model), &ours)?;
        }
    }
    let others = all.only("source=generated, beside=")?.by("model")?;
    if !others.is_empty() {
        table.rule();
    }
    for (model, ours) in others {
        let cells = cells_or_outcome(&ours, &TABLE_1, TABLE_1.len() - 1)?;
        table.row(&[vec![escaped(model)], cells].concat());
    }
    Ok(table.into_text("table1.csv"))
}

/// One line for each of our methods on each of the built-in inputs, the other programs beside it; models are in the
/// sums of `rivals-targets.csv`.
fn rivals(sheet: &Sheet) -> Result<String, SheetError> {
    let over =
        |what: &str, whose: &str| format!("$\\frac{{\\text{{{what}}}}}{{\\text{{{whose}}}}}$");
    let heads = [
        "input", "method", "seconds", "TetGen", "HXT", "MiB", "TetGen",
    ]
    .map(str::to_string);
    let ratios = [
        ("seconds", "TetGen"),
        ("polygon", "TetGen"),
        ("MiB", "TetGen"),
        ("seconds", "HXT"),
    ];
    let heads = heads
        .into_iter()
        .chain(ratios.map(|(a, b)| over(a, b)))
        .chain(["verifier".to_string()]);
    let heads: Vec<String> = heads.collect();
    let heads: Vec<&str> = heads.iter().map(String::as_str).collect();
    let mut table = Table::new("llrrrrrrrrrr", &heads, &[]);
    let rough = |rows: &Rows, column: &str| {
        let number = rows.optional(&format!("first?({column})"))?;
        Ok::<_, SheetError>(Format::Rough.print(number))
    };
    let ratio = |rows: &Rows, column: &str| {
        let number = rows.optional(&format!("first?({column})"))?;
        Ok::<_, SheetError>(Format::Ratio.print(number))
    };
    let seconds = |rows: &Rows| match rows.text("outcome")? {
        "ok" | "" => rough(rows, "seconds"),
        outcome => Ok(escaped(outcome)),
    };
    for (input, rows) in Rows::all(sheet).only("threads=1")?.by("input")? {
        let (tetgen, hxt) = (rows.only("program=tetgen")?, rows.only("program=hxt")?);
        // What verified the first of our meshes stands beside it.
        let mut verifier = Some(rows.only("method=verify")?).filter(|v| !v.rows.is_empty());
        let mut name = escaped(input);
        for (method, ours) in rows.only("program=tetflip, method!=verify")?.by("method")? {
            if ours.text("kind")?.starts_with("model") {
                continue;
            }
            let verified = verifier.take();
            table.row(&[
                std::mem::take(&mut name),
                escaped(method),
                seconds(&ours)?,
                seconds(&tetgen)?,
                seconds(&hxt)?,
                rough(&ours, "peak_mebibytes")?,
                rough(&tetgen, "peak_mebibytes")?,
                ratio(&ours, "seconds_over_tetgen")?,
                ratio(&ours, "polygons_over_tetgen")?,
                ratio(&ours, "memory_over_tetgen")?,
                ratio(&ours, "seconds_over_hxt")?,
                verified.map_or(Ok(String::new()), |v| {
                    ratio(&v, "verification_over_construction")
                })?,
            ]);
        }
    }
    Ok(table.into_text("rivals.csv: kind is not model; seconds, peak_mebibytes, the ratios"))
}

fn targets(sheet: &Sheet) -> Result<String, SheetError> {
    let columns = [
        ("inputs", "only(inputs)", Format::Whole),
        ("target", "only(bound)", Format::Ratio),
        ("measured", "only(measured)", Format::Ratio),
    ];
    let heads = ["quantity", "inputs", "target", "measured", "reached"];
    let mut table = Table::new("p{0.6\\linewidth}rrrr", &heads, &[]);
    for (what, rows) in Rows::all(sheet).by("what")? {
        let reached = vec![cell(rows.text("reached")?)];
        table.row(&[vec![escaped(what)], cells(&rows, &columns)?, reached].concat());
    }
    Ok(table.into_text("rivals-targets.csv"))
}

/// Classes by their numbers of crossing tetrahedra: those of the original's two plots, and beyond.
const CLASSES: [(&str, &str); 3] = [
    ("0 to 102", "crossing_tets<103"),
    ("103 to 1\\,840", "crossing_tets>=103, crossing_tets<1841"),
    ("from 1\\,841", "crossing_tets>=1841"),
];

/// By class and mode: scenes, those that end in the CDT, and medians of the ratios of ours to its time, and of the time
/// of its flips to that of its cavities.
fn fig9_tetgen(sheet: &Sheet) -> Result<String, SheetError> {
    let columns = [
        ("scenes", "sum(1)", Format::Whole),
        (
            "the CDT",
            "sum[outcome=ok, verified=true](1)",
            Format::Whole,
        ),
        (
            "$\\frac{\\text{ours}}{\\text{TetGen}}$",
            "median?(ours_over_tetgen)",
            Format::Ratio,
        ),
    ];
    let heads = ["crossing tetrahedra", "mode"]
        .into_iter()
        .chain(columns.map(|c| c.0));
    let heads = heads.chain(["$\\frac{\\text{TetGen's flips}}{\\text{TetGen's cavities}}$"]);
    let mut table = Table::new("rlrrrr", &heads.collect::<Vec<_>>(), &[]);
    let all = Rows::all(sheet);
    for (range, conditions) in CLASSES {
        for mode in ["cavity", "flips"] {
            let class = all.only(&format!("{conditions}, mode={mode}"))?;
            if class.rows.is_empty() {
                continue;
            }
            let mut slower = Vec::new();
            for row in &class.rows {
                let scene = format!(
                    "vertices={}, seed={}",
                    row.text("vertices")?,
                    row.text("seed")?
                );
                let cavity = all
                    .only(&format!("{scene}, mode=cavity"))?
                    .optional("only?(median_seconds)")?;
                slower.extend(
                    row.optional("median_seconds")?
                        .zip(cavity)
                        .map(|(own, cavity)| own / cavity),
                );
            }
            let slower = match mode {
                "flips" => Format::Ratio.print(median(&slower)),
                _ => String::new(),
            };
            let first = vec![range.to_string(), mode.to_string()];
            table.row(&[first, cells(&class, &columns)?, vec![slower]].concat());
        }
    }
    Ok(table.into_text("fig9-tetgen.csv: by class of crossing_tets; medians"))
}

const SCALING: [Column; 6] = [
    ("size", "only(size)", Format::Whole),
    ("tetrahedra", "only?(tetrahedra)", Format::Whole),
    ("seconds", "only?(seconds)", Format::Rough),
    ("\\textmu s each", "only?(microseconds_each)", Format::Rough),
    ("MiB", "only?(peak_mebibytes)", Format::Whole),
    (
        "bytes per tetrahedron",
        "only?(bytes_per_tetrahedron)",
        Format::Whole,
    ),
];

fn scaling(sheet: &Sheet) -> Result<String, SheetError> {
    let mut table = Table::new("lrrrrrr", &["input"], &SCALING);
    for (input, rows) in Rows::all(sheet).by("input")? {
        for (_, rows) in rows.by("size")? {
            let cells = cells_or_outcome(&rows, &SCALING, 2)?;
            table.row(&[vec![escaped(input)], cells].concat());
        }
    }
    Ok(table.into_text("scaling.csv"))
}

fn scaling_plot(sheet: &Sheet) -> Result<String, SheetError> {
    let mut plot = "% scaling.csv: size, seconds\n".to_string();
    for (input, rows) in Rows::all(sheet).only("outcome=ok")?.by("input")? {
        let mut points = String::new();
        for row in rows.rows {
            points += &format!(" ({},{:.4e})", row.text("size")?, row.number("seconds")?);
        }
        let input = escaped(input);
        plot += &format!("\\addplot coordinates {{{points} }};\n\\addlegendentry{{{input}}}\n");
    }
    Ok(plot)
}

/// The built-in families: one row each, one column for each method.
fn steiner(sheet: &Sheet) -> Result<String, SheetError> {
    let all = Rows::all(sheet);
    let methods = all.by("method")?;
    let others = methods.iter().map(|m| m.0).filter(|&m| m != "tetflip");
    let others: Vec<&str> = others.collect();
    let names: Vec<String> = others.iter().map(|m| escaped(m)).collect();
    let mut heads = vec!["model", "segments", "tetflip", "exactly on segment"];
    heads.extend(names.iter().map(String::as_str));
    let mut table = Table::new(&format!("lrrr{}", "r".repeat(others.len())), &heads, &[]);
    let points = |rows: &Rows| match rows.text("outcome")? {
        "ok" => Ok(Format::Whole.print(rows.optional("only?(steiner_points)")?)),
        outcome => Ok::<_, SheetError>(escaped(outcome)),
    };
    for (model, rows) in all.only("source=built-in")?.by("model")? {
        let ours = rows.only("method=tetflip")?;
        let count = |column: &str| {
            let number = ours.optional(&format!("only?({column})"))?;
            Ok::<_, SheetError>(whole_or_dash(number))
        };
        let mut row = vec![
            escaped(model),
            count("segments")?,
            points(&ours)?,
            count("on_segment")?,
        ];
        for method in &others {
            row.push(points(&rows.only(&format!("method={method}"))?)?);
        }
        table.row(&row);
    }
    Ok(table.into_text("steiner.csv: source=built-in; segments, steiner_points, on_segment"))
}

fn whole_or_dash(number: Option<f64>) -> String {
    number.map_or("--".to_string(), whole)
}
