//! Work on many elements, done by all threads of the pool in chunks; what comes out is in the order of the elements,
//! and does not depend on the number of threads.

use rayon::prelude::*;
use std::ops::Range;

/// Chunks for each thread, so that none waits long for the others.
const EACH: usize = 4;

/// `0..n` in parts: one, if there is one thread or there are fewer than two times `least`, else parts of `least` at
/// least.
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
pub(crate) fn in_parts<T: Send>(
    n: usize,
    least: usize,
    work: impl Fn(Range<usize>) -> T + Sync,
) -> Vec<T> {
    match &ranges(n, least)[..] {
        [one] => vec![work(one.clone())],
        several => several.par_iter().cloned().map(&work).collect(),
    }
}

/// What `work` makes of each item, in order; by one thread if there are fewer than `least`.
pub(crate) fn each<I: Send, T: Send>(
    items: impl ExactSizeIterator<Item = I>,
    least: usize,
    work: impl Fn(I) -> T + Sync,
) -> Vec<T> {
    if items.len() < least || rayon::current_num_threads() == 1 {
        return items.map(work).collect();
    }
    let items: Vec<I> = items.collect();
    items.into_par_iter().map(&work).collect()
}

/// What `find` makes of each of `0..n`, in order.
pub(crate) fn map<T: Send>(n: usize, least: usize, find: impl Fn(usize) -> T + Sync) -> Vec<T> {
    joined(in_parts(n, least, |range| range.map(&find).collect()))
}

/// The elements that `find` pushes for each of `0..n`, in order.
pub(crate) fn collect<T: Send>(
    n: usize,
    least: usize,
    find: impl Fn(usize, &mut Vec<T>) + Sync,
) -> Vec<T> {
    joined(in_parts(n, least, |range| {
        let mut found = Vec::new();
        range.for_each(|i| find(i, &mut found));
        found
    }))
}

fn joined<T>(parts: Vec<Vec<T>>) -> Vec<T> {
    let total: usize = parts.iter().map(Vec::len).sum();
    let mut parts = parts.into_iter();
    let mut all = parts.next().unwrap_or_default();
    all.reserve_exact(total - all.len());
    parts.for_each(|part| all.extend(part));
    all
}

/// Sorts items of which equal ones cannot be told apart.
pub(crate) fn sort<T: Ord + Send>(items: &mut [T], least: usize) {
    if items.len() < least || rayon::current_num_threads() == 1 {
        items.sort_unstable();
    } else {
        items.par_sort_unstable();
    }
}

/// How many of `0..n` have a property.
pub(crate) fn count(n: usize, least: usize, has_it: impl Fn(usize) -> bool + Sync) -> usize {
    let parts = in_parts(n, least, |range| range.filter(|&i| has_it(i)).count());
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
                    assert!(
                        map(n, least, |i| 2 * i)
                            .into_iter()
                            .eq((0..n).map(|i| 2 * i))
                    );
                    assert!(each(0..n, least, |i| i + 1).into_iter().eq(1..=n));
                    let mut mixed: Vec<usize> = (0..n).map(|i| i * 7 % n.max(1)).collect();
                    sort(&mut mixed, least);
                    assert!(mixed.is_sorted());
                }
            });
        }
    }
}
