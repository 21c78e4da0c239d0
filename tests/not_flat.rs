//! Polygons that are flat only to rounding (paper, end of §3.1 and of §3.2): whatever it takes, both algorithms end in
//! meshes that the verifier accepts.
//!
//! `NOT_FLAT_CASES=2000 cargo test --release --test not_flat -- --ignored --nocapture` looks harder, and prints counts.

mod common;

use common::almost_flat::FAMILIES;
use common::quiet;
use tetflip::cdt::{Options, tetrahedralize};
use tetflip::mesh::VertexId;
use tetflip::plc::{Facet, Plc};
use tetflip::recover::flatten::FlatteningCounts;
use tetflip::recover::polygons::{Insertion, Times};
use tetflip::report::Report;
use tetflip::verify::{Domain, VerifyOptions, verify};

const INSERTIONS: [Insertion; 2] = [Insertion::Flip(Times::Filtered), Insertion::Cavity];

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
    ["prism", "box", "bar", "boxes"].contains(&name)
}

/// Runs all families; returns a line for each failure.
fn survey(cases: u64, insertions: &[Insertion]) -> Vec<String> {
    let mut failures = Vec::new();
    for (name, family) in FAMILIES {
        for &insertion in insertions {
            let (mut not_flat, mut refined, mut left_whole, mut shims) = (0, 0, 0, 0);
            for seed in 0..cases {
                let keep_hull = !is_closed(name) || seed % 2 == 0;
                match run(&family(seed), insertion, keep_hull) {
                    Ok(counts) => {
                        not_flat += counts.not_flat;
                        refined += u64::from(counts.rounds > 0);
                        left_whole += u64::from(counts.left_whole > 0);
                        shims += u64::from(counts.shims > 0);
                    }
                    Err(message) => {
                        failures.push(format!("{name} {seed} {insertion:?}: {message}"));
                    }
                }
            }
            println!(
                "{name} {insertion:?}: {not_flat} polygons not flat; meshes with Steiner points for them: {refined}, with some left whole: {left_whole}, with shims: {shims}"
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
#[ignore = "minutes"]
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
        Insertion::Flip(Times::Filtered),
        Insertion::Flip(Times::Exact),
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
