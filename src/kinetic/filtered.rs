//! Exact order at the price of floats: each event carries a float enclosure of its time ([`Enclosure`]); where two
//! enclosures overlap, the exact quotients decide, computed once per event and kept; where those are equal, the
//! perturbation. Exact quotients are of 64-bit integers where the caller is certain of those (small coordinates on a
//! grid), else of dyadic numbers of any size.

use super::bounded::Bounded;
use super::enclosure::{Enclosure, enclosure};
use super::exact::{ExactOrder, Motion};
use super::order::{TimeOrder, Timed};
use super::quotient::{Quotient, first_difference};
use crate::number::Dyadic;
use crate::number::bits::exponent;
use std::cell::Cell;
use std::cmp::Ordering;

/// Where the exact quotient of a time is kept: 0, or 1 + its place in [`FilteredOrder`]'s list.
#[derive(Clone, Debug, Default)]
pub struct FilteredTime(Cell<u32>);

/// An exact quotient.
#[derive(Clone, Debug)]
enum Exactly<const K: usize> {
    /// In quanta of the grid that all coordinates lie on.
    Integers(InQuanta<K>),
    /// In numbers of any size.
    Big(Box<Quotient<Dyadic>>),
}

/// N, D and the coefficients of an event in quanta of the grid that all coordinates lie on: each is less than 2^53.
#[derive(Clone, Debug)]
pub struct InQuanta<const K: usize> {
    pub(crate) numerator: i64,
    pub(crate) denominator: i64,
    /// The identities of the vertices, ascending, and their coefficients.
    pub(crate) terms: [(u32, i64); K],
}

impl<const K: usize> InQuanta<K> {
    /// N, D > 0, and the identities and coefficients of the vertices.
    #[inline]
    pub fn new([numerator, denominator]: [i64; 2], mut terms: [(u32, i64); K]) -> Self {
        terms.sort_unstable();
        InQuanta {
            numerator,
            denominator,
            terms,
        }
    }

    /// Which of two times comes first without the perturbation: the sign of t_0.
    #[inline(always)]
    fn compare_quotients(&self, other: &Self) -> Ordering {
        let (a, b) = (self, other);
        product(b.numerator, a.denominator).cmp(&product(a.numerator, b.denominator))
    }

    /// Which of two times comes first: the sign of t_0, then those of t_v. All products are of numbers of up to 53
    /// bits.
    fn compare(&self, other: &Self, ties: &mut u64) -> Ordering {
        let (a, b) = (self, other);
        let t0 = a.compare_quotients(b);
        if t0.is_ne() {
            return t0;
        }
        *ties += 1;
        let identities = |x: &Self| x.terms.map(|term| term.0);
        first_difference(identities(a), identities(b), |i, j| {
            let of_a = i.map_or(0, |i| product(a.terms[i].1, b.denominator));
            let of_b = j.map_or(0, |j| product(b.terms[j].1, a.denominator));
            of_a.cmp(&of_b).reverse()
        })
    }
}

#[inline(always)]
fn product(x: i64, y: i64) -> i128 {
    i128::from(x) * i128::from(y)
}

/// An exact order that is mostly decided by floats.
pub struct FilteredOrder<M, const K: usize> {
    /// The order that decides in the end.
    pub exact: ExactOrder<M, Dyadic, K>,
    kept: Vec<Exactly<K>>,
    /// A power of two by which enclosures are multiplied; known once there is a time.
    scale: Option<f64>,
    /// Comparisons that needed exact quotients.
    pub compared_exactly: u64,
    /// Comparisons of equal times, but for those that `exact` has counted.
    ties: u64,
    /// Of those, comparisons of two events that are one.
    one_circuit: u64,
}

impl<M: Motion<Dyadic, K>, const K: usize> FilteredOrder<M, K> {
    /// For the given motion.
    pub fn new(motion: M) -> Self {
        FilteredOrder {
            exact: ExactOrder::new(motion),
            kept: Vec::new(),
            scale: None,
            compared_exactly: 0,
            ties: 0,
            one_circuit: 0,
        }
    }

    /// Comparisons of equal times.
    pub fn ties(&self) -> u64 {
        self.ties + self.exact.ties
    }

    /// Of those, comparisons of two events that are one.
    pub fn one_circuit(&self) -> u64 {
        self.one_circuit + self.exact.one_circuit
    }

    /// Keeps a quotient in quanta.
    #[inline]
    pub fn in_integers(&mut self, integers: InQuanta<K>) -> FilteredTime {
        self.keep(Exactly::Integers(integers))
    }

    /// The key of an event with certainly positive D, given N and D with bounds of their errors. The first one sets the
    /// scale; `typical` is what times are like, if that one is 0.
    #[inline(always)]
    pub fn key(&mut self, [n, d]: [&Bounded; 2], typical: impl FnOnce() -> f64) -> Enclosure {
        let (middle, width) = enclosure(n, d);
        let scale = *self.scale.get_or_insert_with(|| {
            // The first event may be due at time 0.
            let typical = [middle, typical()];
            let typical = typical.into_iter().find(|time| time.is_normal());
            typical.map_or(1.0, inverse_power)
        });
        Enclosure::new(middle * scale, ((width * scale) as f32).next_up())
    }

    /// The time of an event of which floats know nothing; `None` if D ≤ 0.
    pub fn unknown(&mut self, event: &M::Event) -> Option<(Enclosure, FilteredTime)> {
        let quotient = self.exact.quotient(event)?;
        let time = self.keep(Exactly::Big(Box::new(quotient)));
        Some((Enclosure::UNKNOWN, time))
    }

    fn keep(&mut self, exactly: Exactly<K>) -> FilteredTime {
        self.kept.push(exactly);
        let place = u32::try_from(self.kept.len()).expect("fewer than 2^32 events");
        FilteredTime(Cell::new(place))
    }

    fn computed(&mut self, event: &M::Event) -> Exactly<K> {
        let quotient = self.exact.quotient(event);
        let quotient = quotient.expect("only events with positive D are queued");
        Exactly::Big(Box::new(quotient))
    }

    /// The exact quotient of an event, computed if no comparison has needed it yet: its place in the list.
    fn exactly(&mut self, (event, time): Timed<M::Event, FilteredTime>) -> usize {
        if time.0.get() == 0 {
            let quotient = self.computed(event);
            let kept = self.keep(quotient);
            time.0.set(kept.0.get());
        }
        (time.0.get() - 1) as usize
    }

    /// The same in numbers of any size.
    fn big(&mut self, event: Timed<M::Event, FilteredTime>) -> usize {
        let place = self.exactly(event);
        if let Exactly::Integers(_) = self.kept[place] {
            self.kept[place] = self.computed(event.0);
        }
        place
    }

    /// The power of two by which enclosures are multiplied.
    #[cfg(test)]
    pub(crate) fn scale(&self) -> Option<f64> {
        self.scale
    }

    /// What is known of a time in quanta.
    #[cfg(test)]
    pub(crate) fn in_quanta(&self, time: &FilteredTime) -> Option<&InQuanta<K>> {
        match &self.kept[time.0.get().checked_sub(1)? as usize] {
            Exactly::Integers(integers) => Some(integers),
            Exactly::Big(_) => None,
        }
    }
}

impl<M: Motion<Dyadic, K>, const K: usize> TimeOrder for FilteredOrder<M, K> {
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
        self.decide::<true>(a, b)
    }
}

impl<M: Motion<Dyadic, K>, const K: usize> FilteredOrder<M, K> {
    /// Which of two times comes first, exactly; of equal ones that of the perturbation, if it is asked for.
    #[inline(always)]
    pub(super) fn decide<const PERTURBED: bool>(
        &mut self,
        a: Timed<M::Event, FilteredTime>,
        b: Timed<M::Event, FilteredTime>,
    ) -> Ordering {
        self.compared_exactly += 1;
        if M::is_one_circuit(a.0, b.0) {
            self.ties += 1;
            self.one_circuit += 1;
            return Ordering::Equal;
        }
        let (i, j) = (self.exactly(a), self.exactly(b));
        if let (Exactly::Integers(qa), Exactly::Integers(qb)) = (&self.kept[i], &self.kept[j]) {
            if !PERTURBED {
                return qa.compare_quotients(qb);
            }
            let (ties, order) = (self.ties, qa.compare(qb, &mut self.ties));
            self.one_circuit += u64::from(order.is_eq() && self.ties > ties);
            return order;
        }
        let (i, j) = (self.big(a), self.big(b));
        match (&self.kept[i], &self.kept[j]) {
            (Exactly::Big(qa), Exactly::Big(qb)) if !PERTURBED => qa.compare(qb),
            (Exactly::Big(qa), Exactly::Big(qb)) => {
                self.exact.compare_quotients((a.0, qa), (b.0, qb))
            }
            _ => unreachable!("both quotients have just been computed in numbers of any size"),
        }
    }
}

/// A power of two that brings a normal number near 1.
fn inverse_power(x: f64) -> f64 {
    2f64.powi((-exponent(x)).clamp(-1000, 1000))
}
