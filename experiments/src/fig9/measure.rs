//! One scene: every method on a copy of the same tetrahedralization, timed in turns and verified.

use crate::plan::Effort;
use crate::row::Row;
use tetflip::cdt::Cdt;
use tetflip::error::Failure;
use tetflip::mesh::ExportedMesh;
use tetflip::plc::Plc;
use tetflip::recover::polygons::PolygonCounts;
use tetflip::report::Report;
use tetflip::verify::{Domain, VerifyOptions, verify};
use tetflip_experiments::method::Method;
use tetflip_experiments::outcome;
use tetflip_experiments::sample::{median, minimum};
use tetflip_experiments::scene::Slab;

/// All runs of one method in one scene.
struct Runs {
    method: Method,
    seconds: Vec<f64>,
    /// Of the first run.
    counts: PolygonCounts,
    /// Of the first run: which of the scene's distinct meshes it gave.
    result: Result<usize, Failure>,
    /// Whether all runs had the same counts and the same outcome.
    repeatable: bool,
}

/// One row per method.
pub fn scene(slab: Slab, methods: &[Method], effort: &Effort) -> Vec<Row> {
    let plc = slab.plc();
    let mut report = Report::default();
    let cdt = match Cdt::with_segments(&plc, true, &mut report) {
        Ok(cdt) => cdt,
        Err(failure) => {
            let outcome = outcome::word::<()>(&Err(failure));
            let failed = |&m| Row {
                outcome,
                ..Row::new(slab, m)
            };
            return methods.iter().map(failed).collect();
        }
    };
    let mut meshes = Vec::new();
    let mut runs: Vec<Runs> = methods
        .iter()
        .map(|&m| first_run(&plc, &cdt, m, &mut meshes))
        .collect();
    repeat(&cdt, &mut runs, effort);
    // Equal meshes have equal verdicts, so each distinct one is verified once.
    let verified: Vec<bool> = meshes.iter().map(|m| is_cdt(&plc, m)).collect();
    let agree = meshes.windows(2).all(|m| m[0].tets == m[1].tets);
    let rows = runs.iter().map(|r| Row {
        steiner_points: report.steiner_points,
        repetitions: r.seconds.len(),
        median_seconds: median(&r.seconds),
        min_seconds: minimum(&r.seconds),
        outcome: outcome::word(&r.result),
        left: outcome::left(&r.result),
        repeatable: r.repeatable,
        agrees: r.result.is_ok().then_some(agree),
        verified: r.result.as_ref().ok().map(|&mesh| verified[mesh]),
        ..Row::new(slab, r.method).with_counts(&r.counts)
    });
    rows.collect()
}

/// Inserts the rectangle into a copy. The time is that of the insertion alone.
fn insert(cdt: &Cdt, method: Method) -> (Cdt, Report, Result<PolygonCounts, Failure>) {
    let (mut cdt, mut report) = (cdt.clone(), Report::default());
    let result = cdt.insert_polygons(method.0, &mut report, &mut |_| ());
    (cdt, report, result)
}

/// The first run of a method, whose mesh is exported and looked for among those that the scene has given already.
fn first_run(plc: &Plc, cdt: &Cdt, method: Method, meshes: &mut Vec<ExportedMesh>) -> Runs {
    let (mut cdt, report, result) = insert(cdt, method);
    let exported = result.and_then(|_| cdt.export(plc, true, &mut Report::default()));
    let result = exported.map(|mesh| {
        meshes.iter().position(|m| *m == mesh).unwrap_or_else(|| {
            meshes.push(mesh);
            meshes.len() - 1
        })
    });
    Runs {
        method,
        seconds: vec![report.seconds.polygons],
        counts: report.insertion_counts,
        result,
        repeatable: true,
    }
}

/// More runs, in rounds of one run of each method. Each round begins with another method, so that none always has the
/// same predecessor to warm, or to cool, the caches.
fn repeat(cdt: &Cdt, runs: &mut [Runs], effort: &Effort) {
    let first_round = runs.iter().map(|r| r.seconds[0]).sum();
    let methods = runs.len();
    for round in 1..effort.repetitions(first_round) {
        for i in 0..methods {
            let runs = &mut runs[(round + i) % methods];
            let (_, report, result) = insert(cdt, runs.method);
            runs.seconds.push(report.seconds.polygons);
            let same_end = match (&result, &runs.result) {
                (Ok(_), Ok(_)) => true,
                (Err(failure), Err(first)) => failure == first,
                _ => false,
            };
            runs.repeatable &= same_end && report.insertion_counts == runs.counts;
        }
    }
}

/// The exact and independent verdict: the CDT of the scene in the convex hull, nothing forgiven.
fn is_cdt(plc: &Plc, mesh: &ExportedMesh) -> bool {
    let options = VerifyOptions {
        domain: Domain::Hull,
        tolerance: 0.0,
        ..VerifyOptions::default()
    };
    verify(plc, mesh, options).is_ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use tetflip::recover::polygons::{Insertion, Times};

    const SLAB: Slab = Slab {
        vertices: 40,
        half_height: 0.01,
        seed: 1,
    };

    const EFFORT: Effort = Effort {
        seconds: 0.0,
        least: 3,
        most: 3,
    };

    #[test]
    fn a_small_scene_succeeds_in_all_ways() {
        let rows = scene(SLAB, &Method::all(), &EFFORT);
        assert_eq!(rows.len(), Method::all().len());
        for row in &rows {
            assert_eq!(row.outcome, "ok", "{}", row.name());
            assert_eq!((row.agrees, row.verified), (Some(true), Some(true)));
            assert!(row.repeatable && row.repetitions == 3);
            assert!(row.min_seconds <= row.median_seconds && row.min_seconds > Some(0.0));
            assert!((50..400).contains(&row.crossing_tets));
            assert_eq!(row.crossing_tets, rows[0].crossing_tets);
            assert_eq!(row.queued > 0, row.insertion == "flip");
        }
    }

    #[test]
    fn a_mesh_without_the_rectangle_is_no_cdt() {
        let plc = SLAB.plc();
        let mut report = Report::default();
        let mut cdt = Cdt::with_segments(&plc, true, &mut report).unwrap();
        let before = cdt.export(&plc, true, &mut report).unwrap();
        assert!(!is_cdt(&plc, &before));
        let exact = Insertion::Flip(Times::Exact);
        cdt.insert_polygons(exact, &mut report, &mut |_| ())
            .unwrap();
        let after = cdt.export(&plc, true, &mut report).unwrap();
        assert!(is_cdt(&plc, &after));
    }

    #[test]
    fn a_scene_without_a_tetrahedralization_has_rows() {
        // Nothing but the rectangle, which does not span space.
        let slab = Slab {
            vertices: 0,
            ..SLAB
        };
        let rows = scene(slab, &Method::all(), &EFFORT);
        assert_eq!(rows.len(), Method::all().len());
        for row in rows {
            assert_eq!(row.outcome, "flat-vertex-set");
            assert_eq!(
                (row.repetitions, row.median_seconds, row.verified),
                (0, None, None)
            );
        }
    }
}
