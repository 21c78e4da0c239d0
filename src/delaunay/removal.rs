//! Vertex removal: what fills the hole that a vertex leaves in a Delaunay tetrahedralization (Devillers 1999).
//!
//! The star of v is replaced by those tetrahedra of the Delaunay tetrahedralization of v's neighbours that lie in the
//! star. They are Delaunay among all vertices: every tetrahedron of the hole in the tetrahedralization without v has
//! its vertices among the neighbours, so with perturbed weights, where there is one tetrahedralization only, it is
//! among those of the neighbours. Ghosts, where v is on the convex hull, are treated like the others.

use super::delaunay;
use crate::mesh::{Corner, TetId, TetMesh, VertexId, canonical_face};
use crate::predicate::PointStore;
use rustc_hash::{FxHashMap, FxHashSet};

/// The tetrahedra, ghosts included, that replace `star`, all those at v, once v is removed; for [`TetMesh::replace`].
/// `star` is in order of id.
/// `None` if the other vertices would not span space. Expected O(k log k) for k neighbours.
pub fn filling<P: PointStore>(
    points: &P,
    mesh: &TetMesh,
    star: &[TetId],
    v: VertexId,
) -> Option<Vec<[VertexId; 4]>> {
    let neighbours = star.iter().flat_map(|&t| mesh.vertices(t));
    let mut link: Vec<VertexId> = neighbours.filter(|&w| w != v && !w.is_infinite()).collect();
    link.sort_unstable();
    link.dedup();
    let local = delaunay(points, &link).ok()?.mesh;
    let mut inside: FxHashMap<[VertexId; 3], Corner> = FxHashMap::default();
    for t in local.all() {
        for slot in 0..4 {
            let c = t.corner(slot);
            inside.insert(canonical_face(local.facet(c)), c);
        }
    }
    // The facets of the hole, as its own tetrahedra see them.
    let border: FxHashSet<[VertexId; 3]> = star
        .iter()
        .map(|&t| canonical_face(mesh.facet(mesh.corner_of(t, v))))
        .collect();
    let mut open = Vec::new();
    let mut taken = FxHashSet::default();
    for &t in star {
        let c = inside.get(&canonical_face(mesh.facet(mesh.corner_of(t, v))))?;
        if taken.insert(c.tet()) {
            open.push(c.tet());
        }
    }
    let mut filling = Vec::new();
    while let Some(t) = open.pop() {
        filling.push(local.vertices(t));
        for c in (0..4).map(|slot| t.corner(slot)) {
            if !border.contains(&canonical_face(local.facet(c))) && taken.insert(local.neighbor(c))
            {
                open.push(local.neighbor(c));
            }
        }
    }
    mesh.can_replace(star, &filling).then_some(filling)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::delaunay::delaunay;
    use crate::mesh::Incidence;
    use crate::predicate::DoublePoints;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(300))]

        /// On lattices, where everything is cospherical, and hull vertices are everywhere.
        #[test]
        fn removal_ends_in_the_tetrahedralization_of_the_others(
            places in prop::collection::btree_set([0i32..4, 0..4, 0..3], 8..30),
        ) {
            let points: Vec<[f64; 3]> = places.into_iter().map(|p| p.map(f64::from)).collect();
            let n = points.len();
            let points = DoublePoints::new(points);
            let all: Vec<VertexId> = (0..n).map(VertexId::new).collect();
            let Ok(whole) = delaunay(&points, &all) else { return Ok(()) };
            let incidence = Incidence::new(&whole.mesh, n);
            for &v in &all {
                let rest: Vec<VertexId> = all.iter().copied().filter(|&w| w != v).collect();
                let Ok(expected) = delaunay(&points, &rest) else { continue };
                let mut mesh = whole.mesh.clone();
                let mut star = incidence.star(&mesh, v);
                star.sort_unstable();
                // The neighbours of a vertex may lie on one plane.
                let Some(filling) = filling(&points, &mesh, &star, v) else { continue };
                mesh.replace(&star, &filling);
                prop_assert_eq!(mesh.check(), Ok(()));
                prop_assert_eq!(mesh.sorted_tets(), expected.mesh.sorted_tets());
            }
        }
    }
}
