//! The exact signs of orient3d and insphere, of points and of centroids.
//!
//! A sign is first asked of doubles ([`super::filter`]), then, where points are no doubles, of doubles relative to
//! one of them ([`Approx`]), and then of integers: of a few machine words ([`super::words`]), of any fixed size
//! ([`super::fixed`]), or of any size at all where coordinates are of too different an order of magnitude. The
//! signs that needed integers are counted.

use crate::mesh::VertexId;
use crate::number::vector::minus;
use crate::number::{Approx, Dyadic, Exact, Number, Sign, Vec3};
use crate::predicate::formula;
use crate::verify::signs::filter::{self, Permanent};
use crate::verify::signs::fixed;
use crate::verify::signs::formulas::{Insphere, Orient, Side};
use crate::verify::signs::points::Points;
use crate::verify::signs::words;
use arrayvec::ArrayVec;

impl Points {
    /// The sign of det[b−a, c−a, d−a].
    #[inline]
    pub(crate) fn orient(&self, t: [VertexId; 4]) -> Sign {
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

    /// The coordinates relative to a double point, with a bound of their rounding ([`Approx`]): those of a point that
    /// is exactly elsewhere are (x − o) + (p − x), where x is p rounded.
    fn near(&self, v: VertexId, origin: [f64; 3]) -> Vec3<Approx> {
        let from_origin = Vec3::<Approx>::from_f64(self.at(v)).sub(&Vec3::from_f64(origin));
        if self.is_double(v) {
            return from_origin;
        }
        let [x, y, z] = from_origin.0;
        let [rx, ry, rz] = self.rest(v);
        Vec3([x + rx, y + ry, z + rz])
    }

    /// The same with the rounded coordinates, if any of the points has others.
    pub(crate) fn orient_rounded(&self, t: [VertexId; 4]) -> Option<Sign> {
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
    pub(crate) fn insphere(&self, five: [VertexId; 5]) -> Sign {
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
    pub(crate) fn is_on_plane(&self, [a, b, c]: [VertexId; 3], v: VertexId) -> bool {
        [a, b, c].contains(&v) || self.orient([a, b, c, v]).is_zero()
    }

    /// The sign of the average of orient(a, b, c, q) over the points q (four at most): the side of the plane abc on
    /// which their centroid lies.
    pub(crate) fn side(&self, [a, b, c]: [VertexId; 3], q: &[VertexId]) -> Sign {
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

    /// [`Points::side`], where the centroid of the points is `centre` up to `slack`.
    pub(crate) fn side_of(
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

    /// Whether the closed positive tetrahedron contains the centroid of the points q (four at most), which is
    /// `centre` up to `slack`. `inward` are its faces.
    #[inline]
    pub(crate) fn contains(
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
    use rustc_hash::FxHashMap;

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
