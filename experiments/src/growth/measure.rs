//! One size: both methods on copies of one tetrahedralization, timed in turns.

use crate::growth::row::Row;
use crate::method::Method;
use crate::outcome;
use crate::sample::{median, minimum, rounded};
use crate::scene::Slab;
use crate::turns::{Effort, Runs, Scene};
use tetflip::cdt::Cdt;
use tetflip::report::Report;

/// One row per method.
pub fn measure(slab: Slab, methods: &[Method], effort: &Effort) -> Vec<Row> {
    let plc = slab.plc();
    let mut report = Report::default();
    let of_scene = |method: Method| Row {
        seed: slab.seed,
        vertices: slab.vertices,
        half_height: slab.half_height,
        method: method.to_string(),
        ..Row::default()
    };
    let cdt = match Cdt::with_segments(&plc, true, &mut report) {
        Ok(cdt) => cdt,
        Err(failure) => {
            let outcome = outcome::word::<()>(&Err(failure));
            let failed = |&m: &Method| Row {
                outcome,
                ..of_scene(m)
            };
            return methods.iter().map(failed).collect();
        }
    };
    let scene = Scene::measure(&plc, &cdt, methods, effort, |_| false);
    let (agree, peak) = (scene.agrees(), peak_megabytes());
    let row = |r: &Runs| {
        let (counts, seconds) = (&r.counts, median(&r.seconds));
        let per_tet = |s| rounded(s * 1e6 / counts.crossing_tets as f64);
        Row {
            steiner_points: report.steiner_points,
            regions: counts.regions,
            crossing_tets: counts.crossing_tets,
            repetitions: r.seconds.len(),
            median_seconds: seconds,
            min_seconds: minimum(&r.seconds),
            microseconds_per_tet: seconds.map(per_tet).filter(|x| x.is_finite()),
            outcome: outcome::word(&r.result),
            flips: counts.flips.flips(),
            queued: counts.flips.queued,
            comparisons: counts.flips.comparisons,
            compared_exactly: counts.flips.compared_exactly,
            fallbacks: counts.cavity_fallbacks + counts.flip_fallbacks,
            peak_megabytes: peak,
            repeatable: r.repeatable,
            agrees: r.result.is_ok().then_some(agree),
            ..of_scene(r.method)
        }
    };
    scene.runs.iter().map(row).collect()
}

/// The most memory that this process has had so far, both meshes and the copies included; only Linux tells.
fn peak_megabytes() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|l| l.strip_prefix("VmHWM:"))?;
    let kilobytes: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(rounded(kilobytes / 1e3))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expectation::Expectation;
    use crate::growth::expect::expectations;
    use crate::growth::plan::{METHODS, Plan, slab};

    #[test]
    fn a_small_size_has_good_rows() {
        let rows = measure(slab(300), &METHODS, &Plan::quick().effort(1_000_000));
        assert!(expectations(&rows).iter().all(Expectation::holds));
        assert_eq!(rows.len(), 2);
        assert!((200..400).contains(&rows[0].crossing_tets));
        assert!(rows[0].flips > 0 && rows[1].flips == 0);
        assert!(rows.iter().all(|r| r.microseconds_per_tet > Some(0.0)));
    }

    #[test]
    fn a_scene_without_a_tetrahedralization_has_rows() {
        let rows = measure(slab(0), &METHODS, &Plan::quick().effort(0));
        assert!(rows.iter().all(|r| r.outcome == "flat-vertex-set"));
        assert!(!expectations(&rows)[0].holds());
    }
}
