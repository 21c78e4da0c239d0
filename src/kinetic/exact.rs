//! The exact order of events: quotients, and where those are equal the perturbation.

use super::order::{TimeOrder, Timed};
use super::quotient::Quotient;
use crate::number::Exact;
use std::cmp::Ordering;
use std::marker::PhantomData;

/// What an exact order asks of what moves: S(τ) = N + τ·D + Σ e_v ε_v of an event with K vertices, in numbers of type
/// `N`.
pub trait Motion<N, const K: usize> {
    /// What happens.
    type Event: Copy;

    /// −N/D, if D > 0.
    fn quotient(&mut self, event: &Self::Event) -> Option<Quotient<N>>;

    /// The event's vertices, by their ranks in ε order (less than `u32::MAX`), and their coefficients e_v.
    fn perturbation(&mut self, event: &Self::Event) -> [(u32, N); K];

    /// Whether two events obviously have the same time, perturbed or not, because they have the same vertices. (If this
    /// says no, they may still have.)
    fn is_one_circuit(a: &Self::Event, b: &Self::Event) -> bool;
}

/// Times as exact quotients; ties are decided by the perturbation of the weights. Two events are `Equal` only if all
/// terms vanish: they have one and the same circuit.
pub struct ExactOrder<M, N, const K: usize> {
    /// What moves.
    pub motion: M,
    /// Comparisons that quotients left to the perturbation.
    pub ties: u64,
    /// Of those, comparisons of two events that are one, because they have one circuit.
    pub one_circuit: u64,
    /// Quotients computed.
    pub quotients: u64,
    numbers: PhantomData<N>,
}

impl<N: Exact, M: Motion<N, K>, const K: usize> ExactOrder<M, N, K> {
    /// For the given motion.
    pub fn new(motion: M) -> Self {
        ExactOrder {
            motion,
            ties: 0,
            one_circuit: 0,
            quotients: 0,
            numbers: PhantomData,
        }
    }

    /// −N/D of an event, if D > 0.
    pub fn quotient(&mut self, event: &M::Event) -> Option<Quotient<N>> {
        self.quotients += 1;
        self.motion.quotient(event)
    }

    /// Which of two events comes first: quotients, then the perturbation.
    pub fn compare_quotients(
        &mut self,
        a: Timed<M::Event, Quotient<N>>,
        b: Timed<M::Event, Quotient<N>>,
    ) -> Ordering {
        let order = a.1.compare(b.1);
        if order.is_ne() {
            return order;
        }
        self.ties += 1;
        let order = self.compare_perturbations(a, b);
        self.one_circuit += u64::from(order.is_eq());
        order
    }

    /// Which of two events comes first by the perturbation alone.
    pub fn compare_perturbations(
        &mut self,
        a: Timed<M::Event, Quotient<N>>,
        b: Timed<M::Event, Quotient<N>>,
    ) -> Ordering {
        let (ea, eb) = (self.motion.perturbation(a.0), self.motion.perturbation(b.0));
        a.1.compare_perturbed(&ea, b.1, &eb)
    }
}

impl<N: Exact, M: Motion<N, K>, const K: usize> TimeOrder for ExactOrder<M, N, K> {
    type Event = M::Event;
    type Key = ();
    type Time = Quotient<N>;

    fn about((): ()) -> Option<f64> {
        None
    }

    fn compare_keys((): (), (): ()) -> Option<Ordering> {
        None
    }

    fn compare(
        &mut self,
        a: Timed<M::Event, Quotient<N>>,
        b: Timed<M::Event, Quotient<N>>,
    ) -> Ordering {
        if M::is_one_circuit(a.0, b.0) {
            self.ties += 1;
            self.one_circuit += 1;
            return Ordering::Equal;
        }
        self.compare_quotients(a, b)
    }
}
