//! The order of two events' times as exact quotients, and under the perturbation.
//!
//! Let A and B be events with S = N + τ·D + Σ e_v ε_v each, and D_A, D_B > 0. Their times are −(N + Σ e_v ε_v)/D. So A
//! comes before B iff the first non-zero of
//!
//! > t_0 = N_A·D_B − N_B·D_A,  t_v = e_{A,v}·D_B − e_{B,v}·D_A, v in ε order,
//!
//! is positive, where e = 0 for a vertex that an event does not have. No product of two ε occurs, because D is free of
//! ε.

use crate::number::{Exact, Sign};
use std::cmp::Ordering;

/// The time −N/D, D > 0, as an unevaluated quotient: comparison needs no division.
#[derive(Clone, Debug)]
pub struct Quotient<N> {
    pub(super) numerator: N,
    pub(super) denominator: N,
}

impl<N: Exact> Quotient<N> {
    /// −N/D, if D > 0.
    pub fn of_rising(numerator: N, denominator: N) -> Option<Self> {
        denominator.exact_sign().is_positive().then_some(Quotient {
            numerator,
            denominator,
        })
    }

    /// The order of −N_A/D_A and −N_B/D_B: the sign of t_0.
    pub fn compare(&self, other: &Quotient<N>) -> Ordering {
        let ab = self.numerator.clone() * &other.denominator;
        let ba = other.numerator.clone() * &self.denominator;
        order_of((ab - &ba).exact_sign())
    }

    /// The order of two events with equal quotients, `self` and `other`, whose vertices and coefficients e_v are given:
    /// the signs of t_v until one is not zero. Vertices are given by their identities, their ranks in ε order.
    pub fn compare_perturbed<const K: usize>(
        &self,
        terms: &[(u32, N); K],
        other: &Quotient<N>,
        other_terms: &[(u32, N); K],
    ) -> Ordering {
        let in_order = |terms: &[(u32, N); K]| {
            let mut places: [(u32, usize); K] = std::array::from_fn(|i| (terms[i].0, i));
            places.sort_unstable();
            places
        };
        let (a, b) = (in_order(terms), in_order(other_terms));
        let identities = |places: &[(u32, usize); K]| places.map(|place| place.0);
        first_difference(identities(&a), identities(&b), |i, j| {
            let zero = N::from_f64(0.0);
            let of_a = i.map_or(zero.clone(), |i| {
                terms[a[i].1].1.clone() * &other.denominator
            });
            let of_b = j.map_or(zero, |j| other_terms[b[j].1].1.clone() * &self.denominator);
            order_of((of_a - &of_b).exact_sign())
        })
    }
}

impl<N> Quotient<N> {
    /// N and D.
    pub fn parts(&self) -> (&N, &N) {
        (&self.numerator, &self.denominator)
    }
}

/// A positive t says that A comes first.
fn order_of(t: Sign) -> Ordering {
    match t {
        Sign::Positive => Ordering::Less,
        Sign::Zero => Ordering::Equal,
        Sign::Negative => Ordering::Greater,
    }
}

/// The first of the orders by t_v, for the vertices of two events in ε order, that is not `Equal`. `order_by` is given
/// the places of v among the vertices of A and of B, where it is among them; both lists are ascending.
pub(super) fn first_difference<const K: usize>(
    a: [u32; K],
    b: [u32; K],
    mut order_by: impl FnMut(Option<usize>, Option<usize>) -> Ordering,
) -> Ordering {
    let (mut i, mut j) = (0, 0);
    while i < K || j < K {
        // No vertex has this identity, which comes after all others.
        let (va, vb) = (
            a.get(i).copied().unwrap_or(u32::MAX),
            b.get(j).copied().unwrap_or(u32::MAX),
        );
        let (in_a, in_b) = (va <= vb, vb <= va);
        let order = order_by(in_a.then_some(i), in_b.then_some(j));
        if order.is_ne() {
            return order;
        }
        i += usize::from(in_a);
        j += usize::from(in_b);
    }
    Ordering::Equal
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_rational::BigRational;
    use num_traits::Signed;
    use proptest::prelude::*;

    fn rational(n: i64) -> BigRational {
        BigRational::from_integer(n.into())
    }

    /// −(N + Σ e ε)/D for ε_v = η^(v+1), with an η so small that it is as good as infinitesimal for small integers.
    fn perturbed(n: i64, d: i64, terms: &[(u32, BigRational)]) -> BigRational {
        let eta = BigRational::new(1.into(), 1_000_000.into());
        let sum = terms
            .iter()
            .map(|(v, e)| e * eta.pow(*v as i32 + 1))
            .sum::<BigRational>();
        -(rational(n) + sum) / rational(d)
    }

    type Event = (i64, i64, [(u32, i64); 3]);

    fn event() -> impl Strategy<Value = Event> {
        let identities = prop::sample::subsequence(vec![0u32, 1, 2, 3, 4], 3).prop_shuffle();
        let terms = (identities, [-2i64..3, -2..3, -2..3])
            .prop_map(|(v, e)| [(v[0], e[0]), (v[1], e[1]), (v[2], e[2])]);
        (-2i64..3, 1i64..4, terms)
    }

    proptest! {
        /// The order of the perturbed times is that of the times for a very small perturbation.
        #[test]
        fn the_perturbed_order_is_that_of_small_perturbations(a in event(), b in event()) {
            let terms = |event: Event| event.2.map(|(v, e)| (v, rational(e)));
            let quotient = |event: Event| Quotient::of_rising(rational(event.0), rational(event.1)).expect("D > 0");
            let (qa, qb) = (quotient(a), quotient(b));
            let found = qa.compare(&qb).then_with(|| qa.compare_perturbed(&terms(a), &qb, &terms(b)));
            let difference = perturbed(a.0, a.1, &terms(a)) - perturbed(b.0, b.1, &terms(b));
            prop_assert_eq!(found, rational(0).cmp(&-difference.signum()));
        }
    }

    #[test]
    fn only_what_rises_has_a_time() {
        for d in [-1, 0] {
            assert!(Quotient::of_rising(rational(1), rational(d)).is_none());
        }
    }
}
