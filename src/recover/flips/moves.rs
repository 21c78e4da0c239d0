//! The bistellar flips of a tetrahedralization: 2-3, 3-2, 4-4 (Shewchuk 2003).

use crate::mesh::{Corner, TetId, TetMesh, VertexId};
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

/// A flip that is possible: the tetrahedra to remove, and the vertices of those that take their place.
#[derive(Clone, Debug)]
pub struct Flip {
    /// Which kind.
    pub kind: FlipKind,
    /// The edge that is removed, in ascending order, and for a 4-4 flip the end of the new edge with the smaller id, as an
    /// edge with four tetrahedra can be flipped in two planes. `None` for 2-3 flips.
    pub edge: Option<[VertexId; 3]>,
    /// To be removed.
    pub old: ArrayVec<TetId, 4>,
    /// To be created, positively oriented.
    pub new: ArrayVec<[VertexId; 4], 4>,
}

/// What 2-3 flip of the triangle xyz would create: vxyz with w in place of x, of y, of z.
fn around_new_edge([v, x, y, z, w]: [VertexId; 5]) -> [[VertexId; 4]; 3] {
    [[v, w, y, z], [v, x, w, z], [v, x, y, w]]
}

/// The signs of the circuit's coefficients c_x, c_y, c_z.
#[inline]
pub fn signs<P: PointStore>(points: &P, circuit: [VertexId; 5]) -> [Sign; 3] {
    around_new_edge(circuit).map(|tet| -points.orient3d(tet))
}

/// The flip that removes the triangle xyz opposite corner `c`, between vxyz and wxzy, or `None` if there is none: the
/// union of the tetrahedra around it is not convex.
///
/// The line vw passes inside the edge opposite x of the triangle iff vwyz, which has w in place of x, is positive. If it
/// passes inside all three edges: 2-3. If it passes outside of one, that edge is reflex: 3-2, if it has three
/// tetrahedra. If it meets one edge, v, w and the edge are coplanar: 4-4, if it has four tetrahedra.
///
/// `signs` are those of the circuit's coefficients c_x, c_y, c_z, where they are known; c_x = −orient3d(v, w, y, z).
pub fn flip_of_triangle<P: PointStore>(
    points: &P,
    mesh: &TetMesh,
    c: Corner,
    signs: [Option<Sign>; 3],
) -> Option<Flip> {
    let (t1, t2) = (c.tet(), mesh.neighbor(c));
    let v = mesh.vertex(c);
    let [x, y, z] = mesh.facet(c);
    let w = mesh.apex_across(c);
    let around_new_edge = around_new_edge([v, x, y, z, w]);
    let inside =
        [0, 1, 2].map(|i| signs[i].map_or_else(|| points.orient3d(around_new_edge[i]), |s| -s));
    let positive: ArrayVec<[VertexId; 4], 4> = (0..3)
        .filter(|&i| inside[i].is_positive())
        .map(|i| around_new_edge[i])
        .collect();
    let old = |tets: &[TetId]| tets.iter().copied().collect();
    if positive.len() == 3 {
        return Some(Flip {
            kind: FlipKind::TwoThree,
            edge: None,
            old: old(&[t1, t2]),
            new: positive,
        });
    }
    if positive.len() != 2 {
        return None;
    }
    // The edge pq that is not passed inside, and the third vertex of the triangle.
    let i = (0..3)
        .find(|&i| !inside[i].is_positive())
        .expect("two of three are positive");
    let r = [x, y, z][i];
    let [p, q] = [[y, z], [z, x], [x, y]][i];
    let (behind1, behind2) = (
        mesh.twin(mesh.corner_of(t1, r)),
        mesh.twin(mesh.corner_of(t2, r)),
    );
    if inside[i] == Sign::Negative {
        // vpqr, wpqr and the third tetrahedron vwpq.
        return (behind1.tet() == behind2.tet()).then(|| Flip {
            kind: FlipKind::ThreeTwo,
            edge: Some([p.min(q), p.max(q), VertexId::INFINITE]),
            old: old(&[t1, t2, behind1.tet()]),
            new: positive,
        });
    }
    // vpqr, wpqr, and on the other side of the plane of v, w, p, q: vpqu and wpqu.
    let u = mesh.vertex(behind1);
    let (t3, t4) = (behind1.tet(), behind2.tet());
    let four_around_edge = mesh.vertex(behind2) == u && mesh.neighbor(mesh.corner_of(t3, v)) == t4;
    (four_around_edge && !u.is_infinite()).then(|| Flip {
        kind: FlipKind::FourFour,
        edge: Some([p.min(q), p.max(q), v.min(w)]),
        old: old(&[t1, t2, t3, t4]),
        // vpqr is positive, so vqpu is; w takes the place of p, then of q.
        new: ArrayVec::from([positive[0], positive[1], [v, q, w, u], [v, w, p, u]]),
    })
}
