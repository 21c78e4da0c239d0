//! The experiment of §3.4 and Figs. 8 and 9.
//!
//! **Question.** How do the times of cavity retriangulation and of flips grow with the size of the cavity, and what does
//! an exact order of the flips cost compared with the paper's rounded times?
//!
//! **Inputs.** Random vertices near the x-y plane and a rectangle in it ([`tetflip_experiments::scene`]); from about 30
//! crossing tetrahedra to 100 000, several seeds for each size. A row is the insertion of the rectangle by one method.
//!
//! **Columns.** Of `fig9.csv`: [`row::Row`]; of `fig9-summary.csv`: [`summary::Summary`]. The README of this package has
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

use clap::Parser;
use indicatif::{ProgressBar, ProgressStyle};
use plan::Plan;
use row::Row;
use std::error::Error;
use std::path::PathBuf;
use std::process::ExitCode;
use tetflip_experiments::expectation::{self, Expectation};
use tetflip_experiments::method::Method;
use tetflip_experiments::record::{Machine, Results};

/// Times of cavity retriangulation and of flips, by the number of crossing tetrahedra (paper, Fig. 9).
#[derive(Parser)]
struct Arguments {
    /// Fewer, smaller scenes: a few seconds instead of minutes.
    #[arg(long)]
    quick: bool,
    /// Where the results go. [default: results, or target/quick-results with --quick]
    #[arg(long, value_name = "DIR")]
    results: Option<PathBuf>,
}

fn main() -> ExitCode {
    match run(Arguments::parse()) {
        Ok(code) => code,
        Err(error) => {
            eprintln!("fig9: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: Arguments) -> Result<ExitCode, Box<dyn Error>> {
    let (plan, directory) = if arguments.quick {
        (Plan::quick(), "target/quick-results")
    } else {
        (Plan::full(), "results")
    };
    let directory = arguments.results.unwrap_or_else(|| directory.into());
    let commit = Machine::detect().commit;
    let results = Results::create(&directory)?;
    let methods = Method::all();
    let rows = measure_all(&plan, &methods, &commit);
    let summaries = summary::summaries(&rows, &methods);

    let mut paths = vec![
        results.rows("fig9", &rows)?,
        results.rows("fig9-summary", &summaries)?,
    ];
    for figure in plots::FIGURES {
        paths.push(results.text(figure.file, &figure.svg(&rows, &methods)?)?);
    }
    println!("Median milliseconds of the insertion of the rectangle:\n");
    println!("{}", summary::table(&summaries, &methods));
    for path in paths {
        println!("{}", path.display());
    }
    Ok(judge(&rows))
}

/// All scenes, with a progress bar if stderr is a terminal.
fn measure_all(plan: &Plan, methods: &[Method], commit: &str) -> Vec<Row> {
    let style = ProgressStyle::with_template(
        "{bar:40} {percent:>3} %  {elapsed} of about {duration}  {msg}",
    )
    .expect("a valid template");
    let bar = ProgressBar::new(plan.scenes.iter().map(plan::weight).sum()).with_style(style);
    let mut rows = Vec::new();
    for &slab in &plan.scenes {
        bar.set_message(format!("{} vertices, seed {}", slab.vertices, slab.seed));
        let scene = measure::scene(slab, methods, &plan.effort);
        rows.extend(scene.into_iter().map(|row| Row {
            commit: commit.to_string(),
            ..row
        }));
        bar.inc(plan::weight(&slab));
    }
    bar.finish_and_clear();
    rows
}

/// Says which expectations hold.
fn judge(rows: &[Row]) -> ExitCode {
    let failed = rows.iter().filter(|r| !r.is_ok());
    println!(
        "\n{} runs, {} of them failed:",
        rows.len(),
        failed.clone().count()
    );
    for row in failed {
        println!("  {}: {}, {} left", row.name(), row.outcome, row.left);
    }
    let expectations = expect::expectations(rows);
    print!("{}", expectation::text(&expectations));
    if expectations.iter().all(Expectation::holds) {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    }
}
