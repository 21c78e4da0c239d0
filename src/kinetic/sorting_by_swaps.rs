//! The queue and the orders on a motion on a line: particles x_v(τ) = a_v + b_v·τ + ε_v, and the swaps of neighbours
//! that keep them sorted (kinetic sorting). An event has two vertices; all times are rational, and many are equal.

use super::*;
use crate::number::{Approx, Dyadic, Exact, Number};
use num_rational::BigRational;
use std::cmp::Ordering;

/// A particle: place at τ = 0 and speed.
type Particle = (i32, i32);

/// Neighbours, the left one first.
type Pair = [usize; 2];

/// The motion of particles, whose identities are their indices: S = x_left − x_right is negative while they are in
/// order.
struct OnLine<'a>(&'a [Particle]);

impl OnLine<'_> {
    fn evaluate<N: Number>(&self, &[left, right]: &Pair) -> [N; 2] {
        let (l, r) = (self.0[left], self.0[right]);
        let difference = |l: i32, r: i32| N::from_f64(l.into()) - &N::from_f64(r.into());
        [difference(l.0, r.0), difference(l.1, r.1)]
    }
}

impl<N: Exact> Motion<N, 2> for OnLine<'_> {
    type Event = Pair;

    fn quotient(&mut self, event: &Pair) -> Option<Quotient<N>> {
        let [n, d] = self.evaluate(event);
        Quotient::of_rising(n, d)
    }

    fn perturbation(&mut self, &[left, right]: &Pair) -> [(u32, N); 2] {
        [
            (left as u32, N::from_f64(1.0)),
            (right as u32, N::from_f64(-1.0)),
        ]
    }

    fn is_one_circuit(a: &Pair, b: &Pair) -> bool {
        a == b
    }
}

type KeyAndTime<O> = (<O as TimeOrder>::Key, <O as TimeOrder>::Time);

/// Evaluates times for some order.
trait Times {
    type Order: TimeOrder<Event = Pair>;

    fn time(&mut self, event: &Pair) -> Option<KeyAndTime<Self::Order>>;

    fn order(&mut self) -> &mut Self::Order;
}

impl<N: Exact> Times for ExactOrder<OnLine<'_>, N, 2> {
    type Order = Self;

    fn time(&mut self, event: &Pair) -> Option<((), Quotient<N>)> {
        Some(((), self.quotient(event)?))
    }

    fn order(&mut self) -> &mut Self {
        self
    }
}

impl Times for FilteredOrder<OnLine<'_>, 2> {
    type Order = Self;

    fn time(&mut self, event: &Pair) -> Option<(Enclosure, FilteredTime)> {
        let [n, d] = self
            .exact
            .motion
            .evaluate::<Approx>(event)
            .map(Bounded::from);
        // Only of every other event are integers known.
        let in_quanta = (event[0].is_multiple_of(2)).then(|| {
            let quotient = [n.in_quanta(1.0), d.in_quanta(1.0)].map(|i| i.expect("small"));
            InQuanta::new(quotient, [(event[0] as u32, 1), (event[1] as u32, -1)])
        });
        if !d.is_positive() {
            return self.unknown(event);
        }
        let time = in_quanta.map_or_else(FilteredTime::default, |q| self.in_integers(q));
        Some((self.key([&n, &d], || 1.0), time))
    }

    fn order(&mut self) -> &mut Self {
        self
    }
}

/// Sorts by swaps in the order of the queue, and returns the swaps. Every swap must be one of neighbours when its time
/// comes.
fn swaps<T: Times>(particles: &[Particle], times: &mut T) -> Vec<Pair> {
    let mut line: Vec<usize> = (0..particles.len()).collect();
    // Just before τ = 0⁻: by place, then by ε, of which that of the smaller identity is the greater.
    line.sort_by_key(|&v| (particles[v].0, std::cmp::Reverse(v)));
    let mut queue = EventQueue::earliest_first();
    let push = |queue: &mut EventQueue<T::Order>, times: &mut T, pair: Pair| {
        if let Some((key, time)) = times.time(&pair) {
            queue.push(times.order(), pair, key, time);
        }
    };
    for pair in line.windows(2) {
        push(&mut queue, times, [pair[0], pair[1]]);
    }
    let mut done = Vec::new();
    while let Some([left, right]) = queue.pop(times.order()) {
        let place = line.iter().position(|&v| v == left).expect("all are there");
        if line.get(place + 1) != Some(&right) {
            // They were parted, and each will meet the other again when it is next to it.
            continue;
        }
        line.swap(place, place + 1);
        done.push([left, right]);
        for i in [place.wrapping_sub(1), place + 1] {
            if let (Some(&l), Some(&r)) = (line.get(i), line.get(i.wrapping_add(1))) {
                push(&mut queue, times, [l, r]);
            }
        }
    }
    done
}

/// All pairs that meet, in the order in which they do: in rationals, with small numbers for ε.
fn meetings(particles: &[Particle]) -> Vec<Pair> {
    let rational = |x: i64| BigRational::from_integer(x.into());
    let epsilon = |v: usize| {
        let eta = BigRational::new(1.into(), 10_000.into());
        eta.pow(v as i32 + 1)
    };
    let mut meetings = Vec::new();
    for l in 0..particles.len() {
        for r in 0..particles.len() {
            let (p, q) = (particles[l], particles[r]);
            let before = (p.0, std::cmp::Reverse(l)) < (q.0, std::cmp::Reverse(r));
            if before && p.1 > q.1 {
                let gap = rational((q.0 - p.0).into()) + epsilon(r) - epsilon(l);
                meetings.push((gap / rational((p.1 - q.1).into()), [l, r]));
            }
        }
    }
    meetings.sort();
    meetings.into_iter().map(|(_, pair)| pair).collect()
}

/// Particles with few places and speeds, so that many meet at one time, and three and more at one place.
fn particles(n: usize, seed: u64) -> Vec<Particle> {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let mut next = move |n: u64| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        ((state >> 33) % n) as i32
    };
    (0..n).map(|_| (next(6), next(5) - 2)).collect()
}

#[test]
fn exact_orders_sort_particles_on_a_line() {
    let (mut swapped, mut ties) = (0, 0);
    for seed in 0..60 {
        let particles = particles(2 + seed as usize % 15, seed);
        let expected = meetings(&particles);
        let mut exact = ExactOrder::<_, Dyadic, 2>::new(OnLine(&particles));
        assert_eq!(swaps(&particles, &mut exact), expected, "{particles:?}");
        let mut rational = ExactOrder::<_, BigRational, 2>::new(OnLine(&particles));
        assert_eq!(swaps(&particles, &mut rational), expected);
        let mut filtered = FilteredOrder::new(OnLine(&particles));
        assert_eq!(swaps(&particles, &mut filtered), expected);
        swapped += expected.len();
        ties += exact.ties;
        assert!(
            filtered.ties() > 0 || exact.ties == 0,
            "equal times are compared exactly"
        );
    }
    assert!(swapped > 1000 && ties > 1000, "{swapped} {ties}");
}

/// The same with doubles and any of the three in doubt: only the rule for equal times differs.
#[test]
fn rounded_orders_break_ties_as_they_are_told() {
    struct ByPerturbation<'a>(ExactOrder<OnLine<'a>, Dyadic, 2>);

    impl TieBreaker for ByPerturbation<'_> {
        type Event = Pair;

        fn break_tie(&mut self, a: &Pair, b: &Pair) -> Ordering {
            let mut quotient = |event: &Pair| {
                self.0
                    .motion
                    .quotient(event)
                    .expect("only what meets is queued")
            };
            let (qa, qb) = (quotient(a), quotient(b));
            self.0.compare_perturbations((a, &qa), (b, &qb))
        }
    }

    struct Rounded<'a, T: TieBreaker>(OnLine<'a>, RoundedOrder<f64, T>);

    impl<T: TieBreaker<Event = Pair>> Times for Rounded<'_, T> {
        type Order = RoundedOrder<f64, T>;

        fn time(&mut self, event: &Pair) -> Option<(f64, f64)> {
            let [n, d] = self.0.evaluate::<f64>(event);
            (d > 0.0).then_some((-n / d, -n / d))
        }

        fn order(&mut self) -> &mut Self::Order {
            &mut self.1
        }
    }

    let mut differences = 0;
    for seed in 0..60 {
        let particles = particles(2 + seed as usize % 15, seed);
        let expected = meetings(&particles);
        // Quotients of numbers as small as these are equal or far apart.
        let ties = ByPerturbation(ExactOrder::new(OnLine(&particles)));
        let mut perturbed = Rounded(OnLine(&particles), RoundedOrder::new(ties));
        assert_eq!(swaps(&particles, &mut perturbed), expected);
        let mut arrival = Rounded(
            OnLine(&particles),
            RoundedOrder::new(ArrivalOrder::default()),
        );
        differences += usize::from(swaps(&particles, &mut arrival) != expected);
    }
    assert!(differences > 30, "{differences}");
}
