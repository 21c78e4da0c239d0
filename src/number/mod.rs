//! Number types: a ring that knows its sign, or admits that it does not.
//!
//! A polynomial is written once, over any [`Number`] (those of the predicates in [`crate::predicate::formula`]), and
//! evaluated in numbers of increasing cost until one of them is sure of the sign:
//!
//! | type | what it is | its sign |
//! |---|---|---|
//! | `f32`, `f64` | naive rounding, for the experiments | always answers, and may lie |
//! | [`Wide`] | a float of any number of mantissa bits, for the experiments | always answers, and may lie |
//! | [`Approx`] | `f64` with a running error bound, the filter | true or unknown |
//! | [`Dyadic`] | m·2^e, the ring that doubles generate | exact |
//! | `Integer` | integers of fixed size, for coordinates on a grid | exact |
//! | `num_rational::BigRational` | rationals, for comparison and tests | exact |
//! | `rug::Rational` | GMP rationals (feature `rug`) | exact |
//!
//! Source of the design: Shewchuk 1997 (adaptive predicates), Burnikel, Funke & Seel 2001 (running error bounds).

mod approx;
pub(crate) mod bits;
mod decide;
mod dyadic;
mod float;
mod integer;
mod parameter;
mod rational;
mod sign;
pub(crate) mod slab;
pub(crate) mod vector;
mod wide;

pub use approx::Approx;
pub(crate) use decide::{Polynomial, decide};
pub use dyadic::Dyadic;
pub use float::Float;
pub(crate) use integer::Integer;
#[doc(hidden)]
pub use parameter::Parameter;
pub use sign::Sign;
#[doc(hidden)]
pub use vector::Vec3;
#[doc(hidden)]
pub use wide::WidthTask;
pub use wide::{Bits, UnknownBits, Wide};

use std::fmt::Debug;
use std::ops::{Add, Mul, Sub};

/// A number in which a polynomial with integer coefficients can be evaluated.
pub trait Number:
    Clone
    + Debug
    + for<'a> Add<&'a Self, Output = Self>
    + for<'a> Sub<&'a Self, Output = Self>
    + for<'a> Mul<&'a Self, Output = Self>
{
    /// The number nearest to the finite double `x`: `x` itself for every type but `f32` and
    /// [`Wide`].
    fn from_f64(x: f64) -> Self;

    /// The sign, or `None` where rounding has lost it. Never `None` for an [`Exact`] type; the naive floats
    /// answer for everything but NaN, rightly or wrongly.
    fn sign(&self) -> Option<Sign>;

    /// The nearest double or a close one (for reports and pictures; decides nothing).
    fn to_f64(&self) -> f64;
}

/// A number type whose arithmetic on doubles is exact, so that [`Number::sign`] is never `None`.
pub trait Exact: Number {
    /// The sign, always true.
    fn exact_sign(&self) -> Sign {
        self.sign().expect("an exact number knows its sign")
    }
}
