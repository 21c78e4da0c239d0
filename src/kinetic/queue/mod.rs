//! The priority queue of events, whose order is asked from a [`TimeOrder`], so that a comparison may look at what moves
//! and compute what it needs. What is moved around is keys and the numbers of events; the events stay where they are.
//!
//! Times only go forward, so that the far future need not be in order yet. It is divided into *spans*, each of which
//! begins at the time of some event. When its turn comes, a span is divided further, if it is long, or else sorted:
//! that is a *run*, and the beginning of the next span is the *horizon*. Events queued since that are not after the
//! horizon are put into their places in the run or, while that is long, or keys do not tell about when a time is, into
//! a binary heap.
//!
//! An event is put into a span only if its key says for certain that it comes after the beginning, and the beginnings
//! are in order for certain, so that it also comes after those of all earlier spans; and one leaves the run or the heap
//! only if its key says for certain that it comes before the horizon; else the horizon moves on. So the order is that
//! of one heap.

mod sorting;

use super::order::TimeOrder;
use crate::machine::prefetch;
use std::cmp::Ordering;

/// A span of at most so many events is not divided further.
const SHORT_SPAN: usize = 256;

/// About how many events a span is to have.
const SPAN: usize = 128;

/// Into a run of so many events no further ones are put: that moves what comes after them.
const LONG_RUN: usize = 512;

/// Into how many spans one is divided at most.
const MOST_SPANS: usize = 64;

/// How many keys are looked at for each span to choose where it begins.
const SAMPLES: usize = 4;

/// Events, the earliest first or the latest first.
pub struct EventQueue<O: TimeOrder> {
    heap: Vec<Entry<O::Key>>,
    /// The last comes first.
    run: Vec<Entry<O::Key>>,
    events: Vec<Queued<O::Event, O::Time>>,
    /// Places in `events` to be used again.
    free: Vec<u32>,
    latest_first: bool,
    /// What comes after the run and the heap: the last span comes first.
    spans: Vec<Span<O::Key>>,
    /// How many events have ever been queued.
    arrived: u32,
    comparisons: u64,
    /// Memory for [`EventQueue::distribute`].
    buckets: Vec<u32>,
    sorted: Vec<Entry<O::Key>>,
}

/// Events in the future.
struct Span<K> {
    /// All come after the event with this key, for certain; `None` before any event has been asked for.
    beginning: Option<K>,
    entries: Vec<Entry<K>>,
}

#[derive(Clone, Copy)]
struct Entry<K> {
    key: K,
    event: u32,
}

struct Queued<E, T> {
    event: E,
    time: T,
    /// When it was queued, for ties between rounded times.
    arrival: u32,
}

impl<O: TimeOrder> EventQueue<O> {
    /// An empty queue, which gives the earliest event first: that of an insertion.
    pub fn earliest_first() -> Self {
        EventQueue {
            heap: Vec::new(),
            run: Vec::new(),
            events: Vec::new(),
            free: Vec::new(),
            latest_first: false,
            spans: vec![Span {
                beginning: None,
                entries: Vec::new(),
            }],
            arrived: 0,
            comparisons: 0,
            buckets: Vec::new(),
            sorted: Vec::new(),
        }
    }

    /// An empty queue, which gives the latest event first: that of a deletion.
    pub fn latest_first() -> Self {
        EventQueue {
            latest_first: true,
            ..EventQueue::earliest_first()
        }
    }

    /// Room for so many events at a time without further allocation.
    pub(crate) fn reserve(&mut self, n: usize) {
        self.events.reserve(n);
        if let Some(span) = self.spans.first_mut() {
            span.entries.reserve(n);
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

    /// The event that comes so many places after the first one of those that are in order already, if there are so
    /// many.
    #[inline]
    pub(crate) fn upcoming(&self, places: usize) -> Option<&O::Event> {
        let entry = self.run.get(self.run.len().wrapping_sub(places + 1))?;
        Some(&self.events[entry.event as usize].event)
    }

    /// Lets the processor fetch that event.
    #[inline]
    pub(crate) fn prefetch(&self, places: usize) {
        if let Some(entry) = self.run.get(self.run.len().wrapping_sub(places + 1)) {
            // Both lines of the cache that it may be in.
            prefetch(&self.events, entry.event as usize);
            prefetch(&self.events, entry.event as usize + 1);
        }
    }

    /// Inserts an event. O(log n) comparisons, but as many as there are spans where the event's time is hardly known.
    pub fn push(&mut self, order: &mut O, event: O::Event, key: O::Key, time: O::Time) {
        let queued = Queued {
            event,
            time,
            arrival: self.arrived,
        };
        self.arrived = self.arrived.checked_add(1).expect("fewer than 2^32 events");
        let entry = self.keep(key, queued);
        match self.latest_span_of(key, 0) {
            Some(span) => self.spans[span].entries.push(entry),
            None if self.run.len() < LONG_RUN && O::about(key).is_some() => {
                self.insert_in_run(order, entry);
            }
            None => {
                self.heap.push(entry);
                self.sift_up(order, self.heap.len() - 1, entry);
            }
        }
    }

    /// Puts an entry into its place in the run: where it belongs by what its time is about, unless its neighbours there
    /// say otherwise.
    fn insert_in_run(&mut self, order: &mut O, entry: Entry<O::Key>) {
        let time = self.about(entry.key);
        let is_later = |other: &Entry<O::Key>| self.about(other.key) > time;
        let mut place = self.run.partition_point(is_later);
        let fits = self
            .run
            .get(place)
            .copied()
            .is_none_or(|next| self.precedes(order, next, entry))
            && (place == 0 || self.precedes(order, entry, self.run[place - 1]));
        if !fits {
            let (mut low, mut high) = (0, self.run.len());
            while low < high {
                let middle = (low + high) / 2;
                if self.precedes(order, entry, self.run[middle]) {
                    low = middle + 1;
                } else {
                    high = middle;
                }
            }
            place = low;
        }
        self.run.insert(place, entry);
    }

    /// About when a time is, negated in a queue that gives the latest first. Anything if keys do not tell.
    #[inline(always)]
    fn about(&self, key: O::Key) -> f64 {
        let about = O::about(key).unwrap_or_default();
        if self.latest_first { -about } else { about }
    }

    /// Gives an event a place.
    fn keep(&mut self, key: O::Key, queued: Queued<O::Event, O::Time>) -> Entry<O::Key> {
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
        Entry { key, event: place }
    }

    /// Whether a key comes after (or before, for `Less`) another one for certain.
    #[inline]
    fn is_certain(&mut self, key: O::Key, order: Ordering, other: O::Key) -> bool {
        self.comparisons += 1;
        let order = if self.latest_first {
            order.reverse()
        } else {
            order
        };
        O::compare_keys(key, other) == Some(order)
    }

    /// The latest of the spans from `first` on that a key belongs to for certain.
    #[inline]
    fn latest_span_of(&mut self, key: O::Key, first: usize) -> Option<usize> {
        let time = self.about(key);
        let begins_later = |span: &Span<O::Key>| {
            let beginning = span.beginning;
            beginning.is_some_and(|beginning| self.about(beginning) > time)
        };
        let likely = self.spans[first..].partition_point(begins_later);
        // Any span will do after whose beginning the key comes.
        (first + likely..self.spans.len()).find(|&span| match self.spans[span].beginning {
            None => true,
            Some(beginning) => self.is_certain(key, Ordering::Greater, beginning),
        })
    }

    /// Makes a run of the next span, until the first event of the run and the heap comes before the next one.
    fn move_horizon(&mut self, order: &mut O) {
        while let Some(next) = self.spans.last() {
            // Both, if they are there: which of them is first may take an exact comparison.
            let beginning = next.beginning;
            let (run, heap) = (self.run.last().copied(), self.heap.first().copied());
            if let Some(horizon) = beginning
                && (run.is_some() || heap.is_some())
                && run.is_none_or(|entry| self.is_certain(entry.key, Ordering::Less, horizon))
                && heap.is_none_or(|entry| self.is_certain(entry.key, Ordering::Less, horizon))
            {
                return;
            }
            let next = self.spans.pop().expect("there is one");
            if next.entries.len() <= SHORT_SPAN || !self.divide(&next) {
                self.run.extend(next.entries);
                self.sort_run(order);
            }
        }
    }

    /// Divides a span, if that is possible.
    fn divide(&mut self, span: &Span<O::Key>) -> bool {
        let n = span.entries.len();
        let spans = (n / SPAN).min(MOST_SPANS);
        let samples = span.entries.iter().step_by(n / (SAMPLES * spans));
        let mut samples: Vec<(f64, O::Key)> = samples
            .filter_map(|entry| Some((O::about(entry.key)?, entry.key)))
            .collect();
        samples.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        if self.latest_first {
            samples.reverse();
        }
        // What is in a span must come after the beginnings of all earlier ones, too: they are in order for certain.
        let next = self.spans.last().and_then(|span| span.beginning);
        let mut beginnings: Vec<O::Key> = Vec::new();
        for &(_, key) in samples.iter().skip(SAMPLES / 2).step_by(SAMPLES) {
            let last = beginnings.last().copied();
            if last.is_none_or(|last| self.is_certain(key, Ordering::Greater, last))
                && next.is_none_or(|next| self.is_certain(key, Ordering::Less, next))
            {
                beginnings.push(key);
            }
        }
        let first = self.spans.len();
        let entries = || Vec::with_capacity(SPAN + SPAN / 2);
        self.spans
            .extend(beginnings.into_iter().rev().map(|key| Span {
                beginning: Some(key),
                entries: entries(),
            }));
        let mut rest = Vec::new();
        for &entry in &span.entries {
            match self.latest_span_of(entry.key, first) {
                Some(span) => self.spans[span].entries.push(entry),
                None => rest.push(entry),
            }
        }
        let is_divided = rest.len() < n;
        if is_divided {
            self.spans.push(Span {
                beginning: span.beginning,
                entries: rest,
            });
        } else {
            self.spans.truncate(first);
        }
        is_divided
    }

    /// Removes the first event.
    pub fn pop(&mut self, order: &mut O) -> Option<O::Event> {
        self.move_horizon(order);
        let from_run = match (self.run.last().copied(), self.heap.first().copied()) {
            (None, None) => return None,
            (Some(_), None) => true,
            (None, Some(_)) => false,
            (Some(a), Some(b)) => self.precedes(order, a, b),
        };
        let first = if from_run {
            self.run.pop()
        } else {
            self.pop_heap(order)
        };
        let first = first.expect("one of them is not empty").event;
        self.free.push(first);
        Some(self.events[first as usize].event)
    }

    /// Removes the first event of the heap. About log₂ n comparisons: the hole at the top sinks to a leaf along the
    /// earlier children, and the last event rises from there, usually not far (Floyd's variant; comparisons are what
    /// costs).
    fn pop_heap(&mut self, order: &mut O) -> Option<Entry<O::Key>> {
        let first = self.heap.first().copied()?;
        let last = self.heap.pop().expect("the heap is not empty");
        if !self.heap.is_empty() {
            let hole = self.sink(order);
            self.sift_up(order, hole, last);
        }
        Some(first)
    }

    /// Sinks a hole from the top to a leaf.
    fn sink(&mut self, order: &mut O) -> usize {
        let n = self.heap.len();
        let mut hole = 0;
        loop {
            let (left, right) = (2 * hole + 1, 2 * hole + 2);
            if left >= n {
                return hole;
            }
            let right_first = right < n && self.precedes(order, self.heap[right], self.heap[left]);
            let child = if right_first { right } else { left };
            self.heap[hole] = self.heap[child];
            hole = child;
        }
    }

    /// Puts an entry into a hole or above it.
    fn sift_up(&mut self, order: &mut O, mut hole: usize, entry: Entry<O::Key>) {
        while hole > 0 {
            let parent = (hole - 1) / 2;
            if !self.precedes(order, entry, self.heap[parent]) {
                break;
            }
            self.heap[hole] = self.heap[parent];
            hole = parent;
        }
        self.heap[hole] = entry;
    }

    #[inline]
    fn precedes(&mut self, order: &mut O, a: Entry<O::Key>, b: Entry<O::Key>) -> bool {
        self.comparisons += 1;
        let order = O::compare_keys(a.key, b.key).unwrap_or_else(|| self.compare(order, a, b));
        (order == Ordering::Less) != self.latest_first
    }

    /// Where the keys do not tell. Never `Equal`: in the end the arrival decides.
    #[cold]
    fn compare(&self, order: &mut O, a: Entry<O::Key>, b: Entry<O::Key>) -> Ordering {
        let (a, b) = (
            &self.events[a.event as usize],
            &self.events[b.event as usize],
        );
        order
            .compare((&a.event, &a.time), (&b.event, &b.time))
            .then(a.arrival.cmp(&b.arrival))
    }
}

#[cfg(test)]
mod tests;
