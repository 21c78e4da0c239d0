//! Point sets: easy ones, cospherical ones, and uneven ones. Coordinates come from correctly rounded operations only,
//! so that they are the same bits everywhere.

use rand::{RngCore, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// How points are spread.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spread {
    /// Uniform in a cube.
    Cube,
    /// On the surface of a sphere, up to rounding.
    Sphere,
    /// A cubic lattice of integers: every cube is cospherical.
    Lattice,
    /// The same times 0.1, rounded: nearly cospherical.
    Tenths,
    /// A mixture of 40 bell-shaped clusters of very different sizes.
    Clusters,
    /// Uniform in a box with sides 1, 1/100 and 1/10 000.
    Flat,
}

impl Spread {
    /// All of them.
    pub const ALL: [Spread; 6] = [
        Spread::Cube,
        Spread::Sphere,
        Spread::Lattice,
        Spread::Tenths,
        Spread::Clusters,
        Spread::Flat,
    ];

    /// The word of tables.
    pub fn word(self) -> &'static str {
        match self {
            Spread::Cube => "uniform",
            Spread::Sphere => "sphere",
            Spread::Lattice => "lattice",
            Spread::Tenths => "tenths",
            Spread::Clusters => "clusters",
            Spread::Flat => "flat",
        }
    }

    /// Whether no five points of it are cospherical, but for accidents, so that the tetrahedralization is unique.
    pub fn is_generic(self) -> bool {
        matches!(self, Spread::Cube | Spread::Clusters | Spread::Flat)
    }

    /// About so many points.
    pub fn points(self, n: usize) -> Vec<[f64; 3]> {
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let mut uniform = move || (random.next_u64() >> 11) as f64 * 2f64.powi(-53);
        match self {
            Spread::Cube => (0..n).map(|_| [uniform(), uniform(), uniform()]).collect(),
            Spread::Flat => (0..n)
                .map(|_| [uniform(), uniform() / 100.0, uniform() / 10_000.0])
                .collect(),
            Spread::Sphere => (0..n).map(|_| on_sphere(&mut uniform)).collect(),
            Spread::Lattice => lattice(n, 1.0),
            Spread::Tenths => lattice(n, 0.1),
            Spread::Clusters => clusters(n, &mut uniform),
        }
    }
}

fn on_sphere(uniform: &mut impl FnMut() -> f64) -> [f64; 3] {
    loop {
        let p = [0; 3].map(|_| 2.0 * uniform() - 1.0);
        let length = (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]).sqrt();
        if (0.01..1.0).contains(&length) {
            return p.map(|x| x / length);
        }
    }
}

fn lattice(n: usize, unit: f64) -> Vec<[f64; 3]> {
    let side = (1..).find(|s: &usize| s * s * s >= n).expect("a side");
    let all =
        (0..side).flat_map(|x| (0..side).flat_map(move |y| (0..side).map(move |z| [x, y, z])));
    all.map(|p| p.map(|i| i as f64 * unit)).collect()
}

/// The sum of four uniform numbers is as good as a bell here.
fn clusters(n: usize, uniform: &mut impl FnMut() -> f64) -> Vec<[f64; 3]> {
    let centres: Vec<([f64; 3], [f64; 3])> = (0..40)
        .map(|i| {
            let size = 2f64.powi(-(i % 12));
            let sides = [0; 3].map(|_| size * (0.02 + uniform()));
            ([0; 3].map(|_| 10.0 * uniform()), sides)
        })
        .collect();
    (0..n)
        .map(|i| {
            let (centre, sides) = centres[i % centres.len()];
            [0, 1, 2].map(|axis| {
                let bell = uniform() + uniform() + uniform() + uniform() - 2.0;
                centre[axis] + sides[axis] * bell
            })
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_many_as_wanted_and_the_same_each_time() {
        for spread in Spread::ALL {
            let points = spread.points(1000);
            assert_eq!(points.len(), 1000, "{}", spread.word());
            assert_eq!(points, spread.points(1000));
            let mut bits: Vec<_> = points.iter().map(|p| p.map(f64::to_bits)).collect();
            bits.sort_unstable();
            bits.dedup();
            assert_eq!(bits.len(), 1000, "{}: no duplicates", spread.word());
        }
    }

    #[test]
    fn of_the_promised_kind() {
        let far = |p: &[f64; 3]| (p[0] * p[0] + p[1] * p[1] + p[2] * p[2] - 1.0).abs();
        assert!(Spread::Sphere.points(100).iter().all(|p| far(p) < 1e-15));
        assert!(Spread::Flat.points(100).iter().all(|p| p[2] < 1e-4));
        assert_eq!(Spread::Lattice.points(27)[26], [2.0; 3]);
    }
}
