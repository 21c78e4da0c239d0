//! `RUNS.csv`: which experiment was run, at which commit, and how it ended. What is in it need not be run again.

use crate::frame::record::{RecordError, Results};
use serde::{Deserialize, Serialize};

/// One experiment.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Entry {
    /// Its name.
    pub experiment: String,
    /// `full` or `quick`.
    pub form: String,
    /// Wall clock.
    pub seconds: f64,
    /// `ok`; `broken`, an expectation does not hold; `failed`, it could not be completed.
    pub outcome: String,
    /// Of the sources.
    pub commit: String,
}

/// The entries of a directory of results, one for each experiment.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ledger {
    entries: Vec<Entry>,
}

const STEM: &str = "RUNS";

impl Ledger {
    /// The ledger of a directory; an empty one if there is none that can be read.
    pub fn read(results: &Results) -> Ledger {
        let path = results.directory().join(format!("{STEM}.csv"));
        let entries = csv::Reader::from_path(path).map(|mut reader| {
            let rows = reader.deserialize::<Entry>();
            rows.filter_map(Result::ok).collect()
        });
        Ledger {
            entries: entries.unwrap_or_default(),
        }
    }

    /// Whether this form of the experiment has succeeded with these very sources.
    pub fn has(&self, experiment: &str, form: &str, commit: &str) -> bool {
        let same = |e: &Entry| (&*e.experiment, &*e.form, &*e.commit) == (experiment, form, commit);
        let known = !commit.ends_with("-dirty") && commit != "unknown";
        known && self.entries.iter().any(|e| same(e) && e.outcome == "ok")
    }

    /// Replaces the entry of the experiment and writes the ledger.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn record(&mut self, results: &Results, entry: Entry) -> Result<(), RecordError> {
        self.entries.retain(|e| e.experiment != entry.experiment);
        self.entries.push(entry);
        self.entries.sort_by(|a, b| a.experiment.cmp(&b.experiment));
        results.rows(STEM, &self.entries).map(|_| ())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entry(experiment: &str, outcome: &str, commit: &str) -> Entry {
        Entry {
            experiment: experiment.to_string(),
            form: "full".to_string(),
            seconds: 1.5,
            outcome: outcome.to_string(),
            commit: commit.to_string(),
        }
    }

    #[test]
    fn what_has_succeeded_with_these_sources_is_known() {
        let directory = tempfile::TempDir::new().expect("a directory");
        let results = Results::create(directory.path()).expect("results");
        let mut ledger = Ledger::read(&results);
        assert_eq!(ledger, Ledger::default());
        for (name, outcome, commit) in [
            ("b", "broken", "1"),
            ("a", "ok", "1"),
            ("c", "ok", "1-dirty"),
            ("b", "ok", "1"),
        ] {
            ledger
                .record(&results, entry(name, outcome, commit))
                .expect("written");
        }
        let read = Ledger::read(&results);
        assert_eq!(read, ledger);
        assert_eq!(read.entries.len(), 3);
        assert!(read.has("a", "full", "1") && read.has("b", "full", "1"));
        assert!(!read.has("a", "full", "2") && !read.has("a", "quick", "1"));
        assert!(!read.has("c", "full", "1-dirty") && !read.has("d", "full", "1"));
    }
}
