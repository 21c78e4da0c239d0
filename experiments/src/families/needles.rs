//! `needles`: extremely anisotropic vertex sets. Determinants are sums of terms of very different sizes, and rounding
//! takes a large part of the result.
//!
//! - `stretched`: general position, one axis stretched by up to 2⁴⁰, another by up to 2²⁰.
//! - `lattice`: the same with lattice points.
//! - `needle`: vertices in two or three tiny clusters far apart.

use super::{Draw, Family, one_polygon};
use tetflip::exchange::Plc;

/// The family.
pub const FAMILY: Family = Family {
    name: "needles",
    subfamilies: &["stretched", "lattice", "needle"],
    candidate,
};

fn candidate(subfamily: &str, draw: &mut Draw) -> Plc {
    let n = draw.int(8, 50) as usize;
    let mut points: Vec<[f64; 3]> = match subfamily {
        "stretched" => (0..n).map(|_| draw.point()).collect(),
        "lattice" => {
            let points = draw.lattice_points(2, n).into_iter();
            let half = |p: [i32; 3]| p.map(|x| f64::from(x) / 2.0);
            points.filter(|p| p[2] != 0).map(half).collect()
        }
        _ => clusters(n, draw),
    };
    let (x, y) = (1.25, 1.125);
    let mut vertices = vec![[-x, -y, 0.0], [x, -y, 0.0], [x, y, 0.0], [-x, y, 0.0]];
    vertices.append(&mut points);
    let mut exponents = [draw.int(10, 40), draw.int(0, 20), 0];
    if subfamily == "needle" {
        exponents = [0; 3];
    }
    draw.shuffle(&mut exponents);
    let factors = exponents.map(|e| 2f64.powi(e));
    let scaled = |p: [f64; 3]| [0, 1, 2].map(|i: usize| p[i] * factors[i]);
    one_polygon(vertices.into_iter().map(scaled).collect(), 4)
}

/// Points near two or three places in the cube.
fn clusters(n: usize, draw: &mut Draw) -> Vec<[f64; 3]> {
    let size = 2f64.powi(-draw.int(5, 25));
    let places: Vec<[f64; 3]> = (0..draw.int(2, 3))
        .map(|_| {
            let [x, y, z] = draw.point();
            // Half of the clusters are on both sides of the rectangle.
            [
                x / 2.0,
                y / 2.0,
                if draw.once_in(2) { 0.0 } else { z / 2.0 },
            ]
        })
        .collect();
    let near = |_| {
        let (place, offset) = (draw.pick(&places), draw.point());
        [0, 1, 2].map(|i: usize| place[i] + size * offset[i])
    };
    (0..n).map(near).collect()
}
