//! `rivals-summary.csv`: each kind of input as a whole, beside each version of TetGen: all inputs on which both
//! succeed, none selected.

use super::row::{Row, ratio};
use crate::measure::sample::{median, rounded};
use serde::Serialize;

/// One of our methods beside one program on one kind of input. The README of the package has the meaning of the
/// columns.
#[allow(missing_docs)]
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Summary {
    pub kind: &'static str,
    pub method: String,
    pub beside: &'static str,
    pub inputs: usize,
    pub we_failed: usize,
    pub they_failed: usize,
    pub common: usize,
    pub seconds: f64,
    pub their_seconds: f64,
    pub sum_ratio: Option<f64>,
    pub geometric_mean: Option<f64>,
    pub median: Option<f64>,
    pub worst: Option<f64>,
    pub worst_input: String,
    pub slower_on: usize,
    pub steiner_points: Option<usize>,
    pub their_steiner_points: Option<usize>,
    pub more_steiner_on: usize,
}

/// In the order of kinds and methods; kinds on which the program does not take part are left out.
pub fn summaries(rows: &[Row]) -> Vec<Summary> {
    let mut summaries: Vec<Summary> = Vec::new();
    let ours = |r: &&Row| r.is_ours && !r.verifies && r.threads == 1;
    for row in rows.iter().filter(ours) {
        for beside in ["tetgen", "tetgen-1.6"] {
            let is_known =
                |s: &Summary| (s.kind, &*s.method, s.beside) == (row.kind, &*row.method, beside);
            if summaries.iter().any(is_known) {
                continue;
            }
            let of_method = rows.iter().filter(ours);
            let of_method = of_method.filter(|r| (r.kind, &*r.method) == (row.kind, &*row.method));
            let pairs: Vec<(&Row, &Row)> = of_method
                .filter_map(|r| Some((r, other(rows, r, beside)?)))
                .collect();
            if !pairs.is_empty() {
                summaries.push(summary(row, beside, &pairs));
            }
        }
    }
    summaries
}

/// The row of another program on the same input.
fn other<'a>(rows: &'a [Row], ours: &Row, program: &str) -> Option<&'a Row> {
    rows.iter()
        .find(|r| r.input == ours.input && r.program == program)
}

fn summary(row: &Row, beside: &'static str, pairs: &[(&Row, &Row)]) -> Summary {
    let good = pairs.iter().filter(|(a, b)| a.is_ok() && b.is_ok());
    let timed = |&&(a, b): &&(&Row, &Row)| Some((a.input.clone(), a.seconds?, b.seconds?));
    let seconds: Vec<(String, f64, f64)> = good.clone().filter_map(|p| timed(&p)).collect();
    let mut ratios: Vec<(f64, &str)> = seconds
        .iter()
        .map(|(name, a, b)| (a / b, &**name))
        .collect();
    ratios.retain(|r| r.0.is_finite() && r.0 > 0.0);
    ratios.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    let values: Vec<f64> = ratios.iter().map(|r| r.0).collect();
    let (sum, their_sum) = seconds
        .iter()
        .fold((0.0, 0.0), |(s, t), (_, a, b)| (s + a, t + b));
    let logs = values.iter().map(|r| r.ln()).sum::<f64>() / values.len() as f64;
    let steiner: Vec<(usize, usize)> = good
        .clone()
        .filter_map(|(a, b)| a.steiner_points.zip(b.steiner_points))
        .collect();
    let total = |of: fn(&(usize, usize)) -> usize| {
        (!steiner.is_empty()).then(|| steiner.iter().map(of).sum())
    };
    Summary {
        kind: row.kind,
        method: row.method.clone(),
        beside,
        inputs: pairs.len(),
        we_failed: pairs.iter().filter(|(a, _)| !a.is_ok()).count(),
        they_failed: pairs.iter().filter(|(_, b)| !b.is_ok()).count(),
        common: good.count(),
        seconds: rounded(sum),
        their_seconds: rounded(their_sum),
        sum_ratio: ratio(Some(sum), Some(their_sum)),
        geometric_mean: (!values.is_empty()).then(|| rounded(logs.exp())),
        median: median(&values).map(rounded),
        worst: values.last().copied().map(rounded),
        worst_input: ratios.last().map_or(String::new(), |r| r.1.to_string()),
        slower_on: values.iter().filter(|&&r| r > 1.0).count(),
        steiner_points: total(|s| s.0),
        their_steiner_points: total(|s| s.1),
        more_steiner_on: steiner.iter().filter(|(a, b)| a > b).count(),
    }
}

#[cfg(test)]
mod tests {
    use super::super::row::tests::row;
    use super::*;

    #[test]
    fn nothing_is_selected() {
        let steiner = |r: Row, n| Row {
            steiner_points: Some(n),
            ..r
        };
        let rows = [
            steiner(row("a", "tetflip", "cavity", 1.0), 3),
            steiner(row("a", "tetgen", "cavity", 4.0), 5),
            steiner(row("b", "tetflip", "cavity", 8.0), 9),
            steiner(row("b", "tetgen", "cavity", 2.0), 0),
            row("c", "tetflip", "cavity", 1.0),
            Row {
                outcome: "failed",
                seconds: None,
                ..row("c", "tetgen", "cavity", 1.0)
            },
            row("d", "tetflip", "cavity", 1.0),
        ];
        let all = summaries(&rows);
        assert_eq!(all.len(), 1, "no other version takes part");
        let s = &all[0];
        assert_eq!(
            (s.inputs, s.common, s.they_failed, s.we_failed),
            (3, 2, 1, 0)
        );
        assert_eq!(
            (s.sum_ratio, s.geometric_mean, s.median),
            (Some(1.5), Some(1.0), Some(2.125))
        );
        assert_eq!((s.worst, &*s.worst_input, s.slower_on), (Some(4.0), "b", 1));
        assert_eq!(
            (s.steiner_points, s.their_steiner_points, s.more_steiner_on),
            (Some(12), Some(5), 1)
        );
    }
}
