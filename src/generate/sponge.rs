//! Menger's sponge: of 27 cubes the 20 at its edges, and so on for each of them; and rows of such sponges.

use super::draft::Draft;
use super::draw::Draw;
use crate::exchange::Plc;

/// The squares on the surface of one sponge, and those of one of its sides: 2·20ᵈ + 4·8ᵈ and 8ᵈ.
fn squares(depth: u32) -> [usize; 2] {
    [
        2 * 20usize.pow(depth) + 4 * 8usize.pow(depth),
        8usize.pow(depth),
    ]
}

/// The sponge that has at most `size` facets, of which each is a square, and as many side by side as come nearest to
/// that. The seed chooses the axis of the row.
pub(super) fn sponge(draw: &mut Draw, size: usize) -> Plc {
    let fits = |&depth: &u32| squares(depth)[0] <= size;
    let depth = (1..7).take_while(fits).last().unwrap_or(1);
    let [surface, side] = squares(depth);
    let row = (size.saturating_sub(2 * side) as f64 / (surface - 2 * side) as f64).round() as usize;
    let width = 3usize.pow(depth);
    let axis = draw.below(3);
    let mut counts = [width; 3];
    counts[axis] *= row.max(1);
    let full = |at: [usize; 3]| {
        let mut at = at.map(|i| i % width);
        (0..depth).all(|_| {
            let middles = at.iter().filter(|&&i| i % 3 == 1).count();
            at = at.map(|i| i / 3);
            middles < 2
        })
    };
    let mut draft = Draft::default();
    let [a, b, c] = counts;
    let pairs = (0..a).flat_map(|i| (0..b).map(move |j| (i, j)));
    for at in pairs.flat_map(|(i, j)| (0..c).map(move |k| [i, j, k])) {
        if full(at) {
            for axis in 0..3 {
                let (mut before, mut after) = (at, at);
                after[axis] += 1;
                before[axis] = before[axis].wrapping_sub(1);
                if at[axis] == 0 || !full(before) {
                    square(&mut draft, axis, at);
                }
                if after[axis] == counts[axis] || !full(after) {
                    square(&mut draft, axis, after);
                }
            }
        }
    }
    draft.finish()
}

/// The unit square across `axis` with this first corner.
fn square(draft: &mut Draft, axis: usize, at: [usize; 3]) {
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    let corner = |i: usize, j: usize| {
        let mut p = at;
        p[u] += i;
        p[v] += j;
        p.map(|x| x as f64)
    };
    draft.polygon(&[corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)]);
}
