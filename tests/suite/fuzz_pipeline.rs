//! The pipeline on small random input, most of it no valid PLC: whatever comes in, every algorithm ends, and ends in a
//! mesh or a typed failure; the exact algorithms agree; and the verifier accepts the meshes of inputs that are valid by
//! construction.
//!
//! `PROPTEST_CASES=20000 cargo test --release --test suite fuzz_pipeline` looks harder.

mod inputs;

use crate::common::{plc_of_points, quiet};
use inputs::{rectangles, soup, spiky, stretched};
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
