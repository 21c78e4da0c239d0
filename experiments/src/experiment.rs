//! The frame of all experiments: what one is given, what it answers, and the list of them.

use crate::expectation::Expectation;
use crate::record::{RecordError, Results};
use crate::steiner::rival::Rival;
use indicatif::{ProgressBar, ProgressStyle};
use serde::Serialize;
use std::error::Error;
use std::path::PathBuf;
use std::time::Duration;

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
    pub rivals: Vec<Rival>,
    /// How long another program may take for one model.
    pub limit: Duration,
}

impl Context {
    /// Writes `STEM.csv`: the rows, each with the commit of the sources as its last column.
    ///
    /// # Errors
    /// As [`Results::rows`].
    pub fn record<T: Serialize>(&self, stem: &str, rows: &[T]) -> Result<PathBuf, RecordError> {
        #[derive(Serialize)]
        struct Stamp<'a> {
            commit: &'a str,
        }
        let commit = &self.commit;
        let stamped: Vec<_> = rows.iter().map(|row| (row, Stamp { commit })).collect();
        self.results.rows(stem, &stamped)
    }

    /// The plan of this form.
    pub fn plan<P>(&self, quick: fn() -> P, full: fn() -> P) -> P {
        if self.quick { quick() } else { full() }
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

    /// A progress bar on stderr, if that is a terminal, with the remaining time.
    pub fn bar(&self, length: u64) -> ProgressBar {
        let style = ProgressStyle::with_template(
            "{bar:40} {percent:>3} %  {elapsed} of about {duration}  {msg}",
        )
        .expect("a valid template");
        ProgressBar::new(length).with_style(style)
    }
}

/// What an experiment answers.
pub struct Answer {
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
}

/// One question.
pub struct Experiment {
    /// The stem of its files.
    pub name: &'static str,
    /// What it asks.
    pub question: &'static str,
    /// About how long the full form takes on two cores.
    pub seconds: u64,
    /// Asks it.
    pub run: fn(&Context) -> Result<Answer, Box<dyn Error>>,
}

/// All experiments, in the order in which they are run.
pub const ALL: [Experiment; 13] = [
    crate::models::EXPERIMENT,
    crate::fig8::EXPERIMENT,
    crate::fig9::EXPERIMENT,
    crate::table1::EXPERIMENT,
    crate::table2::EXPERIMENT,
    crate::growth::EXPERIMENT,
    crate::exactness_cost::EXPERIMENT,
    crate::flip_order::EXPERIMENT,
    crate::failures::EXPERIMENT,
    crate::updates::EXPERIMENT,
    crate::steiner::EXPERIMENT,
    crate::rivals::EXPERIMENT,
    crate::scaling::EXPERIMENT,
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_different() {
        let mut names: Vec<&str> = ALL.iter().map(|e| e.name).collect();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), ALL.len());
    }
}
