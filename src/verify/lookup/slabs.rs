//! Which of many intervals hold a number: the line is cut into slabs, each of which knows the intervals that reach
//! into it.
//!
//! The number of slabs is chosen such that there are O(m) entries for m intervals. A query costs what is in its slab.

/// The intervals by slabs.
pub(crate) struct Slabs {
    low: f64,
    /// Slabs per unit.
    scale: f64,
    /// The entries of slab s are `entries[start[s]..start[s + 1]]`.
    start: Vec<u32>,
    entries: Vec<u32>,
}

/// Entries per interval.
const ENTRIES: f64 = 6.0;

/// The sum of the lengths of intervals in units of the whole: how many of them a number is in on the average.
pub(crate) fn depth(intervals: &[[f64; 2]]) -> f64 {
    let [low, high] = hull(intervals);
    let lengths: f64 = intervals.iter().map(|[a, b]| b - a).sum();
    match high > low {
        true => lengths / (high - low),
        false => intervals.len() as f64,
    }
}

fn hull(intervals: &[[f64; 2]]) -> [f64; 2] {
    let low = intervals.iter().fold(f64::INFINITY, |m, i| m.min(i[0]));
    [
        low,
        intervals.iter().fold(f64::NEG_INFINITY, |m, i| m.max(i[1])),
    ]
}

impl Slabs {
    /// Of intervals [low, high], low ≤ high.
    pub(crate) fn new(intervals: &[[f64; 2]]) -> Slabs {
        let [low, high] = hull(intervals);
        // Every interval has one entry, and one for each border between slabs that it spans.
        let slabs = (ENTRIES * intervals.len() as f64 / depth(intervals).max(1.0)).max(1.0);
        let scale = slabs / (high - low);
        let mut all = Slabs {
            low,
            // Where everything is at one place, or the difference over- or underflows, there is one slab.
            scale: if scale.is_finite() { scale } else { 0.0 },
            start: vec![0; slabs as usize + 2],
            entries: Vec::new(),
        };
        for &[a, b] in intervals {
            for s in all.slab(a)..=all.slab(b) {
                all.start[s + 1] += 1;
            }
        }
        for s in 1..all.start.len() {
            all.start[s] += all.start[s - 1];
        }
        all.entries = vec![0; all.start[all.start.len() - 1] as usize];
        let mut next = all.start.clone();
        for (i, &[a, b]) in intervals.iter().enumerate() {
            for place in &mut next[all.slab(a)..=all.slab(b)] {
                all.entries[*place as usize] = i as u32;
                *place += 1;
            }
        }
        all
    }

    /// The slab of a number. Monotone: no operation on the way rounds a larger number to a smaller one.
    fn slab(&self, x: f64) -> usize {
        let last = self.start.len() - 2;
        (((x - self.low) * self.scale) as usize).min(last)
    }

    /// The intervals that hold a number between the two, and some others; none twice.
    pub(crate) fn around(&self, low: f64, high: f64, found: &mut Vec<u32>) {
        let (first, last) = (self.slab(low), self.slab(high));
        found.clear();
        found.extend(&self.entries[self.start[first] as usize..self.start[last + 1] as usize]);
        if first < last {
            found.sort_unstable();
            found.dedup();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn no_interval_is_missed(
            pairs in prop::collection::vec((-50i32..50, 0i32..30), 1..60),
            x in -60i32..90,
            width in 0i32..9,
        ) {
            let intervals: Vec<[f64; 2]> = pairs
                .iter()
                .map(|&(a, length)| [f64::from(a) / 7.0, f64::from(a + length) / 7.0])
                .collect();
            let [low, high] = [f64::from(x) / 7.0, f64::from(x + width) / 7.0];
            let mut found = Vec::new();
            Slabs::new(&intervals).around(low, high, &mut found);
            for (i, [a, b]) in intervals.iter().enumerate() {
                let times = found.iter().filter(|&&j| j as usize == i).count();
                prop_assert!(times <= 1);
                prop_assert!(times == 1 || *a > high || *b < low);
            }
        }
    }

    #[test]
    fn degenerate_intervals() {
        let mut found = Vec::new();
        Slabs::new(&[[2.0, 2.0], [2.0, 2.0]]).around(2.0, 2.0, &mut found);
        assert_eq!(found, [0, 1]);
        Slabs::new(&[[-f64::MAX, f64::MAX], [0.0, f64::MIN_POSITIVE]]).around(0.0, 0.0, &mut found);
        assert_eq!(found, [0, 1]);
    }
}
