//! A counter that any number of threads increase: its total depends on what they count only.

use std::sync::atomic::{AtomicUsize, Ordering};

/// More threads share a slot.
const SLOTS: usize = 16;

/// A part of the counter, in cache lines of its own, so that threads do not wait for each other.
#[derive(Default)]
#[repr(align(128))]
struct Slot(AtomicUsize);

/// The counter.
#[derive(Default)]
pub(crate) struct Tally([Slot; SLOTS]);

impl Tally {
    /// Counts one more.
    pub(crate) fn add(&self) {
        let thread = rayon::current_thread_index().unwrap_or(0);
        self.0[thread % SLOTS].0.fetch_add(1, Ordering::Relaxed);
    }

    /// How many were counted.
    pub(crate) fn total(&self) -> usize {
        let slots = self.0.iter();
        slots.map(|slot| slot.0.load(Ordering::Relaxed)).sum()
    }
}
