//! [`FilteredTimes`](super::FilteredTimes) without one of their parts, for measuring what that part costs: evaluation,
//! queue and the copy of the region are the same.
//!
//! Orders that are not the true one come of it, too, and then a flip may be impossible when its time comes. The patches
//! of §3.3 would look outside of the copy. So there are none here, as in exact order: the insertion fails at the first
//! such flip ([`FlipOutcome::Impossible`](super::FlipOutcome::Impossible)), and the region is restored.

use super::event::Event;
use super::filtered::{AblatedOrder, Ablation, Filtered, FilteredTimes};
use super::motion::{Circuits, PolygonMotion};
use super::numbers::FlipNumbers;
use super::time::Undecided;
use crate::kinetic::{AblatedFilter, Bounded, Enclosure, FilteredTime, InQuanta, TimeOrder, Timed};
use crate::number::{Dyadic, Number};
use crate::predicate::PointStore;
use std::cmp::Ordering;
use std::marker::PhantomData;

/// The order of flip times with or without enclosures and perturbation.
type Rest<'a, P, const ENCLOSED: bool, const PERTURBED: bool> =
    AblatedFilter<Circuits<'a, P, Dyadic>, 5, ENCLOSED, PERTURBED>;

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
    type Order<'a, P: PointStore + 'a> = Rest<'a, P, true, false>;
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
    type Order<'a, P: PointStore + 'a> = Rest<'a, P, false, true>;
}

/// The number type of an ablation.
pub struct AblatedNumbers<A>(PhantomData<A>);

impl<A> Default for AblatedNumbers<A> {
    fn default() -> Self {
        AblatedNumbers(PhantomData)
    }
}

impl<A: Ablation> FlipNumbers for AblatedNumbers<A> {
    type Times<'a, P: PointStore + 'a> = FilteredTimes<'a, P, A>;

    const IN_COPY: bool = true;

    fn times<'a, P: PointStore>(&self, motion: &'a PolygonMotion<'a, P>) -> Self::Times<'a, P> {
        FilteredTimes::of_parts(motion)
    }
}

impl<'a, P: PointStore, const ENCLOSED: bool, const PERTURBED: bool> AblatedOrder<'a, P>
    for Rest<'a, P, ENCLOSED, PERTURBED>
{
    fn new(filtered: Filtered<'a, P>) -> Self {
        AblatedFilter(filtered)
    }

    #[inline(always)]
    fn certain(
        &mut self,
        quotient: [&Bounded; 2],
        typical: impl FnOnce() -> f64,
        integers: impl FnOnce() -> Option<InQuanta<5>>,
    ) -> (Enclosure, FilteredTime) {
        self.0.certain(quotient, typical, integers)
    }

    fn unknown(&mut self, event: &Event) -> Option<(Enclosure, FilteredTime)> {
        AblatedOrder::unknown(&mut self.0, event)
    }

    fn undecided(&self) -> Undecided {
        self.0.undecided()
    }
}

/// Rounded quotients, as enclosures have them in their middles, and nothing else: equal ones come in the order of their
/// arrival. Exact numbers are for the sign of D alone.
pub struct RoundedOnly<'a, P>(Filtered<'a, P>);

impl<'a, P: PointStore> TimeOrder for RoundedOnly<'a, P> {
    type Event = Event;
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

    fn compare(&mut self, _: Timed<Event, ()>, _: Timed<Event, ()>) -> Ordering {
        Ordering::Equal
    }
}

impl<'a, P: PointStore> AblatedOrder<'a, P> for RoundedOnly<'a, P> {
    fn new(filtered: Filtered<'a, P>) -> Self {
        RoundedOnly(filtered)
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
        let quotient = self.0.exact.quotient(event)?;
        let (n, d) = quotient.parts();
        Some((-n.to_f64() / d.to_f64(), ()))
    }

    fn undecided(&self) -> Undecided {
        self.0.undecided()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cdt::Cdt;
    use crate::exchange::{Facet, Plc};
    use crate::mesh::VertexId;
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
