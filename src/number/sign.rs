//! The sign of a number: the only thing that a predicate returns.

use std::ops::{Mul, Neg};

/// Negative, zero or positive.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[repr(i8)]
pub enum Sign {
    /// Less than zero.
    Negative = -1,
    /// Exactly zero.
    Zero = 0,
    /// Greater than zero.
    Positive = 1,
}

impl Sign {
    /// The sign of `x`, or `None` for NaN.
    #[inline]
    pub fn of_f64(x: f64) -> Option<Sign> {
        if x > 0.0 {
            Some(Sign::Positive)
        } else if x < 0.0 {
            Some(Sign::Negative)
        } else if x == 0.0 {
            Some(Sign::Zero)
        } else {
            None
        }
    }

    /// Whether the sign is [`Sign::Positive`].
    #[inline]
    pub fn is_positive(self) -> bool {
        self == Sign::Positive
    }

    /// Whether the sign is [`Sign::Negative`].
    #[inline]
    pub fn is_negative(self) -> bool {
        self == Sign::Negative
    }

    /// Whether the sign is [`Sign::Zero`].
    #[inline]
    pub fn is_zero(self) -> bool {
        self == Sign::Zero
    }
}

impl From<std::cmp::Ordering> for Sign {
    fn from(ordering: std::cmp::Ordering) -> Sign {
        match ordering {
            std::cmp::Ordering::Less => Sign::Negative,
            std::cmp::Ordering::Equal => Sign::Zero,
            std::cmp::Ordering::Greater => Sign::Positive,
        }
    }
}

impl Neg for Sign {
    type Output = Sign;
    #[inline]
    fn neg(self) -> Sign {
        match self {
            Sign::Negative => Sign::Positive,
            Sign::Zero => Sign::Zero,
            Sign::Positive => Sign::Negative,
        }
    }
}

impl Mul for Sign {
    type Output = Sign;
    #[inline]
    fn mul(self, other: Sign) -> Sign {
        match other {
            Sign::Negative => -self,
            Sign::Zero => Sign::Zero,
            Sign::Positive => self,
        }
    }
}
