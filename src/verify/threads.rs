//! Work on many elements, done by all threads of the pool in chunks; what comes out is in the order of the elements, and does not
//! depend on the number of threads.

use rayon::prelude::*;
use std::ops::Range;

/// Chunks for each thread, so that none waits long for the others.
const EACH: usize = 4;

/// `0..n` in parts: one, if there is one thread or there are fewer than two times `least`, else parts of `least` at least.
fn ranges(n: usize, least: usize) -> Vec<Range<usize>> {
    // The pool is not even started for a few elements.
    if n < 2 * least || rayon::current_num_threads() == 1 {
        return std::iter::once(0..n).collect();
    }
    let parts = (EACH * rayon::current_num_threads()).min(n / least);
    let bound = |k: usize| (n as u128 * k as u128 / parts as u128) as usize;
    (0..parts).map(|k| bound(k)..bound(k + 1)).collect()
}

/// What `work` makes of parts of `0..n`, in order.
pub(super) fn in_parts<T: Send>(
    n: usize,
    least: usize,
    work: impl Fn(Range<usize>) -> T + Sync,
) -> Vec<T> {
    match &ranges(n, least)[..] {
        [one] => vec![work(one.clone())],
        several => several.par_iter().cloned().map(&work).collect(),
    }
}

/// What `work` makes of each item, in order; one item is not worth while to wake a thread.
pub(super) fn each<I: Send, T: Send>(
    items: impl Iterator<Item = I>,
    work: impl Fn(I) -> T + Sync,
) -> Vec<T> {
    let items: Vec<I> = items.collect();
    match items.len() {
        0 | 1 => items.into_iter().map(work).collect(),
        _ => items.into_par_iter().map(&work).collect(),
    }
}

/// The elements that `find` pushes for each of `0..n`, in order.
pub(super) fn collect<T: Send>(
    n: usize,
    least: usize,
    find: impl Fn(usize, &mut Vec<T>) + Sync,
) -> Vec<T> {
    let parts = in_parts(n, least, |range| {
        let mut found = Vec::new();
        range.for_each(|i| find(i, &mut found));
        found
    });
    let mut parts = parts.into_iter();
    let mut all = parts.next().unwrap_or_default();
    parts.for_each(|part| all.extend(part));
    all
}

/// How many of `0..n` are such.
pub(super) fn count(n: usize, least: usize, is_such: impl Fn(usize) -> bool + Sync) -> usize {
    let parts = in_parts(n, least, |range| range.filter(|&i| is_such(i)).count());
    parts.into_iter().sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_in_order_with_any_number_of_threads() {
        for threads in [1, 3] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
            pool.build().expect("a pool").install(|| {
                for (n, least) in [(0, 1), (1, 1), (7, 4), (1000, 1), (1000, 90), (9, 2)] {
                    let parts = in_parts(n, least, |range| range);
                    assert!(threads == 1 || n < 2 * least || parts.len() > 1);
                    assert!(parts.len() == 1 || parts.iter().all(|p| p.len() >= least));
                    let all: Vec<usize> = parts.into_iter().flatten().collect();
                    assert!(all.into_iter().eq(0..n));
                    let pairs = collect(n, least, |i, found| found.extend([i; 2]));
                    assert!(pairs.into_iter().eq((0..n).flat_map(|i| [i; 2])));
                    assert_eq!(count(n, least, |i| i % 3 == 0), n.div_ceil(3));
                }
            });
        }
    }
}
