//! Polygons that are flat only to rounding (paper, end of §3.1 and of §3.2): whatever it takes, both algorithms end in
//! meshes that the verifier accepts.
//!
//! `NOT_FLAT_CASES=2000 cargo test --release --test suite not_flat -- --nocapture` looks harder, and prints counts.

use crate::common::almost_flat::FAMILIES;
use crate::common::quiet;
use tetflip::cdt::{Options, tetrahedralize};
use tetflip::error::{Failure, GaveUp};
use tetflip::exchange::{Facet, Plc};
use tetflip::mesh::VertexId;
use tetflip::predicate::Steiner;
use tetflip::recover::flatten::FlatteningCounts;
use tetflip::recover::flatten::ShimCounts;
use tetflip::recover::polygons::{FlipOrder, Insertion};
use tetflip::report::Report;
use tetflip::verify::{Domain, VerifyOptions, verify};

const INSERTIONS: [Insertion; 2] = [Insertion::Flip(FlipOrder::FILTERED), Insertion::Cavity];

/// The mesh's counts, or what went wrong.
fn run(plc: &Plc, insertion: Insertion, keep_hull: bool) -> Result<FlatteningCounts, String> {
    let options = Options {
        insertion,
        keep_hull,
        merge_coplanar: true,
        ..Options::default()
    };
    let mut report = Report::default();
    let mesh = tetrahedralize(plc, &options, &mut report, &mut quiet)
        .map_err(|failure| failure.to_string())?;
    let domain = if keep_hull {
        Domain::Hull
    } else {
        Domain::Inside
    };
    let verdict = verify(
        plc,
        &mesh,
        VerifyOptions {
            domain,
            ..VerifyOptions::default()
        },
    );
    if verdict.is_ok() {
        Ok(report.flattening)
    } else {
        Err(format!(
            "refused: {:?}: {}; {:?}",
            verdict.totals.keys().collect::<Vec<_>>(),
            verdict.violations[0],
            report.flattening
        ))
    }
}

/// Whether a family encloses something.
fn is_closed(name: &str) -> bool {
    ["prism", "box", "bar", "boxes", "flange", "boss"].contains(&name)
}

/// Runs all families; returns a line for each failure.
fn survey(cases: u64, insertions: &[Insertion]) -> Vec<String> {
    let mut failures = Vec::new();
    for (name, family) in FAMILIES {
        for &insertion in insertions {
            let (mut not_flat, mut refined, mut left_whole, mut repaired, mut kept) =
                (0, 0, 0, 0, 0);
            for seed in 0..cases {
                let keep_hull = !is_closed(name) || seed % 2 == 0;
                match run(&family(seed), insertion, keep_hull) {
                    Ok(counts) => {
                        not_flat += counts.not_flat;
                        refined += u64::from(counts.rounds > 0);
                        left_whole += u64::from(counts.left_whole > 0);
                        repaired += counts.shims.found - counts.shims.kept;
                        kept += counts.shims.kept;
                    }
                    Err(message) => {
                        failures.push(format!("{name} {seed} {insertion:?}: {message}"));
                    }
                }
            }
            println!(
                "{name} {insertion:?}: {not_flat} polygons not flat; meshes with Steiner points for \
                 them: {refined}, with some left whole: {left_whole}; shims repaired: {repaired}, kept: {kept}"
            );
            assert!(
                not_flat > 0,
                "{name} is a family of polygons that are not flat"
            );
        }
    }
    failures
}

#[test]
fn a_few_of_every_family() {
    assert_eq!(survey(12, &INSERTIONS), Vec::<String>::new());
}

#[test]
fn many_of_every_family() {
    let cases = std::env::var("NOT_FLAT_CASES").ok();
    let cases = cases.and_then(|n| n.parse().ok()).unwrap_or(500);
    let failures = survey(cases, &INSERTIONS);
    for failure in &failures {
        println!("{failure}");
    }
    assert_eq!(failures.len(), 0);
}

/// Cavities, gift wrapping and flips find the same tetrahedra, as all pieces are flat.
#[test]
fn algorithms_agree() {
    let insertions = [
        Insertion::Flip(FlipOrder::FILTERED),
        Insertion::Flip(FlipOrder::EXACT),
        Insertion::Cavity,
        Insertion::GiftWrap,
    ];
    let mut compared = 0;
    for (name, family) in FAMILIES {
        for seed in 0..6 {
            let mesh = |insertion| {
                let options = Options {
                    insertion,
                    keep_hull: true,
                    merge_coplanar: true,
                    ..Options::default()
                };
                let mut report = Report::default();
                let mesh = tetrahedralize(&family(seed), &options, &mut report, &mut quiet);
                (
                    report.flattening.left_whole,
                    mesh.expect("a valid PLC").tets,
                )
            };
            let [first, others @ ..] = insertions.map(mesh);
            if first.0 == 0 {
                assert!(others.iter().all(|mesh| *mesh == first), "{name} {seed}");
                compared += 1;
            }
        }
    }
    assert!(compared > 50);
}

/// Paper, Fig. 4: neither diagonal of a quadrilateral that is not flat is legal, as p is above it and q below, both in
/// the circumsphere. It gets a Steiner point.
#[test]
fn incompatible_sides_get_a_steiner_point() {
    let e = 2f64.powi(-48);
    let quadrilateral = [[-1., 0., e], [0., -1., -e], [1., 0., e], [0., 1., -e]];
    let facet = Facet {
        polygons: vec![[0, 1, 2, 3].map(VertexId).to_vec()],
        ..Facet::default()
    };
    let figure = |apexes: &[[f64; 3]]| Plc {
        vertices: [&quadrilateral[..], apexes].concat(),
        facets: vec![facet.clone()],
        ..Plc::default()
    };
    let steiner_points = |plc: &Plc, insertion| {
        let options = Options {
            insertion,
            keep_hull: true,
            merge_coplanar: true,
            ..Options::default()
        };
        let mut report = Report::default();
        let mesh = tetrahedralize(plc, &options, &mut report, &mut quiet).expect("a valid PLC");
        let options = VerifyOptions {
            domain: Domain::Hull,
            ..VerifyOptions::default()
        };
        assert!(verify(plc, &mesh, options).is_ok());
        assert_eq!(report.flattening.not_flat, 1);
        report.steiner_points
    };
    for insertion in INSERTIONS {
        assert!(steiner_points(&figure(&[[0., 0., 0.25], [0., 0., -0.25]]), insertion) > 0);
        // With p alone there is no conflict.
        assert_eq!(
            steiner_points(&figure(&[[0., 0., 0.25], [0., 0., 2.0]]), insertion),
            0
        );
    }
}

/// Like [`run`], with the tetrahedra.
fn shims(plc: &Plc, insertion: Insertion, keep_hull: bool) -> (ShimCounts, Vec<[VertexId; 4]>) {
    let options = Options {
        insertion,
        keep_hull,
        ..Options::default()
    };
    let mut report = Report::default();
    let mesh = tetrahedralize(plc, &options, &mut report, &mut quiet).expect("a valid PLC");
    let domain = if keep_hull {
        Domain::Hull
    } else {
        Domain::Inside
    };
    let options = VerifyOptions {
        domain,
        ..VerifyOptions::default()
    };
    let verdict = verify(plc, &mesh, options);
    assert!(verdict.is_ok(), "{verdict}");
    (report.flattening.shims, mesh.tets)
}

/// Where the domain is on one side of a polygon, shims are left on the other side of it, whichever way it is turned.
#[test]
fn shims_at_the_boundary_are_left_outside() {
    let mut repaired = 0;
    for (name, family) in FAMILIES {
        if name != "prism" && name != "bar" {
            continue;
        }
        for seed in 0..12 {
            let plc = family(seed);
            let mut turned = plc.clone();
            for corners in turned.facets.iter_mut().flat_map(|f| &mut f.polygons) {
                corners.reverse();
            }
            for plc in [&plc, &turned] {
                let [flips, cavities] = INSERTIONS.map(|insertion| shims(plc, insertion, false));
                assert!(flips == cavities, "{name} {seed}");
                assert_eq!(flips.0.kept, 0, "{name} {seed}");
                repaired += flips.0.two_two;
            }
        }
    }
    assert!(repaired > 20, "{repaired}");
}

fn plc(points: &[[f64; 3]], facets: &[&[usize]]) -> Plc {
    let facet = |corners: &&[usize]| Facet {
        polygons: vec![corners.iter().map(|&v| VertexId::new(v)).collect()],
        ..Facet::default()
    };
    Plc {
        vertices: points.to_vec(),
        facets: facets.iter().map(facet).collect(),
        ..Plc::default()
    }
}

/// Four boxes, two by two, turned, with vertices inside.
fn four_rotated_boxes() -> Plc {
    plc(
        &[
            [0.0, -0.0, 0.0],
            [1.8668339962693912, -0.6562424138283551, -0.2903045377971014],
            [1.8668339962693912, -1.4653557743703547, 1.5387213148885386],
            [0.0, -0.8091133605419996, 1.82902585268564],
            [3.7336679925387823, -1.3124848276567103, -0.5806090755942028],
            [3.7336679925387823, -2.1215981881987096, 1.2484167770914372],
            [-0.7175868103392472, -1.707243820924582, -0.7552401641477888],
            [1.149247185930144, -2.363486234752937, -1.0455447019448902],
            [1.149247185930144, -3.172599595294937, 0.7834811507407498],
            [-0.7175868103392472, -2.5163571814665815, 1.0737856885378512],
            [-1.4351736206784944, -3.414487641849164, -1.5104803282955777],
            [0.43166037559089676, -4.070730055677519, -1.800784866092679],
            [
                0.43166037559089676,
                -4.879843416219519,
                0.028240986592960926,
            ],
            [-1.4351736206784944, -4.223601002391163, 0.31854552439006234],
            [2.298494371860288, -4.726972469505874, -2.0910894038897805],
            [2.298494371860288, -5.536085830047874, -0.2620635512041405],
            [3.0160811821995352, -3.019728648581292, -1.3358492397419917],
            [3.0160811821995352, -3.8288420091232913, 0.49317661294364834],
            [2.1811895598926783, -2.736247700220742, 0.05017822124553706],
            [
                1.3489523373872545,
                -4.214832641998746,
                -0.029023828817573483,
            ],
            [
                -0.05170435143641694,
                -1.8250406865226296,
                -0.47966767231878343,
            ],
            [
                -0.41244440005221616,
                -3.2187995339594653,
                0.007789444767101195,
            ],
        ],
        &[
            &[0, 1, 2, 3],
            &[1, 4, 5, 2],
            &[6, 7, 8, 9],
            &[10, 11, 12, 13],
            &[11, 14, 15, 12],
            &[0, 6, 9, 3],
            &[1, 7, 8, 2],
            &[4, 16, 17, 5],
            &[6, 10, 13, 9],
            &[16, 14, 15, 17],
            &[0, 6, 7, 1],
            &[3, 9, 8, 2],
            &[1, 7, 16, 4],
            &[2, 8, 17, 5],
            &[6, 10, 11, 7],
            &[9, 13, 12, 8],
            &[7, 11, 14, 16],
            &[8, 12, 15, 17],
        ],
    )
}

/// The lower of two crossing edges is not always the one to cut along: on the hull every edge is Delaunay from outside.
#[test]
fn cuts_along_upper_edges_where_lower_ones_do_not_do() {
    for insertion in INSERTIONS {
        let counts = run(&four_rotated_boxes(), insertion, false);
        assert!(counts.is_ok_and(|c| c.left_whole == 0), "{insertion:?}");
    }
}

/// CGAL's `1452672-min1.off`: segment 3-2 passes segment 4-0 at a distance of 8e-28, 1.5e-14, about an ulp, from vertex
/// 3.
fn an_ulp_apart() -> Plc {
    plc(
        &[
            [-67.7882151786552, -78.8990375234974, 24.1822920114423],
            [-67.7882151786555, -82.3684947474054, 20.2941771394655],
            [-67.7882151786551, -78.7684947474054, 22.3082058185067],
            [-67.7882151786552, -78.8606722910787, 24.1648110492912],
            [-67.7882151786552, -77.9132941549825, 23.7331420538019],
            [-66.7747752933219, -83.6684947474054, 20.2941771394655],
            [-66.7747752933219, -87.0177872274054, 20.2941771394655],
            [-71.2628099428864, -85.9799747862706, 20.2941771394655],
            [-71.1079493149412, -84.2544096274054, 20.2941771394655],
            [-71.1079493149412, -83.7544096274054, 20.2941771394655],
        ],
        &[&[3, 2, 4], &[4, 0, 3], &[6, 1, 5], &[8, 7, 9]],
    )
}

/// Rounded Steiner points cannot keep such segments apart; exact ones do.
#[test]
fn segments_less_than_an_ulp_apart() {
    let options = |steiner| Options {
        keep_hull: true,
        steiner,
        ..Options::default()
    };
    let plc = an_ulp_apart();
    let mesh = |steiner| {
        let mut report = Report::default();
        tetrahedralize(&plc, &options(steiner), &mut report, &mut quiet)
    };
    let failure = mesh(Steiner::Rounded).expect_err("they come too close");
    assert!(
        matches!(&failure, Failure::GaveUp(GaveUp::SegmentsTooClose { .. })),
        "{failure}"
    );
    let mesh = mesh(Steiner::Exact).expect("a valid PLC");
    let hull = VerifyOptions {
        domain: Domain::Hull,
        ..VerifyOptions::default()
    };
    assert!(verify(&plc, &mesh, hull).is_ok());
}

/// A quadrilateral on the hull that gets Steiner points, among them circumcenters of small triangles whose planes are
/// not its plane.
#[test]
fn steiner_points_stay_on_the_plane() {
    let e = 2f64.powi(-48);
    let points = [
        [0., -1., -e],
        [1., 0., e],
        [0., 1., -e],
        [0., e, -1.],
        [e, 0., -1.],
        [-e, 0., -1.],
        [-1., 0., e],
    ];
    let plc = plc(&points, &[&[0, 1, 2, 6]]);
    for insertion in INSERTIONS {
        run(&plc, insertion, true).expect("accepted");
    }
}
