//! A box divided into rooms by walls, each room a region with an attribute; some walls are missing, some rooms are
//! holes.

use super::draft::{Draft, Sets};
use super::draw::Draw;
use crate::exchange::Plc;

/// Planes at random distances along all axes. The sides of the box are complete; one wall in five is missing between
/// others, which may stand free. One room in fifty, not at the outside, is a hole, and has all its walls.
pub(super) fn cells(draw: &mut Draw, size: usize) -> Plc {
    // n³ rooms have 3n²(n − 1) inner walls, four of five there, and 6n² outer ones.
    let facets = |n: usize| 2.4 * (n * n * (n - 1)) as f64 + 6.0 * (n * n) as f64;
    let n = (2..)
        .find(|&n| facets(n) >= size as f64)
        .expect("facets grow");
    let last = (size as f64 / facets(n) * n as f64).round() as usize;
    let counts = [n, n, last.clamp(1, n)];
    let planes = counts.map(|n| {
        let mut at = vec![0.0];
        (0..n).for_each(|i| at.push(at[i] + draw.between(0.25, 2.0)));
        at
    });
    let room = |at: [usize; 3]| (at[0] * counts[1] + at[1]) * counts[2] + at[2];
    let rooms: Vec<[usize; 3]> = {
        let [a, b, c] = counts;
        let pairs = (0..a).flat_map(|i| (0..b).map(move |j| (i, j)));
        pairs
            .flat_map(|(i, j)| (0..c).map(move |k| [i, j, k]))
            .collect()
    };
    let inner = |at: &[usize; 3]| (0..3).all(|i| at[i] % 2 == 1 && at[i] + 1 < counts[i]);
    let is_hole: Vec<bool> = rooms
        .iter()
        .map(|at| inner(at) && draw.chance(0.16))
        .collect();
    let mut draft = Draft::default();
    let mut joined = Sets::new(rooms.len());
    for at in &rooms {
        for axis in 0..3 {
            let mut next = *at;
            next[axis] += 1;
            let beyond = (next[axis] < counts[axis]).then(|| room(next));
            let needed = |other: usize| is_hole[room(*at)] || is_hole[other];
            if at[axis] == 0 {
                wall(&mut draft, &planes, axis, *at);
            }
            match beyond {
                Some(other) if !needed(other) && draw.chance(0.2) => {
                    joined.join(room(*at), other);
                }
                _ => wall(&mut draft, &planes, axis, next),
            }
        }
    }
    for (i, at) in rooms.iter().enumerate() {
        let middle = [0, 1, 2].map(|k| (planes[k][at[k]] + planes[k][at[k] + 1]) / 2.0);
        if is_hole[i] {
            draft.hole(middle);
        } else if joined.find(i) == i {
            draft.region(middle, i + 1);
        }
    }
    draft.finish()
}

/// The wall across `axis` whose first corner is at the given planes.
fn wall(draft: &mut Draft, planes: &[Vec<f64>; 3], axis: usize, at: [usize; 3]) {
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    let corner = |i: usize, j: usize| {
        let mut index = at;
        index[u] += i;
        index[v] += j;
        [0, 1, 2].map(|k| planes[k][index[k]])
    };
    draft.polygon(&[corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)]);
}
