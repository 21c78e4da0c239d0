//! Sorting a run: by about when times are, which needs no comparisons, and then by moving what is not in its place.

use super::{Entry, EventQueue};
use crate::kinetic::TimeOrder;
use std::cmp::Ordering;

impl<O: TimeOrder> EventQueue<O> {
    /// Sorts the run: into buckets by what its times are about, if that is known, and then by moving what is not in its
    /// place. Where that is too much, by comparisons alone.
    pub(super) fn sort_run(&mut self, order: &mut O) {
        let mut run = std::mem::take(&mut self.run);
        let is_sorted = self.distribute(&mut run) && self.move_into_place(order, &mut run)
            || sort_by_about::<O>(&mut run, self.latest_first)
                && self.move_into_place(order, &mut run);
        if !is_sorted {
            run.sort_unstable_by(|&a, &b| {
                if self.precedes(order, a, b) {
                    Ordering::Greater
                } else {
                    Ordering::Less
                }
            });
        }
        self.run = run;
    }

    /// Brings a run into the order of as many buckets as it has entries, which divide its time evenly. `false` if it
    /// has no times to divide.
    fn distribute(&mut self, run: &mut Vec<Entry<O::Key>>) -> bool {
        if run.len() < 2 {
            return true;
        }
        let sign = if self.latest_first { -1.0 } else { 1.0 };
        let about = |entry: &Entry<O::Key>| O::about(entry.key).map_or(f64::NAN, |t| sign * t);
        let (mut first, mut last) = (f64::INFINITY, f64::NEG_INFINITY);
        for entry in &*run {
            let time = about(entry);
            if !time.is_finite() {
                return false;
            }
            first = first.min(time);
            last = last.max(time);
        }
        let scale = run.len() as f64 / (last - first);
        if !scale.is_finite() {
            return false;
        }
        // The last comes first.
        let most = run.len() - 1;
        let bucket = |entry: &Entry<O::Key>| (((last - about(entry)) * scale) as usize).min(most);
        self.buckets.clear();
        self.buckets.resize(run.len(), 0);
        for entry in &*run {
            self.buckets[bucket(entry)] += 1;
        }
        let mut start = 0;
        for n in &mut self.buckets {
            start += std::mem::replace(n, start);
        }
        self.sorted.clear();
        self.sorted.extend_from_slice(run);
        for &entry in &self.sorted {
            let place = &mut self.buckets[bucket(&entry)];
            run[*place as usize] = entry;
            *place += 1;
        }
        true
    }

    /// Moves what is not in its place in a run that is nearly in order. Gives up where that is too much, and says so.
    fn move_into_place(&mut self, order: &mut O, run: &mut [Entry<O::Key>]) -> bool {
        let mut moves = 0;
        for i in 1..run.len() {
            let entry = run[i];
            let mut hole = i;
            while hole > 0 && self.precedes(order, run[hole - 1], entry) {
                run[hole] = run[hole - 1];
                hole -= 1;
            }
            run[hole] = entry;
            moves += i - hole;
            if moves > 2 * run.len() {
                return false;
            }
        }
        true
    }
}

/// Sorts a run by what its times are about. `false` if that is not known.
fn sort_by_about<O: TimeOrder>(run: &mut [Entry<O::Key>], latest_first: bool) -> bool {
    let about = |entry: &Entry<O::Key>| O::about(entry.key);
    if run.first().is_some_and(|first| about(first).is_none()) {
        return false;
    }
    run.sort_unstable_by(|a, b| {
        let (a, b) = (about(a).unwrap_or(0.0), about(b).unwrap_or(0.0));
        b.total_cmp(&a)
    });
    if latest_first {
        run.reverse();
    }
    true
}
