//! Rationals: `num_rational::BigRational`, and `rug::Rational` (GMP) behind the feature `rug`.
//!
//! A determinant needs no division, and pays for the gcds of a rational without need: [`super::Dyadic`] is several
//! times faster. Rationals are here as independent witnesses.

use super::{Exact, Number, Sign};
use num_rational::BigRational;
use num_traits::{FromPrimitive, Signed, ToPrimitive, Zero};

impl Number for BigRational {
    fn from_f64(x: f64) -> Self {
        <BigRational as FromPrimitive>::from_f64(x).expect("coordinates are finite")
    }
    fn sign(&self) -> Option<Sign> {
        Some(if self.is_zero() {
            Sign::Zero
        } else if self.is_negative() {
            Sign::Negative
        } else {
            Sign::Positive
        })
    }
    fn to_f64(&self) -> f64 {
        ToPrimitive::to_f64(self).unwrap_or(f64::NAN)
    }
}

impl Exact for BigRational {}

#[cfg(feature = "rug")]
impl Number for rug::Rational {
    fn from_f64(x: f64) -> Self {
        rug::Rational::from_f64(x).expect("coordinates are finite")
    }
    fn sign(&self) -> Option<Sign> {
        Some(Sign::from(self.cmp0()))
    }
    fn to_f64(&self) -> f64 {
        rug::Rational::to_f64(self)
    }
}

#[cfg(feature = "rug")]
impl Exact for rug::Rational {}
