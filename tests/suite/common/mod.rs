//! What several test files share.
#![allow(dead_code)]

pub mod almost_flat;
pub mod families;

use tetflip::delaunay::{Delaunay, delaunay};
use tetflip::exchange::{Facet, Plc};
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

/// No progress is reported.
pub fn quiet(_done: usize) {}

/// A PLC of points alone.
pub fn plc_of_points(vertices: Vec<[f64; 3]>) -> Plc {
    Plc {
        vertices,
        ..Plc::default()
    }
}

/// A grid of n[0]×n[1]×n[2] boxes of the given side: the outer squares of every box, and of the inner ones those that
/// `present` names, in turn.
pub fn box_facets(plc: &mut Plc, n: [u32; 3], side: f64, present: &[bool]) {
    let id = |p: [u32; 3]| VertexId((p[0] * (n[1] + 1) + p[1]) * (n[2] + 1) + p[2]);
    for x in 0..=n[0] {
        for y in 0..=n[1] {
            for z in 0..=n[2] {
                plc.vertices.push([x, y, z].map(|c| f64::from(c) * side));
            }
        }
    }
    let mut inner = present.iter().cycle();
    for axis in 0..3 {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        for level in 0..=n[axis] {
            for i in 0..n[u] {
                for j in 0..n[v] {
                    let outer = level == 0 || level == n[axis];
                    if !outer && !inner.next().expect("a cycle") {
                        continue;
                    }
                    let corner = |di: u32, dj: u32| {
                        let mut p = [0; 3];
                        (p[axis], p[u], p[v]) = (level, i + di, j + dj);
                        id(p)
                    };
                    plc.facets.push(Facet {
                        polygons: vec![vec![
                            corner(0, 0),
                            corner(1, 0),
                            corner(1, 1),
                            corner(0, 1),
                        ]],
                        ..Facet::default()
                    });
                }
            }
        }
    }
}
