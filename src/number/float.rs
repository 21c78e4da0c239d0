//! Plain floats as numbers: naive on purpose. Their signs may lie; nothing but a counted experiment may ask for them.

use super::{Number, Sign};

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
