//! The filtered order without one of its parts, so that the price of that part can be measured: what is left is the
//! same code, in the same queue.
//!
//! Two orders that are not the true one come of it: [`Middles`] are times as rounded quotients, the computed ones that
//! enclosures have in their middles; [`Unperturbed`] is the order of the exact quotients, and of arrival where they are
//! equal.

use super::enclosure::Enclosure;
use super::exact::Motion;
use super::filtered::{FilteredOrder, FilteredTime};
use super::order::{TimeOrder, Timed};
use crate::number::Dyadic;
use std::cmp::Ordering;
use std::marker::PhantomData;

/// Rounded quotients, and nothing else; equal ones in the order of their arrival.
pub struct Middles<E>(PhantomData<E>);

impl<E> Default for Middles<E> {
    fn default() -> Self {
        Middles(PhantomData)
    }
}

impl<E: Copy> TimeOrder for Middles<E> {
    type Event = E;
    type Key = f64;
    type Time = ();

    #[inline]
    fn about(key: f64) -> Option<f64> {
        Some(key)
    }

    #[inline]
    fn compare_keys(a: f64, b: f64) -> Option<Ordering> {
        a.partial_cmp(&b).filter(|o| o.is_ne())
    }

    fn compare(&mut self, _: Timed<E, ()>, _: Timed<E, ()>) -> Ordering {
        Ordering::Equal
    }
}

/// The filtered order without the perturbation: equal times in the order of their arrival.
pub struct Unperturbed<M, const K: usize>(pub FilteredOrder<M, K>);

impl<M: Motion<Dyadic, K>, const K: usize> TimeOrder for Unperturbed<M, K> {
    type Event = M::Event;
    type Key = Enclosure;
    type Time = FilteredTime;

    #[inline]
    fn about(key: Enclosure) -> Option<f64> {
        Some(key.middle())
    }

    #[inline]
    fn compare_keys(a: Enclosure, b: Enclosure) -> Option<Ordering> {
        a.compare(b)
    }

    fn compare(
        &mut self,
        a: Timed<M::Event, FilteredTime>,
        b: Timed<M::Event, FilteredTime>,
    ) -> Ordering {
        self.0.decide::<false>(a, b)
    }
}

/// The filtered order without its enclosures: every comparison is one of exact quotients, each computed once.
pub struct Unenclosed<M, const K: usize>(pub FilteredOrder<M, K>);

impl<M: Motion<Dyadic, K>, const K: usize> TimeOrder for Unenclosed<M, K> {
    type Event = M::Event;
    type Key = Enclosure;
    type Time = FilteredTime;

    #[inline]
    fn about(key: Enclosure) -> Option<f64> {
        Some(key.middle())
    }

    #[inline]
    fn compare_keys(_: Enclosure, _: Enclosure) -> Option<Ordering> {
        None
    }

    fn compare(
        &mut self,
        a: Timed<M::Event, FilteredTime>,
        b: Timed<M::Event, FilteredTime>,
    ) -> Ordering {
        self.0.decide::<true>(a, b)
    }
}
