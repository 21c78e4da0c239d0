//! Dyadic numbers m·2^e: the ring that the doubles generate. Sums, differences and products are exact; there is no
//! division, hence no gcd, which makes it several times faster than a rational.

use super::bits::parts;
use super::{Exact, Number, Sign};
use dashu_int::IBig;
use std::cmp::Ordering;
use std::ops::{Add, Mul, Sub};

/// m·2^e with an integer m of any size. Not kept in lowest terms; equality compares values.
#[derive(Clone, Debug)]
pub struct Dyadic {
    pub(super) mantissa: IBig,
    pub(super) exponent: i64,
}

impl Dyadic {
    /// Zero.
    pub const ZERO: Dyadic = Dyadic {
        mantissa: IBig::ZERO,
        exponent: 0,
    };

    /// self·2^k.
    #[must_use]
    pub fn shifted(mut self, k: i64) -> Dyadic {
        self.exponent += k;
        self
    }

    /// −self.
    #[must_use]
    pub fn negated(self) -> Dyadic {
        Dyadic {
            mantissa: -self.mantissa,
            exponent: self.exponent,
        }
    }

    /// self/other rounded to one of the two doubles next to it;
    /// infinite or zero outside the range of doubles. `other` is not zero.
    pub fn quotient(&self, other: &Dyadic) -> f64 {
        use dashu_int::ops::BitTest;
        let bits = |x: &IBig| x.bit_len() as i64;
        let shift = (bits(&other.mantissa) - bits(&self.mantissa) + 70).max(0);
        let quotient = Dyadic {
            mantissa: (&self.mantissa << shift as usize) / &other.mantissa,
            exponent: self.exponent - other.exponent - shift,
        };
        quotient.to_f64()
    }

    /// Whether it is negative, the bytes of the odd integer that is its absolute value but for a power of two, the
    /// least significant first, and the exponent of that power.
    pub(crate) fn parts(&self) -> (bool, Box<[u8]>, i64) {
        let zeros = self.mantissa.trailing_zeros().unwrap_or(0);
        let (sign, magnitude) = self.mantissa.clone().into_parts();
        let odd = magnitude >> zeros;
        let negative = sign == dashu_int::Sign::Negative;
        (negative, odd.to_le_bytes(), self.exponent + zeros as i64)
    }

    fn is_zero(&self) -> bool {
        self.mantissa == IBig::ZERO
    }

    /// Both mantissas over the smaller of the two exponents.
    fn combine(self, other: &Dyadic, apply: impl FnOnce(IBig, &IBig) -> IBig) -> Dyadic {
        let shift = self.exponent - other.exponent;
        if shift == 0 {
            Dyadic {
                mantissa: apply(self.mantissa, &other.mantissa),
                exponent: self.exponent,
            }
        } else if shift > 0 {
            Dyadic {
                mantissa: apply(self.mantissa << shift as usize, &other.mantissa),
                exponent: other.exponent,
            }
        } else {
            let theirs = &other.mantissa << shift.unsigned_abs() as usize;
            Dyadic {
                mantissa: apply(self.mantissa, &theirs),
                exponent: self.exponent,
            }
        }
    }
}

impl Add<&Dyadic> for Dyadic {
    type Output = Dyadic;
    fn add(self, other: &Dyadic) -> Dyadic {
        if other.is_zero() {
            return self;
        }
        if self.is_zero() {
            return other.clone();
        }
        self.combine(other, |a, b| a + b)
    }
}

impl Sub<&Dyadic> for Dyadic {
    type Output = Dyadic;
    fn sub(self, other: &Dyadic) -> Dyadic {
        if other.is_zero() {
            return self;
        }
        if self.is_zero() {
            return other.clone().negated();
        }
        self.combine(other, |a, b| a - b)
    }
}

impl Mul<&Dyadic> for Dyadic {
    type Output = Dyadic;
    fn mul(self, other: &Dyadic) -> Dyadic {
        if self.is_zero() || other.is_zero() {
            return Dyadic::ZERO;
        }
        Dyadic {
            mantissa: self.mantissa * &other.mantissa,
            exponent: self.exponent + other.exponent,
        }
    }
}

impl PartialEq for Dyadic {
    fn eq(&self, other: &Dyadic) -> bool {
        (self.clone() - other).is_zero()
    }
}

impl Eq for Dyadic {}

impl PartialOrd for Dyadic {
    fn partial_cmp(&self, other: &Dyadic) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Dyadic {
    fn cmp(&self, other: &Dyadic) -> Ordering {
        (self.clone() - other).mantissa.cmp(&IBig::ZERO)
    }
}

impl Number for Dyadic {
    fn from_f64(x: f64) -> Dyadic {
        assert!(x.is_finite(), "coordinates are finite");
        if x == 0.0 {
            return Dyadic::ZERO;
        }
        let (magnitude, exponent) = parts(x);
        let zeros = magnitude.trailing_zeros();
        let magnitude = (magnitude >> zeros) as i64;
        Dyadic {
            mantissa: IBig::from(if x < 0.0 { -magnitude } else { magnitude }),
            exponent: i64::from(exponent) + i64::from(zeros),
        }
    }

    fn sign(&self) -> Option<Sign> {
        Some(Sign::from(self.mantissa.cmp(&IBig::ZERO)))
    }

    /// The nearest double, of two the even one; infinite or zero outside the range of doubles.
    fn to_f64(&self) -> f64 {
        use dashu_int::ops::BitTest;
        let Some(zeros) = self.mantissa.trailing_zeros() else {
            return 0.0;
        };
        // The value is below 2^top; a double near it is a multiple of 2^unit.
        let top = self.exponent + self.mantissa.bit_len() as i64;
        if top > 1024 {
            let is_negative = self.mantissa < IBig::ZERO;
            return if is_negative {
                f64::NEG_INFINITY
            } else {
                f64::INFINITY
            };
        }
        let unit = (top - 53).max(-1074);
        // In quarters of that unit, rounded down, and odd if anything is lost: which side of a half it is on is seen.
        let drop = unit - 2 - self.exponent;
        let quarters = if drop <= 0 {
            &self.mantissa << drop.unsigned_abs() as usize
        } else {
            let lost = i64::from((zeros as i64) < drop);
            (&self.mantissa >> drop as usize) | IBig::from(lost)
        };
        let quarters = i64::try_from(quarters).expect("at most 56 bits");
        let (down, part) = (quarters >> 2, quarters & 3);
        let up = part == 3 || part == 2 && down & 1 == 1;
        // Steps that a double can hold: the product is a double, so that no step rounds.
        let (first, second) = (unit / 2, unit - unit / 2);
        (down + i64::from(up)) as f64 * 2f64.powi(first as i32) * 2f64.powi(second as i32)
    }
}

impl Exact for Dyadic {}

#[cfg(test)]
mod tests {
    use super::*;
    use num_rational::BigRational;
    use proptest::prelude::*;

    fn finite() -> impl Strategy<Value = f64> {
        prop_oneof![
            prop::num::f64::NORMAL | prop::num::f64::SUBNORMAL | prop::num::f64::ZERO,
            -100.0..100.0,
            (-50i32..50).prop_map(f64::from),
        ]
    }

    proptest! {
        /// As the processor rounds sums and products.
        #[test]
        fn rounds_to_the_nearest_double(a in finite(), b in finite()) {
            let exact = |x: f64| Dyadic::from_f64(x);
            prop_assert_eq!((exact(a) + &exact(b)).to_f64(), a + b);
            prop_assert_eq!((exact(a) * &exact(b)).to_f64(), a * b);
            // Near the middle of two doubles.
            let half = exact(a) + &(exact(a * f64::EPSILON / 2.0) * &exact(b.signum()));
            prop_assert_eq!(half.to_f64(), a + a * f64::EPSILON / 2.0 * b.signum());
        }

        /// a·b + c − d in dyadics and in rationals have the same sign and value.
        #[test]
        fn agrees_with_rationals(a in finite(), b in finite(), c in finite(), d in finite()) {
            fn value<N: Number>([a, b, c, d]: [f64; 4]) -> N {
                N::from_f64(a) * &N::from_f64(b) + &N::from_f64(c) - &N::from_f64(d)
            }
            let ours = value::<Dyadic>([a, b, c, d]);
            let theirs = value::<BigRational>([a, b, c, d]);
            prop_assert_eq!(ours.sign(), theirs.sign());
            let (x, y) = (ours.to_f64(), Number::to_f64(&theirs));
            prop_assert!(x == y || (x - y).abs() <= 4.0 * f64::EPSILON * y.abs() + 1e-322 || !y.is_finite(), "{x} {y}");
        }

        /// A double survives the round trip.
        #[test]
        fn holds_every_double(a in finite()) {
            prop_assert_eq!(Dyadic::from_f64(a).to_f64(), a);
        }
    }
}
