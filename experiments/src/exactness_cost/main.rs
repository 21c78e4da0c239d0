//! The price of exactness.
//!
//! **Question.** What do exact flip times cost, relative to the paper's rounded ones, on vertices in general position and on
//! those that make nearly every comparison a tie? How often do float enclosures decide, how often exact quotients, how
//! often the perturbation? How do flips compare with cavity retriangulation and with gift wrapping?
//!
//! **Inputs.** One rectangle through a random slab, through lattices, or through a sphere of integer points
//! ([`input`]), with 100 to 100 000 crossing tetrahedra. A row is the insertion of the rectangle by one method.
//!
//! **Columns.** [`row::Row`], [`summary::Summary`], [`summary::Target`]; the README of this package has their meaning.
//! Seconds are wall clock of the insertion alone, in one thread; all methods are timed in turns in one run. A run with
//! rounded times can fail; its time, which includes the undoing, still counts.
//!
//! **Expected.** All but rounded flips always succeed; every success is verified and all of one input are the same mesh
//! ([`expect`]), asserted at the end. The project's targets for times are reported as reached or missed, not asserted.

mod expect;
mod input;
mod measure;
mod plan;
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
use tetflip_experiments::record::{Machine, Results};

/// Times of flips by number type, relative to rounded ones, on random and on degenerate vertices.
#[derive(Parser)]
struct Arguments {
    /// Fewer, smaller inputs: a few seconds instead of minutes.
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
            eprintln!("exactness_cost: {error}");
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
    let methods = plan::methods();
    let summaries = summary::summaries(&rows, &methods);
    let targets = summary::targets(&summaries);

    let paths = [
        results.rows("exactness_cost", &rows)?,
        results.rows("exactness_cost-summary", &summaries)?,
        results.rows("exactness_cost-targets", &targets)?,
    ];
    println!("Times relative to flips with f64 times:\n");
    println!("{}", summary::table(&summaries, &methods));
    println!("{}", summary::targets_text(&targets));
    for path in paths {
        println!("{}", path.display());
    }
    Ok(judge(&rows))
}

/// All inputs, with a progress bar if stderr is a terminal.
fn measure_all(plan: &Plan, commit: &str) -> Vec<Row> {
    let style = ProgressStyle::with_template(
        "{bar:40} {percent:>3} %  {elapsed} of about {duration}  {msg}",
    )
    .expect("a valid template");
    let bar = ProgressBar::new(plan.inputs.iter().map(plan::weight).sum()).with_style(style);
    let mut rows = Vec::new();
    for input in &plan.inputs {
        bar.set_message(input.name());
        let measured = measure::measure(input, &plan::methods_for(input.about), &plan.effort);
        rows.extend(measured.into_iter().map(|row| Row {
            commit: commit.to_string(),
            ..row
        }));
        bar.inc(plan::weight(input));
    }
    bar.finish_and_clear();
    rows
}

/// Says which runs failed, and which expectations hold.
fn judge(rows: &[Row]) -> ExitCode {
    let failed: Vec<&Row> = rows.iter().filter(|r| !r.is_ok()).collect();
    println!("\n{} runs, {} of them failed:", rows.len(), failed.len());
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
