//! Growth over three orders of magnitude.
//!
//! **Question.** How do the times of flips in exact order and of cavity retriangulation grow with the size of the region?
//! Flips need O(n log n) time for n flips (Shewchuk 2003), cavities little more than linear time in practice.
//!
//! **Inputs.** The scene of the paper's Fig. 8 ([`tetflip_experiments::scene`]) with 1000 to 1 000 000 crossing
//! tetrahedra, one seed. A row is the insertion of the rectangle by one method.
//!
//! **Columns.** [`row::Row`], [`row::Summary`]; the README of this package has their meaning. Seconds are wall clock of the
//! insertion alone, in one thread.
//!
//! **Expected.** Both methods succeed at every size and give the same tetrahedra ([`expect`]); asserted at the end. Nothing
//! is asserted of times.

mod expect;
mod fit;
mod measure;
mod plan;
mod plots;
mod row;

use clap::Parser;
use indicatif::{ProgressBar, ProgressStyle};
use plan::{METHODS, Plan};
use row::Row;
use std::error::Error;
use std::path::PathBuf;
use std::process::ExitCode;
use tetflip_experiments::expectation::{self, Expectation};
use tetflip_experiments::record::{Machine, Results};

/// Times of flips and of cavity retriangulation up to a million crossing tetrahedra.
#[derive(Parser)]
struct Arguments {
    /// Only small sizes: a few seconds instead of minutes.
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
            eprintln!("growth: {error}");
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
    let rows = measure_all(&plan, &commit);
    let summaries = row::summaries(&rows, &METHODS, &commit);

    let paths = [
        results.rows("growth", &rows)?,
        results.rows("growth-summary", &summaries)?,
        results.text("growth.svg", &plots::growth(&rows, &METHODS)?)?,
    ];
    println!("{}", row::table(&rows, &summaries));
    for path in paths {
        println!("{}", path.display());
    }
    let expectations = expect::expectations(&rows);
    print!("\n{}", expectation::text(&expectations));
    Ok(if expectations.iter().all(Expectation::holds) {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    })
}

/// All sizes, with a progress bar if stderr is a terminal.
fn measure_all(plan: &Plan, commit: &str) -> Vec<Row> {
    let style = ProgressStyle::with_template(
        "{bar:40} {percent:>3} %  {elapsed} of about {duration}  {msg}",
    )
    .expect("a valid template");
    let bar = ProgressBar::new(plan.sizes.iter().sum()).with_style(style);
    let mut rows = Vec::new();
    for &size in &plan.sizes {
        bar.set_message(format!("about {size} crossing tetrahedra"));
        let measured = measure::measure(plan::slab(size), &METHODS, &plan.effort(size));
        rows.extend(measured.into_iter().map(|row| Row {
            commit: commit.to_string(),
            ..row
        }));
        bar.inc(size);
    }
    bar.finish_and_clear();
    rows
}
