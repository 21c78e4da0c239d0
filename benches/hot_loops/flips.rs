//! What insertion by flips is made of: flip times, their comparison, the queue, and the three flips.

use super::inputs::{before_polygon, lattice, tetrahedralized, uniform};
use criterion::{BatchSize, Criterion, Throughput};
use rustc_hash::FxHashSet;
use std::hint::black_box;
use tetflip::cdt::Cdt;
use tetflip::kinetic::{EventQueue, TimeOrder};
use tetflip::mesh::{Corner, TetId, TetMesh};
use tetflip::number::Dyadic;
use tetflip::predicate::{DoublePoints, PointStore};
use tetflip::recover::flips::{
    Evaluation, Event, ExactTimes, FilteredTimes, Flip, FlipKind, FlipTimes, PolygonMotion,
    RoundedTimes, Rules, Signs, flip_of_triangle,
};
use tetflip::recover::region::Region;
use tetflip::recover::region::{Side, Sides};

/// The mesh of a slab and the crossing triangles of its rectangle, which are all certified first.
struct Scene {
    cdt: Cdt,
    triangles: Vec<Event>,
}

impl Scene {
    fn new() -> Scene {
        let cdt = before_polygon(1500);
        let polygon = &cdt.complex().polygons[0];
        let sides = Sides::new(cdt.points(), polygon, polygon.vertices.iter().copied());
        let mut finite = cdt.mesh().finite();
        let seed = finite.find(|&t| sides.crosses_tet(cdt.mesh(), t));
        let region = Region::grow(
            cdt.mesh(),
            &sides,
            seed.expect("the rectangle cuts the slab"),
        );
        let event = |c: Corner| {
            let [x, y, z] = cdt.mesh().facet(c);
            Event {
                circuit: [cdt.mesh().vertex(c), x, y, z, cdt.mesh().apex_across(c)],
                tet: c.tet(),
                signs: Signs::UNKNOWN,
            }
        };
        let corners = region.crossing_triangles(cdt.mesh(), &sides);
        let triangles = corners.into_iter().map(event).collect();
        drop(finite);
        Scene { cdt, triangles }
    }

    /// Lets `task` work with what moves while the rectangle is inserted.
    fn with_motion<T>(&self, task: impl FnOnce(&PolygonMotion<'_, DoublePoints>) -> T) -> T {
        let polygon = &self.cdt.complex().polygons[0];
        let sides = Sides::new(self.cdt.points(), polygon, polygon.vertices.iter().copied());
        let is_left = |v| sides.of(v) == Side::Left;
        task(&PolygonMotion::new(
            self.cdt.points(),
            polygon.frame,
            &is_left,
        ))
    }
}

fn rounded<'a>(motion: &'a PolygonMotion<'a, DoublePoints>) -> RoundedTimes<'a, DoublePoints, f64> {
    RoundedTimes::new(motion, Evaluation::Plain, Rules::default())
}

/// Event by event, as rounded, filtered and exact numbers.
pub fn flip_times(c: &mut Criterion) {
    fn time_all<C: FlipTimes>(times: &mut C, events: &[Event]) {
        for event in events {
            black_box(times.time(black_box(event.circuit)));
        }
    }
    let scene = Scene::new();
    let mut group = c.benchmark_group("flip time");
    group.throughput(Throughput::Elements(scene.triangles.len() as u64));
    scene.with_motion(|motion| {
        let mut f64s = rounded(motion);
        group.bench_function("f64", |b| b.iter(|| time_all(&mut f64s, &scene.triangles)));
        let mut filtered = FilteredTimes::new(motion);
        group.bench_function("filtered", |b| {
            b.iter(|| time_all(&mut filtered, &scene.triangles));
        });
        let mut exact = ExactTimes::<_, Dyadic>::new(motion);
        group.bench_function("exact", |b| {
            b.iter(|| time_all(&mut exact, &scene.triangles));
        });
    });
    group.finish();
}

/// The events of the scene with their times, as many as there are.
fn timed<C: FlipTimes>(times: &mut C, events: &[Event]) -> Vec<Timed<C::Order>> {
    let timed = events.iter().filter_map(|event| {
        let due = times.time(event.circuit)?;
        Some((*event, due.key, due.time))
    });
    timed.collect()
}

/// An event with its time.
type Timed<O> = (Event, <O as TimeOrder>::Key, <O as TimeOrder>::Time);

/// Each event with the next one: by keys, and where these do not tell in full, as the queue does it.
pub fn comparison(c: &mut Criterion) {
    fn compare_all<C: FlipTimes>(times: &mut C, timed: &[Timed<C::Order>]) {
        for pair in timed.windows(2) {
            let [(a, key_a, time_a), (b, key_b, time_b)] = pair else {
                unreachable!("windows of two")
            };
            let by_keys = C::Order::compare_keys(*key_a, *key_b);
            black_box(by_keys.unwrap_or_else(|| times.order().compare((a, time_a), (b, time_b))));
        }
    }
    let scene = Scene::new();
    let mut group = c.benchmark_group("flip-time comparison");
    group.throughput(Throughput::Elements(scene.triangles.len() as u64));
    scene.with_motion(|motion| {
        let mut f64s = rounded(motion);
        let f64_timed = timed(&mut f64s, &scene.triangles);
        group.bench_function("f64", |b| b.iter(|| compare_all(&mut f64s, &f64_timed)));
        let mut filtered = FilteredTimes::new(motion);
        let enclosed = timed(&mut filtered, &scene.triangles);
        group.bench_function("filtered", |b| {
            b.iter(|| compare_all(&mut filtered, &enclosed));
        });
        let mut exact = ExactTimes::<_, Dyadic>::new(motion);
        let quotients = timed(&mut exact, &scene.triangles);
        group.bench_function("exact", |b| {
            b.iter(|| compare_all(&mut exact, &quotients));
        });
    });
    group.finish();
}

/// All events timed and pushed, then popped in order.
pub fn queue(c: &mut Criterion) {
    let scene = Scene::new();
    fn drain<C: FlipTimes>(times: &mut C, events: &[Event]) -> usize {
        let mut queue = EventQueue::earliest_first();
        for event in events {
            if let Some(due) = times.time(event.circuit) {
                queue.push(times.order(), *event, due.key, due.time);
            }
        }
        std::iter::from_fn(|| queue.pop(times.order())).count()
    }
    let mut group = c.benchmark_group("heap, with its flip times");
    group.throughput(Throughput::Elements(scene.triangles.len() as u64));
    scene.with_motion(|motion| {
        group.bench_function("f64", |b| {
            b.iter(|| drain(&mut rounded(motion), &scene.triangles));
        });
        group.bench_function("filtered", |b| {
            b.iter(|| drain(&mut FilteredTimes::new(motion), &scene.triangles));
        });
        group.bench_function("exact", |b| {
            b.iter(|| drain(&mut ExactTimes::<_, Dyadic>::new(motion), &scene.triangles));
        });
    });
    group.finish();
}

/// Flips of one kind that can all be done, in any order: no tetrahedron takes part in two.
fn independent(points: &DoublePoints, mesh: &TetMesh, kind: FlipKind) -> Vec<Flip> {
    let mut taken: FxHashSet<TetId> = FxHashSet::default();
    let mut flips = Vec::new();
    for t in mesh.finite() {
        for c in (0..4).map(|slot| t.corner(slot)) {
            if mesh.is_ghost(mesh.neighbor(c)) {
                continue;
            }
            let flip = flip_of_triangle(points, mesh, c, Signs::UNKNOWN);
            let Some(flip) = flip.filter(|flip| flip.kind() == kind) else {
                continue;
            };
            let ghost = flip.old().iter().any(|&t| mesh.is_ghost(t));
            if !ghost && flip.old().iter().all(|t| !taken.contains(t)) {
                taken.extend(flip.old());
                flips.push(flip);
            }
        }
    }
    flips
}

/// The surgery alone, and the decision which flip a triangle has.
pub fn flips(c: &mut Criterion) {
    let inputs = [
        ("2-3", FlipKind::TwoThree, uniform(8000)),
        ("3-2", FlipKind::ThreeTwo, uniform(8000)),
        ("4-4", FlipKind::FourFour, lattice(20)),
    ];
    let mut group = c.benchmark_group("flip");
    for (name, kind, points) in inputs {
        let points = DoublePoints::new(points);
        let mesh = tetrahedralized(&points, points.len()).mesh;
        let flips = independent(&points, &mesh, kind);
        assert!(flips.len() > 100, "enough flips {name}");
        group.throughput(Throughput::Elements(flips.len() as u64));
        group.bench_function(name, |b| {
            b.iter_batched_ref(
                || mesh.clone(),
                |mesh| {
                    for flip in &flips {
                        black_box(flip.perform(mesh));
                    }
                },
                BatchSize::PerIteration,
            );
        });
    }
    let points = DoublePoints::new(uniform(8000));
    let mesh = tetrahedralized(&points, points.len()).mesh;
    let inner = |&c: &Corner| !mesh.is_ghost(mesh.neighbor(c));
    let corners = mesh
        .finite()
        .flat_map(|t| (0..4).map(move |slot| t.corner(slot)));
    let corners: Vec<Corner> = corners.filter(inner).collect();
    group.throughput(Throughput::Elements(corners.len() as u64));
    group.bench_function("which", |b| {
        b.iter(|| {
            for &c in &corners {
                black_box(flip_of_triangle(&points, &mesh, c, Signs::UNKNOWN));
            }
        });
    });
    group.finish();
}
