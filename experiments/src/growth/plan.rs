//! Which sizes, how often.

use crate::method::Method;
use crate::scene::Slab;
use crate::turns::Effort;
use tetflip::recover::polygons::{Insertion, Times};

/// Crossing tetrahedra for each vertex of the slab.
const DENSITY: f64 = 3.3;

/// The methods, in the order of tables.
pub const METHODS: [Method; 2] = [
    Method(Insertion::Flip(Times::Filtered)),
    Method(Insertion::Cavity),
];

/// The half height of scenes with up to [`FLAT`] vertices.
const HALF_HEIGHT: f64 = 0.01;

/// With more vertices than this the slab of that height is thick compared with their distances.
const FLAT: f64 = 30_000.0;

/// The scene with about so many crossing tetrahedra. Large ones are as much flatter as their vertices are closer to each other,
/// because in a thick slab many tetrahedra do not cross the rectangle.
pub fn slab(crossing: u64) -> Slab {
    let n = crossing as f64 / DENSITY;
    Slab {
        vertices: n as usize,
        half_height: HALF_HEIGHT * (FLAT / n).sqrt().min(1.0),
        seed: 1,
    }
}

/// What to run.
#[derive(Clone, Debug)]
pub struct Plan {
    /// About how many crossing tetrahedra, ascending.
    pub sizes: Vec<u64>,
    /// Seconds of repetitions for each size.
    pub seconds: f64,
}

impl Plan {
    /// Two minutes.
    pub fn full() -> Plan {
        Plan {
            sizes: vec![1000, 3000, 10_000, 30_000, 100_000, 300_000, 1_000_000],
            seconds: 1.0,
        }
    }

    /// Some seconds.
    pub fn quick() -> Plan {
        Plan {
            sizes: vec![1000, 3000, 10_000],
            seconds: 0.2,
        }
    }

    /// How often the insertions of one size are timed: large ones less often.
    pub fn effort(&self, crossing: u64) -> Effort {
        let least = match crossing {
            0..=30_000 => 5,
            30_001..=300_000 => 3,
            _ => 2,
        };
        Effort {
            seconds: self.seconds,
            least,
            most: 101,
            of_slow: 0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_large_slabs_are_flatter() {
        assert_eq!(slab(3300).half_height, HALF_HEIGHT);
        assert_eq!(slab(0).half_height, HALF_HEIGHT);
        let large = slab(1_000_000);
        let relative = large.half_height * (large.vertices as f64 / FLAT).sqrt();
        assert!((relative / HALF_HEIGHT - 1.0).abs() < 1e-5);
    }
}
