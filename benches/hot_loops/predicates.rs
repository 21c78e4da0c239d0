//! orient3d and insphere where the filter decides, where it proves a zero, and where it is not enough.

use super::inputs::{TUPLES, cubes, generic, nearly_cubes};
use criterion::{Criterion, Throughput};
use std::hint::black_box;
use tetflip::mesh::VertexId;
use tetflip::predicate::{DoublePoints, PointStore};

pub fn predicates(c: &mut Criterion) {
    let families = [
        ("generic", generic()),
        ("lattice", cubes()),
        ("nearly degenerate", nearly_cubes()),
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
