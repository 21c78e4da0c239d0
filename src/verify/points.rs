//! All points that a check talks about, and the exact signs of their determinants.
//!
//! A sign is first asked of doubles ([`super::filter`]), then, where points are no doubles, of doubles relative to one of them
//! ([`Approx`]), and then of integers of a fixed size ([`super::fixed`]), or of any size where coordinates are of too
//! different an order of magnitude.

use super::filter::{self, Permanent};
use super::fixed::{self, Scaled};
use super::formulas::{Compare, Insphere, Orient, Side, Side2d};
use crate::mesh::VertexId;
use crate::number::{Approx, Dyadic, Exact, Number, Sign, Vec3};
use crate::predicate::formula;
use arrayvec::ArrayVec;
use rustc_hash::FxHashMap;
use std::cmp::Ordering;

/// The points: first the vertices of the mesh, then those points of the input (vertices, hole and region points) that
/// are no mesh vertices. A [`VertexId`] in this module names any of them.
pub(super) struct Points {
    coordinates: Vec<[f64; 3]>,
    /// The points whose coordinates are no doubles; `coordinates` has them rounded.
    exact: FxHashMap<VertexId, Elsewhere>,
    /// How far each point may be from its coordinates along an axis; empty if no point is elsewhere.
    wobble: Vec<f64>,
    shortcut: bool,
    largest: f64,
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
        let largest = coordinates
            .iter()
            .flatten()
            .fold(0.0f64, |m, x| m.max(x.abs()));
        Points {
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

    /// The sign of det[b−a, c−a, d−a].
    #[inline]
    pub(super) fn orient(&self, t: [VertexId; 4]) -> Sign {
        let wobble = self.wobble(&t);
        // Not map(), which is not always inlined.
        let p = [self.at(t[0]), self.at(t[1]), self.at(t[2]), self.at(t[3])];
        if self.shortcut
            && let Some(sign) = filter::orient(p, wobble)
        {
            return sign;
        }
        self.orient_slowly(t, wobble)
    }

    #[cold]
    fn orient_slowly(&self, t: [VertexId; 4], wobble: f64) -> Sign {
        let filtered = match wobble == 0.0 {
            true if self.shortcut => filter::orient_by_terms(t.map(|v| self.at(v))),
            true => None,
            false => {
                let p = t.map(|v| self.near(v, self.at(t[0])));
                formula::orient3d(p.each_ref()).sign()
            }
        };
        filtered.unwrap_or_else(|| fixed::sign(self, &t, &Orient))
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
    #[inline]
    pub(super) fn insphere(&self, five: [VertexId; 5]) -> Sign {
        let wobble = self.wobble(&five);
        let [a, b, c, d, e] = five;
        let p = [self.at(a), self.at(b), self.at(c), self.at(d), self.at(e)];
        if self.shortcut
            && let Some(sign) = filter::insphere(p, wobble)
        {
            return sign;
        }
        self.insphere_slowly(five, wobble)
    }

    #[cold]
    fn insphere_slowly(&self, five: [VertexId; 5], wobble: f64) -> Sign {
        let filtered = match wobble == 0.0 {
            true if self.shortcut => filter::insphere_by_terms(five.map(|v| self.at(v))),
            true => None,
            false => {
                let p = five.map(|v| self.near(v, self.at(five[4])));
                formula::insphere(p.each_ref()).sign()
            }
        };
        filtered.unwrap_or_else(|| fixed::sign(self, &five, &Insphere))
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
        filtered.unwrap_or_else(|| fixed::sign(self, &ids, &Side))
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

    /// Twice the signed area of abc in the plane of the two axes, exactly.
    pub(super) fn area(&self, axes: [usize; 2], [a, b, c]: [VertexId; 3]) -> Dyadic {
        let [a, b, c] = [a, b, c].map(|v| {
            let p = self.exact(v);
            axes.map(|i| p.0[i].clone())
        });
        let d = |p: &[Dyadic; 2], i: usize| p[i].clone() - &a[i];
        d(&b, 0) * &d(&c, 1) - &(d(&b, 1) * &d(&c, 0))
    }

    /// The sign of [`Points::area`].
    pub(super) fn orient2d(&self, axes: [usize; 2], [a, b, c]: [VertexId; 3]) -> Sign {
        self.side2d(axes, [a, b], &[c])
    }

    /// The side of the line ab on which the centroid of the points q lies.
    pub(super) fn side2d(&self, axes: [usize; 2], [a, b]: [VertexId; 2], q: &[VertexId]) -> Sign {
        let at = |v: VertexId| {
            let p = self.at(v);
            axes.map(|i| p[i])
        };
        let wobble = self.wobble(&[a, b]).max(self.wobble(q));
        let filtered = filter::side2d([at(a), at(b)], q.iter().map(|&v| at(v)), wobble);
        filtered.filter(|_| self.shortcut).unwrap_or_else(|| {
            let mut ids = ArrayVec::<VertexId, { fixed::MOST_POINTS }>::from_iter([a, b]);
            ids.extend(q.iter().copied().filter(|v| ![a, b].contains(v)));
            match ids.len() {
                2 => Sign::Zero,
                _ => fixed::sign(self, &ids, &Side2d { axes }),
            }
        })
    }

    /// The sign of the area between a point and edges, if certain.
    pub(super) fn quick_area(
        &self,
        axes: [usize; 2],
        origin: VertexId,
        edges: impl Iterator<Item = [VertexId; 2]>,
    ) -> Option<Sign> {
        if !self.shortcut {
            return None;
        }
        let o = self.at(origin);
        let mut sum = Permanent::default();
        let mut n = 4;
        for edge in edges {
            if self.wobble(&edge) != 0.0 || self.wobble(&[origin]) != 0.0 {
                return None;
            }
            let [p, q] = edge.map(|v| minus(self.at(v), o));
            let (left, right) = (p[axes[0]] * q[axes[1]], p[axes[1]] * q[axes[0]]);
            sum = sum.plus(Permanent {
                value: left - right,
                terms: left.abs() + right.abs(),
            });
            n += 1;
        }
        sum.sign(n)
    }

    /// The side of the line ab of a point that is known up to `slack`, if certain; all in the plane of two axes.
    pub(super) fn quick_side2d(
        &self,
        line: [[f64; 2]; 2],
        point: [f64; 2],
        slack: f64,
    ) -> Option<Sign> {
        let sign = filter::side2d(line, std::iter::once(point), slack);
        sign.filter(|_| self.shortcut)
    }

    /// How a coordinate of the centroid of the points q (seven at most) compares with that of v.
    pub(super) fn compare(&self, axis: usize, q: &[VertexId], v: VertexId) -> Sign {
        let wobble = self.wobble(&[v]).max(self.wobble(q));
        let others = q.iter().map(|&w| self.at(w)[axis]);
        let filtered = filter::compare(self.at(v)[axis], others, wobble);
        filtered.filter(|_| self.shortcut).unwrap_or_else(|| {
            let mut ids = ArrayVec::<VertexId, { fixed::MOST_POINTS }>::from_iter([v]);
            ids.extend(q.iter().copied().filter(|w| *w != v));
            fixed::sign(self, &ids, &Compare { axis })
        })
    }

    /// The order of two points by a coordinate.
    pub(super) fn order(&self, axis: usize, v: VertexId, w: VertexId) -> Ordering {
        match self.compare(axis, &[v], w) {
            Sign::Negative => Ordering::Less,
            Sign::Zero => Ordering::Equal,
            Sign::Positive => Ordering::Greater,
        }
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
