//! `boxes`: what comes out of a modelling program: grids of boxes with some inner walls, and points inside. Every box
//! has eight cospherical corners.
//!
//! - `cubes`: a grid of up to 2×2×2 cubes.
//! - `boxes`: the same with planes at unequal distances, decimal fractions that are rounded to doubles.

use super::{Draw, Family, facet};
use tetflip::exchange::Plc;

/// The family.
pub const FAMILY: Family = Family {
    name: "boxes",
    subfamilies: &["cubes", "boxes"],
    candidate,
};

fn candidate(subfamily: &str, draw: &mut Draw) -> Plc {
    let n = [draw.int(1, 2), draw.int(1, 2), draw.int(1, 2)];
    let mut planes: [Vec<f64>; 3] =
        [0, 1, 2].map(|axis: usize| (0..=n[axis]).map(f64::from).collect());
    if subfamily == "boxes" {
        for (i, x) in planes.iter_mut().flatten().enumerate() {
            *x += f64::from(draw.int(-3, 3) + i as i32 % 2) / 10.0;
        }
    }
    let mut plc = Plc::default();
    let size = n.map(|n| n as usize);
    grid(&mut plc, size, &planes, draw);
    for _ in 0..draw.int(4, 30) {
        let p: [f64; 3] = std::array::from_fn(|axis| {
            let cell = draw.below(size[axis]);
            let (low, high) = (planes[axis][cell], planes[axis][cell + 1]);
            low + (high - low) * f64::from(draw.int(1, 7)) / 8.0
        });
        if !plc.vertices.contains(&p) {
            plc.vertices.push(p);
        }
    }
    plc
}

/// The corners of all boxes, all outer rectangles, and half of the inner ones.
fn grid(plc: &mut Plc, n: [usize; 3], planes: &[Vec<f64>; 3], draw: &mut Draw) {
    let id = |p: [usize; 3]| (p[0] * (n[1] + 1) + p[1]) * (n[2] + 1) + p[2];
    for &x in &planes[0] {
        for &y in &planes[1] {
            plc.vertices.extend(planes[2].iter().map(|&z| [x, y, z]));
        }
    }
    for axis in 0..3 {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        for level in 0..=n[axis] {
            let is_outer = level == 0 || level == n[axis];
            for (i, j) in (0..n[u]).flat_map(|i| (0..n[v]).map(move |j| (i, j))) {
                let corner = |[di, dj]: [usize; 2]| {
                    let mut p = [0; 3];
                    (p[axis], p[u], p[v]) = (level, i + di, j + dj);
                    id(p)
                };
                if is_outer || draw.once_in(2) {
                    let corners = [[0, 0], [1, 0], [1, 1], [0, 1]].map(corner);
                    plc.facets.push(facet(corners));
                }
            }
        }
    }
}
