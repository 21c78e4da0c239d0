//! The filtered order without one of its parts, so that the price of that part can be measured: what is left is the
//! same code, in the same queue.

use super::enclosure::Enclosure;
use super::exact::Motion;
use super::filtered::{FilteredOrder, FilteredTime};
use super::order::{TimeOrder, Timed};
use crate::number::Dyadic;
use std::cmp::Ordering;

/// The filtered order. Unless it is `ENCLOSED`, every comparison is one of exact quotients, each computed once. Unless
/// it is `PERTURBED` it is not the true order: equal times come in the order of their arrival.
pub struct AblatedFilter<M, const K: usize, const ENCLOSED: bool, const PERTURBED: bool>(
    pub FilteredOrder<M, K>,
);

impl<M: Motion<Dyadic, K>, const K: usize, const ENCLOSED: bool, const PERTURBED: bool> TimeOrder
    for AblatedFilter<M, K, ENCLOSED, PERTURBED>
{
    type Event = M::Event;
    type Key = Enclosure;
    type Time = FilteredTime;

    #[inline]
    fn about(key: Enclosure) -> Option<f64> {
        Some(key.middle())
    }

    #[inline]
    fn compare_keys(a: Enclosure, b: Enclosure) -> Option<Ordering> {
        if ENCLOSED { a.compare(b) } else { None }
    }

    fn compare(
        &mut self,
        a: Timed<M::Event, FilteredTime>,
        b: Timed<M::Event, FilteredTime>,
    ) -> Ordering {
        self.0.decide::<PERTURBED>(a, b)
    }
}
