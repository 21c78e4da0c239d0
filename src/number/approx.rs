//! `f64` with a running error bound: the filter that knows when it does not know.
//!
//! # The bound
//! An [`Approx`] (v, m, k) stands for an unknown real x with
//!
//! > (I1) |v| ≤ m  and  (I2) |v − x| ≤ k·u′·m,  where u = 2⁻⁵³ and u′ = 2u = 2⁻⁵².
//!
//! (The scheme is Burnikel, Funke & Seel 2001, with u′ a factor 2 above theirs; that factor pays for the rounding of m
//! itself.) k is a small integer that depends on the formula alone, so that after inlining, which we insist on, only v
//! and m remain.
//! Rounding is to nearest: fl(s) = s(1+δ), |δ| ≤ u, and s/(1+u) ≤ fl(s), for sums always and for products that do not
//! underflow; a product that underflows errs by at most η/2 = 2⁻¹⁰⁷⁵ = u·T with T = 2⁻¹⁰²².
//!
//! **Difference of two given doubles** (k = 0 on both sides, so v = x): v = fl(a−b) errs by at most u|v|
//! (nearest rounding errs by at most half an ulp *of the result*), so m = |v|, k = 1 holds.
//!
//! **Sum or difference.** v = fl(va ± vb), m = fl(ma + mb), K = max(ka, kb), result k = K + 1.
//! (I1) |va ± vb| ≤ ma + mb and rounding is monotone. (I2) |v − x| ≤ u(ma+mb) + K·u′(ma+mb) = (K + ½)u′(ma+mb)
//! ≤ (K + ½)(1+u)·u′·m ≤ (K+1)·u′·m as long as (K + ½)u ≤ ½, that is K < 2⁵¹.
//!
//! **Product.** v = fl(va·vb), m = fl(fl(ma·mb) + T), k = ka + kb + 1. Let P = ma·mb.
//! |va·vb − xa·xb| ≤ |va − xa||vb| + |xa||vb − xb| ≤ ka·u′·P + (1 + ka·u′)·kb·u′·P, and rounding adds at most uP + uT,
//! so |v − x| ≤ u′[(ka + kb + ka·kb·u′ + ½)P + ½T]. On the other side m ≥ ((1−u)P − uT + T)(1−u) ≥ (1−2u)P + (1−2u)T,
//! and (k)(1−2u) ≥ ka + kb + ka·kb·u′ + ½ for ka, kb ≤ 2²⁰. (I1) by monotone rounding; T only adds.
//!
//! **Overflow.** If any v overflows then so does its m by (I1), and an infinite or NaN m propagates to the end,
//! where the comparison |v| > bound is false. So the answer is "unknown", never wrong.
//!
//! **Sign.** The bound is computed as fl(fl(k·u′·m)(1 + 2⁻⁴⁹)) + T: where k·u′·m ≤ T the last term is enough, and where
//! it is larger nothing underflows and the factor pays for the roundings. |v| above it implies that x has the sign of
//! v.
//!
//! **Zero.** [`Approx::sign`] never certifies zero. If x is known to be an integer multiple of some quantum q (all
//! coordinates on a grid), |v| + bound < q does: [`Approx::sign_on_grid`].

use super::{Dyadic, Exact, Number, Sign};
use std::ops::{Add, Mul, Sub};

/// The smallest normal double, T in the proof.
const TINY: f64 = f64::MIN_POSITIVE;
/// u′ in the proof: 2⁻⁵².
const ROUNDING: f64 = f64::EPSILON;

/// A double with a bound on its error; see the module's proof.
#[derive(Clone, Copy, Debug)]
pub struct Approx {
    value: f64,
    magnitude: f64,
    index: u32,
}

impl Approx {
    /// An upper bound of |value − x|.
    #[inline(always)]
    pub fn error(&self) -> f64 {
        f64::from(self.index) * ROUNDING * self.magnitude * (1.0 + 8.0 * ROUNDING) + TINY
    }

    /// x rounded to a double. [`Dyadic::to_f64`] rounds the leading 64 bits to nearest, and so errs by at most (2⁻⁵³ +
    /// 2⁻⁶³)(1 + 2⁻⁵²)|x| < u′|v| unless the result is subnormal (or overflows): index 1 with the magnitude |v| where
    /// this is far from that, and a magnitude that says nothing elsewhere.
    pub(crate) fn rounded(x: &Dyadic) -> Approx {
        let value = x.to_f64();
        if x.exact_sign().is_zero() {
            return Approx::from_f64(0.0);
        }
        let normal = value.abs() > 2f64.powi(-1000);
        let magnitude = if normal { value.abs() } else { f64::INFINITY };
        Approx::with_bound(value, magnitude, 1)
    }

    /// A value with the magnitude and the index of an earlier computation.
    #[inline]
    pub(crate) fn with_bound(value: f64, magnitude: f64, index: u32) -> Approx {
        Approx {
            value,
            magnitude,
            index,
        }
    }

    /// k of the proof; 0 for a given double.
    #[inline]
    pub(crate) fn index(&self) -> u32 {
        self.index
    }

    /// m of the proof.
    #[inline]
    pub(crate) fn magnitude(&self) -> f64 {
        self.magnitude
    }

    /// The computed value.
    #[inline]
    pub fn value(&self) -> f64 {
        self.value
    }

    /// The sign, where x is known to be an integer multiple of `quantum`, so that a small enough x is zero.
    #[inline(always)]
    pub fn sign_on_grid(&self, quantum: f64) -> Option<Sign> {
        let error = self.error();
        if self.value > error {
            Some(Sign::Positive)
        } else if self.value < -error {
            Some(Sign::Negative)
        } else if self.value.abs() + error < quantum * (1.0 - ROUNDING) {
            Some(Sign::Zero)
        } else {
            None
        }
    }

    #[inline(always)]
    fn sum(self, other: &Approx, value: f64) -> Approx {
        if self.index == 0 && other.index == 0 {
            return Approx {
                value,
                magnitude: value.abs(),
                index: 1,
            };
        }
        Approx {
            value,
            magnitude: self.magnitude + other.magnitude,
            index: self.index.max(other.index) + 1,
        }
    }
}

impl Add<&Approx> for Approx {
    type Output = Approx;
    #[inline(always)]
    fn add(self, other: &Approx) -> Approx {
        self.sum(other, self.value + other.value)
    }
}

impl Sub<&Approx> for Approx {
    type Output = Approx;
    #[inline(always)]
    fn sub(self, other: &Approx) -> Approx {
        self.sum(other, self.value - other.value)
    }
}

impl Mul<&Approx> for Approx {
    type Output = Approx;
    #[inline(always)]
    fn mul(self, other: &Approx) -> Approx {
        Approx {
            value: self.value * other.value,
            magnitude: self.magnitude * other.magnitude + TINY,
            index: self.index + other.index + 1,
        }
    }
}

impl Number for Approx {
    #[inline(always)]
    fn from_f64(x: f64) -> Approx {
        Approx {
            value: x,
            magnitude: x.abs(),
            index: 0,
        }
    }

    #[inline]
    fn sign(&self) -> Option<Sign> {
        self.sign_on_grid(0.0)
    }

    fn to_f64(&self) -> f64 {
        self.value
    }
}
