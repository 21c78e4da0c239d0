//! Plain floats as numbers: naive on purpose. Their signs may lie; nothing but a counted experiment may ask for them.

use super::{Dyadic, Number, Sign, Wide};
use std::cmp::Ordering;

/// A rounded number type with a quotient, in which flip times can be computed as the paper does.
pub trait Float: Number {
    /// −n/d, rounded in this type; `None` if that is no finite number.
    fn negated_quotient(n: &Self, d: &Self) -> Option<Self>;

    /// The order of two finite numbers. (0 and −0 are equal.)
    fn compare(a: &Self, b: &Self) -> Ordering;

    /// The number of this type nearest to x, infinite where x is beyond the largest.
    fn nearest(x: &Dyadic) -> Self {
        Self::from_f64(x.to_f64())
    }

    /// This number from a double that was computed as this type would have, if this type is the double.
    fn computed(double: f64) -> Option<Self> {
        let _ = double;
        None
    }
}

impl Number for f64 {
    #[inline]
    fn from_f64(x: f64) -> f64 {
        x
    }
    #[inline]
    fn sign(&self) -> Option<Sign> {
        Sign::of_f64(*self)
    }
    #[inline]
    fn to_f64(&self) -> f64 {
        *self
    }
}

impl Float for f64 {
    #[inline]
    fn negated_quotient(n: &f64, d: &f64) -> Option<f64> {
        Some(-n / d).filter(|q| q.is_finite())
    }
    #[inline]
    fn compare(a: &f64, b: &f64) -> Ordering {
        a.partial_cmp(b).expect("finite numbers are ordered")
    }
    #[inline]
    fn computed(double: f64) -> Option<f64> {
        Some(double)
    }
}

impl Number for f32 {
    #[inline]
    fn from_f64(x: f64) -> f32 {
        x as f32
    }
    #[inline]
    fn sign(&self) -> Option<Sign> {
        Sign::of_f64(f64::from(*self))
    }
    #[inline]
    fn to_f64(&self) -> f64 {
        f64::from(*self)
    }
}

impl Float for f32 {
    #[inline]
    fn negated_quotient(n: &f32, d: &f32) -> Option<f32> {
        Some(-n / d).filter(|q| q.is_finite())
    }
    #[inline]
    fn compare(a: &f32, b: &f32) -> Ordering {
        a.partial_cmp(b).expect("finite numbers are ordered")
    }
    /// Rounded to 24 bits first, so that the double is exact: two roundings to nearest may differ from one. (But for
    /// subnormal numbers, which have fewer bits.)
    fn nearest(x: &Dyadic) -> f32 {
        Wide::<24>::nearest(x.clone()).to_f64() as f32
    }
}
