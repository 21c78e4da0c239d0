//! The sign of a polynomial: by the filter, and exactly where that is not sure.

use super::{Approx, Dyadic, Exact, Number, Sign};

/// A polynomial with the points, or whatever it is of, at which it is to be evaluated.
pub(crate) trait Polynomial {
    /// The value in a number type; exact if the type is.
    fn value<N: Number>(&self) -> N;
}

/// The exact sign.
pub(crate) fn decide(polynomial: &impl Polynomial) -> Sign {
    let filtered = polynomial.value::<Approx>().sign();
    filtered.unwrap_or_else(|| polynomial.value::<Dyadic>().exact_sign())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// x² − y².
    struct Squares(f64, f64);

    impl Polynomial for Squares {
        fn value<N: Number>(&self) -> N {
            let [x, y] = [self.0, self.1].map(N::from_f64);
            x.clone() * &x - &(y.clone() * &y)
        }
    }

    #[test]
    fn what_the_filter_leaves_open_is_decided() {
        let near = Squares(1.0 + f64::EPSILON, 1.0);
        assert_eq!(near.value::<Approx>().sign(), None);
        assert_eq!(decide(&near), Sign::Positive);
        assert_eq!(decide(&Squares(0.1, -0.1)), Sign::Zero);
        assert_eq!(decide(&Squares(1.0, 2.0)), Sign::Negative);
    }
}
