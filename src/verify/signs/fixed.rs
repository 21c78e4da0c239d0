//! Integers of a fixed number of words, for exact signs without allocation.
//!
//! Arithmetic is that of the integers modulo 2^(64·W), a ring, so that whatever overflows on the way, a result whose
//! absolute value is below 2^(64·W − 1) is right. [`Formula`]s know how large theirs can get.

use crate::mesh::VertexId;
use crate::number::bits::parts;
use crate::number::{Dyadic, Exact, Number, Sign, Vec3};
use crate::verify::signs::points::Points;
use arrayvec::ArrayVec;
use std::ops::{Add, Mul, Sub};

/// The most points that a [`Formula`] is about.
pub(crate) const MOST_POINTS: usize = 8;

/// A polynomial with integer coefficients in the coordinates of points, all of whose terms have the same degree.
pub(crate) trait Formula {
    /// The degree.
    const DEGREE: u32;
    /// If all coordinates are below 2^b, the value is below 2^(DEGREE·b + GROWTH).
    const GROWTH: u32;
    /// The value.
    fn value<N: Number>(&self, points: &[Vec3<N>]) -> N;
}

/// A coordinate ±words·2^exponent, the least significant word first; odd or zero.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scaled {
    pub(crate) negative: bool,
    pub(crate) words: [u64; Scaled::WORDS],
    pub(crate) exponent: i64,
}

impl Scaled {
    const WORDS: usize = 4;

    /// A finite double.
    pub(crate) fn from_f64(x: f64) -> Scaled {
        let (magnitude, exponent) = parts(x);
        let zeros = if magnitude == 0 {
            0
        } else {
            magnitude.trailing_zeros()
        };
        Scaled {
            negative: x < 0.0,
            words: [magnitude >> zeros, 0, 0, 0],
            exponent: i64::from(exponent) + i64::from(zeros),
        }
    }

    /// Any number, unless it has more bits than fit.
    pub(crate) fn from_dyadic(x: &Dyadic) -> Option<Scaled> {
        let (negative, bytes, exponent) = x.parts();
        let mut words = [0; Scaled::WORDS];
        for (i, byte) in bytes.into_iter().enumerate() {
            *words.get_mut(i / 8)? |= u64::from(byte) << (8 * (i % 8));
        }
        Some(Scaled {
            negative,
            words,
            exponent,
        })
    }

    fn is_zero(&self) -> bool {
        self.words == [0; Scaled::WORDS]
    }

    /// The least e with |x| < 2^e.
    fn top(&self) -> i64 {
        let used = (0..Scaled::WORDS).rev().find(|&i| self.words[i] != 0);
        used.map_or(i64::MIN, |i| {
            64 * i as i64 + 64 - i64::from(self.words[i].leading_zeros()) + self.exponent
        })
    }
}

/// The sign of a formula.
pub(crate) fn sign<F: Formula>(points: &Points, ids: &[VertexId], formula: &F) -> Sign {
    scaled(points, ids)
        .and_then(|scaled| in_words(&scaled, formula))
        .unwrap_or_else(|| {
            let p: Vec<Vec3<Dyadic>> = ids.iter().map(|&v| points.exact(v)).collect();
            formula.value(&p).exact_sign()
        })
}

fn scaled(points: &Points, ids: &[VertexId]) -> Option<ArrayVec<[Scaled; 3], MOST_POINTS>> {
    let mut scaled = ArrayVec::new();
    for &v in ids {
        scaled.try_push(points.scaled(v)?).ok()?;
    }
    Some(scaled)
}

fn in_words<F: Formula>(points: &[[Scaled; 3]], formula: &F) -> Option<Sign> {
    let coordinates = || points.iter().flatten().filter(|x| !x.is_zero());
    let unit = coordinates().map(|x| x.exponent).min().unwrap_or(0);
    let top = coordinates().map(Scaled::top).max().unwrap_or(0);
    let bits = i64::from(F::DEGREE) * (top - unit) + i64::from(F::GROWTH) + 1;
    match bits {
        ..=128 => Some(evaluate::<F, 2>(points, unit, formula)),
        129..=192 => Some(evaluate::<F, 3>(points, unit, formula)),
        193..=320 => Some(evaluate::<F, 5>(points, unit, formula)),
        321..=448 => Some(evaluate::<F, 7>(points, unit, formula)),
        449..=640 => Some(evaluate::<F, 10>(points, unit, formula)),
        _ => None,
    }
}

fn evaluate<F: Formula, const W: usize>(points: &[[Scaled; 3]], unit: i64, formula: &F) -> Sign {
    let p: ArrayVec<Vec3<Fixed<W>>, MOST_POINTS> = points
        .iter()
        .map(|p| Vec3([0, 1, 2].map(|i| Fixed::new(&p[i], unit))))
        .collect();
    formula.value(&p).exact_sign()
}

/// An integer modulo 2^(64·W), the least significant word first; the upper half of the residues are the negative
/// numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Fixed<const W: usize>([u64; W]);

impl<const W: usize> Fixed<W> {
    /// x in units of 2^unit, which divides it.
    fn new(x: &Scaled, unit: i64) -> Fixed<W> {
        let mut words = [0; W];
        if x.is_zero() {
            return Fixed(words);
        }
        let shift = (x.exponent - unit) as usize;
        let (skip, bits) = (shift / 64, shift % 64);
        for (i, &word) in x.words.iter().enumerate().filter(|(_, w)| **w != 0) {
            let wide = u128::from(word) << bits;
            for (j, part) in [(i + skip, wide as u64), (i + skip + 1, (wide >> 64) as u64)] {
                if let Some(place) = words.get_mut(j) {
                    *place |= part;
                }
            }
        }
        let magnitude = Fixed(words);
        match x.negative {
            true => Fixed([0; W]) - &magnitude,
            false => magnitude,
        }
    }
}

impl<const W: usize> Add<&Fixed<W>> for Fixed<W> {
    type Output = Fixed<W>;
    #[inline(always)]
    fn add(self, other: &Fixed<W>) -> Fixed<W> {
        let mut words = self.0;
        let mut carry = false;
        for (word, &theirs) in words.iter_mut().zip(&other.0) {
            let (sum, over) = word.overflowing_add(theirs);
            let (sum, more) = sum.overflowing_add(u64::from(carry));
            // Not both.
            carry = over != more;
            *word = sum;
        }
        Fixed(words)
    }
}

impl<const W: usize> Sub<&Fixed<W>> for Fixed<W> {
    type Output = Fixed<W>;
    #[inline(always)]
    fn sub(self, other: &Fixed<W>) -> Fixed<W> {
        let mut words = self.0;
        let mut borrow = false;
        for (word, &theirs) in words.iter_mut().zip(&other.0) {
            let (difference, under) = word.overflowing_sub(theirs);
            let (difference, more) = difference.overflowing_sub(u64::from(borrow));
            // Not both.
            borrow = under != more;
            *word = difference;
        }
        Fixed(words)
    }
}

impl<const W: usize> Mul<&Fixed<W>> for Fixed<W> {
    type Output = Fixed<W>;
    #[inline]
    fn mul(self, other: &Fixed<W>) -> Fixed<W> {
        let mut words = [0; W];
        for i in 0..W {
            let mut carry = 0;
            for j in 0..W - i {
                let product = u128::from(self.0[i]) * u128::from(other.0[j]);
                let sum = product + u128::from(words[i + j]) + u128::from(carry);
                words[i + j] = sum as u64;
                carry = (sum >> 64) as u64;
            }
        }
        Fixed(words)
    }
}

impl<const W: usize> Number for Fixed<W> {
    /// Of integers only.
    fn from_f64(x: f64) -> Fixed<W> {
        Fixed::new(&Scaled::from_f64(x), 0)
    }

    fn sign(&self) -> Option<Sign> {
        Some(if self.0 == [0; W] {
            Sign::Zero
        } else if self.0[W - 1] >> 63 == 1 {
            Sign::Negative
        } else {
            Sign::Positive
        })
    }

    fn to_f64(&self) -> f64 {
        let negative = self.exact_sign().is_negative();
        let magnitude = if negative {
            Fixed([0; W]) - self
        } else {
            *self
        };
        let words = magnitude.0.iter().rev();
        let x = words.fold(0.0, |x, &word| x * 2f64.powi(64) + word as f64);
        if negative { -x } else { x }
    }
}

impl<const W: usize> Exact for Fixed<W> {}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn number() -> impl Strategy<Value = f64> {
        (-1i64 << 53..1 << 53, -30i32..30).prop_map(|(m, e)| m as f64 * 2f64.powi(e))
    }

    proptest! {
        /// a·b·c − d has the sign and the value that it has in dyadics.
        #[test]
        fn agrees_with_dyadics(a in number(), b in number(), c in number(), d in number()) {
            let unit = -100;
            let fixed = |x: f64| Fixed::<10>::new(&Scaled::from_dyadic(&Dyadic::from_f64(x)).expect("small"), unit);
            let ours = fixed(a) * &fixed(b) * &fixed(c) - &(fixed(d) * &fixed(1.0) * &fixed(1.0));
            let dyadic = Dyadic::from_f64;
            let theirs = dyadic(a) * &dyadic(b) * &dyadic(c) - &dyadic(d);
            prop_assert_eq!(ours.exact_sign(), theirs.exact_sign());
            let (x, y) = (ours.to_f64(), theirs.shifted(-3 * unit).to_f64());
            prop_assert!((x - y).abs() <= 1e-14 * y.abs(), "{} {}", x, y);
        }
    }

    #[test]
    fn the_least_number_is_negative() {
        let least = Fixed::<2>([0, 1 << 63]);
        assert_eq!(least.exact_sign(), Sign::Negative);
        assert_eq!((least - &Fixed([1, 0])).exact_sign(), Sign::Positive);
        assert_eq!(Fixed::<2>::from_f64(-5.0).to_f64(), -5.0);
    }
}
