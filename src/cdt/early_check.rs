//! The check of the input beside a run that takes long: where parts of the input intersect, more and more Steiner
//! points are inserted between them, and most of the time would be spent on what fails in the end.
//!
//! Checking takes about as long as meshing a surface that needs no Steiner points. So it begins only when many are
//! needed, on another thread if there is one, and the run ends as soon as the input is known to be invalid. A valid
//! input is not held up, and what comes of it does not depend on any of this.

use crate::check::{Findings, check};
use crate::exchange::Plc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// The check begins when so many Steiner points are needed at least, and so many more for each facet.
const FEW: usize = 64;
const PER_FACET: f64 = 1.0 / 32.0;

/// A check that may begin.
pub(super) struct EarlyCheck<'a> {
    plc: &'a Plc,
    most: usize,
    begun: AtomicBool,
    state: Arc<State>,
}

#[derive(Default)]
struct State {
    /// Nobody waits for the result any more.
    over: AtomicBool,
    invalid: AtomicBool,
    findings: Mutex<Option<Findings>>,
}

impl<'a> EarlyCheck<'a> {
    /// A check that looks for `most` intersections.
    pub fn new(plc: &'a Plc, most: usize) -> EarlyCheck<'a> {
        EarlyCheck {
            plc,
            most,
            begun: AtomicBool::new(false),
            state: Arc::default(),
        }
    }

    /// Whether a run that needs so many Steiner points at least is worth going on.
    pub fn go_on(&self, needed: usize) -> bool {
        let many = FEW + (PER_FACET * self.plc.facets.len() as f64) as usize;
        if needed >= many && !self.begun.swap(true, Ordering::Relaxed) {
            self.begin();
        }
        !self.state.invalid.load(Ordering::Acquire)
    }

    fn begin(&self) {
        if rayon::current_num_threads() < 2 {
            return;
        }
        let (plc, most) = (self.plc.clone(), self.most);
        let state = Arc::clone(&self.state);
        rayon::spawn(move || {
            if state.over.load(Ordering::Relaxed) {
                return;
            }
            let findings = check(&plc, Some(most));
            if !findings.is_valid() {
                *state
                    .findings
                    .lock()
                    .unwrap_or_else(PoisonError::into_inner) = Some(findings);
                state.invalid.store(true, Ordering::Release);
            }
        });
    }

    /// What makes the input invalid, if it was found.
    pub fn findings(&self) -> Option<Findings> {
        let mut findings = self.state.findings.lock();
        findings
            .as_mut()
            .map_or_else(|poisoned| poisoned.get_mut().take(), |found| found.take())
    }
}

impl Drop for EarlyCheck<'_> {
    fn drop(&mut self) {
        self.state.over.store(true, Ordering::Relaxed);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exchange::Facet;
    use crate::mesh::VertexId;
    use std::time::{Duration, Instant};

    /// Two triangles that cross, or do not.
    fn triangles(crossing: bool) -> Plc {
        let z = if crossing { -1.0 } else { 1.0 };
        let facet = |first: u32| Facet {
            polygons: vec![[0, 1, 2].map(|v| VertexId(first + v)).to_vec()],
            ..Facet::default()
        };
        Plc {
            vertices: vec![
                [0., 0., 0.],
                [8., 0., 0.],
                [0., 8., 0.],
                [1., 1., z],
                [3., 1., 2.],
                [1., 3., 2.],
            ],
            facets: vec![facet(0), facet(3)],
            ..Plc::default()
        }
    }

    #[test]
    fn a_long_run_on_an_invalid_input_ends() {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build();
        pool.expect("two threads").install(|| {
            let plc = triangles(true);
            let early = EarlyCheck::new(&plc, 3);
            assert!(early.go_on(10) && !early.begun.load(Ordering::Relaxed));
            let start = Instant::now();
            while early.go_on(1000) {
                assert!(start.elapsed() < Duration::from_secs(60), "it never ends");
                std::thread::sleep(Duration::from_millis(1));
            }
            let findings = early.findings().expect("a reason");
            assert_eq!(findings.conflicts.len(), 1);
        });
    }

    #[test]
    fn a_run_on_a_valid_input_goes_on() {
        let plc = triangles(false);
        let early = EarlyCheck::new(&plc, 3);
        for _ in 0..50 {
            assert!(early.go_on(1000));
            std::thread::sleep(Duration::from_millis(1));
        }
        assert!(early.findings().is_none());
    }
}
