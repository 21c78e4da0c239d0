//! `near-coplanar`: all vertices within a few ulps, or less, of the polygon's plane. Their rates of growth are tiny and
//! so are the denominators of all flip times.
//!
//! - `ulps`: a rectangle in z = 0 and vertices with z = ±2⁻⁵², …, ±4·2⁻⁵².
//! - `mixed`: the same with z from 2⁻⁵² to 1, uniform in the exponent.
//! - `tilted`: a rectangle in the plane z = x, and vertices up to 4 ulps above or below it.
//! - `lattice`: as `ulps`, with x and y on a lattice: ties besides.

use super::{Draw, Family, one_polygon};
use tetflip::exchange::Plc;

/// The family.
pub const FAMILY: Family = Family {
    name: "near-coplanar",
    subfamilies: &["ulps", "mixed", "tilted", "lattice"],
    candidate,
};

fn candidate(subfamily: &str, draw: &mut Draw) -> Plc {
    let tilt = |x: f64| if subfamily == "tilted" { x } else { 0.0 };
    let corner = |x: f64, y: f64| [x, y, tilt(x)];
    let mut vertices = vec![
        corner(-1.25, -1.125),
        corner(1.25, -1.125),
        corner(1.25, 1.125),
        corner(-1.25, 1.125),
    ];
    for _ in 0..draw.int(8, 50) {
        let [mut x, mut y, _] = draw.point();
        if subfamily == "lattice" {
            (x, y) = (
                f64::from(draw.int(-4, 4)) / 4.0,
                f64::from(draw.int(-4, 4)) / 4.0,
            );
        }
        let ulps = f64::from(draw.sign() * draw.int(1, 4));
        let z = match subfamily {
            "tilted" => x * (1.0 + ulps * f64::EPSILON),
            "mixed" => ulps / 4.0 * 2f64.powi(-draw.int(0, 52)),
            _ => ulps * f64::EPSILON,
        };
        let p = [x, y, z];
        let is_twin = |q: &[f64; 3]| q[..2] == p[..2];
        if z != tilt(x) && !vertices.iter().any(is_twin) {
            vertices.push(p);
        }
    }
    one_polygon(vertices, 4)
}
