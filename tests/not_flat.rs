//! Polygons that are flat only to rounding (paper, end of §3.1 and of §3.2): whatever it takes, both algorithms end in
//! meshes that the verifier accepts.
//!
//! `NOT_FLAT_CASES=2000 cargo test --release --test not_flat -- --ignored --nocapture` looks harder, and prints counts.

mod common;

use common::almost_flat::FAMILIES;
use common::quiet;
use std::collections::BTreeMap;
use tetflip::cdt::{Options, tetrahedralize};
use tetflip::plc::Plc;
use tetflip::recover::polygons::{Insertion, PolygonCounts, Times};
use tetflip::report::Report;
use tetflip::verify::{Domain, VerifyOptions, verify};

const INSERTIONS: [Insertion; 2] = [Insertion::Flip(Times::Filtered), Insertion::Cavity];

/// The mesh's counts, or what went wrong.
fn run(plc: &Plc, insertion: Insertion, keep_hull: bool) -> Result<PolygonCounts, String> {
    let options = Options {
        insertion,
        keep_hull,
        merge_coplanar: true,
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
        Ok(report.insertion_counts)
    } else {
        Err(format!(
            "refused: {:?}: {}",
            verdict.totals.keys().collect::<Vec<_>>(),
            verdict.violations[0]
        ))
    }
}

/// Whether a family encloses something.
fn is_closed(name: &str) -> bool {
    ["prism", "box", "bar", "boxes"].contains(&name)
}

/// A sentence without its numbers.
fn kind(message: &str) -> String {
    let words = message
        .split(' ')
        .filter(|w| !w.contains(|c: char| c.is_ascii_digit()));
    words.collect::<Vec<_>>().join(" ")
}

#[test]
#[ignore = "minutes"]
fn survey() {
    let cases = std::env::var("NOT_FLAT_CASES")
        .ok()
        .and_then(|n| n.parse().ok())
        .unwrap_or(500);
    let mut failed = 0;
    for (name, family) in FAMILIES {
        for insertion in INSERTIONS {
            let mut failures: BTreeMap<String, Vec<u64>> = BTreeMap::new();
            let (mut not_flat, mut shims) = (0, 0);
            for seed in 0..cases {
                let keep_hull = !is_closed(name) || seed % 2 == 0;
                if std::env::var("ONLY").is_ok_and(|o| o != name)
                    || std::env::var("SEED").is_ok_and(|s| s != seed.to_string())
                {
                    continue;
                }
                let start = std::time::Instant::now();
                let r = run(&family(seed), insertion, keep_hull);
                if start.elapsed().as_secs_f64() > 2.0 {
                    println!("{name} {seed}: {:?}", start.elapsed());
                }
                match r {
                    Ok(counts) => {
                        not_flat += counts.not_flat;
                        shims += u64::from(counts.shims > 0);
                    }
                    Err(message) => {
                        if std::env::var_os("ONLY").is_some() {
                            println!("{message}");
                        }
                        failures.entry(kind(&message)).or_default().push(seed)
                    }
                }
            }
            println!(
                "{name} {insertion:?}: {not_flat} polygons not flat, {shims} meshes with shims"
            );
            for (message, seeds) in failures {
                failed += seeds.len();
                println!(
                    "    {} {message}: {:?}",
                    seeds.len(),
                    &seeds[..seeds.len().min(8)]
                );
            }
        }
    }
    assert_eq!(failed, 0);
}
