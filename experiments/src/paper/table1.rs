//! Table 1 of Si & Shewchuk beside ours, from `table1.csv`, and what it says of their sentence that the times of the two algorithms
//! "differ by less than 6%, and less than 1% of the total".

use super::Builder;
use super::number::{percent, significant, whole};
use super::table::{Table, escaped};
use crate::frame::sheet::{PaperError, Row, Sheet};

/// The counts: column of the file, head.
const COUNTS: [(&str, &str); 10] = [
    ("vertices", "vertices"),
    ("polygons", "polygons"),
    ("steiner_points", "Steiner"),
    ("tetrahedra", "tetrahedra"),
    ("subpolygons", "subpol."),
    ("recovered", "recov."),
    ("flips", "flips"),
    ("crossing_tets", "cross."),
    ("largest_region", "largest"),
    ("mean_region", "mean"),
];

const SECONDS: [(&str, &str); 5] = [
    ("delaunay_seconds", "Delaunay"),
    ("segment_seconds", "segments"),
    ("cavity_seconds", "cavities"),
    ("flip_seconds", "flips"),
    ("total_seconds", "all"),
];

/// Makes the table and the numbers.
pub fn add(builder: &mut Builder, sheet: &Sheet) -> Result<String, PaperError> {
    for (name, source) in [("Paper", "paper"), ("Ours", "generated")] {
        differences(builder, sheet, name, source)?;
    }
    let mut broken = Vec::new();
    let ours = sheet.rows(&[("source", "generated")])?;
    for row in &ours {
        let good = [("outcome", "ok"), ("agrees", "true"), ("verified", "true")];
        for (column, value) in good {
            if row.text(column)? != value {
                broken.push(format!("table1.csv: {}; {column}", row.text("model")?));
            }
        }
    }
    builder.claim(
        "both algorithms make the same, verified CDT of every generated model",
        broken,
    );
    let mut beside = 0.0;
    for row in &ours {
        beside += f64::from(u8::from(!row.text("beside")?.is_empty()));
    }
    let source = "table1.csv: source=generated, beside not empty; rows";
    builder.macros.whole("TableOneBeside", beside, source);
    let all = ours.len() as f64;
    builder
        .macros
        .whole("TableOneModels", all, "table1.csv: source=generated; rows");
    table(sheet)
}

/// How much the two algorithms differ, and what part of the whole they take.
fn differences(
    builder: &mut Builder,
    sheet: &Sheet,
    name: &str,
    source: &str,
) -> Result<(), PaperError> {
    let (mut apart, mut of_total, mut share) = (Vec::new(), Vec::new(), Vec::new());
    for row in sheet.rows(&[("source", source), ("outcome", "ok")])? {
        let [_, _, cavity, flip, total] = SECONDS.map(|(column, _)| row.optional(column));
        let (Some(cavity), Some(flip), Some(total)) = (cavity?, flip?, total?) else {
            continue;
        };
        if cavity > 0.0 {
            apart.push((flip - cavity).abs() / cavity);
        }
        of_total.push((flip - cavity).abs() / total);
        share.push(cavity / total);
    }
    let m = &mut builder.macros;
    let from = |what: &str| format!("table1.csv: source={source}, outcome=ok; {what}, percent");
    let apart_of = from("|flip_seconds - cavity_seconds| / cavity_seconds");
    m.range(&format!("TableOne{name}Apart"), &apart, percent, &apart_of)?;
    let total_of = from("|flip_seconds - cavity_seconds| / total_seconds");
    m.range(
        &format!("TableOne{name}OfTotal"),
        &of_total,
        percent,
        &total_of,
    )?;
    let share_of = from("cavity_seconds / total_seconds");
    m.range(&format!("TableOne{name}Share"), &share, percent, &share_of)
}

/// Each of the original's columns with ours beside it, as rows, then the other built-in models. Of other models only those that the
/// original has are shown.
fn table(sheet: &Sheet) -> Result<String, PaperError> {
    let mut heads = vec!["model"];
    heads.extend(COUNTS.iter().chain(&SECONDS).map(|(_, head)| head));
    let columns = format!("@{{}}l{}@{{}}", "r".repeat(heads.len() - 1));
    let mut table = Table::new(&columns, &heads);
    let mut others = Vec::new();
    for original in sheet.rows(&[("source", "paper")])? {
        let model = original.text("model")?;
        table.row(&cells(&original, &format!("\\emph{{{}}}", escaped(model)))?);
        for row in sheet.rows(&[("beside", model)])? {
            if row.text("source")? != "paper" {
                table.row(&cells(&row, &escaped(row.text("model")?))?);
            }
        }
    }
    for row in sheet.rows(&[("source", "generated"), ("beside", "")])? {
        others.push(cells(&row, &escaped(row.text("model")?))?);
    }
    if !others.is_empty() {
        table.rule();
    }
    others.iter().for_each(|cells| table.row(cells));
    Ok(table.into_text("table1.csv"))
}

fn cells(row: &Row, name: &str) -> Result<Vec<String>, PaperError> {
    let mut cells = vec![name.to_string()];
    let ok = row.text("outcome")? == "ok";
    for (column, _) in COUNTS {
        let value = row.optional(column)?;
        cells.push(value.map_or("--".to_string(), whole));
    }
    for (column, _) in SECONDS {
        let value = row.optional(column)?;
        cells.push(match value {
            Some(seconds) => significant(seconds, 3),
            None if !ok && column == "total_seconds" => escaped(row.text("outcome")?),
            None => "--".to_string(),
        });
    }
    Ok(cells)
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEAD: &str = "source,model,beside,vertices,polygons,steiner_points,tetrahedra,subpolygons,recovered,flips,\
        crossing_tets,largest_region,mean_region,delaunay_seconds,segment_seconds,cavity_seconds,flip_seconds,\
        total_seconds,outcome,agrees,verified\n";

    #[test]
    fn ours_are_beside_the_originals() {
        let rows = "paper,A,A,10,20,1,30,40,2,3,4,5,6.0,0.1,0.2,0.10,0.11,1.0,ok,,\n\
            generated,kind/1/20,A,11,20,1,30,40,2,3,4,5,6.5,0.1,0.2,0.2,0.1,0.5,ok,true,true\n\
            generated,other/1/9,,11,20,1,30,40,2,3,4,5,,,,,,,stuck,,\n\
            models,mine.off,,11,20,1,30,40,2,3,4,5,,,,,,,ok,,\n";
        let sheet = Sheet::parse("table1.csv", &format!("{HEAD}{rows}")).expect("a CSV");
        let mut builder = Builder::default();
        let text = add(&mut builder, &sheet).expect("complete");
        let lines: Vec<&str> = text.lines().filter(|l| l.contains(" & ")).collect();
        assert_eq!(lines.len(), 4, "{text}");
        assert!(
            lines[1].starts_with("\\emph{A} & 10 & 20 & 1 & 30"),
            "{text}"
        );
        assert!(lines[2].starts_with("kind/1/20 & 11"), "{text}");
        assert!(
            lines[3].ends_with("-- & -- & -- & -- & -- & stuck \\\\"),
            "{text}"
        );
        let numbers = builder.macros.into_text();
        assert!(
            numbers.contains("\\newcommand{\\TableOnePaperApartMost}{10.0}"),
            "{numbers}"
        );
        assert!(
            numbers.contains("\\newcommand{\\TableOneOursOfTotalMost}{20.0}"),
            "{numbers}"
        );
        let claim = &builder.generated.claims[0];
        assert_eq!(claim.contradictions.len(), 3, "{claim}");
    }
}
