//! One polygon as a whole, by each method.

use super::inputs::before_polygon;
use criterion::{BatchSize, Criterion, Throughput};
use tetflip::cdt::Cdt;
use tetflip::recover::polygons::{FlipOrder, Insertion, NumberType};
use tetflip::report::Report;

pub fn insertion(c: &mut Criterion) {
    let before = before_polygon(1500);
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
        (
            "flips f64",
            Insertion::Flip(FlipOrder::new(NumberType::F64Plain)),
        ),
        ("flips filtered", Insertion::Flip(FlipOrder::FILTERED)),
        ("flips exact", Insertion::Flip(FlipOrder::EXACT)),
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
