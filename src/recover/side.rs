//! On which side of a polygon a vertex lies (paper §3.2: left, right, or neither).

use crate::mesh::{TetId, TetMesh, VertexId};
use crate::number::{Approx, Dyadic, Exact, Number, Sign};
use crate::plc::Polygon;
use crate::predicate::PointStore;
use rustc_hash::{FxHashMap, FxHashSet};
use std::cell::RefCell;

/// Where a vertex lies with respect to the plane h of a polygon f.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Side {
    /// Where orient3d(frame, v) is positive.
    Left,
    /// Where it is negative.
    Right,
    /// A vertex of f, by what the input says, not by coordinates: if f is flat only to rounding, its vertices are still
    /// treated as on h (paper §3.2).
    On,
    /// A vertex exactly on h that is no vertex of f. Elsewhere on the plane, unless the PLC is invalid.
    Stray,
    /// The infinite vertex.
    Infinite,
}

/// A polygon in the process of insertion: its vertices and boundary, with the Steiner points on its segments.
#[derive(Clone, Debug)]
pub struct Sides<'a, P> {
    points: &'a P,
    /// Three vertices of the polygon; see [`Polygon::frame`].
    pub frame: [VertexId; 3],
    /// Whether all vertices of f lie exactly on h.
    pub flat: bool,
    is_reversed: bool,
    vertices: FxHashSet<VertexId>,
    known: RefCell<FxHashMap<VertexId, Side>>,
}

impl<'a, P: PointStore> Sides<'a, P> {
    /// The sides of a polygon with the given vertices, Steiner points included.
    pub fn new(
        points: &'a P,
        polygon: &Polygon,
        vertices: impl IntoIterator<Item = VertexId>,
    ) -> Sides<'a, P> {
        let [a, b, c] = polygon.frame;
        let vertices: FxHashSet<VertexId> = vertices.into_iter().collect();
        Sides {
            points,
            frame: polygon.frame,
            flat: vertices
                .iter()
                .all(|&v| points.orient3d([a, b, c, v]).is_zero()),
            is_reversed: false,
            vertices,
            known: RefCell::default(),
        }
    }

    /// The same polygon seen from behind.
    pub fn reversed(&self) -> Sides<'a, P> {
        let [a, b, c] = self.frame;
        Sides {
            points: self.points,
            frame: [b, a, c],
            flat: self.flat,
            is_reversed: !self.is_reversed,
            vertices: self.vertices.clone(),
            known: RefCell::default(),
        }
    }

    /// The same polygon as another view of the points shows it. Which vertices are its own, and whether it is flat, stays
    /// as it is.
    pub fn seen_through<'b, Q>(&self, points: &'b Q) -> Sides<'b, Q> {
        Sides {
            points,
            frame: self.frame,
            flat: self.flat,
            is_reversed: self.is_reversed,
            vertices: self.vertices.clone(),
            known: RefCell::default(),
        }
    }

    /// Whether one who walks from a to b on f, on its left side, and then to c, turns left: the sign of
    /// n·((b−a)×(c−a)) with the normal n of the frame.
    pub fn turns_left(&self, a: VertexId, b: VertexId, c: VertexId) -> bool {
        let filtered = self.turn::<Approx>([a, b, c]).sign();
        filtered
            .unwrap_or_else(|| self.turn::<Dyadic>([a, b, c]).exact_sign())
            .is_positive()
    }

    fn turn<N: Number>(&self, corner: [VertexId; 3]) -> N {
        let normal = |[a, b, c]: [VertexId; 3]| {
            let [a, b, c] = [a, b, c].map(|v| self.points.coordinates::<N>(v));
            b.sub(&a).cross(&c.sub(&a))
        };
        normal(self.frame).dot(&normal(corner))
    }

    /// The point store.
    pub fn points(&self) -> &'a P {
        self.points
    }

    /// The side of v. Computed once per vertex.
    pub fn of(&self, v: VertexId) -> Side {
        if v.is_infinite() {
            return Side::Infinite;
        }
        if self.vertices.contains(&v) {
            return Side::On;
        }
        *self.known.borrow_mut().entry(v).or_insert_with(|| {
            let [a, b, c] = self.frame;
            match self.points.orient3d([a, b, c, v]) {
                Sign::Positive => Side::Left,
                Sign::Negative => Side::Right,
                Sign::Zero if self.flat => Side::Stray,
                // If f is flat only to rounding, then so is the plane of its frame right only to rounding.
                Sign::Zero if self.is_reversed => Side::Right,
                Sign::Zero => Side::Left,
            }
        })
    }

    /// Whether a simplex has vertices on both sides: a *crossing simplex*, if it is in the region R.
    pub fn crosses(&self, simplex: &[VertexId]) -> bool {
        let has = |side| simplex.iter().any(|&v| self.of(v) == side);
        has(Side::Left) && has(Side::Right)
    }

    /// Whether t has vertices on both sides and is no ghost.
    pub fn crosses_tet(&self, mesh: &TetMesh, t: TetId) -> bool {
        !mesh.is_ghost(t) && self.crosses(&mesh.vertices(t))
    }
}
