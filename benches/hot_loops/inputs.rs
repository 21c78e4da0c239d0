//! The inputs, the same in every run.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tetflip::cdt::Cdt;
use tetflip::delaunay::{Delaunay, delaunay};
use tetflip::exchange::{Facet, Plc};
use tetflip::mesh::VertexId;
use tetflip::predicate::DoublePoints;
use tetflip::report::Report;

/// How many tuples of points predicates are asked about.
pub const TUPLES: usize = 1000;

/// The same random numbers every time.
pub fn random() -> ChaCha8Rng {
    ChaCha8Rng::seed_from_u64(1)
}

/// Five points per tuple, uniform in the unit cube: the filter decides.
pub fn generic() -> Vec<[f64; 3]> {
    uniform(5 * TUPLES)
}

/// Uniform in the unit cube.
pub fn uniform(n: usize) -> Vec<[f64; 3]> {
    let mut random = random();
    (0..n).map(|_| random.random()).collect()
}

/// Corners of one cube of the integer lattice per tuple: cospherical, the filter proves the zero.
pub fn cubes() -> Vec<[f64; 3]> {
    let mut random = random();
    let corners = |_| {
        let low: [u8; 3] = random.random();
        let mut bits: Vec<u8> = (0..8).collect();
        let five = (0..5).map(|_| bits.swap_remove(random.random_range(0..bits.len())));
        let five: Vec<[f64; 3]> = five
            .map(|i| [0, 1, 2].map(|axis| f64::from(low[axis]) + f64::from(i >> axis & 1)))
            .collect();
        five
    };
    (0..TUPLES).flat_map(corners).collect()
}

/// The same cubes with sides of 0.1, each coordinate moved by up to an ulp: the filter is not enough.
pub fn nearly_cubes() -> Vec<[f64; 3]> {
    let mut random = random();
    let mut moved = |x: f64| {
        let tenth = x * 0.1;
        match random.random_range(0..3) {
            0 => tenth.next_up(),
            1 => tenth.next_down(),
            _ => tenth,
        }
    };
    cubes().into_iter().map(|p| p.map(&mut moved)).collect()
}

/// All points of a lattice with n points along each side.
pub fn lattice(n: u32) -> Vec<[f64; 3]> {
    let place = |i: u32| [i % n, i / n % n, i / n / n].map(f64::from);
    (0..n * n * n).map(place).collect()
}

/// The Delaunay tetrahedralization of the first `n` points.
pub fn tetrahedralized(points: &DoublePoints, n: usize) -> Delaunay {
    let vertices: Vec<VertexId> = (0..n).map(VertexId::new).collect();
    delaunay(points, &vertices).expect("points that span space")
}

/// Random vertices in a slab around the plane z = 0, and a rectangle in that plane that cuts through all of it.
fn slab(n: usize) -> Plc {
    let mut random = random();
    let mut vertices: Vec<[f64; 3]> = (0..n)
        .map(|_| {
            let z: f64 = random.random_range(0.001..0.05);
            let side = if random.random() { z } else { -z };
            [
                random.random_range(-1.0..1.0),
                random.random_range(-1.0..1.0),
                side,
            ]
        })
        .collect();
    let corners = [
        [-1.25, -1.125],
        [1.25, -1.125],
        [1.25, 1.125],
        [-1.25, 1.125],
    ];
    vertices.extend(corners.map(|[x, y]| [x, y, 0.0]));
    let rectangle = Facet {
        polygons: vec![(n..n + 4).map(VertexId::new).collect()],
        ..Facet::default()
    };
    Plc {
        vertices,
        facets: vec![rectangle],
        ..Plc::default()
    }
}

/// The mesh of a slab with its rectangle's segments, before the rectangle: about 3.3 crossing tetrahedra per vertex.
pub fn before_polygon(vertices: usize) -> Cdt {
    Cdt::with_segments(&slab(vertices), true, &mut Report::default()).expect("a valid PLC")
}
