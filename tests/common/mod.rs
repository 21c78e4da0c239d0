//! What several test files share.
#![allow(dead_code)]

use tetflip::delaunay::{Delaunay, delaunay};
use tetflip::mesh::{TetMesh, VertexId};
use tetflip::predicate::{DoublePoints, PointStore};

/// All vertex ids of a store.
pub fn all_vertices(points: &DoublePoints) -> Vec<VertexId> {
    (0..points.len()).map(VertexId::new).collect()
}

/// The finite tetrahedra as sets of vertices, in a canonical order.
pub fn sorted_tets(mesh: &TetMesh) -> Vec<[VertexId; 4]> {
    let mut tets: Vec<[VertexId; 4]> = mesh
        .finite()
        .map(|t| {
            let mut v = mesh.vertices(t);
            v.sort_unstable();
            v
        })
        .collect();
    tets.sort_unstable();
    tets
}

/// The vertices of the finite tetrahedra, sorted.
pub fn used_vertices(mesh: &TetMesh) -> Vec<VertexId> {
    let mut used: Vec<VertexId> = mesh.finite().flat_map(|t| mesh.vertices(t)).collect();
    used.sort_unstable();
    used.dedup();
    used
}

/// The Delaunay tetrahedralization with the vertices inserted exactly in the given order, after the first four that
/// span space.
pub fn delaunay_in_order(points: &DoublePoints, order: &[VertexId]) -> Delaunay {
    let mut seed: Vec<VertexId> = Vec::new();
    for &v in order {
        let spans = match *seed.as_slice() {
            [] | [_] => true,
            [a, b] => !points.collinear([a, b, v]),
            [a, b, c] => !points.orient3d([a, b, c, v]).is_zero(),
            _ => break,
        };
        if spans {
            seed.push(v);
        }
    }
    let mut result = delaunay(points, &seed).expect("four vertices that span space");
    for v in order.iter().filter(|v| !seed.contains(v)) {
        result.insert(points, *v);
    }
    result
}
