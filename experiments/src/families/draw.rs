//! Random choices that are the same bits everywhere. They are written out rather than left to `rand`, whose
//! distributions may change with its version.

use rand::{RngCore, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// A stream of choices.
pub struct Draw(ChaCha8Rng);

impl Draw {
    /// The stream with the given number of the generator with the given seed.
    pub fn new(seed: u64, stream: u64) -> Draw {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        random.set_stream(stream);
        Draw(random)
    }

    /// 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0.next_u64()
    }

    /// One of 0, …, n − 1.
    pub fn below(&mut self, n: usize) -> usize {
        ((u128::from(self.bits()) * n as u128) >> 64) as usize
    }

    /// An integer from `low` to `high`, both included.
    pub fn int(&mut self, low: i32, high: i32) -> i32 {
        low + self.below((high - low + 1) as usize) as i32
    }

    /// One of the two numbers −1 and 1.
    pub fn sign(&mut self) -> i32 {
        2 * self.int(0, 1) - 1
    }

    /// True once in n times.
    pub fn once_in(&mut self, n: usize) -> bool {
        self.below(n) == 0
    }

    /// Uniform among the odd multiples of 2⁻⁵² in (−1, 1): symmetric and never zero.
    pub fn fraction(&mut self) -> f64 {
        let odd = (self.bits() >> 12 << 1 | 1) as i64 - (1 << 52);
        odd as f64 * 2f64.powi(-52)
    }

    /// A point of the cube (−1, 1)³.
    pub fn point(&mut self) -> [f64; 3] {
        std::array::from_fn(|_| self.fraction())
    }

    /// One of several.
    pub fn pick<T: Copy>(&mut self, of: &[T]) -> T {
        of[self.below(of.len())]
    }

    /// All of them in random order.
    pub fn shuffle<T>(&mut self, items: &mut [T]) {
        for i in (1..items.len()).rev() {
            items.swap(i, self.below(i + 1));
        }
    }

    /// A lattice point with coordinates from −r to r.
    pub fn lattice_point(&mut self, r: i32) -> [i32; 3] {
        std::array::from_fn(|_| self.int(-r, r))
    }

    /// About n different lattice points with coordinates from −r to r.
    pub fn lattice_points(&mut self, r: i32, n: usize) -> Vec<[i32; 3]> {
        let mut points: Vec<[i32; 3]> = (0..n).map(|_| self.lattice_point(r)).collect();
        points.sort_unstable();
        points.dedup();
        points
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_are_filled_and_kept() {
        let mut draw = Draw::new(1, 0);
        let mut seen = [0; 7];
        for _ in 0..700 {
            seen[(draw.int(-3, 3) + 3) as usize] += 1;
            assert!(draw.fraction().abs() < 1.0);
        }
        assert!(seen.iter().all(|&n| n > 50), "{seen:?}");
        let mut items: Vec<i32> = (0..20).collect();
        draw.shuffle(&mut items);
        assert!(!items.is_sorted());
        items.sort_unstable();
        assert!(items.into_iter().eq(0..20));
    }

    #[test]
    fn streams_differ_and_repeat() {
        let first = |seed, stream| Draw::new(seed, stream).bits();
        assert_eq!(first(5, 2), first(5, 2));
        assert_ne!(first(5, 2), first(5, 3));
        assert_ne!(first(5, 2), first(6, 2));
    }
}
