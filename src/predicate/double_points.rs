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
//! 1. to 3. see [`super::stages`].
//!
//! The perturbed sign of a zero takes the signs of the circuit's coefficients from the same evaluation.

use super::pairs;
use super::range::Range;
use super::segment_point::{SegmentPoint, between, rounded_between};
use super::{GrowingStore, PointStore, Steiner, formula};
use crate::mesh::VertexId;
use crate::number::{Approx, Dyadic, Exact, Number, Parameter, Sign, Vec3};

/// Points with finite double coordinates; Steiner points may have exact ones that are no doubles.
#[derive(Clone, Debug, Default)]
pub struct DoublePoints {
    /// [NaN, NaN, i] stands for `segment_points[i]`.
    pub(super) points: Vec<[f64; 3]>,
    /// By vertex, ascending.
    segment_points: Vec<(usize, SegmentPoint)>,
    steiner: Steiner,
    /// The identities of reordered points; `None` where each has its index.
    identities: Option<Vec<u32>>,
    pub(super) range: Range,
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
    pub(super) fn any_segment_point(&self, v: &[VertexId]) -> bool {
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

    fn push_unchecked(&mut self, p: [f64; 3]) -> VertexId {
        let v = VertexId::new(self.points.len());
        self.points.push(p);
        if let Some(identities) = &mut self.identities {
            identities.push(v.0);
        }
        v
    }

    /// Stages 1 and 3 where not all coordinates are doubles.
    #[cold]
    pub(super) fn orient3d_of_any(&self, v: [VertexId; 4]) -> Sign {
        let origin = self.rounded(v[0]);
        let p = v.map(|v| self.approx(v, origin));
        let filtered = formula::orient3d(p.each_ref()).sign();
        filtered
            .unwrap_or_else(|| formula::orient3d(v.map(|v| self.exact(v)).each_ref()).exact_sign())
    }

    /// Stages 1 and 3 where not all coordinates are doubles.
    #[cold]
    pub(super) fn insphere_of_any(&self, v: [VertexId; 5]) -> Sign {
        let origin = self.rounded(v[4]);
        let p = v.map(|v| self.approx(v, origin));
        let filtered = formula::insphere(p.each_ref()).sign();
        filtered
            .unwrap_or_else(|| formula::insphere(v.map(|v| self.exact(v)).each_ref()).exact_sign())
    }

    /// The coordinates of a point whose coordinates are doubles, NaN for others.
    #[inline]
    pub(super) fn at<N: Number>(&self, v: VertexId) -> Vec3<N> {
        Vec3::from_f64(self.points[v.index()])
    }
}

impl PointStore for DoublePoints {
    fn len(&self) -> usize {
        self.points.len()
    }

    #[inline]
    fn rounded(&self, v: VertexId) -> [f64; 3] {
        self.segment_point(v)
            .map_or(self.points[v.index()], |p| p.rounded)
    }

    #[inline]
    fn doubles(&self, v: VertexId) -> Option<[f64; 3]> {
        self.is_double(v).then(|| self.points[v.index()])
    }

    fn coordinates<N: Number>(&self, v: VertexId) -> Vec3<N> {
        match self.segment_point(v) {
            Some(p) => between(p.ends, p.t),
            None => self.at(v),
        }
    }

    fn reordered(&self, order: &[VertexId]) -> DoublePoints {
        let mut points: Vec<[f64; 3]> = order.iter().map(|v| self.points[v.index()]).collect();
        let mut segment_points = Vec::new();
        if !self.segment_points.is_empty() {
            for (i, p) in points.iter_mut().enumerate().filter(|(_, p)| p[0].is_nan()) {
                let point = self.segment_points[p[2] as usize].1.clone();
                p[2] = segment_points.len() as f64;
                segment_points.push((i, point));
            }
        }
        DoublePoints {
            points,
            segment_points,
            steiner: self.steiner,
            identities: Some(order.iter().map(|&v| self.identity(v)).collect()),
            range: self.range,
            earlier: Vec::new(),
        }
    }

    fn grid(&self) -> Option<i32> {
        Some(self.range.grid)
    }

    #[inline]
    fn identity(&self, v: VertexId) -> u32 {
        self.identities
            .as_ref()
            .map_or(v.0, |identities| identities[v.index()])
    }

    fn coincide(&self, v: VertexId, w: VertexId) -> bool {
        if self.is_double(v) && self.is_double(w) {
            return self.points[v.index()] == self.points[w.index()];
        }
        let (v, w) = (self.exact(v), self.exact(w));
        v.sub(&w).0.iter().all(|x| x.exact_sign().is_zero())
    }

    #[inline]
    fn orient3d(&self, v: [VertexId; 4]) -> Sign {
        // Written out: array::map is not always inlined, and this is the innermost loop.
        let [a, b, c, d] = v;
        let [a, b, c, d]: [Vec3<f64>; 4] = [self.at(a), self.at(b), self.at(c), self.at(d)];
        let det = formula::orient3d([&a, &b, &c, &d]);
        if det.abs() > self.range.orient3d_error {
            return if det > 0.0 {
                Sign::Positive
            } else {
                Sign::Negative
            };
        }
        self.orient3d_slow(v)
    }

    #[inline]
    fn facet_towards(&self, v: [VertexId; 4], p: VertexId) -> Option<usize> {
        let [a, b, c, d] = v;
        let points = &self.points;
        let sides = pairs::sides([
            &points[a.index()],
            &points[b.index()],
            &points[c.index()],
            &points[d.index()],
            &points[p.index()],
        ]);
        // The facet that p is farthest behind, by volume, without branches, which nobody could predict.
        let lesser = |i: usize, j: usize| if sides[j] < sides[i] { j } else { i };
        let (i, j) = (lesser(0, 1), lesser(2, 3));
        let slot = if sides[j] < sides[i] { j } else { i };
        if sides[slot] < -self.range.orient3d_error {
            return Some(slot);
        }
        // By far most often all are positive.
        let certain = |side: f64| side > self.range.orient3d_error;
        if certain(sides[slot]) && sides.iter().all(|&side| certain(side)) {
            return None;
        }
        (0..4).find(|&slot| {
            let mut moved = v;
            moved[slot] = p;
            !certain(sides[slot]) && self.orient3d(moved).is_negative()
        })
    }

    #[inline]
    fn insphere_unperturbed(&self, v: [VertexId; 5]) -> Sign {
        self.insphere_fast(v)
            .unwrap_or_else(|| self.insphere_slow::<false>(v))
    }

    #[inline]
    fn insphere(&self, v: [VertexId; 5]) -> Sign {
        self.insphere_fast(v)
            .unwrap_or_else(|| self.insphere_slow::<true>(v))
    }
}

impl GrowingStore for DoublePoints {
    /// # Panics
    /// If a coordinate is not finite.
    fn push(&mut self, p: [f64; 3]) -> VertexId {
        let before = self.range;
        for x in p {
            assert!(x.is_finite(), "coordinates are finite");
        }
        if self.range.include(p) {
            self.earlier.push((self.points.len(), before));
        }
        self.push_unchecked(p)
    }

    fn truncate(&mut self, n: usize) {
        self.points.truncate(n);
        while self.segment_points.pop_if(|(i, _)| *i >= n).is_some() {}
        while let Some((_, range)) = self.earlier.pop_if(|(i, _)| *i >= n) {
            self.range = range;
        }
        if let Some(identities) = &mut self.identities {
            identities.truncate(n);
        }
    }

    /// [`Steiner::Rounded`] rounds each coordinate of p + t(q−p) to a double, so that the point is off the line by
    /// about half an ulp, or not at all where the result is representable. p and q must have double coordinates.
    fn push_on_segment(&mut self, p: VertexId, q: VertexId, t: Parameter) -> VertexId {
        let ends = [p, q].map(|v| self.points[v.index()]);
        if self.steiner == Steiner::Rounded
            && let Some(doubles) = rounded_between(ends, t)
        {
            return self.push(doubles);
        }
        let point = match SegmentPoint::new(ends, t) {
            Err(doubles) => return self.push(doubles),
            Ok(point) => point,
        };
        if self.steiner == Steiner::Rounded {
            return self.push(point.rounded);
        }
        let place = self.segment_points.len() as f64;
        self.segment_points.push((self.points.len(), point));
        self.push_unchecked([f64::NAN, f64::NAN, place])
    }
}

/// 2^−900.
const TINY: f64 = f64::MIN_POSITIVE * (1u128 << 122) as f64;

impl DoublePoints {
    /// Stage 0.
    #[inline]
    fn insphere_fast(&self, [a, b, c, d, e]: [VertexId; 5]) -> Option<Sign> {
        let p = &self.points;
        let (det, h) = pairs::insphere([
            &p[a.index()],
            &p[b.index()],
            &p[c.index()],
            &p[d.index()],
            &p[e.index()],
        ]);
        let h2 = h * h;
        if det * det > self.range.insphere_factor * (h2 * h2 * h) + TINY {
            Some(if det > 0.0 {
                Sign::Positive
            } else {
                Sign::Negative
            })
        } else {
            None
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Coordinates from families that defeat floats: small lattices, jittered lattices, mixed and extreme exponents.
    fn coordinate() -> impl Strategy<Value = f64> {
        prop_oneof![
            (-3i32..4).prop_map(f64::from),
            (-3i32..4).prop_map(|x| f64::from(x) * 0.1),
            ((-3i32..4), (-3i32..4))
                .prop_map(|(x, k)| f64::from(x) * (1.0 + f64::from(k) * f64::EPSILON)),
            (-2i32..3, -300i32..300).prop_map(|(x, e)| f64::from(x) * 10f64.powi(e)),
            (-3i32..4).prop_map(|x| f64::from(x) * 5e-324),
            (-2i32..3).prop_map(|x| f64::from(x) * 8.9e307),
        ]
    }

    fn family() -> impl Strategy<Value = Vec<[f64; 3]>> {
        let free = prop::collection::vec([coordinate(), coordinate(), coordinate()], 5);
        let lattice = prop::collection::vec([-2i32..3, -2..3, -2..3], 5);
        let lattice = (lattice, -1070i32..1000).prop_map(|(p, e)| {
            let scale = 2f64.powi(e);
            p.into_iter()
                .map(|q| q.map(|x| f64::from(x) * scale))
                .collect()
        });
        prop_oneof![free, lattice]
    }

    /// What is known of the coordinates, and with it the speed, comes back with the points.
    #[test]
    fn truncation_restores_the_range() {
        let mut store = DoublePoints::new(vec![[1.0, 2.0, 4.0]; 3]);
        for p in [[0.5, 0.0, 1.0], [8.0, 0.0, 1.0], [0.1, 0.2, 1e9]] {
            store.push(p);
        }
        store.truncate(5);
        assert_eq!((store.range.grid, store.range.largest), (-1, 8.0));
        store.truncate(3);
        assert_eq!((store.range.grid, store.range.largest), (0, 4.0));
        assert_eq!(store.push([0.25, 0.0, 0.0]), VertexId(3));
        assert_eq!(store.grid(), Some(-2));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4000))]

        /// The staged predicates agree with the formula over dyadics for every finite double.
        #[test]
        fn stages_agree_with_dyadics(p in family()) {
            let store = DoublePoints::new(p);
            let v: [VertexId; 5] = std::array::from_fn(VertexId::new);
            let [a, b, c, d, _] = v;
            let exact = v.map(|v| store.at::<Dyadic>(v));
            let [ea, eb, ec, ed, _] = exact.each_ref();
            let o = formula::orient3d([ea, eb, ec, ed]).exact_sign();
            prop_assert_eq!(store.orient3d([a, b, c, d]), o);
            prop_assert_eq!(store.orient3d_exact([a, b, c, d]), o);
            let s = formula::insphere(exact.each_ref()).exact_sign();
            prop_assert_eq!(store.insphere_unperturbed(v), s);
            prop_assert_eq!(store.insphere_exact::<false>(v), s);
            let behind = |slot: usize| {
                let mut moved = [a, b, c, d];
                moved[slot] = v[4];
                store.orient3d(moved).is_negative()
            };
            match store.facet_towards([a, b, c, d], v[4]) {
                Some(slot) => prop_assert!(behind(slot)),
                None => prop_assert!(!(0..4).any(behind)),
            }
        }

        /// The same with exact points on segments, also for points of one line or plane.
        #[test]
        fn exact_steiner_points_agree_with_dyadics(
            p in family(),
            q in family(),
            t in prop::collection::vec(1u32..64, 5),
        ) {
            let mut store = DoublePoints::new([p, q].concat()).with_steiner(Steiner::Exact);
            let end = |i: u32| VertexId(i);
            let mut steiner: Vec<VertexId> = (0..5u32)
                .map(|i| store.push_on_segment(end(i), end(5 + i), (f64::from(t[i as usize]) / 64.0).into()))
                .collect();
            steiner.push(store.push_on_segment(end(0), end(5), 0.3.into()));
            steiner.extend((0..10).map(end));
            let exact: Vec<Vec3<Dyadic>> = (0..store.len()).map(|v| store.coordinates(VertexId::new(v))).collect();
            for start in 0..steiner.len() - 4 {
                let v: [VertexId; 5] = std::array::from_fn(|i| steiner[start + i]);
                let [a, b, c, d, e] = v.map(|v| &exact[v.index()]);
                prop_assert_eq!(store.orient3d([v[0], v[1], v[2], v[3]]), formula::orient3d([a, b, c, d]).exact_sign());
                prop_assert_eq!(store.insphere_unperturbed(v), formula::insphere([a, b, c, d, e]).exact_sign());
            }
            for v in [steiner[0], steiner[5]] {
                prop_assert!(store.collinear([end(0), end(5), v]));
                prop_assert!(store.orient3d([end(0), end(5), end(1), v]).is_zero());
            }
            let n = store.count_not_double();
            store.truncate(11);
            prop_assert_eq!(store.count_not_double(), n.min(usize::from(!store.is_double(VertexId(10)))));
        }

        /// Exchanging two of the five points changes the perturbed sign; it is zero only for five coplanar points.
        #[test]
        fn perturbed_insphere_is_alternating(p in family(), i in 0usize..5, step in 1usize..5) {
            let j = (i + step) % 5;
            let store = DoublePoints::new(p);
            let v: [VertexId; 5] = std::array::from_fn(VertexId::new);
            let mut w = v;
            w.swap(i, j);
            let sign = store.insphere(v);
            prop_assert_eq!(sign, -store.insphere(w));
            let coplanar = (0..5).all(|i| super::super::perturbation::circuit_sign(&store, v, i).is_zero());
            prop_assert_eq!(sign.is_zero(), coplanar);
        }
    }
}
