//! Points with double coordinates, and Steiner points on segments with rounded or exact ones; filtered exact
//! predicates.
//!
//! A Steiner point whose exact coordinates are no doubles ([`Steiner::Exact`]) has NaN in their place, so that the
//! first stage below, which nearly all calls end in, says "don't know" without being asked: models without such points
//! pay nothing for them. Their predicates go through stage 1 with coordinates that are sums of two doubles, relative to
//! one of the points, and the rounding of these sums in the error bound, and end in stage 3; all zeros do.
//!
//! Each sign goes through stages until one is sure:
//!
//! 0. the formula over plain doubles, with an error bound that costs next to nothing. By the proof in [`Approx`] the
//!    same evaluation has an error of at most k·u′·m, where k = 8 for orient3d (difference 1, product 3, minor 4,
//!    product 6, two sums 7, 8) and k = 18 for insphere (the same 8 for the five coefficients, sign 9; lift 5; product
//!    9 + 5 + 1 = 15; three more sums), and m is the formula over absolute values. With X, Y, Z bounds of the
//!    coordinate differences and L one of the lifts, m is at most 6·X·Y·Z and 4·6·X·Y·Z·L (up to a factor 1 + 8u for
//!    its own rounding, for which the constants are rounded up by 1 %). For orient3d X, Y, Z are the extents of the
//!    bounding box of all points: one constant, and nothing over- or underflows that matters (no extent is above 2^150,
//!    and those below 2^−150 are taken as that). For insphere L = H, the largest of the four lifts, which come for
//!    nothing, and X, Y, Z ≤ √H: the error is at most c·H^(5/2), c = 18·24·u′, and det² > c²·H⁵ + 2^−900 is the test
//!    without a root. No extent is above 2^99, so that nothing overflows; where c²·H⁵ underflows it is below 2^−900;
//!    and |det| > 2^−450 is far above what the underflow of a product can do, at most 2^−1022 · 2^(4·100+10).
//! 1. to 3. see [`super::stages`]. Stage 0 is in `signs.rs`.
//!
//! The perturbed sign of a zero takes the signs of the circuit's coefficients from the same evaluation.

mod growing;
mod signs;
#[cfg(test)]
mod tests;

use super::range::Range;
use super::segment_point::SegmentPoint;
use super::{PointStore, Steiner, formula};
use crate::mesh::VertexId;
use crate::number::{Approx, Dyadic, Exact, Number, Sign, Vec3};

/// Points with finite double coordinates; Steiner points may have exact ones that are no doubles.
#[derive(Clone, Debug, Default)]
pub struct DoublePoints {
    /// [NaN, NaN, i] stands for `segment_points[i]`.
    pub(in crate::predicate) points: Vec<[f64; 3]>,
    /// By vertex, ascending.
    segment_points: Vec<(usize, SegmentPoint)>,
    steiner: Steiner,
    /// The identities of reordered points; `None` where each has its index.
    identities: Option<Vec<u32>>,
    pub(in crate::predicate) range: Range,
    /// What the range was before the points that changed it: they may be taken back.
    earlier: Vec<(usize, Range)>,
}

impl DoublePoints {
    /// A store of the given points.
    ///
    /// # Panics
    /// If a coordinate is not finite: [`crate::plc::Complex::new`] refuses such input.
    pub fn new(points: Vec<[f64; 3]>) -> DoublePoints {
        let finite = points.iter().flatten().all(|x| x.is_finite());
        assert!(finite, "coordinates are finite");
        let range = Range::of(&points);
        DoublePoints {
            points,
            segment_points: Vec::new(),
            steiner: Steiner::Rounded,
            identities: None,
            range,
            earlier: Vec::new(),
        }
    }

    /// All points, in order of id; NaN for those that are no doubles.
    pub fn as_slice(&self) -> &[[f64; 3]] {
        &self.points
    }

    /// The same as a vector of its own.
    pub fn into_vec(self) -> Vec<[f64; 3]> {
        self.points
    }

    /// The same points, which represent Steiner points in the given way from now on.
    #[must_use]
    pub fn with_steiner(self, steiner: Steiner) -> DoublePoints {
        DoublePoints { steiner, ..self }
    }

    /// Whether the coordinates of a point are doubles.
    pub fn is_double(&self, v: VertexId) -> bool {
        !self.points[v.index()][0].is_nan()
    }

    /// How many points have coordinates that are no doubles.
    pub fn count_not_double(&self) -> usize {
        self.segment_points.len()
    }

    /// A point whose coordinates are no doubles.
    #[inline]
    fn segment_point(&self, v: VertexId) -> Option<&SegmentPoint> {
        let [x, _, i] = self.points[v.index()];
        x.is_nan().then(|| &self.segment_points[i as usize].1)
    }

    /// Whether one of the points has coordinates that are no doubles.
    pub(in crate::predicate) fn any_segment_point(&self, v: &[VertexId]) -> bool {
        !self.segment_points.is_empty() && v.iter().any(|&v| !self.is_double(v))
    }

    /// The coordinates relative to a double point, with the bound of their rounding: (x − o) + rest, so that the bound
    /// is relative to the distance from there, not to the coordinates.
    fn approx(&self, v: VertexId, origin: [f64; 3]) -> Vec3<Approx> {
        let origin = Vec3::from_f64(origin);
        match self.segment_point(v) {
            Some(p) => {
                let [x, y, z] = Vec3::<Approx>::from_f64(p.rounded).sub(&origin).0;
                let [rx, ry, rz] = &p.rest.0;
                Vec3([x + rx, y + ry, z + rz])
            }
            None => self.at(v).sub(&origin),
        }
    }

    fn exact(&self, v: VertexId) -> Vec3<Dyadic> {
        match self.segment_point(v) {
            Some(p) => p.exact.clone(),
            None => self.at(v),
        }
    }

    /// Stages 1 and 3 where not all coordinates are doubles.
    #[cold]
    pub(in crate::predicate) fn orient3d_of_any(&self, v: [VertexId; 4]) -> Sign {
        let origin = self.rounded(v[0]);
        let p = v.map(|v| self.approx(v, origin));
        let filtered = formula::orient3d(p.each_ref()).sign();
        filtered
            .unwrap_or_else(|| formula::orient3d(v.map(|v| self.exact(v)).each_ref()).exact_sign())
    }

    /// Stages 1 and 3 where not all coordinates are doubles.
    #[cold]
    pub(in crate::predicate) fn insphere_of_any(&self, v: [VertexId; 5]) -> Sign {
        let origin = self.rounded(v[4]);
        let p = v.map(|v| self.approx(v, origin));
        let filtered = formula::insphere(p.each_ref()).sign();
        filtered
            .unwrap_or_else(|| formula::insphere(v.map(|v| self.exact(v)).each_ref()).exact_sign())
    }

    /// The coordinates of a point whose coordinates are doubles, NaN for others.
    #[inline]
    pub(in crate::predicate) fn at<N: Number>(&self, v: VertexId) -> Vec3<N> {
        Vec3::from_f64(self.points[v.index()])
    }
}
