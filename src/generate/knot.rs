//! A tube around a torus knot, in triangles.

use super::draft::{Draft, along};
use super::draw::{Draw, turn};
use crate::exchange::Plc;
use crate::number::vector::cross;

/// How often a knot goes around the axis of its torus, and around the torus' core; and the radius of its tube, less
/// than half the distance of its strands and less than its radius of curvature.
const KNOTS: [(u64, u64, f64); 5] = [
    (2, 3, 0.30),
    (2, 5, 0.25),
    (3, 4, 0.22),
    (3, 5, 0.20),
    (4, 5, 0.16),
];

/// The radii of the torus.
const MAJOR: f64 = 2.0;
const MINOR: f64 = 0.875;

/// The seed chooses the knot and a rotation.
pub(super) fn knot(draw: &mut Draw, size: usize) -> Plc {
    let (p, q, tube) = draw.pick(&KNOTS);
    let axes = draw.rotation();
    // A knot is some eighty radii of its tube long.
    let least = 12 * (p + q) as usize;
    let corners =
        ((size as f64 / 30.0).sqrt().round() as usize).clamp(3, size.div_ceil(2 * least).max(3));
    let rings = (size / (2 * corners)).max(least) as u64;
    let point = |i: u64| {
        let [c, s] = turn(q * (i % rings), rings);
        let [cos, sin] = turn(p * (i % rings), rings);
        let radius = MAJOR + MINOR * c;
        [radius * cos, radius * sin, MINOR * s]
    };
    let ring = |i: u64| -> Vec<[f64; 3]> {
        let [x, y, _] = point(i);
        let [ahead, behind] = [point(i + 1), point(i + rings - 1)];
        let forward = unit([0, 1, 2].map(|k| ahead[k] - behind[k]));
        // Away from the core of the torus, and across both.
        let distance = (x * x + y * y).sqrt();
        let core = [MAJOR * x / distance, MAJOR * y / distance, 0.0];
        let outward = [0, 1, 2].map(|k| point(i)[k] - core[k]);
        let part: f64 = (0..3).map(|k| outward[k] * forward[k]).sum();
        let up = unit([0, 1, 2].map(|k| outward[k] - part * forward[k]));
        let across = cross(forward, up);
        let corner = |j: usize| {
            let [c, s] = turn(j as u64, corners as u64);
            let p = [0, 1, 2].map(|k| point(i)[k] + tube * (c * up[k] + s * across[k]));
            along(&axes, p)
        };
        (0..corners).map(corner).collect()
    };
    let mut draft = Draft::default();
    let first = ring(0);
    let mut these = first.clone();
    for i in 1..=rings {
        let those = if i == rings { first.clone() } else { ring(i) };
        for j in 0..corners {
            let k = (j + 1) % corners;
            draft.halves([these[j], these[k], those[k], those[j]]);
        }
        these = those;
    }
    draft.finish()
}

fn unit(a: [f64; 3]) -> [f64; 3] {
    let length = a.iter().map(|x| x * x).sum::<f64>().sqrt();
    a.map(|x| x / length)
}
