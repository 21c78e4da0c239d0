//! Flips in rounded numbers, down to eight bits and down to no exact predicate at all: whatever they do, they end; the
//! library does not panic; a result that passes the exact judgement is the CDT; after a failure the region is as it
//! was, and what the failure carries along fails again by itself.
//!
//! `PROPTEST_CASES=20000 cargo test --release --test suite rounded_flips` looks harder.

use crate::common::{plc_of_points, quiet, sorted_tets};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use tetflip::cdt::Cdt;
use tetflip::error::{Failure, GaveUp};
use tetflip::exchange::{Facet, Plc};
use tetflip::mesh::VertexId;
use tetflip::predicate::PointStore;
use tetflip::recover::polygons::{FlipOrder, Insertion};
use tetflip::report::Report;

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

/// Rounded number types, the naive ones first.
const ROUNDED: &str =
    "naive naive:8 naive:14 naive:24 naive:53 naive:106 f32 f64 bits:8 bits:24 bits:53 bits:106";

fn times(word: &str) -> FlipOrder {
    word.parse().expect("a number type")
}

/// Points and one polygon.
fn scene(points: Vec<[f64; 3]>, corners: usize) -> Plc {
    let mut plc = plc_of_points(points);
    plc.facets.push(Facet {
        polygons: vec![(0..corners).map(VertexId::new).collect()],
        ..Facet::default()
    });
    plc
}

/// All polygons inserted; the mesh in any case.
fn insert(plc: &Plc, times: FlipOrder) -> Result<(Cdt, Result<(), Failure>), Failure> {
    let mut cdt = Cdt::with_segments(plc, true, &mut Report::default())?;
    let inserted = cdt.insert_polygons(Insertion::Flip(times), &mut Report::default(), &mut quiet);
    Ok((cdt, inserted.map(|_| ())))
}

/// What must hold on a PLC with one polygon.
fn check(plc: &Plc) {
    // The vertices may be on one plane, and two of them on one place.
    let Ok((exact, Ok(()))) = insert(plc, FlipOrder::FILTERED) else {
        return;
    };
    for word in ROUNDED.split(' ') {
        let (cdt, outcome) = insert(plc, times(word)).expect("as before");
        assert_eq!(cdt.mesh().check(), Ok(()), "{word}");
        match outcome {
            Ok(()) => assert_eq!(sorted_tets(cdt.mesh()), sorted_tets(exact.mesh()), "{word}"),
            Err(failure) => {
                assert!(!failure.describe(plc).is_empty());
                let positive = |t| cdt.points().orient3d(cdt.mesh().vertices(t)).is_positive();
                assert!(
                    cdt.mesh().finite().all(positive),
                    "{word}: the region is restored"
                );
                if let Some(region) = failure.region() {
                    check_region(region, plc, times(word));
                }
            }
        }
    }
}

/// The region is a PLC of some of the vertices, in their order, with Steiner points behind, in which exact flips
/// succeed.
fn check_region(region: &Plc, plc: &Plc, times: FlipOrder) {
    let place = |p| plc.vertices.iter().position(|q| q == p);
    let places = region
        .vertices
        .iter()
        .map(|p| place(p).unwrap_or(usize::MAX));
    assert!(places.is_sorted(), "{region:?}");
    let (_, exact) = insert(region, FlipOrder::FILTERED).expect("a region spans space");
    assert_eq!(exact, Ok(()), "{region:?}");
    // The same failure in most cases, but not in all: equal times are flipped in order of arrival.
    let (again, outcome) = insert(region, times).expect("a region spans space");
    assert_eq!(again.mesh().check(), Ok(()));
    assert!(outcome.is_ok() || outcome.is_err_and(|f| f.region().is_some()));
}

fn lattice() -> impl Strategy<Value = Plc> {
    let points = prop::collection::btree_set([-3i32..4, -3..4, -3..4], 3..30);
    (points, 0usize..4, 1i32..4, 1i32..4).prop_map(|(points, kind, w, h)| {
        let (u, v): ([i32; 3], [i32; 3]) = match kind {
            0 => ([w, 0, 0], [0, h, 0]),
            1 => ([w, 0, 0], [0, h, h]),
            2 => ([w, w, 0], [0, 0, h]),
            _ => ([2 * w, w, 0], [-1, 2, 1]),
        };
        let corner = |i: i32, j: i32| [0, 1, 2].map(|k: usize| i * u[k] + j * v[k]);
        let mut all = vec![corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)];
        all.extend(
            points
                .iter()
                .filter(|p| !all[..4].contains(p))
                .collect::<Vec<_>>(),
        );
        scene(all.into_iter().map(|p| p.map(f64::from)).collect(), 4)
    })
}

/// A large square on z = 0, and points near its plane: on a lattice in x and y or not, and at heights of any size.
fn nearly_coplanar() -> impl Strategy<Value = Plc> {
    let xy = prop_oneof![(-4i32..5).prop_map(f64::from), -4.0..4.0];
    let z = (-1.0..1.0, -60i32..1).prop_map(|(z, e): (f64, i32)| z * 2f64.powi(e));
    let points = prop::collection::vec((xy.clone(), xy, z), 5..40);
    points.prop_map(|points| {
        let mut all = vec![
            [-9.0, -9.0, 0.0],
            [9.0, -9.0, 0.0],
            [9.0, 9.0, 0.0],
            [-9.0, 9.0, 0.0],
        ];
        all.extend(points.into_iter().map(|(x, y, z)| [x, y, z]));
        scene(all, 4)
    })
}

/// Points in a box around a triangle on a plane that is none of the axes'. Large or small, so that products overflow.
fn random() -> impl Strategy<Value = Plc> {
    let points = prop::collection::vec([-1.0..1.0, -1.0..1.0, -1.0..1.0], 5..40);
    (
        points,
        prop_oneof![4 => Just(0), 1 => -150i32..150, 1 => Just(250)],
    )
        .prop_map(|(points, e)| {
            let mut all = vec![[2.0, 0.0, -1.0], [-1.0, 2.0, -1.0], [0.0, -1.0, 2.0]];
            all.extend(points);
            let size = 2f64.powi(e);
            scene(all.into_iter().map(|p| p.map(|x| x * size)).collect(), 3)
        })
}

proptest! {
    #![proptest_config(config(25))]

    #[test]
    fn lattices(plc in lattice()) {
        check(&plc);
    }

    #[test]
    fn nearly_coplanar_points(plc in nearly_coplanar()) {
        check(&plc);
    }

    #[test]
    fn random_points(plc in random()) {
        check(&plc);
    }
}

/// Ten points on a sphere and a square through it: times that are equal, in any number of bits, flipped in the wrong
/// order. (Found by random search; TetGen 1.5.0 crashes on it.)
fn sphere() -> Plc {
    let points = [
        [8, -2, 0],
        [-4, 4, -6],
        [80, 80, -1],
        [-80, 80, -1],
        [-2, -8, 0],
        [-4, -6, 4],
        [-80, -80, -1],
        [-2, 8, 0],
        [80, -80, -1],
        [2, 8, 0],
    ];
    let mut plc = plc_of_points(points.map(|p| p.map(f64::from)).to_vec());
    plc.facets.push(Facet {
        polygons: vec![[6, 8, 2, 3].map(VertexId).to_vec()],
        ..Facet::default()
    });
    plc
}

/// Fourteen cospherical points and a square through them. (Found by the experiment `flip_order`.)
fn cospherical() -> Plc {
    let points = [
        [11, -12, 0],
        [11, 12, 0],
        [-11, 12, 0],
        [2, 0, -5],
        [0, 2, -5],
        [-4, 3, 2],
        [-4, -3, 2],
        [-2, -3, -4],
        [-4, 3, -2],
        [-4, 2, 3],
        [-3, 2, 4],
        [-11, -12, 0],
        [4, 3, -2],
        [4, 3, 2],
    ];
    let mut plc = plc_of_points(points.map(|p| p.map(f64::from)).to_vec());
    plc.facets.push(Facet {
        polygons: vec![[11, 0, 1, 2].map(VertexId).to_vec()],
        ..Facet::default()
    });
    plc
}

/// Seven points of which only doubles make a mess. (From the same source.)
fn close_to_a_plane() -> Plc {
    let points = [
        [-1.7254809563860356, -2.025292745403822, -1.2599117931767658],
        [-1.210531177825071, 0.19878302299346595, -4.270808706322892],
        [1.6138090613532217, 0.0797971966296731, -0.33657320216385145],
        [0.6540013181701468, -0.5253692544542015, -0.6017958539759969],
        [0.2659919166079542, -0.7337418684939265, -0.7692266967876316],
        [0.3501200581651416, -1.227442489569467, 0.16167176664704705],
        [1.098859282792257, -2.144278571767615, 2.674323710982275],
    ];
    let mut plc = plc_of_points(points.to_vec());
    plc.facets.push(Facet {
        polygons: vec![[2, 1, 0, 6].map(VertexId).to_vec()],
        ..Facet::default()
    });
    plc
}

#[test]
fn failures_replay() {
    for (plc, word) in [
        (cospherical(), "f32"),
        (cospherical(), "f64:plain"),
        (cospherical(), "bits:256"),
        (cospherical(), "naive"),
        (close_to_a_plane(), "f64:plain"),
        (close_to_a_plane(), "bits:53"),
        (close_to_a_plane(), "naive:24"),
    ] {
        check(&plc);
        let (_, outcome) = insert(&plc, times(word)).expect("segments are there");
        let failure = outcome.expect_err(word);
        let region = failure.region().expect("a polygon that is flat");
        let (_, again) = insert(region, times(word)).expect("segments are there");
        let count = |failure: &Failure| match failure {
            Failure::GaveUp(GaveUp::Stuck { crossing, .. }) => (0, *crossing),
            Failure::GaveUp(GaveUp::NotDelaunay { faces, .. }) => (1, *faces),
            Failure::GaveUp(GaveUp::Inverted { tets, .. }) => (2, *tets),
            other => panic!("{other:?}"),
        };
        assert_eq!(count(&again.expect_err(word)), count(&failure), "{word}");
    }
}

#[test]
fn enough_bits_suffice_where_nothing_is_tied() {
    for (word, succeeds) in [("bits:53", false), ("bits:64", true), ("bits:256", true)] {
        let (_, outcome) = insert(&close_to_a_plane(), times(word)).expect("segments are there");
        assert_eq!(outcome.is_ok(), succeeds, "{word}");
    }
}

#[test]
fn flips_that_do_not_end_are_stopped() {
    let (cdt, outcome) = insert(&sphere(), times("naive:14")).expect("segments are there");
    let failure = outcome.expect_err("fourteen bits");
    assert!(
        matches!(failure, Failure::GaveUp(GaveUp::Endless { .. })),
        "{failure:?}"
    );
    let before = Cdt::with_segments(&sphere(), true, &mut Report::default()).expect("as above");
    assert_eq!(sorted_tets(cdt.mesh()), sorted_tets(before.mesh()));
}
