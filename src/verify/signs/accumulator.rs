//! Exact sums of products of three doubles: one long fixed-point number (Kulisch & Miranker 1986, The arithmetic of the
//! digital computer: a new approach).
//!
//! The number has a limb of 32 bits in each 64-bit word, so that 2³⁰ additions need no carry. A product is an integer
//! of at most 159 bits times 2^e with e ≥ 3·(−1074), and below 2^(3·1024).

use crate::number::bits::parts;
use crate::number::{Dyadic, Number, Sign};
use std::ops::Range;

/// The exponent of the lowest bit.
const LOWEST: i64 = -3 * 1074;
/// Up to 2^3072 and 64 bits for carries, from the lowest bit, in limbs of 32 bits, and what the highest product
/// reaches over.
const LIMBS: usize = (3072 + 3222 + 64) / 32 + 6;
/// How many additions the limbs hold for certain.
const ADDITIONS: u32 = 1 << 30;

/// No limbs, such that the least and the greatest of two ranges are those of both.
const NONE: Range<usize> = Range {
    start: LIMBS,
    end: 0,
};

/// A sum.
pub(crate) struct Accumulator {
    limbs: Box<[i64; LIMBS]>,
    /// Limbs outside this range are zero.
    used: Range<usize>,
    additions: u32,
}

impl Accumulator {
    /// Zero.
    pub(crate) fn new() -> Accumulator {
        Accumulator {
            limbs: Box::new([0; LIMBS]),
            used: NONE,
            additions: 0,
        }
    }

    /// Adds xyz.
    pub(crate) fn add(&mut self, [x, y, z]: [f64; 3]) {
        let ((mx, ex), (my, ey), (mz, ez)) = (parts(x), parts(y), parts(z));
        if mx == 0 || my == 0 || mz == 0 {
            return;
        }
        if self.additions == ADDITIONS {
            self.carry();
        }
        self.additions += 1;
        let negative = (x < 0.0) ^ (y < 0.0) ^ (z < 0.0);
        let place = (i64::from(ex + ey + ez) - LOWEST) as usize;
        let (limb, shift) = (place / 32, place % 32);
        // 106 bits times 53 + 31 bits.
        let xy = u128::from(mx) * u128::from(my);
        let z = u128::from(mz) << shift;
        let (xy_low, xy_high) = (xy as u64, (xy >> 64) as u64);
        let (z_low, z_high) = (z as u64, (z >> 64) as u64);
        let wide = |a: u64, b: u64| u128::from(a) * u128::from(b);
        let low = wide(xy_low, z_low);
        let crossed = [wide(xy_high, z_low), wide(xy_low, z_high)];
        let middle = (low >> 64) + u128::from(crossed[0] as u64) + u128::from(crossed[1] as u64);
        let high = (middle >> 64) + (crossed[0] >> 64) + (crossed[1] >> 64) + wide(xy_high, z_high);
        let words = [low as u64, middle as u64, high as u64];
        let limbs = &mut self.limbs[limb..limb + 6];
        for (i, word) in words.into_iter().enumerate() {
            let parts = [word & 0xffff_ffff, word >> 32].map(|p| p as i64);
            for (j, part) in parts.into_iter().enumerate() {
                limbs[2 * i + j] += if negative { -part } else { part };
            }
        }
        self.used = self.used.start.min(limb)..self.used.end.max(limb + 6);
    }

    /// Adds det[a, b, c].
    pub(crate) fn add_determinant(&mut self, [a, b, c]: [[f64; 3]; 3]) {
        for (i, j, k) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
            self.add([a[i], b[j], c[k]]);
            self.add([-a[i], b[k], c[j]]);
        }
    }

    /// Leaves 32 bits in each limb but the highest.
    fn carry(&mut self) {
        let mut carry = 0;
        for i in self.used.start..LIMBS {
            let sum = self.limbs[i] + carry;
            if i + 1 == LIMBS || (i >= self.used.end && carry == 0) {
                self.limbs[i] = sum;
                self.used.end = self.used.end.max(i + 1);
                break;
            }
            (self.limbs[i], carry) = (sum & 0xffff_ffff, sum >> 32);
        }
        self.additions = 0;
    }

    /// The sign of the sum.
    pub(crate) fn sign(&mut self) -> Sign {
        self.carry();
        let limbs = &self.limbs[self.used.start.min(self.used.end)..self.used.end];
        match limbs.iter().rev().find(|limb| **limb != 0) {
            None => Sign::Zero,
            // All limbs but the highest are positive.
            Some(highest) if *highest < 0 => Sign::Negative,
            Some(_) => Sign::Positive,
        }
    }

    /// The sum so far; zero is left.
    pub(crate) fn take(&mut self) -> Dyadic {
        if self.used.is_empty() {
            return Dyadic::ZERO;
        }
        self.carry();
        let limbs = self.used.clone().rev();
        let sum = limbs.fold(Dyadic::ZERO, |sum, i| {
            sum.shifted(32) + &Dyadic::from_f64(self.limbs[i] as f64)
        });
        let unit = LOWEST + 32 * self.used.start as i64;
        self.limbs[self.used.clone()].fill(0);
        self.used = NONE;
        sum.shifted(unit)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Exact;
    use proptest::prelude::*;

    fn finite() -> impl Strategy<Value = f64> {
        prop_oneof![
            prop::num::f64::NORMAL | prop::num::f64::SUBNORMAL | prop::num::f64::ZERO,
            -100.0..100.0,
            (-50i32..50).prop_map(f64::from),
            Just(f64::MAX),
            Just(-f64::MAX),
            Just(f64::from_bits(1)),
        ]
    }

    proptest! {
        /// Sums are what they are in dyadics, with carries in between or not.
        #[test]
        fn sums_are_exact(
            products in prop::collection::vec([finite(), finite(), finite()], 0..12),
            often in any::<bool>(),
        ) {
            let mut ours = Accumulator::new();
            let mut theirs = Dyadic::ZERO;
            for p in &products {
                ours.add(*p);
                if often {
                    ours.carry();
                }
                let [x, y, z] = p.map(Dyadic::from_f64);
                theirs = theirs + &(x * &y * &z);
            }
            prop_assert_eq!(ours.sign(), theirs.exact_sign());
            prop_assert_eq!(ours.take(), theirs);
            prop_assert_eq!(ours.sign(), Sign::Zero);
        }

        #[test]
        fn determinants_are_exact(p in prop::array::uniform9(finite())) {
            let mut sum = Accumulator::new();
            let [a, b, c] = [0, 3, 6].map(|i| [p[i], p[i + 1], p[i + 2]]);
            sum.add_determinant([a, b, c]);
            let [a, b, c] = [a, b, c].map(crate::number::Vec3::<Dyadic>::from_f64);
            prop_assert_eq!(sum.take(), a.dot(&b.cross(&c)));
        }
    }
}
