//! A pipe with a right-angled bend, with facets that are flat only to rounding.
//!
//! The pipe is turned by a random rotation, and its coordinates are rounded to doubles. So its ends, which are cut off
//! at a slant, the cut through the middle of its bend, and the quadrangles of its walls, all of which would be planar
//! in real numbers, are planar to a few units in the last place only. That is the purpose of this kind: all others are
//! exactly planar.

use super::draft::{Draft, along};
use super::draw::{Draw, turn};
use crate::exchange::Plc;

/// The radius of the bend; the radii of the pipe are less.
const BEND: f64 = 2.0;

/// Rings around the pipe, with two regions: the pipe before and after the cut.
pub(super) fn bend(draw: &mut Draw, size: usize) -> Plc {
    let corners = ((size as f64 / 2.0).sqrt().round() as usize).clamp(4, 512);
    let rings = ((size as f64 / (2 * corners) as f64 - 2.0).round() as usize).max(2);
    let radii = [draw.between(0.8, 1.2), draw.between(0.4, 0.7)];
    let slants = [draw.between(-0.5, 0.5), draw.between(-0.5, 0.5)];
    let axes = draw.rotation();
    // Along the pipe: a slanted end, the rings of the bend, the other end.
    let point = |radius: f64, station: usize, i: usize| {
        let [c, s] = turn(i as u64, corners as u64);
        let (outwards, up) = (radius * c, radius * s);
        let ring = station.clamp(1, rings + 1) - 1;
        let [cos, sin] = turn(ring as u64, 4 * rings as u64);
        let (x, y) = ((BEND + outwards) * cos, (BEND + outwards) * sin);
        let leg = |slant: f64| 2.0 + slant * outwards + 0.25 * up;
        match station {
            0 => [x, y - leg(slants[0]), up],
            _ if station == rings + 2 => [x - leg(slants[1]), y, up],
            _ => [x, y, up],
        }
    };
    let ring = |radius, station| -> Vec<[f64; 3]> {
        (0..corners)
            .map(|i| along(&axes, point(radius, station, i)))
            .collect()
    };
    let mut draft = Draft::default();
    for radius in radii {
        for station in 0..rings + 2 {
            let (these, those) = (ring(radius, station), ring(radius, station + 1));
            for i in 0..corners {
                let j = (i + 1) % corners;
                draft.polygon(&[these[i], these[j], those[j], those[i]]);
            }
        }
    }
    let cut = 1 + rings / 2;
    for station in [0, cut, rings + 2] {
        let middle = along(&axes, point(0.0, station, 0));
        draft.facet(&radii.map(|radius| ring(radius, station)), &[middle]);
    }
    for (station, attribute) in [(0, 1), (rings + 1, 2)] {
        // Between the two walls, and between two rings.
        let wall = (radii[0] + radii[1]) / 2.0;
        let between = mean(point(wall, station, 0), point(wall, station + 1, 0));
        draft.region(along(&axes, between), attribute);
    }
    draft.finish()
}

fn mean(p: [f64; 3], q: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|i| (p[i] + q[i]) / 2.0)
}
