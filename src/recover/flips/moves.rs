//! The bistellar flips of a tetrahedralization: 2-3, 3-2, 4-4 (Shewchuk 2003).

use super::event::Signs;
use crate::mesh::{Corner, FACET, TetId, TetMesh, VertexId, behind};
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

    /// Which facets of each new tetrahedron are on the boundary of the flipped volume, by the bits of the opposite
    /// corners.
    #[inline]
    pub(super) fn outer_facets(&self) -> [u8; 4] {
        match self {
            Flip::TwoThree(..) => TetMesh::OUTER_OF_THREE,
            Flip::ThreeTwo(..) => TetMesh::OUTER_OF_TWO,
            Flip::FourFour(..) => TetMesh::OUTER_OF_FOUR,
        }
    }

    /// The edge that is removed, in ascending order, and for a 4-4 flip the end of the new edge with the smaller id, as
    /// an edge with four tetrahedra can be flipped in two planes. `None` for 2-3 flips.
    pub fn edge(&self) -> Option<[VertexId; 3]> {
        match *self {
            Flip::TwoThree(..) => None,
            Flip::ThreeTwo(_, [_, _, p, q, _]) => Some([p.min(q), p.max(q), VertexId::INFINITE]),
            Flip::FourFour(_, [v, w, p, q, _, _]) => Some([p.min(q), p.max(q), v.min(w)]),
        }
    }

    /// Does it. Returns the new tetrahedra.
    #[inline]
    pub fn perform(&self, mesh: &mut TetMesh) -> ArrayVec<TetId, 4> {
        let mut created = ArrayVec::new();
        match *self {
            Flip::TwoThree(old, vertices) => {
                let [a, b, c] = mesh.two_to_three(old, vertices);
                created.push(a);
                created.push(b);
                created.push(c);
            }
            Flip::ThreeTwo(old, vertices) => {
                let [a, b] = mesh.three_to_two(old, vertices);
                created.push(a);
                created.push(b);
            }
            Flip::FourFour(old, vertices) => created.extend(mesh.four_to_four(old, vertices)),
        }
        created
    }
}

/// What a 2-3 flip of the triangle xyz would create: vxyz with w in place of x, of y, of z.
fn around_new_edge([v, x, y, z, w]: [VertexId; 5]) -> [[VertexId; 4]; 3] {
    [[v, w, y, z], [v, x, w, z], [v, x, y, w]]
}

/// Whether there is a flip that removes the triangle opposite corner `c`, if no sign is zero: what [`flip_of_triangle`]
/// says, without a branch.
#[inline(always)]
pub(super) fn is_flippable(mesh: &TetMesh, c: Corner, negative: u8) -> bool {
    let twin = mesh.twin(c);
    let (old1, old2) = (mesh.tet(c.tet()), mesh.tet(twin.tet()));
    let not_inside = !negative & 0b111;
    let is_one = not_inside & not_inside.wrapping_sub(1) == 0;
    // If there is one, it; else any.
    let slot = FACET[c.slot()][usize::from(not_inside >> 1).min(2)];
    let (behind1, behind2) = (old1.1[slot], behind(old2, old1.0[slot]));
    let is_third = (behind1.tet() == behind2.tet()) & (mesh.vertex(behind1) == old2.0[twin.slot()]);
    is_one & ((not_inside == 0) | is_third)
}

/// The signs of c_x, c_y, c_z, of which some are known.
fn all_signs<P: PointStore>(points: &P, circuit: [VertexId; 5], mut signs: Signs) -> Signs {
    for (i, tet) in around_new_edge(circuit).into_iter().enumerate() {
        if signs.known() >> i & 1 == 0 {
            signs.set(i, -points.orient3d(tet));
        }
    }
    signs
}

/// The flip that removes the triangle xyz opposite corner `c`, between vxyz and wxzy, or `None` if there is none: the
/// union of the tetrahedra around it is not convex.
///
/// The line vw passes inside the edge opposite x of the triangle iff vwyz, which has w in place of x, is positive. If
/// it passes inside all three edges: 2-3. If it passes outside of one, that edge is reflex: 3-2, if it has three
/// tetrahedra. If it meets one edge, v, w and the edge are coplanar: 4-4, if it has four tetrahedra.
///
/// `signs` are those of the circuit's coefficients c_x, c_y, c_z, where they are known; c_x = −orient3d(v, w, y, z).
#[inline(always)]
pub fn flip_of_triangle<P: PointStore>(
    points: &P,
    mesh: &TetMesh,
    c: Corner,
    mut signs: Signs,
) -> Option<Flip> {
    let (t1, twin) = (c.tet(), mesh.twin(c));
    let (old1, old2) = (mesh.tet(t1), mesh.tet(twin.tet()));
    let slots = FACET[c.slot()];
    let (v, w) = (old1.0[c.slot()], old2.0[twin.slot()]);
    let facet = [old1.0[slots[0]], old1.0[slots[1]], old1.0[slots[2]]];
    let [x, y, z] = facet;
    let circuit = [v, x, y, z, w];
    if signs.known() != 0b111 {
        signs = all_signs(points, circuit, signs);
    }
    let not_inside = !signs.negative & 0b111;
    if not_inside == 0 {
        return Some(Flip::TwoThree([t1, twin.tet()], circuit));
    }
    if !not_inside.is_power_of_two() {
        return None;
    }
    let i = usize::from(not_inside >> 1);
    let t2 = twin.tet();
    // The edge pq that is not passed inside, and the third vertex of the triangle.
    let r = facet[i];
    let [p, q] = [facet[(i + 1) % 3], facet[(i + 2) % 3]];
    let (behind1, behind2) = (old1.1[slots[i]], behind(old2, r));
    let (t3, t4) = (behind1.tet(), behind2.tet());
    if signs.zero == 0 {
        // The vertex of the third tetrahedron that is not in the first: one tetrahedron may stand for several that are
        // outside of a copy of a region.
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
