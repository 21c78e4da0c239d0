//! Experiments that need other programs, other models or much memory: where their files are missing the paper says so.

use super::Builder;
use super::fig9_tetgen;
use super::number::{ratio, significant, whole};
use super::table::{Table, cell, escaped, not_measured, of_sheet};
use super::{table1, updates};
use crate::frame::sheet::{PaperError, Row, Sheet};
use std::path::Path;

/// A CSV that becomes a table as it is: the paper has `\input{generated/STEM-table}` and the switch `\ifSWITCH`.
struct Hook {
    stem: &'static str,
    switch: &'static str,
    /// Columns and their heads; all but `commit` if there are none.
    columns: &'static [(&'static str, &'static str)],
    /// Only rows that have something in this column, if one is named.
    filled: &'static str,
    /// A column for each row.
    turned: bool,
}

const HOOKS: [Hook; 2] = [
    Hook {
        stem: "table2",
        switch: "TableTwo",
        columns: &[
            ("beside", "column"),
            ("source", "source"),
            ("insertion", "by"),
            ("cavity_delaunay", "(1)"),
            ("cavity_faces", "(2)"),
            ("polygon_faces", "(3)"),
            ("merging", "(4)"),
            ("queueing", "(5)"),
            ("flipping", "(6)"),
        ],
        filled: "beside",
        turned: false,
    },
    Hook {
        stem: "failures",
        switch: "Failures",
        columns: &[
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
        ],
        filled: "",
        turned: false,
    },
];

/// Adds them.
pub fn add(builder: &mut Builder, results: &Path) -> Result<(), PaperError> {
    for hook in HOOKS {
        let sheet = Sheet::read_optional(results, hook.stem)?;
        let sheet = match sheet {
            Some(sheet) if !hook.filled.is_empty() => Some(sheet.filled(hook.filled)?),
            sheet => sheet,
        };
        let text = match &sheet {
            Some(sheet) => of_sheet(sheet, hook.columns, hook.turned)?,
            None => not_measured(&format!("{}.csv", hook.stem)),
        };
        builder.file(&format!("{}-table.tex", hook.stem), text);
        let file = format!("{}.csv", hook.stem);
        builder.macros.switch(hook.switch, sheet.is_some(), &file);
    }
    let compared = |column: &'static str| {
        move |sheet: &Sheet| Ok::<_, PaperError>(sheet.values(column)?.len() > 1)
    };
    let always = |_: &Sheet| Ok(true);
    optional(
        builder,
        results,
        ("table1", "TableOne"),
        always,
        table1::add,
    )?;
    optional(
        builder,
        results,
        ("rivals", "Rivals"),
        compared("program"),
        rivals,
    )?;
    optional(
        builder,
        results,
        ("rivals-targets", "RivalsTargets"),
        always,
        targets,
    )?;
    optional(
        builder,
        results,
        ("fig9-tetgen", "Modes"),
        always,
        fig9_tetgen::table,
    )?;
    optional(
        builder,
        results,
        ("updates", "Updates"),
        always,
        updates::table,
    )?;
    optional(builder, results, ("scaling", "Scaling"), always, scaling)?;
    let summary = ("steiner-summary", "SteinerSummary");
    optional(
        builder,
        results,
        summary,
        compared("method"),
        steiner_summary,
    )?;
    optional(builder, results, ("steiner", "Steiner"), always, steiner)
}

/// What makes a table of a sheet, and may define commands and add files.
type Make = fn(&mut Builder, &Sheet) -> Result<String, PaperError>;

/// A table of a file, if it is there and `wanted`.
fn optional(
    builder: &mut Builder,
    results: &Path,
    (stem, switch): (&str, &str),
    wanted: impl Fn(&Sheet) -> Result<bool, PaperError>,
    make: Make,
) -> Result<(), PaperError> {
    let file = format!("{stem}.csv");
    let sheet = match Sheet::read_optional(results, stem)? {
        Some(sheet) if wanted(&sheet)? => Some(sheet),
        _ => None,
    };
    builder.macros.switch(switch, sheet.is_some(), &file);
    let text = match &sheet {
        Some(sheet) => make(builder, sheet)?,
        None => not_measured(&file),
    };
    builder.file(&format!("{stem}-table.tex"), text);
    Ok(())
}

/// A cell of a table: two significant digits, or a dash.
fn rough(row: &Row, column: &str) -> Result<String, PaperError> {
    let value = row.optional(column)?;
    Ok(value.map_or("--".to_string(), |x| significant(x, 2)))
}

fn count(row: &Row, column: &str) -> Result<String, PaperError> {
    let value = row.optional(column)?;
    Ok(value.map_or("--".to_string(), whole))
}

fn over(row: &Row, column: &str) -> Result<String, PaperError> {
    let value = row.optional(column)?;
    Ok(value.map_or("--".to_string(), ratio))
}

/// The seconds of a row, or how it ended.
fn seconds(row: Option<&Row>) -> Result<String, PaperError> {
    match row {
        None => Ok("--".to_string()),
        Some(row) => match row.text("outcome")? {
            "ok" => rough(row, "seconds"),
            outcome => Ok(escaped(outcome)),
        },
    }
}

/// One line for each of our methods on each of the built-in inputs, the other programs beside it; models are in the sums of
/// `rivals-targets.csv`.
fn rivals(builder: &mut Builder, sheet: &Sheet) -> Result<String, PaperError> {
    let heads = [
        "input",
        "method",
        "seconds",
        "TetGen",
        "HXT",
        "MiB",
        "TetGen",
        "$\\frac{\\text{seconds}}{\\text{TetGen}}$",
        "$\\frac{\\text{polygon}}{\\text{TetGen}}$",
        "$\\frac{\\text{MiB}}{\\text{TetGen}}$",
        "$\\frac{\\text{seconds}}{\\text{HXT}}$",
        "verifier",
    ];
    let mut table = Table::new("@{}llrrrrrrrrrr@{}", &heads);
    let mut verification = Vec::new();
    for row in sheet.all() {
        verification.extend(row.optional("verification_over_construction")?);
    }
    for input in sheet.values("input")? {
        let find =
            |program: &str| sheet.rows(&[("input", input), ("program", program), ("threads", "1")]);
        let (tetgen, hxt) = (find("tetgen")?, find("hxt")?);
        let (tetgen, hxt) = (tetgen.first(), hxt.first());
        let mut verifier = sheet
            .rows(&[("input", input), ("method", "verify"), ("threads", "1")])?
            .into_iter();
        let mut name = escaped(input);
        for ours in find("tetflip")? {
            if ours.text("kind")?.starts_with("model") || ours.text("method")? == "verify" {
                continue;
            }
            let verified = verifier.next();
            table.row(&[
                std::mem::take(&mut name),
                escaped(ours.text("method")?),
                seconds(Some(&ours))?,
                seconds(tetgen)?,
                seconds(hxt)?,
                rough(&ours, "peak_mebibytes")?,
                tetgen.map_or(Ok("--".to_string()), |r| rough(r, "peak_mebibytes"))?,
                over(&ours, "seconds_over_tetgen")?,
                over(&ours, "polygons_over_tetgen")?,
                over(&ours, "memory_over_tetgen")?,
                over(&ours, "seconds_over_hxt")?,
                verified.map_or(Ok(String::new()), |r| {
                    over(&r, "verification_over_construction")
                })?,
            ]);
        }
    }
    let source = "rivals.csv: verification_over_construction";
    let m = &mut builder.macros;
    if verification.is_empty() {
        m.define("RivalsVerificationLeast", "--", source);
        m.define("RivalsVerificationMost", "--", source);
    } else {
        m.range("RivalsVerification", &verification, ratio, source)?;
    }
    let versions = |program: &str| {
        let rows = sheet.rows(&[("program", program)])?;
        rows.first()
            .map_or(Ok("not installed"), |r| r.text("version"))
    };
    for (name, program) in [("TetGen", "tetgen"), ("HXT", "hxt")] {
        let version = escaped(versions(program)?);
        builder.macros.define(
            &format!("Rivals{name}Version"),
            &version,
            &format!("rivals.csv: program={program}; version"),
        );
    }
    Ok(table.into_text("rivals.csv: kind is not model; seconds, peak_mebibytes, the ratios"))
}

fn targets(_: &mut Builder, sheet: &Sheet) -> Result<String, PaperError> {
    let heads = ["quantity", "inputs", "target", "measured", "reached"];
    let mut table = Table::new("@{}p{0.6\\linewidth}rrrr@{}", &heads);
    for row in sheet.all() {
        table.row(&[
            escaped(row.text("what")?),
            whole(row.number("inputs")?),
            ratio(row.number("bound")?),
            ratio(row.number("measured")?),
            cell(row.text("reached")?),
        ]);
    }
    Ok(table.into_text("rivals-targets.csv"))
}

fn scaling(builder: &mut Builder, sheet: &Sheet) -> Result<String, PaperError> {
    let heads = [
        "input",
        "size",
        "tetrahedra",
        "seconds",
        "\\textmu s each",
        "MiB",
        "bytes per tetrahedron",
    ];
    let mut table = Table::new("@{}lrrrrrr@{}", &heads);
    let mut plot = "% scaling.csv: size, seconds\n".to_string();
    for row in sheet.all() {
        let outcome = row.text("outcome")?;
        table.row(&[
            escaped(row.text("input")?),
            whole(row.number("size")?),
            count(&row, "tetrahedra")?,
            if outcome == "ok" {
                rough(&row, "seconds")?
            } else {
                escaped(outcome)
            },
            rough(&row, "microseconds_each")?,
            count(&row, "peak_mebibytes")?,
            count(&row, "bytes_per_tetrahedron")?,
        ]);
    }
    for input in sheet.values("input")? {
        let mut points = String::new();
        let (mut each, mut sizes) = (Vec::new(), Vec::new());
        for row in sheet.rows(&[("input", input), ("outcome", "ok")])? {
            points += &format!(" ({},{:.4e})", row.text("size")?, row.number("seconds")?);
            each.push(row.number("microseconds_each")?);
            sizes.push(row.number("size")?);
        }
        if each.is_empty() {
            continue;
        }
        plot += &format!(
            "\\addplot coordinates {{{points} }};\n\\addlegendentry{{{}}}\n",
            escaped(input)
        );
        if input == "uniform" {
            let m = &mut builder.macros;
            let source = format!("scaling.csv: input={input}, outcome=ok");
            m.range(
                "ScalingEach",
                &each,
                |x| significant(x, 2),
                &format!("{source}; microseconds_each"),
            )?;
            m.range("ScalingSizes", &sizes, whole, &format!("{source}; size"))?;
        }
    }
    builder.file("scaling-plot.tex", plot);
    Ok(table.into_text("scaling.csv"))
}

fn steiner_summary(_: &mut Builder, sheet: &Sheet) -> Result<String, PaperError> {
    let columns = [
        ("source", "models"),
        ("method", "program"),
        ("models", "all"),
        ("succeeded", "succeeded"),
        ("common", "in common"),
        ("common_steiner_points", "Steiner points on these"),
        ("fewest", "fewest or equal on"),
    ];
    of_sheet(sheet, &columns, false)
}

/// The built-in families: one row each, one column for each method.
fn steiner(builder: &mut Builder, sheet: &Sheet) -> Result<String, PaperError> {
    let methods = sheet.values("method")?;
    let others: Vec<&str> = methods.into_iter().filter(|m| *m != "tetflip").collect();
    let mut heads = vec![
        "model".to_string(),
        "segments".into(),
        "tetflip".into(),
        "exactly on segment".into(),
    ];
    heads.extend(others.iter().map(|m| escaped(m)));
    let heads: Vec<&str> = heads.iter().map(String::as_str).collect();
    let columns = format!("@{{}}lrrr{}@{{}}", "r".repeat(others.len()));
    let mut table = Table::new(&columns, &heads);
    let (mut points, mut on_segment) = (0.0, 0.0);
    for row in sheet.rows(&[("source", "built-in"), ("method", "tetflip")])? {
        let model = row.text("model")?;
        let mut cells = vec![
            escaped(model),
            count(&row, "segments")?,
            steiner_points(&row)?,
            count(&row, "on_segment")?,
        ];
        points += row.optional("steiner_points")?.unwrap_or(0.0);
        on_segment += row.optional("on_segment")?.unwrap_or(0.0);
        for method in &others {
            let row = sheet.row(&[("source", "built-in"), ("model", model), ("method", method)])?;
            cells.push(steiner_points(&row)?);
        }
        table.row(&cells);
    }
    let source = "steiner.csv: source=built-in, method=tetflip; sums of";
    builder
        .macros
        .whole("SteinerPoints", points, &format!("{source} steiner_points"));
    if points > 0.0 {
        builder.macros.percent(
            "SteinerOnSegment",
            on_segment / points,
            &format!("{source} on_segment / steiner_points"),
        );
    }
    Ok(table.into_text("steiner.csv: source=built-in; segments, steiner_points, on_segment"))
}

fn steiner_points(row: &Row) -> Result<String, PaperError> {
    match row.text("outcome")? {
        "ok" => count(row, "steiner_points"),
        outcome => Ok(escaped(outcome)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_there_is_said() {
        let empty = tempfile::tempdir().expect("a directory");
        let mut builder = Builder::default();
        add(&mut builder, empty.path()).expect("nothing is needed");
        let text = &builder.generated.files["rivals-table.tex"];
        assert!(
            text.contains("Not measured") && text.contains("rivals.csv"),
            "{text}"
        );
        let numbers = builder.macros.into_text();
        assert!(
            numbers.contains("\\newif\\ifRivals\\Rivalsfalse"),
            "{numbers}"
        );
    }

    #[test]
    fn what_is_there_is_a_table() {
        let directory = tempfile::tempdir().expect("a directory");
        let rivals = "input,kind,program,method,version,threads,outcome,seconds,peak_mebibytes,tetrahedra,\
            seconds_over_tetgen,polygons_over_tetgen,memory_over_tetgen,seconds_over_hxt,verification_over_construction\n\
            uniform/9,points,tetflip,delaunay,0.1,1,ok,0.5,12.5,60,0.4,,0.6,,\n\
            uniform/9,points,tetgen,cavity,1.5,1,failed,,,,,,,,\n\
            uniform/9,points,tetflip,verify,0.1,1,ok,0.25,12.5,60,,,,,0.5\n";
        std::fs::write(directory.path().join("rivals.csv"), rivals).expect("written");
        let mut builder = Builder::default();
        add(&mut builder, directory.path()).expect("complete");
        let text = &builder.generated.files["rivals-table.tex"];
        let ours = "uniform/9 & delaunay & 0.50 & failed & -- & 12 & -- & 0.40 & -- & 0.60 & -- & 0.50 \\\\";
        assert!(text.contains(ours), "{text}");
        let numbers = builder.macros.into_text();
        assert!(
            numbers.contains("\\newcommand{\\RivalsVerificationMost}{0.50}"),
            "{numbers}"
        );
        assert!(
            numbers.contains("\\newcommand{\\RivalsTetGenVersion}{1.5}"),
            "{numbers}"
        );
    }

    #[test]
    fn alone_nothing_is_compared() {
        let directory = tempfile::tempdir().expect("a directory");
        let alone = "input,program\nuniform/9,tetflip\n";
        std::fs::write(directory.path().join("rivals.csv"), alone).expect("written");
        let mut builder = Builder::default();
        add(&mut builder, directory.path()).expect("complete");
        assert!(builder.generated.files["rivals-table.tex"].contains("Not measured"));
        assert!(builder.macros.into_text().contains("\\Rivalsfalse"));
    }

    #[test]
    fn hooks_take_any_columns() {
        let directory = tempfile::tempdir().expect("a directory");
        let table = "beside,source,insertion,cavity_delaunay,cavity_faces,polygon_faces,merging,queueing,flipping,commit\n\
                     A,paper,cavity,50,12345,,,,,x\n,generated,cavity,1,2,3,4,5,6,x\n";
        std::fs::write(directory.path().join("table2.csv"), table).expect("written");
        let mut builder = Builder::default();
        add(&mut builder, directory.path()).expect("complete");
        let text = &builder.generated.files["table2-table.tex"];
        assert!(
            text.contains("A & paper & cavity & 50 & 12\\,345 &") && !text.contains("generated"),
            "{text}"
        );
    }
}
