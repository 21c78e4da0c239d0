//! Rows of tables that are made of groups of columns, which several tables have.

use crate::measure::sample::{median, minimum};
use serde::Serialize;

/// Makes CSV of a row whose fields are groups of columns: all of their columns, in this order. (serde's `flatten` makes
/// maps, of which CSV knows nothing.)
#[macro_export]
macro_rules! row_of_groups {
    ($row:ty: $($group:ident),+) => {
        impl serde::Serialize for $row {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                ($(&self.$group,)+).serialize(serializer)
            }
        }
    };
}

/// The times of some repetitions. The README of the package has the meaning of the columns.
#[allow(missing_docs)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Timed {
    pub repetitions: usize,
    pub median_seconds: Option<f64>,
    pub min_seconds: Option<f64>,
}

impl Timed {
    /// Of these seconds.
    pub fn of(seconds: &[f64]) -> Timed {
        Timed {
            repetitions: seconds.len(),
            median_seconds: median(seconds),
            min_seconds: minimum(seconds),
        }
    }
}
