//! Points on segments with exact coordinates p + t(q−p), where p, q and t are doubles: dyadic numbers, hence exactly on the
//! segment, and on every plane that holds it.

use crate::number::{Approx, Dyadic, Number, Vec3};
use std::cmp::Ordering;

/// How the coordinates of Steiner points on segments are represented.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Steiner {
    /// Rounded to doubles, as in the paper: segments are not quite straight and polygons not quite flat any more.
    #[default]
    Rounded,
    /// Exactly: everything stays straight and flat. Rounded only on output.
    Exact,
}

impl Steiner {
    /// The name in options and reports.
    pub fn name(self) -> &'static str {
        match self {
            Steiner::Rounded => "rounded",
            Steiner::Exact => "exact",
        }
    }
}

impl std::fmt::Display for Steiner {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

/// The parameter t of a point p + t(q−p), as a sum of two doubles: nearly always of one, which is enough unless vertices come
/// closer to a segment than 2⁻⁵³ of its length.
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

/// p + t(q−p) in a number type; exact if the type is.
pub(super) fn between<N: Number>([p, q]: [[f64; 3]; 2], t: Parameter) -> Vec3<N> {
    let t = t.number::<N>();
    Vec3([0, 1, 2].map(|i| {
        let (a, b) = (N::from_f64(p[i]), N::from_f64(q[i]));
        (b - &a) * &t + &a
    }))
}

/// A point whose coordinates are no doubles.
#[derive(Clone, Debug)]
pub(super) struct SegmentPoint {
    /// p and q.
    pub ends: [[f64; 3]; 2],
    /// t.
    pub t: Parameter,
    /// The coordinates.
    pub exact: Vec3<Dyadic>,
    /// The doubles nearest to them.
    pub rounded: [f64; 3],
    /// What is missing from them, up to its own rounding.
    pub rest: Vec3<Approx>,
}

impl SegmentPoint {
    /// p + t(q−p); if its coordinates are doubles after all, those.
    pub fn new(ends: [[f64; 3]; 2], t: Parameter) -> Result<SegmentPoint, [f64; 3]> {
        let exact = between::<Dyadic>(ends, t);
        let rounded = exact.0.each_ref().map(Number::to_f64);
        let is_double =
            |i: usize| rounded[i].is_finite() && Dyadic::from_f64(rounded[i]) == exact.0[i];
        if (0..3).all(is_double) {
            return Err(rounded);
        }
        let rest = exact.sub(&Vec3::from_f64(rounded)).0;
        Ok(SegmentPoint {
            ends,
            t,
            exact,
            rounded,
            rest: Vec3(rest.each_ref().map(Approx::rounded)),
        })
    }
}
