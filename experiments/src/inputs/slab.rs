//! The scene of Si & Shewchuk's §3.4 and Fig. 8: a random vertex set near, but not on, the x-y plane, and a large
//! rectangle in that plane that cuts entirely through the convex hull of the set.
//!
//! The paper says no more; our reading of it: the vertices are uniform in the slab [−1, 1]² × [−h, h] without z = 0,
//! and the rectangle is [−5/4, 5/4] × [−9/8, 9/8]. Each edge of the rectangle is an edge of the convex hull of all
//! vertices (no other vertex lies on the vertical plane through it), so the Delaunay tetrahedralization has all four
//! and the rectangle can be inserted without a Steiner point. Every tetrahedron with vertices on both sides of the
//! plane crosses the rectangle; there are about 3.3 n of them where h ≤ 1/10 (counted for n = 50 … 800), fewer in a
//! thicker slab.

use rand::{RngCore, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde::Serialize;
use tetflip::exchange::{Facet, Plc};
use tetflip::mesh::VertexId;

/// Half the sides of the rectangle along x and y: more than the 1 of the slab, and not equal.
pub const RECTANGLE: [f64; 2] = [1.25, 1.125];

/// Which scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slab {
    /// The number n of random vertices.
    pub vertices: usize,
    /// h: the random vertices have −h < z < h, and none has z = 0.
    pub half_height: f64,
    /// The seed of ChaCha8. One seed and one n give the same bits everywhere.
    pub seed: u64,
}

/// The half height of scenes with up to [`FLAT`] vertices.
const HALF_HEIGHT: f64 = 0.01;

/// With more vertices than this the slab of that height is thick compared with their distances.
const FLAT: f64 = 30_000.0;

impl Slab {
    /// The scene with about so many crossing tetrahedra. Large ones are as much flatter as their vertices are closer to
    /// each other, because in a thick slab many tetrahedra do not cross the rectangle.
    pub fn crossing(about: u64) -> Slab {
        let n = about as f64 / 3.3;
        let half_height = HALF_HEIGHT * (FLAT / n).sqrt().min(1.0);
        Slab {
            vertices: n as usize,
            half_height,
            seed: 1,
        }
    }

    /// For messages.
    pub fn name(&self) -> String {
        format!("{} vertices, seed {}", self.vertices, self.seed)
    }

    /// The PLC: the random vertices 0, …, n − 1, then the corners of the rectangle, which is the only facet, with
    /// marker 1.
    ///
    /// # Panics
    /// If the half height is not positive, finite and normal.
    pub fn plc(&self) -> Plc {
        assert!(
            self.half_height.is_normal() && self.half_height > 0.0,
            "the slab has a height"
        );
        let mut random = ChaCha8Rng::seed_from_u64(self.seed);
        let mut vertices: Vec<[f64; 3]> = (0..self.vertices)
            .map(|_| {
                let [x, y, z] = std::array::from_fn(|_| odd_fraction(&mut random));
                [x, y, z * self.half_height]
            })
            .collect();
        let corners = (self.vertices..self.vertices + 4)
            .map(VertexId::new)
            .collect();
        let [x, y] = RECTANGLE;
        vertices.extend([[-x, -y, 0.0], [x, -y, 0.0], [x, y, 0.0], [-x, y, 0.0]]);
        let rectangle = Facet {
            polygons: vec![corners],
            holes: Vec::new(),
            marker: 1,
        };
        Plc {
            vertices,
            facets: vec![rectangle],
            ..Plc::default()
        }
    }
}

/// The scene, and what is inserted into it. The README of the package has the meaning of the columns.
#[allow(missing_docs)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct OfScene {
    pub seed: u64,
    pub vertices: usize,
    pub half_height: f64,
    pub steiner_points: usize,
    pub regions: u64,
    pub crossing_tets: u64,
}

impl OfScene {
    /// A scene before it is measured.
    pub fn new(slab: Slab) -> OfScene {
        let Slab {
            vertices,
            half_height,
            seed,
        } = slab;
        OfScene {
            seed,
            vertices,
            half_height,
            ..OfScene::default()
        }
    }
}

/// Uniform among the odd multiples of 2⁻⁵² in (−1, 1): symmetric and never zero. All of them are doubles. (Written
/// out rather than left to `rand`, whose distributions may change with its version.)
fn odd_fraction(random: &mut ChaCha8Rng) -> f64 {
    let odd = (random.next_u64() >> 12 << 1 | 1) as i64 - (1 << 52);
    odd as f64 * 2f64.powi(-52)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SLAB: Slab = Slab {
        vertices: 1000,
        half_height: 0.01,
        seed: 7,
    };

    #[test]
    fn vertices_fill_the_slab_but_not_its_middle() {
        let plc = SLAB.plc();
        assert_eq!(plc.vertices.len(), 1004);
        let random = &plc.vertices[..1000];
        assert!(random.iter().all(|p| p[2] != 0.0));
        for (axis, bound) in [1.0, 1.0, 0.01].into_iter().enumerate() {
            let x = || random.iter().map(|p| p[axis] / bound);
            assert!(x().all(|x| x.abs() < 1.0));
            let above = x().filter(|&x| x > 0.0).count();
            let outer = x().filter(|x| x.abs() > 0.5).count();
            assert!(
                [above, outer].iter().all(|n| (400..600).contains(n)),
                "{above} {outer}"
            );
        }
    }

    #[test]
    fn the_rectangle_cuts_through_the_hull() {
        let plc = SLAB.plc();
        let corners = plc.facets[0].polygons[0]
            .iter()
            .map(|v| plc.vertices[v.index()]);
        let expected = [
            [-1.25, -1.125],
            [1.25, -1.125],
            [1.25, 1.125],
            [-1.25, 1.125],
        ];
        assert!(corners.eq(expected.map(|[x, y]| [x, y, 0.0])));
        assert!(plc.vertices[..1000].iter().any(|p| p[2] > 0.0));
        assert!(plc.vertices[..1000].iter().any(|p| p[2] < 0.0));
    }

    #[test]
    fn one_seed_gives_one_scene() {
        assert_eq!(SLAB.plc(), SLAB.plc());
        assert_ne!(SLAB.plc(), Slab { seed: 8, ..SLAB }.plc());
        // A longer set begins with the shorter one.
        let longer = Slab {
            vertices: 2000,
            ..SLAB
        };
        assert_eq!(longer.plc().vertices[..1000], SLAB.plc().vertices[..1000]);
        // Should this change, results of old runs could not be compared.
        let first = [
            -0.684407805958761,
            -0.6640212744557974,
            0.004085522560729131,
        ];
        assert_eq!(SLAB.plc().vertices[0], first);
    }

    #[test]
    fn only_large_slabs_are_flatter() {
        assert_eq!(Slab::crossing(3300).half_height, HALF_HEIGHT);
        assert_eq!(Slab::crossing(0).half_height, HALF_HEIGHT);
        let large = Slab::crossing(1_000_000);
        let relative = large.half_height * (large.vertices as f64 / FLAT).sqrt();
        assert!((relative / HALF_HEIGHT - 1.0).abs() < 1e-5);
    }
}
