//! `crossing-planes`: several polygons, inserted one after the other, so that a flip must respect those that are there.
//!
//! - `cross`: four rectangles in two axis planes that cross in a common segment, among lattice points.
//! - `cross-random`: the same among points in general position.
//! - `fan`: three to six rectangles on one common segment, in planes with integer normals.
//! - `parallel`: rectangles one above the other, with lattice points between them.

use super::{Draw, Family, doubles, facet};
use tetflip::exchange::Plc;

/// The family.
pub const FAMILY: Family = Family {
    name: "crossing-planes",
    subfamilies: &["cross", "cross-random", "fan", "parallel"],
    candidate,
};

fn candidate(subfamily: &str, draw: &mut Draw) -> Plc {
    match subfamily {
        "cross" => cross(false, draw),
        "cross-random" => cross(true, draw),
        "fan" => fan(draw),
        _ => parallel(draw),
    }
}

/// Rectangles that share the segment of the vertices 0 and 1, each with two more vertices.
fn on_common_segment(vertices: Vec<[f64; 3]>, rectangles: usize) -> Plc {
    let sides = (0..rectangles).map(|i| facet([0, 1, 2 * i + 2, 2 * i + 3]));
    Plc {
        vertices,
        facets: sides.collect(),
        ..Plc::default()
    }
}

fn cross(random: bool, draw: &mut Draw) -> Plc {
    let [a, b, c] = [0; 3].map(|_: i32| draw.int(1, 3));
    let mut vertices = vec![[-a, 0, 0], [a, 0, 0]];
    for [y, z] in [[b, 0], [-b, 0], [0, c], [0, -c]] {
        vertices.extend([[a, y, z], [-a, y, z]]);
    }
    let mut vertices = doubles(vertices);
    let n = draw.int(4, 50) as usize;
    if random {
        vertices.extend((0..n).map(|_| draw.point().map(|x| 3.0 * x)));
    } else {
        let on = |p: &[i32; 3]| {
            (p[2] == 0 && p[1].abs() <= b || p[1] == 0 && p[2].abs() <= c) && p[0].abs() <= a
        };
        let others = draw.lattice_points(3, n).into_iter();
        vertices.extend(doubles(others.filter(|p| !on(p))));
    }
    on_common_segment(vertices, 4)
}

fn fan(draw: &mut Draw) -> Plc {
    let a = draw.int(1, 3);
    let mut directions = vec![
        [1, 0],
        [0, 1],
        [-1, 0],
        [0, -1],
        [1, 1],
        [-1, 1],
        [-1, -1],
        [1, -1],
        [2, 1],
        [-1, 2],
    ];
    draw.shuffle(&mut directions);
    directions.truncate(draw.int(3, 6) as usize);
    let mut vertices = vec![[-a, 0, 0], [a, 0, 0]];
    for &[y, z] in &directions {
        vertices.extend([[a, 2 * y, 2 * z], [-a, 2 * y, 2 * z]]);
    }
    let on = |p: &[i32; 3]| {
        let [x, y, z] = *p;
        let along = |&[dy, dz]: &[i32; 2]| {
            let t = y * dy + z * dz;
            y * dz == z * dy && (0..=2 * (dy * dy + dz * dz)).contains(&t)
        };
        x.abs() <= a && directions.iter().any(along)
    };
    let n = draw.int(20, 90) as usize;
    let others = draw.lattice_points(4, n).into_iter();
    vertices.extend(others.filter(|p| !on(p)));
    on_common_segment(doubles(vertices), directions.len())
}

fn parallel(draw: &mut Draw) -> Plc {
    let levels = draw.int(2, 4);
    let mut vertices = Vec::new();
    for level in 0..levels {
        let (x, y, z) = (draw.int(3, 5), draw.int(3, 5), 2 * level);
        vertices.extend([[-x, -y, z], [x, -y, z], [x, y, z], [-x, y, z]]);
    }
    for _ in 0..draw.int(8, 50) {
        let (x, y) = (draw.int(-3, 3), draw.int(-3, 3));
        vertices.push([x, y, 2 * draw.int(0, levels) - 1]);
    }
    let four = 4 * levels as usize;
    vertices[four..].sort_unstable();
    vertices.dedup();
    Plc {
        vertices: doubles(vertices),
        facets: (0..levels as usize)
            .map(|i| facet(4 * i..4 * i + 4))
            .collect(),
        ..Plc::default()
    }
}
