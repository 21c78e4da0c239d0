//! The table of `fig9-tetgen.csv`: TetGen's two modes on the scenes of Fig. 9.

use super::Builder;
use super::number::{ratio, whole};
use super::table::Table;
use crate::frame::sheet::{PaperError, Row, Sheet};
use crate::measure::sample::median;

/// First numbers of crossing tetrahedra of the classes: those of the original's two plots, and beyond.
const CLASSES: [f64; 3] = [0.0, 103.0, 1841.0];

/// By class and mode: scenes, those that end in the CDT, and medians of the ratios of ours to its time, and of the time of
/// its flips to that of its cavities.
pub fn table(builder: &mut Builder, sheet: &Sheet) -> Result<String, PaperError> {
    let heads = [
        "crossing tetrahedra",
        "mode",
        "scenes",
        "the CDT",
        "$\\frac{\\text{ours}}{\\text{TetGen}}$",
        "$\\frac{\\text{TetGen's flips}}{\\text{TetGen's cavities}}$",
    ];
    let mut table = Table::new("@{}rlrrrr@{}", &heads);
    let (mut runs, mut cdts) = (0, 0);
    for (i, &from) in CLASSES.iter().enumerate() {
        let below = CLASSES.get(i + 1).copied().unwrap_or(f64::INFINITY);
        for mode in ["cavity", "flips"] {
            let mut class = Vec::new();
            for row in sheet.rows(&[("mode", mode)])? {
                let crossing = row.number("crossing_tets")?;
                if crossing >= from && crossing < below {
                    class.push(row);
                }
            }
            if class.is_empty() {
                continue;
            }
            let (mut good, mut ours, mut slower) = (0, Vec::new(), Vec::new());
            for row in &class {
                good +=
                    usize::from(row.text("outcome")? == "ok" && row.text("verified")? == "true");
                ours.extend(row.optional("ours_over_tetgen")?);
                slower.extend(over_cavity(sheet, row)?);
            }
            (runs, cdts) = (runs + class.len(), cdts + good);
            let cell = |sample: &[f64]| median(sample).map_or("--".to_string(), ratio);
            let range = match below {
                f64::INFINITY => format!("from {}", whole(from)),
                _ => format!("{} to {}", whole(from), whole(below - 1.0)),
            };
            table.row(&[
                range,
                mode.to_string(),
                whole(class.len() as f64),
                whole(good as f64),
                cell(&ours),
                if mode == "flips" {
                    cell(&slower)
                } else {
                    String::new()
                },
            ]);
        }
    }
    let m = &mut builder.macros;
    m.whole("ModesRuns", runs as f64, "fig9-tetgen.csv: rows");
    let source = "fig9-tetgen.csv: rows with outcome=ok and verified=true";
    m.whole("ModesCDTs", cdts as f64, source);
    Ok(table.into_text("fig9-tetgen.csv: by class of crossing_tets; medians"))
}

/// The time of a row over that of cavities in the same scene.
fn over_cavity(sheet: &Sheet, row: &Row) -> Result<Option<f64>, PaperError> {
    let scene = [
        ("vertices", row.text("vertices")?),
        ("seed", row.text("seed")?),
        ("mode", "cavity"),
    ];
    let cavity = sheet.row(&scene)?.optional("median_seconds")?;
    let own = row.optional("median_seconds")?;
    Ok(own.zip(cavity).map(|(own, cavity)| own / cavity))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn classes_and_modes() {
        let text = "seed,vertices,crossing_tets,mode,median_seconds,outcome,verified,ours_over_tetgen\n\
                    1,30,91,cavity,0.001,ok,true,0.5\n1,30,91,flips,0.003,ok,false,0.25\n\
                    1,900,3000,cavity,0.01,ok,true,0.4\n";
        let sheet = Sheet::parse("fig9-tetgen.csv", text).expect("a sheet");
        let mut builder = Builder::default();
        let table = table(&mut builder, &sheet).expect("a table");
        assert!(
            table.contains("0 to 102 & flips & 1 & 0 & 0.25 & 3.00"),
            "{table}"
        );
        assert!(table.contains("cavity & 1 & 1 & 0.40 &  \\\\"), "{table}");
        let numbers = builder.macros.into_text();
        assert!(numbers.contains("\\ModesCDTs}{2}"), "{numbers}");
    }
}
