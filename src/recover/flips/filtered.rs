//! Exact flip order at the price of floats: each event carries a float enclosure of its time; where two enclosures
//! overlap, the exact quotients decide, computed once per event and kept; where those are equal, the perturbation.
//!
//! # The enclosure
//! N and D are evaluated over [`Approx`], which gives n, d and bounds e ≥ |N − n|, g ≥ |D − d|, valid for every finite
//! input, under- and overflow included (the proof is there; the evaluation of D has the rates d_v, themselves orient3d
//! determinants, as its last column, and the same rules apply to it). Let d > g, so that D > 0 is certain, and let
//! q = −n/d exactly. With τ = −N/D,
//!
//! > |τ − q| = |N/D − n/d| = |(N − n) + n/d·(d − D)| / D ≤ (e + |q|·g)/(d − g).
//!
//! In floats, with u = 2⁻⁵³, η = 2⁻¹⁰⁷⁴, T = 2⁻¹⁰²²: q̂ = fl(−n/d) has |q̂ − q| ≤ u|q̂| + η/2, so that
//! |q| ≤ (|q̂| + T)(1 + 2u). We take
//!
//! > w = (e + (|q̂| + T)·g)/(d − g)·(1 + 2⁻⁴⁸) + |q̂|·2⁻⁵² + T.
//!
//! The fraction has five roundings and the factor 1 + 2u to make up for, which 1 + 2⁻⁴⁸ = 1 + 32u does; its product may
//! underflow and lose η/2 ≤ u·e, because e ≥ T ([`Approx::error`]); d − g is a difference of doubles and does not
//! underflow; the quotient may, and loses η/2, which the last T covers together with that of q̂. Overflow makes w infinite
//! or NaN, and then no comparison is decided by it.
//!
//! # The comparison
//! q̂_B − q̂_A > (w_A + w_B)(1 + 2⁻⁵⁰) in floats implies τ_A < τ_B: the left side is at most (1 + u) times its exact value,
//! the right side at least (1 + 2⁻⁵⁰)(1 − 2u) > 1 + u times w_A + w_B. NaN and infinity make it false.

use super::event::Event;
use super::time::{ExactTimes, FlipTimes, LeftVertices, Quotient, Rates, Undecided, same_vertices};
use crate::mesh::VertexId;
use crate::number::{Approx, Dyadic, Number, Sign};
use crate::predicate::PointStore;
use std::cell::OnceCell;
use std::cmp::Ordering;

/// A flip time: a float enclosure, and the exact quotient once a comparison has needed it.
#[derive(Clone, Debug)]
pub struct FilteredTime {
    /// τ is within `width` of `middle`.
    middle: f64,
    width: f64,
    exact: OnceCell<Box<Quotient<Dyadic>>>,
}

/// Flip times whose order is exact and is mostly decided by floats.
pub struct FilteredTimes<'a, P> {
    filter: Rates<'a, P, Approx>,
    exact: ExactTimes<'a, P, Dyadic>,
    /// Comparisons that needed exact quotients.
    compared_exactly: u64,
}

impl<'a, P: PointStore> FilteredTimes<'a, P> {
    /// For the polygon with the given frame; `is_left` tells the left vertices.
    pub fn new(points: &'a P, frame: [VertexId; 3], is_left: LeftVertices<'a>) -> Self {
        FilteredTimes {
            filter: Rates::new(points, frame, is_left),
            exact: ExactTimes::new(points, frame, is_left),
            compared_exactly: 0,
        }
    }
}

impl<P: PointStore> FlipTimes for FilteredTimes<'_, P> {
    type Time = FilteredTime;
    const EXACT: bool = true;

    fn time(&mut self, circuit: [VertexId; 5]) -> Option<FilteredTime> {
        let (n, d) = self.filter.evaluate(circuit);
        let exact = OnceCell::new();
        match d.sign() {
            Some(Sign::Positive) => {
                let (middle, width) = enclosure(&n, &d);
                Some(FilteredTime {
                    middle,
                    width,
                    exact,
                })
            }
            Some(_) => None,
            None => {
                let quotient = self.exact.quotient(circuit)?;
                let _ = exact.set(Box::new(quotient));
                let (middle, width) = (0.0, f64::INFINITY);
                Some(FilteredTime {
                    middle,
                    width,
                    exact,
                })
            }
        }
    }

    fn compare(&mut self, a: &Event<FilteredTime>, b: &Event<FilteredTime>) -> Ordering {
        let gap = b.time.middle - a.time.middle;
        let widths = (a.time.width + b.time.width) * (1.0 + 4.0 * f64::EPSILON);
        if gap > widths {
            return Ordering::Less;
        }
        if -gap > widths {
            return Ordering::Greater;
        }
        if same_vertices(a.circuit, b.circuit) {
            return Ordering::Equal;
        }
        self.compared_exactly += 1;
        let exact = &mut self.exact;
        let mut quotient = |event: &Event<FilteredTime>| -> Quotient<Dyadic> {
            let compute = || {
                let quotient = exact.quotient(event.circuit);
                Box::new(quotient.expect("only events with positive D are queued"))
            };
            (**event.time.exact.get_or_init(compute)).clone()
        };
        let (qa, qb) = (quotient(a), quotient(b));
        self.exact
            .compare_quotients((a.circuit, &qa), (b.circuit, &qb))
    }

    fn undecided(&self) -> Undecided {
        Undecided {
            compared_exactly: self.compared_exactly,
            ..self.exact.undecided()
        }
    }
}

/// The middle and the half width of an interval that contains −N/D, for D certainly positive.
fn enclosure(n: &Approx, d: &Approx) -> (f64, f64) {
    let (e, g) = (n.error(), d.error());
    let middle = -n.value() / d.value();
    let slope = (e + (middle.abs() + f64::MIN_POSITIVE) * g) / (d.value() - g);
    let width =
        slope * (1.0 + 16.0 * f64::EPSILON) + middle.abs() * f64::EPSILON + f64::MIN_POSITIVE;
    (middle, width)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::predicate::DoublePoints;
    use num_rational::BigRational;
    use num_traits::Signed;
    use proptest::prelude::*;

    /// Points that make near ties and extreme exponents.
    fn family() -> impl Strategy<Value = Vec<[f64; 3]>> {
        let lattice = prop::collection::vec([-3i32..4, -3..4, -3..4], 8)
            .prop_map(|p| p.into_iter().map(|q| q.map(f64::from)).collect::<Vec<_>>());
        let jittered = (
            lattice.clone(),
            prop::collection::vec([-2i32..3, -2..3, -2..3], 8),
        )
            .prop_map(|(p, j)| {
                let jitter = |x: f64, k: i32| x * (1.0 + f64::from(k) * f64::EPSILON);
                p.iter()
                    .zip(j)
                    .map(|(p, j)| [0, 1, 2].map(|i| jitter(p[i], j[i])))
                    .collect::<Vec<_>>()
            });
        let scaled = (jittered.clone(), -200i32..200).prop_map(|(p, e)| {
            p.into_iter()
                .map(|q| q.map(|x| x * 2f64.powi(e)))
                .collect::<Vec<_>>()
        });
        let mixed = prop::collection::vec(
            [(-2i32..3, -70i32..70), (-2..3, -70..70), (-2..3, -70..70)],
            8,
        )
        .prop_map(|p| {
            p.into_iter()
                .map(|q| q.map(|(x, e)| f64::from(x) * 2f64.powi(e)))
                .collect::<Vec<_>>()
        });
        prop_oneof![lattice, jittered, scaled, mixed]
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(3000))]

        /// The true time is within the enclosure, and filtered and exact order agree.
        #[test]
        fn enclosures_hold_and_orders_agree(p in family()) {
            let points = DoublePoints::new(p);
            let is_left = |v: VertexId| v.0.is_multiple_of(2);
            let frame = [5, 6, 7].map(VertexId);
            let mut filtered = FilteredTimes::new(&points, frame, &is_left);
            let mut exact = ExactTimes::<_, Dyadic>::new(&points, frame, &is_left);
            let mut rational = ExactTimes::<_, BigRational>::new(&points, frame, &is_left);
            let mut events = Vec::new();
            for (arrival, skip) in (0..6u32).enumerate() {
                let left_out = |&i: &u32| i != skip;
                let circuit: Vec<VertexId> = (0..6).filter(left_out).map(VertexId).collect();
                let circuit: [VertexId; 5] = circuit.try_into().expect("five of six");
                let (f, e, r) = (filtered.time(circuit), exact.time(circuit), rational.time(circuit));
                prop_assert_eq!(f.is_some(), e.is_some());
                prop_assert_eq!(f.is_some(), r.is_some());
                let (Some(f), Some(e), Some(r)) = (f, e, r) else { continue };
                if f.width.is_finite() && f.middle.is_finite() {
                    let (n, d) = r.parts();
                    let middle = <BigRational as Number>::from_f64(f.middle);
                    let distance = (-n / d - middle).abs();
                    prop_assert!(distance <= <BigRational as Number>::from_f64(f.width));
                }
                let event = |time| Event { circuit, tet: crate::mesh::TetId(0), time, arrival: arrival as u64 };
                events.push((event(f), Event { circuit, tet: crate::mesh::TetId(0), time: e, arrival: 0 }));
            }
            for (fa, ea) in &events {
                for (fb, eb) in &events {
                    prop_assert_eq!(filtered.compare(fa, fb), exact.compare(ea, eb));
                }
            }
        }
    }
}
