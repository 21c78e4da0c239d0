//! Wilson's interval of a rate (Wilson 1927; Brown, Cai & DasGupta 2001 recommend it also for small samples and rates
//! near 0).

/// The 0.975 quantile of the normal distribution.
const Z: f64 = 1.959_963_984_540_054;

/// The 95 % interval of the rate of which k of n were seen; [0, 1] if n is 0.
pub fn interval(k: u64, n: u64) -> [f64; 2] {
    if n == 0 {
        return [0.0, 1.0];
    }
    let (k, n) = (k as f64, n as f64);
    let rate = k / n;
    let scale = 1.0 + Z * Z / n;
    let middle = (rate + Z * Z / (2.0 * n)) / scale;
    let half = Z / scale * (rate * (1.0 - rate) / n + Z * Z / (4.0 * n * n)).sqrt();
    // The ends are exact where they are 0 and 1, without the roundings of the others.
    [
        if k == 0.0 { 0.0 } else { middle - half },
        if k == n { 1.0 } else { middle + half },
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The ends are the rates p from which k/n is just as far as the quantile allows: (k/n − p)² = Z²·p(1−p)/n.
    #[test]
    fn the_ends_solve_wilsons_equation() {
        for (k, n) in [(0, 10), (1, 3), (7, 200), (682, 22_800), (2000, 2000)] {
            let [low, high] = interval(k, n);
            let (k, n) = (k as f64, n as f64);
            assert!(low <= k / n && k / n <= high && low < high);
            for p in [low, high] {
                let distance = (k / n - p).powi(2) - Z * Z * p * (1.0 - p) / n;
                assert!(distance.abs() < 1e-12, "{k} of {n}: {distance}");
            }
        }
        assert_eq!(interval(0, 0), [0.0, 1.0]);
        assert_eq!((interval(0, 9)[0], interval(9, 9)[1]), (0.0, 1.0));
    }
}
