//! Inputs: boxes in every format.

use std::fmt::Write;

/// Two rooms with a wall between them and a block left out; the example of the README.
pub const ROOMS: &str = include_str!("../../../examples/rooms.poly");

pub type Point = [f64; 3];

/// The corners of a box, by the bits of their number: x, y, z.
pub fn box_corners([low, high]: [Point; 2]) -> Vec<Point> {
    let corner = |i: usize| {
        std::array::from_fn(|axis| {
            if i >> axis & 1 == 1 {
                high[axis]
            } else {
                low[axis]
            }
        })
    };
    (0..8).map(corner).collect()
}

/// The faces of a box, seen from outside.
pub const BOX_FACES: [[usize; 4]; 6] = [
    [0, 2, 3, 1],
    [4, 5, 7, 6],
    [0, 1, 5, 4],
    [2, 6, 7, 3],
    [0, 4, 6, 2],
    [1, 3, 7, 5],
];

pub const CUBE: [Point; 2] = [[0.0; 3], [1.0; 3]];

/// Boxes as a .poly file with a list of hole points. Vertices count from 1.
pub fn poly(boxes: &[[Point; 2]], holes: &[Point]) -> String {
    let mut text = format!("{} 3 0 0\n", 8 * boxes.len());
    for (i, [x, y, z]) in boxes.iter().flat_map(|&b| box_corners(b)).enumerate() {
        writeln!(text, "{} {x} {y} {z}", i + 1).expect("a string");
    }
    writeln!(text, "{} 0", 6 * boxes.len()).expect("a string");
    for first in (0..boxes.len()).map(|b| 8 * b + 1) {
        for face in BOX_FACES {
            let [a, b, c, d] = face.map(|v| v + first);
            writeln!(text, "1\n4 {a} {b} {c} {d}").expect("a string");
        }
    }
    writeln!(text, "{}", holes.len()).expect("a string");
    for (i, [x, y, z]) in holes.iter().enumerate() {
        writeln!(text, "{} {x} {y} {z}", i + 1).expect("a string");
    }
    text
}

/// The first `faces` faces of the cube as an OFF file.
pub fn off(faces: usize) -> String {
    let mut text = format!("OFF\n8 {faces} 0\n");
    for [x, y, z] in box_corners(CUBE) {
        writeln!(text, "{x} {y} {z}").expect("a string");
    }
    for [a, b, c, d] in &BOX_FACES[..faces] {
        writeln!(text, "4 {a} {b} {c} {d}").expect("a string");
    }
    text
}

/// The cube as an ASCII STL file of twelve triangles.
pub fn stl() -> String {
    let corners = box_corners(CUBE);
    let mut text = "solid cube\n".to_owned();
    for [a, b, c, d] in BOX_FACES {
        for triangle in [[a, b, c], [a, c, d]] {
            text += "facet normal 0 0 0\nouter loop\n";
            for [x, y, z] in triangle.map(|v| corners[v]) {
                writeln!(text, "vertex {x} {y} {z}").expect("a string");
            }
            text += "endloop\nendfacet\n";
        }
    }
    text + "endsolid cube\n"
}

/// A square: no tetrahedra.
pub const FLAT: &str = "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";
