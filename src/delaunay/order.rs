//! The order of insertion: biased randomized rounds (Amenta, Choi & Rote 2003), each along a Hilbert curve, so that the
//! walk from one vertex to the next is short and the expected work is that of a random order.
//!
//! The order affects time only: the tetrahedralization is unique.

use crate::mesh::VertexId;
use crate::predicate::PointStore;
use rayon::prelude::*;

/// A round smaller than this is not divided further.
const SMALLEST_ROUND: u32 = 64;
/// Bits per coordinate of the Hilbert curve.
const BITS: u32 = 21;

/// So many vertices are sorted by all threads.
const MANY: usize = 1 << 15;

/// The rounds of an order of insertion.
pub(super) struct Rounds {
    /// The members of each with their places on the curve, in ascending order.
    rounds: Vec<Vec<(u64, VertexId)>>,
}

impl Rounds {
    /// The rounds of the given vertices. The same for any number of threads.
    pub fn new<P: PointStore>(points: &P, vertices: &[VertexId]) -> Rounds {
        let (low, scale) = bounding_box(points, vertices);
        let last = (vertices.len() as u32 / SMALLEST_ROUND)
            .checked_ilog2()
            .unwrap_or(0)
            / 2;
        let keyed = |&v: &VertexId| {
            let p = points.rounded(v);
            let cell = [0, 1, 2].map(|i| (((p[i] - low[i]) * scale) as u32).min((1 << BITS) - 1));
            (hilbert_index(cell), v)
        };
        let by_all_threads = vertices.len() >= MANY && rayon::current_num_threads() > 1;
        let keyed: Vec<(u64, VertexId)> = if by_all_threads {
            vertices.par_iter().map(keyed).collect()
        } else {
            vertices.iter().map(keyed).collect()
        };
        let mut rounds = vec![Vec::new(); last as usize + 1];
        // A vertex is in the last round with probability 3/4, in the one before with 3/16, and so on.
        let round = |v: VertexId| last - (mix(u64::from(v.0)).trailing_zeros() / 2).min(last);
        for (key, v) in keyed {
            rounds[round(v) as usize].push((key, v));
        }
        for members in &mut rounds {
            if by_all_threads && members.len() >= MANY {
                members.par_sort_unstable();
            } else {
                members.sort_unstable();
            }
        }
        Rounds { rounds }
    }

    /// All of them, one after the other.
    pub fn order(&self) -> Vec<VertexId> {
        let mut order = Vec::with_capacity(self.rounds.iter().map(Vec::len).sum());
        for members in &self.rounds {
            order.extend(members.iter().map(|&(_, v)| v));
        }
        order
    }

    /// The curve cut into so many pieces, of about as many vertices each: by round, where in the order the pieces
    /// begin, and at last where the round ends.
    pub fn cuts(&self, pieces: usize) -> Vec<Vec<usize>> {
        let last = self.rounds.last().expect("there is a round");
        let cut = |k: usize| {
            last.get(last.len() * k / pieces)
                .map_or(u64::MAX, |&(key, _)| key)
        };
        let cuts: Vec<u64> = (1..pieces).map(cut).collect();
        let mut start = 0;
        let places = |members: &Vec<(u64, VertexId)>| {
            let begin = start;
            start += members.len();
            let place = |&cut: &u64| begin + members.partition_point(|&(key, _)| key < cut);
            let inner = cuts.iter().map(place);
            std::iter::once(begin).chain(inner).chain([start]).collect()
        };
        self.rounds.iter().map(places).collect()
    }
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

/// The place of a grid cell on the Hilbert curve (Hamilton & Rau-Chaplin 2008), from the coarsest level to the finest:
/// the table gives the place of a level's octant on the curve, and how the curve runs within it.
fn hilbert_index(cell: [u32; 3]) -> u64 {
    let [x, y, z] = cell.map(spread);
    let octants = x | y << 1 | z << 2;
    let (mut index, mut state) = (0, 0);
    for level in (0..BITS).rev() {
        let octant = (octants >> (3 * level)) & 7;
        let step = CURVE[(state | octant) as usize];
        index = index << 3 | u64::from(step & 7);
        state = u64::from(step) & !7;
    }
    index
}

/// By 8·state + octant: 8·(next state) + the place of the octant on the curve.
const CURVE: [u8; 192] = curve();

/// A state is the corner where the curve enters a cube and the axis along which it goes through: 3·corner + axis, 24
/// states.
const fn curve() -> [u8; 192] {
    let mut table = [0; 192];
    let mut state = 0;
    while state < 24 {
        let (entry, axis) = (state / 3, state % 3);
        let mut octant = 0;
        while octant < 8 {
            // The octant as the curve of the state 0 sees it, and its place there: the inverse of the Gray code.
            let seen = rotate(octant ^ entry, 3 - (axis + 1) % 3);
            let place = seen ^ (seen >> 1) ^ (seen >> 2);
            // Where the curve enters that octant, and along which axis it goes through.
            let enters = if place == 0 {
                0
            } else {
                gray((place - 1) / 2 * 2)
            };
            let along = match place {
                0 => 0,
                p if p % 2 == 0 => (p - 1).trailing_ones() as usize % 3,
                p => p.trailing_ones() as usize % 3,
            };
            let next = 3 * (entry ^ rotate(enters, (axis + 1) % 3)) + (axis + along + 1) % 3;
            table[8 * state + octant] = (8 * next + place) as u8;
            octant += 1;
        }
        state += 1;
    }
    table
}

const fn gray(i: usize) -> usize {
    i ^ (i >> 1)
}

/// Three bits rotated to the left.
const fn rotate(bits: usize, by: usize) -> usize {
    (bits << (by % 3) | bits >> (3 - by % 3)) & 7
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
        let mut order = Rounds::new(&points, &all).order();
        order.sort_unstable();
        assert_eq!(order, all);
    }
}
