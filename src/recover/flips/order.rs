//! The orders of flips that there are, by name: one table of number types, and the rules that rounded ones may have.

use super::numbers::{
    ExactNumbers, FilteredNumbers, FlipNumbers, NaiveNumbers, NaiveWideNumbers, RoundedNumbers,
    WideNumbers,
};
use super::rounded::Evaluation::{Once, Paper, Plain, TetGen};
use super::ties::{Rules, UnknownRule};
use crate::number::{Bits, Dyadic, UnknownBits};
use num_rational::BigRational;
use serde::{Serialize, Serializer};
use std::fmt;
use std::str::FromStr;

/// How far an order can be trusted.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Exactness {
    /// The order of flips is the true one.
    Exact,
    /// Times are rounded; all other predicates are exact.
    Rounded,
    /// Not even orientations are exact.
    Naive,
}

/// Something to do with a number type, whichever it is.
pub trait NumberTask {
    /// What comes of it.
    type Output;

    /// Does it.
    fn with<T: FlipNumbers>(self, numbers: &T) -> Self::Output;
}

/// From the table: variants, each with what it carries, its word, its exactness, and how to make it, given the rules.
macro_rules! number_types {
    ($rules:ident: $(
        $(#[doc = $doc:literal])*
        $type:ident $(($field:ident: $payload:ty))? = $word:literal, $exactness:ident, $numbers:expr
        $(, only if $cfg:meta)?;
    )*) => {
        /// The number type of flip times. Its word, for the command line and for tables, is in parentheses.
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
        pub enum NumberType {
            $(
                $(#[doc = $doc])*
                $(#[cfg($cfg)])?
                $type $(($payload))?,
            )*
        }

        impl NumberType {
            /// How far it can be trusted.
            pub fn exactness(self) -> Exactness {
                match self {
                    $($(#[cfg($cfg)])? NumberType::$type $(($field))? => {
                        $(let _ = $field;)?
                        Exactness::$exactness
                    })*
                }
            }

            /// Does a task with it.
            fn run<J: NumberTask>(self, $rules: Rules, task: J) -> J::Output {
                match self {
                    $($(#[cfg($cfg)])? NumberType::$type $(($field))? => task.with(&$numbers),)*
                }
            }
        }

        impl fmt::Display for NumberType {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                match self {
                    $($(#[cfg($cfg)])? NumberType::$type $(($field))? => {
                        f.write_str($word)$(.and_then(|()| write!(f, ":{}", $field)))?
                    })*
                }
            }
        }

        impl FromStr for NumberType {
            type Err = UnknownOrder;

            fn from_str(word: &str) -> Result<NumberType, UnknownOrder> {
                let (name, parameter) = match word.split_once(':') {
                    Some((name, parameter)) => (name, Some(parameter)),
                    None => (word, None),
                };
                if word == "f64" {
                    return Ok(NumberType::F64Paper);
                }
                $($(#[cfg($cfg)])? {
                    number_types!(@parse $type $word, word, name, parameter, $($payload)?);
                })*
                match word {
                    "rug" => Err(UnknownOrder::NoGmp),
                    _ => Err(UnknownOrder::Word(word.to_owned())),
                }
            }
        }
    };
    (@parse $type:ident $expected:literal, $word:ident, $name:ident, $parameter:ident,) => {
        if $word == $expected {
            return Ok(NumberType::$type);
        }
    };
    (@parse $type:ident $expected:literal, $word:ident, $name:ident, $parameter:ident, $payload:ty) => {
        if let (true, Some(parameter)) = ($name == $expected, $parameter) {
            return Ok(NumberType::$type(parameter.parse::<$payload>()?));
        }
    };
}

number_types! { rules:
    /// Doubles, evaluated as the paper's text says: weights by the adaptive Orient3D, adaptive InSphere and Orient4D
    /// (`f64:paper`, or `f64`).
    F64Paper = "f64:paper", Rounded, RoundedNumbers::<f64>::new(Paper, rules);
    /// Doubles, evaluated as TetGen 1.5 is known to do it: the same with weights in plain doubles (`f64:tetgen`).
    F64TetGen = "f64:tetgen", Rounded, RoundedNumbers::<f64>::new(TetGen, rules);
    /// Doubles, every operation rounded; only the sign of D is exact (`f64:plain`).
    F64Plain = "f64:plain", Rounded, RoundedNumbers::<f64>::new(Plain, rules);
    /// Doubles: N and D are computed exactly, and each is rounded once (`f64:once`).
    F64Once = "f64:once", Rounded, RoundedNumbers::<f64>::new(Once, rules);
    /// Single precision, every operation rounded (`f32`).
    F32 = "f32", Rounded, RoundedNumbers::<f32>::new(Plain, rules);
    /// Single precision: exact N and D, each rounded once (`f32:once`).
    F32Once = "f32:once", Rounded, RoundedNumbers::<f32>::new(Once, rules);
    /// A chosen number of mantissa bits, with unbounded exponents, every operation rounded (`bits:106`).
    Wide(bits: Bits) = "bits", Rounded, WideNumbers { bits, evaluation: Plain, rules };
    /// The same: exact N and D, each rounded once (`once:106`).
    WideOnce(bits: Bits) = "once", Rounded, WideNumbers { bits, evaluation: Once, rules };
    /// Float enclosures, exact dyadic numbers where they overlap, and the perturbation: the exact order, mostly at the
    /// price of floats (`filtered`).
    Filtered = "filtered", Exact, FilteredNumbers;
    /// Exact dyadic numbers, and the perturbation (`exact`).
    Exact = "exact", Exact, ExactNumbers::<Dyadic>::default();
    /// Exact rationals, and the perturbation (`rational`).
    Rational = "rational", Exact, ExactNumbers::<BigRational>::default();
    /// GMP rationals, and the perturbation (`rug`).
    Rug = "rug", Exact, ExactNumbers::<rug::Rational>::default(), only if feature = "rug";
    /// No exact predicate at all while a region is inserted: sides, convexity, insphere and times in double precision
    /// (`naive`). What comes of it is judged exactly.
    Naive = "naive", Naive, NaiveNumbers;
    /// The same in a chosen number of mantissa bits (`naive:24`).
    NaiveWide(bits: Bits) = "naive", Naive, NaiveWideNumbers(bits);
}

/// In which order the flips of an insertion are done: a number type for their times, and for a rounded one the rules of
/// its queue (`f64:paper,ties=perturbed,queue=possible`).
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct FlipOrder {
    /// The number type.
    pub numbers: NumberType,
    /// Of exact and of naive ones always the default.
    rules: Rules,
}

impl From<NumberType> for FlipOrder {
    fn from(numbers: NumberType) -> FlipOrder {
        FlipOrder::new(numbers)
    }
}

impl FlipOrder {
    /// The exact order, mostly at the price of floats.
    pub const FILTERED: FlipOrder = FlipOrder::new(NumberType::Filtered);

    /// The exact order in dyadic numbers.
    pub const EXACT: FlipOrder = FlipOrder::new(NumberType::Exact);

    /// The order of a number type, with the paper's rules if it is a rounded one.
    pub const fn new(numbers: NumberType) -> FlipOrder {
        const PAPER: Rules = Rules::ALL[0];
        FlipOrder {
            numbers,
            rules: PAPER,
        }
    }

    /// The same with other rules, which exact and naive orders do not have.
    #[must_use]
    pub fn with_rules(mut self, rules: Rules) -> FlipOrder {
        if self.numbers.exactness() == Exactness::Rounded {
            self.rules = rules;
        }
        self
    }

    /// The rules.
    pub fn rules(self) -> Rules {
        self.rules
    }

    /// Whether the order of flips is the true one.
    pub fn is_exact(self) -> bool {
        self.numbers.exactness() == Exactness::Exact
    }

    /// Whether not even orientations are exact.
    pub fn is_naive(self) -> bool {
        self.numbers.exactness() == Exactness::Naive
    }

    /// The same order of times over exact predicates, where they were rounded.
    pub(super) fn without_naivety(mut self) -> FlipOrder {
        self.numbers = match self.numbers {
            NumberType::Naive => NumberType::F64Plain,
            NumberType::NaiveWide(bits) => NumberType::Wide(bits),
            numbers => numbers,
        };
        self
    }

    /// Does a task with the number type.
    pub fn run<J: NumberTask>(self, task: J) -> J::Output {
        self.numbers.run(self.rules, task)
    }
}

impl fmt::Display for FlipOrder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(&format!("{}{}", self.numbers, self.rules))
    }
}

/// A word that names no [`FlipOrder`].
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum UnknownOrder {
    /// No such word.
    #[error(
        "{0:?} is no number type; there are f64:paper (or f64), f64:tetgen, f64:plain, f64:once, f32, f32:once, \
         bits:N, once:N, filtered, exact, rational, rug, naive and naive:N"
    )]
    Word(String),
    /// No such number of bits.
    #[error(transparent)]
    Bits(#[from] UnknownBits),
    /// No such rule.
    #[error(transparent)]
    Rule(#[from] UnknownRule),
    /// Rules for a number type that has none.
    #[error(
        "only rounded number types (f64:…, f32, bits:N, …) have rules for ties and for the queue; {0} has none"
    )]
    NoRules(NumberType),
    /// GMP rationals are a feature of the build.
    #[error("this program was built without GMP; build it with --features rug")]
    NoGmp,
}

impl FromStr for FlipOrder {
    type Err = UnknownOrder;

    fn from_str(words: &str) -> Result<FlipOrder, UnknownOrder> {
        let Some((word, rules)) = words.split_once(',') else {
            return Ok(FlipOrder::new(words.parse()?));
        };
        let numbers: NumberType = word.parse()?;
        if numbers.exactness() != Exactness::Rounded {
            return Err(UnknownOrder::NoRules(numbers));
        }
        Ok(FlipOrder::new(numbers).with_rules(rules.parse()?))
    }
}

impl Serialize for FlipOrder {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

#[cfg(test)]
mod tests {
    use super::super::numbers::is_exact;
    use super::*;
    use crate::predicate::DoublePoints;

    const WORDS: &str = "f64:paper f64:tetgen f64:plain f64:once f32 f32:once bits:8 bits:106 once:64 \
        filtered exact rational naive naive:24 f64:paper,ties=perturbed f32,queue=possible bits:64,ties=circuit,queue=possible";

    #[test]
    fn words_and_orders_are_one_to_one() {
        for word in WORDS.split_whitespace() {
            assert_eq!(word.parse::<FlipOrder>().expect(word).to_string(), word);
        }
        let exact = WORDS
            .split_whitespace()
            .filter(|w| w.parse().is_ok_and(FlipOrder::is_exact));
        assert_eq!(exact.collect::<Vec<_>>(), ["filtered", "exact", "rational"]);
        let [f64, paper] =
            ["f64,queue=possible", "f64:paper,queue=possible"].map(str::parse::<FlipOrder>);
        assert_eq!(f64, paper);
        assert_eq!("rug".parse::<FlipOrder>().is_ok(), cfg!(feature = "rug"));
    }

    #[test]
    fn other_words_are_refused_with_what_there_is() {
        for word in [
            "", "F64", "bits", "bits:", "bits:31", "naive:-8", "exact:53",
        ] {
            let error = word.parse::<FlipOrder>().expect_err(word).to_string();
            assert!(error.contains("bits"), "{word}: {error}");
        }
        for word in ["exact,ties=arrival", "naive,queue=all"] {
            let error = word.parse::<FlipOrder>().expect_err(word).to_string();
            assert!(error.contains("has none"), "{word}: {error}");
        }
        let error = "f64,ties=none".parse::<FlipOrder>().expect_err("no rule");
        assert!(error.to_string().contains("ties=circuit"), "{error}");
    }

    /// What the table says of a type is what the type says.
    #[test]
    fn the_table_is_right_about_exactness() {
        struct Told(Exactness);

        impl NumberTask for Told {
            type Output = bool;

            fn with<T: FlipNumbers>(self, _: &T) -> bool {
                let exact = is_exact::<T, DoublePoints>();
                match self.0 {
                    Exactness::Exact => exact && !T::NAIVE,
                    Exactness::Rounded => !exact && !T::NAIVE,
                    Exactness::Naive => !exact && T::NAIVE,
                }
            }
        }

        for word in WORDS.split_whitespace() {
            let order: FlipOrder = word.parse().expect(word);
            assert!(order.run(Told(order.numbers.exactness())), "{word}");
        }
    }
}
