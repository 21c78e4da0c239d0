//! The parts of a double, for all that look inside one.

/// The integer m and the exponent e with |x| = m·2^e, for a finite double: m has 53 bits, fewer if x is subnormal, and
/// is 0 for zero.
#[inline(always)]
pub(crate) fn parts(x: f64) -> (u64, i32) {
    let bits = x.to_bits();
    let fraction = bits & ((1 << 52) - 1);
    // A subnormal (biased exponent 0) has no hidden bit and the exponent of the smallest normal double.
    match biased_exponent(x) {
        0 => (fraction, -1074),
        biased => (fraction | 1 << 52, biased - 1075),
    }
}

/// The e with 2^e ≤ |x| < 2^(e+1), for a normal double; −1022 for zero and where x is subnormal.
#[inline(always)]
pub(crate) fn exponent(x: f64) -> i32 {
    biased_exponent(x).max(1) - 1023
}

/// The greatest k such that a finite double is a multiple of 2^k; `None` for zero, which is one of all.
#[inline(always)]
pub(crate) fn lowest_bit(x: f64) -> Option<i32> {
    let (mantissa, exponent) = parts(x);
    (mantissa != 0).then(|| exponent + mantissa.trailing_zeros() as i32)
}

/// 2^k if that is a normal double, else 0.
#[inline]
pub(crate) fn power_of_two(k: i32) -> f64 {
    if (-1022..=1023).contains(&k) {
        f64::from_bits(((k + 1023) as u64) << 52)
    } else {
        0.0
    }
}

#[inline(always)]
fn biased_exponent(x: f64) -> i32 {
    ((x.to_bits() >> 52) & 0x7ff) as i32
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn parts_make_the_whole(x in prop::num::f64::NORMAL | prop::num::f64::SUBNORMAL) {
            let (mantissa, e) = parts(x);
            let half = 2f64.powi(e / 2);
            // In two steps, neither of which rounds.
            prop_assert_eq!(mantissa as f64 * half * 2f64.powi(e - e / 2), x.abs());
            let low = lowest_bit(x).expect("x is not zero");
            prop_assert_eq!(low, e + mantissa.trailing_zeros() as i32);
            let top = exponent(x);
            prop_assert!(x.abs() < 2f64.powi(top) * 2.0 || top == 1023);
            prop_assert!(!x.is_normal() || power_of_two(top) <= x.abs());
        }
    }

    #[test]
    fn zeros_and_ends_of_the_range() {
        assert_eq!((parts(0.0), lowest_bit(-0.0)), ((0, -1074), None));
        assert_eq!((exponent(0.0), exponent(1.5)), (-1022, 0));
        assert_eq!(lowest_bit(f64::from_bits(1)), Some(-1074));
        assert_eq!((power_of_two(-1023), power_of_two(1024)), (0.0, 0.0));
        assert_eq!(
            (power_of_two(-1022), power_of_two(3)),
            (f64::MIN_POSITIVE, 8.0)
        );
    }
}
