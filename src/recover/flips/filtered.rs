//! Exact flip order at the price of floats: [`FilteredOrder`] over the float evaluations of [`Filter`].

use super::event::{Event, Signs};
use super::filter::Filter;
use super::motion::{Circuits, PolygonMotion};
use super::time::{FlipTime, FlipTimes, Undecided};
use crate::kinetic::{Bounded, Enclosure, FilteredOrder, FilteredTime, InQuanta, TimeOrder};
use crate::mesh::VertexId;
use crate::number::Dyadic;
use crate::predicate::PointStore;

/// Flip times whose order is exact and is mostly decided by floats; in experiments, what is left of that without one of
/// its parts.
pub struct FilteredTimes<'a, P: PointStore + 'a, A: Ablation = NoAblation> {
    points: &'a P,
    filter: Filter<'a, P>,
    order: A::Order<'a, P>,
}

/// The filtered order of flip times.
pub(super) type Filtered<'a, P> = FilteredOrder<Circuits<'a, P, Dyadic>, 5>;

/// Which part of the filtered order is left out: none, or one for measuring what it costs (`ablated`).
pub trait Ablation {
    /// Without exact quotients of 64-bit integers, where coordinates lie on a grid: all are of numbers of any size.
    const INTEGERS: bool;

    /// The order that is left.
    type Order<'a, P: PointStore + 'a>: AblatedOrder<'a, P>;
}

/// An order of what is left.
pub trait AblatedOrder<'a, P: PointStore>: TimeOrder<Event = Event> {
    /// Over the filtered order.
    fn new(filtered: Filtered<'a, P>) -> Self;

    /// The time of an event with certainly positive D, given N, D and, if they are certain, N, D and the coefficients
    /// in quanta.
    fn certain(
        &mut self,
        quotient: [&Bounded; 2],
        typical: impl FnOnce() -> f64,
        integers: impl FnOnce() -> Option<InQuanta<5>>,
    ) -> (Self::Key, Self::Time);

    /// That of an event of which floats know nothing; `None` if D ≤ 0.
    fn unknown(&mut self, event: &Event) -> Option<(Self::Key, Self::Time)>;

    /// What it did not decide by floats.
    fn undecided(&self) -> Undecided;
}

/// Nothing is left out.
pub struct NoAblation;

impl Ablation for NoAblation {
    const INTEGERS: bool = true;
    type Order<'a, P: PointStore + 'a> = Filtered<'a, P>;
}

impl<'a, P: PointStore> AblatedOrder<'a, P> for Filtered<'a, P> {
    fn new(filtered: Filtered<'a, P>) -> Self {
        filtered
    }

    #[inline(always)]
    fn certain(
        &mut self,
        quotient: [&Bounded; 2],
        typical: impl FnOnce() -> f64,
        integers: impl FnOnce() -> Option<InQuanta<5>>,
    ) -> (Enclosure, FilteredTime) {
        let time = match integers() {
            Some(integers) => self.in_integers(integers),
            None => FilteredTime::default(),
        };
        (self.key(quotient, typical), time)
    }

    #[inline]
    fn unknown(&mut self, event: &Event) -> Option<(Enclosure, FilteredTime)> {
        FilteredOrder::unknown(self, event)
    }

    fn undecided(&self) -> Undecided {
        Undecided {
            compared_exactly: self.compared_exactly,
            ties: self.ties(),
            one_circuit: self.one_circuit(),
            big_quotients: self.exact.quotients,
            overflows: 0,
        }
    }
}

impl<'a, P: PointStore> FilteredTimes<'a, P> {
    /// For the given motion.
    pub fn new(motion: &'a PolygonMotion<'a, P>) -> Self {
        FilteredTimes::of_parts(motion)
    }
}

impl<'a, P: PointStore, A: Ablation> FilteredTimes<'a, P, A> {
    /// For the given motion, without what is left out.
    pub(super) fn of_parts(motion: &'a PolygonMotion<'a, P>) -> Self {
        FilteredTimes {
            points: motion.points,
            filter: Filter::new(motion),
            order: AblatedOrder::new(FilteredOrder::new(Circuits::new(motion))),
        }
    }
}

impl<'a, P: PointStore, A: Ablation> FlipTimes for FilteredTimes<'a, P, A> {
    type Order = A::Order<'a, P>;
    // Orders that are not exact have no patches either: see `ablated`.
    const EXACT: bool = true;

    #[inline(always)]
    fn order(&mut self) -> &mut Self::Order {
        &mut self.order
    }

    #[inline]
    fn prefetch(&self, v: VertexId) {
        self.filter.prefetch(v);
    }

    #[inline]
    fn time_across(
        &mut self,
        _: [VertexId; 4],
        circuit: [VertexId; 5],
        is_wanted: impl FnOnce(Signs, bool) -> bool,
    ) -> Option<FlipTime<Self::Order>> {
        let mut rising = self.filter.evaluate(circuit);
        let may_rise = self.filter.may_rise(&mut rising);
        let signs = self.filter.signs(&rising);
        if !is_wanted(signs, may_rise) {
            return None;
        }
        if !rising.d.is_positive() {
            let (key, time) = self.order.unknown(&Event::of_circuit(circuit))?;
            return Some(FlipTime { key, time, signs });
        }
        let n = self.filter.resting(&rising);
        let (filter, points) = (&self.filter, self.points);
        let in_quanta = || {
            if !A::INTEGERS {
                return None;
            }
            let (quotient, c) = filter.integers(&rising, &n)?;
            let terms = [0, 1, 2, 3, 4].map(|i| (points.identity(circuit[i]), c[i]));
            Some(InQuanta::new(quotient, terms))
        };
        let typical = || filter.typical_time(&rising);
        let (key, time) = self.order.certain([&n, &rising.d], typical, in_quanta);
        Some(FlipTime { key, time, signs })
    }

    fn undecided(&self) -> Undecided {
        self.order.undecided()
    }
}

#[cfg(test)]
mod tests {
    use super::super::exact::ExactTimes;
    use super::*;
    use crate::number::Number;
    use crate::predicate::{DoublePoints, formula};
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

    /// The magnitudes of rates about so large a frame overflow, and become NaN where they meet a zero.
    #[test]
    fn rates_without_a_bound_decide_nothing() {
        let s = 8e153;
        let mut points = vec![[-s, -s, 0.0], [-s, s, 0.0], [s, s, 0.0]];
        points.extend([
            [0.8375779762864113, 0.9162698360159993, 0.5564543176442385],
            [0.6516717132180929, 1.5456227399408817, 1.5489977290853858],
            [1.7597665395587683, 1.5585642028599977, 0.6564545948058367],
            [0.7236390076577663, 0.85994653403759, -0.14819519827142358],
            [1.57386027649045, 2.18791710678488, 1.648998006246984],
        ]);
        let points = DoublePoints::new(points);
        let frame = [0, 1, 2].map(VertexId);
        let is_left = |v: VertexId| {
            points
                .orient3d([frame[0], frame[1], frame[2], v])
                .is_positive()
        };
        let motion = PolygonMotion::new(&points, frame, &is_left);
        let mut exact = ExactTimes::<_, Dyadic>::new(&motion);
        // In all roles: the order in which vertices become known must not matter.
        for turn in 0..5 {
            let mut circuit = [3, 4, 5, 6, 7].map(VertexId);
            circuit.rotate_left(turn);
            let [a, b, c, d, _] = circuit;
            if points.orient3d([a, b, c, d]).is_negative() {
                circuit.swap(0, 1);
            }
            let filtered = FilteredTimes::new(&motion).time(circuit);
            assert_eq!(filtered.is_some(), exact.time(circuit).is_some(), "{turn}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(3000))]

        /// The true time is within the enclosure, and filtered and exact order agree.
        #[test]
        fn enclosures_hold_and_orders_agree(p in family()) {
            let points = DoublePoints::new(p);
            let is_left = |v: VertexId| v.0.is_multiple_of(2);
            let frame = [5, 6, 7].map(VertexId);
            let motion = PolygonMotion::new(&points, frame, &is_left);
            let mut filtered = FilteredTimes::new(&motion);
            let mut exact = ExactTimes::<_, Dyadic>::new(&motion);
            let mut rational = ExactTimes::<_, BigRational>::new(&motion);
            let mut events = Vec::new();
            for skip in 0..6u32 {
                let left_out = |&i: &u32| i != skip;
                let circuit: Vec<VertexId> = (0..6).filter(left_out).map(VertexId).collect();
                let circuit: [VertexId; 5] = circuit.try_into().expect("five of six");
                let (f, e, r) = (filtered.time(circuit), exact.time(circuit), rational.time(circuit));
                prop_assert_eq!(f.is_some(), e.is_some());
                prop_assert_eq!(f.is_some(), r.is_some());
                let (Some(f), Some(e), Some(r)) = (f, e, r) else { continue };
                let (middle, width) = f.key.middle_and_width();
                let (n, d) = r.time.parts();
                if width.is_finite() && middle.is_finite() {
                    let rational = <BigRational as Number>::from_f64;
                    let scale = rational(filtered.order.scale().expect("there is a time"));
                    let distance = (-n / d * scale - rational(middle)).abs();
                    prop_assert!(distance <= rational(width.into()));
                }
                if let Some(integers) = filtered.order.in_quanta(&f.time) {
                    let g = <BigRational as Number>::from_f64(2f64.powi(points.grid().expect("a grid")));
                    let quanta = |k: i64, degree: i32| BigRational::from_integer(k.into()) * g.pow(degree);
                    prop_assert_eq!(&quanta(integers.numerator, 5), n);
                    prop_assert_eq!(&quanta(integers.denominator, 6), d);
                    let (c, _) = formula::circuit(circuit.map(|v| points.coordinates::<BigRational>(v)).each_ref());
                    for (v, k) in integers.terms {
                        let place = circuit.iter().position(|&w| w.0 == v).expect("of the circuit");
                        prop_assert_eq!(&quanta(k, 3), &c[place]);
                    }
                }
                events.push((Event::of_circuit(circuit), f, e));
            }
            for (a, fa, ea) in &events {
                for (b, fb, eb) in &events {
                    let known = <FilteredTimes<DoublePoints> as FlipTimes>::Order::compare_keys(fa.key, fb.key);
                    let order = exact.order().compare((a, &ea.time), (b, &eb.time));
                    prop_assert!(known.is_none_or(|o| o == order));
                    prop_assert_eq!(filtered.order().compare((a, &fa.time), (b, &fb.time)), order);
                }
            }
        }
    }
}
