//! Experiments measure one thread, unless the question is what more of them gain.

use rayon::ThreadPoolBuilder;

/// A pool of so many threads, of which the one that builds it is the first: alone, it needs no other and waits for
/// none.
pub fn pool(threads: usize) -> ThreadPoolBuilder {
    ThreadPoolBuilder::new()
        .num_threads(threads)
        .use_current_thread()
}

/// Does the same work in a thread for each processor. None of them has help from others in what it does: there are none
/// to spare.
pub fn on_all_processors<T: Send>(work: impl Fn() -> T + Sync) -> Vec<T> {
    let alone = || {
        let pool = pool(1).build();
        let done = work();
        drop(pool.expect("a pool of the thread that is there"));
        done
    };
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(alone)).collect();
        let done = workers.into_iter();
        done.map(|w| w.join().expect("no worker panics")).collect()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn workers_are_alone() {
        let threads = on_all_processors(rayon::current_num_threads);
        assert!(!threads.is_empty());
        assert!(threads.iter().all(|&n| n == 1));
        // What is in a pool of its own does not wait for another thread.
        let sums = on_all_processors(|| {
            use rayon::prelude::*;
            (0..10_000u64).into_par_iter().sum::<u64>()
        });
        assert!(sums.iter().all(|&sum| sum == 49_995_000));
    }
}
