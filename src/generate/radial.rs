//! Surfaces that are seen whole from the origin: spheres and stars. They have no holes and do not meet themselves,
//! because their projections to the unit sphere are triangulations of it.

use super::draft::{Draft, along};
use super::draw::Draw;
use crate::exchange::Plc;

/// A sphere: the faces of an octahedron divided evenly, and all points moved to distance 1, rounded; then turned about
/// the origin. All vertices are cospherical up to rounding.
pub(super) fn sphere(draw: &mut Draw, size: usize) -> Plc {
    let n = ((size as f64 / 8.0).sqrt().round() as usize).max(1);
    let axes = draw.rotation();
    let mut draft = Draft::default();
    for triangle in octahedron(n) {
        draft.polygon(&triangle.map(normal));
    }
    draft.map(|p| along(&axes, p));
    draft.finish()
}

/// A spike of random length on every triangle of a divided octahedron, whose vertices are at random distances, too.
pub(super) fn star(draw: &mut Draw, size: usize) -> Plc {
    let n = ((size as f64 / 24.0).sqrt().round() as usize).max(1);
    let mut draft = Draft::default();
    let width = 1.0 / n as f64;
    let mut radii = rustc_hash::FxHashMap::default();
    for triangle in octahedron(n) {
        let corners = triangle.map(|p| {
            let radius = radii
                .entry(p)
                .or_insert_with(|| draw.between(1.0 - width / 4.0, 1.0));
            normal(p).map(|x| *radius * x)
        });
        let weights = [(); 3].map(|()| draw.between(0.25, 1.0));
        let total: f64 = weights.iter().sum();
        let towards: [f64; 3] =
            std::array::from_fn(|k| (0..3).map(|i| weights[i] / total * corners[i][k]).sum());
        let length = draw.between(1.0 + width, 1.0 + 6.0 * width);
        let tip = towards.map(|x| length * x);
        for i in 0..3 {
            draft.polygon(&[corners[i], corners[(i + 1) % 3], tip]);
        }
    }
    draft.finish()
}

/// The 8n² triangles of an octahedron of radius n whose edges are divided into n parts, counterclockwise from outside.
fn octahedron(n: usize) -> impl Iterator<Item = [[i64; 3]; 3]> {
    let n = n as i64;
    (0..8).flat_map(move |octant: i64| {
        let signs = [0, 1, 2].map(|k| 1 - 2 * (octant >> k & 1));
        let at = move |i: i64, j: i64| [i * signs[0], j * signs[1], (n - i - j) * signs[2]];
        let rows = (0..n).flat_map(move |i| (0..n - i).map(move |j| (i, j)));
        rows.flat_map(move |(i, j)| {
            let up = [at(i, j), at(i + 1, j), at(i, j + 1)];
            let down = [at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            std::iter::once(up).chain((i + j + 2 <= n).then_some(down))
        })
        .map(move |[a, b, c]| match signs.iter().product::<i64>() {
            1 => [a, b, c],
            _ => [a, c, b],
        })
    })
}

/// The point in this direction at distance 1, rounded.
fn normal(p: [i64; 3]) -> [f64; 3] {
    let length = (p.iter().map(|x| x * x).sum::<i64>() as f64).sqrt();
    p.map(|x| x as f64 / length)
}
