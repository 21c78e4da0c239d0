//! The pipeline on small random input, most of it no valid PLC: whatever comes in, every algorithm ends, and ends in a
//! mesh or a typed failure; the exact algorithms agree; and the verifier accepts the meshes of inputs that are valid by
//! construction.
//!
//! `PROPTEST_CASES=20000 cargo test --release --test fuzz_pipeline` looks harder.

use crate::common::{plc_of_points, quiet};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use std::sync::mpsc;
use std::time::Duration;
use tetflip::cdt::{Options, tetrahedralize};
use tetflip::delaunay::delaunay;
use tetflip::error::{Failure, GaveUp};
use tetflip::exchange::ExportedMesh;
use tetflip::exchange::{Facet, Plc, Region, Segment};
use tetflip::mesh::VertexId;
use tetflip::number::Bits;
use tetflip::predicate::{DoublePoints, Steiner};
use tetflip::recover::polygons::{FlipOrder, Insertion, NumberType};
use tetflip::report::Report;
use tetflip::verify::{Domain, VerifyOptions, verify};

/// A run on the inputs of this file takes milliseconds; one that takes this long is taken for endless.
const PATIENCE: Duration = Duration::from_secs(120);

const INSERTIONS: [Insertion; 7] = [
    Insertion::Cavity,
    Insertion::GiftWrap,
    Insertion::Flip(FlipOrder::EXACT),
    Insertion::Flip(FlipOrder::new(NumberType::F64Plain)),
    Insertion::Flip(FlipOrder::new(NumberType::F32)),
    Insertion::Flip(FlipOrder::new(NumberType::Naive)),
    // Eight bits.
    Insertion::Flip(FlipOrder::new(NumberType::NaiveWide(Bits::ALL[0]))),
];

fn config(cases: u32) -> ProptestConfig {
    if std::env::var_os("PROPTEST_CASES").is_some() {
        ProptestConfig::default()
    } else {
        ProptestConfig {
            rng_seed: RngSeed::Fixed(1),
            ..ProptestConfig::with_cases(cases)
        }
    }
}

/// What came of one insertion.
type Outcome = Result<ExportedMesh, Failure>;

/// All insertions, on a thread of their own, so that an endless one fails the test.
fn run_all(plc: &Plc, keep_hull: bool, merge_coplanar: bool) -> Vec<Outcome> {
    let (send, receive) = mpsc::channel();
    let plc = plc.clone();
    let thread = std::thread::spawn(move || {
        for insertion in INSERTIONS {
            let options = Options {
                insertion,
                keep_hull,
                merge_coplanar,
                ..Options::default()
            };
            let mut report = Report::default();
            let outcome = tetrahedralize(&plc, &options, &mut report, &mut quiet);
            if let Err(failure) = &outcome {
                // Messages are computed from the input's numbers; they must not fail either.
                assert!(!failure.describe(&plc).is_empty());
            }
            if send.send(outcome).is_err() {
                return;
            }
        }
    });
    let mut outcomes = Vec::new();
    for insertion in INSERTIONS {
        match receive.recv_timeout(PATIENCE) {
            Ok(outcome) => outcomes.push(outcome),
            Err(mpsc::RecvTimeoutError::Timeout) => panic!("{insertion:?} does not end"),
            Err(mpsc::RecvTimeoutError::Disconnected) => {
                std::panic::resume_unwind(thread.join().expect_err("it sends all or panics"))
            }
        }
    }
    outcomes
}

/// Whether the verifier accepts the mesh.
fn accepted(plc: &Plc, mesh: &ExportedMesh, keep_hull: bool) -> Result<(), String> {
    let options = VerifyOptions {
        domain: if keep_hull {
            Domain::Hull
        } else {
            Domain::Inside
        },
        ..VerifyOptions::default()
    };
    let verdict = verify(plc, mesh, options);
    if verdict.is_ok() {
        Ok(())
    } else {
        Err(verdict.to_string())
    }
}

/// What must hold for any input, with rounded Steiner points. (A mesh of an invalid input with features of a few ulps
/// may be refused: to the verifier's tolerance such features are not there.) `valid`: the input is a PLC by
/// construction.
fn check(plc: &Plc, keep_hull: bool, merge_coplanar: bool, valid: bool) {
    check_exactly(plc, keep_hull, merge_coplanar);
    let outcomes = run_all(plc, keep_hull, merge_coplanar);
    let exact: Vec<_> = outcomes[..3].iter().flatten().collect();
    for pair in exact.windows(2) {
        assert_eq!(
            pair[0], pair[1],
            "the exact algorithms end in the same mesh"
        );
    }
    for (insertion, outcome) in INSERTIONS.iter().zip(&outcomes) {
        match outcome {
            Ok(mesh) => {
                if let Err(why) = accepted(plc, mesh, keep_hull) {
                    assert!(
                        !valid && !is_coarse(plc),
                        "{insertion:?} made a mesh that is refused: {why}"
                    );
                }
            }
            Err(Failure::Plc(_) | Failure::Invalid(_)) => {
                assert!(!valid, "{insertion:?}: {outcome:?} of a valid PLC");
            }
            Err(Failure::GaveUp(GaveUp::FlipOrder { .. })) if valid => {
                panic!("exactly ordered flips are possible in a valid PLC");
            }
            Err(_) => {}
        }
    }
}

/// With exact Steiner points a valid PLC has a mesh, which is verified without tolerance, and an invalid one has none:
/// what is valid is what the check says, which shares no code with the pipeline.
fn check_exactly(plc: &Plc, keep_hull: bool, merge_coplanar: bool) {
    let (send, receive) = mpsc::channel();
    let input = plc.clone();
    let thread = std::thread::spawn(move || {
        for insertion in [Insertion::Cavity, Insertion::Flip(FlipOrder::FILTERED)] {
            let options = Options {
                insertion,
                keep_hull,
                merge_coplanar,
                steiner: Steiner::Exact,
            };
            let mut report = Report::default();
            let outcome = tetrahedralize(&input, &options, &mut report, &mut quiet);
            if send.send(outcome).is_err() {
                return;
            }
        }
    });
    let mut outcomes = Vec::new();
    for _ in 0..2 {
        match receive.recv_timeout(PATIENCE) {
            Ok(outcome) => outcomes.push(outcome),
            Err(mpsc::RecvTimeoutError::Timeout) => panic!("exact Steiner points do not end"),
            Err(mpsc::RecvTimeoutError::Disconnected) => {
                std::panic::resume_unwind(thread.join().expect_err("it sends all or panics"))
            }
        }
    }
    let findings = tetflip::check::check(plc, Some(4));
    match &outcomes[..] {
        [Ok(cavity), Ok(flips)] => {
            assert_eq!(cavity, flips, "one mesh");
            assert!(findings.is_valid(), "a mesh of {findings:?}");
            let domain = match keep_hull {
                true => Domain::Hull,
                false => Domain::Inside,
            };
            let options = VerifyOptions {
                domain,
                tolerance: 0.0,
                ..VerifyOptions::default()
            };
            let verdict = verify(plc, cavity, options);
            assert!(verdict.is_ok(), "{verdict}");
        }
        [Err(cavity), Err(flips)] => {
            for failure in [cavity, flips] {
                let no_intersection = matches!(
                    failure,
                    Failure::Delaunay(_) | Failure::Domain(_) | Failure::Plc(_)
                );
                // Edges that nearly overlap may need any number of Steiner points, and vertices nearer to a segment
                // than 2^-106 of its length a place between parameters.
                let too_many = matches!(
                    failure,
                    Failure::GaveUp(
                        GaveUp::TooManySteinerPoints { .. } | GaveUp::SegmentTooShort { .. }
                    )
                ) && !is_coarse(plc);
                assert!(
                    no_intersection || too_many || !findings.is_valid(),
                    "{failure} of a valid PLC"
                );
            }
        }
        _ => panic!("cavities and flips disagree: {outcomes:?}"),
    }
}

/// Whether all coordinates are small integers, so that no feature is too small for the tolerance of the verifier.
fn is_coarse(plc: &Plc) -> bool {
    let small = |x: &f64| x.fract() == 0.0 && x.abs() < 100.0;
    plc.vertices.iter().flatten().all(small)
}

/// Lattice coordinates to doubles of every size.
#[derive(Clone, Copy, Debug)]
struct Scale {
    exponents: [i32; 3],
    jitter: u64,
}

impl Scale {
    /// Only the same for all axes or powers of two per axis: keeps what is coplanar coplanar, unless it is jittered.
    fn apply(&self, n: usize, p: [i32; 3]) -> [f64; 3] {
        [0, 1, 2].map(|i| {
            // In two steps, as 2^-1074 is no normal number.
            let e = self.exponents[i];
            let mut x = f64::from(p[i]) * 2f64.powi(e / 2) * 2f64.powi(e - e / 2);
            let bits = self.jitter >> ((3 * n + i) % 32 * 2) & 3;
            if bits == 1 {
                x = x.next_up();
            } else if bits == 2 {
                x = x.next_down();
            }
            x
        })
    }
}

fn scale() -> impl Strategy<Value = Scale> {
    let exponent = || {
        prop_oneof![
            Just(0),
            Just(900),
            Just(-900),
            Just(-1074),
            Just(1020),
            Just(-30),
            Just(3)
        ]
    };
    let exponents = prop_oneof![
        3 => Just([0; 3]),
        2 => exponent().prop_map(|e| [e; 3]),
        1 => [exponent(), exponent(), exponent()],
    ];
    let jitter = prop_oneof![2 => Just(0), 1 => any::<u64>(), 1 => any::<u64>().prop_map(|x| x & x >> 7 & x << 3)];
    (exponents, jitter).prop_map(|(exponents, jitter)| Scale { exponents, jitter })
}

fn lattice_point(n: i32) -> [std::ops::Range<i32>; 3] {
    [0..n, 0..n, 0..n]
}

/// Vertices picked by arbitrary numbers; repetitions, which no facet may have, only now and then.
fn pick(v: &[usize], n: usize) -> Vec<VertexId> {
    let mut picked: Vec<VertexId> = Vec::new();
    for &i in v {
        let v = VertexId::new(i % n);
        if i == 63 || !picked.contains(&v) {
            picked.push(v);
        }
    }
    picked
}

/// Anything: triangles, quadrilaterals and worse on lattice points, segments, holes, regions.
fn soup() -> impl Strategy<Value = Plc> {
    let points = (2i32..6).prop_flat_map(|n| prop::collection::vec(lattice_point(n), 4..14));
    let polygon = prop_oneof![
        6 => prop::collection::vec(0usize..64, 3..4),
        3 => prop::collection::vec(0usize..64, 4..5),
        1 => prop::collection::vec(0usize..64, 1..7),
    ];
    let polygons = prop_oneof![
        6 => prop::collection::vec(polygon.clone(), 1..2),
        1 => prop::collection::vec(polygon, 1..4),
    ];
    let halves = || [-1i32..12, -1..12, -1..12];
    let facets = prop::collection::vec(
        (polygons, prop::collection::vec(halves(), 0..2), 0i64..3),
        0..7,
    );
    let segments = prop::collection::vec([0usize..64, 0..64], 0..4);
    let marks = prop::collection::vec(halves(), 0..2);
    (points, facets, segments, marks.clone(), marks, scale()).prop_map(
        |(points, facets, segments, holes, regions, scale)| {
            let n = points.len();
            let half = |p: &[i32; 3]| scale.apply(1, *p).map(|x| x * 0.5);
            Plc {
                vertices: points
                    .iter()
                    .enumerate()
                    .map(|(i, &p)| scale.apply(i, p))
                    .collect(),
                facets: facets
                    .iter()
                    .map(|(polygons, holes, marker)| Facet {
                        polygons: polygons.iter().map(|p| pick(p, n)).collect(),
                        holes: if holes.len() == 1 {
                            holes.iter().map(half).collect()
                        } else {
                            vec![]
                        },
                        marker: *marker,
                    })
                    .collect(),
                segments: segments
                    .iter()
                    .filter(|&&[a, b]| a % n != b % n || a == 63)
                    .map(|&[a, b]| Segment {
                        ends: [VertexId::new(a % n), VertexId::new(b % n)],
                        marker: 1,
                    })
                    .collect(),
                holes: holes.iter().map(half).collect(),
                regions: regions
                    .iter()
                    .map(|p| Region {
                        point: half(p),
                        attribute: 7.0,
                        max_volume: None,
                    })
                    .collect(),
                ..Plc::default()
            }
        },
    )
}

/// Rectangles and triangles in planes that are nearly all parallel to two axes or tilted by 45 degrees, with corners on
/// a lattice: they touch, overlap and cross, and many are accepted.
fn rectangles() -> impl Strategy<Value = Plc> {
    let rectangle = (
        lattice_point(5),
        0usize..3,
        1i32..4,
        1i32..4,
        0i32..6,
        0u8..4,
    );
    let facets = prop::collection::vec(rectangle, 1..6);
    let loose = prop::collection::vec(lattice_point(8), 4..12);
    (facets, loose, scale()).prop_map(|(facets, loose, scale)| {
        // Without jitter: see `edges_an_ulp_apart_end`.
        let scale = Scale { jitter: 0, ..scale };
        let mut plc = Plc::default();
        let add = |plc: &mut Plc, p: [i32; 3]| {
            plc.vertices.push(scale.apply(plc.vertices.len(), p));
            VertexId::new(plc.vertices.len() - 1)
        };
        for (at, axis, width, height, tilt, corners) in facets {
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            let corner = |i: i32, j: i32| {
                let mut p = at;
                p[u] += i * width;
                p[v] += j * height;
                // Tilted around u, if at all.
                p[axis] += i32::from(tilt == 0) * j * height;
                p
            };
            let square = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
            let n = if corners == 0 { 3 } else { 4 };
            let polygon: Vec<VertexId> = square[..n].iter().map(|&p| add(&mut plc, p)).collect();
            plc.facets.push(Facet {
                polygons: vec![polygon],
                marker: i64::from(corners == 2),
                ..Facet::default()
            });
        }
        for p in loose {
            add(&mut plc, p);
        }
        plc
    })
}

/// Valid: triangles and edges of a tetrahedralization of integer points that is Delaunay only after a stretch.
fn stretched() -> impl Strategy<Value = Plc> {
    let points = (3i32..12).prop_flat_map(|n| prop::collection::btree_set(lattice_point(n), 5..30));
    let stretch = [1i32..20, 1..20, 1..20];
    let chosen = prop::collection::vec(0u8..4, 97);
    let edges = prop::collection::vec(0u8..8, 41);
    (points, stretch, chosen, edges, 0u8..4, -2i32..3).prop_map(
        |(points, stretch, chosen, edges, rare, e)| {
            let points: Vec<[i32; 3]> = points.into_iter().collect();
            let stretched = points
                .iter()
                .map(|p| [0, 1, 2].map(|i| f64::from(p[i] * stretch[i])));
            let store = DoublePoints::new(stretched.collect());
            let all: Vec<VertexId> = (0..points.len()).map(VertexId::new).collect();
            let size = 2f64.powi(300 * e);
            let mut plc = plc_of_points(
                points
                    .iter()
                    .map(|p| p.map(|x| f64::from(x) * size))
                    .collect(),
            );
            let Ok(d) = delaunay(&store, &all) else {
                return plc;
            };
            let mut k = 0;
            for t in d.mesh.finite() {
                for slot in 0..4 {
                    let c = t.corner(slot);
                    if c > d.mesh.twin(c) {
                        continue;
                    }
                    k += 1;
                    if chosen[k % 97] <= rare {
                        continue;
                    }
                    let f = d.mesh.facet(c);
                    plc.facets.push(Facet {
                        polygons: vec![f.to_vec()],
                        marker: (k % 2) as i64,
                        ..Facet::default()
                    });
                    if edges[k % 41] == 0 {
                        plc.segments.push(Segment {
                            ends: [f[0], f[1]],
                            marker: 3,
                        });
                    }
                }
            }
            plc
        },
    )
}

/// Valid: a surface around the origin, star-shaped, with spikes: the hull of integer points, each then pulled out by an
/// integer factor. Its radial projection stays a triangulated sphere.
fn spiky() -> impl Strategy<Value = Plc> {
    let points = prop::collection::btree_set([-4i32..5, -4..5, -4..5], 5..24);
    (
        points,
        prop::collection::vec(prop_oneof![3 => 1i32..4, 1 => 4..60], 24),
        0u8..3,
    )
        .prop_map(|(points, factor, loose)| {
            let points: Vec<[i32; 3]> = points.into_iter().filter(|p| *p != [0; 3]).collect();
            let store = DoublePoints::new(points.iter().map(|p| p.map(f64::from)).collect());
            let all: Vec<VertexId> = (0..points.len()).map(VertexId::new).collect();
            let mut plc = Plc::default();
            let Ok(d) = delaunay(&store, &all) else {
                return plc;
            };
            let mut number = vec![None; points.len()];
            for t in d.mesh.all() {
                let Some(slot) = d.mesh.slot_of(t, VertexId::INFINITE) else {
                    continue;
                };
                let f = d.mesh.facet(t.corner(slot));
                let [a, b, c] = f.map(|v| points[v.index()].map(i64::from));
                let det = a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
                    + a[2] * (b[0] * c[1] - b[1] * c[0]);
                let inner = d.mesh.vertex(d.mesh.twin(t.corner(slot)));
                let q = points[inner.index()].map(i64::from);
                // The origin must be strictly on the inner side of every facet.
                let side = |p: [i64; 3]| {
                    let [u, v, w] = [a, b, c].map(|x| [x[0] - p[0], x[1] - p[1], x[2] - p[2]]);
                    u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0])
                        + u[2] * (v[0] * w[1] - v[1] * w[0])
                };
                if det == 0 || (side(q) > 0) != (det > 0) {
                    return Plc::default();
                }
                let polygon = f.map(|v| {
                    *number[v.index()].get_or_insert_with(|| {
                        let r = factor[v.index()];
                        plc.vertices
                            .push(points[v.index()].map(|x| f64::from(x * r)));
                        VertexId::new(plc.vertices.len() - 1)
                    })
                });
                plc.facets.push(Facet {
                    polygons: vec![polygon.to_vec()],
                    ..Facet::default()
                });
            }
            for k in 0..loose {
                plc.vertices.push([f64::from(k) / 1024.0, 0.0, 0.0]);
            }
            plc
        })
}

proptest! {
    #![proptest_config(config(150))]

    #[test]
    fn soup_ends_in_a_mesh_or_a_failure(plc in soup(), keep_hull: bool, merge: bool) {
        check(&plc, keep_hull, merge, false);
    }
}

proptest! {
    #![proptest_config(config(150))]

    #[test]
    fn rectangles_end_in_a_mesh_or_a_failure(plc in rectangles(), keep_hull: bool, merge: bool) {
        check(&plc, keep_hull, merge, false);
    }
}

proptest! {
    #![proptest_config(config(60))]

    #[test]
    fn stretched_triangulations_are_valid(plc in stretched(), keep_hull: bool, merge: bool) {
        check(&plc, keep_hull, merge, true);
    }

    #[test]
    fn spiky_surfaces_are_valid(plc in spiky(), keep_hull: bool, merge: bool) {
        check(&plc, keep_hull, merge, true);
    }
}

/// A PLC of triangles and quadrilaterals.
fn surface(vertices: &[[f64; 3]], facets: &[&[u32]]) -> Plc {
    let mut plc = plc_of_points(vertices.to_vec());
    for f in facets {
        plc.facets.push(Facet {
            polygons: vec![f.iter().map(|&v| VertexId(v)).collect()],
            ..Facet::default()
        });
    }
    plc
}

/// A spike's vertex 8 lies exactly on the plane of facet 6 0 9, beyond its edge 6 0, which has rounded Steiner points.
#[test]
fn vertex_on_the_plane_beyond_an_edge_is_no_intersection() {
    let vertices = [
        [9, 0, 12],
        [0, 3, 0],
        [3, 1, 0],
        [0, 2, 3],
        [-4, 0, 0],
        [-3, 0, -4],
        [-4, -6, -2],
        [-4, -1, 3],
        [6, 0, 12],
        [6, -9, -9],
    ];
    let facets: [&[u32]; 16] = [
        &[0, 1, 2],
        &[1, 3, 4],
        &[5, 1, 4],
        &[6, 4, 7],
        &[6, 5, 4],
        &[4, 3, 7],
        &[0, 7, 8],
        &[8, 7, 3],
        &[0, 8, 3],
        &[3, 1, 0],
        &[1, 5, 2],
        &[9, 0, 2],
        &[6, 7, 0],
        &[2, 5, 9],
        &[6, 0, 9],
        &[9, 5, 6],
    ];
    let plc = surface(&vertices.map(|p| p.map(f64::from)), &facets);
    check(&plc, false, false, true);
}

/// A polygon, flat only to rounding, cuts through a facet of the convex hull; no flip may look beyond that.
#[test]
fn polygon_that_cuts_the_hull_only_to_rounding() {
    let tiny = f64::from_bits(1);
    let (below, above) = (1f64.next_down(), 1f64.next_up());
    let vertices = [
        [3.0, 4.0, 1.0],
        [4f64.next_down(), 4.0, above],
        [4f64.next_down(), 5.0, below],
        [3.0, 5f64.next_up(), above],
        [-tiny, 0.0, -tiny],
        [0.0, -tiny, 0.0],
        [0.0, 0.0, -tiny],
        [-tiny, tiny, 0.0],
        [-tiny, 0.0, 0.0],
        [0.0, -tiny, -tiny],
        [2f64.next_down(), tiny, 2.0],
        [4.0, 4f64.next_up(), below],
        [1.0, -tiny, 0.0],
    ];
    check(&surface(&vertices, &[&[0, 1, 2, 3]]), false, false, false);
}

/// Edges of two facets that overlap but for an ulp are divided on and on.
#[test]
fn edges_an_ulp_apart_end() {
    let (x, y) = (32f64.next_down(), 8f64.next_up());
    let vertices = [
        [x, 8.0, 16.0],
        [32.0, y, 40f64.next_up()],
        [56f64.next_down(), y, 40f64.next_down()],
        [x, 8f64.next_down(), x],
        [x, 16f64.next_down(), x],
        [32.0, 16.0, 56f64.next_down()],
        [32.0, 8.0, 56f64.next_down()],
        [48.0, 24.0, 16.0],
        [16.0, 56.0, 16.0],
        [0.0, 0.0, 0.0],
    ];
    let plc = surface(&vertices, &[&[0, 1, 2], &[3, 4, 5, 6]]);
    check(&plc, true, true, false);
}
