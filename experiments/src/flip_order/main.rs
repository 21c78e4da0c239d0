//! The order of flips, rounded and exact (§3.3 and the failure case of §3.4).
//!
//! **Question.** How often do flips come off the queue in the wrong order when their times are rounded, what do the
//! paper's three patches make of it, how often does the insertion fail, and what is left then? Does the exact order, with the
//! perturbation, always succeed?
//!
//! **Inputs.** Small PLCs of nine families ([`tetflip_experiments::family`]) that make ties, near ties and large rounding
//! errors; every polygon is exactly flat.
//!
//! **Columns.** [`row::Summary`], [`row::FailureRow`]; the README of this package has their meaning.
//!
//! **Expected.** Every exact number type succeeds on every input, without a patch and without an inversion, and ends in the
//! tetrahedra of cavity retriangulation ([`expect`]). Rounded times may fail. Asserted at the end.

mod expect;
mod measure;
mod plan;
mod plots;
mod replay;
mod row;

use clap::Parser;
use indicatif::{ProgressBar, ProgressStyle};
use measure::Measured;
use plan::Plan;
use std::error::Error;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::atomic::{AtomicUsize, Ordering};
use tetflip_experiments::expectation::{self, Expectation};
use tetflip_experiments::family::Member;
use tetflip_experiments::record::{Machine, Results};

/// The order of flips with rounded and with exact times (paper, §3.3, and the failure case of §3.4).
#[derive(Parser)]
struct Arguments {
    /// Fewer inputs: a few seconds instead of minutes.
    #[arg(long)]
    quick: bool,
    /// Where the results go. [default: results, or target/quick-results with --quick]
    #[arg(long, value_name = "DIR")]
    results: Option<PathBuf>,
    /// Runs one input, FAMILY/SUBFAMILY:SEED, and says what happens; nothing is recorded.
    #[arg(long, value_name = "INPUT")]
    replay: Option<Member>,
    /// The number type of the replay.
    #[arg(long, value_name = "TIMES", default_value = "f64", requires = "replay")]
    times: String,
    /// Writes the PLC of the replay to this file.
    #[arg(long, value_name = "FILE.poly", requires = "replay")]
    write: Option<PathBuf>,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let done = match arguments.replay {
        Some(member) => replay_one(member, &arguments),
        None => run(&arguments),
    };
    match done {
        Ok(code) => code,
        Err(error) => {
            eprintln!("flip_order: {error}");
            ExitCode::FAILURE
        }
    }
}

fn replay_one(member: Member, arguments: &Arguments) -> Result<ExitCode, Box<dyn Error>> {
    let times = plan::number_type(&arguments.times)
        .ok_or_else(|| format!("unknown number type `{}`", arguments.times))?;
    if let Some(path) = &arguments.write {
        std::fs::write(path, replay::poly(&member.prepare().plc))?;
    }
    print!("{}", replay::replay(member, times));
    Ok(ExitCode::SUCCESS)
}

fn run(arguments: &Arguments) -> Result<ExitCode, Box<dyn Error>> {
    let (plan, directory) = if arguments.quick {
        (Plan::quick(), "target/quick-results")
    } else {
        (Plan::full(), "results")
    };
    let directory = arguments
        .results
        .clone()
        .unwrap_or_else(|| directory.into());
    let commit = Machine::detect().commit;
    let results = Results::create(&directory)?;
    let inputs = measure_all(&plan);
    let rows = row::summaries(&inputs, &plan, &commit);

    let failures = row::failures(&inputs);
    let paths = [
        results.rows("flip_order", &rows)?,
        results.rows("flip_order-failures", &failures)?,
        results.text("flip_order-precision.svg", &plots::precision(&rows)?)?,
    ];
    println!("{}\n", row::table(&rows, &plan));
    for path in paths {
        println!("{}", path.display());
    }
    let runs: usize = inputs.iter().map(|m| m.runs.len()).sum();
    println!(
        "\n{} inputs, {runs} runs, {} failed",
        inputs.len(),
        failures.len()
    );
    Ok(judge(&inputs))
}

/// All inputs, on all processors, in the order of the plan.
fn measure_all(plan: &Plan) -> Vec<Measured> {
    let members = Member::all(plan.seeds);
    let style =
        ProgressStyle::with_template("{bar:40} {percent:>3} %  {elapsed} of about {duration}")
            .expect("a valid template");
    let bar = ProgressBar::new(members.len() as u64).with_style(style);
    let next = AtomicUsize::new(0);
    let work = || {
        let mut measured = Vec::new();
        while let Some(&member) = members.get(next.fetch_add(1, Ordering::Relaxed)) {
            measured.push(measure::measure(member, plan));
            bar.inc(1);
        }
        measured
    };
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let mut inputs: Vec<Measured> = std::thread::scope(|scope| {
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        let done = workers
            .into_iter()
            .map(|w| w.join().expect("no worker panics"));
        done.flatten().collect()
    });
    bar.finish_and_clear();
    inputs.sort_by_key(|m| m.member.key());
    inputs
}

/// Says which expectations hold.
fn judge(inputs: &[Measured]) -> ExitCode {
    let expectations = expect::expectations(inputs);
    print!("{}", expectation::text(&expectations));
    if expectations.iter().all(Expectation::holds) {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    }
}
