//! What a run of a survey does: one of our algorithms with its number type, TetGen, or the check of the input.

use clap::ValueEnum;
use std::fmt;
use std::str::FromStr;
use tetflip::recover::polygons::{FlipOrder, Insertion};

/// An algorithm; the same word names it on the command line and in messages.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Algorithm {
    /// No mesh: whether the input is a valid PLC at all (`check`).
    Check,
    /// One of ours.
    Ours(Insertion),
    /// TetGen, which inserts facets by cavities (`tetgen`).
    TetgenCavity,
    /// TetGen with `-L`: by flips (`tetgen-flip`).
    TetgenFlip,
}

impl Algorithm {
    /// The words of the columns `insertion` and `times`.
    pub(super) fn columns(self) -> [String; 2] {
        let word = self.to_string();
        match word.split_once(':') {
            Some((insertion, times)) => [insertion.to_owned(), times.to_owned()],
            None => [word, String::new()],
        }
    }

    /// Whether this is another program.
    pub(super) fn is_foreign(self) -> bool {
        matches!(self, Algorithm::TetgenCavity | Algorithm::TetgenFlip)
    }
}

impl fmt::Display for Algorithm {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Algorithm::Check => f.write_str("check"),
            Algorithm::Ours(Insertion::Cavity) => f.write_str("cavity"),
            Algorithm::Ours(Insertion::GiftWrap) => f.write_str("gift-wrap"),
            Algorithm::Ours(Insertion::Flip(times)) => write!(f, "flip:{times}"),
            Algorithm::TetgenCavity => f.write_str("tetgen"),
            Algorithm::TetgenFlip => f.write_str("tetgen-flip"),
        }
    }
}

impl FromStr for Algorithm {
    type Err = String;

    fn from_str(word: &str) -> Result<Algorithm, String> {
        Ok(match word.split_once(':') {
            Some(("flip", times)) => Algorithm::Ours(Insertion::Flip(
                times
                    .parse::<FlipOrder>()
                    .map_err(|unknown| unknown.to_string())?,
            )),
            None if word == "check" => Algorithm::Check,
            None if word == "cavity" => Algorithm::Ours(Insertion::Cavity),
            None if word == "gift-wrap" => Algorithm::Ours(Insertion::GiftWrap),
            None if word == "flip" => Algorithm::Ours(Insertion::Flip(FlipOrder::FILTERED)),
            None if word == "tetgen" => Algorithm::TetgenCavity,
            None if word == "tetgen-flip" => Algorithm::TetgenFlip,
            _ => {
                return Err(
                    "no method; there are check, cavity, gift-wrap, flip:TYPE, tetgen and tetgen-flip"
                        .to_owned(),
                );
            }
        })
    }
}

/// Where Steiner points are.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub(super) enum Steiner {
    /// Rounded to doubles, so that they are near their segments.
    Rounded,
    /// Exactly on their segments.
    Exact,
}

impl fmt::Display for Steiner {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Steiner::Rounded => f.write_str("rounded"),
            Steiner::Exact => f.write_str("exact"),
        }
    }
}

/// An algorithm and the Steiner points it is given.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Method {
    /// How polygons are inserted.
    pub algorithm: Algorithm,
    /// Where Steiner points are.
    pub steiner: Steiner,
}

impl Method {
    /// The words of the columns `insertion`, `times` and `steiner`, which tell the rows of a model apart.
    pub(super) fn columns(self) -> [String; 3] {
        let [insertion, times] = self.algorithm.columns();
        let steiner = match self.algorithm {
            Algorithm::Check => String::new(),
            _ => self.steiner.to_string(),
        };
        [insertion, times, steiner]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_word_of_an_algorithm_names_it() {
        for word in [
            "check",
            "cavity",
            "gift-wrap",
            "flip:filtered",
            "flip:bits:24",
            "flip:naive:53",
            "tetgen",
            "tetgen-flip",
        ] {
            let algorithm: Algorithm = word.parse().expect(word);
            assert_eq!(algorithm.to_string(), word);
        }
        assert_eq!(
            "flip".parse(),
            Ok(Algorithm::Ours(Insertion::Flip(FlipOrder::FILTERED)))
        );
        for word in ["", "flips", "flip:", "cavity:f64", "flip:f65"] {
            assert!(word.parse::<Algorithm>().is_err(), "{word}");
        }
        let bits: Algorithm = "flip:bits:24".parse().expect("a method");
        assert_eq!(bits.columns(), ["flip", "bits:24"]);
    }
}
