//! The walk to a point, the insertion of vertices one by one (Bowyer–Watson), and a Delaunay tetrahedralization as a
//! whole.

use super::inputs::{lattice, random, tetrahedralized, uniform};
use criterion::{BatchSize, Criterion, Throughput};
use rand::Rng;
use std::hint::black_box;
use tetflip::mesh::{TetId, VertexId};
use tetflip::predicate::DoublePoints;

/// Vertices of the mesh walked in.
const IN_MESH: usize = 100_000;
/// Points to walk to or to insert.
const NEW: usize = 1000;

/// From a random tetrahedron across the mesh, and from a tetrahedron that is near already.
pub fn walk(c: &mut Criterion) {
    let points = DoublePoints::new(uniform(IN_MESH + NEW));
    let mut delaunay = tetrahedralized(&points, IN_MESH);
    let all: Vec<TetId> = delaunay.mesh.finite().collect();
    let mut random = random();
    let targets: Vec<VertexId> = (IN_MESH..IN_MESH + NEW).map(VertexId::new).collect();
    let far: Vec<TetId> = (0..NEW)
        .map(|_| all[random.random_range(0..all.len())])
        .collect();
    // A tetrahedron at a vertex of the one that contains the point.
    let mut near = Vec::new();
    for &p in &targets {
        let at = delaunay.locate(&points, p);
        let neighbor = delaunay.mesh.neighbor(at.corner(0));
        near.push(delaunay.mesh.neighbor(neighbor.corner(1)));
    }
    let mut group = c.benchmark_group("walk");
    group.throughput(Throughput::Elements(NEW as u64));
    for (name, starts) in [("across 100000 vertices", far), ("from nearby", near)] {
        group.bench_function(name, |b| {
            b.iter(|| {
                for (&p, &start) in targets.iter().zip(&starts) {
                    delaunay.start_at(start);
                    black_box(delaunay.locate(&points, p));
                }
            });
        });
    }
    group.finish();
}

/// New vertices into a mesh, one after the other: walk, conflict zone and star.
pub fn insertion(c: &mut Criterion) {
    let inputs = [
        ("uniform", uniform(20_000 + NEW), 20_000),
        ("lattice", lattice(28), 28 * 28 * 28 - NEW),
    ];
    let mut group = c.benchmark_group("insertion");
    group.throughput(Throughput::Elements(NEW as u64));
    for (name, points, before) in inputs {
        let last = points.len();
        let points = DoublePoints::new(points);
        let delaunay = tetrahedralized(&points, before);
        group.bench_function(name, |b| {
            b.iter_batched_ref(
                || delaunay.clone(),
                |delaunay| {
                    for v in (before..last).map(VertexId::new) {
                        delaunay.insert(&points, v);
                    }
                },
                BatchSize::PerIteration,
            );
        });
    }
    group.finish();
}

pub fn tetrahedralization(c: &mut Criterion) {
    let mut group = c.benchmark_group("delaunay");
    group.sample_size(10);
    let inputs = [
        ("100000 uniform points", uniform(IN_MESH)),
        ("46^3 points of a lattice", lattice(46)),
    ];
    for (name, points) in inputs {
        let n = points.len();
        group.throughput(Throughput::Elements(n as u64));
        let points = DoublePoints::new(points);
        group.bench_function(name, |b| b.iter(|| tetrahedralized(&points, n)));
    }
    group.finish();
}
