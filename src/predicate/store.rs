//! Where the algorithms get their signs: a list of points that can be asked, and one that also grows.

use super::{coordinates, formula, perturbed_sign};
use crate::mesh::VertexId;
use crate::number::{Dyadic, Exact, Number, Parameter, Polynomial, Sign, Vec3, decide};

/// A list of points that answers geometric questions.
///
/// The default bodies evaluate the formulas over [`Dyadic`]; an implementation overrides them with filtered versions
/// that return the same signs sooner. (`NaivePoints` are the exception: their signs are rounded,
/// for experiments.)
pub trait PointStore: Sync {
    /// The number of points.
    fn len(&self) -> usize;

    /// Whether there is no point.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The coordinates rounded to doubles: for sorting, for choosing where to look first, for output. They decide
    /// nothing.
    fn rounded(&self, v: VertexId) -> [f64; 3];

    /// The coordinates as numbers of type `N`: exact if `N` is.
    fn coordinates<N: Number>(&self, v: VertexId) -> Vec3<N>;

    /// The coordinates, if they are known to be doubles.
    fn doubles(&self, _: VertexId) -> Option<[f64; 3]> {
        None
    }

    /// A list of the given points in the given order, which gives each the identity it has here. For locality: an
    /// algorithm that visits vertices in this order finds neighbours close together in memory.
    fn reordered(&self, order: &[VertexId]) -> Self
    where
        Self: Sized;

    /// The rank of `v` in the order ε_0 ≫ ε_1 ≫ … of the weight perturbation: its identity, never its place in some
    /// spatial order.
    fn identity(&self, v: VertexId) -> u32;

    /// A g such that all coordinates are multiples of 2^g, if one is known.
    fn grid(&self) -> Option<i32> {
        None
    }

    /// The sign of det[b−a, c−a, d−a].
    fn orient3d(&self, v: [VertexId; 4]) -> Sign {
        let p = v.map(|v| self.coordinates::<Dyadic>(v));
        formula::orient3d(p.each_ref()).exact_sign()
    }

    /// A slot of the positive tetrahedron v whose facet has p strictly behind it, if there is one: for walks.
    fn facet_towards(&self, v: [VertexId; 4], p: VertexId) -> Option<usize> {
        (0..4).find(|&slot| {
            let mut moved = v;
            moved[slot] = p;
            self.orient3d(moved).is_negative()
        })
    }

    /// Where a point of any double coordinates, which need not be in the list, lies with respect to the tetrahedron v:
    /// the sign of orient3d with it in place of each vertex. For a positive v all are positive iff it is inside.
    fn sides_of(&self, v: [VertexId; 4], p: [f64; 3]) -> [Sign; 4] {
        [0, 1, 2, 3].map(|slot| {
            decide(&Moved {
                points: self,
                v,
                slot,
                p,
            })
        })
    }

    /// The sign of the unperturbed insphere determinant: positive iff e is inside the circumsphere of a positive abcd.
    fn insphere_unperturbed(&self, v: [VertexId; 5]) -> Sign {
        let p = v.map(|v| self.coordinates::<Dyadic>(v));
        formula::insphere(p.each_ref()).exact_sign()
    }

    /// The sign of insphere under the symbolic perturbation of the weights: never zero, unless all five points are
    /// coplanar.
    #[inline]
    fn insphere(&self, v: [VertexId; 5]) -> Sign {
        let sign = self.insphere_unperturbed(v);
        if sign.is_zero() {
            perturbed_sign(self, v)
        } else {
            sign
        }
    }

    /// Whether two points coincide.
    fn coincide(&self, v: VertexId, w: VertexId) -> bool {
        if let (Some(v), Some(w)) = (self.doubles(v), self.doubles(w)) {
            return v == w;
        }
        let (v, w) = (self.coordinates::<Dyadic>(v), self.coordinates::<Dyadic>(w));
        v.sub(&w).0.iter().all(|x| x.exact_sign().is_zero())
    }

    /// Whether a, b, c lie on one line.
    fn collinear(&self, v: [VertexId; 3]) -> bool {
        if let [Some(a), Some(b), Some(c)] = v.map(|v| self.doubles(v)) {
            return coordinates::collinear([a, b, c]);
        }
        let [a, b, c] = v.map(|v| self.coordinates::<Dyadic>(v));
        let normal = b.sub(&a).cross(&c.sub(&a));
        normal.0.iter().all(|x| x.exact_sign().is_zero())
    }
}

/// A list of points that grows.
pub trait GrowingStore: PointStore {
    /// Adds a point with finite double coordinates.
    fn push(&mut self, p: [f64; 3]) -> VertexId;

    /// Removes all points from index `n` on.
    fn truncate(&mut self, n: usize);

    /// Adds the point p + t(q−p), 0 < t < 1, as exactly as the store's coordinates allow.
    fn push_on_segment(&mut self, p: VertexId, q: VertexId, t: Parameter) -> VertexId;
}

/// orient3d of the tetrahedron v with p in place of one vertex.
struct Moved<'a, P: ?Sized> {
    points: &'a P,
    v: [VertexId; 4],
    slot: usize,
    p: [f64; 3],
}

impl<P: PointStore + ?Sized> Polynomial for Moved<'_, P> {
    fn value<N: Number>(&self) -> N {
        let mut corners = self.v.map(|v| self.points.coordinates::<N>(v));
        corners[self.slot] = Vec3::from_f64(self.p);
        formula::orient3d(corners.each_ref())
    }
}
