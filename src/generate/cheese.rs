//! A block full of bores that cross.
//!
//! Bores of round cross-section would meet in curves. Here they meet in cubic cells: from a cell, a bore goes through a
//! hole in one of its square sides to the next cell, or to the outside. So everything is exactly planar.

use super::draft::{Draft, Loop, Sets, placed, rectangle};
use super::draw::{Draw, circle, turn};
use super::turned::Face;
use crate::exchange::Plc;

/// The distance of cells.
const PITCH: f64 = 4.0;
/// How many of all possible bores there are.
const PROBABILITY: f64 = 0.6;

/// Bores of 3 to 12 corners along all axes. Cells that bores do not join with the outside are voids, with a hole point.
pub(super) fn cheese(draw: &mut Draw, size: usize) -> Plc {
    // For n³ cells: six sides each, and 3n²(n + 1) possible bores of 7.5 walls.
    let facets = |n: usize| 6.0 * n.pow(3) as f64 + 22.5 * PROBABILITY * (n * n * (n + 1)) as f64;
    let enough = |n: &usize| facets(*n) >= size as f64;
    let most = (1..).find(enough).expect("facets grow");
    let least = |n: usize| (size as f64 / facets(n) * n as f64).round() as usize;
    let counts = [most, most, least(most).clamp(1, most)];
    let cells = counts.iter().product();
    let cell = |at: [usize; 3]| (at[0] * counts[1] + at[1]) * counts[2] + at[2];
    let halves: Vec<f64> = (0..cells).map(|_| draw.whole(3, 8) as f64 / 8.0).collect();
    let middle = |at: [usize; 3]| at.map(|i| PITCH * (i as f64 + 1.0));
    let high = counts.map(|n| PITCH * (n as f64 + 1.0));
    let mut draft = Draft::default();
    // The last set is the outside.
    let mut joined = Sets::new(cells + 1);
    for axis in 0..3 {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let outer = |w| Face::new(axis, w, rectangle([0.0; 2], [high[u], high[v]]));
        let mut ends = [outer(0.0), outer(high[axis])];
        for (i, j) in (0..counts[u]).flat_map(|i| (0..counts[v]).map(move |j| (i, j))) {
            for k in 0..=counts[axis] {
                let at = |k: usize| {
                    let mut at = [0; 3];
                    (at[u], at[v], at[axis]) = (i, j, k);
                    at
                };
                let before = (k > 0).then(|| at(k - 1));
                let after = (k < counts[axis]).then(|| at(k));
                let known = before.or(after).expect("there is a cell");
                let centre = [middle(known)[u], middle(known)[v]];
                let half = |at: Option<[usize; 3]>| at.map_or(f64::MAX, |at| halves[cell(at)]);
                let narrow = half(before).min(half(after));
                let bore = bore(draw, centre, narrow);
                if bore.is_some() {
                    let set = |at: Option<[usize; 3]>| at.map_or(cells, cell);
                    joined.join(set(before), set(after));
                }
                let mut places = [0.0, high[axis]];
                for (at, out, end) in [(before, 1.0, 0), (after, -1.0, 1)] {
                    match at {
                        Some(at) => {
                            places[end] = middle(at)[axis] + out * halves[cell(at)];
                            side(
                                &mut draft,
                                axis,
                                places[end],
                                centre,
                                halves[cell(at)],
                                &bore,
                            );
                        }
                        None => {
                            if let Some(bore) = &bore {
                                ends[end].open(bore.clone(), centre);
                            }
                        }
                    }
                }
                if let Some(bore) = &bore {
                    draft.walls(axis, bore, places);
                }
            }
        }
        ends.into_iter().for_each(|face| face.draw(&mut draft));
    }
    let outside = joined.find(cells);
    for i in 0..cells {
        let root = joined.find(i);
        if root == i && root != outside {
            let at = [
                i / counts[2] / counts[1],
                i / counts[2] % counts[1],
                i % counts[2],
            ];
            draft.hole(middle(at));
        }
    }
    draft.finish()
}

/// The outline of a bore that fits into a side of the given half, if there is to be one.
fn bore(draw: &mut Draw, centre: [f64; 2], half: f64) -> Option<Loop> {
    let corners = draw.whole(3, 12);
    let [c, s] = turn(draw.below(64) as u64, 64);
    let radius = half * draw.between(0.5, 0.9);
    let turned: Loop = circle(corners)
        .iter()
        .map(|[u, v]| [c * u - s * v, s * u + c * v])
        .collect();
    draw.chance(PROBABILITY)
        .then(|| placed(&turned, centre, radius))
}

/// A side of a cell.
fn side(draft: &mut Draft, axis: usize, at: f64, centre: [f64; 2], half: f64, bore: &Option<Loop>) {
    let square = rectangle(centre.map(|x| x - half), centre.map(|x| x + half));
    let mut face = Face::new(axis, at, square);
    if let Some(bore) = bore {
        face.open(bore.clone(), centre);
    }
    face.draw(draft);
}
