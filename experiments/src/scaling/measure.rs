//! One size, in a process of its own, so that its memory is known.

use super::plan::{Task, Work};
use super::row::Row;
use crate::outcome;
use crate::rivals::points::Spread;
use crate::rivals::{number_after, processor_seconds, run_limited};
use crate::sample::rounded;
use std::error::Error;
use std::time::Duration;
use tetflip::cdt::{Options, tetrahedralize};
use tetflip::delaunay::delaunay;
use tetflip::generate::generate;
use tetflip::mesh::VertexId;
use tetflip::predicate::DoublePoints;
use tetflip::report::Report;

/// A time for ten million points on a slow machine.
const LEAST_LIMIT: Duration = Duration::from_secs(600);

/// The row of a task.
pub fn measure(task: &Task, limit: Duration) -> Row {
    let this = std::env::current_exe().unwrap_or_default();
    let arguments = [
        "scale".to_string(),
        task.work.word().to_string(),
        task.size.to_string(),
    ];
    let ran = run_limited(&this.to_string_lossy(), &arguments, limit.max(LEAST_LIMIT));
    let after = |heading| number_after(&ran.text, heading).filter(|_| ran.ok);
    let seconds = after("seconds:");
    let count = |heading| after(heading).map(|n| n as usize);
    let per = |total: Option<f64>, n: usize| Some(rounded(total? / n as f64));
    let tetrahedra = count("tetrahedra:");
    let bytes = ran.peak_mebibytes.map(|m| m * 1024.0 * 1024.0);
    Row {
        input: task.work.word(),
        size: task.size,
        outcome: if seconds.is_some() {
            outcome::OK
        } else {
            "failed"
        },
        tetrahedra,
        steiner_points: count("steiner:"),
        seconds: seconds.map(rounded),
        microseconds_each: per(seconds.map(|s| s * 1e6), task.size),
        peak_mebibytes: ran.peak_mebibytes.map(rounded),
        bytes_per_tetrahedron: tetrahedra.and_then(|n| per(bytes, n)),
    }
}

/// What the process does.
///
/// # Errors
/// If the word is unknown, or there is no tetrahedralization.
pub fn take_part(word: &str, size: usize) -> Result<(), Box<dyn Error>> {
    let work = Work::ALL.into_iter().find(|w| w.word() == word);
    match work.ok_or_else(|| format!("unknown word {word}"))? {
        Work::Points => {
            let points = DoublePoints::new(Spread::Cube.points(size));
            let all: Vec<VertexId> = (0..size).map(VertexId::new).collect();
            let start = processor_seconds();
            let result = delaunay(&points, &all)?;
            println!("seconds: {}", processor_seconds() - start);
            println!("tetrahedra: {}", result.mesh.finite().count());
        }
        Work::Surface(kind) => {
            let plc = generate(kind, 1, size);
            let mut report = Report::default();
            let start = processor_seconds();
            let mesh = tetrahedralize(&plc, &Options::default(), &mut report, &mut |_| ())
                .map_err(|failure| failure.describe(&plc).to_string())?;
            println!("seconds: {}", processor_seconds() - start);
            println!("tetrahedra: {}", mesh.tets.len());
            println!("steiner: {}", report.steiner_points);
        }
    }
    Ok(())
}
