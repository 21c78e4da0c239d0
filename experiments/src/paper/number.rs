//! Numbers as the paper prints them.

/// How a number is printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// [`whole`].
    Whole,
    /// [`ratio`].
    Ratio,
    /// A part of 1: [`percent`].
    Part,
    /// The same with the sign.
    Percent,
    /// Two [`significant`] digits.
    Rough,
    /// Three.
    Exact,
}

impl Format {
    /// The format that a word names.
    ///
    /// # Panics
    /// If there is none.
    pub fn of(word: &str) -> Format {
        match word {
            "whole" => Format::Whole,
            "ratio" => Format::Ratio,
            "part" => Format::Part,
            "percent" => Format::Percent,
            "rough" => Format::Rough,
            other => panic!("{other}: no format"),
        }
    }

    /// The number, or a dash.
    pub fn print(self, number: Option<f64>) -> String {
        let Some(x) = number else {
            return "--".to_string();
        };
        match self {
            Format::Whole => whole(x),
            Format::Ratio => ratio(x),
            Format::Part => percent(x),
            Format::Percent => format!("{}\\,\\%", percent(x)),
            Format::Rough => significant(x, 2),
            Format::Exact => significant(x, 3),
        }
    }
}

/// A whole number with thin spaces between groups of three digits, from 10 000 on also in four-digit company.
pub fn whole(x: f64) -> String {
    grouped(&format!("{x:.0}"))
}

/// A number of so many significant digits, never in scientific notation; zeros in place of digits that are not
/// significant.
pub fn significant(x: f64, digits: i32) -> String {
    if x == 0.0 || !x.is_finite() {
        return grouped(&format!("{x}"));
    }
    // The exponent after rounding: 9.96 has two digits before the point if two are kept.
    let rounded = format!("{x:.*e}", (digits - 1).max(0) as usize);
    let exponent = rounded.split_once('e').map_or("0", |(_, e)| e);
    let exponent: i32 = exponent.parse().expect("an exponent");
    let rounded: f64 = rounded.parse().expect("a number");
    let decimals = (digits - 1 - exponent).max(0) as usize;
    grouped(&format!("{rounded:.decimals$}"))
}

/// A ratio: two decimals below 10, one below 100, none from there on.
pub fn ratio(x: f64) -> String {
    match x.abs() {
        a if a < 9.995 => format!("{x:.2}"),
        a if a < 99.95 => format!("{x:.1}"),
        _ => whole(x),
    }
}

/// A part of 1 in percent, without the sign: one decimal, two significant digits if it is less than 1 percent.
pub fn percent(part: f64) -> String {
    let percent = part * 100.0;
    match percent.abs() {
        0.0 => "0".to_string(),
        p if p < 0.995 => significant(percent, 2),
        100.0 => "100".to_string(),
        // Not everything must not look like everything.
        p if p > 99.95 => format!("{:.2}", (percent * 100.0).floor() / 100.0),
        _ => format!("{percent:.1}"),
    }
}

/// Thin spaces between groups of three digits before the point.
fn grouped(number: &str) -> String {
    let (sign, digits) = match number.strip_prefix('-') {
        Some(digits) => ("$-$", digits),
        None => ("", number),
    };
    let (before, after) = digits.split_at(digits.find('.').unwrap_or(digits.len()));
    let mut text = String::new();
    for (i, digit) in before.chars().enumerate() {
        if i > 0 && (before.len() - i) % 3 == 0 && before.len() > 3 {
            text += "\\,";
        }
        text.push(digit);
    }
    format!("{sign}{text}{after}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thousands() {
        let numbers = [0.0, 999.0, 1000.0, 22_800.0, 1_013_499.0, -5.0];
        let expected = ["0", "999", "1\\,000", "22\\,800", "1\\,013\\,499", "$-$5"];
        assert_eq!(numbers.map(whole), expected);
    }

    #[test]
    fn significant_digits() {
        let two = [0.03795, 1.256, 33.07, 674.4, 5958.0, 9.96, 0.0].map(|x| significant(x, 2));
        assert_eq!(two, ["0.038", "1.3", "33", "670", "6\\,000", "10", "0"]);
        let three = [0.037_96, 1.0, 5958.0].map(|x| significant(x, 3));
        assert_eq!(three, ["0.0380", "1.00", "5\\,960"]);
    }

    #[test]
    fn ratios_and_percentages() {
        assert_eq!(
            [0.9262, 9.996, 10.82, 1234.5].map(ratio),
            ["0.93", "10.0", "10.8", "1\\,234"]
        );
        let parts = [0.0, 0.000_123, 0.0746, 0.9904, 0.999_99, 1.0].map(percent);
        assert_eq!(parts, ["0", "0.012", "7.5", "99.0", "99.99", "100"]);
    }
}
