//! What is known of all coordinates that are doubles, and what follows for the error of the determinants.

use super::integers::most_bits;
use crate::number::bits::{lowest_bit, power_of_two};

/// The grid that all coordinates lie on, their largest magnitude and their bounding box.
#[derive(Clone, Copy, Debug)]
pub(super) struct Range {
    /// All coordinates are multiples of 2^grid.
    pub grid: i32,
    /// All coordinates are at most this in magnitude.
    pub largest: f64,
    low: [f64; 3],
    high: [f64; 3],
    /// 2^(3·grid) and 2^(5·grid), or 0 where that is no normal double.
    pub quantum3: f64,
    pub quantum5: f64,
    /// 2^(−grid) if all coordinates are below 2^61 in units of the grid, else 0.
    pub unit: f64,
    /// The error of orient3d, whatever the points; infinite where nothing is known.
    pub orient3d_error: f64,
    /// The factor of H⁵ in the square of the error of insphere; infinite where that is no bound.
    pub insphere_factor: f64,
}

/// 8·6·2⁻⁵², rounded up.
pub(super) const ORIENT3D_BOUND: f64 = 48.5 * f64::EPSILON;
/// 18·24·2⁻⁵², rounded up.
const INSPHERE_BOUND: f64 = 437.0 * f64::EPSILON;
/// 2^150, beyond which products of three differences are not bounded.
const FAR: f64 = (1u128 << 100) as f64 * (1u64 << 50) as f64;
/// 2^99, beyond which the square of insphere may overflow.
const WIDE: f64 = (1u128 << 99) as f64;

impl Default for Range {
    fn default() -> Range {
        Range {
            grid: 1023,
            largest: 0.0,
            low: [f64::INFINITY; 3],
            high: [f64::NEG_INFINITY; 3],
            quantum3: 0.0,
            quantum5: 0.0,
            unit: 0.0,
            orient3d_error: f64::INFINITY,
            insphere_factor: f64::INFINITY,
        }
    }
}

impl Range {
    /// The range of all given points.
    pub fn of(points: &[[f64; 3]]) -> Range {
        let mut range = Range::default();
        for &p in points {
            range.note(p);
        }
        range.conclude();
        range
    }

    /// The same with one more point; whether it changes anything.
    pub fn include(&mut self, p: [f64; 3]) -> bool {
        let changed = self.note(p);
        if changed {
            self.conclude();
        }
        changed
    }

    #[inline]
    fn note(&mut self, p: [f64; 3]) -> bool {
        let mut changed = false;
        for (i, x) in p.into_iter().enumerate() {
            if x < self.low[i] {
                self.low[i] = x;
                changed = true;
            }
            if x > self.high[i] {
                self.high[i] = x;
                changed = true;
            }
            if let Some(grid) = lowest_bit(x) {
                changed |= grid < self.grid || x.abs() > self.largest;
                self.grid = self.grid.min(grid);
                self.largest = self.largest.max(x.abs());
            }
        }
        changed
    }

    fn conclude(&mut self) {
        self.quantum3 = power_of_two(3 * self.grid);
        self.quantum5 = power_of_two(5 * self.grid);
        let unit = power_of_two(-self.grid);
        let fits = self.largest * unit < 2f64.powi(most_bits(1));
        self.unit = if fits { unit } else { 0.0 };
        // A bound may be larger than the extent: not too small, so that the product does not underflow.
        let extents = [0, 1, 2].map(|i| (self.high[i] - self.low[i]).max(1.0 / FAR));
        let [x, y, z] = extents;
        let all_below = |limit: f64| extents.iter().all(|&x| x <= limit);
        self.orient3d_error = match all_below(FAR) {
            true => ORIENT3D_BOUND * (x * y * z),
            false => f64::INFINITY,
        };
        self.insphere_factor = match all_below(WIDE) {
            true => INSPHERE_BOUND * INSPHERE_BOUND,
            false => f64::INFINITY,
        };
    }
}
