//! Exact signs in the plane of a facet: a coordinate axis is dropped along which the plane does not stand upright, so
//! that the projected coordinates are input doubles and no rounding happens at all.

use crate::mesh::VertexId;
use crate::number::{Number, Polynomial, Sign, decide};
pub(crate) use crate::predicate::coordinates::{collinear, orient3d};
use crate::predicate::{coordinates, formula};

/// A point of the projection plane.
pub(crate) type Point = [f64; 2];

/// The projection along a coordinate axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Projection {
    axis: usize,
}

impl Projection {
    /// The projection along the largest component of the normal of a triangle, with the sign of that component;
    /// `None` if the three points are collinear.
    ///
    /// Component k of (b−a) × (c−a) is the determinant of the triangle projected along axis k onto the axes
    /// (k+1, k+2) mod 3, which is what [`Projection::point`] keeps.
    pub fn of(triangle: [[f64; 3]; 3]) -> Option<(Projection, Sign)> {
        let (axis, sign) = coordinates::normal_axis(triangle)?;
        Some((Projection { axis }, sign))
    }

    /// The projection along a coordinate axis.
    pub fn along(axis: usize) -> Projection {
        Projection { axis }
    }

    /// The axis along which it projects.
    pub fn axis(self) -> usize {
        self.axis
    }

    /// The two coordinates that are kept.
    pub fn point(self, p: [f64; 3]) -> Point {
        [p[(self.axis + 1) % 3], p[(self.axis + 2) % 3]]
    }
}

/// The vertices in a projection.
#[derive(Clone, Copy)]
pub(crate) struct Projected<'a> {
    /// The coordinates in space.
    pub points: &'a [[f64; 3]],
    /// The projection.
    pub projection: Projection,
}

impl Projected<'_> {
    /// Where v is.
    pub fn at(&self, v: VertexId) -> Point {
        self.projection.point(self.points[v.index()])
    }

    /// The orientation of abc.
    pub fn orient(&self, [a, b, c]: [VertexId; 3]) -> Sign {
        orient2d(self.at(a), self.at(b), self.at(c))
    }
}

/// The sign of det[b−a, c−a]: positive iff abc turns counterclockwise.
#[inline]
pub(crate) fn orient2d(a: Point, b: Point, c: Point) -> Sign {
    coordinates::orient2d([a, b, c])
}

/// The sign of the area enclosed by a closed walk: Σ det[p_i − p_0, p_{i+1} − p_0].
pub(crate) fn area_sign(walk: &[Point]) -> Sign {
    match walk {
        [] => Sign::Zero,
        &[a, b, c] => orient2d(a, b, c),
        _ => decide(&Area(walk)),
    }
}

/// Twice the area enclosed by a closed walk.
struct Area<'a>(&'a [Point]);

impl Polynomial for Area<'_> {
    fn value<N: Number>(&self) -> N {
        let number = |p: &Point| p.map(N::from_f64);
        let origin = number(&self.0[0]);
        let corners = |pair: &[Point]| {
            let [p, q] = [number(&pair[0]), number(&pair[1])];
            formula::orient2d([&origin, &p, &q])
        };
        let zero = N::from_f64(0.0);
        let triangles = self.0.windows(2).map(corners);
        triangles.fold(zero, |sum, area| sum + &area)
    }
}

/// In which direction a closed walk turns, if it is the boundary of a convex polygon with these corners and no others:
/// it turns in the same direction everywhere, and goes round once, so that its direction changes from ascending to
/// descending, by first and then by second coordinates, only once.
pub(crate) fn convex_turn(walk: &[Point]) -> Option<Sign> {
    let n = walk.len();
    let next = |i: usize| if i + 1 == n { 0 } else { i + 1 };
    let turn = |i: usize| orient2d(walk[i], walk[next(i)], walk[next(next(i))]);
    let ascends = |i: usize| walk[i] < walk[next(i)];
    let sign = turn(0);
    let same = !sign.is_zero() && (1..n).all(|i| turn(i) == sign);
    let changes = || (0..n).filter(|&i| ascends(i) != ascends(next(i))).count();
    (same && changes() == 2).then_some(sign)
}

/// Whether p is on the closed segment ab.
pub(crate) fn on_segment(p: Point, a: Point, b: Point) -> bool {
    in_box(p, a, b) && orient2d(a, b, p).is_zero()
}

/// Whether p is in the bounding box of a and b.
pub(crate) fn in_box(p: Point, a: Point, b: Point) -> bool {
    (0..2).all(|k| a[k].min(b[k]) <= p[k] && p[k] <= a[k].max(b[k]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn projection_keeps_the_orientation() {
        let corner = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        for turn in 0..3 {
            let triangle = corner.map(|[x, y, z]| {
                let mut p = [x, y, z];
                p.rotate_left(turn);
                p
            });
            let (projection, sign) = Projection::of(triangle).unwrap();
            let [a, b, c] = triangle.map(|p| projection.point(p));
            assert_eq!(sign, Sign::Positive);
            assert_eq!(orient2d(a, b, c), sign);
            assert_eq!(area_sign(&[a, c, b]), Sign::Negative);
        }
        assert!(Projection::of([[0.0; 3], [1.0; 3], [3.0; 3]]).is_none());
    }

    #[test]
    fn convex_walks() {
        let square = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];
        assert_eq!(convex_turn(&square), Some(Sign::Positive));
        let [a, b, c, d] = square;
        assert_eq!(convex_turn(&[a, d, c, b]), Some(Sign::Negative));
        // A corner that is none, one that turns in, a bow tie, and a star that goes round twice.
        assert_eq!(convex_turn(&[a, [1.0, 0.0], b, c, d]), None);
        assert_eq!(convex_turn(&[a, [1.0, 0.5], b, c, d]), None);
        assert_eq!(convex_turn(&[a, b, d, c]), None);
        let corner = |i: u32| {
            let angle = f64::from(i) * 0.4 * std::f64::consts::PI;
            [angle.cos(), angle.sin()]
        };
        let star = [0, 2, 4, 1, 3].map(corner);
        assert_eq!(convex_turn(&star), None);
        assert!(area_sign(&star).is_positive());
        let pentagon = [0, 1, 2, 3, 4].map(corner);
        assert_eq!(convex_turn(&pentagon), Some(Sign::Positive));
    }

    #[test]
    fn extreme_coordinates_do_not_lie() {
        let tiny = f64::from_bits(1);
        let collinear = [[1e308, -1e308, 0.0], [-1e308, 1e308, 0.0], [0.0; 3]];
        assert!(super::collinear(collinear));
        let mut other = collinear;
        other[2][0] = tiny;
        assert!(!super::collinear(other));
        assert_eq!(
            orient2d([0.0, 0.0], [tiny, 0.0], [0.0, tiny]),
            Sign::Positive
        );
        let [a, b, c] = other;
        assert_eq!(orient3d([a, b, c, [0.0, 0.0, tiny]]), Sign::Negative);
    }
}
