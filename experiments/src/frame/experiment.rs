//! An experiment: one question, what it is given, and what it answers.

use super::expectation::{self, Expectation};
use super::program::Program;
use super::record::{RecordError, Results, csv_text};
use super::sheet::Sheet;
use super::text;
use crate::measure::threads;
use indicatif::{ProgressBar, ProgressStyle};
use serde::Serialize;
use std::error::Error;
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;
use tetflip::lab::Shard;

/// Why an experiment could not be completed.
pub type Failed = Box<dyn Error>;

/// One question. The list of all is [`crate::registry`].
pub trait Experiment: Sync {
    /// Its name, what it asks, and what it costs.
    fn about(&self) -> About;

    /// Asks it.
    ///
    /// # Errors
    /// If it cannot be completed. An expectation that does not hold is no error, but part of the answer.
    fn run(&self, context: &Context) -> Result<Answer, Failed>;

    /// Makes the tables of several shards ([`Context::shard`]) into one and writes it to `results`.
    ///
    /// # Errors
    /// If this experiment cannot be divided, or if the shards do not belong together.
    fn join(&self, _shards: &[PathBuf], _results: &Results) -> Result<Vec<PathBuf>, Failed> {
        Err("this experiment cannot be divided among machines".into())
    }
}

/// What a list of experiments says of one.
#[derive(Clone, Copy, Debug)]
pub struct About {
    /// The stem of its files.
    pub name: &'static str,
    /// What it asks.
    pub question: &'static str,
    /// About how long the full form takes on two cores.
    pub seconds: u64,
}

/// What an experiment is given.
pub struct Context {
    /// The quick form: the same questions in seconds, not fit for conclusions about time.
    pub quick: bool,
    /// Where its files go.
    pub results: Results,
    /// The commit of the sources, for the rows.
    pub commit: String,
    /// A directory of models of the user's.
    pub models: Option<PathBuf>,
    /// TetGen, if it is installed.
    pub tetgen: Option<String>,
    /// A Python that may have gmsh.
    pub python: String,
    /// More programs that take TetGen's switches and files.
    pub rivals: Vec<Program>,
    /// How long another program may take for one model.
    pub limit: Duration,
    /// The part of the inputs that is wanted, for experiments that can be divided among machines.
    pub shard: Option<Shard>,
}

impl Context {
    /// The plan of this form.
    pub fn plan<P>(&self, quick: fn() -> P, full: fn() -> P) -> P {
        if self.quick { quick() } else { full() }
    }

    /// An answer that says nothing yet.
    pub fn answer(&self) -> Answer {
        Answer {
            results: self.results.clone(),
            commit: self.commit.clone(),
            text: String::new(),
            files: Vec::new(),
            expectations: Vec::new(),
        }
    }

    /// The rows of all inputs, one after the other, beside a progress bar: an input moves it by its weight.
    pub fn measure<I, R>(
        &self,
        inputs: &[I],
        weight: impl Fn(&I) -> u64,
        name: impl Fn(&I) -> String,
        measure: impl Fn(&I) -> Vec<R>,
    ) -> Vec<R> {
        let bar = self.bar(inputs.iter().map(&weight).sum());
        let mut rows = Vec::new();
        for input in inputs {
            bar.set_message(name(input));
            rows.extend(measure(input));
            bar.inc(weight(input));
        }
        bar.finish_and_clear();
        rows
    }

    /// What becomes of each input, in the order of the inputs, on all processors; each is measured in one thread.
    pub fn measure_on_all_processors<I: Sync, R: Send>(
        &self,
        inputs: &[I],
        measure: impl Fn(&I) -> R + Sync,
    ) -> Vec<R> {
        let bar = self.bar(inputs.len() as u64);
        let next = AtomicUsize::new(0);
        let work = || {
            let mut measured = Vec::new();
            loop {
                let i = next.fetch_add(1, Ordering::Relaxed);
                let Some(input) = inputs.get(i) else {
                    return measured;
                };
                measured.push((i, measure(input)));
                bar.inc(1);
            }
        };
        let workers = threads::on_all_processors(work);
        bar.finish_and_clear();
        let mut measured: Vec<(usize, R)> = workers.into_iter().flatten().collect();
        measured.sort_unstable_by_key(|m| m.0);
        measured.into_iter().map(|m| m.1).collect()
    }

    /// A progress bar on stderr, if that is a terminal, with the remaining time.
    fn bar(&self, length: u64) -> ProgressBar {
        let style = "{bar:40} {percent:>3} %  {elapsed} of about {duration}  {msg}";
        let style = ProgressStyle::with_template(style).expect("a valid template");
        ProgressBar::new(length).with_style(style)
    }
}

/// What an experiment answers.
pub struct Answer {
    results: Results,
    commit: String,
    /// The tables, for people.
    pub text: String,
    /// The files that it has written.
    pub files: Vec<PathBuf>,
    /// What must be so, and what breaks it.
    pub expectations: Vec<Expectation>,
}

impl Answer {
    /// Whether every expectation holds.
    pub fn holds(&self) -> bool {
        self.expectations.iter().all(Expectation::holds)
    }

    /// The expectations as lines for people.
    pub fn expectations_text(&self) -> String {
        expectation::text(&self.expectations)
    }

    /// Adds lines for people.
    pub fn say(&mut self, text: impl AsRef<str>) {
        self.text += text.as_ref().trim_end_matches('\n');
        self.text += "\n";
    }

    /// Writes `STEM.csv`: the rows, each with the commit of the sources as its last column. Those of its columns that
    /// are named, with spaces between them, are shown to people, too.
    ///
    /// # Errors
    /// If there are no rows, if they are no CSV, or if the file cannot be written.
    pub fn csv<T: Serialize>(
        &mut self,
        stem: &str,
        rows: &[T],
        shown: &str,
    ) -> Result<(), RecordError> {
        #[derive(Serialize)]
        struct Stamp<'a> {
            commit: &'a str,
        }
        let commit = &self.commit;
        let stamped: Vec<_> = rows.iter().map(|row| (row, Stamp { commit })).collect();
        self.files.push(self.results.rows(stem, &stamped)?);
        if !shown.is_empty() {
            let csv = csv_text(rows).expect("they have been written");
            let sheet = Sheet::parse(stem, &csv).expect("they have been written");
            self.say(text::table(&sheet, shown));
        }
        Ok(())
    }

    /// Writes a text file, for instance `STEM.svg`.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn file(&mut self, name: &str, text: &str) -> Result<(), RecordError> {
        self.files.push(self.results.text(name, text)?);
        Ok(())
    }
}
