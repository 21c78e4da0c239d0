//! The rows of the tables: `growth.csv` and `growth-summary.csv`.

use crate::growth::fit::power_law;
use crate::method::Method;
use crate::outcome;
use crate::sample::rounded;
use serde::Serialize;

/// One method at one size. The README of the package has the meaning of the columns.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Row {
    pub seed: u64,
    pub vertices: usize,
    pub half_height: f64,
    pub steiner_points: usize,
    pub regions: u64,
    pub crossing_tets: u64,
    pub method: String,
    pub repetitions: usize,
    pub median_seconds: Option<f64>,
    pub min_seconds: Option<f64>,
    pub microseconds_per_tet: Option<f64>,
    pub outcome: &'static str,
    pub flips: u64,
    pub queued: u64,
    pub comparisons: u64,
    pub compared_exactly: u64,
    pub fallbacks: u64,
    pub peak_megabytes: Option<f64>,
    pub repeatable: bool,
    pub agrees: Option<bool>,
}

impl Row {
    /// Whether the run succeeded.
    pub fn is_ok(&self) -> bool {
        self.outcome == outcome::OK
    }

    /// The scene and the method, for messages.
    pub fn name(&self) -> String {
        format!("{} vertices, {}", self.vertices, self.method)
    }

    /// The number of vertices and the median seconds of a success.
    pub fn point(&self) -> Option<(f64, f64)> {
        let seconds = self.median_seconds.filter(|_| self.is_ok())?;
        Some((self.vertices as f64, seconds))
    }
}

/// How the time of one method grows.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Summary {
    pub method: String,
    pub from_vertices: u64,
    pub to_vertices: u64,
    pub sizes: usize,
    pub exponent: f64,
    pub worst_factor: f64,
    pub exponent_beyond_n_log_n: f64,
    pub worst_factor_n_log_n: f64,
}

/// The first number of vertices of the fit of large scenes, whose meshes no cache holds.
const LARGE: f64 = 2500.0;

/// For each method the fit of all sizes, and that of the large ones; those that have two sizes at least.
pub fn summaries(rows: &[Row], methods: &[Method]) -> Vec<Summary> {
    let mut summaries = Vec::new();
    for method in methods.iter().map(Method::to_string) {
        for from in [0.0, LARGE] {
            let of_method = rows.iter().filter(|r| r.method == method);
            let points = of_method.filter_map(Row::point).filter(|p| p.0 >= from);
            summaries.extend(summary(&method, &points.collect::<Vec<_>>()));
        }
    }
    summaries
}

fn summary(method: &str, points: &[(f64, f64)]) -> Option<Summary> {
    let law = power_law(points)?;
    let relative = points.iter().map(|&(n, t)| (n, t / (n * n.ln())));
    let beyond = power_law(&relative.collect::<Vec<_>>())?;
    Some(Summary {
        method: method.to_string(),
        from_vertices: points.first()?.0 as u64,
        to_vertices: points.last()?.0 as u64,
        sizes: points.len(),
        exponent: rounded(law.exponent),
        worst_factor: rounded(law.worst_factor),
        exponent_beyond_n_log_n: rounded(beyond.exponent),
        worst_factor_n_log_n: rounded(beyond.worst_factor),
    })
}

/// The rows and the fits for people.
pub fn table(rows: &[Row], summaries: &[Summary]) -> String {
    let mut text = format!(
        "{:>9} {:>9} {:<14} {:>4} {:>10} {:>8} {:>8}\n",
        "vertices", "tets", "method", "runs", "seconds", "µs/tet", "peak MB"
    );
    for row in rows {
        let number = |x: Option<f64>| x.map_or("–".to_string(), |x| rounded(x).to_string());
        text += &format!(
            "{:>9} {:>9} {:<14} {:>4} {:>10} {:>8} {:>8}\n",
            row.vertices,
            row.crossing_tets,
            row.method,
            row.repetitions,
            number(row.median_seconds),
            number(row.microseconds_per_tet),
            number(row.peak_megabytes),
        );
    }
    for s in summaries {
        text += &format!(
            "\n{}, {} to {} vertices: seconds grow as n^{:.3} (within a factor {:.2}), or as n log n times n^{:.3} (within {:.2})",
            s.method,
            s.from_vertices,
            s.to_vertices,
            s.exponent,
            s.worst_factor,
            s.exponent_beyond_n_log_n,
            s.worst_factor_n_log_n
        );
    }
    text + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::growth::plan::METHODS;

    #[test]
    fn exponents_of_successes() {
        let row = |vertices: usize, seconds, outcome| Row {
            vertices,
            outcome,
            median_seconds: Some(seconds),
            method: METHODS[1].to_string(),
            ..Row::default()
        };
        let n_log_n = |n: usize| row(n, n as f64 * (n as f64).ln(), "ok");
        let mut rows: Vec<Row> = [300, 3000, 30_000].map(n_log_n).to_vec();
        rows.push(row(300_000, 1e-9, "stuck"));
        let summaries = summaries(&rows, &METHODS);
        assert_eq!(summaries.len(), 2, "all and large sizes of one method");
        assert_eq!((summaries[0].sizes, summaries[1].sizes), (3, 2));
        assert_eq!(
            (summaries[1].from_vertices, summaries[1].to_vertices),
            (3000, 30_000)
        );
        for s in &summaries {
            assert!(s.exponent > 1.05 && s.exponent < 1.2, "{s:?}");
            assert!(s.exponent_beyond_n_log_n.abs() < 1e-9, "{s:?}");
        }
        assert!(table(&rows, &summaries).contains("cavity, 300 to 30000 vertices"));
    }
}
