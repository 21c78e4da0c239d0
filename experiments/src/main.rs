//! Runs the experiments, each in a process of its own, so that none takes down or warms up another, and tells how far it is.

use clap::{Parser, Subcommand};
use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};
use std::time::{Duration, Instant};
use tetflip_experiments::expectation;
use tetflip_experiments::experiment::{ALL, Context, Experiment};
use tetflip_experiments::family::Member;
use tetflip_experiments::ledger::{Entry, Ledger};
use tetflip_experiments::record::{Machine, Results};
use tetflip_experiments::steiner::rival::Rival;
use tetflip_experiments::{flip_order, paper, report, rivals, scaling, threads};

/// The experiments of tetflip: CSV files and plots in results/.
///
/// What has succeeded with the very same sources is not run again, so that an interrupted run can be resumed.
#[derive(Parser)]
#[command(version, args_conflicts_with_subcommands = true)]
struct Program {
    #[command(subcommand)]
    command: Option<Verb>,
    #[command(flatten)]
    run: Arguments,
}

#[derive(Subcommand)]
enum Verb {
    /// Lists the experiments and what they ask.
    List,
    /// Runs one input of `flip_order`, FAMILY/SUBFAMILY:SEED, and tells what happens; nothing is recorded.
    Replay {
        /// The input.
        input: Member,
        /// The number type of the flip times.
        #[arg(long, default_value = "f64")]
        times: String,
        /// Writes the PLC to this file, too.
        #[arg(long, value_name = "FILE.poly")]
        write: Option<PathBuf>,
    },
    /// Writes the tables, plots and numbers of the paper, all from the CSV files of the results.
    Paper {
        /// The results.
        #[arg(long, value_name = "DIR", default_value = "results")]
        results: PathBuf,
        /// Where the files go.
        #[arg(short, long, value_name = "DIR", default_value = "paper/generated")]
        output: PathBuf,
        /// Writes nothing, and fails if there is anything to write.
        #[arg(long)]
        check: bool,
    },
    /// Makes a page of results, `report.html`; running all experiments ends with it.
    Report {
        /// The results.
        #[arg(long, value_name = "DIR", default_value = "results")]
        results: PathBuf,
        /// The page. [default: report.html beside the results]
        #[arg(short, long, value_name = "FILE")]
        output: Option<PathBuf>,
    },
    /// This library as one of the programs that the experiment `rivals` runs.
    #[command(hide = true)]
    Contestant {
        what: String,
        input: PathBuf,
        threads: usize,
    },
    /// One size of the experiment `scaling`.
    #[command(hide = true)]
    Scale { what: String, size: usize },
    /// Runs a program for so many seconds at most and tells its memory.
    #[command(hide = true)]
    Limited {
        seconds: u64,
        program: String,
        #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
        arguments: Vec<String>,
    },
}

#[derive(Parser)]
struct Arguments {
    /// The same questions in seconds instead of minutes.
    #[arg(long)]
    quick: bool,
    /// Only these experiments.
    #[arg(long, value_name = "NAME", value_delimiter = ',', value_parser = names())]
    only: Vec<String>,
    /// Where the results go. [default: results, or target/quick-results with --quick]
    #[arg(long, value_name = "DIR")]
    results: Option<PathBuf>,
    /// Run again what has succeeded with the same sources.
    #[arg(long)]
    again: bool,
    /// A directory of models, for the experiments that take some.
    #[arg(long, value_name = "DIR")]
    models: Option<PathBuf>,
    /// TetGen, to compare with where it is installed.
    #[arg(long, value_name = "PROGRAM", default_value = "tetgen")]
    tetgen: String,
    /// A Python that has gmsh, to compare with.
    #[arg(long, value_name = "PROGRAM", default_value = "python3")]
    python: String,
    /// More programs that take TetGen's switches and files.
    #[arg(long, value_name = "NAME=PROGRAM[:SWITCHES]")]
    rival: Vec<Rival>,
    /// How long another program may take for one model.
    #[arg(long, value_name = "SECONDS", default_value_t = 60)]
    limit: u64,
    /// Run this experiment in this process.
    #[arg(long, hide = true, value_name = "NAME", value_parser = names())]
    here: Option<String>,
}

fn names() -> clap::builder::PossibleValuesParser {
    ALL.iter().map(|e| e.name).collect::<Vec<_>>().into()
}

fn main() -> ExitCode {
    let Program { command, run } = Program::parse();
    let number = match &command {
        Some(Verb::Contestant { threads, .. }) => *threads,
        _ => 1,
    };
    let pool = threads::pool(number);
    if let Err(error) = pool.build_global() {
        eprintln!("experiments: {error}");
        return ExitCode::FAILURE;
    }
    let done = match command {
        Some(Verb::List) => {
            list();
            Ok(true)
        }
        Some(Verb::Replay {
            input,
            times,
            write,
        }) => replay(input, &times, write.as_deref()),
        Some(Verb::Paper {
            results,
            output,
            check,
        }) => write_paper(&results, &output, check),
        Some(Verb::Report { results, output }) => make_report(&results, output),
        Some(Verb::Contestant { what, input, .. }) => {
            rivals::take_part(&what, &input).map(|()| true)
        }
        Some(Verb::Scale { what, size }) => scaling::take_part(&what, size).map(|()| true),
        Some(Verb::Limited {
            seconds,
            program,
            arguments,
        }) => rivals::limited(seconds, &program, &arguments).map_err(Into::into),
        None => match run.here.clone() {
            Some(name) => run_here(&name, run),
            None => run_all(&run),
        },
    };
    match done {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("experiments: {error}");
            ExitCode::FAILURE
        }
    }
}

fn list() {
    for e in &ALL {
        println!("{:<16} {:>4} s  {}", e.name, e.seconds, e.question);
    }
}

fn replay(input: Member, times: &str, write: Option<&Path>) -> Result<bool, Box<dyn Error>> {
    let number = flip_order::plan::number_type(times)
        .ok_or_else(|| format!("unknown number type `{times}`"))?;
    if let Some(path) = write {
        tetflip::format::write_poly(path, &input.prepare().plc)?;
    }
    print!("{}", flip_order::replay::replay(input, number));
    Ok(true)
}

/// Whether the files are up to date, with `check`, and the sentences of the paper true.
fn write_paper(results: &Path, output: &Path, check: bool) -> Result<bool, Box<dyn Error>> {
    let generated = paper::generate(results)?;
    let mut good = true;
    if check {
        for stale in paper::stale(&generated, output)? {
            eprintln!("{}/{stale}", output.display());
            good = false;
        }
    } else {
        let files = paper::write(&generated, output)?;
        println!("{files} files in {}", output.display());
    }
    for claim in generated.claims.iter().filter(|claim| !claim.holds()) {
        eprintln!("{claim}");
        good = false;
    }
    Ok(good)
}

fn make_report(results: &Path, output: Option<PathBuf>) -> Result<bool, Box<dyn Error>> {
    let path = report::write(results, output)?;
    println!("{}", path.display());
    Ok(true)
}

impl Arguments {
    fn directory(&self) -> PathBuf {
        let default = if self.quick {
            "target/quick-results"
        } else {
            "results"
        };
        self.results.clone().unwrap_or_else(|| default.into())
    }

    fn form(&self) -> &'static str {
        if self.quick { "quick" } else { "full" }
    }
}

/// All that are wanted, one after the other; whether all have succeeded.
fn run_all(arguments: &Arguments) -> Result<bool, Box<dyn Error>> {
    let wanted = |e: &&Experiment| {
        arguments.only.is_empty() || arguments.only.iter().any(|name| name == e.name)
    };
    let wanted: Vec<&Experiment> = ALL.iter().filter(wanted).collect();
    let results = Results::create(&arguments.directory())?;
    let mut ledger = Ledger::read(&results);
    let (form, commit) = (arguments.form(), Machine::detect().commit);
    let total = wanted.len();
    let mut bad = Vec::new();
    for (i, experiment) in wanted.iter().enumerate() {
        let name = experiment.name;
        if !arguments.again && ledger.has(name, form, &commit) {
            println!(
                "[{}/{total}] {name}: has been run with these sources; --again repeats it",
                i + 1
            );
            continue;
        }
        let left = wanted[i..].iter().map(|e| e.seconds);
        println!(
            "[{}/{total}] {name}: {}{}",
            i + 1,
            experiment.question,
            remaining(arguments.quick, left)
        );
        let start = Instant::now();
        let status = child(name)?;
        let outcome = match status.code() {
            Some(0) => "ok",
            Some(1) => "broken",
            _ => "failed",
        };
        let seconds = start.elapsed().as_secs_f64();
        println!("{name}: {outcome}, {seconds:.1} s\n");
        if outcome != "ok" {
            bad.push(name);
        }
        let entry = Entry {
            experiment: name.to_string(),
            form: form.to_string(),
            seconds: (seconds * 10.0).round() / 10.0,
            outcome: outcome.to_string(),
            commit: commit.clone(),
        };
        ledger.record(&results, entry)?;
    }
    println!("results are in {}", results.directory().display());
    make_report(results.directory(), None)?;
    if !bad.is_empty() {
        println!("not as expected: {}", bad.join(", "));
    }
    Ok(bad.is_empty())
}

/// What this and the following experiments take, in the full form.
fn remaining(quick: bool, seconds: impl Iterator<Item = u64>) -> String {
    let seconds: u64 = seconds.sum();
    if quick {
        return String::new();
    }
    format!(
        " (about {} min for this and the rest)",
        seconds.div_ceil(60)
    )
}

/// This program again, with the same arguments, for one experiment.
fn child(name: &str) -> std::io::Result<std::process::ExitStatus> {
    Command::new(std::env::current_exe()?)
        .args(std::env::args_os().skip(1))
        .args(["--here", name])
        .stdin(Stdio::null())
        .status()
}

fn run_here(name: &str, arguments: Arguments) -> Result<bool, Box<dyn Error>> {
    let experiment = ALL.iter().find(|e| e.name == name);
    let experiment = experiment.expect("the parser knows the names");
    let context = Context {
        quick: arguments.quick,
        results: Results::create(&arguments.directory())?,
        commit: Machine::detect().commit,
        models: arguments.models,
        tetgen: is_program(&arguments.tetgen).then_some(arguments.tetgen),
        python: arguments.python,
        rivals: arguments.rival,
        limit: Duration::from_secs(arguments.limit),
    };
    let answer = (experiment.run)(&context).map_err(|error| format!("{name}: {error}"));
    let answer = match answer {
        Ok(answer) => answer,
        Err(error) => {
            eprintln!("{error}");
            std::process::exit(2);
        }
    };
    println!("{}", answer.text.trim_end());
    for path in &answer.files {
        println!("{}", path.display());
    }
    print!("{}", expectation::text(&answer.expectations));
    Ok(answer.holds())
}

/// Whether there is such a program, by path or name.
fn is_program(name: &str) -> bool {
    let run = Command::new(name)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .arg("-h")
        .status();
    run.is_ok()
}
