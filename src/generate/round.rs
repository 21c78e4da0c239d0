//! Parts that are round about an axis: stepped shafts and helical gears.

use super::draft::{Draft, Loop, lift, placed, sides};
use super::draw::{Draw, circle, turn};
use crate::exchange::Plc;

/// A shaft of many steps and chamfers: rings of exactly similar regular polygons, so that chamfers, too, are exactly
/// planar quadrangles. The corners of a ring are cocircular, those of some rings cospherical, up to rounding, and by
/// symmetry eight or sixteen of them exactly so. A blind bore in each end; a groove is a step like others.
pub(super) fn shaft(draw: &mut Draw, size: usize) -> Plc {
    let corners = ((size as f64 / 4.0).sqrt().round() as usize).clamp(4, 256) / 4 * 4;
    let outline = circle(corners);
    // A step is a shelf or a chamfer, and a cylinder.
    let steps = (size as f64 / (1.4 * corners as f64) - 1.4).round() as usize;
    let mut draft = Draft::default();
    let ring = |radius: f64| placed(&outline, [0.0; 2], radius);
    let bore = |draft: &mut Draft, end: f64, bottom: f64, radius: f64| {
        draft.plane(2, end, &[ring(radius), ring(0.25)], &[[0.0; 2]]);
        draft.walls(2, &ring(0.25), [end, bottom]);
        draft.plane(2, bottom, &[ring(0.25)], &[]);
    };
    let mut eighths = |low, high| draw.whole(low, high) as f64 / 8.0;
    let (mut radius, mut z) = (eighths(8, 16), 0.0);
    bore(&mut draft, 0.0, 0.25, radius);
    for step in 0..steps.max(1) {
        if step > 0 {
            let mut other = eighths(4, 31);
            if other >= radius {
                other += 0.125;
            }
            // Two steps in five are slanted.
            let slant = eighths(0, 4).max(0.25) - 0.25;
            let rings = [ring(radius), ring(other)];
            if slant == 0.0 {
                draft.plane(2, z, &rings, &[[0.0; 2]]);
            } else {
                let [lower, upper] = [z, z + slant];
                for ([p, q], [r, s]) in sides(&rings[0]).zip(sides(&rings[1])) {
                    let corners = [(p, lower), (q, lower), (s, upper), (r, upper)];
                    draft.polygon(&corners.map(|(p, w)| lift(2, p, w)));
                }
            }
            (radius, z) = (other, z + slant);
        }
        let end = z + eighths(4, 16);
        draft.walls(2, &ring(radius), [z, end]);
        z = end;
    }
    bore(&mut draft, z, z - 0.125, radius);
    draft.finish()
}

/// A gear whose teeth turn with the height, in triangles, with a bore and lightening holes straight through it.
///
/// All points of a flank's horizontal section come in the order of their angles, as long as a layer turns by less than
/// the smallest step of the profile, so that the flanks do not meet.
pub(super) fn gear(draw: &mut Draw, size: usize) -> Plc {
    let teeth = ((size as f64 / 16.0).sqrt().round() as usize).clamp(6, 240);
    let layers = ((size as f64 / (8 * teeth) as f64 - 0.75).round() as usize).max(1);
    // Steps of a quarter of a tooth; a layer turns by less than half of one.
    let part = |i: usize| (i * 64) as u64;
    let total = part(4 * teeth);
    let twist = draw.whole(8, 28) as u64;
    let root = 4.0 - (24.0 / teeth as f64).min(1.0);
    let profile = |layer: usize| -> Loop {
        let corner = |i: usize| {
            let [c, s] = turn((part(i) + twist * layer as u64) % total, total);
            let radius = if i % 4 < 2 { root } else { 4.0 };
            [radius * c, radius * s]
        };
        (0..4 * teeth).map(corner).collect()
    };
    let mut draft = Draft::default();
    let height = |layer: usize| layer as f64 / layers as f64 * 2.0;
    for layer in 0..layers {
        let (below, above) = (profile(layer), profile(layer + 1));
        let [low, high] = [height(layer), height(layer + 1)];
        for ([p, q], [r, s]) in sides(&below).zip(sides(&above)) {
            draft.halves([
                lift(2, q, low),
                lift(2, s, high),
                lift(2, r, high),
                lift(2, p, low),
            ]);
        }
    }
    let outline = circle(teeth);
    let mut holes = vec![([0.0; 2], draw.between(0.5, 0.75))];
    let spokes = draw.whole(3, 6) as u64;
    let spoke = |i| turn(i, spokes).map(|x| 1.75 * x);
    holes.extend((0..spokes).map(|i| (spoke(i), 0.625)));
    let curves = holes
        .iter()
        .map(|&(centre, radius)| placed(&outline, centre, radius));
    let curves: Vec<Loop> = curves.collect();
    let centres: Vec<[f64; 2]> = holes.iter().map(|hole| hole.0).collect();
    for curve in &curves {
        draft.walls(2, curve, [0.0, 2.0]);
    }
    for layer in [0, layers] {
        let outlines = [vec![profile(layer)], curves.clone()].concat();
        draft.plane(2, height(layer), &outlines, &centres);
    }
    draft.finish()
}
