//! One model: the phases, several times.

use super::Row;
use crate::inputs::suite::Model;
use crate::measure::outcome;
use crate::measure::sample::{median, rounded};
use tetflip::cdt::{Cdt, Options};
use tetflip::error::Failure;
use tetflip::exchange::{ExportedMesh, Plc};
use tetflip::predicate::Steiner;
use tetflip::recover::polygons::{FlipOrder, Insertion};
use tetflip::report::Report;
use tetflip::verify::{VerifyOptions, verify};

/// Gift wrapping takes quadratic time: it runs once, and only where regions are small.
const MOST_WRAPPED: u64 = 3000;

/// One algorithm on one model.
struct Made {
    report: Report,
    mesh: ExportedMesh,
}

/// The row. What fails has the outcome of the first algorithm that fails, and the counts so far.
pub fn measure(model: &Model, rounds: usize) -> Row {
    let mut row = Row {
        source: model.source,
        model: model.name.clone(),
        beside: model.beside,
        ..Row::default()
    };
    let Ok(plc) = model.plc() else {
        row.outcome = "unreadable";
        return row;
    };
    row.vertices = plc.vertices.len();
    row.facets = Some(plc.facets.len());
    // As the program does: rounded Steiner points, and exact ones where these have no solution.
    row.steiner = "rounded";
    let mut result = all_rounds(&plc, rounds, Steiner::Rounded, &mut row);
    if let Err(Failure::GaveUp(_)) = result {
        row.steiner = "exact";
        result = all_rounds(&plc, rounds, Steiner::Exact, &mut row);
    }
    row.outcome = outcome::word(&result);
    row
}

fn all_rounds(plc: &Plc, rounds: usize, steiner: Steiner, row: &mut Row) -> Result<(), Failure> {
    let flips = Insertion::Flip(FlipOrder::FILTERED);
    let mut cavity_runs = Vec::new();
    let mut flip_runs = Vec::new();
    for _ in 0..rounds {
        cavity_runs.push(make(plc, Insertion::Cavity, steiner)?);
        flip_runs.push(make(plc, flips, steiner)?);
    }
    let (by_cavity, by_flips) = (&cavity_runs[0], &flip_runs[0]);
    let report = &by_flips.report;
    let counts = report.insertion_counts;
    row.polygons = report.polygons;
    row.steiner_points = report.steiner_points;
    row.tetrahedra = report.output_tets;
    row.subpolygons = report.output_faces;
    row.recovered = counts.recovered;
    row.most_recovered = counts.most_recovered;
    row.flips = counts.flips.flips();
    row.crossing_tets = counts.crossing_tets;
    row.largest_region = counts.largest_region;
    row.mean_region =
        (counts.regions > 0).then(|| rounded(counts.crossing_tets as f64 / counts.regions as f64));
    let of = |runs: &[&[Made]], seconds: fn(&Report) -> f64| -> Option<f64> {
        let sample: Vec<f64> = runs
            .iter()
            .copied()
            .flatten()
            .map(|r| seconds(&r.report))
            .collect();
        median(&sample).map(rounded)
    };
    let both = [&cavity_runs[..], &flip_runs];
    row.delaunay_seconds = of(&both, |r| r.seconds.delaunay);
    row.segment_seconds = of(&both, |r| r.seconds.segments + r.seconds.flattening);
    row.cavity_seconds = of(&both[..1], |r| r.seconds.polygons);
    row.flip_seconds = of(&both[1..], |r| r.seconds.polygons);
    row.total_seconds = of(&both[..1], |r| {
        let s = &r.seconds;
        s.complex + s.delaunay + s.segments + s.flattening + s.polygons + s.domain
    });
    let mut agrees = by_cavity.mesh == by_flips.mesh;
    if counts.largest_region <= MOST_WRAPPED {
        let wrapped = make(plc, Insertion::GiftWrap, steiner)?;
        row.gift_wrap_seconds = Some(rounded(wrapped.report.seconds.polygons));
        agrees &= wrapped.mesh == by_flips.mesh;
    }
    row.agrees = Some(agrees);
    let verdict = verify(plc, &by_flips.mesh, VerifyOptions::default());
    row.verified = Some(verdict.is_ok());
    Ok(())
}

fn make(plc: &Plc, insertion: Insertion, steiner: Steiner) -> Result<Made, Failure> {
    let mut report = Report::default();
    let options = Options {
        insertion,
        steiner,
        ..Options::default()
    };
    let mut cdt = Cdt::begin(plc, &options, &mut report)?;
    cdt.insert_polygons(insertion, &mut report, &mut |_| ())?;
    // What encloses nothing keeps its hull.
    let mesh = cdt.export(plc, false, &mut report);
    let mesh = mesh.or_else(|_| cdt.export(plc, true, &mut report))?;
    Ok(Made { report, mesh })
}
