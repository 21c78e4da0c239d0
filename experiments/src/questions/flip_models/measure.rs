//! One model: its polygons inserted in exact order, and then with every arm.

use super::row::{OfModel, Row};
use super::trial::{Reference, Trial};
use crate::inputs::suite::Model;
use crate::measure::outcome;
use std::borrow::Cow;
use tetflip::cdt::{Cdt, Options};
use tetflip::error::Failure;
use tetflip::exchange::Plc;
use tetflip::mesh::VertexId;
use tetflip::predicate::Steiner;
use tetflip::recover::polygons::{FlipOrder, Insertion};
use tetflip::repair::{RepairOptions, repair};
use tetflip::report::Report;

/// One row per arm.
pub fn measure(model: &Model, arms: &[FlipOrder]) -> Vec<Row> {
    let mut of_model = OfModel {
        source: model.source,
        model: model.name.clone(),
        ..OfModel::default()
    };
    let plc = match model.plc() {
        Ok(plc) => plc,
        Err(_) => {
            of_model.outcome = "unreadable";
            return arms.iter().map(|&arm| Row::new(&of_model, arm)).collect();
        }
    };
    of_model.vertices = plc.vertices.len();
    of_model.facets = plc.facets.len();
    match prepare(&plc, &mut of_model) {
        Ok((cdt, reference)) => {
            let of_arm = |&arm: &FlipOrder| run(&cdt, &reference, &of_model, arm);
            arms.iter().map(of_arm).collect()
        }
        Err(failure) => {
            of_model.outcome = outcome::word::<()>(&Err(failure));
            arms.iter().map(|&arm| Row::new(&of_model, arm)).collect()
        }
    }
}

/// The Delaunay tetrahedralization with all segments, and what the exact order makes of its regions. As the program
/// does: rounded Steiner points first; then what is exactly repairable is repaired; and then exact Steiner points.
fn prepare(plc: &Plc, of_model: &mut OfModel) -> Result<(Cdt, Reference), Failure> {
    let mut plc = Cow::Borrowed(plc);
    let mut result = prepared(&plc, Steiner::Rounded, of_model);
    if result.is_err()
        && let Ok(repaired) = repair(&plc, RepairOptions::default())
    {
        if let Cow::Owned(repaired) = repaired.plc {
            plc = Cow::Owned(repaired);
            result = prepared(&plc, Steiner::Rounded, of_model);
        }
        if result.is_err() {
            result = prepared(&plc, Steiner::Exact, of_model);
        }
    }
    result
}

fn prepared(
    plc: &Plc,
    steiner: Steiner,
    of_model: &mut OfModel,
) -> Result<(Cdt, Reference), Failure> {
    let mut report = Report::default();
    let options = Options {
        steiner,
        ..Options::default()
    };
    let cdt = Cdt::begin(plc, &options, &mut report)?;
    let reference = Reference::default();
    let mut by_flips = cdt.clone();
    let counts = by_flips.insert_polygons_in(&reference, &mut report, None)?;
    let mut by_cavities = cdt.clone();
    let cavities = by_cavities.insert_polygons(Insertion::Cavity, &mut report, &mut |_| ());
    of_model.steiner = match steiner {
        Steiner::Rounded => "rounded",
        Steiner::Exact => "exact",
    };
    of_model.polygons = report.polygons;
    of_model.steiner_points = report.steiner_points;
    of_model.regions = counts.regions;
    of_model.not_flat = counts.regions - reference.flat();
    of_model.crossing_tets = counts.crossing_tets;
    of_model.largest_region = counts.largest_region;
    // Of polygons that are not flat nothing is proved.
    let agrees = cavities.is_ok() && tets(&by_cavities) == tets(&by_flips);
    of_model.agrees = (of_model.not_flat == 0).then_some(agrees);
    of_model.outcome = outcome::OK;
    Ok((cdt, reference))
}

fn tets(cdt: &Cdt) -> Vec<[VertexId; 4]> {
    let mesh = cdt.mesh();
    let mut tets: Vec<[VertexId; 4]> = mesh.finite().map(|t| mesh.vertices(t)).collect();
    tets.iter_mut().for_each(|t| t.sort_unstable());
    tets.sort_unstable();
    tets
}

fn run(cdt: &Cdt, reference: &Reference, of_model: &OfModel, arm: FlipOrder) -> Row {
    let trial = Trial::new(arm, reference);
    let mut cdt = cdt.clone();
    let result = cdt.insert_polygons_in(&trial, &mut Report::default(), None);
    let mut row = Row::new(of_model, arm);
    row.of_model.outcome = outcome::word(&result);
    row.count(&trial.into_seen());
    row
}

#[cfg(test)]
mod tests {
    use super::super::{ARMS, arms};
    use super::*;
    use crate::families::Member;

    fn model(plc: &Plc) -> (tempfile::TempDir, Model) {
        let directory = tempfile::tempdir().expect("a directory");
        let path = directory.path().join("model.poly");
        tetflip::format::write_poly(&path, plc).expect("written");
        (directory, Model::of_file(path))
    }

    /// Of the paper's failure, f64:plain fails in its one region; the exact order does not.
    #[test]
    fn a_failure_is_counted_and_the_model_goes_on() {
        let member: Member = "prism/end:78".parse().expect("a name");
        let mut plc = member.prepare().plc;
        // A second copy of it, so that there is a region after the failure.
        let n = plc.vertices.len();
        let moved: Vec<[f64; 3]> = plc
            .vertices
            .iter()
            .map(|&[x, y, z]| [x + 4096.0, y, z])
            .collect();
        plc.vertices.extend(moved);
        let mut second = plc.facets.clone();
        for v in second.iter_mut().flat_map(|f| &mut f.polygons).flatten() {
            *v = VertexId::new(v.index() + n);
        }
        plc.facets.extend(second);
        let (_directory, model) = model(&plc);
        let rows = measure(&model, &arms());
        assert_eq!(rows.len(), ARMS);
        let of = |times: &str| rows.iter().find(|r| r.arm.times == times).expect("a row");
        assert!(
            rows.iter()
                .all(|r| r.is_ok() && r.of_model.agrees == Some(true))
        );
        let model = &of("f64:plain").of_model;
        let (plain, exact) = (&of("f64:plain").counts, &of("filtered").counts);
        assert!(model.regions >= 2 && plain.tried == model.regions);
        assert!(
            plain.failed_regions >= 1 && plain.failed_regions == plain.stuck + plain.not_delaunay
        );
        assert_eq!((exact.failed_regions, exact.patched_regions), (0, 0));
        assert_eq!(exact.tied_regions, plain.tied_regions);
    }

    #[test]
    fn what_cannot_be_read_or_meshed_has_rows() {
        let (directory, _) = model(&Plc::default());
        let path = directory.path().join("none.off");
        std::fs::write(&path, "OFF 3").expect("written");
        let rows = measure(&Model::of_file(path), &arms());
        assert!(rows.iter().all(|r| r.of_model.outcome == "unreadable"));
        let flat = Plc {
            vertices: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            ..Plc::default()
        };
        let (_directory, model) = model(&flat);
        let rows = measure(&model, &arms());
        assert!(rows.iter().all(|r| !r.is_ok() && r.counts.tried == 0));
    }
}
