//! Small angles and short distances: pages of a book that meet in its spine, and a pile of needles.

use super::draft::Draft;
use super::draw::{Draw, turn};
use crate::exchange::Plc;

/// A book in a box: upright pages around one edge, whose angles differ by factors of up to 1024; rectangles of random
/// lengths, and triangles.
pub(super) fn fan(draw: &mut Draw, size: usize) -> Plc {
    let pages = size.saturating_sub(6).max(2);
    let mut draft = Draft::default();
    draft.block([-1.5, -1.5, -0.5], [1.5, 1.5, 1.5]);
    let gaps: Vec<f64> = (0..pages)
        .map(|_| 2f64.powi(-(draw.below(11) as i32)))
        .collect();
    let around: f64 = gaps.iter().sum();
    let mut angle = 0.0;
    for gap in gaps {
        // Directions are at equal distances on the square |x| + |y| = 1, not on the circle.
        let side = 4.0 * angle / around;
        let (quadrant, s) = (side as usize, side.fract());
        let length = draw.between(0.5, 1.0);
        let (a, b) = (length * (1.0 - s), length * s);
        let [x, y] = [[a, b], [-b, a], [-a, -b], [b, -a]][quadrant.min(3)];
        let (bottom, top) = ([0.0; 3], [0.0, 0.0, 1.0]);
        if draw.chance(0.25) {
            draft.polygon(&[bottom, [x, y, draw.between(0.0, 1.0)], top]);
        } else {
            draft.polygon(&[bottom, [x, y, 0.0], [x, y, 1.0], top]);
        }
        angle += gap;
    }
    draft.finish()
}

/// A pile of tetrahedra 128 times as long as thick, in layers, in a box: those of a layer side by side, those of the
/// next across them. All of them are bodies of one region, the box around them another.
pub(super) fn needles(draw: &mut Draw, size: usize) -> Plc {
    let count = (size.saturating_sub(6) as f64 / 4.0).round().max(1.0) as usize;
    let row = ((count as f64).sqrt().round() as usize).max(1);
    let thick = 2f64.powi(-7);
    let mut draft = Draft::default();
    let layers = count.div_ceil(row);
    let height = layers as f64 * 2.0 * thick;
    draft.block([-0.5, -0.5, -0.5], [1.5, 1.5, height + 0.5]);
    for i in 0..count {
        let (layer, place) = (i / row, i % row);
        // Layers are apart by their thickness, needles by at least a third of their distance.
        let low = layer as f64 * 2.0 * thick;
        let across = (place as f64 + 0.5) / row as f64;
        let spread = (1.0 / (3.0 * row as f64)).min(thick);
        let mut corner = |end: f64, i: u64| {
            let [c, s] = turn(i, 4);
            let shift = draw.between(0.0, 0.0625);
            let along = end + if end == 0.0 { shift } else { -shift };
            let (u, w) = (across + spread * c, low + thick * (0.5 + 0.5 * s));
            if layer % 2 == 0 {
                [along, u, w]
            } else {
                [u, along, w]
            }
        };
        let [a, b, c, d] = [
            corner(0.0, 0),
            corner(0.0, 2),
            corner(1.0, 1),
            corner(1.0, 3),
        ];
        for triangle in [[a, b, c], [a, b, d], [a, c, d], [b, c, d]] {
            draft.polygon(&triangle);
        }
    }
    draft.region([-0.25; 3], 1);
    draft.finish()
}
