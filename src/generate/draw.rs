//! Numbers for generators that are the same bits on every platform: random choices, and points of the unit circle.
//!
//! ChaCha8 is specified and portable; what is drawn from its bits is written out here, since the distributions of
//! `rand` may change with its version. Sines and cosines of the standard library differ between platforms in their last
//! bits: here they are sums and products, which IEEE 754 defines exactly.
//!
//! Drawn coordinates are multiples of 2⁻²⁰ ([`grid`]), so that sums and small products of them are exact and what is
//! meant to be planar is exactly so.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{RngCore, SeedableRng};
use std::f64::consts::TAU;

/// A stream of random choices.
pub(super) struct Draw(ChaCha8Rng);

impl Draw {
    /// The stream with the given number of the generator with the given seed.
    pub fn new(seed: u64, stream: u64) -> Draw {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        random.set_stream(stream);
        Draw(random)
    }

    /// One of 0, …, n − 1.
    pub fn below(&mut self, n: usize) -> usize {
        ((u128::from(self.0.next_u64()) * n as u128) >> 64) as usize
    }

    /// An integer from `low` to `high`, both included.
    pub fn whole(&mut self, low: usize, high: usize) -> usize {
        low + self.below(high - low + 1)
    }

    /// A multiple of 2⁻²⁰ in [0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 44) as f64 * 2f64.powi(-20)
    }

    /// A multiple of 2⁻²⁰ between two numbers.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        grid(low + (high - low) * self.unit())
    }

    /// True with the given probability.
    pub fn chance(&mut self, probability: f64) -> bool {
        self.unit() < probability
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

    /// The axes of a random rotation, orthogonal but for rounding: those of a random quaternion.
    pub fn rotation(&mut self) -> [[f64; 3]; 3] {
        let q = loop {
            let q: [f64; 4] = std::array::from_fn(|_| 2.0 * self.unit() - 1.0);
            let square: f64 = q.iter().map(|x| x * x).sum();
            if (0.1..=1.0).contains(&square) {
                break q.map(|x| x / square.sqrt());
            }
        };
        let [w, x, y, z] = q;
        [
            [
                1.0 - 2.0 * (y * y + z * z),
                2.0 * (x * y - w * z),
                2.0 * (x * z + w * y),
            ],
            [
                2.0 * (x * y + w * z),
                1.0 - 2.0 * (x * x + z * z),
                2.0 * (y * z - w * x),
            ],
            [
                2.0 * (x * z - w * y),
                2.0 * (y * z + w * x),
                1.0 - 2.0 * (x * x + y * y),
            ],
        ]
    }
}

/// The multiple of 2⁻²⁰ that is nearest.
pub(super) fn grid(x: f64) -> f64 {
    (x * 2f64.powi(20)).round() * 2f64.powi(-20)
}

/// Cosine and sine of `i/n` of a full turn, to a few units in the last place, and with all the symmetries of the circle
/// exactly: the angle is reduced to the first eighth, in integers.
pub(super) fn turn(i: u64, n: u64) -> [f64; 2] {
    let quadrant = i * 4 / n % 4;
    let rest = i * 4 % n;
    let complement = 2 * rest > n;
    let of = if complement { n - rest } else { rest };
    let [c, s] = taylor(TAU / 4.0 * (of as f64 / n as f64));
    let [c, s] = if complement { [s, c] } else { [c, s] };
    match quadrant {
        0 => [c, s],
        1 => [-s, c],
        2 => [-c, -s],
        _ => [s, -c],
    }
}

/// Cosine and sine of 0 ≤ x ≤ π/4 by Taylor's series; the first terms left out are below 10⁻²⁰.
fn taylor(x: f64) -> [f64; 2] {
    let square = x * x;
    let series = |last: u32, first: f64| {
        let (mut sum, mut k) = (1.0, last);
        while k > 1 {
            let divisor = f64::from(k) * (f64::from(k) - 1.0);
            sum = 1.0 - square / divisor * sum;
            k -= 2;
        }
        first * sum
    };
    [series(18, 1.0), series(19, x)]
}

/// The corners of the regular n-gon in the unit circle, counterclockwise, as multiples of 2⁻³⁰: times radii of few
/// bits, plus centres of few bits, they are exact, so that rings of one n and one centre are exactly similar and the
/// walls between them, slanted or not, are exactly planar.
pub(super) fn circle(n: usize) -> Vec<[f64; 2]> {
    let round = |x: f64| (x * 2f64.powi(30)).round() * 2f64.powi(-30);
    (0..n as u64)
        .map(|i| turn(i, n as u64).map(round))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turns_are_cosines_and_sines() {
        for n in [1, 3, 7, 8, 1000] {
            for i in 0..n {
                let [c, s] = turn(i, n);
                let (sin, cos) = (TAU * i as f64 / n as f64).sin_cos();
                assert!(
                    (c - cos).abs() < 1e-15 && (s - sin).abs() < 1e-15,
                    "{i}/{n}"
                );
            }
        }
        // The symmetries are exact.
        let [c, s] = turn(5, 37);
        assert_eq!(turn(37 - 5, 37), [c, -s]);
        assert_eq!(turn(37 + 4 * 5, 4 * 37), [-s, c]);
    }

    #[test]
    fn choices_are_within_bounds_and_fixed() {
        let mut draw = Draw::new(1, 2);
        for _ in 0..1000 {
            assert!((0.0..1.0).contains(&draw.unit()));
            assert!((3..=5).contains(&draw.whole(3, 5)));
        }
        let mut again = [Draw::new(7, 0), Draw::new(7, 0), Draw::new(7, 1)];
        let [a, b, c] = again.each_mut().map(|draw| draw.below(1 << 60));
        assert!(a == b && a != c);
    }
}
