//! The experiment of §3.4 and Figs. 8 and 9.
//!
//! **Question.** How do the times of cavity retriangulation and of flips grow with the size of the cavity, and what does
//! an exact order of the flips cost compared with the paper's rounded times?
//!
//! **Inputs.** Random vertices near the x-y plane and a rectangle in it ([`crate::scene`]); from about 30
//! crossing tetrahedra to 100 000, several seeds for each size. A row is the insertion of the rectangle by one method.
//!
//! TetGen inserts the same rectangles where it is installed, in its two modes ([`tetgen`]).
//!
//! **Columns.** Of `fig9.csv`: [`row::Row`]; of `fig9-summary.csv`: [`summary::Summary`]; of `fig9-tetgen.csv`: [`tetgen::Row`]. The README of this package has
//! their meaning. Seconds are wall clock of the polygon insertion alone, in one thread.
//!
//! **Expected.** Cavities and exact flips always succeed; every success is verified and all of one scene are the same
//! mesh ([`expect`]). Flips with rounded times may fail: then the row has the outcome. Asserted at the end.

mod expect;
mod measure;
mod plan;
mod plots;
mod row;
mod summary;
mod tetgen;

use crate::experiment::{Answer, Context, Experiment};
use crate::method::Method;
use crate::outcome;
use crate::scene::Slab;
use plan::Plan;
use row::Row;
use std::error::Error;

/// The figure.
pub const EXPERIMENT: Experiment = Experiment {
    name: "fig9",
    question: "time of both algorithms by the number of crossing tetrahedra (paper, Fig. 9)",
    seconds: 205,
    run,
};

fn run(context: &Context) -> Result<Answer, Box<dyn Error>> {
    let plan = context.plan(Plan::quick, Plan::full);
    let methods = Method::all();
    let rows = measure_all(&plan, &methods, context);
    let summaries = summary::summaries(&rows, &methods);

    let results = &context.results;
    let mut files = vec![
        context.record("fig9", &rows)?,
        context.record("fig9-summary", &summaries)?,
    ];
    for figure in plots::FIGURES {
        files.push(results.text(figure.file, &figure.svg(&rows, &methods)?)?);
    }
    let mut text = format!(
        "Median milliseconds of the insertion of the rectangle:\n\n{}\n{}",
        summary::table(&summaries, &methods),
        outcome::failures(&rows, |r| (r.name(), r.outcome, r.left))
    );
    if let Some(program) = &context.tetgen {
        let name = |slab: &Slab| format!("TetGen, {} vertices, seed {}", slab.vertices, slab.seed);
        let beside = context.measure(&plan.scenes, plan::weight, name, |&slab| {
            tetgen::measure(program, slab, &rows, context.limit)
        });
        files.push(context.record("fig9-tetgen", &beside)?);
        files.push(results.text("fig9-tetgen.svg", &plots::beside_tetgen(&rows, &beside)?)?);
        text += &tetgen::text(&beside);
    } else {
        text += "skipped: TetGen is not installed\n";
    }
    Ok(Answer {
        text,
        files,
        expectations: expect::expectations(&rows),
    })
}

/// All scenes.
fn measure_all(plan: &Plan, methods: &[Method], context: &Context) -> Vec<Row> {
    let name = |slab: &Slab| format!("{} vertices, seed {}", slab.vertices, slab.seed);
    context.measure(&plan.scenes, plan::weight, name, |&slab| {
        measure::scene(slab, methods, &plan.effort)
    })
}
