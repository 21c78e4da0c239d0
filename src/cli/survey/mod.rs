//! The command `survey`: a whole collection of models, each by several methods, in a table that survives everything.
//!
//! Every run is a process of its own ([`run`], [`worker`]), so that a crash, a hang or a lack of memory is an outcome
//! of one model and one method. Runs of one model follow each other; models are processed side by side. Nothing in a
//! row depends on the order, except seconds and memory.

mod limits;
mod merge;
mod method;
mod models;
mod run;
mod summary;
mod table;
mod tetgen;
mod worker;

use super::{Stop, say, warn};
use clap::ValueEnum;
use indicatif::{ProgressBar, ProgressStyle};
use method::{Algorithm, Method, Steiner};
use models::{Model, models};
use run::{Settings, run};
use std::io;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Sender, channel};
use std::time::Instant;
use table::{Run, Table};
use tetflip::exchange::{Note, NoteCode, PrecisionChoice};
use tetflip::lab::{Shard, fnv1a};
use worker::{Job, work};

/// Arguments of `tetflip survey`.
#[derive(clap::Args)]
pub(crate) struct SurveyArguments {
    /// The collection: a directory, searched with all below it for what `mesh` reads; or one file. With --merge:
    /// tables.
    #[arg(required = true)]
    collection: Vec<PathBuf>,
    /// Makes one table of several, of shards or of methods: one header, in the order of the models' names. Rows that
    /// contradict each other are refused.
    #[arg(long, conflicts_with = "shard")]
    merge: bool,
    /// The table, as CSV: a row for each model and method. If it is there, only the rows that it lacks are made.
    #[arg(short, long, required_unless_present = "worker")]
    output: Option<PathBuf>,
    /// What is done with each model: `check`, which finds all that is wrong with the input; and meshes by cavity,
    /// gift-wrap, or flip:TYPE with a TYPE of `mesh --times`.
    #[arg(
        long,
        value_delimiter = ',',
        default_value = "cavity,flip:filtered,flip:f64"
    )]
    methods: Vec<Algorithm>,
    /// Where Steiner points are; every method is run with each.
    #[arg(long, value_enum, value_delimiter = ',', default_value = "rounded")]
    steiner: Vec<Steiner>,
    /// Another program to compare with, as two more methods: `tetgen` and, by flips, `tetgen-flip`.
    #[arg(long, value_enum, value_delimiter = ',')]
    compare: Vec<Program>,
    /// Where that program is, if not on the search path.
    #[arg(long, value_name = "PATH", default_value = "tetgen")]
    tetgen: PathBuf,
    /// How many runs at once [default: the number of processors].
    #[arg(short, long)]
    jobs: Option<NonZeroUsize>,
    /// Seconds for one run, verification included.
    #[arg(long, default_value_t = 300.0, value_parser = seconds)]
    timeout: f64,
    /// MiB of address space for one run. Enforced on Linux only.
    #[arg(long, default_value_t = 4096, value_parser = clap::value_parser!(u64).range(1..))]
    memory: u64,
    /// Only part I of N of the collection, for several machines; --merge makes one table of theirs.
    #[arg(long, value_name = "I/N")]
    shard: Option<Shard>,
    /// Keep the whole convex hull instead of what the facets enclose.
    #[arg(long)]
    hull: bool,
    /// Do not merge coplanar adjacent facets.
    #[arg(long)]
    no_merge: bool,
    /// How far coordinates may be from what was meant: `auto` (what their values tell, see `mesh --help`), `exact`, or
    /// a distance.
    #[arg(long, value_name = "auto|exact|DISTANCE", default_value = "auto")]
    precision: PrecisionChoice,
    /// Do not verify meshes.
    #[arg(long)]
    no_verify: bool,
    /// No progress and no summary.
    #[arg(short, long)]
    quiet: bool,
    /// The process of one run, which a survey starts.
    #[arg(long, hide = true)]
    worker: bool,
    /// Where a run can leave files.
    #[arg(long, hide = true)]
    scratch: Option<PathBuf>,
}

/// A program to compare with.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
enum Program {
    /// TetGen 1.5.
    Tetgen,
}

fn seconds(word: &str) -> Result<f64, String> {
    let number: f64 = word.parse().map_err(|_| "not a number".to_owned())?;
    // A year; an infinite time is none that can be counted.
    let good = number > 0.0 && number <= 3.2e7;
    good.then_some(number)
        .ok_or("not a positive number of seconds, at most a year".to_owned())
}

/// Runs what the table lacks, then says what is in it.
pub(crate) fn survey(arguments: &SurveyArguments) -> Result<(), Stop> {
    let settings = Settings {
        keep_hull: arguments.hull,
        merge_coplanar: !arguments.no_merge,
        precision: arguments.precision,
        verify: !arguments.no_verify,
        memory: arguments.memory,
        timeout: arguments.timeout,
        tetgen: arguments.tetgen.clone(),
    };
    if arguments.worker {
        return worker(arguments, &settings);
    }
    let output = arguments.output.as_ref().expect("clap requires it");
    if arguments.merge {
        return merge(&arguments.collection, output, arguments.quiet);
    }
    let methods = methods(arguments);
    let (mut list, skipped) = models(one(&arguments.collection)?).map_err(Stop::input)?;
    if let Some(note) = skipped {
        warn(&note.to_string());
    }
    if let Some(shard) = arguments.shard {
        list.retain(|model| shard.has(&model.name));
    }
    let mut table = Table::open(output).map_err(Stop::input)?;
    if let Some(model) = table.changed(&list) {
        return Err(Stop::input(format!(
            "{} has changed since its rows in {} were made; choose another name",
            model.name,
            output.display()
        )));
    }
    let plan = plan(&list, &methods, &table);
    let mut planned = vec![0; methods.len()];
    for &(_, method) in plan.iter().flatten() {
        planned[methods.iter().position(|m| *m == method).expect("planned")] += 1;
    }
    let bar = progress_bar(planned.iter().sum(), arguments.quiet);
    if !limits::MEMORY_IS_LIMITED && !arguments.quiet {
        bar.suspend(|| eprintln!("tetflip: the limit of memory is not enforced on this system"));
    }
    let jobs = arguments
        .jobs
        .or_else(|| std::thread::available_parallelism().ok());
    execute(&plan, jobs.map_or(1, NonZeroUsize::get), &settings, |run| {
        table.append(run, &settings).map_err(Stop::input)?;
        bar.inc(1);
        bar.set_message(run.model.name.clone());
        Ok(())
    })?;
    bar.finish_and_clear();
    table.sort().map_err(Stop::input)?;
    if !arguments.quiet {
        say(summary::summary(table.rows()).trim_end());
    }
    Ok(())
}

/// The only collection.
fn one(collection: &[PathBuf]) -> Result<&PathBuf, Stop> {
    match collection {
        [one] => Ok(one),
        _ => Err(Stop::input(
            "one collection at a time; --merge takes several tables",
        )),
    }
}

/// One table of several.
fn merge(tables: &[PathBuf], output: &Path, quiet: bool) -> Result<(), Stop> {
    let same = |table: &&PathBuf| {
        table
            .canonicalize()
            .is_ok_and(|t| output.canonicalize().is_ok_and(|o| o == t))
    };
    if let Some(table) = tables.iter().find(same) {
        return Err(Stop::input(format!(
            "{} is an input and would be overwritten; choose another name",
            table.display()
        )));
    }
    let (rows, repeated) = merge::merge(tables, output).map_err(Stop::input)?;
    if repeated > 0 {
        let text = format!(
            "{repeated} rows are in several tables, the same but for seconds and memory: the first counts"
        );
        warn(&Note::new(NoteCode::RepeatedRows, repeated, text).to_string());
    }
    if !quiet {
        say(summary::summary(&rows).trim_end());
    }
    Ok(())
}

fn worker(arguments: &SurveyArguments, settings: &Settings) -> Result<(), Stop> {
    let (&[algorithm], &[steiner]) = (&arguments.methods[..], &arguments.steiner[..]) else {
        return Err(Stop::input("a worker has one method"));
    };
    let job = Job {
        algorithm,
        steiner,
        keep_hull: settings.keep_hull,
        merge_coplanar: settings.merge_coplanar,
        precision: settings.precision,
        verify: settings.verify,
        memory: settings.memory,
        timeout: settings.timeout,
        tetgen: &settings.tetgen,
        scratch: arguments.scratch.as_deref(),
    };
    work(one(&arguments.collection)?, &job);
    Ok(())
}

/// All methods once, in the order of the arguments; other programs last. They know no other than rounded Steiner
/// points.
fn methods(arguments: &SurveyArguments) -> Vec<Method> {
    let mut list: Vec<Method> = Vec::new();
    let mut add = |algorithm, steiner| {
        let method = Method { algorithm, steiner };
        if !list.contains(&method) {
            list.push(method);
        }
    };
    let (foreign, ours): (Vec<Algorithm>, Vec<Algorithm>) =
        arguments.methods.iter().partition(|a| a.is_foreign());
    for algorithm in ours {
        // Whether the input is valid has nothing to do with Steiner points.
        let steiner = match algorithm {
            Algorithm::Check => &[Steiner::Rounded],
            _ => &arguments.steiner[..],
        };
        for &steiner in steiner {
            add(algorithm, steiner);
        }
    }
    for algorithm in foreign {
        add(algorithm, Steiner::Rounded);
    }
    if arguments.compare.contains(&Program::Tetgen) {
        add(Algorithm::TetgenCavity, Steiner::Rounded);
        add(Algorithm::TetgenFlip, Steiner::Rounded);
    }
    list
}

/// The runs that are missing, model by model.
fn plan<'a>(list: &'a [Model], methods: &[Method], table: &Table) -> Vec<Vec<(&'a Model, Method)>> {
    let missing = |model: &'a Model| -> Vec<(&'a Model, Method)> {
        let methods = methods.iter().filter(|&&m| !table.has(model, m));
        methods.map(|&method| (model, method)).collect()
    };
    let plan = list.iter().map(missing);
    plan.filter(|runs| !runs.is_empty()).collect()
}

/// Runs everything, `jobs` models at a time; `record` gets each run when it is done. After an error no run is begun.
fn execute(
    plan: &[Vec<(&Model, Method)>],
    jobs: usize,
    settings: &Settings,
    mut record: impl FnMut(&Run) -> Result<(), Stop>,
) -> Result<(), Stop> {
    let next = AtomicUsize::new(0);
    let (sender, receiver) = channel();
    std::thread::scope(|scope| {
        for _ in 0..jobs.min(plan.len()) {
            let (sender, next) = (sender.clone(), &next);
            scope.spawn(move || {
                while let Some(runs) = plan.get(next.fetch_add(1, Ordering::Relaxed)) {
                    if run_model(runs, settings, &sender).is_none() {
                        break;
                    }
                }
            });
        }
        drop(sender);
        let mut result = Ok(());
        for run in &receiver {
            let recorded = match run {
                Ok(run) => record(&run),
                Err(error) => Err(Stop::input(error)),
            };
            if recorded.is_err() {
                next.store(plan.len(), Ordering::Relaxed);
                result = recorded;
                break;
            }
        }
        // Whoever still has something to send learns that nobody listens.
        drop(receiver);
        result
    })
}

/// The runs of one model; `None` if nobody wants more.
fn run_model<'a>(
    runs: &[(&'a Model, Method)],
    settings: &Settings,
    sender: &Sender<io::Result<Run<'a>>>,
) -> Option<()> {
    let mut hash = 0;
    if let Some((model, _)) = runs.first() {
        // What cannot be read is an outcome of the run itself.
        hash = fnv1a(std::fs::read(&model.path).unwrap_or_default());
    }
    for &(model, method) in runs {
        let start = Instant::now();
        let run = run(&model.path, method, settings).map(|findings| Run {
            model,
            hash,
            method,
            findings,
            seconds: start.elapsed().as_secs_f64(),
        });
        sender.send(run).ok()?;
    }
    Some(())
}

/// A bar on stderr, where that is a terminal.
fn progress_bar(runs: u64, quiet: bool) -> ProgressBar {
    if quiet {
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template("{bar:30} {pos}/{len} [{elapsed} < {eta}] {wide_msg}");
    ProgressBar::new(runs).with_style(style.expect("a template"))
}
