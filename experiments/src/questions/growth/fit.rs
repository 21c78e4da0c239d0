//! How a time grows: `growth-summary.csv`.

use super::Row;
use crate::measure::method::Method;
use crate::measure::sample::rounded;
use serde::Serialize;

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
            let of_method = rows.iter().filter(|r| r.method.method == method);
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

/// A power law y = c·xᵉ through points, by least squares of logarithms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PowerLaw {
    /// e.
    pub exponent: f64,
    /// The greatest factor by which a point is above or below the law: at least 1.
    pub worst_factor: f64,
}

/// The fit; `None` unless there are two different abscissas. All numbers must be positive.
pub fn power_law(points: &[(f64, f64)]) -> Option<PowerLaw> {
    let logs: Vec<(f64, f64)> = points.iter().map(|&(x, y)| (x.ln(), y.ln())).collect();
    let n = logs.len() as f64;
    let mean = |f: fn(&(f64, f64)) -> f64| logs.iter().map(f).sum::<f64>() / n;
    let (x0, y0) = (mean(|p| p.0), mean(|p| p.1));
    let square: f64 = logs.iter().map(|(x, _)| (x - x0) * (x - x0)).sum();
    let product: f64 = logs.iter().map(|(x, y)| (x - x0) * (y - y0)).sum();
    let is_spread = square > 1e-9;
    is_spread.then(|| {
        let exponent = product / square;
        let residual = |(x, y): &(f64, f64)| (y - y0 - exponent * (x - x0)).abs();
        PowerLaw {
            exponent,
            worst_factor: logs.iter().map(residual).fold(0.0, f64::max).exp(),
        }
    })
}

#[cfg(test)]
mod tests {
    use super::super::METHODS;
    use super::*;
    use crate::inputs::slab::Slab;

    #[test]
    fn laws_are_found() {
        let sizes = [1e3, 1e4, 1e5, 1e6];
        let square = power_law(&sizes.map(|n| (n, 3.0 * n * n))).unwrap();
        assert!((square.exponent - 2.0).abs() < 1e-12 && (square.worst_factor - 1.0).abs() < 1e-9);
        let noisy = power_law(&[(1.0, 1.0), (10.0, 40.0), (100.0, 100.0)]).unwrap();
        assert!((noisy.exponent - 1.0).abs() < 1e-12 && noisy.worst_factor > 2.0);
        assert_eq!(power_law(&[]), None);
        assert_eq!(
            power_law(&[(10.0, 1.0), (10.0, 2.0)]),
            None,
            "one size has no law"
        );
    }

    #[test]
    fn exponents_of_successes() {
        let row = |vertices: usize, seconds, outcome| {
            let mut row = Row::new(
                Slab {
                    vertices,
                    half_height: 1.0,
                    seed: 1,
                },
                METHODS[1],
            );
            (row.timed.median_seconds, row.counts.outcome) = (Some(seconds), outcome);
            row
        };
        let n_log_n = |n: usize| row(n, n as f64 * (n as f64).ln(), "ok");
        let mut rows: Vec<Row> = [300, 3000, 30_000].map(n_log_n).to_vec();
        rows.push(row(300_000, 1e-9, "stuck"));
        let summaries = summaries(&rows, &METHODS);
        let ranges: Vec<_> = summaries
            .iter()
            .map(|s| (s.from_vertices, s.to_vertices, s.sizes))
            .collect();
        assert_eq!(
            ranges,
            [(300, 30_000, 3), (3000, 30_000, 2)],
            "all and large sizes of one method"
        );
        for s in &summaries {
            assert!(s.exponent > 1.05 && s.exponent < 1.2, "{s:?}");
            assert!(s.exponent_beyond_n_log_n.abs() < 1e-9, "{s:?}");
        }
    }
}
