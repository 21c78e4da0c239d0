//! `sphere`: many vertices on one sphere. All of their insphere determinants are zero, so the Delaunay
//! tetrahedralization is the perturbation's choice, and so is the order of nearly all flips.
//!
//! - `centre`: integer points on a sphere around the origin, exactly cospherical, and a rectangle through the centre
//!   that is larger than the sphere. No vertex but its corners is in its plane.
//! - `cap`: the same, but the plane of the rectangle passes beside the centre.
//! - `shells`: integer points on two or three concentric spheres.
//! - `rounded`: random points of the unit sphere, rounded: cospherical but for an ulp or so.

use super::{Draw, Family, doubles, one_polygon};
use tetflip::exchange::Plc;

/// The family.
pub const FAMILY: Family = Family {
    name: "sphere",
    subfamilies: &["centre", "cap", "shells", "rounded"],
    candidate,
};

fn candidate(subfamily: &str, draw: &mut Draw) -> Plc {
    let n = draw.int(6, 50) as usize;
    if subfamily == "rounded" {
        return rounded(n, draw);
    }
    let c = if subfamily == "cap" {
        draw.int(1, 3)
    } else {
        0
    };
    // Numbers with many sums of three squares.
    let mut squares = vec![26, 29, 41, 50, 54, 65, 66, 74, 81, 89];
    draw.shuffle(&mut squares);
    squares.truncate(if subfamily == "shells" {
        draw.int(2, 3) as usize
    } else {
        1
    });
    let mut on_spheres: Vec<[i32; 3]> = squares.into_iter().flat_map(sphere_points).collect();
    on_spheres.retain(|p| p[2] != c);
    draw.shuffle(&mut on_spheres);
    on_spheres.truncate(n);
    let (a, b) = (draw.int(10, 12), draw.int(10, 12));
    let mut points = vec![[-a, -b, c], [a, -b, c], [a, b, c], [-a, b, c]];
    points.extend(on_spheres);
    one_polygon(doubles(points), 4)
}

/// All integer points p with |p|² = `square`.
fn sphere_points(square: i32) -> Vec<[i32; 3]> {
    let r = square.isqrt();
    let all = (-r..=r).flat_map(|x| (-r..=r).flat_map(move |y| (-r..=r).map(move |z| [x, y, z])));
    all.filter(|p| p.iter().map(|x| x * x).sum::<i32>() == square)
        .collect()
}

fn rounded(n: usize, draw: &mut Draw) -> Plc {
    let (x, y) = (1.25, 1.125);
    let mut vertices = vec![[-x, -y, 0.0], [x, -y, 0.0], [x, y, 0.0], [-x, y, 0.0]];
    for _ in 0..n {
        let p = draw.point();
        let r = p.iter().map(|x| x * x).sum::<f64>().sqrt();
        vertices.push(p.map(|x| x / r));
    }
    one_polygon(vertices, 4)
}
