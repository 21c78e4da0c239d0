//! What counts as flat.

use crate::exchange::Precision;

/// What counts as flat, and what is done with it.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct FlatnessRule {
    /// The precision δ of the input: vertices within δ of a plane, along each axis, are on it.
    pub delta: f64,
    /// Adjacent facets with equal markers that are on one plane in this sense become one polygon.
    pub merge: bool,
    /// So do those that meet at this angle at least, in degrees, and are all within the rest to 180 of one plane.
    pub merge_angle: Option<f64>,
}

impl FlatnessRule {
    /// Flat is what is exactly on one plane, or within 10⁻⁹ of the polygon's size; nothing else is merged.
    pub const EXACT: FlatnessRule = FlatnessRule {
        delta: 0.0,
        merge: false,
        merge_angle: None,
    };

    /// Flat to the precision of the input, and merged, too.
    pub fn of(precision: Precision) -> FlatnessRule {
        FlatnessRule {
            delta: precision.delta,
            merge: precision.delta > 0.0,
            merge_angle: None,
        }
    }

    /// The same without any merging.
    #[must_use]
    pub fn apart(self) -> FlatnessRule {
        FlatnessRule {
            merge: false,
            merge_angle: None,
            ..self
        }
    }

    /// Whether facets may be merged.
    pub(crate) fn merges(&self) -> bool {
        self.merge || self.merge_angle.is_some()
    }
}
