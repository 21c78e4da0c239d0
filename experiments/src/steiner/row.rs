//! The rows of the tables: `steiner.csv` and `steiner-summary.csv`.

use crate::outcome;
use serde::Serialize;

/// One method on one model. The README of the package has the meaning of the columns.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Row {
    pub source: &'static str,
    pub model: String,
    pub method: String,
    pub vertices: usize,
    pub segments: Option<usize>,
    pub steiner_points: Option<usize>,
    pub on_segment: Option<usize>,
    pub seconds: f64,
    pub outcome: &'static str,
    pub verified: Option<bool>,
}

impl Row {
    /// Whether the run succeeded.
    pub fn is_ok(&self) -> bool {
        self.outcome == outcome::OK
    }

    /// The model and the method, for messages.
    pub fn name(&self) -> String {
        format!("{}, {}", self.model, self.method)
    }
}

/// The sum over the models of one source that all methods have meshed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Summary {
    pub source: &'static str,
    pub method: String,
    pub models: usize,
    pub succeeded: usize,
    pub common: usize,
    pub common_steiner_points: usize,
    pub fewest: usize,
}

/// One summary for each source and method, in order of appearance.
pub fn summaries(rows: &[Row]) -> Vec<Summary> {
    let mut keys: Vec<(&'static str, &str)> = Vec::new();
    for row in rows {
        if !keys.contains(&(row.source, &row.method)) {
            keys.push((row.source, &row.method));
        }
    }
    let of = |&(source, method): &(&'static str, &str)| {
        let mine = rows
            .iter()
            .filter(|r| (r.source, &*r.method) == (source, method));
        let of_model = |row: &Row| {
            let model = row.model.clone();
            rows.iter()
                .filter(move |r| r.source == source && r.model == model)
        };
        let common = mine.clone().filter(|row| of_model(row).all(Row::is_ok));
        let fewest = common
            .clone()
            .filter(|row| of_model(row).all(|other| row.steiner_points <= other.steiner_points));
        Summary {
            source,
            method: method.to_string(),
            models: mine.clone().count(),
            succeeded: mine.clone().filter(|r| r.is_ok()).count(),
            common: common.clone().count(),
            common_steiner_points: common.clone().filter_map(|r| r.steiner_points).sum(),
            fewest: fewest.count(),
        }
    };
    keys.iter().map(of).collect()
}

/// The rows and the sums for people.
pub fn table(rows: &[Row], summaries: &[Summary]) -> String {
    let mut text = format!(
        "{:<40} {:<12} {:>9} {:>9} {:>8}  {}\n",
        "model", "method", "Steiner", "exactly", "seconds", "outcome"
    );
    let number = |x: Option<usize>| x.map_or("–".to_string(), |x| x.to_string());
    for row in rows {
        text += &format!(
            "{:<40} {:<12} {:>9} {:>9} {:>8.2}  {}\n",
            row.model,
            row.method,
            number(row.steiner_points),
            number(row.on_segment),
            row.seconds,
            row.outcome
        );
    }
    for s in summaries {
        text += &format!(
            "\n{}, {}: {} of {} models; {} Steiner points on the {} models of all methods, fewest or equal on {}",
            s.source, s.method, s.succeeded, s.models, s.common_steiner_points, s.common, s.fewest
        );
    }
    text + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_are_over_common_models() {
        let row = |model: &str, method: &str, steiner_points, outcome| Row {
            source: "built-in",
            model: model.to_string(),
            method: method.to_string(),
            steiner_points,
            outcome,
            ..Row::default()
        };
        let rows = [
            row("a", "tetflip", Some(3), "ok"),
            row("a", "other", Some(5), "ok"),
            row("b", "tetflip", Some(70), "ok"),
            row("b", "other", None, "failed"),
        ];
        let sums = summaries(&rows);
        assert_eq!((sums[0].succeeded, sums[0].common), (2, 1));
        assert_eq!((sums[0].common_steiner_points, sums[0].fewest), (3, 1));
        assert_eq!((sums[1].common_steiner_points, sums[1].fewest), (5, 0));
        assert!(table(&rows, &sums).contains("other: 1 of 2 models"));
    }
}
