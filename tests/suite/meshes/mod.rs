//! Small meshes and PLCs for the tests of the verifier.

#![allow(missing_docs, dead_code)]

use tetflip::exchange::ExportedMesh;
use tetflip::exchange::{Facet, Plc};
use tetflip::mesh::VertexId;
use tetflip::verify::{Domain, Verdict, VerifyOptions, verify};

pub fn ids<const N: usize>(v: [u32; N]) -> [VertexId; N] {
    v.map(VertexId)
}

/// A facet with one polygon.
pub fn facet(polygon: &[u32]) -> Facet {
    Facet {
        polygons: vec![polygon.iter().map(|&v| VertexId(v)).collect()],
        ..Facet::default()
    }
}

pub fn plc(vertices: &[[f64; 3]], facets: &[&[u32]]) -> Plc {
    Plc {
        vertices: vertices.to_vec(),
        facets: facets.iter().map(|f| facet(f)).collect(),
        ..Plc::default()
    }
}

/// The mesh with all tetrahedra turned to be positive.
pub fn mesh(vertices: &[[f64; 3]], tets: &[[u32; 4]]) -> ExportedMesh {
    let turned = |t: &[u32; 4]| {
        let [a, b, c, d] = t.map(|v| vertices[v as usize]);
        let [u, v, w] = [b, c, d].map(|p| [p[0] - a[0], p[1] - a[1], p[2] - a[2]]);
        let det = u[0] * (v[1] * w[2] - v[2] * w[1])
            + u[1] * (v[2] * w[0] - v[0] * w[2])
            + u[2] * (v[0] * w[1] - v[1] * w[0]);
        let [a, b, c, d] = ids(*t);
        if det > 0.0 {
            [a, b, c, d]
        } else {
            [a, b, d, c]
        }
    };
    ExportedMesh {
        vertices: vertices.to_vec(),
        tets: tets.iter().map(turned).collect(),
        ..ExportedMesh::default()
    }
}

pub fn run(plc: &Plc, mesh: &ExportedMesh) -> Verdict {
    verify(plc, mesh, VerifyOptions::default())
}

pub fn run_as(domain: Domain, plc: &Plc, mesh: &ExportedMesh) -> Verdict {
    let options = VerifyOptions {
        domain,
        ..VerifyOptions::default()
    };
    verify(plc, mesh, options)
}

#[track_caller]
pub fn assert_kinds(verdict: &Verdict, kinds: &[&str]) {
    let found: Vec<&str> = verdict.totals.keys().copied().collect();
    assert_eq!(found, kinds, "{verdict}");
    assert_eq!(verdict.is_ok(), kinds.is_empty());
}

/// Vertex x + 2y + 4z of the unit cube.
pub fn cube_vertices() -> Vec<[f64; 3]> {
    (0..8u8)
        .map(|i| [i & 1, i >> 1 & 1, i >> 2 & 1].map(f64::from))
        .collect()
}

pub const CUBE: [&[u32]; 6] = [
    &[0, 1, 3, 2],
    &[4, 5, 7, 6],
    &[0, 1, 5, 4],
    &[2, 3, 7, 6],
    &[0, 2, 6, 4],
    &[1, 3, 7, 5],
];
pub const SIX: [[u32; 4]; 6] = [
    [0, 1, 3, 7],
    [0, 1, 5, 7],
    [0, 2, 3, 7],
    [0, 2, 6, 7],
    [0, 4, 5, 7],
    [0, 4, 6, 7],
];
pub const FIVE: [[u32; 4]; 5] = [
    [0, 3, 5, 6],
    [1, 0, 3, 5],
    [2, 0, 3, 6],
    [4, 0, 5, 6],
    [7, 3, 5, 6],
];

pub fn cube() -> (Plc, ExportedMesh) {
    (plc(&cube_vertices(), &CUBE), mesh(&cube_vertices(), &SIX))
}

/// A triangle abc with apexes at ±h: vertices a, b, c, bottom, top.
pub fn bipyramid(h: f64) -> Vec<[f64; 3]> {
    vec![
        [2., 0., 0.],
        [-1., 2., 0.],
        [-1., -2., 0.],
        [0., 0., -h],
        [0., 0., h],
    ]
}

pub const BIPYRAMID: [&[u32]; 6] = [
    &[0, 1, 3],
    &[1, 2, 3],
    &[2, 0, 3],
    &[0, 1, 4],
    &[1, 2, 4],
    &[2, 0, 4],
];

pub const TWO: [[u32; 4]; 2] = [[0, 1, 2, 3], [0, 1, 2, 4]];

pub const THREE: [[u32; 4]; 3] = [[0, 1, 3, 4], [1, 2, 3, 4], [2, 0, 3, 4]];

/// The top of the cube as two triangles, with a diagonal that [`FIVE`] has or has not.
pub fn split_top(diagonal: [u32; 2]) -> Plc {
    let mut plc = plc(&cube_vertices(), &CUBE);
    let [a, b] = diagonal;
    let rest: Vec<u32> = [4, 5, 6, 7]
        .into_iter()
        .filter(|v| !diagonal.contains(v))
        .collect();
    plc.facets[1] = facet(&[a, b, rest[0]]);
    plc.facets.push(facet(&[a, b, rest[1]]));
    plc
}

/// A row of two unit cubes along x, with the wall between them; vertex x + 3y + 6z.
pub fn two_cubes(meshed: &[u32]) -> (Plc, ExportedMesh) {
    let vertices: Vec<[f64; 3]> = (0..12u8)
        .map(|i| [i % 3, i / 3 % 2, i / 6].map(f64::from))
        .collect();
    let at = |cube: u32, v: u32| cube + (v & 1) + 3 * (v >> 1 & 1) + 6 * (v >> 2);
    let mut plc = plc(&vertices, &[]);
    for cube in 0..2 {
        for (i, f) in CUBE.iter().enumerate() {
            if (cube, i) != (1, 4) {
                plc.facets
                    .push(facet(&f.iter().map(|&v| at(cube, v)).collect::<Vec<_>>()));
            }
        }
    }
    let tets: Vec<_> = meshed
        .iter()
        .flat_map(|&c| SIX.map(|t| t.map(|v| at(c, v))))
        .collect();
    (plc, mesh(&vertices, &tets))
}

/// 3×3×3 cubes with facets around all of them and around the middle one, which is meshed or not.
pub fn nested(middle: bool) -> (Plc, ExportedMesh) {
    let number = |x: u32, y: u32, z: u32| x + 4 * y + 16 * z;
    let vertices: Vec<[f64; 3]> = (0..64u8)
        .map(|i| [i % 4, i / 4 % 4, i / 16].map(f64::from))
        .collect();
    let corner = |low: u32, side: u32, v: u32| {
        let [x, y, z] = [v & 1, v >> 1 & 1, v >> 2].map(|k| low + side * k);
        number(x, y, z)
    };
    let mut plc = plc(&vertices, &[]);
    for (low, side) in [(0, 3), (1, 1)] {
        plc.facets.extend(
            CUBE.map(|f| facet(&f.iter().map(|&v| corner(low, side, v)).collect::<Vec<_>>())),
        );
    }
    let cells = (0..27u32)
        .filter(|&c| middle || c != 13)
        .map(|c| (c % 3, c / 3 % 3, c / 9));
    let tets: Vec<_> = cells
        .flat_map(|(x, y, z)| {
            SIX.map(|t| t.map(|v| number(x + (v & 1), y + (v >> 1 & 1), z + (v >> 2))))
        })
        .collect();
    (plc, mesh(&vertices, &tets))
}
