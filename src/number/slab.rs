//! The plane to which points are nearest, where the distance is that along the coordinate axes: a plane is within δ of
//! a point if it meets the cube of half side δ around it. So it is within δ of all points of a plane that have been
//! rounded, each coordinate by at most δ.
//!
//! After the exchange algorithm for Chebyshev approximation (Stiefel, *Numerische Mathematik* 1, 1959): four points,
//! the reference, have one plane from which all are equally far, on alternating sides; no plane is nearer to all four.
//! As long as some other point is farther from it, it takes the place of that one of the four that leaves the largest
//! distance. So a plane within δ is found, or four points show that there is none. Everything is rounded; whoever
//! relies on a distance compares it by himself.

use super::vector::{cross, minus};

/// A plane: one coordinate as an affine function of the two others.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slab {
    /// The coordinate that is the function, and the ones that it depends on.
    axes: [usize; 3],
    /// A point near all others, with which differences are taken.
    origin: [f64; 3],
    /// The function: slopes and the value at the origin.
    plane: [f64; 3],
    /// The three or four points that the plane follows from, as differences.
    reference: [[f64; 3]; 4],
    /// How many they are.
    size: usize,
}

/// How often points are exchanged.
const MOST_EXCHANGES: usize = 64;

impl Slab {
    /// The plane of a triangle; `None` if it is too close to a line for doubles.
    pub(crate) fn of([a, b, c]: [[f64; 3]; 3]) -> Option<Slab> {
        let normal = cross(minus(b, a), minus(c, a));
        let size = |k: usize| normal[k].abs();
        let mut axis = 0;
        for k in 1..3 {
            if size(k) > size(axis) {
                axis = k;
            }
        }
        let length = size(axis);
        if !(length > 0.0 && length.is_finite()) {
            return None;
        }
        let axes = [axis, (axis + 1) % 3, (axis + 2) % 3];
        let slope = |k: usize| -normal[axes[k]] / normal[axis];
        let mut slab = Slab {
            axes,
            origin: a,
            plane: [slope(1), slope(2), 0.0],
            reference: [[0.0; 3]; 4],
            size: 3,
        };
        slab.reference = [a, b, c, c].map(|p| slab.local(p));
        Some(slab)
    }

    /// The coordinate that is a function of the others.
    pub(crate) fn axis(&self) -> usize {
        self.axes[0]
    }

    /// A point as x, y and the height z.
    fn local(&self, p: [f64; 3]) -> [f64; 3] {
        let [z, x, y] = self.axes.map(|k| p[k] - self.origin[k]);
        [x, y, z]
    }

    /// How far the point is above the plane, along the axis.
    fn height(&self, [x, y, z]: [f64; 3]) -> f64 {
        let [a, b, c] = self.plane;
        z - (a * x + b * y) - c
    }

    /// A height in terms of distances along all axes.
    fn as_distance(&self, height: f64) -> f64 {
        height.abs() / (1.0 + self.plane[0].abs() + self.plane[1].abs())
    }

    /// How far a point is from the plane along each axis.
    pub(crate) fn distance(&self, p: [f64; 3]) -> f64 {
        self.as_distance(self.height(self.local(p)))
    }

    /// The plane as n·(p − o) = c: n, o and c.
    pub(crate) fn equation(&self) -> ([f64; 3], [f64; 3], f64) {
        let [z, x, y] = self.axes;
        let [a, b, c] = self.plane;
        let mut normal = [0.0; 3];
        (normal[z], normal[x], normal[y]) = (1.0, -a, -b);
        (normal, self.origin, c)
    }

    /// Moves the plane until it is within `delta` of all points. `false` if there is no such plane, up to rounding, or
    /// if none is found; the plane is the one before then. Points from `new` on are looked at first. O(n) for each
    /// exchange, of which there are few.
    pub(crate) fn fit(&mut self, points: &[[f64; 3]], new: usize, delta: f64) -> bool {
        let before = *self;
        let mut range = new.min(points.len())..points.len();
        for _ in 0..MOST_EXCHANGES {
            let worst = farthest(&points[range.clone()], |p| self.distance(p));
            match worst {
                Some((p, distance)) if distance.is_nan() || distance > delta => {
                    if !self.exchange(self.local(p), delta) {
                        break;
                    }
                }
                _ if range.start == 0 => return true,
                _ => range.start = 0,
            }
        }
        *self = before;
        false
    }

    /// Takes a point into the reference. `false` if four points are too far apart then, or nothing is gained.
    fn exchange(&mut self, p: [f64; 3], delta: f64) -> bool {
        let now = match self.size {
            3 => 0.0,
            _ => self.level(&self.reference).abs(),
        };
        let mut best = (0.0f64, self.reference);
        for place in if self.size == 3 { 3..4 } else { 0..4 } {
            let mut four = self.reference;
            four[place] = p;
            let level = self.level(&four);
            if level.abs() > best.0.abs() {
                best = (level, four);
            }
        }
        let (level, four) = best;
        if !level.is_finite() || level.abs() <= now || self.as_distance(level) > delta {
            return false;
        }
        (self.reference, self.size) = (four, 4);
        self.balance(level);
        self.plane.iter().all(|x| x.is_finite())
    }

    /// The signed areas of the triangles without each of four points, with alternating signs: an affine function that
    /// has these as coefficients is 0.
    fn areas(four: &[[f64; 3]; 4]) -> [f64; 4] {
        let area = |i: usize, j: usize, k: usize| {
            let [p, q] = [minus(four[j], four[i]), minus(four[k], four[i])];
            p[0] * q[1] - p[1] * q[0]
        };
        [area(1, 2, 3), -area(0, 2, 3), area(0, 1, 3), -area(0, 1, 2)]
    }

    /// The height at which four points are equally far from a plane, with a sign.
    fn level(&self, four: &[[f64; 3]; 4]) -> f64 {
        let areas = Slab::areas(four);
        let sum: f64 = areas.iter().map(|a| a.abs()).sum();
        let heights = areas.iter().zip(four).map(|(a, &p)| a * self.height(p));
        match sum > 0.0 {
            true => heights.sum::<f64>() / sum,
            false => 0.0,
        }
    }

    /// Moves the plane to where the four points of the reference are at the level, on alternating sides.
    fn balance(&mut self, level: f64) {
        let areas = Slab::areas(&self.reference);
        // The three whose triangle is largest.
        let mut out = 0;
        for i in 1..4 {
            if areas[i].abs() > areas[out].abs() {
                out = i;
            }
        }
        let rest: Vec<usize> = (0..4).filter(|&i| i != out).collect();
        let wanted = |i: usize| self.height(self.reference[i]) - level * areas[i].signum();
        let [p, q, r] = [rest[0], rest[1], rest[2]].map(|i| self.reference[i]);
        let values = [rest[0], rest[1], rest[2]].map(wanted);
        let [u, v] = [minus(q, p), minus(r, p)];
        let [s, t] = [values[1] - values[0], values[2] - values[0]];
        let area = u[0] * v[1] - u[1] * v[0];
        let a = (s * v[1] - t * u[1]) / area;
        let b = (t * u[0] - s * v[0]) / area;
        self.plane[0] += a;
        self.plane[1] += b;
        self.plane[2] += values[0] - a * p[0] - b * p[1];
    }
}

/// The point that is farthest, the first of several, and how far.
fn farthest(points: &[[f64; 3]], distance: impl Fn([f64; 3]) -> f64) -> Option<([f64; 3], f64)> {
    let mut worst: Option<([f64; 3], f64)> = None;
    for &p in points {
        let d = distance(p);
        if worst.is_none_or(|(_, most)| d > most || d.is_nan()) {
            worst = Some((p, d));
        }
    }
    worst
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Points of a plane through the origin, each coordinate rounded to multiples of 2δ.
    fn rounded(slopes: [f64; 2], at: &[[f64; 2]], delta: f64) -> Vec<[f64; 3]> {
        let round = |x: f64| (x / (2.0 * delta)).round() * (2.0 * delta);
        let point = |&[x, y]: &[f64; 2]| [x, y, slopes[0] * x + slopes[1] * y].map(round);
        at.iter().map(point).collect()
    }

    proptest! {
        /// A plane is found for whatever has been rounded by at most δ, in whatever order it comes.
        #[test]
        fn rounded_planes_are_found(
            slopes in prop::array::uniform2(-1.0..1.0f64),
            at in prop::collection::vec(prop::array::uniform2(-9.0..9.0f64), 4..60),
            e in 10..40i32,
        ) {
            let delta = 2f64.powi(-e);
            let points = rounded(slopes, &at, delta);
            if let Some(mut slab) = Slab::of([points[0], points[1], points[2]]) {
                prop_assert!(slab.fit(&points, 0, delta * 1.001));
                for &p in &points {
                    prop_assert!(slab.distance(p) <= delta * 1.001);
                }
            }
        }

        /// A ridge that is higher than 2δ is not flat, however wide it is: half its height is off every plane.
        #[test]
        fn ridges_are_seen(width in 0.1..100.0f64, height in 2.5..1000.0f64) {
            let delta = 1e-6;
            let z = height * delta;
            let points = [[0.0, 0.0, 0.0], [width, 0.0, z], [width, 1.0, z], [2.0 * width, 1.0, 0.0], [0.0, 1.0, 0.0],
                [2.0 * width, 0.0, 0.0]];
            let mut slab = Slab::of([points[0], points[1], points[2]]).unwrap();
            prop_assert!(!slab.fit(&points, 0, delta));
            prop_assert!(slab.fit(&points, 0, z));
        }
    }
}
