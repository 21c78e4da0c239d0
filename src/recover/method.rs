//! Which algorithm inserts polygons, and with which numbers.

pub use super::flips::{FlipOrder, NumberType};
use serde::Serialize;

/// The algorithm that inserts a polygon.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Insertion {
    /// Cavity retriangulation (paper §3.1).
    Cavity,
    /// Gift wrapping of the two cavities (Shewchuk 2002; paper §3.1): the baseline, in quadratic time.
    #[serde(rename = "gift-wrap")]
    GiftWrap,
    /// Bistellar flips in order of their times (paper §3.2).
    Flip(FlipOrder),
}
