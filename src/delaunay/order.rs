//! The order of insertion: biased randomized rounds (Amenta, Choi & Rote 2003), each along a Hilbert curve, so that the
//! walk from one vertex to the next is short and the expected work is that of a random order.
//!
//! The order affects time only: the tetrahedralization is unique.

use crate::mesh::VertexId;
use crate::predicate::PointStore;

/// A round smaller than this is not divided further.
const SMALLEST_ROUND: u32 = 64;
/// Bits per coordinate of the Hilbert curve.
const BITS: u32 = 21;

/// The given vertices in the order in which to insert them. O(n log n), deterministic.
pub fn insertion_order<P: PointStore>(points: &P, vertices: &[VertexId]) -> Vec<VertexId> {
    let (low, scale) = bounding_box(points, vertices);
    let rounds = (vertices.len() as u32 / SMALLEST_ROUND)
        .checked_ilog2()
        .unwrap_or(0)
        / 2;
    let mut keyed: Vec<(u64, VertexId)> = vertices
        .iter()
        .map(|&v| {
            let p = points.rounded(v);
            let cell = [0, 1, 2].map(|i| (((p[i] - low[i]) * scale) as u32).min((1 << BITS) - 1));
            // 63 bits of curve; a key for each round is its own stretch of the sorted order.
            (hilbert_index(cell), v)
        })
        .collect();
    if rounds == 0 {
        keyed.sort_unstable();
        return keyed.into_iter().map(|(_, v)| v).collect();
    }
    // A vertex is in the last round with probability 3/4, in the one before with 3/16, and so on.
    let round = |v: VertexId| rounds - (mix(u64::from(v.0)).trailing_zeros() / 2).min(rounds);
    let mut rounds: Vec<Vec<(u64, VertexId)>> = vec![Vec::new(); rounds as usize + 1];
    for (key, v) in keyed {
        rounds[round(v) as usize].push((key, v));
    }
    let mut order = Vec::with_capacity(vertices.len());
    for mut members in rounds {
        members.sort_unstable();
        order.extend(members.into_iter().map(|(_, v)| v));
    }
    order
}

/// The lower corner of the bounding box, and the factor that maps its longest side to the curve's grid.
fn bounding_box<P: PointStore>(points: &P, vertices: &[VertexId]) -> ([f64; 3], f64) {
    let mut low = [f64::INFINITY; 3];
    let mut high = [f64::NEG_INFINITY; 3];
    for &v in vertices {
        let p = points.rounded(v);
        for i in 0..3 {
            low[i] = low[i].min(p[i]);
            high[i] = high[i].max(p[i]);
        }
    }
    let side = (0..3).map(|i| high[i] - low[i]).fold(0.0, f64::max);
    let scale = f64::from(1 << BITS) / side;
    // Beyond the range of doubles every vertex falls into one cell: slow, not wrong.
    (low, if scale.is_finite() { scale } else { 0.0 })
}

/// SplitMix64, a fixed scrambling of the id.
fn mix(x: u64) -> u64 {
    let x = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

/// The place of a grid cell on the Hilbert curve (Skilling 2004: axes to transpose, then interleaved).
fn hilbert_index(mut x: [u32; 3]) -> u64 {
    let mut q = 1 << (BITS - 1);
    while q > 1 {
        let p = q - 1;
        for i in 0..3 {
            if x[i] & q != 0 {
                x[0] ^= p;
            } else {
                let t = (x[0] ^ x[i]) & p;
                x[0] ^= t;
                x[i] ^= t;
            }
        }
        q >>= 1;
    }
    x[1] ^= x[0];
    x[2] ^= x[1];
    let mut t = 0;
    let mut q = 1 << (BITS - 1);
    while q > 1 {
        if x[2] & q != 0 {
            t ^= q - 1;
        }
        q >>= 1;
    }
    let [a, b, c] = x.map(|y| spread(y ^ t));
    a << 2 | b << 1 | c
}

/// The low 21 bits of x, two zeros between each.
fn spread(x: u32) -> u64 {
    let x = u64::from(x) & 0x1f_ffff;
    let x = (x | x << 32) & 0x001f_0000_0000_ffff;
    let x = (x | x << 16) & 0x001f_0000_ff00_00ff;
    let x = (x | x << 8) & 0x100f_00f0_0f00_f00f;
    let x = (x | x << 4) & 0x10c3_0c30_c30c_30c3;
    (x | x << 2) & 0x1249_2492_4924_9249
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::predicate::DoublePoints;

    #[test]
    fn consecutive_cells_of_the_curve_are_neighbours() {
        // All cells of the lowest 8×8×8 block, in order of the curve.
        let mut cells: Vec<(u64, [u32; 3])> = Vec::new();
        for x in 0..8 {
            for y in 0..8 {
                for z in 0..8 {
                    cells.push((hilbert_index([x, y, z]), [x, y, z]));
                }
            }
        }
        cells.sort_unstable();
        for pair in cells.windows(2) {
            let step: u32 = (0..3).map(|i| pair[0].1[i].abs_diff(pair[1].1[i])).sum();
            assert_eq!(step, 1, "{pair:?}");
        }
    }

    #[test]
    fn every_vertex_once() {
        let points: Vec<[f64; 3]> = (0..5000)
            .map(|i| [f64::from(i % 17), f64::from(i % 31), f64::from(i)])
            .collect();
        let points = DoublePoints::new(points);
        let all: Vec<VertexId> = (0..5000).map(VertexId::new).collect();
        let mut order = insertion_order(&points, &all);
        order.sort_unstable();
        assert_eq!(order, all);
    }
}
