//! Points with double coordinates, and Steiner points on segments with rounded or exact ones; filtered exact predicates.
//!
//! A Steiner point whose exact coordinates are no doubles ([`Steiner::Exact`]) has NaN in their place, so that the first
//! stage below, which nearly all calls end in, says "don't know" without being asked: models without such points pay
//! nothing for them. Their predicates go through stage 1 with coordinates that are sums of two doubles, relative to one of the
//! points, and the rounding of these sums in the error bound, and end in stage 3; all zeros do.
//!
//! Each sign goes through stages until one is sure:
//!
//! 0. the formula over plain doubles, with a bound from the largest coordinate differences X, Y, Z alone. By the proof in
//!    [`Approx`] the same evaluation has an error of at most k·u′·m, where k = 8 for orient3d (difference 1, product 3,
//!    minor 4, product 6, two sums 7, 8) and k = 18 for insphere (the same 8 for the five coefficients, sign 9; lift 5;
//!    product 9 + 5 + 1 = 15; three more sums), and m, the formula over absolute values, is at most 6·X·Y·Z and
//!    4·6·X·Y·Z·L with L = 3·max(X,Y,Z)² (1 + 8u for its own rounding). Where X, Y and Z are all in [2^−150, 2^150]
//!    nothing over- or underflows, and the terms T of that proof stay below 2^−1022 · 2^(4·150+10), a fraction 2^−9 of u′
//!    of the bound. The constants below are rounded up by 1 %;
//! 1. the formula over [`Approx`] (running error bound, proved there), which also certifies *zero* where all coordinates
//!    lie on a grid 2^g and the determinant, an integer multiple of 2^(g·degree), is proved smaller than that;
//! 2. Shewchuk's adaptive expansions from the `robust` crate, where they can neither overflow nor underflow: all
//!    coordinates are multiples of 2^g with g ≥ −200, hence all terms and tails of the degree 5 polynomial are multiples
//!    of 2^−1000 and representable; and all are below 2^190 in magnitude, hence the polynomial and its partial sums, a
//!    sum of at most 2^12 products of five differences below 2^191, stay below 2^(5·191+12) < 2^1023;
//! 3. the formula over [`Dyadic`](crate::number::Dyadic), for every finite double.

use super::segment_point::{SegmentPoint, between};
use super::{Parameter, PointStore, Steiner, formula};
use crate::mesh::VertexId;
use crate::number::{Approx, Dyadic, Exact, Number, Sign, Vec3};
use robust::Coord3D;

/// Points with finite double coordinates; Steiner points may have exact ones that are no doubles.
#[derive(Clone, Debug, Default)]
pub struct DoublePoints {
    /// [NaN, NaN, i] stands for `segment_points[i]`.
    points: Vec<[f64; 3]>,
    /// By vertex, ascending.
    segment_points: Vec<(usize, SegmentPoint)>,
    steiner: Steiner,
    /// The identities of reordered points; `None` where each has its index.
    identities: Option<Vec<u32>>,
    range: Range,
    /// What the range was before the points that changed it: they may be taken back.
    earlier: Vec<(usize, Range)>,
}

/// What is known of all coordinates that are doubles: the grid that they lie on and their largest magnitude.
#[derive(Clone, Copy, Debug)]
struct Range {
    /// All coordinates are multiples of 2^grid.
    grid: i32,
    /// All coordinates are at most this in magnitude.
    largest: f64,
    /// 2^(3·grid) and 2^(5·grid), or 0 where that is no normal double.
    quantum3: f64,
    quantum5: f64,
    /// Whether stage 2 is safe.
    expansions_safe: bool,
}

impl Default for Range {
    fn default() -> Range {
        Range {
            grid: 1023,
            largest: 0.0,
            quantum3: 0.0,
            quantum5: 0.0,
            expansions_safe: true,
        }
    }
}

impl Range {
    fn include(&mut self, x: f64) {
        if x == 0.0 {
            return;
        }
        let grid = lowest_bit(x);
        if grid < self.grid || x.abs() > self.largest {
            self.grid = self.grid.min(grid);
            self.largest = self.largest.max(x.abs());
            self.quantum3 = power_of_two(3 * self.grid);
            self.quantum5 = power_of_two(5 * self.grid);
            self.expansions_safe = self.grid >= -200 && self.largest < 2f64.powi(190);
        }
    }
}

/// The exponent of the lowest set bit of a non-zero finite double.
fn lowest_bit(x: f64) -> i32 {
    let bits = x.to_bits();
    let biased = ((bits >> 52) & 0x7ff) as i32;
    let fraction = bits & ((1 << 52) - 1);
    if biased == 0 {
        -1074 + fraction.trailing_zeros() as i32
    } else {
        biased - 1075 + (fraction | 1 << 52).trailing_zeros() as i32
    }
}

/// 2^k if that is a normal double, else 0.
fn power_of_two(k: i32) -> f64 {
    if (-1022..=1023).contains(&k) {
        f64::from_bits(((k + 1023) as u64) << 52)
    } else {
        0.0
    }
}

impl DoublePoints {
    /// A store of the given points.
    ///
    /// # Panics
    /// If a coordinate is not finite: [`crate::plc::Complex::new`] refuses such input.
    pub fn new(points: Vec<[f64; 3]>) -> DoublePoints {
        let mut range = Range::default();
        for &x in points.iter().flatten() {
            assert!(x.is_finite(), "coordinates are finite");
            range.include(x);
        }
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
    pub fn no_doubles(&self) -> usize {
        self.segment_points.len()
    }

    /// A point whose coordinates are no doubles.
    fn segment_point(&self, v: VertexId) -> Option<&SegmentPoint> {
        let [x, _, i] = self.points[v.index()];
        x.is_nan().then(|| &self.segment_points[i as usize].1)
    }

    /// Whether one of the points has coordinates that are no doubles.
    fn any_segment_point(&self, v: &[VertexId]) -> bool {
        !self.segment_points.is_empty() && v.iter().any(|&v| !self.is_double(v))
    }

    /// The coordinates relative to a double point, with the bound of their rounding: (x − o) + rest, so that the bound is
    /// relative to the distance from there, not to the coordinates.
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
    fn orient3d_of_any(&self, v: [VertexId; 4]) -> Sign {
        let origin = self.rounded(v[0]);
        let p = v.map(|v| self.approx(v, origin));
        let filtered = formula::orient3d(p.each_ref()).sign();
        filtered
            .unwrap_or_else(|| formula::orient3d(v.map(|v| self.exact(v)).each_ref()).exact_sign())
    }

    /// Stages 1 and 3 where not all coordinates are doubles.
    #[cold]
    fn insphere_of_any(&self, v: [VertexId; 5]) -> Sign {
        let origin = self.rounded(v[4]);
        let p = v.map(|v| self.approx(v, origin));
        let filtered = formula::insphere(p.each_ref()).sign();
        filtered
            .unwrap_or_else(|| formula::insphere(v.map(|v| self.exact(v)).each_ref()).exact_sign())
    }

    /// The coordinates of a point whose coordinates are doubles, NaN for others.
    #[inline]
    fn at<N: Number>(&self, v: VertexId) -> Vec3<N> {
        Vec3::from_f64(self.points[v.index()])
    }

    #[inline]
    fn coord(&self, v: VertexId) -> Coord3D<f64> {
        let [x, y, z] = self.points[v.index()];
        Coord3D { x, y, z }
    }

    /// Stages 1 and 2.
    fn orient3d_filtered(&self, v: [VertexId; 4]) -> Sign {
        if self.any_segment_point(&v) {
            return self.orient3d_of_any(v);
        }
        let [a, b, c, d] = v;
        let [a, b, c, d]: [Vec3<Approx>; 4] = [self.at(a), self.at(b), self.at(c), self.at(d)];
        let filtered = formula::orient3d([&a, &b, &c, &d]).sign_on_grid(self.range.quantum3);
        filtered.unwrap_or_else(|| self.orient3d_exact(v))
    }

    /// Stages 1 and 2.
    fn insphere_filtered(&self, v: [VertexId; 5]) -> Sign {
        if self.any_segment_point(&v) {
            return self.insphere_of_any(v);
        }
        let [a, b, c, d, e] = v;
        let [a, b, c, d, e]: [Vec3<Approx>; 5] =
            [self.at(a), self.at(b), self.at(c), self.at(d), self.at(e)];
        let filtered = formula::insphere([&a, &b, &c, &d, &e]).sign_on_grid(self.range.quantum5);
        filtered.unwrap_or_else(|| self.insphere_exact(v))
    }

    #[cold]
    fn orient3d_exact(&self, v: [VertexId; 4]) -> Sign {
        if self.range.expansions_safe {
            let [a, b, c, d] = v.map(|v| self.coord(v));
            // Shewchuk's orient3d is the negative of ours.
            return -Sign::of_f64(robust::orient3d(a, b, c, d))
                .expect("expansions do not overflow");
        }
        formula::orient3d(v.map(|v| self.at::<Dyadic>(v)).each_ref()).exact_sign()
    }

    #[cold]
    fn insphere_exact(&self, v: [VertexId; 5]) -> Sign {
        if self.range.expansions_safe {
            let [a, b, c, d, e] = v.map(|v| self.coord(v));
            // Positive inside for the opposite orientation of abcd: the negative of ours.
            let sign = Sign::of_f64(robust::insphere(a, b, c, d, e));
            return -sign.expect("expansions do not overflow");
        }
        formula::insphere(v.map(|v| self.at::<Dyadic>(v)).each_ref()).exact_sign()
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

    /// # Panics
    /// If a coordinate is not finite.
    fn push(&mut self, p: [f64; 3]) -> VertexId {
        let before = self.range;
        for x in p {
            assert!(x.is_finite(), "coordinates are finite");
            self.range.include(x);
        }
        if (before.grid, before.largest) != (self.range.grid, self.range.largest) {
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

    /// [`Steiner::Rounded`] rounds each coordinate of p + t(q−p) to a double, so that the point is off the line by about
    /// half an ulp, or not at all where the result is representable. p and q must have double coordinates.
    fn push_on_segment(&mut self, p: VertexId, q: VertexId, t: Parameter) -> VertexId {
        let ends = [p, q].map(|v| self.points[v.index()]);
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

    #[inline]
    fn orient3d(&self, v: [VertexId; 4]) -> Sign {
        // Written out: array::map is not always inlined, and this is the innermost loop.
        let [a, b, c, d] = v;
        let [a, b, c, d]: [Vec3<f64>; 4] = [self.at(a), self.at(b), self.at(c), self.at(d)];
        let det = formula::orient3d([&a, &b, &c, &d]);
        let [x, y, z] = largest_differences(&a, [&b, &c, &d]);
        if det.abs() > ORIENT3D_BOUND * (x * y * z) && in_static_range([x, y, z]) {
            return if det > 0.0 {
                Sign::Positive
            } else {
                Sign::Negative
            };
        }
        self.orient3d_filtered(v)
    }

    #[inline]
    fn insphere_unperturbed(&self, v: [VertexId; 5]) -> Sign {
        let [a, b, c, d, e] = v;
        let [a, b, c, d, e]: [Vec3<f64>; 5] =
            [self.at(a), self.at(b), self.at(c), self.at(d), self.at(e)];
        let det = formula::insphere([&a, &b, &c, &d, &e]);
        let [x, y, z] = largest_differences(&e, [&a, &b, &c, &d]);
        let side = x.max(y).max(z);
        if det.abs() > INSPHERE_BOUND * (x * y * z) * (side * side) && in_static_range([x, y, z]) {
            return if det > 0.0 {
                Sign::Positive
            } else {
                Sign::Negative
            };
        }
        self.insphere_filtered(v)
    }
}

/// 8·6·2⁻⁵², rounded up.
const ORIENT3D_BOUND: f64 = 48.5 * f64::EPSILON;
/// 18·24·3·2⁻⁵², rounded up.
const INSPHERE_BOUND: f64 = 1310.0 * f64::EPSILON;

/// The largest |x|, |y|, |z| among the differences of some points to one.
#[inline]
fn largest_differences<const N: usize>(origin: &Vec3<f64>, points: [&Vec3<f64>; N]) -> [f64; 3] {
    let mut largest = [0.0f64; 3];
    for p in points {
        for (i, x) in largest.iter_mut().enumerate() {
            *x = x.max((p.0[i] - origin.0[i]).abs());
        }
    }
    largest
}

/// Whether stage 0 is proved for these differences.
#[inline]
fn in_static_range(largest: [f64; 3]) -> bool {
    const LOW: f64 = 1.0 / (1u128 << 100) as f64 / (1u64 << 50) as f64;
    const HIGH: f64 = (1u128 << 100) as f64 * (1u64 << 50) as f64;
    largest.iter().all(|&x| (LOW..=HIGH).contains(&x))
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
            prop_assert_eq!(store.insphere_exact(v), s);
        }

        /// The same with exact points on segments, also for points of one line or plane.
        #[test]
        fn exact_steiner_points_agree_with_dyadics(p in family(), q in family(), t in prop::collection::vec(1u32..64, 5)) {
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
            let n = store.no_doubles();
            store.truncate(11);
            prop_assert_eq!(store.no_doubles(), n.min(usize::from(!store.is_double(VertexId(10)))));
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
