//! Integers of a fixed number of 64-bit words: exact determinants of coordinates that lie on a common grid, without
//! allocation and without branches.

use super::Sign;
use super::bits::parts;

/// An integer of `N` words in two's complement, the lowest first. Sums and differences wrap: it is for the caller to
/// know that they fit.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Integer<const N: usize>([u64; N]);

impl<const N: usize> Integer<N> {
    /// Zero.
    pub const ZERO: Integer<N> = Integer([0; N]);

    /// x·2^−grid for a finite double x that is a multiple of 2^grid and less than 2^(64N − 1 + grid) in magnitude.
    #[inline]
    pub fn on_grid(x: f64, grid: i32) -> Self {
        if x == 0.0 {
            return Self::ZERO;
        }
        let (magnitude, exponent) = parts(x);
        let mut words = [0; N];
        if exponent < grid {
            // The bits below the grid are zeros.
            words[0] = magnitude >> (grid - exponent);
        } else {
            let shift = (exponent - grid) as usize;
            let (word, bit) = (shift / 64, shift % 64);
            let wide = u128::from(magnitude) << bit;
            words[word] = wide as u64;
            if let Some(next) = words.get_mut(word + 1) {
                *next = (wide >> 64) as u64;
            }
        }
        match x < 0.0 {
            true => Self::ZERO.minus(&Integer(words)),
            false => Integer(words),
        }
    }

    /// self + other.
    #[inline(always)]
    #[must_use]
    // Loops written out, here and below: neither `from_fn` nor `zip` is always inlined.
    #[allow(clippy::needless_range_loop)]
    pub fn plus(&self, other: &Self) -> Self {
        let mut words = [0; N];
        let mut carry = false;
        for i in 0..N {
            let (sum, first) = self.0[i].overflowing_add(other.0[i]);
            let (sum, second) = sum.overflowing_add(u64::from(carry));
            carry = first | second;
            words[i] = sum;
        }
        Integer(words)
    }

    /// self − other.
    #[inline(always)]
    #[must_use]
    #[allow(clippy::needless_range_loop)]
    pub fn minus(&self, other: &Self) -> Self {
        let mut words = [0; N];
        let mut borrow = false;
        for i in 0..N {
            let (difference, first) = self.0[i].overflowing_sub(other.0[i]);
            let (difference, second) = difference.overflowing_sub(u64::from(borrow));
            borrow = first | second;
            words[i] = difference;
        }
        Integer(words)
    }

    /// self·other, which always fits `P` = `N` + `M` words.
    #[inline(always)]
    pub fn times<const M: usize, const P: usize>(&self, other: &Integer<M>) -> Integer<P> {
        const { assert!(P == N + M) };
        let mut product = [0u64; P];
        for i in 0..N {
            let mut carry = 0;
            for j in 0..M {
                let sum = u128::from(self.0[i]) * u128::from(other.0[j])
                    + u128::from(product[i + j])
                    + u128::from(carry);
                product[i + j] = sum as u64;
                carry = (sum >> 64) as u64;
            }
            product[i + M] = carry;
        }
        // So far the words were taken without sign; a negative factor was 2^(64N) or 2^(64M) too large.
        subtract_if::<M, P>(self.is_negative(), &mut product, N, &other.0);
        subtract_if::<N, P>(other.is_negative(), &mut product, M, &self.0);
        Integer(product)
    }

    #[inline(always)]
    fn is_negative(&self) -> bool {
        (self.0[N - 1] as i64) < 0
    }

    /// The sign.
    #[inline]
    pub fn sign(&self) -> Sign {
        if self.is_negative() {
            Sign::Negative
        } else if self.0.iter().fold(0, |all, word| all | word) == 0 {
            Sign::Zero
        } else {
            Sign::Positive
        }
    }
}

impl From<i64> for Integer<1> {
    fn from(x: i64) -> Integer<1> {
        Integer([x as u64])
    }
}

/// from −= what·2^(64·place), if so wished, without a branch.
#[inline(always)]
fn subtract_if<const N: usize, const P: usize>(
    condition: bool,
    from: &mut [u64; P],
    place: usize,
    what: &[u64; N],
) {
    let mask = u64::from(condition).wrapping_neg();
    let mut borrow = false;
    for i in 0..N {
        let (difference, first) = from[place + i].overflowing_sub(what[i] & mask);
        let (difference, second) = difference.overflowing_sub(u64::from(borrow));
        borrow = first | second;
        from[place + i] = difference;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::{Dyadic, Exact, Number};
    use proptest::prelude::*;

    /// Doubles that are multiples of 2^−60 below 2^60.
    fn number() -> impl Strategy<Value = f64> {
        prop_oneof![
            Just(0.0),
            (-3i32..4).prop_map(f64::from),
            (any::<i64>(), -60i32..-3).prop_map(|(m, e)| (m >> 11) as f64 * 2f64.powi(e)),
            (any::<bool>(), -60i32..60).prop_map(|(s, e)| if s {
                2f64.powi(e)
            } else {
                -2f64.powi(e)
            }),
        ]
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        /// a·b + c·d − b·c has the sign that it has in dyadics.
        #[test]
        fn agrees_with_dyadics([a, b, c, d] in [number(), number(), number(), number()]) {
            let [ea, eb, ec, ed] = [a, b, c, d].map(Dyadic::from_f64);
            let exact = ea * &eb + &(ec.clone() * &ed) - &(eb * &ec);
            let [a, b, c, d] = [a, b, c, d].map(|x| Integer::<2>::on_grid(x, -60));
            let (ab, cd, bc): (Integer<4>, Integer<4>, Integer<4>) = (a.times(&b), c.times(&d), b.times(&c));
            prop_assert_eq!(ab.plus(&cd).minus(&bc).sign(), exact.exact_sign());
            prop_assert_eq!(bc.minus(&cd).minus(&ab).sign(), -exact.exact_sign());
        }

        /// (a·b)·c = a·(b·c), for factors of different lengths.
        #[test]
        fn products_associate([a, b, c] in [number(), number(), number()]) {
            let a = Integer::<2>::on_grid(a, -60);
            let [b, c] = [b, c].map(|x| Integer::<3>::on_grid(x, -60));
            let (ab, bc): (Integer<5>, Integer<6>) = (a.times(&b), b.times(&c));
            let (left, right): (Integer<8>, Integer<8>) = (ab.times(&c), a.times(&bc));
            prop_assert_eq!(left, right);
        }
    }

    /// A grid finer than the last bit of a number, and a number with zeros below the grid.
    #[test]
    fn shifts_both_ways() {
        assert_eq!(Integer::<1>::on_grid(6.0, 1).0, [3]);
        assert_eq!(Integer::<2>::on_grid(-1.0, -64).0, [0, u64::MAX]);
        assert_eq!(Integer::<1>::on_grid(5e-324, -1074).0, [1]);
    }
}
