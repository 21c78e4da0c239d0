//! `lattice`: lattice points and a rectangle with corners on the lattice. Doubles hold all products of such small
//! integers, so that float times are correctly rounded; but many of them are equal, and the order of equal ones is
//! decided by the perturbation, of which floats know nothing.
//!
//! - `axis`: the rectangle in the plane z = 0, lattice points around it, some of them on its plane.
//! - `tilted`: in one of several planes with integer normals.
//! - `layers`: a nearly full lattice of layers, cut in the middle between two.
//! - `jitter-17` … `jitter-4`: as `axis`, but all vertices except the corners are moved by up to 2·10⁻¹⁷ … 2·10⁻⁴ along
//!   each axis (what of it is below half an ulp is lost): ties become near ties, and then none.

use super::{Draw, Family, doubles, one_polygon};
use tetflip::exchange::Plc;

/// The family.
pub const FAMILY: Family = Family {
    name: "lattice",
    subfamilies: &[
        "axis",
        "tilted",
        "layers",
        "jitter-17",
        "jitter-16",
        "jitter-15",
        "jitter-14",
        "jitter-12",
        "jitter-8",
        "jitter-4",
    ],
    candidate,
};

fn candidate(subfamily: &str, draw: &mut Draw) -> Plc {
    match subfamily {
        "axis" => around_rectangle(axis_axes(draw), draw),
        "tilted" => around_rectangle(tilted_axes(draw), draw),
        "layers" => layers(draw),
        jitter => {
            let exponent = jitter
                .strip_prefix("jitter")
                .expect("a subfamily of this family");
            // Parsing rounds correctly on all platforms, `powi` need not.
            let step = format!("1e{exponent}").parse();
            jittered(step.expect("a number"), draw)
        }
    }
}

/// Orthogonal half sides of a rectangle.
type Axes = ([i32; 3], [i32; 3]);

fn axis_axes(draw: &mut Draw) -> Axes {
    ([draw.int(1, 3), 0, 0], [0, draw.int(1, 3), 0])
}

/// Half sides that span a plane with the normal (0,1,−1), (1,−1,0), (1,−1,−2), or (1,−2,5) times a number.
pub fn tilted_axes(draw: &mut Draw) -> Axes {
    let (w, h) = (draw.int(1, 3), draw.int(1, 3));
    match draw.below(4) {
        0 => ([w, 0, 0], [0, h, h]),
        1 => ([w, w, 0], [0, 0, h]),
        2 => ([w, w, 0], [h, -h, h]),
        _ => ([2 * w, w, 0], [-1, 2, 1]),
    }
}

fn corners((u, v): Axes) -> [[i32; 3]; 4] {
    [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(|[i, j]| [0, 1, 2].map(|k: usize| i * u[k] + j * v[k]))
}

/// Whether p is in the rectangle ±u±v, or on its boundary.
fn is_on_rectangle((u, v): Axes, p: [i32; 3]) -> bool {
    let dot = |a: [i32; 3], b: [i32; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let normal = [
        u[1] * v[2] - u[2] * v[1],
        u[2] * v[0] - u[0] * v[2],
        u[0] * v[1] - u[1] * v[0],
    ];
    dot(p, normal) == 0 && dot(p, u).abs() <= dot(u, u) && dot(p, v).abs() <= dot(v, v)
}

fn around_rectangle(axes: Axes, draw: &mut Draw) -> Plc {
    let (r, n) = (draw.int(2, 3), draw.int(6, 60) as usize);
    let mut points = corners(axes).to_vec();
    let others = draw.lattice_points(r, n);
    points.extend(others.into_iter().filter(|&p| !is_on_rectangle(axes, p)));
    one_polygon(doubles(points), 4)
}

fn layers(draw: &mut Draw) -> Plc {
    let size = [draw.int(2, 4), draw.int(2, 4), 2 * draw.int(1, 2)];
    let mut points = Vec::new();
    let missing = draw.int(3, 20) as usize;
    for x in 0..size[0] {
        for y in 0..size[1] {
            for z in 0..size[2] {
                if !draw.once_in(missing) {
                    points.push([2 * x, 2 * y, 2 * z + 1 - size[2]]);
                }
            }
        }
    }
    let (x, y) = (2 * size[0] - 1, 2 * size[1] - 1);
    let mut all = vec![[-1, -1, 0], [x, -1, 0], [x, y, 0], [-1, y, 0]];
    all.append(&mut points);
    one_polygon(doubles(all), 4)
}

fn jittered(step: f64, draw: &mut Draw) -> Plc {
    let axes = axis_axes(draw);
    let (u, v) = axes;
    let (r, n) = (draw.int(2, 3), draw.int(6, 60) as usize);
    let mut vertices = doubles(corners(axes));
    for p in draw.lattice_points(r, n) {
        let moved = p.map(|x| f64::from(x) + f64::from(draw.int(-2, 2)) * step);
        // Neither on the rectangle nor so close to its edges that they would need Steiner points close to each other.
        let inside = p[0].abs() < u[0] && p[1].abs() < v[1];
        if !is_on_rectangle(axes, p) || inside && moved[2] != 0.0 {
            vertices.push(moved);
        }
    }
    one_polygon(vertices, 4)
}
