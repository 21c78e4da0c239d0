//! `random`: vertices and a polygon in general position: no five vertices on a sphere, no four on a circle or a plane
//! but for the polygon's own, which are on its plane and on no circle. Nothing is nasty here; it is the control.
//!
//! - `triangle`: a large triangle through a slab of one of three thicknesses.
//! - `quadrilateral`: the same with a quadrilateral.
//! - `tilted`: a quadrilateral in a tilted plane, with integer corners.
//! - `inside`: a quadrilateral that ends inside the hull; its edges need Steiner points.

use super::{Draw, Family, one_polygon};
use crate::families::lattice::tilted_axes;
use tetflip::exchange::Plc;

/// The family.
pub const FAMILY: Family = Family {
    name: "random",
    subfamilies: &["triangle", "quadrilateral", "tilted", "inside"],
    candidate,
};

fn candidate(subfamily: &str, draw: &mut Draw) -> Plc {
    let n = draw.int(8, 56) as usize;
    let mut half_height = 1.0;
    let corners: Vec<[f64; 3]> = match subfamily {
        "triangle" => {
            half_height = draw.pick(&[1.0, 0.1, 0.01]);
            near(&[[-4.0, -3.0], [4.0, -3.0], [0.0, 5.0]], 0.5, draw)
        }
        "quadrilateral" => {
            half_height = draw.pick(&[1.0, 0.1, 0.01]);
            let corners = [[-2.0, -2.0], [2.0, -2.0], [2.0, 2.0], [-2.0, 2.0]];
            near(&corners, 0.5, draw)
        }
        "tilted" => tilted(draw),
        _ => {
            let (x, y) = (0.625, 0.5);
            near(&[[-x, -y], [x, -y], [x, y], [-x, y]], 0.125, draw)
        }
    };
    let count = corners.len();
    let mut vertices = corners;
    vertices.extend((0..n).map(|_| {
        let [x, y, z] = draw.point();
        [x, y, half_height * z]
    }));
    one_polygon(vertices, count)
}

/// Corners in the plane z = 0, each at most so far from the given one along each axis.
fn near(corners: &[[f64; 2]], radius: f64, draw: &mut Draw) -> Vec<[f64; 3]> {
    let corner = |[x, y]: &[f64; 2]| {
        let [dx, dy] = [draw.fraction(), draw.fraction()];
        [x + radius * dx, y + radius * dy, 0.0]
    };
    corners.iter().map(corner).collect()
}

/// A quadrilateral with one corner in each quadrant of a tilted plane. It contains a rectangle that is larger than the
/// cube of the points, and is convex: every corner is at least twice the axes from the middle, its neighbours at most
/// five times.
fn tilted(draw: &mut Draw) -> Vec<[f64; 3]> {
    let (u, v) = tilted_axes(draw);
    let dot = |a: [i32; 3]| i64::from(a.iter().map(|x| x * x).sum::<i32>());
    loop {
        let corners = [[-1, -1], [1, -1], [1, 1], [-1, 1]]
            .map(|[i, j]: [i32; 2]| [i * draw.int(2, 5), j * draw.int(2, 5)]);
        // The axes are orthogonal: along them, squares are multiples of theirs.
        let rows = corners.map(|[i, j]| {
            let [i, j] = [i64::from(i), i64::from(j)];
            [i, j, i * i * dot(u) + j * j * dot(v)]
        });
        if !is_on_one_circle(rows) {
            let point = |[i, j]: [i32; 2]| std::array::from_fn(|k| f64::from(i * u[k] + j * v[k]));
            return corners.map(point).to_vec();
        }
    }
}

/// Whether four points with the given squares of their distances from the origin are on one circle.
fn is_on_one_circle(rows: [[i64; 3]; 4]) -> bool {
    let [a, b, c] = [0, 1, 2].map(|i: usize| [0, 1, 2].map(|k: usize| rows[i][k] - rows[3][k]));
    let minor = |i: usize, j: usize| b[i] * c[j] - b[j] * c[i];
    a[0] * minor(1, 2) - a[1] * minor(0, 2) + a[2] * minor(0, 1) == 0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn circles_are_recognized() {
        let row = |x: i64, y: i64| [x, y, x * x + y * y];
        assert!(is_on_one_circle([
            row(0, 5),
            row(3, 4),
            row(-5, 0),
            row(4, -3)
        ]));
        assert!(!is_on_one_circle([
            row(0, 5),
            row(3, 4),
            row(-5, 0),
            row(4, -2)
        ]));
    }

    #[test]
    fn tilted_quadrilaterals_are_convex() {
        let mut draw = Draw::new(1, 0);
        for _ in 0..500 {
            let p = tilted(&mut draw);
            let minus = |i: usize, j: usize| [0, 1, 2].map(|k: usize| p[i % 4][k] - p[j % 4][k]);
            let cross = |a: [f64; 3], b: [f64; 3]| {
                let minor = |i: usize, j: usize| a[i] * b[j] - a[j] * b[i];
                [minor(1, 2), minor(2, 0), minor(0, 1)]
            };
            let turn = |i: usize| cross(minus(i + 1, i), minus(i + 2, i + 1));
            let first = turn(0);
            for i in 1..4 {
                let along: f64 = turn(i).iter().zip(first).map(|(a, b)| a * b).sum();
                assert!(along > 0.0, "{p:?}");
            }
        }
    }
}
