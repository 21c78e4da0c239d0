//! Exact Steiner points: every polygon stays flat, every algorithm ends in the same tetrahedra, the verifier accepts
//! them without any tolerance, and output says where the points are and what rounding spoils.

use crate::common::families::{crossing_planes, fins, lattice_with_rectangle, sphere, walls};
use crate::common::quiet;
use proptest::prelude::*;
use tetflip::cdt::{Cdt, Options, tetrahedralize};
use tetflip::error::Failure;
use tetflip::exchange::Plc;
use tetflip::exchange::{ExportedMesh, FaceTable};
use tetflip::format::{read_mesh, write_mesh};
use tetflip::predicate::{DoublePoints, PointStore, Steiner};
use tetflip::recover::polygons::{FlipOrder, Insertion};
use tetflip::report::Report;
use tetflip::verify::{Domain, Verdict, VerifyOptions, verify};

fn options(steiner: Steiner, insertion: Insertion) -> Options {
    Options {
        steiner,
        insertion,
        keep_hull: true,
        ..Options::default()
    }
}

fn run(
    plc: &Plc,
    steiner: Steiner,
    insertion: Insertion,
) -> Result<(ExportedMesh, Report), Failure> {
    let mut report = Report::default();
    let mesh = tetrahedralize(plc, &options(steiner, insertion), &mut report, &mut quiet)?;
    Ok((mesh, report))
}

fn verdict(plc: &Plc, mesh: &ExportedMesh) -> Verdict {
    let options = VerifyOptions {
        domain: Domain::Hull,
        tolerance: 0.0,
        ..VerifyOptions::default()
    };
    verify(plc, mesh, options)
}

/// Coordinates that leave no bits to spare: axis planes stay planes.
fn stretched(mut plc: Plc, [sx, sy, sz]: [f64; 3]) -> Plc {
    for p in &mut plc.vertices {
        *p = [p[0] * sx, p[1] * sy, p[2] * sz];
    }
    plc
}

/// Turned about two axes: planes are flat only to rounding.
fn turned(mut plc: Plc, [a, b]: [f64; 2]) -> Plc {
    for p in &mut plc.vertices {
        let [x, y, z] = *p;
        let (x, y) = (x * a.cos() - y * a.sin(), x * a.sin() + y * a.cos());
        let (y, z) = (y * b.cos() - z * b.sin(), y * b.sin() + z * b.cos());
        *p = [x, y, z];
    }
    plc
}

/// All algorithms, or the same complaint about the input. A polygon is never not flat.
fn agree(plc: &Plc) -> Option<(ExportedMesh, Report)> {
    let flips = run(plc, Steiner::Exact, Insertion::Flip(FlipOrder::FILTERED));
    let cavity = run(plc, Steiner::Exact, Insertion::Cavity);
    let (flips, cavity) = match (flips, cavity) {
        (Ok(flips), Ok(cavity)) => (flips, cavity),
        (Err(Failure::Invalid(a)), Err(Failure::Invalid(b))) => {
            assert_eq!(std::mem::discriminant(&a), std::mem::discriminant(&b));
            return None;
        }
        (Err(Failure::Delaunay(a)), Err(Failure::Delaunay(b))) => {
            assert_eq!(a, b);
            return None;
        }
        (a, b) => panic!("flips {:?}, cavity {:?}", a.err(), b.err()),
    };
    assert_eq!(flips.0, cavity.0);
    let exact =
        run(plc, Steiner::Exact, Insertion::Flip(FlipOrder::EXACT)).expect("as filtered ones");
    assert_eq!(flips.0, exact.0);
    for report in [&flips.1, &cavity.1] {
        assert_eq!(report.insertion_counts.not_flat, 0);
        assert_eq!(report.insertion_counts.shims, 0);
    }
    let verdict = verdict(plc, &flips.0);
    assert!(verdict.is_ok(), "{verdict}");
    assert_eq!(verdict.counts.exact_vertices, flips.1.steiner_not_doubles);
    assert_eq!(verdict.counts.segment_vertices_rounded, 0);
    check_rounding(&flips.0, &flips.1);
    Some(flips)
}

/// The tetrahedra that the report names are those that are not positive as they are written.
fn check_rounding(mesh: &ExportedMesh, report: &Report) {
    let points = DoublePoints::new(mesh.vertices.clone());
    let spoilt: Vec<usize> = (0..mesh.tets.len())
        .filter(|&t| !points.orient3d(mesh.tets[t]).is_positive())
        .collect();
    assert_eq!(spoilt, report.spoilt_by_rounding);
}

fn factor() -> impl Strategy<Value = f64> {
    prop_oneof![Just(1.0), Just(0.1), Just(1e-9), Just(1e12), 0.3..3.0]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    #[test]
    fn stretched_lattices(plc in lattice_with_rectangle(), s in [factor(), factor(), factor()]) {
        agree(&stretched(plc, s));
    }

    #[test]
    fn stretched_crossing_planes(plc in crossing_planes(), s in [factor(), factor(), factor()]) {
        agree(&stretched(plc, s));
    }

    #[test]
    fn stretched_walls(plc in walls(), s in [factor(), factor(), factor()]) {
        agree(&stretched(plc, s));
    }

    #[test]
    fn stretched_fins(plc in fins(), s in [factor(), factor(), factor()]) {
        agree(&stretched(plc, s));
    }

    #[test]
    fn turned_walls(plc in walls(), turn in [0.0..7.0, 0.0..7.0]) {
        agree(&turned(plc, turn));
    }

    #[test]
    fn turned_fins(plc in fins(), turn in [0.0..7.0, 0.0..7.0]) {
        agree(&turned(plc, turn));
    }

    /// Where no Steiner point needs more bits than a double has, exact and rounded ones are the same.
    #[test]
    fn without_rounding_both_are_one(plc in prop_oneof![walls(), crossing_planes(), sphere()]) {
        let filtered = Insertion::Flip(FlipOrder::FILTERED);
        if let (Ok(exact), Ok(rounded)) = (run(&plc, Steiner::Exact, filtered), run(&plc, Steiner::Rounded, filtered))
            && exact.1.steiner_not_doubles == 0
        {
            prop_assert_eq!(exact.0, rounded.0);
        }
    }

    /// Deleting and inserting a polygon is the identity, also with Steiner points on it.
    #[test]
    fn deletion_is_undone(
        plc in walls(),
        s in [factor(), factor(), factor()],
        turn in [0.0..7.0, 0.0..7.0],
        which in any::<prop::sample::Index>(),
    ) {
        for plc in [stretched(plc.clone(), s), turned(plc, turn)] {
            let mut report = Report::default();
            let filtered = Insertion::Flip(FlipOrder::FILTERED);
            let mut cdt = Cdt::begin(&plc, &options(Steiner::Exact, filtered), &mut report).expect("a valid PLC");
            cdt.insert_polygons(filtered, &mut report, &mut quiet).expect("a valid PLC");
            let before = cdt.export(&plc, true, &mut report).expect("a hull");
            let f = which.index(cdt.complex().polygons.len());
            cdt.delete_polygon(f).expect("a flat polygon can be deleted");
            cdt.insert_polygon(f, Insertion::Cavity, &mut report).expect("it was there");
            prop_assert_eq!(cdt.export(&plc, true, &mut report).expect("a hull"), before);
        }
    }
}

fn close_to_edges() -> Plc {
    let corners = [
        [0.1, 0.2, 0.3],
        [3.3, 0.7, 0.1],
        [0.9, 3.1, 0.2],
        [1.1, 1.3, 2.9],
    ];
    let mut plc = crate::common::plc_of_points(corners.to_vec());
    for (i, j) in [(0, 1), (1, 2), (2, 3), (0, 3)] {
        let near = |k: usize| {
            let middle = 0.48 * corners[i][k] + 0.52 * corners[j][k];
            let centre = corners.iter().map(|p| p[k] / 4.0).sum::<f64>();
            middle + 0.02 * (middle - centre)
        };
        plc.vertices.push([near(0), near(1), near(2)]);
    }
    plc.facets = [[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]]
        .map(|f| crate::common::families::facet(&f))
        .to_vec();
    plc
}

/// Two boxes, turned: their squares are not flat.
#[test]
fn polygons_flat_only_to_rounding_are_divided() {
    let mut plc = crate::common::plc_of_points(Vec::new());
    crate::common::box_facets(&mut plc, [2, 1, 1], 3.0, &[true]);
    plc.vertices.extend([[2.9, 1.4, 1.5], [3.1, 1.6, 1.5]]);
    let (mesh, report) = agree(&turned(plc.clone(), [0.3, 0.7])).expect("a valid PLC");
    assert!(report.triangulated_polygons > 0);
    // The diagonals are no segments of the input.
    assert_eq!(mesh.edges.len(), 20);
    let (_, report) = agree(&plc).expect("a valid PLC");
    assert_eq!(report.triangulated_polygons, 0);
}

/// A tetrahedron with vertices outside, close to its edges: Steiner points are exact, written, read back, and verified.
#[test]
fn positions_are_written_and_read() {
    let plc = close_to_edges();
    let (mesh, report) = agree(&plc).expect("a valid PLC");
    assert!(report.steiner_not_doubles > 0);
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("m.node");
    let written = write_mesh(&path, &mesh).unwrap();
    assert!(written.contains(&path.with_extension("steiner")));
    let read = read_mesh(&path).unwrap();
    // What is ours beside the files of TetGen is not read back.
    let mesh = ExportedMesh {
        face_table: FaceTable::default(),
        region_numbers: Vec::new(),
        ..mesh
    };
    assert_eq!(read, mesh);
    assert!(verdict(&plc, &read).is_ok());

    // A position that is not that of the coordinates is noticed.
    let mut moved = read.clone();
    moved.exact[0].t.value *= 0.5;
    assert_eq!(verdict(&plc, &moved).totals.get("wrong position"), Some(&1));
    // Without the positions the vertices are off their segments.
    let doubles = ExportedMesh {
        exact: Vec::new(),
        ..read
    };
    assert!(!verdict(&plc, &doubles).is_ok());

    // A mesh without exact positions takes the file of the earlier one away.
    write_mesh(
        &path,
        &ExportedMesh {
            exact: Vec::new(),
            ..mesh
        },
    )
    .unwrap();
    assert!(!path.with_extension("steiner").exists());
}
