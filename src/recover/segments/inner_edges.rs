//! Edges inside a set of tetrahedra: those whose tetrahedra are all in it. When a conflict zone is replaced they
//! vanish, and all other edges stay.
//!
//! An edge is found by turning around it, once: from the tetrahedron with the smallest id, and not at all if the set
//! ends next to that, or if nobody asks for it. Time linear in the set, but for the turns, which mostly end after a
//! step or two.

use crate::mesh::{TetId, TetMesh, VertexId};

/// The slots of the edges of a tetrahedron, each with the two others.
static EDGES: [[usize; 4]; 6] = [
    [0, 1, 2, 3],
    [0, 2, 1, 3],
    [0, 3, 1, 2],
    [1, 2, 0, 3],
    [1, 3, 0, 2],
    [2, 3, 0, 1],
];

/// Calls `visit` for each finite edge that is `wanted` and all of whose tetrahedra are in a set, once, in an order that
/// depends on the order of the set. An edge is passed over where `narrow`, called with what it gave for the tetrahedron
/// before (`start` for the first), gives `None` for one of its tetrahedra.
pub(super) fn inner_edges<S: Copy>(
    mesh: &TetMesh,
    set: &[TetId],
    is_in: impl Fn(TetId) -> bool,
    wanted: impl Fn([VertexId; 2]) -> bool,
    start: S,
    narrow: impl Fn(S, TetId) -> Option<S>,
    mut visit: impl FnMut([VertexId; 2], S),
) {
    for &t in set {
        let vertices = mesh.vertices(t);
        // Bit by bit the facets behind which the set goes on.
        let mut goes_on = 0;
        for slot in 0..4 {
            let n = mesh.neighbor(t.corner(slot));
            goes_on |= u32::from(n > t && is_in(n)) << slot;
        }
        if goes_on.count_ones() < 2 {
            continue;
        }
        for &[i, j, k, l] in &EDGES {
            if goes_on >> k & goes_on >> l & 1 == 0 {
                continue;
            }
            let edge = [vertices[i], vertices[j]];
            if edge[0].is_infinite() || edge[1].is_infinite() || !wanted(edge) {
                continue;
            }
            let mut state = narrow(start, t);
            let mut exit = t.corner(k);
            let mut behind = vertices[l];
            while let Some(s) = state {
                let across = mesh.twin(exit);
                let n = across.tet();
                if n == t {
                    visit(edge, s);
                    break;
                }
                if n < t || !is_in(n) {
                    break;
                }
                state = narrow(s, n);
                exit = mesh.corner_of(n, behind);
                behind = mesh.vertex(across);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::delaunay::delaunay;
    use crate::predicate::{DoublePoints, GrowingStore};
    use rustc_hash::FxHashSet;

    /// The edges inside a conflict zone are those that are gone after the insertion.
    #[test]
    fn inner_edges_vanish() {
        let coordinate = |i: u32, k: u32| f64::from((i * 7919 + k * 104_729 + i * i * k) % 97);
        let vertices: Vec<[f64; 3]> = (0..60)
            .map(|i| [1, 2, 3].map(|k| coordinate(i, k)))
            .collect();
        let mut points = DoublePoints::new(vertices);
        let all: Vec<VertexId> = (0..60).map(VertexId::new).collect();
        let mut delaunay = delaunay(&points, &all).expect("these points span space");
        let edges = |mesh: &TetMesh| -> FxHashSet<[VertexId; 2]> {
            let tets = mesh.finite().map(|t| mesh.vertices(t));
            let pairs = tets.flat_map(|v| EDGES.map(|[i, j, ..]| [v[i].min(v[j]), v[i].max(v[j])]));
            pairs.collect()
        };
        for i in 0..20u32 {
            let before = edges(&delaunay.mesh);
            let v = points.push([1, 2, 3].map(|k| coordinate(i + 100, k) + 0.25));
            let start = delaunay.locate(&points, v);
            delaunay.find_conflicts(&points, v, start);
            let zone = delaunay.conflicts();
            let mut inner = FxHashSet::default();
            inner_edges(
                &delaunay.mesh,
                zone,
                |t| zone.contains(&t),
                |_| true,
                (),
                |(), _| Some(()),
                |[a, b], ()| assert!(inner.insert([a.min(b), a.max(b)]), "found once"),
            );
            delaunay.replace_conflicts(v);
            let after = edges(&delaunay.mesh);
            let gone: FxHashSet<[VertexId; 2]> = before.difference(&after).copied().collect();
            assert!(!gone.is_empty() || inner.is_empty());
            assert_eq!(inner, gone);
        }
    }
}
