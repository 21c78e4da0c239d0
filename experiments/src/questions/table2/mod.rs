//! Table 2: what polygon insertion spends its time on.
//!
//! **Question.** Which part of the time of each algorithm goes into its tasks? The paper's cavities spend most of it on
//! the Delaunay tetrahedralizations of the cavities, its flips on computing flip times.
//!
//! **Inputs.** The models of Table 1 ([`crate::inputs::suite`]), and two scenes of `fig9`, whose regions are large. The
//! clock is read at the ends of the tasks, so that these times are a little longer than those of Table 1.
//!
//! **Columns.** [`Row`]; the README of this package has their meaning.
//!
//! **Expected.** All built-in models succeed, and the tasks are no more than the whole; asserted at the end.

mod measure;
pub mod paper;

use crate::frame::{About, Answer, Context, Expectation, Experiment, Failed, check_rows};
use crate::inputs::slab::Slab;
use crate::inputs::suite;
use crate::measure::outcome;
use serde::Serialize;
use tetflip::exchange::Plc;

/// The table.
pub struct Table2;

impl Experiment for Table2 {
    fn about(&self) -> About {
        About {
            name: "table2",
            question: "shares of the time of polygon insertion by task (Table 2)",
            seconds: 10,
        }
    }

    fn run(&self, context: &Context) -> Result<Answer, Failed> {
        // Scenes of `fig9` with about so many crossing tetrahedra.
        let sizes: &[u64] = if context.quick {
            &[300]
        } else {
            &[1000, 30_000]
        };
        let of_scene = |size: &u64| Of {
            source: "scene",
            model: format!("slab/{size}"),
            ..Of::default()
        };
        let scenes = sizes
            .iter()
            .map(|size| (of_scene(size), Some(Slab::crossing(*size).plc())));
        let models = suite::all(context)?.into_iter().map(|m| {
            let plc = m.plc().ok();
            (
                Of {
                    source: m.source,
                    model: m.name,
                    beside: m.beside,
                },
                plc,
            )
        });
        let inputs: Vec<(Of, Option<Plc>)> = scenes.chain(models).collect();
        let rounds = if context.quick { 1 } else { 5 };
        let measure = |(of, plc): &(Of, Option<Plc>)| {
            plc.as_ref()
                .map_or(Vec::new(), |plc| measure::measure(of, plc, rounds))
        };
        let mut rows = of_paper();
        rows.extend(context.measure(&inputs, |_| 1, |input| input.0.model.clone(), measure));
        let mut answer = context.answer();
        let shown = "model beside insertion crossing_tets seconds cavity_delaunay cavity_faces polygon_faces merging \
                     queueing flipping other";
        answer.csv("table2", &rows, shown)?;
        answer.expectations = expectations(&rows);
        Ok(answer)
    }
}

/// What a row is of.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
struct Of {
    source: &'static str,
    model: String,
    beside: &'static str,
}

/// `table2.csv`: one model and one algorithm: shares of its time, in per cent. The README of the package has the
/// meaning of the columns.
#[derive(Clone, Debug, Default, PartialEq)]
struct Row {
    of: Of,
    run: Run,
    shares: Shares,
    end: End,
}

crate::row_of_groups!(Row: of, run, shares, end);

#[derive(Clone, Debug, Default, PartialEq, Serialize)]
struct Run {
    insertion: &'static str,
    crossing_tets: Option<u64>,
    seconds: Option<f64>,
}

#[derive(Clone, Debug, Default, PartialEq, Serialize)]
struct Shares {
    cavity_delaunay: Option<f64>,
    cavity_faces: Option<f64>,
    polygon_faces: Option<f64>,
    merging: Option<f64>,
    queueing: Option<f64>,
    flipping: Option<f64>,
}

impl Shares {
    fn sum(&self) -> f64 {
        let cavities = [
            self.cavity_delaunay,
            self.cavity_faces,
            self.polygon_faces,
            self.merging,
        ];
        let all = cavities.into_iter().chain([self.queueing, self.flipping]);
        all.flatten().sum()
    }
}

#[derive(Clone, Debug, Default, PartialEq, Serialize)]
struct End {
    other: Option<f64>,
    outcome: &'static str,
}

fn of_paper() -> Vec<Row> {
    let rows = paper::TABLE_2.into_iter().flat_map(|(model, shares)| {
        let row = |insertion, shares| Row {
            of: Of {
                source: "paper",
                model: model.to_string(),
                beside: model,
            },
            run: Run {
                insertion,
                ..Run::default()
            },
            shares,
            end: End {
                other: None,
                outcome: outcome::OK,
            },
        };
        let [
            cavity_delaunay,
            cavity_faces,
            polygon_faces,
            merging,
            queueing,
            flipping,
        ] = shares.map(Some);
        let cavity = Shares {
            cavity_delaunay,
            cavity_faces,
            polygon_faces,
            merging,
            ..Shares::default()
        };
        let flip = Shares {
            queueing,
            flipping,
            ..Shares::default()
        };
        [row("cavity", cavity), row("flip", flip)]
    });
    rows.collect()
}

fn expectations(rows: &[Row]) -> Vec<Expectation> {
    check_rows(
        rows,
        |r| format!("{}, {}", r.of.model, r.run.insertion),
        &[
            ("every built-in model succeeds", &|r| {
                r.of.source == "models" || r.end.outcome == outcome::OK
            }),
            ("the tasks are no more than the whole", &|r| {
                r.end.other.is_none_or(|other| other > -0.5)
            }),
        ],
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::expectation::assert_each_can_fail;

    #[test]
    fn the_papers_shares_are_parts_of_a_whole() {
        let rows = of_paper();
        for row in &rows {
            let sum = row.shares.sum();
            assert!((70.0..100.0).contains(&sum), "{}: {sum}", row.of.model);
        }
        assert_each_can_fail(
            expectations,
            &rows,
            &[
                (&|r| r.end.outcome = "stuck", &[0]),
                (&|r| r.end.other = Some(-1.0), &[1]),
            ],
        );
    }
}
