//! Runs the experiments, each in a process of its own, so that none takes down or warms up another, and tells how far
//! it is.

use clap::{Parser, Subcommand};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};
use std::time::{Duration, Instant};
use tetflip::lab::Shard;
use tetflip::recover::polygons::FlipOrder;
use tetflip_experiments::families::Member;
use tetflip_experiments::frame::ledger::{Entry, Ledger};
use tetflip_experiments::frame::machine::Machine;
use tetflip_experiments::frame::program::Program;
use tetflip_experiments::frame::record::Results;
use tetflip_experiments::frame::{About, Context, Experiment, Failed};
use tetflip_experiments::measure::threads;
use tetflip_experiments::questions::{flip_order, scaling};
use tetflip_experiments::registry::ALL;
use tetflip_experiments::rivals::{ours, process};
use tetflip_experiments::{page, paper};

/// The experiments of tetflip: CSV files and plots in results/.
///
/// What has succeeded with the very same sources is not run again, so that an interrupted run can be resumed.
#[derive(Parser)]
#[command(version, args_conflicts_with_subcommands = true)]
struct Arguments {
    #[command(subcommand)]
    command: Option<Verb>,
    #[command(flatten)]
    run: Run,
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
        #[arg(long, default_value = "f64:plain")]
        times: FlipOrder,
        /// Writes the PLC to this file, too.
        #[arg(long, value_name = "FILE.poly")]
        write: Option<PathBuf>,
    },
    /// Writes one input of `flip_order` as numbers: coordinates, identities, polygons, regions, and N and D of the
    /// events, doubles as hexadecimal floats.
    Dump {
        /// The input.
        input: Member,
        /// Where the files go.
        #[arg(short, long, value_name = "DIR")]
        output: PathBuf,
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
    /// Makes the tables of the shards of an experiment into one: the one that a single machine would have made.
    Join {
        /// Which experiment.
        #[arg(value_parser = names())]
        experiment: String,
        /// The results of the shards: directories.
        #[arg(required = true)]
        shards: Vec<PathBuf>,
        /// Where the joined results go.
        #[arg(long, value_name = "DIR")]
        results: PathBuf,
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
struct Run {
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
    rival: Vec<Program>,
    /// How long another program may take for one model.
    #[arg(long, value_name = "SECONDS", default_value_t = 60)]
    limit: u64,
    /// Only part I of N of the inputs, of experiments that can be divided among machines.
    #[arg(long, value_name = "I/N")]
    shard: Option<Shard>,
    /// Run this experiment in this process.
    #[arg(long, hide = true, value_name = "NAME", value_parser = names())]
    here: Option<String>,
}

fn names() -> clap::builder::PossibleValuesParser {
    ALL.iter()
        .map(|e| e.about().name)
        .collect::<Vec<_>>()
        .into()
}

fn main() -> ExitCode {
    let Arguments { command, run } = Arguments::parse();
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
        }) => replay(input, times, write.as_deref()),
        Some(Verb::Dump { input, output }) => flip_order::dump::dump(input, &output).map(tell),
        Some(Verb::Paper {
            results,
            output,
            check,
        }) => write_paper(&results, &output, check),
        Some(Verb::Report { results, output }) => make_report(&results, output),
        Some(Verb::Join {
            experiment,
            shards,
            results,
        }) => join(&experiment, &shards, &results),
        Some(Verb::Contestant { what, input, .. }) => ours::take_part(&what, &input).map(|()| true),
        Some(Verb::Scale { what, size }) => scaling::take_part(&what, size).map(|()| true),
        Some(Verb::Limited {
            seconds,
            program,
            arguments,
        }) => process::limited(seconds, &program, &arguments).map_err(Into::into),
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

/// Names the files that have been written.
fn tell(files: Vec<PathBuf>) -> bool {
    for file in files {
        println!("{}", file.display());
    }
    true
}

fn list() {
    for About {
        name,
        question,
        seconds,
    } in ALL.map(|e| e.about())
    {
        println!("{name:<16} {seconds:>4} s  {question}");
    }
}

fn replay(input: Member, times: FlipOrder, write: Option<&Path>) -> Result<bool, Failed> {
    if let Some(path) = write {
        tetflip::format::write_poly(path, &input.prepare().plc)?;
    }
    print!("{}", flip_order::replay::replay(input, times));
    Ok(true)
}

/// Whether the files are up to date, with `check`, and the sentences of the paper true.
fn write_paper(results: &Path, output: &Path, check: bool) -> Result<bool, Failed> {
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

fn make_report(results: &Path, output: Option<PathBuf>) -> Result<bool, Failed> {
    let path = page::write(results, output)?;
    println!("{}", path.display());
    Ok(true)
}

fn join(name: &str, shards: &[PathBuf], results: &Path) -> Result<bool, Failed> {
    let results = Results::create(results)?;
    for path in experiment(name).join(shards, &results)? {
        println!("{}", path.display());
    }
    Ok(true)
}

fn experiment(name: &str) -> &'static dyn Experiment {
    let found = ALL.iter().find(|e| e.about().name == name);
    *found.expect("the parser knows the names")
}

impl Run {
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
fn run_all(run: &Run) -> Result<bool, Failed> {
    let mut wanted = ALL.map(|e| e.about()).to_vec();
    wanted.retain(|e| run.only.is_empty() || run.only.iter().any(|name| name == e.name));
    let results = Results::create(&run.directory())?;
    let mut ledger = Ledger::read(&results);
    let (form, commit) = (run.form(), Machine::detect().commit);
    let mut bad = Vec::new();
    for (i, &About { name, question, .. }) in wanted.iter().enumerate() {
        let place = format!("[{}/{}] {name}:", i + 1, wanted.len());
        if !run.again && ledger.has(name, form, &commit) {
            println!("{place} has been run with these sources; --again repeats it");
            continue;
        }
        let minutes = wanted[i..]
            .iter()
            .map(|e| e.seconds)
            .sum::<u64>()
            .div_ceil(60);
        match run.quick {
            true => println!("{place} {question}"),
            false => println!("{place} {question} (about {minutes} min for this and the rest)"),
        }
        let start = Instant::now();
        let outcome = match child(name)?.code() {
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

/// This program again, with the same arguments, for one experiment.
fn child(name: &str) -> std::io::Result<std::process::ExitStatus> {
    Command::new(std::env::current_exe()?)
        .args(std::env::args_os().skip(1))
        .args(["--here", name])
        .stdin(Stdio::null())
        .status()
}

fn run_here(name: &str, run: Run) -> Result<bool, Failed> {
    let context = Context {
        quick: run.quick,
        results: Results::create(&run.directory())?,
        commit: Machine::detect().commit,
        models: run.models,
        tetgen: is_program(&run.tetgen).then_some(run.tetgen),
        python: run.python,
        rivals: run.rival,
        limit: Duration::from_secs(run.limit),
        shard: run.shard,
    };
    let answer = experiment(name).run(&context).unwrap_or_else(|error| {
        eprintln!("{name}: {error}");
        std::process::exit(2);
    });
    println!("{}", answer.text.trim_end());
    for path in &answer.files {
        println!("{}", path.display());
    }
    print!("{}", answer.expectations_text());
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
