//! Points on segments with exact coordinates p + t(q−p), where p, q and t are doubles: dyadic numbers, hence exactly on
//! the segment, and on every plane that holds it.

use crate::number::{Approx, Dyadic, Number, Parameter, Vec3};

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
pub(super) fn between<N: Number>([p, q]: [[f64; 3]; 2], t: Parameter) -> Vec3<N> {
    let t = t.number::<N>();
    Vec3([0, 1, 2].map(|i| {
        let (a, b) = (N::from_f64(p[i]), N::from_f64(q[i]));
        (b - &a) * &t + &a
    }))
}

/// p + t(q−p), each coordinate rounded to the nearest double, with doubles alone; `None` where these do not tell.
#[inline]
pub(super) fn rounded_between([p, q]: [[f64; 3]; 2], t: Parameter) -> Option<[f64; 3]> {
    if t.rest != 0.0 {
        return None;
    }
    let coordinate = |i: usize| rounded_coordinate(p[i], q[i], t.value);
    Some([coordinate(0)?, coordinate(1)?, coordinate(2)?])
}

/// One coordinate. Difference, product and sum are taken without error, as sums of two doubles (Dekker 1971), but for
/// terms that are as small as the rounding errors of the others; of these the sum is h + l, up to less than 4u times
/// their sum. Twice that, added to l, outweighs the rounding of this addition; if h stays the same then, whatever the
/// sign of the error, h is the double nearest to the exact value. What is nearly half-way between two doubles is left
/// to [`Dyadic`], which cuts off what is beyond 64 bits before it rounds: hence the last term of the error.
#[inline]
fn rounded_coordinate(p: f64, q: f64, t: f64) -> Option<f64> {
    if p == q {
        // Not −0, as exact numbers know no such thing.
        return Some(p + 0.0);
    }
    let in_range = |x: f64| x == 0.0 || (SMALL..LARGE).contains(&x.abs());
    let (d, d_rest) = sum(q, -p);
    if !(in_range(p) && in_range(q) && in_range(d) && in_range(t)) {
        return None;
    }
    let (product, product_rest) = product(t, d);
    let (s, e) = sum(p, product);
    let small = t * d_rest;
    let (h, l) = sum(s, e + (product_rest + small));
    let cut = h.abs() * (1.0 / (1u64 << 62) as f64);
    let error = 4.0 * f64::EPSILON * (e.abs() + product_rest.abs() + small.abs()) + cut;
    (h + (l + error) == h && h + (l - error) == h).then_some(h)
}

/// Between these nothing over- or underflows in [`rounded_coordinate`].
const LARGE: f64 = (1u128 << 100) as f64 * (1u128 << 100) as f64;
const SMALL: f64 = 1.0 / LARGE;

/// x + y and what is missing from it (Knuth).
#[inline]
fn sum(x: f64, y: f64) -> (f64, f64) {
    let sum = x + y;
    let of_y = sum - x;
    (sum, (x - (sum - of_y)) + (y - of_y))
}

/// x·y and what is missing from it (Dekker).
#[inline]
fn product(x: f64, y: f64) -> (f64, f64) {
    let halves = |x: f64| {
        let scaled = ((1u32 << 27) + 1) as f64 * x;
        let high = scaled - (scaled - x);
        (high, x - high)
    };
    let product = x * y;
    let ((a, b), (c, d)) = (halves(x), halves(y));
    (product, b * d - (((product - a * c) - b * c) - a * d))
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

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Ordinary coordinates, short ones, whose results are doubles or half-way between two, and some of very
    /// different sizes.
    fn coordinate() -> impl Strategy<Value = f64> {
        prop_oneof![
            -10.0..10.0f64,
            (-9i32..9).prop_map(f64::from),
            (-9i32..9, -3i32..3).prop_map(|(x, k)| f64::from(x) + f64::from(k) * f64::EPSILON),
            (-9i32..9, -320i32..300).prop_map(|(x, e)| f64::from(x) * 10f64.powi(e)),
        ]
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20_000))]

        #[test]
        fn doubles_tell_the_nearest_double(
            p in coordinate(),
            q in coordinate(),
            t in prop_oneof![0.0..1.0f64, (1i32..64).prop_map(|x| f64::from(x) / 64.0), 1e-18..1e-9f64],
        ) {
            let [exact, ..] = between::<Dyadic>([[p, 0.0, 0.0], [q, 0.0, 0.0]], t.into()).0;
            if let Some(rounded) = rounded_coordinate(p, q, t) {
                prop_assert_eq!(rounded.to_bits(), exact.to_f64().to_bits());
            }
        }
    }

    /// By far most points are found by doubles.
    #[test]
    fn doubles_mostly_tell() {
        let told = (1..1000).filter(|&i| {
            let t = f64::from(i) * 0.001;
            rounded_coordinate(0.1 + t, 7.3 - t, t * t).is_some()
        });
        assert!(told.count() > 990);
    }
}
