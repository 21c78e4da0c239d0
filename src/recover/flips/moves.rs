//! The bistellar flips of a tetrahedralization: 2-3, 3-2, 4-4 (Shewchuk 2003).

use crate::mesh::{Corner, FACET, TetId, TetMesh, VertexId, slot_of};
use crate::number::Sign;
use crate::predicate::PointStore;
use arrayvec::ArrayVec;

/// The three kinds of flip.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum FlipKind {
    /// Two tetrahedra on a triangle become three around a new edge.
    TwoThree,
    /// Three tetrahedra around an edge become two on a new triangle.
    ThreeTwo,
    /// Four tetrahedra around an edge, two pairs of coplanar triangles, become four around the crossing edge: two flips
    /// at the same time.
    FourFour,
}

/// A flip that is possible: the tetrahedra to replace, and how.
#[derive(Clone, Debug)]
pub enum Flip {
    /// vxyz and wxzy, and v, x, y, z, w: w takes the place of x, of y and of z.
    TwoThree([TetId; 2], [VertexId; 5]),
    /// vpqr, wprq and the third one around pq, and v, w, p, q, r.
    ThreeTwo([TetId; 3], [VertexId; 5]),
    /// vpqr, wprq, vqpu and wpqu around pq, and v, w, p, q, r, u; v, w, p, q are on one plane.
    FourFour([TetId; 4], [VertexId; 6]),
}

impl Flip {
    /// Which kind.
    pub fn kind(&self) -> FlipKind {
        match self {
            Flip::TwoThree(..) => FlipKind::TwoThree,
            Flip::ThreeTwo(..) => FlipKind::ThreeTwo,
            Flip::FourFour(..) => FlipKind::FourFour,
        }
    }

    /// The tetrahedra to replace.
    pub fn old(&self) -> &[TetId] {
        match self {
            Flip::TwoThree(old, _) => old,
            Flip::ThreeTwo(old, _) => old,
            Flip::FourFour(old, _) => old,
        }
    }

    /// The edge that is removed, in ascending order, and for a 4-4 flip the end of the new edge with the smaller id, as an
    /// edge with four tetrahedra can be flipped in two planes. `None` for 2-3 flips.
    pub fn edge(&self) -> Option<[VertexId; 3]> {
        match *self {
            Flip::TwoThree(..) => None,
            Flip::ThreeTwo(_, [_, _, p, q, _]) => Some([p.min(q), p.max(q), VertexId::INFINITE]),
            Flip::FourFour(_, [v, w, p, q, _, _]) => Some([p.min(q), p.max(q), v.min(w)]),
        }
    }

    /// Does it. Returns the new tetrahedra.
    pub fn perform(&self, mesh: &mut TetMesh) -> ArrayVec<TetId, 4> {
        let mut created = ArrayVec::new();
        match *self {
            Flip::TwoThree(old, vertices) => created.extend(mesh.two_to_three(old, vertices)),
            Flip::ThreeTwo(old, vertices) => created.extend(mesh.three_to_two(old, vertices)),
            Flip::FourFour(old, vertices) => created.extend(mesh.four_to_four(old, vertices)),
        }
        created
    }
}

/// What a 2-3 flip of the triangle xyz would create: vxyz with w in place of x, of y, of z.
fn around_new_edge([v, x, y, z, w]: [VertexId; 5]) -> [[VertexId; 4]; 3] {
    [[v, w, y, z], [v, x, w, z], [v, x, y, w]]
}

/// The flip that removes the triangle xyz opposite corner `c`, between vxyz and wxzy, or `None` if there is none: the
/// union of the tetrahedra around it is not convex.
///
/// The line vw passes inside the edge opposite x of the triangle iff vwyz, which has w in place of x, is positive. If it
/// passes inside all three edges: 2-3. If it passes outside of one, that edge is reflex: 3-2, if it has three
/// tetrahedra. If it meets one edge, v, w and the edge are coplanar: 4-4, if it has four tetrahedra.
///
/// `signs` are those of the circuit's coefficients c_x, c_y, c_z, where they are known; c_x = −orient3d(v, w, y, z).
#[inline(always)]
pub fn flip_of_triangle<P: PointStore>(
    points: &P,
    mesh: &TetMesh,
    c: Corner,
    signs: [Option<Sign>; 3],
) -> Option<Flip> {
    let (t1, twin) = (c.tet(), mesh.twin(c));
    let (old1, old2) = (mesh.tet(t1), mesh.tet(twin.tet()));
    let slots = FACET[c.slot()];
    let (v, w) = (old1.0[c.slot()], old2.0[twin.slot()]);
    let facet = [old1.0[slots[0]], old1.0[slots[1]], old1.0[slots[2]]];
    let [x, y, z] = facet;
    let circuit = [v, x, y, z, w];
    let inside = |i: usize| match signs[i] {
        Some(sign) => sign,
        None => -points.orient3d(around_new_edge(circuit)[i]),
    };
    let signs = [inside(0), inside(1), inside(2)];
    let not_inside = |i: usize| u8::from(!signs[i].is_negative());
    let i = match not_inside(0) | not_inside(1) << 1 | not_inside(2) << 2 {
        0 => return Some(Flip::TwoThree([t1, twin.tet()], circuit)),
        1 => 0,
        2 => 1,
        4 => 2,
        _ => return None,
    };
    let t2 = twin.tet();
    // The edge pq that is not passed inside, and the third vertex of the triangle.
    let r = facet[i];
    let [p, q] = [facet[(i + 1) % 3], facet[(i + 2) % 3]];
    let (behind1, behind2) = (old1.1[slots[i]], old2.1[slot_of(old2.0, r)]);
    let (t3, t4) = (behind1.tet(), behind2.tet());
    if signs[i].is_positive() {
        // The vertex of the third tetrahedron that is not in the first: one tetrahedron may stand for several that are outside
        // of a copy of a region.
        let is_third = t3 == t4 && mesh.vertex(behind1) == w;
        return is_third.then_some(Flip::ThreeTwo([t1, t2, t3], [v, w, p, q, r]));
    }
    // On the other side of the plane of v, w, p, q: vqpu and wpqu.
    let u = mesh.vertex(behind1);
    let four_around_edge = !u.is_infinite()
        && mesh.vertex(behind2) == u
        && u != r
        && mesh.neighbor(mesh.corner_of(t3, v)) == t4;
    four_around_edge.then_some(Flip::FourFour([t1, t2, t3, t4], [v, w, p, q, r, u]))
}
