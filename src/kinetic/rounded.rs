//! Orders of rounded times: the rounded numbers themselves, and some rule for those that are equal.

use super::order::{TimeOrder, Timed};
use crate::number::{Dyadic, Float};
use std::cmp::Ordering;
use std::marker::PhantomData;

/// Which of two events with equal rounded times comes first.
pub trait TieBreaker {
    /// What happens.
    type Event: Copy;

    /// The order of two events; `Equal` leaves it to their arrival.
    fn break_tie(&mut self, a: &Self::Event, b: &Self::Event) -> Ordering;
}

/// Events with equal times come in the order of their arrival.
pub struct ArrivalOrder<E>(PhantomData<E>);

impl<E> Default for ArrivalOrder<E> {
    fn default() -> Self {
        ArrivalOrder(PhantomData)
    }
}

impl<E: Copy> TieBreaker for ArrivalOrder<E> {
    type Event = E;

    fn break_tie(&mut self, _: &E, _: &E) -> Ordering {
        Ordering::Equal
    }
}

/// Times in a rounded type whose values are as close as doubles or less close, so that those serve as keys.
pub struct RoundedOrder<N, T> {
    /// For equal times.
    pub ties: T,
    numbers: PhantomData<N>,
}

impl<N, T> RoundedOrder<N, T> {
    /// With a rule for equal times.
    pub fn new(ties: T) -> Self {
        RoundedOrder {
            ties,
            numbers: PhantomData,
        }
    }
}

impl<N: Float, T: TieBreaker> TimeOrder for RoundedOrder<N, T> {
    type Event = T::Event;
    type Key = f64;
    type Time = N;

    #[inline]
    fn about(key: f64) -> Option<f64> {
        Some(key)
    }

    #[inline]
    fn compare_keys(a: f64, b: f64) -> Option<Ordering> {
        a.partial_cmp(&b).filter(|o| o.is_ne())
    }

    fn compare(&mut self, a: Timed<T::Event, N>, b: Timed<T::Event, N>) -> Ordering {
        N::compare(a.1, b.1).then_with(|| self.ties.break_tie(a.0, b.0))
    }
}

/// Times in a rounded type of any width, by their exact values. Doubles would not tell times of more bits, or with
/// larger exponents, apart, so there are no keys.
pub struct WideOrder<T> {
    /// For equal times.
    pub ties: T,
}

impl<T: TieBreaker> TimeOrder for WideOrder<T> {
    type Event = T::Event;
    type Key = ();
    type Time = Dyadic;

    fn about((): ()) -> Option<f64> {
        None
    }

    fn compare_keys((): (), (): ()) -> Option<Ordering> {
        None
    }

    fn compare(&mut self, a: Timed<T::Event, Dyadic>, b: Timed<T::Event, Dyadic>) -> Ordering {
        a.1.cmp(b.1).then_with(|| self.ties.break_tie(a.0, b.0))
    }
}
