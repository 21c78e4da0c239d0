//! How far the order in which flips came off a queue is from the true one.
//!
//! # What is counted
//! The sequence of an insertion is that of the events that came off the queue *alive*: with both tetrahedra in place,
//! flipped then or not. Events whose triangle was gone are left out: their order changes nothing; so are flips from the
//! list L and those of non-crossing triangles, which have no turn of their own. In exact order an event that is queued
//! by a flip is never earlier than that flip, so the sequence is sorted by the exact times (with the perturbation),
//! although the queue grows meanwhile. The pairs that are not in that order are therefore a measure of disorder: 0 for
//! exact times, always.
//!
//! Two events are *one* if they have one circuit: triangles that one flip removes, or one triangle twice. Two events
//! are *tied* if their times are equal without the perturbation, and they are not one.

use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};
use tetflip::kinetic::{Quotient, TimeOrder};
use tetflip::mesh::VertexId;
use tetflip::number::Dyadic;
use tetflip::predicate::PointStore;
use tetflip::recover::flips::{
    Event, ExactTimes, Exactness, Fate, FlipNumbers, FlipObserver, FlipOutcome, FlipTime,
    FlipTimes, NumberTask, PolygonMotion,
};
use tetflip::recover::polygons::FlipOrder;

/// The circuit of an event: v, x, y, z, w of the triangle xyz between the tetrahedra vxyz and wxzy.
pub type Circuit = [VertexId; 5];

/// What happened in one missing region.
#[derive(Clone, Debug)]
pub struct Insertion {
    /// The polygon.
    pub polygon: usize,
    /// Three of its vertices; the left side is where orient3d(frame, ·) is positive.
    pub frame: [VertexId; 3],
    /// The crossing tetrahedra before.
    pub before: Vec<[VertexId; 4]>,
    /// All events.
    pub events: Vec<(Circuit, Fate)>,
    /// How it ended and what fills the region then.
    pub end: Option<(FlipOutcome, Vec<[VertexId; 4]>)>,
}

/// All insertions of a run.
#[derive(Clone, Default, Debug)]
pub struct Trace {
    /// In order.
    pub insertions: Vec<Insertion>,
}

impl FlipObserver for Trace {
    fn begin(&mut self, polygon: usize, frame: [VertexId; 3], region: &[[VertexId; 4]]) {
        self.insertions.push(Insertion {
            polygon,
            frame,
            before: region.to_vec(),
            events: Vec::new(),
            end: None,
        });
    }

    fn event(&mut self, circuit: Circuit, fate: Fate) {
        let insertion = self.insertions.last_mut().expect("an insertion has begun");
        insertion.events.push((circuit, fate));
    }

    fn end(&mut self, outcome: FlipOutcome, tets: &[[VertexId; 4]]) {
        let insertion = self.insertions.last_mut().expect("an insertion has begun");
        insertion.end = Some((outcome, tets.to_vec()));
    }
}

/// The disorder of an insertion, or of several.
#[derive(Clone, Copy, Default, PartialEq, Eq, Debug)]
pub struct Disorder {
    /// Events that came off the queue alive.
    pub events: u64,
    /// Of those, ones that exact numbers would never have queued (D ≤ 0). They are in none of the following counts.
    pub unfounded: u64,
    /// Consecutive events in the wrong order.
    pub adjacent: u64,
    /// Pairs of events in the wrong order: Kendall's distance to the exact order.
    pub kendall: u64,
    /// Events tied with their predecessor in the exact order, but for the perturbation, which is needed to tell them
    /// apart: they are of different circuits.
    pub exact_ties: u64,
    /// Triangles whose event is one with that of another triangle: of each circuit all but one of those that came off
    /// the queue, alive or not. These ties need no perturbation, since one flip removes all triangles of its circuit:
    /// one in a 2-to-3 flip, up to two in a 4-to-4 flip, up to three in a 3-to-2 flip. So in exact order at most one of
    /// them comes off the queue alive, the first one, and the events of the others must be looked at, too.
    pub circuit_ties: u64,
    /// Events whose rounded time is that of their predecessor in rounded order, though they are not one event; `None`
    /// of a number type that this experiment cannot ask.
    pub rounded_ties: Option<u64>,
    /// The greatest length of the list L.
    pub longest_list: u64,
    /// Its length in the end.
    pub list_left: u64,
}

impl Disorder {
    /// Adds another insertion: sums, but the maximum of the longest lists.
    pub fn add(&mut self, other: &Disorder) {
        self.events += other.events;
        self.unfounded += other.unfounded;
        self.adjacent += other.adjacent;
        self.kendall += other.kendall;
        self.exact_ties += other.exact_ties;
        self.circuit_ties += other.circuit_ties;
        self.rounded_ties = self
            .rounded_ties
            .zip(other.rounded_ties)
            .map(|(a, b)| a + b);
        self.longest_list = self.longest_list.max(other.longest_list);
        self.list_left += other.list_left;
    }
}

/// Whether the event came off the queue when its turn had come, alive.
pub fn takes_turn(fate: Fate) -> bool {
    matches!(
        fate,
        Fate::Flipped(_) | Fate::Impossible | Fate::OutsideRegion
    )
}

/// The events of an insertion that came off the queue alive.
pub fn popped_alive(insertion: &Insertion) -> Vec<Circuit> {
    let alive = insertion
        .events
        .iter()
        .filter(|(_, fate)| takes_turn(*fate));
    alive.map(|&(circuit, _)| circuit).collect()
}

/// Whether a vertex is to the left of a flat polygon.
pub fn is_left<P: PointStore>(points: &P, [a, b, c]: [VertexId; 3], v: VertexId) -> bool {
    points.orient3d([a, b, c, v]).is_positive()
}

/// The place, from 1, of each event that came off the queue alive in the exact order; none for one that exact numbers
/// would never have queued.
pub fn exact_ranks<P: PointStore>(points: &P, insertion: &Insertion) -> Vec<Option<usize>> {
    let left = |v| is_left(points, insertion.frame, v);
    let motion = PolygonMotion::new(points, insertion.frame, &left);
    let mut exact = ExactTimes::<P, Dyadic>::new(&motion);
    let circuits = popped_alive(insertion);
    let quotients: Vec<_> = circuits.iter().map(|&c| exact.quotient(c)).collect();
    let mut timed: Vec<_> = (0..circuits.len())
        .filter_map(|i| Some((i, circuits[i], quotients[i].as_ref()?)))
        .collect();
    timed.sort_by(|a, b| exact.compare_quotients((a.1, a.2), (b.1, b.2)));
    let mut ranks = vec![None; circuits.len()];
    for (rank, (i, ..)) in timed.into_iter().enumerate() {
        ranks[i] = Some(rank + 1);
    }
    ranks
}

/// The disorder of an insertion whose queue was ordered by `times`. O(n log n) exact comparisons for n different
/// events: without exact predicates flips can go around in circles, and then the same few come off the queue again and
/// again.
pub fn disorder<P: PointStore>(points: &P, insertion: &Insertion, times: FlipOrder) -> Disorder {
    let left = |v| is_left(points, insertion.frame, v);
    let motion = PolygonMotion::new(points, insertion.frame, &left);
    let circuits = popped_alive(insertion);
    let mut exact = ExactTimes::<P, Dyadic>::new(&motion);
    let (places, exact_ties) = places(&mut exact, &circuits);
    let mut order: Vec<u64> = circuits
        .iter()
        .filter_map(|c| places.get(c).copied())
        .collect();
    let (events, founded) = (circuits.len() as u64, order.len() as u64);
    let adjacent = order.windows(2).filter(|w| w[0] > w[1]).count() as u64;
    let kendall = sort_counting_inversions(&mut order, &mut |a, b| a.cmp(&b));
    let mut is_one = |a: Circuit, b: Circuit| match (places.get(&a), places.get(&b)) {
        (Some(p), Some(q)) => p == q,
        _ => false,
    };
    let is_rounded = times.numbers.exactness() == Exactness::Rounded;
    // With other rules no two times would be equal.
    let rounded_ties = is_rounded.then(|| {
        FlipOrder::new(times.numbers).run(RoundedTies {
            motion: &motion,
            circuits: &circuits,
            is_one: &mut is_one,
        })
    });
    let (longest_list, list_left) = list_lengths(insertion);
    Disorder {
        events,
        unfounded: events - founded,
        adjacent,
        kendall,
        exact_ties,
        circuit_ties: circuit_ties(points, &mut exact, insertion),
        rounded_ties,
        longest_list,
        list_left,
    }
}

/// The place of each event in the exact order, equal for those that are one; none for one that exact numbers would
/// never have queued. And how many places have the time of the one before them, so that the perturbation alone tells
/// them apart.
fn places<P: PointStore>(
    exact: &mut ExactTimes<P, Dyadic>,
    circuits: &[Circuit],
) -> (BTreeMap<Circuit, u64>, u64) {
    let distinct: BTreeSet<Circuit> = circuits.iter().copied().collect();
    let timed = distinct
        .into_iter()
        .filter_map(|c| Some((c, exact.quotient(c)?)));
    let mut timed: Vec<(Circuit, Quotient<Dyadic>)> = timed.collect();
    timed.sort_by(|a, b| exact.compare_quotients((a.0, &a.1), (b.0, &b.1)));
    let (mut places, mut place, mut ties) = (BTreeMap::new(), 0, 0);
    for (i, (circuit, quotient)) in timed.iter().enumerate() {
        if let Some((before, earlier)) = i.checked_sub(1).map(|i| &timed[i]) {
            let ties_before = exact.undecided().ties;
            let order = exact.compare_quotients((*before, earlier), (*circuit, quotient));
            if order != Ordering::Equal {
                place += 1;
                ties += u64::from(exact.undecided().ties > ties_before);
            }
        }
        places.insert(*circuit, place);
    }
    (places, ties)
}

/// [`Disorder::circuit_ties`]. The circuit of an event are those of its five vertices without which the other four are
/// not on one plane; a triangle that is queued again, or seen from its other side, is no second one.
fn circuit_ties<P: PointStore>(
    points: &P,
    exact: &mut ExactTimes<P, Dyadic>,
    insertion: &Insertion,
) -> u64 {
    let mut triangles: BTreeMap<Vec<VertexId>, BTreeSet<[VertexId; 3]>> = BTreeMap::new();
    for &(five, fate) in &insertion.events {
        let had_turn = takes_turn(fate) || fate == Fate::Stale;
        if !had_turn || exact.quotient(five).is_none() {
            continue;
        }
        let in_circuit = |i: &usize| {
            let others = [1, 2, 3, 4].map(|k| five[(i + k) % 5]);
            !points.orient3d(others).is_zero()
        };
        let mut circuit: Vec<VertexId> = (0..5).filter(in_circuit).map(|i| five[i]).collect();
        circuit.sort_unstable();
        let [_, mut triangle @ .., _] = five;
        triangle.sort_unstable();
        triangles.entry(circuit).or_default().insert(triangle);
    }
    triangles
        .values()
        .map(|of_one| of_one.len() as u64 - 1)
        .sum()
}

/// Counts events whose rounded time is that of their predecessor.
struct RoundedTies<'a, P> {
    motion: &'a PolygonMotion<'a, P>,
    circuits: &'a [Circuit],
    is_one: &'a mut dyn FnMut(Circuit, Circuit) -> bool,
}

impl<P: PointStore> NumberTask for RoundedTies<'_, P> {
    type Output = u64;

    fn with<T: FlipNumbers>(self, numbers: &T) -> u64 {
        ties(&mut numbers.times(self.motion), self.circuits, self.is_one)
    }
}

/// Events whose time, as `times` computes it, is that of their predecessor.
fn ties<C: FlipTimes>(
    times: &mut C,
    circuits: &[Circuit],
    is_one: &mut dyn FnMut(Circuit, Circuit) -> bool,
) -> u64 {
    let mut events = Vec::new();
    for &circuit in circuits {
        let due = times.time(circuit);
        events.extend(due.map(|due| (Event::of_circuit(circuit), due)));
    }
    let mut compare = |a: &(Event, FlipTime<C::Order>), b: &(Event, FlipTime<C::Order>)| {
        C::Order::compare_keys(a.1.key, b.1.key).unwrap_or_else(|| {
            let order = times.order();
            order.compare((&a.0, &a.1.time), (&b.0, &b.1.time))
        })
    };
    events.sort_by(&mut compare);
    let pairs = events.windows(2);
    let tied = pairs.filter(|w| {
        compare(&w[0], &w[1]) == Ordering::Equal && !is_one(w[0].0.circuit, w[1].0.circuit)
    });
    tied.count() as u64
}

/// The greatest and the last length of the list L.
fn list_lengths(insertion: &Insertion) -> (u64, u64) {
    let (mut longest, mut length) = (0, 0u64);
    for (_, fate) in &insertion.events {
        match fate {
            Fate::Impossible => length += 1,
            Fate::FlippedFromList(_) | Fate::DroppedFromList => {
                length = length.checked_sub(1).expect("what leaves L was in it");
            }
            _ => {}
        }
        longest = longest.max(length);
    }
    (longest, length)
}

/// Merge sort, which is stable, and the number of pairs that were not in order: Kendall's distance between the two
/// orders.
pub fn sort_counting_inversions<T: Copy>(
    items: &mut [T],
    compare: &mut dyn FnMut(T, T) -> Ordering,
) -> u64 {
    let n = items.len();
    if n < 2 {
        return 0;
    }
    let (left, right) = items.split_at_mut(n / 2);
    let mut inversions =
        sort_counting_inversions(left, compare) + sort_counting_inversions(right, compare);
    let mut merged = Vec::with_capacity(n);
    let (mut l, mut r) = (0, 0);
    while l < left.len() && r < right.len() {
        if compare(left[l], right[r]) == Ordering::Greater {
            // It overtakes all that are left of the left half.
            inversions += (left.len() - l) as u64;
            merged.push(right[r]);
            r += 1;
        } else {
            merged.push(left[l]);
            l += 1;
        }
    }
    merged.extend_from_slice(&left[l..]);
    merged.extend_from_slice(&right[r..]);
    items.copy_from_slice(&merged);
    inversions
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::families::{Draw, Member};
    use tetflip::recover::flips::{FlipKind, NumberType};
    use tetflip::recover::polygons::Insertion as Algorithm;
    use tetflip::report::Report;

    #[test]
    fn kendall_distance_is_the_number_of_inverted_pairs() {
        let mut draw = Draw::new(2, 0);
        for n in 0..60 {
            // Few values, so that many are equal: no inversion.
            let items: Vec<(i32, usize)> = (0..n).map(|i| (draw.int(0, 9), i)).collect();
            let pairs = (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j)));
            let expected = pairs.filter(|&(i, j)| items[i].0 > items[j].0).count();
            let mut sorted = items.clone();
            let found = sort_counting_inversions(&mut sorted, &mut |a, b| a.0.cmp(&b.0));
            assert_eq!(found, expected as u64);
            assert!(sorted.is_sorted(), "sorted and stable: {sorted:?}");
        }
    }

    fn trace(member: &str, times: FlipOrder) -> (tetflip::predicate::DoublePoints, Trace) {
        let mut cdt = member.parse::<Member>().expect("a name").prepare().cdt;
        let points = cdt.points().clone();
        let mut trace = Trace::default();
        let algorithm = Algorithm::Flip(times);
        let _ = cdt.insert_polygons_observed(
            algorithm,
            &mut Report::default(),
            &mut |_| (),
            Some(&mut trace),
        );
        (points, trace)
    }

    #[test]
    fn exact_order_has_no_inversion_and_ties_are_seen() {
        let mut ties = 0;
        for member in [
            "sphere/centre:0",
            "lattice/layers:3",
            "rectangle/slab:1",
            "prism/right:2",
        ] {
            for times in [FlipOrder::EXACT, FlipOrder::FILTERED] {
                let (points, trace) = trace(member, times);
                assert!(!trace.insertions.is_empty());
                for insertion in &trace.insertions {
                    let d = disorder(&points, insertion, times);
                    assert!(d.events > 0);
                    assert_eq!((d.adjacent, d.kendall, d.unfounded), (0, 0, 0), "{member}");
                    ties += d.exact_ties;
                }
            }
        }
        assert!(ties > 20, "{ties}");
    }

    /// Counted again, by comparing exact times with the perturbation instead of vertices. Alive events are never one.
    #[test]
    fn triangles_of_one_circuit_are_counted_apart() {
        let mut total = 0;
        for member in ["lattice/layers:3", "rectangle/slab:1", "random/triangle:2"] {
            let (points, trace) = trace(member, FlipOrder::EXACT);
            for insertion in &trace.insertions {
                let left = |v| is_left(&points, insertion.frame, v);
                let motion = PolygonMotion::new(&points, insertion.frame, &left);
                let mut exact = ExactTimes::<_, Dyadic>::new(&motion);
                // One event of each triangle with each pair of tetrahedra.
                let mut events: BTreeMap<[Vec<VertexId>; 2], Circuit> = BTreeMap::new();
                for &(five @ [v, x, y, z, w], _) in &insertion.events {
                    let [mut triangle, mut apexes] = [vec![x, y, z], vec![v, w]];
                    triangle.sort_unstable();
                    apexes.sort_unstable();
                    events.insert([triangle, apexes], five);
                }
                let events: Vec<Circuit> = events.into_values().collect();
                let mut firsts: Vec<Circuit> = Vec::new();
                let mut ties = 0;
                for &event in &events {
                    let mut time = |e: Circuit| exact.quotient(e).expect("exact times are founded");
                    let mine = time(event);
                    let others: Vec<_> = firsts.iter().map(|&e| (e, time(e))).collect();
                    let mut is_one = |(e, t): &(Circuit, _)| {
                        exact.compare_quotients((event, &mine), (*e, t)) == Ordering::Equal
                    };
                    if others.iter().any(&mut is_one) {
                        ties += 1;
                    } else {
                        firsts.push(event);
                    }
                }
                let d = disorder(&points, insertion, FlipOrder::EXACT);
                assert_eq!(d.circuit_ties, ties, "{member}");
                total += ties;
                let alive: BTreeSet<Circuit> = popped_alive(insertion).into_iter().collect();
                let places = places(&mut exact, &Vec::from_iter(alive.iter().copied())).0;
                let distinct: BTreeSet<u64> = places.values().copied().collect();
                assert_eq!(distinct.len(), alive.len(), "{member}");
            }
        }
        assert!(total > 10, "{total}");
    }

    #[test]
    fn a_reversed_trace_is_all_inversions() {
        let (points, trace) = trace("rectangle/slab:1", FlipOrder::EXACT);
        let mut insertion = trace.insertions[0].clone();
        insertion.events.reverse();
        let d = disorder(&points, &insertion, FlipOrder::new(NumberType::F64Plain));
        // Two triangles of one circuit are in any order.
        let (n, most) = (d.events, d.events * (d.events - 1) / 2);
        assert!(d.kendall > most * 9 / 10 && d.kendall <= most, "{d:?}");
        assert!(d.adjacent > n * 8 / 10 && d.adjacent < n);
        assert_eq!(d.rounded_ties.map(|t| t < n / 4), Some(true));
    }

    #[test]
    fn lists_grow_and_shrink() {
        let circuit = [VertexId(0); 5];
        let fates = [
            Fate::Impossible,
            Fate::Impossible,
            Fate::Flipped(FlipKind::TwoThree),
            Fate::DroppedFromList,
            Fate::Impossible,
            Fate::Impossible,
            Fate::FlippedFromList(FlipKind::ThreeTwo),
        ];
        let insertion = Insertion {
            polygon: 0,
            frame: [VertexId(0); 3],
            before: Vec::new(),
            events: fates.map(|fate| (circuit, fate)).to_vec(),
            end: None,
        };
        assert_eq!(list_lengths(&insertion), (3, 2));
    }
}
