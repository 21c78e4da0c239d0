//! Cavity insertion, gift wrapping, exact flips in every number type, and every order of insertion end in the same
//! tetrahedra, and the exact verifier accepts them.

use crate::common::families::{
    crossing_planes, facet, fins, lattice_with_rectangle, sphere, walls,
};
use crate::common::{plc_of_points, quiet};
use proptest::prelude::*;
use tetflip::cdt::{Options, tetrahedralize};
use tetflip::error::{Failure, GaveUp};
use tetflip::exchange::ExportedMesh;
use tetflip::exchange::{Facet, Plc};
use tetflip::mesh::VertexId;
use tetflip::recover::polygons::{FlipOrder, Insertion, NumberType, PolygonCounts};
use tetflip::report::Report;
use tetflip::verify::{Domain, VerifyOptions, verify};

fn run(plc: &Plc, insertion: Insertion) -> Result<(ExportedMesh, PolygonCounts), Failure> {
    let options = Options {
        insertion,
        keep_hull: true,
        ..Options::default()
    };
    let mut report = Report::default();
    let mesh = tetrahedralize(plc, &options, &mut report, &mut quiet)?;
    Ok((mesh, report.insertion_counts))
}

fn assert_verified(plc: &Plc, mesh: &ExportedMesh) {
    let options = VerifyOptions {
        domain: Domain::Hull,
        ..VerifyOptions::default()
    };
    let verdict = verify(plc, mesh, options);
    assert!(verdict.is_ok(), "{verdict}");
}

/// The exact algorithms on one PLC, whose polygons must all be flat with the Steiner points: equal meshes, or the same
/// complaint about the input. Returns the mesh.
fn agree(plc: &Plc) -> Option<ExportedMesh> {
    let flips = run(plc, Insertion::Flip(FlipOrder::EXACT));
    let cavity = run(plc, Insertion::Cavity);
    let (flips, cavity) = match (flips, cavity) {
        (Ok(flips), Ok(cavity)) => (flips, cavity),
        // Random input may be no PLC, or its polygons not flat once Steiner points are rounded.
        (Err(Failure::GaveUp(GaveUp::FlipOrder { .. })), _) => {
            panic!("exact order failed on a valid PLC")
        }
        (Err(a), Err(b)) => {
            assert_eq!(
                std::mem::discriminant(&a),
                std::mem::discriminant(&b),
                "{a}; {b}"
            );
            return None;
        }
        (a, b) => panic!(
            "one algorithm failed: flips {:?}, cavity {:?}",
            a.err(),
            b.err()
        ),
    };
    assert_eq!(flips.0, cavity.0);
    let wrapped = run(plc, Insertion::GiftWrap).expect("flips are its last resort");
    assert_eq!(wrapped.0, flips.0);
    if wrapped.1.not_flat == 0 {
        assert_eq!(wrapped.1.flip_fallbacks + cavity.1.flip_fallbacks, 0);
    }
    let filtered = run(plc, Insertion::Flip(FlipOrder::FILTERED)).expect("as with exact times");
    assert_eq!(filtered.0, flips.0);
    assert_eq!(
        filtered.1.flips.flips(),
        flips.1.flips.flips(),
        "the same flips in the same order"
    );
    assert_verified(plc, &flips.0);
    #[cfg(feature = "rug")]
    {
        let rug = run(plc, Insertion::Flip(FlipOrder::new(NumberType::Rug)))
            .expect("as the other exact number type");
        assert_eq!(rug.0, flips.0);
        assert_eq!(
            rug.1.flips, flips.1.flips,
            "the same flips in the same order"
        );
    }
    Some(flips.0)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn lattices_agree(plc in lattice_with_rectangle()) {
        agree(&plc);
    }

    #[test]
    fn crossing_planes_agree(plc in crossing_planes()) {
        agree(&plc);
    }

    #[test]
    fn walls_agree(plc in walls()) {
        agree(&plc);
    }

    #[test]
    fn fins_agree(plc in fins()) {
        agree(&plc);
    }

    #[test]
    fn spheres_agree(plc in sphere()) {
        agree(&plc);
    }

    /// Polygons in another order give the same mesh.
    #[test]
    fn order_of_polygons_does_not_matter(plc in crossing_planes(), seed in 0usize..24) {
        let (mut reordered, n) = (plc.clone(), plc.facets.len());
        reordered.facets.swap(0, seed % n);
        reordered.facets.swap(1, seed / n % n);
        for insertion in [Insertion::Cavity, Insertion::GiftWrap, Insertion::Flip(FlipOrder::EXACT)] {
            let (Ok(a), Ok(b)) = (run(&plc, insertion), run(&reordered, insertion)) else { continue };
            // Segments are numbered by first appearance, so Steiner points may differ; without them the meshes are
            // equal.
            if a.0.vertices.len() == plc.vertices.len() {
                prop_assert_eq!(a.0.tets, b.0.tets);
            }
        }
    }

    /// Rounded times never panic, and what they end in is either the same mesh or a typed outcome.
    #[test]
    fn rounded_times_end_in_a_mesh_or_an_outcome(plc in lattice_with_rectangle()) {
        let Some(exact) = agree(&plc) else { return Ok(()) };
        for times in [FlipOrder::new(NumberType::F32), FlipOrder::new(NumberType::F64Plain)] {
            match run(&plc, Insertion::Flip(times)) {
                Ok((mesh, _)) => prop_assert_eq!(&mesh, &exact),
                Err(Failure::GaveUp(GaveUp::Stuck { .. } | GaveUp::NotDelaunay { .. })) => {}
                Err(other) => prop_assert!(false, "{}", other),
            }
        }
    }
}

/// The smallest of the inputs on which the certification of a 4-4 flip's in-plane triangles was missing: seven lattice
/// points and a triangle.
#[test]
fn four_four_flip_certifies_its_own_plane() {
    let points = [
        [3, 4, 4],
        [2, 6, 6],
        [2, 5, 3],
        [6, 6, 4],
        [1, 5, 5],
        [2, 6, 4],
        [2, 5, 4],
    ];
    let mut plc = plc_of_points(points.map(|p| p.map(f64::from)).to_vec());
    plc.facets.push(facet(&[3, 4, 2]));
    assert!(agree(&plc).is_some());
    let (_, counts) = run(&plc, Insertion::Flip(FlipOrder::EXACT)).expect("a valid PLC");
    assert!(counts.flips.four_four > 0);
}

/// The rare ways of cavity retriangulation are taken, swallowing tetrahedra, displacing polygons and reinserting them,
/// and the mesh is still that of the flips.
#[test]
fn cavities_swallow_and_displace() {
    use proptest::strategy::ValueTree;
    let mut runner = proptest::test_runner::TestRunner::deterministic();
    let family = fins();
    let (mut swallowed, mut displaced, mut reinserted) = (0, 0, 0);
    for _ in 0..1500 {
        let plc = family.new_tree(&mut runner).expect("a PLC").current();
        let Ok((mesh, counts)) = run(&plc, Insertion::Cavity) else {
            continue;
        };
        swallowed += counts.swallowed;
        displaced += counts.displaced;
        reinserted += counts.reinserted;
        if counts.swallowed > 0 {
            let flips = run(&plc, Insertion::Flip(FlipOrder::FILTERED)).expect("as by cavities");
            assert_eq!(mesh, flips.0);
            // Where a cavity grows, one of its walls is not Delaunay, and hides vertices.
            let wrapped = run(&plc, Insertion::GiftWrap).expect("as by cavities");
            assert_eq!(mesh, wrapped.0);
            assert_eq!(wrapped.1.flip_fallbacks, 0);
        }
    }
    assert!(swallowed > 0 && displaced > 0 && reinserted > 0);
}

/// Segments in f part its missing region so that one part is next to no edge that is in the mesh at first.
#[test]
fn a_region_may_hide_behind_another() {
    let vertices = [
        [0, 2, 0],
        [5, 2, 2],
        [2, 3, 0],
        [3, 0, -1],
        [-2, -2, 0],
        [4, 2, 0],
        [2, -3, 0],
        [-7, 7, 0],
        [7, 7, 0],
        [-2, 2, 0],
        [-7, -7, 0],
        [3, 1, 1],
        [-4, -2, 0],
        [4, -2, 0],
        [7, -7, 0],
        [-3, 4, 3],
        [2, 3, -1],
        [-4, 2, 0],
        [5, 4, 2],
        [0, -2, 0],
        [5, -5, -1],
        [-3, 4, -3],
    ];
    let ids = |polygon: &[u32]| polygon.iter().map(|&v| VertexId(v)).collect();
    let polygons: [&[u32]; 6] = [
        &[10, 14, 8, 7],
        &[12, 17],
        &[4, 9],
        &[19, 0],
        &[6, 2],
        &[13, 5],
    ];
    let plc = Plc {
        vertices: vertices.map(|p| p.map(f64::from)).to_vec(),
        facets: vec![Facet {
            polygons: polygons.map(ids).to_vec(),
            ..Facet::default()
        }],
        ..Plc::default()
    };
    assert!(agree(&plc).is_some());
}
