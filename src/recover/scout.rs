//! What lies between two vertices a and b of a tetrahedralization: the edge ab, another vertex, or crossing tetrahedra.

use crate::mesh::{TetId, TetMesh, VertexId};
use crate::predicate::PointStore;
use rustc_hash::FxHashSet;

/// What one finds on leaving a in the direction of b.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Scouted {
    /// The edge ab is in the mesh; a tetrahedron that has it.
    Edge(TetId),
    /// The ray runs along an edge to this vertex, which lies between a and b.
    Vertex(VertexId),
    /// The ray enters this tetrahedron, and leaves it by the facet opposite a.
    Crosses(TetId),
}

/// Looks from a towards b, starting in `t`, a finite tetrahedron at a. A visibility walk within the star of a; the mesh
/// must be Delaunay, so that it cannot cycle.
pub fn scout<P: PointStore>(
    points: &P,
    mesh: &TetMesh,
    mut t: TetId,
    a: VertexId,
    b: VertexId,
) -> Scouted {
    'walk: loop {
        let v = mesh.vertices(t);
        if v.contains(&b) {
            return Scouted::Edge(t);
        }
        let at_a = mesh.slot_of(t, a).expect("the walk stays in the star of a");
        let mut along = [true; 4];
        for slot in (0..4).filter(|&slot| slot != at_a) {
            let mut moved = v;
            moved[slot] = b;
            let side = points.orient3d(moved);
            if side.is_negative() {
                t = mesh.neighbor(t.corner(slot));
                continue 'walk;
            }
            along[slot] = side.is_zero();
        }
        let off: Vec<usize> = (0..4)
            .filter(|&slot| slot != at_a && !along[slot])
            .collect();
        return match off[..] {
            [slot] => Scouted::Vertex(v[slot]),
            _ => Scouted::Crosses(t),
        };
    }
}

/// The finite tetrahedra that the segment ab passes through, from the star of a on. Tetrahedra that it touches only
/// along an edge or a facet may be missing: for choosing a reference point, not for deciding.
pub fn crossed_by<P: PointStore>(
    points: &P,
    mesh: &TetMesh,
    first: TetId,
    a: VertexId,
    b: VertexId,
) -> Vec<TetId> {
    let mut crossed = vec![first];
    let mut seen: FxHashSet<TetId> = crossed.iter().copied().collect();
    let mut next = 0;
    while let Some(&t) = crossed.get(next) {
        next += 1;
        for slot in 0..4 {
            let c = t.corner(slot);
            let n = mesh.neighbor(c);
            if !seen.contains(&n) && !mesh.is_ghost(n) && crosses_facet(points, a, b, mesh.facet(c))
            {
                seen.insert(n);
                crossed.push(n);
            }
        }
    }
    crossed
}

/// Whether the open segment ab meets the closed triangle pqr in one point.
pub fn crosses_facet<P: PointStore>(
    points: &P,
    a: VertexId,
    b: VertexId,
    facet: [VertexId; 3],
) -> bool {
    let [p, q, r] = facet;
    if facet.contains(&a) || facet.contains(&b) {
        return false;
    }
    let sides = points.orient3d([a, p, q, r]) * points.orient3d([b, p, q, r]);
    if !sides.is_negative() {
        return false;
    }
    let turns = [[p, q], [q, r], [r, p]].map(|[x, y]| points.orient3d([a, b, x, y]));
    turns.iter().all(|s| !s.is_negative()) || turns.iter().all(|s| !s.is_positive())
}
