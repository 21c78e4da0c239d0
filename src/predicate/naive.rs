//! A view of points whose predicates are rounded and trusted: what a program without exact arithmetic would see. For
//! experiments alone; what is built with it must be judged exactly afterwards.

use super::{PointStore, formula};
use crate::mesh::VertexId;
use crate::number::{Number, Sign, Vec3};

/// The points of a store, seen through a number type N: every sign is that of the formula evaluated in N, and may be
/// wrong. A sign that N does not know (NaN) is given as zero, and so is that of points one of which is repeated. No
/// weight is perturbed: five points that seem cospherical are.
///
/// N is not part of the type, so that what works on a view is not compiled anew for every N.
#[derive(Debug)]
pub struct NaivePoints<'a, P> {
    points: Source<'a, P>,
    orient3d: fn(&P, [VertexId; 4]) -> Sign,
    insphere: fn(&P, [VertexId; 5]) -> Sign,
}

/// The points behind a view: a store's, or a copy of them in another order.
#[derive(Debug)]
enum Source<'a, P> {
    Store(&'a P),
    Own(P),
}

impl<'a, P: PointStore> NaivePoints<'a, P> {
    /// The view of a store through `N`.
    pub fn new<N: Number>(points: &'a P) -> Self {
        NaivePoints {
            points: Source::Store(points),
            orient3d: |points, v| sign::<P, N, 4>(points, v, formula::orient3d),
            insphere: |points, v| sign::<P, N, 5>(points, v, formula::insphere),
        }
    }

    fn points(&self) -> &P {
        match &self.points {
            Source::Store(points) => points,
            Source::Own(points) => points,
        }
    }
}

fn sign<P: PointStore, N: Number, const K: usize>(
    points: &P,
    v: [VertexId; K],
    formula: impl FnOnce([&Vec3<N>; K]) -> N,
) -> Sign {
    if (1..K).any(|i| v[..i].contains(&v[i])) {
        return Sign::Zero;
    }
    let p = v.map(|v| points.coordinates::<N>(v));
    formula(p.each_ref()).sign().unwrap_or(Sign::Zero)
}

impl<P: PointStore> PointStore for NaivePoints<'_, P> {
    fn len(&self) -> usize {
        self.points().len()
    }

    fn rounded(&self, v: VertexId) -> [f64; 3] {
        self.points().rounded(v)
    }

    fn coordinates<M: Number>(&self, v: VertexId) -> Vec3<M> {
        self.points().coordinates(v)
    }

    fn identity(&self, v: VertexId) -> u32 {
        self.points().identity(v)
    }

    fn orient3d(&self, v: [VertexId; 4]) -> Sign {
        (self.orient3d)(self.points(), v)
    }

    fn insphere_unperturbed(&self, v: [VertexId; 5]) -> Sign {
        (self.insphere)(self.points(), v)
    }

    fn insphere(&self, v: [VertexId; 5]) -> Sign {
        self.insphere_unperturbed(v)
    }

    fn reordered(&self, order: &[VertexId]) -> Self {
        NaivePoints {
            points: Source::Own(self.points().reordered(order)),
            ..*self
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Wide;
    use crate::predicate::DoublePoints;

    #[test]
    fn trusts_what_it_computes() {
        // The fourth point is one part in a thousand above the plane of the first three.
        let height = 1.0 + 0.001;
        let p = [
            [0.0, 0.0, 1.0],
            [1.0, 0.0, 1.0],
            [0.0, 1.0, 1.0],
            [0.0, 0.0, height],
        ];
        let points = DoublePoints::new(p.to_vec());
        let v = [0, 1, 2, 3].map(VertexId);
        assert_eq!(points.orient3d(v), Sign::Positive);
        assert_eq!(NaivePoints::new::<f64>(&points).orient3d(v), Sign::Positive);
        assert_eq!(NaivePoints::new::<Wide<8>>(&points).orient3d(v), Sign::Zero);
    }

    #[test]
    fn a_view_in_another_order_sees_the_same() {
        let p = [
            [0.0, 0.0, 1.0],
            [1.0, 0.0, 1.0],
            [0.0, 1.0, 1.0],
            [0.0, 0.0, 1.001],
        ];
        let points = DoublePoints::new(p.to_vec());
        let order = [1, 0, 2, 3].map(VertexId);
        let v = [0, 1, 2, 3].map(VertexId);
        let view = NaivePoints::new::<f64>(&points).reordered(&order);
        assert_eq!(view.orient3d(v), Sign::Negative);
        assert_eq!(view.identity(VertexId(0)), 1);
        let view = NaivePoints::new::<Wide<8>>(&points).reordered(&order);
        assert_eq!(view.orient3d(v), Sign::Zero);
    }

    #[test]
    fn unknown_and_repeated_are_zero() {
        let huge = [
            [0.0; 3],
            [1e300, 0.0, 0.0],
            [0.0, 1e300, 0.0],
            [0.0, 0.0, 1e300],
        ];
        let mut p = huge.to_vec();
        p.push([1e300, 1e300, 1e300]);
        let points = DoublePoints::new(p);
        let naive = NaivePoints::new::<f64>(&points);
        // Infinity minus infinity somewhere.
        assert_eq!(naive.insphere([0, 1, 2, 3, 4].map(VertexId)), Sign::Zero);
        let seen = NaivePoints::new::<f32>(&points);
        assert_eq!(seen.orient3d([0, 1, 2, 1].map(VertexId)), Sign::Zero);
    }
}
