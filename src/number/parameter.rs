//! Where a point is on a segment.

use super::{Dyadic, Number};
use std::cmp::Ordering;

/// The parameter t of a point p + t(q−p), as a sum of two doubles. The second one is nearly always zero: it is needed
/// only where vertices come closer to a segment than 2⁻⁵³ of its length.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct Parameter {
    /// t rounded.
    pub value: f64,
    /// What is missing from t.
    pub rest: f64,
}

impl From<f64> for Parameter {
    fn from(value: f64) -> Parameter {
        Parameter { value, rest: 0.0 }
    }
}

impl Parameter {
    /// t in a number type.
    pub fn number<N: Number>(self) -> N {
        match self.rest == 0.0 {
            true => N::from_f64(self.value),
            false => N::from_f64(self.value) + &N::from_f64(self.rest),
        }
    }

    /// The middle between two parameters, rounded; `None` if there is none between them.
    pub fn middle(a: Parameter, b: Parameter) -> Option<Parameter> {
        let sum: Dyadic = a.number::<Dyadic>() + &b.number();
        let exact = sum.shifted(-1);
        let value = exact.to_f64();
        let rest = (exact - &Dyadic::from_f64(value)).to_f64();
        let middle = Parameter { value, rest };
        // Rounding to `value` is monotone, so that the order of the pairs is that of the sums.
        (a < middle && middle < b).then_some(middle)
    }

    /// The order of two finite parameters.
    pub fn order(a: &Parameter, b: &Parameter) -> Ordering {
        a.value.total_cmp(&b.value).then(a.rest.total_cmp(&b.rest))
    }
}
