//! On which side of a polygon a vertex lies (paper §3.2: left, right, or neither).

use crate::mesh::{Corner, TetId, TetMesh, VertexId};
use crate::number::{Number, Polynomial, Sign, decide};
use crate::plc::Polygon;
use crate::predicate::PointStore;
use crate::recover::tables::Table;
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
    /// The vertices of f, Steiner points included.
    vertices: Vec<VertexId>,
    known: RefCell<SideTable>,
}

/// The sides that are known so far; kept from polygon to polygon for its memory.
pub type SideTable = Table<Option<Side>>;

impl<'a, P: PointStore> Sides<'a, P> {
    /// The sides of a polygon with the given vertices, Steiner points included.
    pub fn new(
        points: &'a P,
        polygon: &Polygon,
        vertices: impl IntoIterator<Item = VertexId>,
    ) -> Sides<'a, P> {
        Sides::with_table(points, polygon, vertices, SideTable::default())
    }

    /// The same, using the memory of `table`.
    pub fn with_table(
        points: &'a P,
        polygon: &Polygon,
        vertices: impl IntoIterator<Item = VertexId>,
        table: SideTable,
    ) -> Sides<'a, P> {
        let [a, b, c] = polygon.frame;
        let mut vertices: Vec<VertexId> = vertices.into_iter().collect();
        vertices.sort_unstable();
        vertices.dedup();
        let on_plane =
            |&v: &VertexId| [a, b, c].contains(&v) || points.orient3d([a, b, c, v]).is_zero();
        let flat = vertices.iter().all(on_plane);
        Sides {
            points,
            frame: polygon.frame,
            flat,
            is_reversed: false,
            known: known(&vertices, table),
            vertices,
        }
    }

    /// The memory given to [`Sides::with_table`].
    pub fn into_table(self) -> SideTable {
        self.known.into_inner()
    }

    /// The same polygon seen from behind.
    pub fn reversed(&self) -> Sides<'a, P> {
        let [a, b, c] = self.frame;
        Sides {
            points: self.points,
            frame: [b, a, c],
            flat: self.flat,
            is_reversed: !self.is_reversed,
            known: known(&self.vertices, SideTable::default()),
            vertices: self.vertices.clone(),
        }
    }

    /// The same polygon as another view of the points shows it. Which vertices are its own, and whether it is flat,
    /// stays as it is.
    pub fn seen_through<'b, Q>(&self, points: &'b Q) -> Sides<'b, Q> {
        Sides {
            points,
            frame: self.frame,
            flat: self.flat,
            is_reversed: self.is_reversed,
            vertices: self.vertices.clone(),
            known: known(&self.vertices, SideTable::default()),
        }
    }

    /// Whether one who walks from a to b on f, on its left side, and then to c, turns left: the sign of
    /// n·((b−a)×(c−a)) with the normal n of the frame.
    pub fn turns_left(&self, a: VertexId, b: VertexId, c: VertexId) -> bool {
        let normals = NormalProduct {
            points: self.points,
            triangles: [self.frame, [a, b, c]],
        };
        decide(&normals).is_positive()
    }

    /// The point store.
    pub fn points(&self) -> &'a P {
        self.points
    }

    /// The side of v. Computed once per vertex.
    #[inline]
    pub fn of(&self, v: VertexId) -> Side {
        if v.is_infinite() {
            return Side::Infinite;
        }
        let known = self.known.borrow().get(v.index());
        known.unwrap_or_else(|| self.compute(v))
    }

    /// The side of v, if it has been asked for, or v is one of f's.
    pub fn known(&self, v: VertexId) -> Option<Side> {
        self.known.borrow().get(v.index())
    }

    #[cold]
    fn compute(&self, v: VertexId) -> Side {
        let [a, b, c] = self.frame;
        let side = match self.points.orient3d([a, b, c, v]) {
            Sign::Positive => Side::Left,
            Sign::Negative => Side::Right,
            Sign::Zero if self.flat => Side::Stray,
            // If f is flat only to rounding, then so is the plane of its frame right only to rounding.
            Sign::Zero if self.is_reversed => Side::Right,
            Sign::Zero => Side::Left,
        };
        self.known.borrow_mut().set(v.index(), Some(side));
        side
    }

    /// Whether a simplex has vertices on both sides: a *crossing simplex*, if it is in the region R.
    #[inline]
    pub fn crosses(&self, simplex: &[VertexId]) -> bool {
        let (mut left, mut right) = (false, false);
        for &v in simplex {
            let side = self.of(v);
            left |= side == Side::Left;
            right |= side == Side::Right;
        }
        left && right
    }

    /// Which of a tetrahedron's vertices are left and which are right, as bits.
    #[inline]
    pub fn left_and_right(&self, vertices: &[VertexId; 4]) -> [u8; 2] {
        let (mut left, mut right) = (0, 0);
        let known = self.known.borrow();
        for (i, v) in vertices.iter().enumerate() {
            let Some(side) = known.get(v.index()) else {
                drop(known);
                return self.new_left_and_right(vertices);
            };
            left |= u8::from(side == Side::Left) << i;
            right |= u8::from(side == Side::Right) << i;
        }
        [left, right]
    }

    /// The same, where not all sides are known.
    #[cold]
    fn new_left_and_right(&self, vertices: &[VertexId; 4]) -> [u8; 2] {
        let (mut left, mut right) = (0, 0);
        for (i, &v) in vertices.iter().enumerate() {
            let side = self.of(v);
            left |= u8::from(side == Side::Left) << i;
            right |= u8::from(side == Side::Right) << i;
        }
        [left, right]
    }

    /// Which facets of a tetrahedron have vertices on both sides, by the bit of the opposite vertex.
    #[inline]
    pub fn crossing_facets(&self, vertices: &[VertexId; 4]) -> u8 {
        crossing_facets(self.left_and_right(vertices))
    }

    /// Whether t has vertices on both sides and is no ghost.
    pub fn crosses_tet(&self, mesh: &TetMesh, t: TetId) -> bool {
        !mesh.is_ghost(t) && self.crosses(&mesh.vertices(t))
    }
}

/// The product of the normals of two triangles.
struct NormalProduct<'a, P> {
    points: &'a P,
    triangles: [[VertexId; 3]; 2],
}

impl<P: PointStore> Polynomial for NormalProduct<'_, P> {
    fn value<N: Number>(&self) -> N {
        let [m, n] = self.triangles.map(|t| {
            let [a, b, c] = t.map(|v| self.points.coordinates::<N>(v));
            b.sub(&a).cross(&c.sub(&a))
        });
        m.dot(&n)
    }
}

/// Which facets have vertices on both sides, by the bit of the opposite vertex, if the left and the right ones are
/// those.
#[inline(always)]
pub fn crossing_facets([left, right]: [u8; 2]) -> u8 {
    CROSSING_FACETS[usize::from(left & 15) << 4 | usize::from(right & 15)]
}

/// By 16·left + right.
const CROSSING_FACETS: [u8; 256] = {
    let mut table = [0; 256];
    let mut i = 0;
    while i < 256 {
        let mut slot = 0;
        while slot < 4 {
            let others = 15 & !(1 << slot);
            if (i >> 4) & others != 0 && i & others != 0 {
                table[i] |= 1 << slot;
            }
            slot += 1;
        }
        i += 1;
    }
    table
};

/// The corners of `t` whose bits are set.
#[inline]
pub fn corners(t: TetId, set: u8) -> impl Iterator<Item = Corner> {
    let lowest = |set: u8| (set != 0).then_some(set);
    let sets = std::iter::successors(lowest(set), move |set| lowest(set & (set - 1)));
    sets.map(move |set| t.corner(set.trailing_zeros() as usize))
}

/// A table that knows the vertices of f.
fn known(vertices: &[VertexId], mut table: SideTable) -> RefCell<SideTable> {
    table.clear();
    for v in vertices {
        table.set(v.index(), Some(Side::On));
    }
    RefCell::new(table)
}
