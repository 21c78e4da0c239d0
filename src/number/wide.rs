//! Floats with a chosen number of mantissa bits, to see how many the order of flips needs.
//!
//! A [`Wide`] is a [`Dyadic`] that is rounded after every operation: the operation is exact, and the one rounding that
//! follows, to nearest with ties to even, makes it correct by construction. (An arbitrary precision float of a crate
//! would bring its precision as a value at run time, with rules for operands of different precisions, where here it is
//! part of the type.) The exponent is unbounded, so nothing overflows or underflows, there is one zero, and there is no
//! NaN; within the exponents of a double, `Wide<53>` is an `f64` and `Wide<24>` an `f32`.
//!
//! Cost: that of a dyadic, plus a shift; a few dozen nanoseconds per operation as long as products fit two words.

use super::{Dyadic, Float, Number, Sign};
use dashu_int::ops::{BitTest, DivRem};
use dashu_int::{IBig, UBig};
use std::cmp::Ordering;
use std::fmt;
use std::ops::{Add, Mul, Sub};
use std::str::FromStr;

/// A binary float of `BITS` ≥ 1 mantissa bits, the leading one included, and unbounded exponent.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Wide<const BITS: u32>(Dyadic);

/// m·2^e rounded to `bits` bits, to nearest, ties to even.
fn rounded(number: Dyadic, bits: u32) -> Dyadic {
    let length = number.mantissa.bit_len();
    let bits = bits as usize;
    if length <= bits {
        return number;
    }
    let drop = length - bits;
    let (sign, magnitude) = number.mantissa.into_parts();
    let at_least_half = magnitude.bit(drop - 1);
    let above_half = magnitude.trailing_zeros() < Some(drop - 1);
    let mut head = magnitude >> drop;
    if at_least_half && (above_half || head.bit(0)) {
        // May become 2^bits, one bit longer, but a power of two.
        head += UBig::ONE;
    }
    Dyadic {
        mantissa: IBig::from_parts(sign, head),
        exponent: number.exponent + drop as i64,
    }
}

impl<const BITS: u32> Wide<BITS> {
    /// The number nearest to x.
    pub fn nearest(x: Dyadic) -> Self {
        const { assert!(BITS >= 1) };
        Wide(rounded(x, BITS))
    }

    /// The exact value.
    pub fn value(&self) -> &Dyadic {
        &self.0
    }

    /// The exact value.
    pub fn into_value(self) -> Dyadic {
        self.0
    }

    /// self / d, rounded; `None` if d = 0.
    #[must_use]
    pub fn quotient(&self, d: &Self) -> Option<Self> {
        quotient(&self.0, &d.0, BITS).map(Wide)
    }
}

/// n/d rounded to `bits` bits; `None` if d = 0.
fn quotient(n: &Dyadic, d: &Dyadic, bits: u32) -> Option<Dyadic> {
    if d.mantissa == IBig::ZERO {
        return None;
    }
    // A quotient of at least bits + 2 bits, with one more bit that says whether there is a remainder, rounds as the
    // exact quotient does.
    let wanted = d.mantissa.bit_len() + bits as usize + 2;
    let shift = wanted.saturating_sub(n.mantissa.bit_len());
    let (sign_n, magnitude_n) = (n.mantissa.clone() << shift).into_parts();
    let (sign_d, magnitude_d) = d.mantissa.clone().into_parts();
    let (head, rest) = magnitude_n.div_rem(magnitude_d);
    let sticky = UBig::from(u8::from(rest != UBig::ZERO));
    let quotient = Dyadic {
        mantissa: IBig::from_parts(sign_n * sign_d, (head << 1) + sticky),
        exponent: n.exponent - d.exponent - shift as i64 - 1,
    };
    Some(rounded(quotient, bits))
}

impl<const BITS: u32> Add<&Wide<BITS>> for Wide<BITS> {
    type Output = Self;
    fn add(self, other: &Self) -> Self {
        Wide::nearest(self.0 + &other.0)
    }
}

impl<const BITS: u32> Sub<&Wide<BITS>> for Wide<BITS> {
    type Output = Self;
    fn sub(self, other: &Self) -> Self {
        Wide::nearest(self.0 - &other.0)
    }
}

impl<const BITS: u32> Mul<&Wide<BITS>> for Wide<BITS> {
    type Output = Self;
    fn mul(self, other: &Self) -> Self {
        Wide::nearest(self.0 * &other.0)
    }
}

impl<const BITS: u32> Number for Wide<BITS> {
    fn from_f64(x: f64) -> Self {
        Wide::nearest(Dyadic::from_f64(x))
    }

    /// Never `None`, and may lie, as that of every rounded type.
    fn sign(&self) -> Option<Sign> {
        self.0.sign()
    }

    fn to_f64(&self) -> f64 {
        self.0.to_f64()
    }
}

impl<const BITS: u32> Float for Wide<BITS> {
    fn negated_quotient(n: &Self, d: &Self) -> Option<Self> {
        let quotient = n.quotient(d)?;
        Some(Wide(quotient.0.negated()))
    }

    fn compare(a: &Self, b: &Self) -> Ordering {
        a.0.cmp(&b.0)
    }

    fn nearest(x: &Dyadic) -> Self {
        Wide::nearest(x.clone())
    }
}

/// A number of mantissa bits for which this build has a [`Wide`]: one of [`Bits::ALL`].
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Bits(u32);

/// What is to be done with floats whose number of bits is known only at run time. It is compiled once for every width,
/// so it had better be short.
pub trait WidthTask {
    /// The result.
    type Output;

    /// Does it.
    fn with<const BITS: u32>(self) -> Self::Output;
}

macro_rules! widths {
    ($($bits:literal)*) => {
        impl Bits {
            /// All of them, ascending.
            pub const ALL: &'static [Bits] = &[$(Bits($bits)),*];

            /// Does a task in the [`Wide`] of this many bits.
            pub fn run<T: WidthTask>(self, task: T) -> T::Output {
                match self.0 {
                    $($bits => task.with::<$bits>(),)*
                    _ => unreachable!("only listed widths are made"),
                }
            }
        }
    };
}

// 11, 24 and 53 bits are those of half, single and double precision, 8 those of bfloat16, 64 of x87, 106 of
// double-double.
widths!(8 11 14 16 18 20 22 24 26 28 32 36 40 44 48 53 64 80 106 160 256);

impl Bits {
    /// The width of this many bits, if it is one of [`Bits::ALL`].
    pub fn new(bits: u32) -> Option<Bits> {
        Bits::ALL.iter().copied().find(|b| b.0 == bits)
    }

    /// How many.
    pub fn get(self) -> u32 {
        self.0
    }
}

impl fmt::Display for Bits {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

/// A word that is none of the numbers of bits in [`Bits::ALL`].
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
#[error(
    "{word:?} is no number of bits that this program has; it has {}",
    listed()
)]
pub struct UnknownBits {
    /// The word.
    pub word: String,
}

fn listed() -> String {
    let names: Vec<String> = Bits::ALL.iter().map(Bits::to_string).collect();
    names.join(", ")
}

impl FromStr for Bits {
    type Err = UnknownBits;
    fn from_str(word: &str) -> Result<Bits, UnknownBits> {
        let bits = word.parse().ok().and_then(Bits::new);
        bits.ok_or_else(|| UnknownBits {
            word: word.to_owned(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ties_go_to_even() {
        // In three bits 16, 20, 24 and 28 are neighbours, and 32 and 40 are.
        let table = [
            (18, 16),
            (19, 20),
            (22, 24),
            (26, 24),
            (30, 32),
            (36, 32),
            (37, 40),
        ];
        for (x, nearest) in table {
            assert_eq!(
                Wide::<3>::from_f64(f64::from(x)).to_f64(),
                f64::from(nearest)
            );
            assert_eq!(
                Wide::<3>::from_f64(f64::from(-x)).to_f64(),
                f64::from(-nearest)
            );
        }
    }

    #[test]
    fn nothing_overflows_and_nothing_underflows() {
        let tiny = Wide::<24>::from_f64(5e-324);
        let square = tiny.clone() * &tiny;
        assert_eq!(square.sign(), Some(Sign::Positive));
        assert_eq!(square.quotient(&tiny), Some(tiny.clone()));
        assert_eq!(tiny.quotient(&Wide::from_f64(0.0)), None);
        assert_eq!(Wide::<24>::compare(&square, &tiny), Ordering::Less);
    }

    #[test]
    fn bits_are_listed_or_unknown() {
        assert!(Bits::ALL.is_sorted());
        for &bits in Bits::ALL {
            assert_eq!(bits.to_string().parse(), Ok(bits));
        }
        let error = "31"
            .parse::<Bits>()
            .expect_err("not in the list")
            .to_string();
        assert!(
            error.contains("31") && error.contains("8, 11, 14"),
            "{error}"
        );
    }
}
