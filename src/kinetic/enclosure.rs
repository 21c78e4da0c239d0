//! Float enclosures of times: the keys of the filtered order.
//!
//! # The enclosure
//! N and D come in floats as n, d and bounds e ≥ |N − n|, g ≥ |D − d|. Let d > g, so that D > 0 is certain, and let
//! q = −n/d exactly. With τ = −N/D,
//!
//! > |τ − q| = |N/D − n/d| = |(N − n) + n/d·(d − D)| / D ≤ (e + |q|·g)/(d − g).
//!
//! In floats, with u = 2⁻⁵³, η = 2⁻¹⁰⁷⁴, T = 2⁻¹⁰²²: q̂ = fl(−n/d) has |q̂ − q| ≤ u|q̂| + η/2, so that
//! |q| ≤ (|q̂| + T)(1 + 2u). We take
//!
//! > w = (e + (|q̂| + T)·g)/(d − g)·(1 + 2⁻⁴⁸) + |q̂|·2⁻⁵² + T.
//!
//! The fraction has five roundings, the sums after it three, and the factor 1 + 2u is to be made up for; 1 + 2⁻⁴⁸ = 1 +
//! 32u does all that (`paper/theory.tex` has it in detail). The product may underflow and lose η/2 ≤ u·e, because e ≥
//! T; d − g is a difference of doubles and does not underflow; the quotient may, and loses η/2, which the last T covers
//! together with that of q̂. Overflow makes w infinite or NaN, and then no comparison is decided by it.
//!
//! # The comparison
//! Both numbers are multiplied by a power of two that brings the first time of a region near 1, and w is then rounded
//! to single precision and from there to the next number above, so that the queue has less to move. A product that
//! underflows errs by at most η/2, twice that is less than the 2⁻¹⁵⁰ by which w has grown at least; an overflow gives
//! an infinite or NaN enclosure.
//!
//! q̂_B − q̂_A > (w_A + w_B)(1 + 2⁻⁵⁰) in floats implies τ_A < τ_B: the left side is at most (1 + u) times its exact
//! value, the right side at least (1 + 2⁻⁵⁰)(1 − 2u) > 1 + u times w_A + w_B. NaN and infinity make it false.

use super::bounded::Bounded;
use std::cmp::Ordering;

/// A float enclosure of a time, multiplied by some power of two: the time is within `width` of `middle`.
#[derive(Clone, Copy, Debug)]
pub struct Enclosure {
    /// The bits of a double: twelve bytes with the width, not sixteen.
    middle: [u32; 2],
    width: f32,
}

impl Enclosure {
    /// Of a time of which nothing is known.
    pub(super) const UNKNOWN: Enclosure = Enclosure {
        middle: [0; 2],
        width: f32::INFINITY,
    };

    #[inline(always)]
    pub(super) fn new(middle: f64, width: f32) -> Enclosure {
        let bits = middle.to_bits();
        Enclosure {
            middle: [bits as u32, (bits >> 32) as u32],
            width,
        }
    }

    #[inline(always)]
    pub(super) fn middle(self) -> f64 {
        let [low, high] = self.middle;
        f64::from_bits(u64::from(high) << 32 | u64::from(low))
    }

    /// What the time lies within.
    #[cfg(test)]
    pub(crate) fn middle_and_width(self) -> (f64, f32) {
        (self.middle(), self.width)
    }

    /// Which of two times comes first, if that is certain.
    #[inline]
    pub(super) fn compare(self, other: Enclosure) -> Option<Ordering> {
        let gap = other.middle() - self.middle();
        let widths = (f64::from(self.width) + f64::from(other.width)) * (1.0 + 4.0 * f64::EPSILON);
        if gap > widths {
            Some(Ordering::Less)
        } else if -gap > widths {
            Some(Ordering::Greater)
        } else {
            None
        }
    }
}

/// The middle and the half width of an interval that contains −N/D, for D certainly positive.
#[inline]
pub(super) fn enclosure(n: &Bounded, d: &Bounded) -> (f64, f64) {
    // e is at least T, since the product below may underflow; and infinite where the bound overflowed to NaN, which the
    // larger of the two would forget.
    let e = match n.error {
        e if e.is_nan() => f64::INFINITY,
        e => e.max(f64::MIN_POSITIVE),
    };
    let g = d.error;
    let middle = -n.value / d.value;
    let slope = (e + (middle.abs() + f64::MIN_POSITIVE) * g) / (d.value - g);
    let width =
        slope * (1.0 + 16.0 * f64::EPSILON) + middle.abs() * f64::EPSILON + f64::MIN_POSITIVE;
    (middle, width)
}
