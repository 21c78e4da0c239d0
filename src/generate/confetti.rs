//! Polygons that float in a box: each in a cell of its own, in a random plane, and exactly planar.

use super::draft::Draft;
use super::draw::Draw;
use crate::exchange::Plc;

/// The corners of polygons, as combinations of two vectors with small whole numbers: with multiples of 2⁻²⁰ for vectors
/// they are exactly planar. Where there is a second polygon, it is a hole.
const SHAPES: [&[&[[i8; 2]]]; 6] = [
    &[&[[0, 0], [4, 1], [1, 4]]],
    &[&[[0, 0], [3, 0], [4, 4], [1, 3]]],
    &[&[[0, 0], [4, 0], [4, 1], [1, 1], [1, 4], [0, 4]]],
    &[&[[1, 0], [3, 0], [4, 2], [3, 4], [1, 4], [0, 2]]],
    &[&[[0, 0], [4, 0], [2, 1], [4, 4], [1, 2]]],
    &[&[[0, 0], [4, 0], [4, 4], [0, 4]], &[[1, 1], [3, 1], [2, 3]]],
];

/// One facet, segment or vertex in each cell: of twenty, one is a segment and one is a vertex.
pub(super) fn confetti(draw: &mut Draw, size: usize) -> Plc {
    let count = size.saturating_sub(6).max(1) * 20 / 18;
    let row = (1..).find(|n| n * n * n >= count).expect("cubes grow");
    let mut draft = Draft::default();
    draft.block([-0.25; 3], [row as f64 + 0.25; 3]);
    for i in 0..count {
        let cell = [i / row / row, i / row % row, i % row];
        let middle = cell.map(|k| k as f64 + 0.5);
        match draw.below(20) {
            0 => {
                draft.vertex(middle);
            }
            1 => {
                let away: [f64; 3] = std::array::from_fn(|_| draw.between(-0.45, 0.45));
                let end = |sign: f64| [0, 1, 2].map(|k| middle[k] + sign * away[k]);
                if away != [0.0; 3] {
                    draft.segment([end(1.0), end(-1.0)]);
                }
            }
            _ => polygon(&mut draft, draw, middle),
        }
    }
    draft.finish()
}

/// A polygon around a point, within a cube of side 1.
fn polygon(draft: &mut Draft, draw: &mut Draw, middle: [f64; 3]) {
    let mut vector = || -> [f64; 3] { std::array::from_fn(|_| draw.between(-0.11, 0.11)) };
    let (u, v) = loop {
        let (u, v) = (vector(), vector());
        // Products of numbers of 17 bits are exact.
        if (0..3).any(|k| u[k] * v[(k + 1) % 3] != u[(k + 1) % 3] * v[k]) {
            break (u, v);
        }
    };
    let shape = draw.pick(&SHAPES);
    let point = |s: f64, t: f64| [0, 1, 2].map(|k| middle[k] + (s - 2.0) * u[k] + (t - 2.0) * v[k]);
    let corners = |polygon: &&[[i8; 2]]| {
        let corners = polygon.iter().map(|&[s, t]| point(s.into(), t.into()));
        corners.collect()
    };
    let polygons: Vec<Vec<[f64; 3]>> = shape.iter().map(corners).collect();
    let holes = if shape.len() > 1 {
        vec![point(2.0, 2.0)]
    } else {
        Vec::new()
    };
    draft.facet(&polygons, &holes);
}
