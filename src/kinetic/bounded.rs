//! A double with a bound of its error, and what it says about a number that lies on a grid.
//!
//! If a number is known to be a multiple of some quantum, and the error of a value that stands for it is less than half
//! of that, then it is the multiple nearest to the value. If also the value is less than 2^52 quanta, that multiple is
//! found in floats: where the quantum is a power of two the division by it is exact (or underflows towards 0, the
//! nearest multiple then), and so is rounding to an integer.

use crate::number::{Approx, Sign};

/// A value and a bound of its error.
#[derive(Clone, Copy, Debug)]
pub struct Bounded {
    /// The value.
    pub value: f64,
    /// At least the distance to the number that it stands for; infinite or NaN where nothing is known.
    pub error: f64,
}

impl From<Approx> for Bounded {
    fn from(x: Approx) -> Bounded {
        Bounded {
            value: x.value(),
            error: x.error(),
        }
    }
}

impl Bounded {
    /// The sign of the number, if it is known to be an integer multiple of `quantum`.
    #[inline(always)]
    pub fn sign_on_grid(&self, quantum: f64) -> Option<Sign> {
        if self.value > self.error {
            Some(Sign::Positive)
        } else if self.value < -self.error {
            Some(Sign::Negative)
        } else if self.value.abs() + self.error < quantum * (1.0 - f64::EPSILON) {
            Some(Sign::Zero)
        } else {
            None
        }
    }

    /// Whether the number is certainly positive.
    #[inline(always)]
    pub fn is_positive(&self) -> bool {
        self.value > self.error
    }

    /// The number as a multiple of `quantum`, which it is known to be, if the bound leaves only one possibility.
    #[inline(always)]
    pub fn in_quanta(&self, quantum: f64) -> Option<i64> {
        // No quantum: 0 < 0 is false, as bounds are positive.
        let certain = self.error < 0.5 * quantum && self.is_small(quantum);
        certain.then(|| (self.value / quantum).round() as i64)
    }

    /// Whether a smaller error might make an integer of it.
    #[inline(always)]
    pub fn is_small(&self, quantum: f64) -> bool {
        self.value.abs() < quantum * 2f64.powi(52)
    }
}
