//! What double points answer: coordinates, and signs by stage 0 of the module above, which is to be inlined everywhere.

use super::DoublePoints;
use crate::mesh::VertexId;
use crate::number::{Exact, Number, Sign, Vec3};
use crate::predicate::segment_point::between;
use crate::predicate::{PointStore, formula, pairs};

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
