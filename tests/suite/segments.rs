//! Segment recovery ends on small angles, and every segment is then a chain of edges of a Delaunay tetrahedralization.

use crate::common::{plc_of_points, quiet};
use proptest::prelude::*;
use tetflip::cdt::{Cdt, MeshOptions, Options, PrecisionChoice, SteinerChoice, tetrahedralize};
use tetflip::error::{Failure, GaveUp, InvalidPlc};
use tetflip::exchange::ExportedMesh;
use tetflip::exchange::{Facet, Plc, Segment};
use tetflip::mesh::VertexId;
use tetflip::predicate::PointStore;
use tetflip::report::Report;
use tetflip::verify::{Domain, VerifyOptions, verify};

fn segment(a: u32, b: u32) -> Segment {
    Segment {
        ends: [VertexId(a), VertexId(b)],
        marker: 0,
    }
}

/// Meshes the hull, and has the segments and everything else checked by the verifier.
fn mesh_and_verify(plc: &Plc) -> (ExportedMesh, Report) {
    let mut report = Report::default();
    let options = Options {
        keep_hull: true,
        ..Options::default()
    };
    let mesh = tetrahedralize(plc, &options, &mut report, &mut quiet).expect("a valid PLC");
    let options = VerifyOptions {
        domain: Domain::Hull,
        ..VerifyOptions::default()
    };
    let verdict = verify(plc, &mesh, options);
    assert!(verdict.is_ok(), "{verdict}");
    (mesh, report)
}

/// Segments from the origin in nearly one direction, of different lengths.
fn spokes(n: u32, spread: f64) -> Plc {
    let mut points = vec![[0.0; 3]];
    for i in 0..n {
        let (turn, length) = (f64::from(i) * 2.4, 10.0 + f64::from(i * 7 % 11) * 0.4);
        let radius = spread * f64::from(i + 1) / f64::from(n);
        points.push([length, radius * turn.cos(), radius * turn.sin()]);
    }
    points.extend([[1.0, 20.0, 3.0], [-5.0, -20.0, 1.0], [3.0, 1.0, 30.0]]);
    let mut plc = plc_of_points(points);
    plc.segments = (1..=n).map(|i| segment(0, i)).collect();
    plc
}

#[test]
fn spokes_at_small_angles_end() {
    for spread in [1.0, 1e-2, 1e-4] {
        let (_, report) = mesh_and_verify(&spokes(12, spread));
        assert!(report.steiner_points > 0);
    }
}

#[test]
fn walls_around_an_axis_end() {
    // 30 rectangles at a twentieth of a degree from each other, not equally long.
    let mut plc = plc_of_points(vec![[0.0; 3], [0.0, 0.0, 5.0]]);
    for i in 0..30u32 {
        let (angle, length) = (
            f64::from(i).to_radians() * 0.05,
            10.0 + f64::from(i % 7) * 0.3,
        );
        for z in [0.0, 5.0] {
            plc.vertices
                .push([angle.cos() * length, angle.sin() * length, z]);
        }
        let corners = [0, 2 + 2 * i, 3 + 2 * i, 1].map(VertexId);
        plc.facets.push(Facet {
            polygons: vec![corners.to_vec()],
            ..Facet::default()
        });
    }
    let (_, report) = mesh_and_verify(&plc);
    assert!(report.steiner_points > 0);
}

#[test]
fn wedges_and_slits_end() {
    for thickness in [1e-3, 1e-7, 1e-12] {
        // Two rectangles that meet in an edge at a small angle, and two parallel ones.
        for near in [0.0, thickness] {
            let mut plc = plc_of_points(vec![
                [0.0, 0.0, 0.0],
                [0.0, 1.0, 0.0],
                [1.0, 0.0, 0.0],
                [1.0, 1.0, 0.0],
                [1.0, 0.0, thickness],
                [1.0, 1.0, thickness],
                [0.0, 0.0, near],
                [0.0, 1.0, near],
                [0.3, 0.4, 2.0],
                [0.7, 0.2, -2.0],
            ]);
            for corners in [[0, 2, 3, 1], [6, 4, 5, 7]] {
                plc.facets.push(Facet {
                    polygons: vec![corners.map(VertexId).to_vec()],
                    ..Facet::default()
                });
            }
            mesh_and_verify(&plc);
        }
    }
}

#[test]
fn impossible_segments_are_named() {
    let fail = |plc: &Plc| {
        let mut report = Report::default();
        tetrahedralize(
            plc,
            &Options {
                keep_hull: true,
                ..Options::default()
            },
            &mut report,
            &mut quiet,
        )
        .unwrap_err()
    };
    let corners = vec![
        [0.0, 0.0, 0.0],
        [4.0, 4.0, 0.0],
        [4.0, 0.0, 0.0],
        [0.0, 4.0, 0.0],
        [1.0, 2.0, 5.0],
        [2.0, 1.0, -5.0],
    ];
    let mut crossing = plc_of_points(corners.clone());
    crossing.segments = vec![segment(0, 1), segment(2, 3)];
    let Failure::Invalid(InvalidPlc::SegmentsMeet { segments }) = fail(&crossing) else {
        panic!("segments cross")
    };
    assert_eq!(segments.concat().len(), 4);
    let mut through = plc_of_points(corners);
    through.vertices.push([1.0, 1.0, 0.0]);
    through.segments = vec![segment(0, 1)];
    let expected = InvalidPlc::VertexOnSegment {
        segment: [VertexId(0), VertexId(1)],
        vertex: VertexId(6),
    };
    assert_eq!(fail(&through), Failure::Invalid(expected));
}

/// Two segments that pass each other at 1e-300 can be told from crossing ones, and are meshed.
#[test]
fn segments_that_nearly_meet_end() {
    let mut close = plc_of_points(vec![
        [0.0, 0.0, 0.0],
        [4.1, 4.3, 0.0],
        [4.0, 0.0, 1e-300],
        [0.0, 4.0, 1e-300],
        [1.0, 2.0, 5.0],
        [2.0, 1.0, -5.0],
    ]);
    close.segments = vec![segment(0, 1), segment(2, 3)];
    let (_, report) = mesh_and_verify(&close);
    assert!(report.steiner_points > 0);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]

    /// Random disjoint segments: every subsegment is an edge, no facet of the tetrahedralization fails the perturbed
    /// insphere test, and Steiner points lie between the ends.
    #[test]
    fn segments_become_chains(ends in prop::collection::vec(([0i32..8, 0..8, 0..8], [0i32..8, 0..8, 0..8]), 3..10)) {
        let mut plc = Plc::default();
        for (i, (a, b)) in ends.into_iter().enumerate() {
            // Each segment has its own layer of a slightly skew lattice, so that no two meet.
            let place = |p: [i32; 3]| [f64::from(p[0]), f64::from(p[1]), f64::from(p[2] + 10 * i as i32) * 0.1];
            let n = plc.vertices.len() as u32;
            if a[..2] != b[..2] {
                plc.vertices.extend([place(a), place(b)]);
                plc.segments.push(segment(n, n + 1));
            }
        }
        let mut report = Report::default();
        let Ok(cdt) = Cdt::with_segments(&plc, true, &mut report) else { return Ok(()) };
        for t in cdt.mesh().finite() {
            let [a, b, c, d] = cdt.mesh().vertices(t);
            for slot in 0..4 {
                let apex = cdt.mesh().apex_across(t.corner(slot));
                prop_assert!(apex.is_infinite() || cdt.points().insphere([a, b, c, d, apex]).is_negative());
            }
        }
        mesh_and_verify(&plc);
    }
}

/// A dome whose pole is a ring of vertices as near to each other as rounding: valid, but Steiner points at the pole
/// would have to be as near. It ends soon, with an error that names the reason.
#[test]
fn vertices_as_near_as_rounding_are_named() {
    const SPOKES: u32 = 11;
    let mut points = Vec::new();
    for i in 0..SPOKES {
        let (t, angle) = (f64::from(i), -1.079 + 0.063466 * f64::from(i));
        let rings = [
            (2.69e-15, 43.93364334106445),
            (1.4424 + 0.0022 * t, 45.4384 + 0.07 * t),
            (2.94 + 0.008 * t, 46.26 + 0.13 * t),
        ];
        points.extend(rings.map(|(r, z)| [r * angle.cos(), r * angle.sin(), z]));
    }
    points.extend([[0.0, 0.0, 60.0], [9.0, 0.0, 40.0], [0.0, -9.0, 40.0]]);
    let mut plc = plc_of_points(points);
    let facet = |corners: [u32; 3]| Facet {
        polygons: vec![corners.map(VertexId).to_vec()],
        ..Facet::default()
    };
    for a in (0..SPOKES - 1).flat_map(|i| [3 * i, 3 * i + 1]) {
        plc.facets
            .extend([facet([a + 1, a, a + 3]), facet([a + 3, a + 4, a + 1])]);
    }
    assert!(tetflip::check::check(&plc, None).is_valid());
    for steiner in [SteinerChoice::Rounded, SteinerChoice::Auto] {
        let options = MeshOptions {
            keep_hull: true,
            steiner,
            precision: PrecisionChoice::Exact,
            ..MeshOptions::default()
        };
        let error = tetflip::mesh(&plc, &options).expect_err("there is hardly an end");
        assert!(!error.is_of_input());
        let Failure::GaveUp(
            GaveUp::SegmentTooShort { nearest, .. } | GaveUp::TooManySteinerPoints { nearest, .. },
        ) = *error.failure
        else {
            panic!("{error}");
        };
        assert!(nearest.is_some_and(|near| near.distance < 1e-14), "{error}");
        assert!(error.to_string().contains("from it is"), "{error}");
    }
}
