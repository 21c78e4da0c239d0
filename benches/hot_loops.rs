//! Where the time goes: the predicates on easy and on degenerate points, the Delaunay tetrahedralization, and the
//! insertion of one polygon into a scene like that of the paper's Fig. 8, by each method.
//!
//! `cargo bench` runs all, `cargo bench -- insphere` some, `cargo bench -- --test` each once.

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::hint::black_box;
use std::time::Duration;
use tetflip::cdt::Cdt;
use tetflip::delaunay::delaunay;
use tetflip::mesh::VertexId;
use tetflip::plc::{Facet, Plc};
use tetflip::predicate::{DoublePoints, PointStore};
use tetflip::recover::polygons::{Insertion, Times};
use tetflip::report::Report;

const TUPLES: usize = 1000;

fn random() -> ChaCha8Rng {
    ChaCha8Rng::seed_from_u64(1)
}

/// Five points per tuple, uniform in the unit cube: the filter decides.
fn generic() -> Vec<[f64; 3]> {
    let mut random = random();
    (0..5 * TUPLES).map(|_| random.random()).collect()
}

/// Corners of one cube of the integer lattice per tuple: cospherical, the filter proves the zero.
fn lattice() -> Vec<[f64; 3]> {
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
fn nearly_degenerate() -> Vec<[f64; 3]> {
    let mut random = random();
    let mut moved = |x: f64| {
        let tenth = x * 0.1;
        match random.random_range(0..3) {
            0 => tenth.next_up(),
            1 => tenth.next_down(),
            _ => tenth,
        }
    };
    lattice().into_iter().map(|p| p.map(&mut moved)).collect()
}

fn predicates(c: &mut Criterion) {
    let families = [
        ("generic", generic()),
        ("lattice", lattice()),
        ("nearly degenerate", nearly_degenerate()),
    ];
    for (family, points) in families {
        let points = DoublePoints::new(points);
        let tuples: Vec<[VertexId; 5]> = (0..TUPLES)
            .map(|i| std::array::from_fn(|j| VertexId::new(5 * i + j)))
            .collect();
        let mut group = c.benchmark_group("orient3d");
        group.throughput(Throughput::Elements(TUPLES as u64));
        group.bench_function(family, |b| {
            b.iter(|| {
                for &[p, q, r, s, _] in &tuples {
                    black_box(points.orient3d(black_box([p, q, r, s])));
                }
            });
        });
        group.finish();
        let mut group = c.benchmark_group("insphere");
        group.throughput(Throughput::Elements(TUPLES as u64));
        group.bench_function(family, |b| {
            b.iter(|| {
                for &tuple in &tuples {
                    black_box(points.insphere(black_box(tuple)));
                }
            });
        });
        group.finish();
    }
}

fn tetrahedralization(c: &mut Criterion) {
    const N: usize = 100_000;
    let mut random = random();
    let points = DoublePoints::new((0..N).map(|_| random.random()).collect());
    let all: Vec<VertexId> = (0..N).map(VertexId::new).collect();
    let mut group = c.benchmark_group("delaunay");
    group
        .sample_size(10)
        .throughput(Throughput::Elements(N as u64));
    group.bench_function("100000 uniform points", |b| {
        b.iter(|| delaunay(&points, &all).expect("points that span space"));
    });
    group.finish();
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

fn polygon_insertion(c: &mut Criterion) {
    // About 3.3 crossing tetrahedra per vertex.
    let plc = slab(1500);
    let before = Cdt::with_segments(&plc, true, &mut Report::default()).expect("a valid PLC");
    let insert = |cdt: &mut Cdt, insertion| {
        let counts = cdt.insert_polygons(insertion, &mut Report::default(), &mut |_| {});
        counts.expect("a polygon that can be inserted")
    };
    let crossing = insert(&mut before.clone(), Insertion::Cavity).crossing_tets;
    let mut group = c.benchmark_group(format!("polygon across {crossing} tetrahedra"));
    group
        .sample_size(10)
        .throughput(Throughput::Elements(crossing));
    for (name, insertion) in [
        ("cavity", Insertion::Cavity),
        ("flips f64", Insertion::Flip(Times::F64)),
        ("flips exact", Insertion::Flip(Times::Exact)),
    ] {
        group.bench_function(name, |b| {
            b.iter_batched_ref(
                || before.clone(),
                |cdt| insert(cdt, insertion),
                BatchSize::PerIteration,
            );
        });
    }
    group.finish();
}

criterion_group! {
    name = hot_loops;
    config = Criterion::default()
        .sample_size(20)
        .warm_up_time(Duration::from_millis(500))
        .measurement_time(Duration::from_secs(2));
    targets = predicates, tetrahedralization, polygon_insertion
}
criterion_main!(hot_loops);
