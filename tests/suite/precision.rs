//! Inputs whose coordinates have been rounded: facets that are flat to their precision are one polygon, and nothing
//! else changes.

mod shapes;

use crate::meshes::{assert_kinds, plc};
use proptest::prelude::*;
use shapes::{Rounding, gear, prism, turned, washer};
use tetflip::cdt::{FlatnessRule, MeshOptions, Meshed, Precision, PrecisionChoice};
use tetflip::exchange::{ExportedMesh, NoteCode, Plc, Segment};
use tetflip::mesh::VertexId;
use tetflip::plc::Complex;
use tetflip::verify::{Verdict, VerifyOptions, verify};

fn meshed(plc: &Plc) -> Meshed {
    tetflip::mesh(plc, &MeshOptions::default()).expect("a closed surface")
}

fn verified(plc: &Plc, mesh: &ExportedMesh, precision: f64) -> Verdict {
    let options = VerifyOptions {
        precision,
        ..VerifyOptions::default()
    };
    verify(plc, mesh, options)
}

/// The polygons of a PLC at its own precision.
fn polygons(plc: &Plc) -> usize {
    let rule = FlatnessRule::of(Precision::of(&plc.vertices));
    let (complex, counts) = Complex::flat_to(plc, true, &rule).expect("a PLC");
    assert_eq!(counts.left_apart, 0);
    complex.polygons.len()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    /// The faces of turned and rounded shapes are found again, and the mesh is right.
    #[test]
    fn rounded_shapes_have_their_faces(seed in 0u64..1 << 32, n in 5u32..24, rounding in shapes::any_rounding()) {
        for (shape, faces) in [
            (prism(n, 3.0), n + 2),
            (washer(n, 3.0), 2 * n + 2),
            (gear(n, 3.0), 4 * n + 2),
        ] {
            let plc = turned(shape, seed, rounding);
            prop_assert_eq!(polygons(&plc), faces as usize);
            let Meshed { mesh, report } = meshed(&plc);
            let verdict = verified(&plc, &mesh, report.precision.delta);
            prop_assert!(verdict.is_ok(), "{}", verdict);
            let code = |code| report.notes.iter().any(|n| n.code == code);
            prop_assert!(code(NoteCode::FlatToPrecision) || code(NoteCode::LeftApart));
        }
    }

    /// A row of faces around a curve is not drawn into one: all vertices of a polygon are near one plane.
    #[test]
    fn polygons_do_not_drift_around_curves(seed in 0u64..1 << 32, n in 200u32..1500) {
        let plc = turned(washer(n, 3.0), seed, Rounding::Decimals(3));
        let precision = Precision::of(&plc.vertices);
        let (complex, _) = Complex::flat_to(&plc, true, &FlatnessRule::of(precision)).unwrap();
        for polygon in &complex.polygons {
            let at = |v: VertexId| plc.vertices[v.index()];
            let [a, b, c] = polygon.frame.map(at);
            let minus = |p: [f64; 3], q: [f64; 3]| [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
            let ([p, q, r], [x, y, z]) = (minus(b, a), minus(c, a));
            let normal = [q * z - r * y, r * x - p * z, p * y - q * x];
            let length = normal.iter().map(|x| x * x).sum::<f64>().sqrt();
            for &v in &polygon.vertices {
                let d = minus(at(v), a);
                let height = (normal[0] * d[0] + normal[1] * d[1] + normal[2] * d[2]) / length;
                // A plane through three of them may be farther off than the best one.
                prop_assert!(height.abs() < 12.0 * precision.delta);
            }
        }
    }

    /// The sheets of a thin plate stay apart, whatever its thickness is.
    #[test]
    fn thin_plates_stay_plates(seed in 0u64..1 << 32, n in 5u32..20, units in 3u32..40) {
        let delta = 0.5e-3;
        let plc = turned(prism(n, f64::from(units) * delta), seed, Rounding::Decimals(3));
        let rule = FlatnessRule::of(Precision::of(&plc.vertices));
        let (complex, _) = Complex::flat_to(&plc, true, &rule).unwrap();
        for polygon in &complex.polygons {
            let is_of = |f: usize, first: u32| {
                plc.facets[f].polygons[0]
                    .iter()
                    .all(|v| (first..first + n).contains(&v.0))
            };
            let [low, high] =
                [0, n].map(|first| polygon.facets.iter().filter(|&&f| is_of(f, first)).count());
            prop_assert!(low == 0 || high == 0);
        }
    }
}

/// The two halves of a roof over a square, as high as given, on walls.
fn roof(height: f64) -> Plc {
    let mut plc = plc(
        &[
            [0.1234567, 0.1, 0.3],
            [8.3456789, 0.2, 0.2],
            [8.2345678, 8.1, 0.1],
            [0.2123456, 8.3, 0.4],
            [0.1234567, 0.1, 4.0],
            [8.3456789, 0.2, 4.0],
            [8.2345678, 8.1, 4.0],
            [0.2123456, 8.3, 4.0],
            [4.1111111, 4.2, 4.0 + height],
        ],
        &[&[0, 2, 1], &[0, 3, 2]],
    );
    for i in 0..4 {
        let j = (i + 1) % 4;
        for corners in [[i, j, j + 4], [i, j + 4, i + 4], [i + 4, j + 4, 8]] {
            plc.facets.push(crate::meshes::facet(&corners));
        }
    }
    plc
}

#[test]
fn shallow_roofs_stay_and_what_is_below_the_precision_is_flat() {
    let delta = 0.5e-7;
    assert_eq!(Precision::of(&roof(0.0).vertices).delta, delta);
    let complex = |height: f64| {
        let rule = FlatnessRule::of(Precision::of(&roof(0.0).vertices));
        Complex::flat_to(&roof(height), true, &rule).unwrap().0
    };
    let at_top = |height: f64| {
        complex(height)
            .segments
            .iter()
            .filter(|s| s.ends.contains(&VertexId(8)))
            .count()
    };
    assert_eq!(at_top(1.5 * delta), 0);
    assert_eq!(at_top(4.0 * delta), 4);
}

#[test]
fn what_must_stay_stays() {
    let delta = 0.5e-7;
    let rule = FlatnessRule::of(Precision::of(&roof(0.0).vertices));
    let count = |edit: fn(&mut Plc)| {
        let mut plc = roof(delta);
        edit(&mut plc);
        let (complex, counts) = Complex::flat_to(&plc, true, &rule).unwrap();
        (complex.polygons.len(), counts.edges)
    };
    let (all, edges) = count(|_| {});
    // A marker of its own; a segment; a fifth facet at an edge.
    assert_eq!(count(|plc| plc.facets[4].marker = 7), (all + 1, edges - 2));
    let segment = Segment {
        ends: [VertexId(4), VertexId(8)],
        marker: 0,
    };
    assert_eq!(count(|_| {}).0, all);
    let mut with_segment = roof(delta);
    with_segment.segments.push(segment);
    let (complex, _) = Complex::flat_to(&with_segment, true, &rule).unwrap();
    assert_eq!(complex.polygons.len(), all);
    assert!(
        complex
            .segments
            .iter()
            .any(|s| s.ends == segment.ends || s.ends == [VertexId(8), VertexId(4)])
    );
    let fin = |plc: &mut Plc| {
        plc.vertices.push([4.0, 4.0, 9.0]);
        plc.facets.push(crate::meshes::facet(&[4, 8, 9]));
    };
    let (complex, _) = Complex::flat_to(
        &{
            let mut plc = roof(delta);
            fin(&mut plc);
            plc
        },
        true,
        &rule,
    )
    .unwrap();
    let at_fin = |s: &&Segment| s.ends.contains(&VertexId(4)) && s.ends.contains(&VertexId(8));
    assert_eq!(complex.segments.iter().filter(at_fin).count(), 1);
}

#[test]
fn exact_inputs_are_as_before() {
    // A lattice of cubes of a size with many digits in float32, and short numbers.
    for size in [f64::from(0.1f32), 0.25, 7.0] {
        let mut plc = crate::meshes::two_cubes(&[0, 1]).0;
        plc.vertices.iter_mut().flatten().for_each(|x| *x *= size);
        let exact = MeshOptions {
            precision: PrecisionChoice::Exact,
            ..MeshOptions::default()
        };
        let exactly = tetflip::mesh(&plc, &exact).expect("cubes");
        let found = meshed(&plc);
        assert_eq!(found.mesh, exactly.mesh);
        assert!(found.notes().is_empty());
    }
}

/// A box on a kite, whose top is folded along the longer diagonal: two corners are lower by a height.
fn folded(height: f64) -> Plc {
    let mut plc = plc(
        &[
            [0.1234567, 4.0, 0.0],
            [4.0, 3.0, 0.0],
            [8.1234567, 4.0, 0.0],
            [4.0, 5.0, 0.0],
            [0.1234567, 4.0, 2.0],
            [4.0, 3.0, 2.0 - height],
            [8.1234567, 4.0, 2.0],
            [4.0, 5.0, 2.0 - height],
        ],
        &[&[0, 2, 1], &[0, 3, 2], &[4, 5, 6], &[4, 6, 7]],
    );
    for i in 0..4 {
        let j = (i + 1) % 4;
        plc.facets.push(crate::meshes::facet(&[i, j, j + 4]));
        plc.facets.push(crate::meshes::facet(&[i, j + 4, i + 4]));
    }
    plc
}

#[test]
fn the_verifier_accepts_what_is_flat_to_the_stated_precision_only() {
    let height = 3e-4;
    let plc = folded(height);
    let options = MeshOptions {
        precision: PrecisionChoice::Given(height),
        ..MeshOptions::default()
    };
    let Meshed { mesh, report } = tetflip::mesh(&plc, &options).expect("a box");
    assert_eq!(report.merged_near.polygons, 1);
    assert_eq!(report.steiner_points, 0);
    let verdict = verified(&plc, &mesh, height);
    assert!(verdict.is_ok(), "{verdict}");
    assert_eq!(verdict.counts.groups_flat_to_precision, 1);
    for precision in [0.0, height / 10.0] {
        let verdict = verified(&plc, &mesh, precision);
        assert!(!verdict.is_ok(), "{precision}: {verdict}");
    }
}

#[test]
fn facets_are_flat_to_the_precision() {
    // A column with polygons, turned and written with six digits.
    let plc = turned(shapes::column(7), 5, Rounding::Digits(6));
    let exact = MeshOptions {
        precision: PrecisionChoice::Exact,
        ..MeshOptions::default()
    };
    let error = tetflip::mesh(&plc, &exact).expect_err("polygons that are not flat");
    assert!(error.to_string().contains("is not planar"));
    let Meshed { mesh, report } = meshed(&plc);
    assert_eq!(report.steiner_points, 0);
    assert_kinds(&verified(&plc, &mesh, report.precision.delta), &[]);
}

#[test]
fn features_below_an_angle_are_given_up_where_that_is_asked_for() {
    let plc = roof(2e-3);
    assert_eq!(meshed(&plc).report.merged_near.polygons, 0);
    let options = MeshOptions {
        merge_angle: Some(179.9),
        ..MeshOptions::default()
    };
    let Meshed { mesh, report } = tetflip::mesh(&plc, &options).expect("a roof");
    assert_eq!(report.merged_near.polygons, 1);
    let options = VerifyOptions {
        merge_angle: Some(179.9),
        ..VerifyOptions::default()
    };
    assert_kinds(&verify(&plc, &mesh, options), &[]);
}
