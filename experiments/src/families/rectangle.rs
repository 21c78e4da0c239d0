//! `rectangle`: vertices in general position, but for four corners of the polygon, which are on one circle. That alone
//! forces ties: lifted to the paraboloid such corners are on one plane, so that for any two vertices v and w on both
//! sides, the circuits of v, w and any three of the corners are due at one time.
//!
//! - `slab`: the scene of Fig. 8, of three thicknesses.
//! - `hexagon`: a hexagon, four of whose corners are on one circle.
//! - `tilted`: a large rectangle in a tilted plane, with integer corners.
//! - `inside`: a rectangle that ends inside the hull; its edges need Steiner points.

use super::{Draw, Family, one_polygon};
use crate::families::lattice::tilted_axes;
use crate::inputs::slab::Slab;
use tetflip::exchange::Plc;

/// The family.
pub const FAMILY: Family = Family {
    name: "rectangle",
    subfamilies: &["slab", "hexagon", "tilted", "inside"],
    candidate,
};

fn candidate(subfamily: &str, draw: &mut Draw) -> Plc {
    let n = draw.int(8, 56) as usize;
    let corners: Vec<[f64; 3]> = match subfamily {
        "slab" => {
            return Slab {
                vertices: n,
                half_height: draw.pick(&[1.0, 0.1, 0.01]),
                seed: draw.bits(),
            }
            .plc();
        }
        "hexagon" => [[5, 0], [2, 4], [-3, 4], [-5, 0], [-2, -4], [3, -4]]
            .map(|[x, y]| [f64::from(x) / 2.0, f64::from(y) / 2.0, 0.0])
            .to_vec(),
        "tilted" => {
            let (u, v) = tilted_axes(draw);
            let corner =
                |i: i32, j: i32| std::array::from_fn(|k| f64::from(2 * (i * u[k] + j * v[k])));
            vec![corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)]
        }
        _ => [[-1, -1], [1, -1], [1, 1], [-1, 1]]
            .map(|[x, y]| [0.625 * f64::from(x), 0.5 * f64::from(y), 0.0])
            .to_vec(),
    };
    let count = corners.len();
    let mut vertices = corners;
    vertices.extend((0..n).map(|_| draw.point()));
    one_polygon(vertices, count)
}
