//! Statistics of a few numbers.

/// The median: the mean of the two middle ones of an even number; `None` of nothing.
pub fn median(sample: &[f64]) -> Option<f64> {
    let mut sorted = sample.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let middle = sorted.len() / 2;
    match sorted.len() {
        0 => None,
        n if n % 2 == 1 => Some(sorted[middle]),
        _ => Some((sorted[middle - 1] + sorted[middle]) / 2.0),
    }
}

/// The least; `None` of nothing.
pub fn minimum(sample: &[f64]) -> Option<f64> {
    sample.iter().copied().min_by(f64::total_cmp)
}

/// The number rounded to four significant digits: more than any time is good for.
pub fn rounded(x: f64) -> f64 {
    format!("{x:.3e}").parse().unwrap_or(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_none_one_and_many() {
        assert_eq!((median(&[]), minimum(&[])), (None, None));
        assert_eq!((median(&[7.0]), minimum(&[7.0])), (Some(7.0), Some(7.0)));
        assert_eq!(median(&[3.0, 1.0, 100.0]), Some(3.0));
        assert_eq!(median(&[4.0, 1.0, 100.0, 2.0]), Some(3.0));
        assert_eq!(minimum(&[4.0, 1.0, 100.0]), Some(1.0));
    }

    #[test]
    fn four_digits() {
        let rounded = [0.0, 1.23456e-7, 99_996.0, f64::INFINITY].map(rounded);
        assert_eq!(rounded, [0.0, 1.235e-7, 100_000.0, f64::INFINITY]);
    }
}
