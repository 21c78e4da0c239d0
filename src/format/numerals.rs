//! The numbers that words of a text file are.

/// The whole number that a word with few digits is, as most are; `str::parse` would say the same.
pub(super) fn whole(token: &[u8]) -> Option<i64> {
    let digits = token.strip_prefix(b"-").unwrap_or(token);
    if !(1..=18).contains(&digits.len()) {
        return None;
    }
    let mut number = 0;
    for digit in digits {
        match digit.wrapping_sub(b'0') {
            digit @ 0..=9 => number = 10 * number + i64::from(digit),
            _ => return None,
        }
    }
    Some(if digits.len() < token.len() {
        -number
    } else {
        number
    })
}

/// The number that Fortran writes with D in the place of E, as in `1.5D+00`. (It leaves the letter out before an
/// exponent of three digits; then the word could be two numbers as well, and is none.)
#[cold]
pub(super) fn fortran(token: &[u8]) -> Option<f64> {
    let at = token.iter().position(|b| matches!(b, b'd' | b'D'))?;
    let mut text = std::str::from_utf8(token).ok()?.to_owned();
    text.replace_range(at..=at, "e");
    text.parse().ok()
}

/// Whether a word is a number but for a comma: `1,5` or `-2,50e3`.
pub(super) fn has_decimal_comma(token: &[u8]) -> bool {
    let text = std::str::from_utf8(token).unwrap_or_default();
    let (whole, fraction) = text.split_once(',').unwrap_or_default();
    let digit = |c: Option<char>| c.is_some_and(|c| c.is_ascii_digit());
    digit(whole.chars().next_back())
        && digit(fraction.chars().next())
        && text.replacen(',', ".", 1).parse::<f64>().is_ok()
}

/// Whether the fields of a line, of which at least two are separated by a comma without a blank, have nothing but
/// such commas between them. `1,0.5,0,0` is so; in `1 0,5 0,0 0,0` the commas are decimal ones; and in `8,000` or
/// `1,000,000` they may be for thousands.
#[cold]
pub(super) fn is_separated_by_commas(line: &[u8]) -> bool {
    let mut fields = line.trim_ascii().split(|&b| b == b',');
    let first = fields.next().unwrap_or_default();
    let is_field = |f: &[u8]| !f.is_empty() && !f.iter().any(u8::is_ascii_whitespace);
    let is_thousands = |f: &[u8]| f.len() == 3 && f.iter().all(u8::is_ascii_digit);
    is_field(first) && fields.clone().all(is_field) && !fields.all(is_thousands)
}

/// The first 40 characters of a word, which in a binary file can be very long.
pub(super) fn shorten(token: &[u8]) -> String {
    let text = String::from_utf8_lossy(&token[..token.len().min(160)]);
    text.chars().take(40).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commas_that_can_only_separate() {
        for line in ["1,0.5,0,0", " 6,1 ", "1,0,0,0", "1,000,5", "-1,2,3"] {
            assert!(is_separated_by_commas(line.as_bytes()), "{line}");
        }
        for line in [
            "1 0,5",
            "1, 0,5",
            "8,000",
            "1,000,000",
            "1,,2",
            "1,2,",
            "v 1,2,3",
        ] {
            assert!(!is_separated_by_commas(line.as_bytes()), "{line}");
        }
    }

    #[test]
    fn exponents_of_fortran() {
        assert_eq!(fortran(b"-1.5D+02"), Some(-150.0));
        assert_eq!(fortran(b".5d0"), Some(0.5));
        for bad in [
            &b"1.5"[..],
            b"D",
            b"1D",
            b"1D5D5",
            b"1E5D5",
            b"d5",
            b"0x1d",
            b"1.0-100",
        ] {
            assert_eq!(fortran(bad), None, "{bad:?}");
        }
    }
}
