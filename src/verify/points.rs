//! All points that a check talks about, and the exact signs of their determinants.
//!
//! A sign is first asked of doubles ([`super::filter`]), then, where points are no doubles, of doubles relative to one of them
//! ([`Approx`]), and then of integers: of a few machine words ([`super::words`]), of any fixed size ([`super::fixed`]), or of
//! any size at all where coordinates are of too different an order of magnitude. The signs that needed integers are counted.

use super::filter::{self, Exactness, Permanent};
use super::fixed::{self, Scaled};
use super::formulas::{Insphere, Orient, Side};
use super::tally::Tally;
use super::words::{self, Cell};
use crate::machine::prefetch;
use crate::mesh::VertexId;
use crate::number::{Approx, Dyadic, Exact, Number, Sign, Vec3};
use crate::predicate::formula;
use crate::threads;
use arrayvec::ArrayVec;
use rustc_hash::FxHashMap;

/// The points: first the vertices of the mesh, then those points of the input (vertices, hole and region points) that
/// are no mesh vertices. A [`VertexId`] in this module names any of them.
pub(super) struct Points {
    coordinates: Vec<[f64; 3]>,
    /// The points whose coordinates are no doubles; `coordinates` has them rounded.
    exact: FxHashMap<VertexId, Elsewhere>,
    /// How far each point may be from its coordinates along an axis; empty if no point is elsewhere.
    wobble: Vec<f64>,
    /// Whether all coordinates are small enough for the filters.
    pub(super) shortcut: bool,
    largest: f64,
    /// The greatest k for each point such that its coordinates are multiples of 2^k; [`ELSEWHERE`] if they are no doubles.
    grain: Vec<i16>,
    exactness: Exactness,
    exact_signs: Tally,
}

/// Fewer points are one thread's work.
const FEW: usize = 1 << 15;

/// Below all exponents.
const ELSEWHERE: i16 = i16::MIN;

/// The greatest k such that a number is a multiple of 2^k; above all of them for zero.
#[inline(always)]
fn grain(x: f64) -> i16 {
    let bits = x.to_bits();
    let fraction = bits & ((1 << 52) - 1);
    match (bits >> 52 & 0x7ff) as i16 {
        0 if fraction == 0 => i16::MAX,
        0 => -1074 + fraction.trailing_zeros() as i16,
        biased => biased - 1075 + (fraction | 1 << 52).trailing_zeros() as i16,
    }
}

/// Where a point is exactly.
struct Elsewhere {
    at: Vec3<Dyadic>,
    scaled: Option<[Scaled; 3]>,
    /// What its rounded coordinates lack.
    rest: [Approx; 3],
}

/// The difference of two points, in doubles.
pub(super) fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// The cross product, in doubles.
pub(super) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// The scalar product, in doubles.
pub(super) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

impl Points {
    /// Finite coordinates.
    pub(super) fn new(coordinates: Vec<[f64; 3]>) -> Points {
        let n = coordinates.len();
        let parts = threads::in_parts(n, FEW, |range| {
            let numbers = coordinates[range].iter().flatten();
            numbers.fold(0.0f64, |m, x| m.max(x.abs()))
        });
        let largest = parts.into_iter().fold(0.0, f64::max);
        let grain: Vec<i16> = threads::map(n, FEW, |v| {
            let [x, y, z] = coordinates[v].map(grain);
            x.min(y).min(z)
        });
        Points {
            exactness: Exactness::new(grain.iter().copied().min().unwrap_or(0)),
            grain,
            exact_signs: Tally::default(),
            coordinates,
            exact: FxHashMap::default(),
            wobble: Vec::new(),
            shortcut: largest <= filter::LARGEST,
            largest,
        }
    }

    /// The same points, some of which are exactly elsewhere.
    pub(super) fn with_exact(mut self, exact: FxHashMap<VertexId, Vec3<Dyadic>>) -> Points {
        if exact.is_empty() {
            return self;
        }
        self.wobble = vec![0.0; self.coordinates.len()];
        for (v, at) in exact {
            let rest = at.sub(&Vec3::from_f64(self.at(v))).0;
            // More than the rounding of the rest itself, and of twice this.
            let wobble = rest.each_ref().map(|r| match r.exact_sign() {
                Sign::Zero => 0.0,
                _ => r.to_f64().abs() * 1.0001 + f64::MIN_POSITIVE,
            });
            self.wobble[v.index()] = wobble[0].max(wobble[1]).max(wobble[2]);
            self.grain[v.index()] = ELSEWHERE;
            let [x, y, z] = at.0.each_ref().map(Scaled::from_dyadic);
            let scaled = x.zip(y).zip(z).map(|((x, y), z)| [x, y, z]);
            let rest = rest.each_ref().map(Approx::rounded);
            self.exact.insert(v, Elsewhere { at, scaled, rest });
        }
        self
    }

    /// The largest absolute value of a coordinate.
    pub(super) fn largest(&self) -> f64 {
        self.largest
    }

    /// The coordinates, rounded if they are no doubles.
    #[inline(always)]
    pub(super) fn at(&self, v: VertexId) -> [f64; 3] {
        self.coordinates[v.index()]
    }

    /// How far the difference of two of the points may be from that of their coordinates, along an axis.
    #[inline(always)]
    pub(super) fn wobble(&self, points: &[VertexId]) -> f64 {
        if self.wobble.is_empty() {
            return 0.0;
        }
        let wobble = points.iter().map(|v| self.wobble[v.index()]);
        2.0 * wobble.fold(0.0, f64::max)
    }

    /// Whether the point is exactly where its coordinates say.
    pub(super) fn is_double(&self, v: VertexId) -> bool {
        self.exact.is_empty() || !self.exact.contains_key(&v)
    }

    pub(super) fn exact(&self, v: VertexId) -> Vec3<Dyadic> {
        match self.exact.get(&v) {
            Some(exact) => exact.at.clone(),
            None => Vec3::from_f64(self.at(v)),
        }
    }

    /// The exact coordinates, unless they are too long.
    pub(super) fn scaled(&self, v: VertexId) -> Option<[Scaled; 3]> {
        if !self.is_double(v) {
            return self.exact[&v].scaled;
        }
        Some(self.at(v).map(Scaled::from_f64))
    }

    /// Whether two points are exactly at the same place.
    pub(super) fn coincide(&self, v: VertexId, w: VertexId) -> bool {
        self.exact(v) == self.exact(w)
    }

    /// det[b−a, c−a, d−a], exactly.
    pub(super) fn volume(&self, t: [VertexId; 4]) -> Dyadic {
        let p = t.map(|v| self.exact(v));
        formula::orient3d(p.each_ref())
    }

    /// Lets the processor fetch the coordinates of a point that will soon be wanted.
    #[inline(always)]
    pub(super) fn prefetch(&self, v: VertexId) {
        prefetch(&self.coordinates, v.index());
    }

    /// Whether all points are exactly where their coordinates say.
    pub(super) fn are_doubles(&self) -> bool {
        self.exact.is_empty()
    }

    /// The points that are not where their coordinates say, in increasing order.
    pub(super) fn elsewhere(&self) -> Vec<VertexId> {
        let mut all: Vec<VertexId> = self.exact.keys().copied().collect();
        all.sort_unstable();
        all
    }

    /// The coordinates of all points, rounded.
    pub(super) fn coordinates(&self) -> &[[f64; 3]] {
        &self.coordinates
    }

    /// How many points there are.
    pub(super) fn len(&self) -> usize {
        self.coordinates.len()
    }

    /// How many signs were decided by integers so far.
    pub(super) fn exact_signs(&self) -> usize {
        self.exact_signs.total()
    }

    /// The points in the largest unit that makes them integers, if those are small enough.
    #[inline(always)]
    pub(super) fn cells<const N: usize>(&self, ids: [VertexId; N]) -> Option<[Cell; N]> {
        let grain = ids.iter().map(|v| self.grain[v.index()]);
        let unit = match grain.min() {
            None | Some(i16::MAX) => 0,
            Some(k) if (-1000..1000).contains(&k) => i64::from(k),
            Some(_) => return None,
        };
        let scale = f64::from_bits(((1023 - unit) as u64) << 52);
        let mut cells = [[0; 3]; N];
        let mut fits = true;
        for (cell, v) in cells.iter_mut().zip(ids) {
            for (to, from) in cell.iter_mut().zip(self.at(v)) {
                let x = from * scale;
                fits &= x.abs() < words::LARGEST;
                *to = x as i64;
            }
        }
        fits.then_some(cells)
    }

    /// A sign that is decided by integers.
    pub(super) fn counted(&self, sign: Sign) -> Sign {
        self.exact_signs.add();
        sign
    }

    /// A sign by integers that may be long.
    pub(super) fn in_fixed<F: fixed::Formula>(&self, ids: &[VertexId], formula: &F) -> Sign {
        self.counted(fixed::sign(self, ids, formula))
    }

    /// The sign of det[b−a, c−a, d−a].
    #[inline]
    pub(super) fn orient(&self, t: [VertexId; 4]) -> Sign {
        let wobble = self.wobble(&t);
        // Not map(), which is not always inlined.
        let p = [self.at(t[0]), self.at(t[1]), self.at(t[2]), self.at(t[3])];
        if !self.shortcut {
            return self.orient_slowly(t, wobble);
        }
        let filtered = if wobble == 0.0 {
            let determinant = filter::orient_of_doubles(p);
            let certain = determinant.sign(8);
            certain.or_else(|| determinant.sign_below(self.exactness.orient))
        } else {
            filter::orient(p, wobble)
        };
        filtered.unwrap_or_else(|| self.orient_slowly(t, wobble))
    }

    #[cold]
    fn orient_slowly(&self, t: [VertexId; 4], wobble: f64) -> Sign {
        if let Some(cells) = self.cells(t) {
            return self.counted(words::orient(cells));
        }
        let filtered = match wobble == 0.0 {
            true if self.shortcut => filter::orient_by_terms(t.map(|v| self.at(v))),
            true => None,
            false => {
                let p = t.map(|v| self.near(v, self.at(t[0])));
                formula::orient3d(p.each_ref()).sign()
            }
        };
        filtered.unwrap_or_else(|| self.in_fixed(&t, &Orient))
    }

    /// The coordinates relative to a double point, with a bound of their rounding ([`Approx`]): those of a point that is exactly
    /// elsewhere are (x − o) + (p − x), where x is p rounded.
    fn near(&self, v: VertexId, origin: [f64; 3]) -> Vec3<Approx> {
        let from_origin = Vec3::<Approx>::from_f64(self.at(v)).sub(&Vec3::from_f64(origin));
        if self.is_double(v) {
            return from_origin;
        }
        let [x, y, z] = from_origin.0;
        let [rx, ry, rz] = &self.exact[&v].rest;
        Vec3([x + rx, y + ry, z + rz])
    }

    /// The same with the rounded coordinates, if any of the points has others.
    pub(super) fn orient_rounded(&self, t: [VertexId; 4]) -> Option<Sign> {
        if self.wobble(&t) == 0.0 {
            return None;
        }
        let p = t.map(|v| self.at(v));
        let exactly = || {
            let p = p.map(Vec3::from_f64);
            formula::orient3d::<Dyadic>(p.each_ref()).exact_sign()
        };
        let filtered = filter::orient(p, 0.0).filter(|_| self.shortcut);
        Some(filtered.unwrap_or_else(exactly))
    }

    /// Positive iff e is inside the circumsphere of the positive abcd.
    #[inline(always)]
    pub(super) fn insphere(&self, five: [VertexId; 5]) -> Sign {
        let wobble = self.wobble(&five);
        let [a, b, c, d, e] = five;
        let p = [self.at(a), self.at(b), self.at(c), self.at(d), self.at(e)];
        if !self.shortcut {
            return self.insphere_slowly(five, wobble);
        }
        let filtered = if wobble == 0.0 {
            let determinant = filter::insphere_of_doubles(p);
            let certain = determinant.sign(17);
            certain.or_else(|| determinant.sign_below(self.exactness.insphere))
        } else {
            filter::insphere(p, wobble)
        };
        filtered.unwrap_or_else(|| self.insphere_slowly(five, wobble))
    }

    #[cold]
    fn insphere_slowly(&self, five: [VertexId; 5], wobble: f64) -> Sign {
        if let Some(cells) = self.cells(five) {
            return self.counted(words::insphere(cells));
        }
        let filtered = match wobble == 0.0 {
            true if self.shortcut => filter::insphere_by_terms(five.map(|v| self.at(v))),
            true => None,
            false => {
                let p = five.map(|v| self.near(v, self.at(five[4])));
                formula::insphere(p.each_ref()).sign()
            }
        };
        filtered.unwrap_or_else(|| self.in_fixed(&five, &Insphere))
    }

    /// Whether v is exactly on the plane abc.
    pub(super) fn is_on_plane(&self, [a, b, c]: [VertexId; 3], v: VertexId) -> bool {
        [a, b, c].contains(&v) || self.orient([a, b, c, v]).is_zero()
    }

    /// The sign of the average of orient(a, b, c, q) over the points q (four at most): the side of the plane abc on which
    /// their centroid lies.
    pub(super) fn side(&self, [a, b, c]: [VertexId; 3], q: &[VertexId]) -> Sign {
        // Three of the points are on the plane, and add nothing.
        let mut ids = ArrayVec::<VertexId, { fixed::MOST_POINTS }>::from_iter([a, b, c]);
        ids.extend(q.iter().copied().filter(|v| ![a, b, c].contains(v)));
        let others = &ids[3..];
        match others[..] {
            [] => return Sign::Zero,
            [v] => return self.orient([a, b, c, v]),
            _ => {}
        }
        let wobble = self.wobble(&ids);
        let filtered = if wobble != 0.0 {
            let near = |v: VertexId| self.near(v, self.at(a));
            let p = [a, b, c].map(near);
            let sum = |sum: Approx, &v: &VertexId| {
                sum + &formula::orient3d([&p[0], &p[1], &p[2], &near(v)])
            };
            others.iter().fold(Approx::from_f64(0.0), sum).sign()
        } else if self.shortcut {
            let o = self.at(a);
            let row = |v: VertexId| minus(self.at(v), o);
            let terms = others
                .iter()
                .map(|&v| filter::det3_and_terms([row(b), row(c), row(v)]));
            terms
                .fold(Permanent::default(), Permanent::plus)
                .sign(8 + others.len())
        } else {
            None
        };
        filtered.unwrap_or_else(|| self.in_fixed(&ids, &Side))
    }

    /// The centroid of points (four at most), rounded, and how far off that may be along each axis.
    pub(super) fn centroid(&self, q: &[VertexId]) -> ([f64; 3], f64) {
        let share = q.len() as f64;
        let at = [0, 1, 2].map(|i| q.iter().map(|&v| self.at(v)[i] / share).sum::<f64>());
        // At most six roundings of relative size 2⁻⁵³ on the way to the centre of up to four points.
        let coordinates = q.iter().flat_map(|&v| self.at(v));
        let largest = coordinates.fold(0.0f64, |m, x| m.max(x.abs()));
        let slack = 16.0 * f64::EPSILON * largest + f64::MIN_POSITIVE + self.wobble(q);
        (at, slack)
    }

    /// [`Points::side`], where the centroid of the points is `centre` up to `slack`.
    pub(super) fn side_of(
        &self,
        t: [VertexId; 3],
        q: &[VertexId],
        (centre, slack): ([f64; 3], f64),
    ) -> Sign {
        let [a, b, c] = t.map(|v| self.at(v));
        let quickly = filter::orient([a, b, c, centre], slack + self.wobble(&t));
        let quickly = quickly.filter(|_| self.shortcut);
        quickly.unwrap_or_else(|| self.side(t, q))
    }

    /// Whether the closed positive tetrahedron contains the centroid of the points q (four at most), which is `centre` up
    /// to `slack`. `inward` are its faces.
    #[inline]
    pub(super) fn contains(
        &self,
        t: [VertexId; 4],
        inward: &[[usize; 3]; 4],
        q: &[VertexId],
        (centre, slack): ([f64; 3], f64),
    ) -> bool {
        if self.shortcut {
            let p = [self.at(t[0]), self.at(t[1]), self.at(t[2]), self.at(t[3])];
            let wobble = slack + self.wobble(&t);
            if let Some(contains) = filter::contains(p, inward, centre, wobble) {
                return contains;
            }
        }
        inward
            .iter()
            .all(|face| !self.side(face.map(|k| t[k]), q).is_negative())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Grid points make many zeros; tiny offsets make many near-zeros.
    fn coordinate() -> impl Strategy<Value = f64> {
        (-3i32..4, -2i32..3).prop_map(|(i, k)| f64::from(i) * 0.1 + f64::from(k) * 1e-16)
    }

    proptest! {
        /// The shortcut never contradicts the exact number.
        #[test]
        fn shortcut_is_exact(p in prop::collection::vec([coordinate(), coordinate(), coordinate()], 5)) {
            let points = Points::new(p);
            let v = [0, 1, 2, 3, 4].map(VertexId::new);
            let e = v.map(|i| points.exact(i));
            let [a, b, c, d, _] = v;
            prop_assert_eq!(points.orient([a, b, c, d]), points.volume([a, b, c, d]).exact_sign());
            prop_assert_eq!(points.insphere(v), formula::insphere(e.each_ref()).exact_sign());
            prop_assert_eq!(points.orient2d([1, 2], [a, b, c]), points.area([1, 2], [a, b, c]).exact_sign());
        }
    }

    proptest! {
        /// The same where points are exactly between others, and have rounded coordinates.
        #[test]
        fn shortcut_knows_of_exact_positions(
            p in prop::collection::vec([coordinate(), coordinate(), coordinate()], 10),
            t in prop::collection::vec(1u32..16, 5),
        ) {
            let mut exact = FxHashMap::default();
            let mut coordinates = p.clone();
            for (i, t) in t.iter().enumerate() {
                let t = Dyadic::from_f64(f64::from(*t) / 16.0);
                let (a, b) = (Vec3::<Dyadic>::from_f64(p[i]), Vec3::from_f64(p[i + 5]));
                let along = b.sub(&a);
                let at = Vec3([0, 1, 2].map(|k| along.0[k].clone() * &t + &a.0[k]));
                exact.insert(VertexId::new(coordinates.len()), at.clone());
                coordinates.push(at.0.map(|x| x.to_f64()));
            }
            let points = Points::new(coordinates).with_exact(exact);
            for start in 5..11 {
                let v = [0, 1, 2, 3, 4].map(|i| VertexId::new(start + i));
                let e = v.map(|i| points.exact(i));
                let [a, b, c, d, _] = v;
                prop_assert_eq!(points.orient([a, b, c, d]), points.volume([a, b, c, d]).exact_sign());
                prop_assert_eq!(points.insphere(v), formula::insphere(e.each_ref()).exact_sign());
                prop_assert_eq!(points.orient2d([1, 2], [a, b, c]), points.area([1, 2], [a, b, c]).exact_sign());
            }
        }
    }

    #[test]
    fn centroid_decides_the_side() {
        let points = Points::new(vec![
            [0., 0., 0.],
            [1., 0., 0.],
            [0., 1., 0.],
            [0., 0., 2.],
            [0., 0., -1.],
            [5., 5., -1.],
        ]);
        let [a, b, c, up, down, far] = [0, 1, 2, 3, 4, 5].map(VertexId::new);
        assert_eq!(points.side([a, b, c], &[up, down]), Sign::Positive);
        assert_eq!(points.side([a, b, c], &[up, down, far]), Sign::Zero);
        assert_eq!(points.side([a, b, c], &[down, far]), Sign::Negative);
    }
}
