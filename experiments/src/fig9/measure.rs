//! One scene: every method on a copy of the same tetrahedralization, timed in turns and verified.

use crate::fig9::row::Row;
use crate::method::Method;
use crate::outcome;
use crate::sample::{median, minimum};
use crate::scene::Slab;
use crate::turns::{Effort, Scene};
use tetflip::cdt::Cdt;
use tetflip::report::Report;

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
    // All methods are timed equally often.
    let scene = Scene::measure(&plc, &cdt, methods, effort, |_| false);
    let (verified, agree) = (scene.verdicts(&plc), scene.agrees());
    let rows = scene.runs.iter().map(|r| Row {
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

#[cfg(test)]
mod tests {
    use super::*;

    const SLAB: Slab = Slab {
        vertices: 40,
        half_height: 0.01,
        seed: 1,
    };

    const EFFORT: Effort = Effort {
        seconds: 0.0,
        least: 3,
        most: 3,
        of_slow: 0,
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
