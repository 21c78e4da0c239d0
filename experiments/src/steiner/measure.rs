//! One model: this library, with the mesh verified, and the rivals.

use crate::outcome;
use crate::sample::rounded;
use crate::steiner::families::Model;
use crate::steiner::rival::Rival;
use crate::steiner::row::Row;
use std::time::Duration;
use tetflip::cdt::{Cdt, Options};
use tetflip::error::Failure;
use tetflip::exchange::ExportedMesh;
use tetflip::exchange::Plc;
use tetflip::report::Report;
use tetflip::verify::{Domain, VerifyOptions, verify};

/// What tables call this library.
pub const TETFLIP: &str = "tetflip";

/// One row per method.
pub fn measure(source: &'static str, model: &Model, rivals: &[Rival], limit: Duration) -> Vec<Row> {
    let plc = &model.plc;
    let mut rows = vec![ours(plc)];
    rows.extend(rivals.iter().map(|rival| {
        let run = rival.run(plc, limit);
        Row {
            method: rival.name.clone(),
            steiner_points: run.steiner_points,
            seconds: rounded(run.seconds),
            outcome: run.outcome,
            ..Row::default()
        }
    }));
    for row in &mut rows {
        row.source = source;
        row.model.clone_from(&model.name);
        row.vertices = plc.vertices.len();
    }
    rows
}

/// Segment recovery is what counts: the outcome and the seconds are its own, and polygons that cannot be inserted leave
/// `verified` empty.
fn ours(plc: &Plc) -> Row {
    let mut report = Report::default();
    let result = Cdt::with_segments(plc, true, &mut report);
    let outcome = outcome::word(&result);
    let counts = result.is_ok();
    let mut row = Row {
        method: TETFLIP.to_string(),
        segments: counts.then_some(report.segments),
        steiner_points: counts.then_some(report.steiner_points),
        on_segment: counts.then_some(report.steiner_points_on_segment),
        seconds: rounded(report.seconds.segments),
        outcome,
        ..Row::default()
    };
    if let Ok(mut cdt) = result
        && let Ok(mesh) = mesh(&mut cdt, plc, &mut report)
    {
        let options = VerifyOptions {
            domain: Domain::Hull,
            ..VerifyOptions::default()
        };
        row.verified = Some(verify(plc, &mesh, options).is_ok());
    }
    row
}

fn mesh(cdt: &mut Cdt, plc: &Plc, report: &mut Report) -> Result<ExportedMesh, Failure> {
    cdt.insert_polygons(Options::default().insertion, report, &mut |_| ())?;
    cdt.export(plc, true, report)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expectation::Expectation;
    use crate::steiner::expect::expectations;
    use crate::steiner::families::models;

    #[test]
    fn small_models_have_good_rows() {
        let all = models(true);
        let small = all.iter().filter(|m| m.plc.vertices.len() < 20);
        let rows: Vec<Row> = small
            .flat_map(|m| measure(crate::steiner::BUILT_IN, m, &[], Duration::ZERO))
            .collect();
        assert!(rows.len() >= 6);
        assert!(rows.iter().all(|r| r.verified == Some(true)));
        assert!(expectations(&rows).iter().all(Expectation::holds));
    }
}
