//! How a time grows: the exponent of the power law that fits it best.

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
    use super::*;

    const SIZES: [f64; 4] = [1e3, 1e4, 1e5, 1e6];

    #[test]
    fn laws_are_found() {
        let square = power_law(&SIZES.map(|n| (n, 3.0 * n * n))).unwrap();
        assert!((square.exponent - 2.0).abs() < 1e-12);
        assert!((square.worst_factor - 1.0).abs() < 1e-9);
        let n_log_n = power_law(&SIZES.map(|n| (n, n * n.ln()))).unwrap();
        assert!(
            n_log_n.exponent > 1.05 && n_log_n.exponent < 1.15,
            "{n_log_n:?}"
        );
        let noisy = power_law(&[(1.0, 1.0), (10.0, 40.0), (100.0, 100.0)]).unwrap();
        assert!((noisy.exponent - 1.0).abs() < 1e-12 && noisy.worst_factor > 2.0);
    }

    #[test]
    fn one_size_has_no_law() {
        assert_eq!(power_law(&[]), None);
        assert_eq!(power_law(&[(10.0, 1.0), (10.0, 2.0)]), None);
    }
}
