//! The check of the input beside a run that takes long: where parts of the input intersect, more and more Steiner
//! points are inserted between them, and most of the time would be spent on what fails in the end.
//!
//! Checking takes about as long as meshing a surface that needs no Steiner points. So it begins only when many are
//! needed, on another thread if there is one, and the run ends as soon as something is found that cannot be repaired. A
//! valid input is not held up, and what comes of it does not depend on any of this.

use super::MeshOptions;
use crate::check::{Findings, check_to};
use crate::exchange::{Note, Plc};
use crate::repair::{LISTED, RepairOptions, Repaired, repair};
use std::borrow::Cow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// The check begins when so many Steiner points are needed at least, and so many more for each facet.
const FEW: usize = 64;
const PER_FACET: f64 = 1.0 / 32.0;

/// What a look at an input comes to.
#[derive(Clone, Debug)]
pub(super) enum Verdict {
    /// It is valid.
    Valid,
    /// It was not; this is, and the notes tell what has been repaired.
    Repaired(Box<Plc>, Vec<Note>),
    /// It is not valid, and may not or cannot be repaired.
    Wrong(Box<Findings>),
}

impl Verdict {
    /// Looks at an input, and repairs it if that is necessary and allowed. The cost is that of [`check`] or, if it can
    /// be repaired, a few times that.
    pub fn of(plc: &Plc, options: &MeshOptions, delta: f64) -> Verdict {
        if options.strict {
            let findings = check_to(plc, Some(LISTED), delta);
            return match findings.is_valid() {
                true => Verdict::Valid,
                false => Verdict::Wrong(Box::new(findings)),
            };
        }
        let options = RepairOptions {
            strict: false,
            merge_coplanar: options.merge_coplanar,
            delta,
        };
        match repair(plc, options) {
            Ok(Repaired { plc, notes }) => match plc {
                Cow::Borrowed(_) => Verdict::Valid,
                Cow::Owned(plc) => Verdict::Repaired(Box::new(plc), notes),
            },
            Err(findings) => Verdict::Wrong(findings),
        }
    }

    /// Whether there is something that no repair mends.
    fn is_hopeless(&self) -> bool {
        matches!(self, Verdict::Wrong(findings) if !findings.is_repairable())
    }
}

/// A check that may begin.
pub(super) struct EarlyCheck<'a> {
    plc: &'a Plc,
    options: &'a MeshOptions,
    /// The precision of the input.
    delta: f64,
    begun: AtomicBool,
    state: Arc<State>,
}

#[derive(Default)]
struct State {
    /// Nobody waits for the result any more.
    over: AtomicBool,
    hopeless: AtomicBool,
    verdict: Mutex<Option<Verdict>>,
}

impl<'a> EarlyCheck<'a> {
    /// A check that has not begun.
    pub fn new(plc: &'a Plc, options: &'a MeshOptions, delta: f64) -> EarlyCheck<'a> {
        EarlyCheck {
            plc,
            options,
            delta,
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
        !self.state.hopeless.load(Ordering::Acquire)
    }

    fn begin(&self) {
        if rayon::current_num_threads() < 2 {
            return;
        }
        let (plc, options, delta) = (self.plc.clone(), *self.options, self.delta);
        let state = Arc::clone(&self.state);
        rayon::spawn(move || {
            if state.over.load(Ordering::Relaxed) {
                return;
            }
            let verdict = Verdict::of(&plc, &options, delta);
            let is_hopeless = verdict.is_hopeless();
            *state.verdict.lock().unwrap_or_else(PoisonError::into_inner) = Some(verdict);
            if is_hopeless {
                state.hopeless.store(true, Ordering::Release);
            }
        });
    }

    /// The verdict. If it is not there yet, it is found here: to wait for another thread may be to wait for one that
    /// waits for this one.
    pub fn verdict(self) -> Verdict {
        let verdict = self.state.verdict.lock();
        let found = verdict.unwrap_or_else(PoisonError::into_inner).take();
        found.unwrap_or_else(|| Verdict::of(self.plc, self.options, self.delta))
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
            let options = MeshOptions::default();
            let early = EarlyCheck::new(&plc, &options, 0.0);
            assert!(early.go_on(10) && !early.begun.load(Ordering::Relaxed));
            let start = Instant::now();
            while early.go_on(1000) {
                assert!(start.elapsed() < Duration::from_secs(60), "it never ends");
                std::thread::sleep(Duration::from_millis(1));
            }
            let verdict = early.verdict();
            let Verdict::Wrong(findings) = verdict else {
                panic!("{verdict:?}");
            };
            assert_eq!(findings.conflicts.len(), 1);
        });
    }

    #[test]
    fn a_run_on_a_valid_input_goes_on() {
        let plc = triangles(false);
        let options = MeshOptions::default();
        let early = EarlyCheck::new(&plc, &options, 0.0);
        for _ in 0..50 {
            assert!(early.go_on(1000));
            std::thread::sleep(Duration::from_millis(1));
        }
        assert!(early.begun.load(Ordering::Relaxed));
        assert!(matches!(early.verdict(), Verdict::Valid));
    }
}
