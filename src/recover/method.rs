//! Which algorithm inserts polygons, and with which numbers.

use crate::number::{Bits, UnknownBits};
use serde::{Serialize, Serializer};
use std::fmt;
use std::str::FromStr;

/// The number type of the flip queue. Its word, for the command line and for tables, is in parentheses.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Times {
    /// Quotients rounded to single precision (`f32`).
    F32,
    /// Quotients rounded to double precision: the paper's own (`f64`).
    F64,
    /// Quotients rounded to a chosen number of mantissa bits, with unbounded exponents (`bits:106`).
    Wide(Bits),
    /// Float enclosures, exact dyadic numbers where they overlap, and the perturbation: the exact order, mostly at the
    /// price of floats (`filtered`).
    Filtered,
    /// Exact dyadic numbers, and the perturbation (`exact`).
    Exact,
    /// Exact rationals, and the perturbation (`rational`).
    Rational,
    /// GMP rationals, and the perturbation (`rug`).
    #[cfg(feature = "rug")]
    Rug,
    /// No exact predicate at all while a region is inserted: sides, convexity, insphere and times in double precision
    /// (`naive`). What comes of it is judged exactly.
    Naive,
    /// The same in a chosen number of mantissa bits (`naive:24`).
    NaiveWide(Bits),
}

impl Times {
    /// Whether the order of flips is the true one.
    pub fn is_exact(self) -> bool {
        match self {
            Times::Filtered | Times::Exact | Times::Rational => true,
            #[cfg(feature = "rug")]
            Times::Rug => true,
            _ => false,
        }
    }

    /// Whether not even orientations are exact.
    pub fn is_naive(self) -> bool {
        matches!(self, Times::Naive | Times::NaiveWide(_))
    }
}

impl fmt::Display for Times {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Times::F32 => f.pad("f32"),
            Times::F64 => f.pad("f64"),
            Times::Wide(bits) => f.pad(&format!("bits:{bits}")),
            Times::Filtered => f.pad("filtered"),
            Times::Exact => f.pad("exact"),
            Times::Rational => f.pad("rational"),
            #[cfg(feature = "rug")]
            Times::Rug => f.pad("rug"),
            Times::Naive => f.pad("naive"),
            Times::NaiveWide(bits) => f.pad(&format!("naive:{bits}")),
        }
    }
}

/// A word that names no [`Times`].
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum UnknownTimes {
    /// No such word.
    #[error(
        "{0:?} is no number type; there are f32, f64, bits:N, filtered, exact, rational, rug, naive and naive:N"
    )]
    Word(String),
    /// No such number of bits.
    #[error(transparent)]
    Bits(#[from] UnknownBits),
    /// GMP rationals are a feature of the build.
    #[error("this program was built without GMP; build it with --features rug")]
    NoGmp,
}

impl FromStr for Times {
    type Err = UnknownTimes;
    fn from_str(word: &str) -> Result<Times, UnknownTimes> {
        Ok(match word.split_once(':') {
            Some(("bits", bits)) => Times::Wide(bits.parse()?),
            Some(("naive", bits)) => Times::NaiveWide(bits.parse()?),
            Some(_) => return Err(UnknownTimes::Word(word.to_owned())),
            None => match word {
                "f32" => Times::F32,
                "f64" => Times::F64,
                "filtered" => Times::Filtered,
                "exact" => Times::Exact,
                "rational" => Times::Rational,
                #[cfg(feature = "rug")]
                "rug" => Times::Rug,
                #[cfg(not(feature = "rug"))]
                "rug" => return Err(UnknownTimes::NoGmp),
                "naive" => Times::Naive,
                _ => return Err(UnknownTimes::Word(word.to_owned())),
            },
        })
    }
}

impl Serialize for Times {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

/// The algorithm that inserts a polygon.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Insertion {
    /// Cavity retriangulation (paper §3.1).
    Cavity,
    /// Gift wrapping of the two cavities (Shewchuk 2002; paper §3.1): the baseline, in quadratic time.
    #[serde(rename = "gift-wrap")]
    GiftWrap,
    /// Bistellar flips in order of their times (paper §3.2).
    Flip(Times),
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_and_times_are_one_to_one() {
        let words = "f32 f64 bits:8 bits:106 filtered exact rational naive naive:24";
        for word in words.split(' ') {
            assert_eq!(word.parse::<Times>().expect(word).to_string(), word);
        }
        let exact = words
            .split(' ')
            .filter(|w| w.parse().is_ok_and(Times::is_exact));
        assert_eq!(exact.collect::<Vec<_>>(), ["filtered", "exact", "rational"]);
        assert_eq!("rug".parse::<Times>().is_ok(), cfg!(feature = "rug"));
    }

    #[test]
    fn other_words_are_refused_with_what_there_is() {
        for word in [
            "", "F64", "bits", "bits:", "bits:31", "naive:-8", "exact:53",
        ] {
            let error = word.parse::<Times>().expect_err(word).to_string();
            assert!(error.contains("bits"), "{word}: {error}");
        }
    }
}
