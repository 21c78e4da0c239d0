//! The priority queue of flips: a binary heap whose order is asked from a [`FlipTimes`], so that a comparison may use
//! the point store and compute what it needs.
//!
//! The heap moves keys and the numbers of events; the events stay where they are until they come off the queue. Events in
//! the far future do not go there at once, but to a *pile*, which is read from front to back: the heap, and the events
//! that it refers to, stay small enough for the caches. An event is on the pile only if its key says for certain that it
//! comes after the *horizon*, the time of some other event, and an event leaves the heap only if its key says for certain
//! that it comes before; else the horizon moves on. So the order is that of one heap.

use super::event::Event;
use super::time::{FlipTimes, Timing};
use std::cmp::Ordering;

/// A pile of at most so many events goes to the heap as a whole, and that is the end of the pile.
const SMALL_PILE: usize = 500;

/// How many keys of the pile are looked at to choose a horizon: the third of them has a fraction of 3/17 of the pile before
/// it on average.
const SAMPLES: usize = 16;

/// Events, the earliest first or the latest first.
pub struct FlipQueue<C: FlipTimes> {
    heap: Vec<Entry<C::Key>>,
    events: Vec<Queued<C::Time>>,
    /// Places in `events` to be used again.
    free: Vec<u32>,
    latest_first: bool,
    /// Events after the horizon.
    pile: Vec<(C::Key, Queued<C::Time>)>,
    horizon: Horizon<C::Key>,
    /// How many events have ever been queued.
    arrived: u32,
    comparisons: u64,
}

/// The time that separates the heap from the pile.
#[derive(Clone, Copy)]
enum Horizon<K> {
    /// Before the first event is asked for: all are on the pile.
    Unknown,
    /// The key of some event.
    At(K),
    /// Nothing is on the pile, nor ever will be.
    Infinite,
}

#[derive(Clone, Copy)]
struct Entry<K> {
    key: K,
    event: u32,
}

struct Queued<T> {
    event: Event,
    time: T,
    /// When it was queued, for ties between rounded times.
    arrival: u32,
}

impl<C: FlipTimes> FlipQueue<C> {
    /// An empty queue, which gives the earliest event first: that of an insertion.
    pub fn earliest_first() -> Self {
        FlipQueue {
            heap: Vec::new(),
            events: Vec::new(),
            free: Vec::new(),
            latest_first: false,
            pile: Vec::new(),
            horizon: Horizon::Unknown,
            arrived: 0,
            comparisons: 0,
        }
    }

    /// An empty queue, which gives the latest event first: that of a deletion.
    pub fn latest_first() -> Self {
        FlipQueue {
            latest_first: true,
            ..FlipQueue::earliest_first()
        }
    }

    /// The number of events that have been queued so far.
    pub fn arrived(&self) -> u64 {
        u64::from(self.arrived)
    }

    /// The number of comparisons so far.
    pub fn comparisons(&self) -> u64 {
        self.comparisons
    }

    /// Inserts an event. O(log n) comparisons.
    pub fn push(&mut self, times: &mut C, event: Event, timing: Timing<C::Key, C::Time>) {
        let queued = Queued {
            event,
            time: timing.time,
            arrival: self.arrived,
        };
        self.arrived = self.arrived.checked_add(1).expect("fewer than 2^32 events");
        if self.is_beyond_horizon(timing.key) {
            self.pile.push((timing.key, queued));
        } else {
            self.put_on_heap(times, timing.key, queued);
        }
    }

    fn put_on_heap(&mut self, times: &mut C, key: C::Key, queued: Queued<C::Time>) {
        let place = match self.free.pop() {
            Some(place) => {
                self.events[place as usize] = queued;
                place
            }
            None => {
                self.events.push(queued);
                u32::try_from(self.events.len() - 1).expect("fewer than 2^32 events")
            }
        };
        let entry = Entry { key, event: place };
        self.heap.push(entry);
        self.sift_up(times, self.heap.len() - 1, entry);
    }

    /// Whether a key comes after the horizon for certain.
    #[inline]
    fn is_beyond_horizon(&mut self, key: C::Key) -> bool {
        let horizon = match self.horizon {
            Horizon::Unknown => return true,
            Horizon::At(key) => key,
            Horizon::Infinite => return false,
        };
        self.comparisons += 1;
        let beyond = if self.latest_first {
            Ordering::Less
        } else {
            Ordering::Greater
        };
        C::compare_keys(key, horizon) == Some(beyond)
    }

    /// Whether a key comes before the horizon for certain.
    #[inline]
    fn is_before_horizon(&mut self, key: C::Key) -> bool {
        let horizon = match self.horizon {
            Horizon::Unknown => return false,
            Horizon::At(key) => key,
            Horizon::Infinite => return true,
        };
        self.comparisons += 1;
        let before = if self.latest_first {
            Ordering::Greater
        } else {
            Ordering::Less
        };
        C::compare_keys(key, horizon) == Some(before)
    }

    /// Moves the horizon until the first event of the heap is before it, or the pile is empty.
    fn move_horizon(&mut self, times: &mut C) {
        while !self.pile.is_empty() {
            if let Some(first) = self.heap.first().copied()
                && self.is_before_horizon(first.key)
            {
                return;
            }
            self.horizon = if self.pile.len() <= SMALL_PILE {
                Horizon::Infinite
            } else {
                Horizon::At(self.early_key())
            };
            let mut later = Vec::new();
            for (key, queued) in std::mem::take(&mut self.pile) {
                if self.is_beyond_horizon(key) {
                    later.push((key, queued));
                } else {
                    self.put_on_heap(times, key, queued);
                }
            }
            self.pile = later;
        }
    }

    /// An early key of the pile: the third of some samples. Any key is right; an event is never beyond itself.
    fn early_key(&self) -> C::Key {
        let step = self.pile.len().div_ceil(SAMPLES);
        let first_if_known = |a: C::Key, b: C::Key| match C::compare_keys(a, b) {
            Some(Ordering::Less) => !self.latest_first,
            Some(_) => self.latest_first,
            None => false,
        };
        let mut earliest: [Option<C::Key>; 3] = [None; 3];
        for mut key in self.pile.iter().step_by(step).map(|p| p.0) {
            for place in &mut earliest {
                match place {
                    Some(known) if !first_if_known(key, *known) => {}
                    Some(known) => std::mem::swap(known, &mut key),
                    None => {
                        *place = Some(key);
                        break;
                    }
                }
            }
        }
        let last = earliest.into_iter().flatten().next_back();
        last.expect("the pile is not empty")
    }

    /// Removes the first event. About log₂ n comparisons: the hole at the top sinks to a leaf along the earlier
    /// children, and the last event rises from there, usually not far (Floyd's variant; comparisons are what costs).
    pub fn pop(&mut self, times: &mut C) -> Option<Event> {
        self.move_horizon(times);
        let first = self.heap.first()?.event;
        let last = self.heap.pop().expect("the heap is not empty");
        if !self.heap.is_empty() {
            let hole = self.sink(times);
            self.sift_up(times, hole, last);
        }
        self.free.push(first);
        Some(self.events[first as usize].event)
    }

    /// Sinks a hole from the top to a leaf.
    fn sink(&mut self, times: &mut C) -> usize {
        let n = self.heap.len();
        let mut hole = 0;
        loop {
            let (left, right) = (2 * hole + 1, 2 * hole + 2);
            if left >= n {
                return hole;
            }
            let right_first = right < n && self.precedes(times, self.heap[right], self.heap[left]);
            let child = if right_first { right } else { left };
            self.heap[hole] = self.heap[child];
            hole = child;
        }
    }

    /// Puts an entry into a hole or above it.
    fn sift_up(&mut self, times: &mut C, mut hole: usize, entry: Entry<C::Key>) {
        while hole > 0 {
            let parent = (hole - 1) / 2;
            if !self.precedes(times, entry, self.heap[parent]) {
                break;
            }
            self.heap[hole] = self.heap[parent];
            hole = parent;
        }
        self.heap[hole] = entry;
    }

    #[inline]
    fn precedes(&mut self, times: &mut C, a: Entry<C::Key>, b: Entry<C::Key>) -> bool {
        self.comparisons += 1;
        let order = C::compare_keys(a.key, b.key).unwrap_or_else(|| self.compare(times, a, b));
        (order == Ordering::Less) != self.latest_first
    }

    /// Where the keys do not tell. Never `Equal`: in the end the arrival decides.
    #[cold]
    fn compare(&self, times: &mut C, a: Entry<C::Key>, b: Entry<C::Key>) -> Ordering {
        let (a, b) = (
            &self.events[a.event as usize],
            &self.events[b.event as usize],
        );
        times
            .compare((&a.event, &a.time), (&b.event, &b.time))
            .then(a.arrival.cmp(&b.arrival))
    }
}

#[cfg(test)]
mod tests {
    use super::super::time::{Timed, Undecided};
    use super::*;
    use crate::mesh::{TetId, VertexId};

    /// Times that are plain integers.
    struct Integers;

    impl FlipTimes for Integers {
        type Key = i32;
        type Time = ();
        const EXACT: bool = true;
        type Lift = ();
        fn lift(&mut self, _: [VertexId; 4]) {}
        fn time_across(&mut self, (): &mut (), _: [VertexId; 5]) -> Option<Timing<i32, ()>> {
            None
        }
        fn compare_keys(a: i32, b: i32) -> Option<Ordering> {
            Some(a.cmp(&b)).filter(|o| o.is_ne())
        }
        fn compare(&mut self, _: Timed<()>, _: Timed<()>) -> Ordering {
            Ordering::Equal
        }
        fn undecided(&self) -> Undecided {
            Undecided::default()
        }
    }

    /// The (time, arrival) of the last 3000 of 5000 events, many at the same time, as they come off a queue.
    fn sorted_by(mut queue: FlipQueue<Integers>) -> Vec<(i32, u32)> {
        let time = |arrival: u32| (arrival * 37 % 411) as i32;
        let push = |queue: &mut FlipQueue<Integers>, arrival| {
            let event = Event {
                circuit: [VertexId(0); 5],
                tet: TetId(arrival),
                signs: [None; 3],
            };
            let timing = Timing {
                key: time(arrival),
                time: (),
                signs: [None; 3],
            };
            queue.push(&mut Integers, event, timing);
        };
        for arrival in 0..3000 {
            push(&mut queue, arrival);
        }
        // Places are used again.
        for arrival in 3000..5000 {
            let first = queue.pop(&mut Integers).expect("3000 events");
            push(&mut queue, arrival);
            assert!(first.tet.0 < arrival);
        }
        let mut order = Vec::new();
        while let Some(event) = queue.pop(&mut Integers) {
            order.push((time(event.tet.0), event.tet.0));
        }
        order
    }

    #[test]
    fn events_come_in_order_of_time_then_of_arrival() {
        let order = sorted_by(FlipQueue::earliest_first());
        assert_eq!(order.len(), 3000);
        assert!(order.is_sorted());
    }

    #[test]
    fn the_latest_come_first_if_asked() {
        let order = sorted_by(FlipQueue::latest_first());
        assert_eq!(order.len(), 3000);
        assert!(order.is_sorted_by(|a, b| b <= a));
    }
}
