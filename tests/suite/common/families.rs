//! Random PLCs full of ties.

use super::{box_facets, plc_of_points};
use proptest::prelude::*;
use tetflip::exchange::{Facet, Plc};
use tetflip::mesh::VertexId;

/// Lattice points and one rectangle with corners on the lattice, in an axis plane or a tilted one.
pub fn lattice_with_rectangle() -> impl Strategy<Value = Plc> {
    let points = prop::collection::btree_set([-3i32..4, -3..4, -3..4], 3..30);
    (points, 0usize..5, 1i32..4, 1i32..4).prop_map(|(points, kind, w, h)| {
        // Corners ±u ± v.
        let (u, v): ([i32; 3], [i32; 3]) = match kind {
            0 => ([w, 0, 0], [0, h, 0]),
            1 => ([w, 0, 0], [0, h, h]),
            2 => ([w, w, 0], [0, 0, h]),
            3 => ([w, w, 0], [h, -h, h]),
            _ => ([2 * w, w, 0], [-1, 2, 1]),
        };
        let corner = |i: i32, j: i32| [0, 1, 2].map(|k: usize| i * u[k] + j * v[k]);
        let corners = [corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)];
        let mut all: Vec<[i32; 3]> = corners.to_vec();
        all.extend(points.into_iter().filter(|p| !corners.contains(p)));
        let mut plc = plc_of_points(all.into_iter().map(|p| p.map(f64::from)).collect());
        plc.facets.push(facet(&[0, 1, 2, 3]));
        plc
    })
}

/// Two rectangles in axis planes that cross in a common segment, split along it, among lattice points.
pub fn crossing_planes() -> impl Strategy<Value = Plc> {
    let points = prop::collection::btree_set([-3i32..4, -3..4, -3..4], 0..30);
    (points, 1i32..4, 1i32..4, 1i32..4).prop_map(|(points, a, b, c)| {
        let mut all: Vec<[i32; 3]> = vec![
            [-a, 0, 0],
            [a, 0, 0], // the common segment
            [a, b, 0],
            [-a, b, 0],
            [a, -b, 0],
            [-a, -b, 0], // z = 0
            [a, 0, c],
            [-a, 0, c],
            [a, 0, -c],
            [-a, 0, -c], // y = 0
        ];
        let on_a_plane = |p: &[i32; 3]| {
            (p[2] == 0 && p[1].abs() <= b || p[1] == 0 && p[2].abs() <= c) && p[0].abs() <= a
        };
        all.extend(points.into_iter().filter(|p| !on_a_plane(p)));
        let mut plc = plc_of_points(all.into_iter().map(|p| p.map(f64::from)).collect());
        for quad in [[0, 1, 2, 3], [0, 1, 4, 5], [0, 1, 6, 7], [0, 1, 8, 9]] {
            plc.facets.push(facet(&quad));
        }
        plc
    })
}

/// A grid of boxes with walls between them, some walls left out, and points inside.
pub fn walls() -> impl Strategy<Value = Plc> {
    let points = prop::collection::btree_set([0i32..13, 0..9, 0..5], 0..25);
    (points, prop::collection::vec(any::<bool>(), 36), -2i32..3).prop_map(|(points, present, e)| {
        let scale = 2f64.powi(e * 100);
        let mut plc = Plc::default();
        box_facets(&mut plc, [3, 2, 1], 4.0 * scale, &present);
        for p in points.into_iter().filter(|p| p.iter().all(|x| x % 4 != 0)) {
            plc.vertices.push(p.map(|x| f64::from(x) * scale));
        }
        plc
    })
}

/// Points on a sphere around the origin, all cospherical, and a square through the centre whose corners are among them.
pub fn sphere() -> impl Strategy<Value = Plc> {
    // All integer points with |p|² = 50 but those of the square in the plane z = 0.
    let on_sphere = || {
        let range = -7i32..8;
        let all = range.clone().flat_map(move |x| {
            range
                .clone()
                .flat_map(move |y| (-7..8).map(move |z| [x, y, z]))
        });
        all.filter(|p| p.iter().map(|x| x * x).sum::<i32>() == 50 && p[2] != 0)
            .collect::<Vec<_>>()
    };
    let n = on_sphere().len();
    prop::collection::vec(any::<bool>(), n).prop_map(move |chosen| {
        let mut all = vec![[5, 5, 0], [-5, 5, 0], [-5, -5, 0], [5, -5, 0]];
        all.extend(
            on_sphere()
                .into_iter()
                .zip(&chosen)
                .filter(|&(_, &c)| c)
                .map(|(p, _)| p),
        );
        let mut plc = plc_of_points(
            all.into_iter()
                .map(|p: [i32; 3]| p.map(f64::from))
                .collect(),
        );
        plc.facets.push(facet(&[0, 1, 2, 3]));
        plc
    })
}

/// Upright rectangles that float above and below a large one, inserted before it, and points between them: the cavities
/// of the large one have triangles on the upright ones that are not Delaunay for the cavity's vertices.
pub fn fins() -> impl Strategy<Value = Plc> {
    let fin = (1i32..5, 1i32..4, any::<bool>());
    let fins = prop::collection::vec(fin, 5);
    let points = prop::collection::btree_set([-5i32..6, -5..6, -4..5], 5..60);
    (fins, points).prop_map(|(fins, points)| {
        let mut all: Vec<[i32; 3]> = vec![[-7, -7, 0], [7, -7, 0], [7, 7, 0], [-7, 7, 0]];
        let mut facets = Vec::new();
        for (i, (half, height, above)) in fins.into_iter().enumerate() {
            let (x, n) = (2 * i as i32 - 4, all.len() as u32);
            let [near, far] = [1, 1 + height].map(|z| if above { z } else { -z });
            all.extend([
                [x, -half, near],
                [x, half, near],
                [x, half, far],
                [x, -half, far],
            ]);
            facets.push(facet(&[n, n + 1, n + 2, n + 3]));
        }
        facets.push(facet(&[0, 1, 2, 3]));
        // Other points have odd x, off the planes of the fins.
        all.extend(points.into_iter().filter(|p| p[0] % 2 != 0 && p[2] != 0));
        let mut plc = plc_of_points(all.into_iter().map(|p| p.map(f64::from)).collect());
        plc.facets = facets;
        plc
    })
}

/// A facet of one polygon.
pub fn facet(vertices: &[u32]) -> Facet {
    Facet {
        polygons: vec![vertices.iter().map(|&v| VertexId(v)).collect()],
        ..Facet::default()
    }
}
