//! One input: every method on a copy of the same tetrahedralization, timed in turns and verified.

use super::input::Input;
use super::plan;
use super::row::{Row, decided};
use crate::measure::method::Method;
use crate::measure::outcome;
use crate::measure::rounds::{Effort, Runs, Scene};
use crate::measure::sample::{median, minimum};

/// One row per method.
pub fn measure(input: &Input, methods: &[Method], effort: &Effort) -> Vec<Row> {
    let plc = input.plc();
    let scene = match Scene::measure(&plc, methods, effort, plan::is_slow) {
        Ok(scene) => scene,
        Err(failure) => {
            let outcome = outcome::word::<()>(&Err(failure));
            let failed = |&m| Row {
                outcome,
                ..Row::new(input, m)
            };
            return methods.iter().map(failed).collect();
        }
    };
    let (verified, agree) = (scene.verdicts(&plc), scene.agrees());
    let row = |r: &Runs| {
        let (counts, flips) = (&r.counts, &r.counts.flips);
        let decided = decided(r.method, flips);
        Row {
            vertices: plc.vertices.len(),
            steiner_points: scene.steiner_points,
            crossing_tets: counts.crossing_tets,
            repetitions: r.seconds.len(),
            median_seconds: median(&r.seconds),
            min_seconds: minimum(&r.seconds),
            outcome: outcome::word(&r.result),
            left: outcome::left(&r.result),
            comparisons: flips.comparisons,
            by_floats: decided.map(|d| d.by_floats),
            by_exact_quotients: decided.map(|d| d.by_exact_quotients),
            by_perturbation: decided.map(|d| d.by_perturbation),
            big_quotients: flips.big_quotients,
            queued: flips.queued,
            stale: flips.stale,
            flips: flips.flips(),
            patches: flips.postponed + flips.discarded_outside + flips.non_crossing,
            fallbacks: counts.cavity_fallbacks + counts.flip_fallbacks,
            repeatable: r.repeatable,
            agrees: r.result.is_ok().then_some(agree),
            verified: r.result.as_ref().ok().map(|&mesh| verified[mesh]),
            ..Row::new(input, r.method)
        }
    };
    scene.runs.iter().map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::super::input::{Cut, Kind};
    use super::super::plan::methods;
    use super::super::row::expectations;
    use super::*;
    use crate::frame::Expectation;

    #[test]
    fn ties_are_the_perturbations_and_random_times_are_floats() {
        let effort = Effort {
            seconds: 0.0,
            least: 1,
            most: 1,
            of_slow: 1,
        };
        let filtered = |kind| {
            let input = Input {
                kind,
                about: 300,
                seed: 1,
            };
            let rows = measure(&input, &methods(), &effort);
            assert_eq!(rows.len(), methods().len());
            assert!(expectations(&rows).iter().all(Expectation::holds));
            let mut rows = rows.into_iter();
            rows.find(|r| r.method == "flip filtered").expect("a row")
        };
        let slab = filtered(Kind::Slab);
        // Flips of one circuit are due at the same time, whatever the coordinates are.
        assert!(slab.is_ok() && slab.by_floats > Some(0.97), "{slab:?}");
        assert!(slab.by_exact_quotients < Some(0.01), "{slab:?}");
        let lattice = filtered(Kind::Lattice(Cut::Between));
        assert!(lattice.by_perturbation > Some(0.2), "{lattice:?}");
        assert!(lattice.repetitions == 1 && lattice.flips > 100);
    }
}
