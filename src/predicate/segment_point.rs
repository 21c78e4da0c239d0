//! Points on segments with exact coordinates p + t(q−p), where p, q and t are doubles: dyadic numbers, hence exactly on the
//! segment, and on every plane that holds it.

use crate::number::{Approx, Dyadic, Number, Vec3};

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

/// p + t(q−p) in a number type; exact if the type is.
pub(super) fn between<N: Number>([p, q]: [[f64; 3]; 2], t: f64) -> Vec3<N> {
    let t = N::from_f64(t);
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
    pub t: f64,
    /// The coordinates.
    pub exact: Vec3<Dyadic>,
    /// The doubles nearest to them.
    pub rounded: [f64; 3],
    /// The same with the bound of that rounding.
    pub approx: Vec3<Approx>,
}

impl SegmentPoint {
    /// p + t(q−p); if its coordinates are doubles after all, those.
    pub fn new(ends: [[f64; 3]; 2], t: f64) -> Result<SegmentPoint, [f64; 3]> {
        let exact = between::<Dyadic>(ends, t);
        let rounded = exact.0.each_ref().map(Number::to_f64);
        let is_double =
            |i: usize| rounded[i].is_finite() && Dyadic::from_f64(rounded[i]) == exact.0[i];
        if (0..3).all(is_double) {
            return Err(rounded);
        }
        let approx = [0, 1, 2].map(|i| match is_double(i) {
            true => Approx::from_f64(rounded[i]),
            false => near(rounded[i]),
        });
        Ok(SegmentPoint {
            ends,
            t,
            exact,
            rounded,
            approx: Vec3(approx),
        })
    }
}

/// A number that was rounded to x. [`Dyadic::to_f64`] rounds the leading 64 bits to nearest, and so errs by at most
/// (2⁻⁵³ + 2⁻⁶³)(1 + 2⁻⁵²)|x| < 2⁻⁵²|x| unless the result is subnormal (or overflows): index 1 with the magnitude |x|, where
/// this is far from that.
fn near(x: f64) -> Approx {
    let magnitude = if x.abs() > 2f64.powi(-1000) {
        x.abs()
    } else {
        f64::INFINITY
    };
    Approx::with_bound(x, magnitude, 1)
}
