//! Where the time goes, loop by loop: the predicates on easy and on degenerate points, the walk and the insertion of
//! the Delaunay tetrahedralization, and the flip times, the queue and the flips of a polygon's insertion; then a
//! polygon as a whole, by each method, in a scene like that of the paper's Fig. 8.
//!
//! `cargo bench` runs all, `cargo bench -- insphere` some, `cargo bench -- --test` each once.

mod delaunay;
mod flips;
mod inputs;
mod polygon;
mod predicates;

use criterion::{Criterion, criterion_group, criterion_main};
use std::time::Duration;

criterion_group! {
    name = hot_loops;
    config = Criterion::default()
        .sample_size(20)
        .warm_up_time(Duration::from_millis(500))
        .measurement_time(Duration::from_secs(2));
    targets = predicates::predicates, delaunay::walk, delaunay::insertion, delaunay::tetrahedralization,
    flips::flip_times,
        flips::comparison, flips::queue, flips::flips, polygon::insertion
}
criterion_main!(hot_loops);
