//! Several methods on copies of one tetrahedralization, timed in turns.
//!
//! The methods take turns in rounds, each round beginning with another one, so that none always has the same
//! predecessor to warm, or to cool, the caches, and so that a busy minute of the machine meets all of them.

use super::method::Method;
use super::outcome;
use crate::rivals::process::processor_seconds;
use serde::Serialize;
use tetflip::cdt::Cdt;
use tetflip::error::Failure;
use tetflip::exchange::{ExportedMesh, Plc};
use tetflip::recover::polygons::PolygonCounts;
use tetflip::report::Report;
use tetflip::verify::{Domain, VerifyOptions, verify};

/// How often each insertion is timed: a time for one scene, in bounds.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// Seconds for all repetitions of all methods that are not slow.
    pub seconds: f64,
    /// Repetitions at least.
    pub least: usize,
    /// Repetitions at most.
    pub most: usize,
    /// Repetitions of slow methods.
    pub of_slow: usize,
}

impl Effort {
    /// The number of repetitions, given what the first round of the methods that are not slow took.
    pub fn repetitions(&self, first_round: f64) -> usize {
        // A cast from a float saturates.
        ((self.seconds / first_round) as usize).clamp(self.least, self.most)
    }
}

/// All runs of one method in one scene.
#[derive(Clone, Debug)]
pub struct Runs {
    /// The method.
    pub method: Method,
    /// Processor time of the insertion alone; of a failed one with the undoing of what it did. (One thread; and other
    /// work on the machine does not count.)
    pub seconds: Vec<f64>,
    /// Of the first run.
    pub counts: PolygonCounts,
    /// Of the first run: which of the scene's distinct meshes it gave.
    pub result: Result<usize, Failure>,
    /// Whether all runs had the same counts and the same outcome.
    pub repeatable: bool,
}

/// How the runs of a method ended. The README of the package has the meaning of the columns.
#[allow(missing_docs)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct End {
    pub outcome: &'static str,
    pub left: usize,
    pub repeatable: bool,
    pub agrees: Option<bool>,
    pub verified: Option<bool>,
}

impl End {
    /// Whether it succeeded.
    pub fn is_ok(&self) -> bool {
        self.outcome == outcome::OK
    }
}

/// The runs of all methods in one scene.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Of the segments.
    pub steiner_points: usize,
    /// In the order of the methods.
    pub runs: Vec<Runs>,
    /// The distinct meshes that they gave.
    pub meshes: Vec<ExportedMesh>,
}

impl Scene {
    /// Inserts the polygons of a PLC into copies of its tetrahedralization. Methods that are slow take part in the
    /// first rounds only.
    ///
    /// # Errors
    /// If there is no tetrahedralization with its segments.
    pub fn measure(
        plc: &Plc,
        methods: &[Method],
        effort: &Effort,
        is_slow: fn(Method) -> bool,
    ) -> Result<Scene, Failure> {
        let mut report = Report::default();
        let cdt = Cdt::with_segments(plc, true, &mut report)?;
        let mut meshes = Vec::new();
        let first = methods
            .iter()
            .map(|&m| first_run(plc, &cdt, m, &mut meshes));
        let mut runs: Vec<Runs> = first.collect();
        repeat(&cdt, &mut runs, effort, is_slow);
        Ok(Scene {
            steiner_points: report.steiner_points,
            runs,
            meshes,
        })
    }

    /// How the runs of each method ended, in the order of the methods.
    pub fn ends(&self, plc: &Plc) -> Vec<End> {
        let (verified, agree) = (self.verdicts(plc), self.agrees());
        let end = |r: &Runs| End {
            outcome: outcome::word(&r.result),
            left: outcome::left(&r.result),
            repeatable: r.repeatable,
            agrees: r.result.is_ok().then_some(agree),
            verified: r.result.as_ref().ok().map(|&mesh| verified[mesh]),
        };
        self.runs.iter().map(end).collect()
    }

    /// Whether all successful runs gave the same tetrahedra.
    pub fn agrees(&self) -> bool {
        self.meshes.windows(2).all(|m| m[0].tets == m[1].tets)
    }

    /// Of each distinct mesh, whether it is the CDT. Equal meshes have equal verdicts, so each distinct one is verified
    /// once.
    pub fn verdicts(&self, plc: &Plc) -> Vec<bool> {
        self.meshes.iter().map(|m| is_cdt(plc, m)).collect()
    }
}

/// Inserts the polygons into a copy. The report's seconds of polygons are replaced by processor time.
fn insert(cdt: &Cdt, method: Method) -> (Cdt, Report, Result<PolygonCounts, Failure>) {
    let (mut cdt, mut report) = (cdt.clone(), Report::default());
    let start = processor_seconds();
    let result = cdt.insert_polygons(method.0, &mut report, &mut |_| ());
    report.seconds.polygons = processor_seconds() - start;
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

fn repeat(cdt: &Cdt, runs: &mut [Runs], effort: &Effort, is_slow: fn(Method) -> bool) {
    let fast = runs.iter().filter(|r| !is_slow(r.method));
    let rounds = effort.repetitions(fast.map(|r| r.seconds[0]).sum());
    let methods = runs.len();
    for round in 1..rounds.max(effort.of_slow) {
        for i in 0..methods {
            let runs = &mut runs[(round + i) % methods];
            let slow = is_slow(runs.method);
            if round >= if slow { effort.of_slow } else { rounds } {
                continue;
            }
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
    use crate::inputs::slab::Slab;
    use tetflip::recover::polygons::{FlipOrder, Insertion};

    const SLAB: Slab = Slab {
        vertices: 40,
        half_height: 0.01,
        seed: 1,
    };

    const EFFORT: Effort = Effort {
        seconds: 0.6,
        least: 3,
        most: 5,
        of_slow: 2,
    };

    #[test]
    fn repetitions_fill_the_time() {
        assert_eq!(EFFORT.repetitions(EFFORT.seconds / 4.0), 4);
        assert_eq!(EFFORT.repetitions(1e3), EFFORT.least);
        assert_eq!(EFFORT.repetitions(0.0), EFFORT.most);
    }

    #[test]
    fn slow_methods_sit_out_later_rounds() {
        let plc = SLAB.plc();
        let is_slow = |m: Method| m.0 == Insertion::Flip(FlipOrder::EXACT);
        let scene = Scene::measure(&plc, &Method::all(), &EFFORT, is_slow).unwrap();
        for runs in &scene.runs {
            let expected = if is_slow(runs.method) { 2 } else { 5 };
            assert_eq!(runs.seconds.len(), expected, "{}", runs.method);
        }
        let good = End {
            outcome: "ok",
            left: 0,
            repeatable: true,
            agrees: Some(true),
            verified: Some(true),
        };
        assert!(scene.ends(&plc).iter().all(|end| *end == good));
    }

    #[test]
    fn a_mesh_without_the_rectangle_is_no_cdt() {
        let plc = SLAB.plc();
        let mut report = Report::default();
        let mut cdt = Cdt::with_segments(&plc, true, &mut report).unwrap();
        let before = cdt.export(&plc, true, &mut report).unwrap();
        let exact = Insertion::Flip(FlipOrder::EXACT);
        cdt.insert_polygons(exact, &mut report, &mut |_| ())
            .unwrap();
        let after = cdt.export(&plc, true, &mut report).unwrap();
        let scene = Scene {
            steiner_points: 0,
            runs: Vec::new(),
            meshes: vec![after, before],
        };
        assert_eq!(scene.verdicts(&plc), [true, false]);
        assert!(!scene.agrees());
    }
}
