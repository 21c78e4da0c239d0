//! The search of [`super::tree`] by all threads.

use super::tree::{Bounds, Cell, Simplices, Step};
use rayon::prelude::*;
use std::ops::ControlFlow;

/// Cells with fewer simplices are one thread's work.
const SHARED: usize = 1 << 12;

impl Simplices<'_> {
    /// Visits the pairs of some cells by all threads: each collects what `visit` makes of some of the pairs, and `join`
    /// joins two such collections. Which pairs are visited does not depend on the number of threads; what is collected
    /// must not depend on their order.
    pub fn collect<T: Default + Send>(
        &self,
        cells: Vec<Cell>,
        visit: &(dyn Fn(usize, usize, &mut T) + Sync),
        join: &(dyn Fn(&mut T, T) + Sync),
    ) -> T {
        let cells = cells.into_par_iter();
        let found = cells.map(
            |Cell {
                 bounds,
                 list,
                 depth,
             }| { self.divide_shared(&bounds, list, depth, visit, join) },
        );
        found.reduce(T::default, |mut found, more| {
            join(&mut found, more);
            found
        })
    }

    fn divide_shared<T: Default + Send>(
        &self,
        cell: &Bounds,
        list: Vec<u32>,
        depth: usize,
        visit: &(dyn Fn(usize, usize, &mut T) + Sync),
        join: &(dyn Fn(&mut T, T) + Sync),
    ) -> T {
        let mut found = T::default();
        let mut alone = |i: usize, j: usize| {
            visit(i, j, &mut found);
            ControlFlow::Continue(())
        };
        let step = if list.len() < SHARED || rayon::current_num_threads() == 1 {
            let _ = self.divide(cell, list, depth, &mut alone);
            return found;
        } else {
            self.step(cell, list, depth)
        };
        match step {
            Step::Nothing => found,
            Step::Compare(list) => {
                let _ = self.compare(&list, &mut alone);
                found
            }
            Step::Halves(halves) => {
                let [first, second] = halves.map(|(cell, list)| {
                    move || self.divide_shared(&cell, list, depth - 1, visit, join)
                });
                let (mut found, more) = rayon::join(first, second);
                join(&mut found, more);
                found
            }
        }
    }
}
