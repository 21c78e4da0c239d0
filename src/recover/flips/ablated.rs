//! [`FilteredTimes`](super::FilteredTimes) without one of their parts, for measuring what that part costs: evaluation,
//! queue and the copy of the region are the same.
//!
//! Orders that are not the true one come of it, too, and then a flip may be impossible when its time comes. The patches
//! of §3.3 would look outside of the copy. So there are none here, as in exact order: the insertion fails at the first
//! such flip ([`FlipOutcome::Impossible`](super::FlipOutcome::Impossible)), and the region is restored.

use super::event::{Event, Signs};
use super::filter::{Filter, Rising};
use super::motion::{Circuits, PolygonMotion};
use super::numbers::FlipNumbers;
use super::time::{FlipTime, FlipTimes, Undecided};
use crate::kinetic::{
    Bounded, Enclosure, FilteredOrder, FilteredTime, InQuanta, Middles, TimeOrder, Unenclosed,
    Unperturbed,
};
use crate::mesh::VertexId;
use crate::number::{Dyadic, Number};
use crate::predicate::PointStore;
use std::marker::PhantomData;

type Filtered<'a, P> = FilteredOrder<Circuits<'a, P, Dyadic>, 5>;

/// Which part is left out.
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

/// Nothing is exact about times but the sign of D: rounded quotients, in the order of their arrival where they are
/// equal.
pub struct RoundedKeys;

impl Ablation for RoundedKeys {
    const INTEGERS: bool = false;
    type Order<'a, P: PointStore + 'a> = RoundedOnly<'a, P>;
}

/// Exact quotients, but no perturbation where they are equal.
pub struct NoPerturbation;

impl Ablation for NoPerturbation {
    const INTEGERS: bool = true;
    type Order<'a, P: PointStore + 'a> = Unperturbed<Circuits<'a, P, Dyadic>, 5>;
}

/// No quotients of 64-bit integers.
pub struct NoIntegers;

impl Ablation for NoIntegers {
    const INTEGERS: bool = false;
    type Order<'a, P: PointStore + 'a> = Filtered<'a, P>;
}

/// No enclosures: all comparisons are exact.
pub struct NoEnclosures;

impl Ablation for NoEnclosures {
    const INTEGERS: bool = true;
    type Order<'a, P: PointStore + 'a> = Unenclosed<Circuits<'a, P, Dyadic>, 5>;
}

/// The number type of an ablation.
pub struct AblatedNumbers<A>(PhantomData<A>);

impl<A> Default for AblatedNumbers<A> {
    fn default() -> Self {
        AblatedNumbers(PhantomData)
    }
}

impl<A: Ablation> FlipNumbers for AblatedNumbers<A> {
    type Times<'a, P: PointStore + 'a> = AblatedTimes<'a, P, A>;

    const IN_COPY: bool = true;

    fn times<'a, P: PointStore>(&self, motion: &'a PolygonMotion<'a, P>) -> Self::Times<'a, P> {
        AblatedTimes {
            points: motion.points,
            filter: Filter::new(motion),
            order: AblatedOrder::new(FilteredOrder::new(Circuits::new(motion))),
        }
    }
}

/// Flip times of an ablation.
pub struct AblatedTimes<'a, P: PointStore + 'a, A: Ablation> {
    points: &'a P,
    filter: Filter<'a, P>,
    order: A::Order<'a, P>,
}

impl<'a, P: PointStore, A: Ablation> AblatedTimes<'a, P, A> {
    #[inline(always)]
    fn in_quanta(
        filter: &Filter<'a, P>,
        points: &P,
        rising: &Rising,
        n: &Bounded,
        circuit: [VertexId; 5],
    ) -> Option<InQuanta<5>> {
        if !A::INTEGERS {
            return None;
        }
        let (quotient, c) = filter.integers(rising, n)?;
        let terms = [0, 1, 2, 3, 4].map(|i| (points.identity(circuit[i]), c[i]));
        Some(InQuanta::new(quotient, terms))
    }
}

impl<'a, P: PointStore, A: Ablation> FlipTimes for AblatedTimes<'a, P, A> {
    type Order = A::Order<'a, P>;

    // No patches.
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
        let (key, time) = self.order.certain(
            [&n, &rising.d],
            || filter.typical_time(&rising),
            || Self::in_quanta(filter, points, &rising, &n, circuit),
        );
        Some(FlipTime { key, time, signs })
    }

    fn undecided(&self) -> Undecided {
        self.order.undecided()
    }
}

fn undecided<P: PointStore>(order: &Filtered<P>) -> Undecided {
    Undecided {
        compared_exactly: order.compared_exactly,
        ties: order.ties(),
        one_circuit: order.one_circuit(),
        big_quotients: order.exact.quotients,
        overflows: 0,
    }
}

#[inline(always)]
fn certain<P: PointStore>(
    order: &mut Filtered<P>,
    quotient: [&Bounded; 2],
    typical: impl FnOnce() -> f64,
    integers: impl FnOnce() -> Option<InQuanta<5>>,
) -> (Enclosure, FilteredTime) {
    let time = integers().map_or_else(FilteredTime::default, |integers| {
        order.in_integers(integers)
    });
    (order.key(quotient, typical), time)
}

/// Orders with enclosures for keys: where the filtered order is in them.
macro_rules! over_filtered {
    ($($order:ty: $inner:ident => $filtered:expr, $new:expr;)*) => {$(
        impl<'a, P: PointStore> AblatedOrder<'a, P> for $order {
            fn new(filtered: Filtered<'a, P>) -> Self {
                $new(filtered)
            }

            #[inline(always)]
            fn certain(
                &mut self,
                quotient: [&Bounded; 2],
                typical: impl FnOnce() -> f64,
                integers: impl FnOnce() -> Option<InQuanta<5>>,
            ) -> (Enclosure, FilteredTime) {
                let $inner = self;
                certain(&mut $filtered, quotient, typical, integers)
            }

            fn unknown(&mut self, event: &Event) -> Option<(Enclosure, FilteredTime)> {
                let $inner = self;
                $filtered.unknown(event)
            }

            fn undecided(&self) -> Undecided {
                let $inner = self;
                undecided(&$filtered)
            }
        }
    )*};
}

over_filtered! {
    Filtered<'a, P>: order => *order, |filtered| filtered;
    Unperturbed<Circuits<'a, P, Dyadic>, 5>: order => order.0, Unperturbed;
    Unenclosed<Circuits<'a, P, Dyadic>, 5>: order => order.0, Unenclosed;
}

/// [`Middles`], and exact numbers for the sign of D.
pub struct RoundedOnly<'a, P> {
    middles: Middles<Event>,
    filtered: Filtered<'a, P>,
}

impl<'a, P: PointStore> TimeOrder for RoundedOnly<'a, P> {
    type Event = Event;
    type Key = f64;
    type Time = ();

    #[inline]
    fn about(key: f64) -> Option<f64> {
        Middles::<Event>::about(key)
    }

    #[inline]
    fn compare_keys(a: f64, b: f64) -> Option<std::cmp::Ordering> {
        Middles::<Event>::compare_keys(a, b)
    }

    fn compare(&mut self, a: (&Event, &()), b: (&Event, &())) -> std::cmp::Ordering {
        self.middles.compare(a, b)
    }
}

impl<'a, P: PointStore> AblatedOrder<'a, P> for RoundedOnly<'a, P> {
    fn new(filtered: Filtered<'a, P>) -> Self {
        RoundedOnly {
            middles: Middles::default(),
            filtered,
        }
    }

    #[inline(always)]
    fn certain(
        &mut self,
        [n, d]: [&Bounded; 2],
        _: impl FnOnce() -> f64,
        _: impl FnOnce() -> Option<InQuanta<5>>,
    ) -> (f64, ()) {
        (-n.value / d.value, ())
    }

    fn unknown(&mut self, event: &Event) -> Option<(f64, ())> {
        let quotient = self.filtered.exact.quotient(event)?;
        let (n, d) = quotient.parts();
        Some((-n.to_f64() / d.to_f64(), ()))
    }

    fn undecided(&self) -> Undecided {
        undecided(&self.filtered)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cdt::Cdt;
    use crate::exchange::{Facet, Plc};
    use crate::predicate::DoublePoints;
    use crate::recover::flips::{FilteredNumbers, FlipCounts, FlipRegion};
    use crate::report::Report;

    /// A triangle through points of a flat box: of random ones, or of a lattice.
    fn scene(grid: f64) -> Plc {
        let mut state = 7u32;
        let mut next = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(state >> 8) / f64::from(1 << 24) - 0.5
        };
        let mut vertices = vec![[-9., -8., 0.], [9., -7., 0.], [1., 9., 0.]];
        while vertices.len() < 120 {
            let p = [2.0 * next(), 2.0 * next(), 0.25 * next()].map(|x| (x * grid).round() / grid);
            if p[2] != 0.0 && !vertices.contains(&p) {
                vertices.push(p);
            }
        }
        let polygon = vec![(0..3).map(VertexId::new).collect()];
        let facets = vec![Facet {
            polygons: polygon,
            ..Facet::default()
        }];
        Plc {
            vertices,
            facets,
            ..Plc::default()
        }
    }

    fn flips(
        plc: &Plc,
        numbers: &dyn FlipRegion<DoublePoints>,
    ) -> Option<(Vec<[VertexId; 4]>, FlipCounts)> {
        let mut report = Report::default();
        let mut cdt = Cdt::with_segments(plc, true, &mut report).expect("a valid PLC");
        let counts = cdt.insert_polygons_in(numbers, &mut report, None).ok()?;
        assert!(counts.largest_region >= 100, "in a copy");
        let mut tets: Vec<_> = cdt
            .mesh()
            .finite()
            .map(|t| cdt.mesh().vertices(t))
            .collect();
        tets.iter_mut().for_each(|t| t.sort_unstable());
        tets.sort_unstable();
        Some((tets, counts.flips))
    }

    #[test]
    fn in_general_position_all_make_the_same_flips() {
        let plc = scene(1e9);
        let (tets, counts) = flips(&plc, &FilteredNumbers).expect("exact");
        let all: [&dyn FlipRegion<DoublePoints>; 4] = [
            &AblatedNumbers::<RoundedKeys>::default(),
            &AblatedNumbers::<NoPerturbation>::default(),
            &AblatedNumbers::<NoIntegers>::default(),
            &AblatedNumbers::<NoEnclosures>::default(),
        ];
        for numbers in all {
            let (same, other) = flips(&plc, numbers).expect("nothing is near a tie");
            assert_eq!(same, tets);
            assert_eq!(
                (other.flips(), other.queued),
                (counts.flips(), counts.queued)
            );
        }
    }

    #[test]
    fn ties_are_left_to_arrival_and_integers_to_numbers_of_any_size() {
        let plc = scene(8.0);
        let (tets, counts) = flips(&plc, &FilteredNumbers).expect("exact");
        assert!(counts.ties > counts.one_circuit, "{counts:?}");
        let exact: [&dyn FlipRegion<DoublePoints>; 2] = [
            &AblatedNumbers::<NoIntegers>::default(),
            &AblatedNumbers::<NoEnclosures>::default(),
        ];
        let [(a, big), (b, all)] = exact.map(|numbers| flips(&plc, numbers).expect("exact"));
        assert!(a == tets && b == tets);
        assert!(big.big_quotients > counts.big_quotients);
        assert!(all.compared_exactly > counts.compared_exactly);
        // What comes of the others is no matter of proof: if they succeed then without the perturbation.
        let arrival = AblatedNumbers::<NoPerturbation>::default();
        assert!(flips(&plc, &arrival).is_none_or(|(_, counts)| counts.ties == counts.one_circuit));
    }
}
