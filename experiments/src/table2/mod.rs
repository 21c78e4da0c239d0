//! Table 2: what polygon insertion spends its time on.
//!
//! **Question.** Which part of the time of each algorithm goes into its tasks? The paper's cavities spend most of it on the
//! Delaunay tetrahedralizations of the cavities, its flips on computing flip times.
//!
//! **Inputs.** The models of Table 1 ([`crate::suite`]), and two scenes of `fig9`, whose regions are large. The clock is read at
//! the ends of the tasks, so that these times are a little longer than those of Table 1.
//!
//! **Columns.** [`Row`]; the README of this package has their meaning.
//!
//! **Expected.** All built-in models succeed, and the tasks are no more than the whole; asserted at the end.

mod measure;
pub mod paper;

use crate::expectation::{Check, check_rows};
use crate::experiment::{Answer, Context, Experiment};
use crate::outcome;
use crate::suite;
use serde::Serialize;
use std::error::Error;

/// The table.
pub const EXPERIMENT: Experiment = Experiment {
    name: "table2",
    question: "shares of the time of polygon insertion by task (Table 2)",
    seconds: 10,
    run,
};

/// One model and one algorithm: shares of its time, in per cent. The README of the package has the meaning of the columns.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Row {
    source: &'static str,
    model: String,
    beside: &'static str,
    insertion: &'static str,
    crossing_tets: Option<u64>,
    seconds: Option<f64>,
    cavity_delaunay: Option<f64>,
    cavity_faces: Option<f64>,
    polygon_faces: Option<f64>,
    merging: Option<f64>,
    queueing: Option<f64>,
    flipping: Option<f64>,
    other: Option<f64>,
    outcome: &'static str,
}

fn run(context: &Context) -> Result<Answer, Box<dyn Error>> {
    let mut models = suite::built_in(context.quick);
    if let Some(directory) = &context.models {
        models.extend(suite::of_directory(directory)?);
    }
    let bar = context.bar(models.len() as u64);
    let mut rows: Vec<Row> = of_paper();
    let rounds = if context.quick { 1 } else { 5 };
    for scene in measure::scenes(context.quick) {
        rows.extend(measure::measure(&scene.0, "scene", "", &scene.1, rounds));
    }
    for model in &models {
        bar.set_message(model.name.clone());
        if let Ok(plc) = model.plc() {
            rows.extend(measure::measure(
                &model.name,
                model.source,
                model.beside,
                &plc,
                rounds,
            ));
        }
        bar.inc(1);
    }
    bar.finish_and_clear();
    let checks: [Check<Row>; 2] = [
        ("every built-in model succeeds", &|r| {
            r.source == "models" || r.outcome == outcome::OK
        }),
        ("the tasks are no more than the whole", &|r| {
            r.other.is_none_or(|other| other > -0.5)
        }),
    ];
    let expectations = check_rows(&rows, &checks, |r| format!("{}, {}", r.model, r.insertion));
    Ok(Answer {
        text: table(&rows),
        files: vec![context.record("table2", &rows)?],
        expectations,
    })
}

fn of_paper() -> Vec<Row> {
    let rows = paper::TABLE_2.into_iter().flat_map(|(model, shares)| {
        let row = |insertion| Row {
            source: "paper",
            model: model.to_string(),
            beside: model,
            insertion,
            outcome: outcome::OK,
            ..Row::default()
        };
        let [delaunay, faces, polygon, merging, queueing, flipping] = shares.map(Some);
        [
            Row {
                cavity_delaunay: delaunay,
                cavity_faces: faces,
                polygon_faces: polygon,
                merging,
                ..row("cavity")
            },
            Row {
                queueing,
                flipping,
                ..row("flip")
            },
        ]
    });
    rows.collect()
}

fn table(rows: &[Row]) -> String {
    let mut text = format!(
        "{:<22} {:<14} {:<7} {:>9} {:>9} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6}\n",
        "model",
        "beside",
        "by",
        "crossing",
        "ms",
        "(1)",
        "(2)",
        "(3)",
        "(4)",
        "(5)",
        "(6)",
        "other"
    );
    let percent = |x: Option<f64>| x.map_or(String::new(), |x| format!("{x:.1}"));
    for r in rows {
        text += &format!(
            "{:<22} {:<14} {:<7} {:>9} {:>9} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6}\n",
            r.model,
            r.beside,
            r.insertion,
            r.crossing_tets.map_or(String::new(), |n| n.to_string()),
            r.seconds
                .map_or(String::new(), |s| format!("{:.2}", s * 1e3)),
            percent(r.cavity_delaunay),
            percent(r.cavity_faces),
            percent(r.polygon_faces),
            percent(r.merging),
            percent(r.queueing),
            percent(r.flipping),
            percent(r.other),
        );
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_papers_shares_are_parts_of_a_whole() {
        for row in of_paper() {
            let shares = [
                row.cavity_delaunay,
                row.cavity_faces,
                row.polygon_faces,
                row.merging,
                row.queueing,
                row.flipping,
            ];
            let sum: f64 = shares.into_iter().flatten().sum();
            assert!((70.0..100.0).contains(&sum), "{}: {sum}", row.model);
        }
    }
}
