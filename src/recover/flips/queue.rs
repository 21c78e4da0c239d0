//! The priority queue of flips: a binary heap whose order is asked from a [`FlipTimes`], so that a comparison may use
//! the point store and compute what it needs.

use super::event::Event;
use super::time::FlipTimes;
use std::cmp::Ordering;

/// Events, the earliest first.
pub struct FlipQueue<T> {
    heap: Vec<Event<T>>,
}

impl<T> Default for FlipQueue<T> {
    fn default() -> Self {
        FlipQueue { heap: Vec::new() }
    }
}

impl<T> FlipQueue<T> {
    /// The number of events.
    pub fn len(&self) -> usize {
        self.heap.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.heap.is_empty()
    }

    /// Inserts an event. O(log n) comparisons.
    pub fn push<C: FlipTimes<Time = T>>(&mut self, times: &mut C, event: Event<T>) {
        self.heap.push(event);
        self.sift_up(times, self.heap.len() - 1);
    }

    /// Removes the earliest event. About log₂ n comparisons: the hole at the top sinks to a leaf along the earlier
    /// children, and the last event rises from there, usually not far (Floyd's variant; comparisons are what costs).
    pub fn pop<C: FlipTimes<Time = T>>(&mut self, times: &mut C) -> Option<Event<T>> {
        if self.heap.is_empty() {
            return None;
        }
        let first = self.heap.swap_remove(0);
        let mut hole = 0;
        loop {
            let (left, right) = (2 * hole + 1, 2 * hole + 2);
            if left >= self.heap.len() {
                break;
            }
            let earlier = if right < self.heap.len() && self.precedes(times, right, left) {
                right
            } else {
                left
            };
            self.heap.swap(hole, earlier);
            hole = earlier;
        }
        if hole < self.heap.len() {
            self.sift_up(times, hole);
        }
        Some(first)
    }

    fn sift_up<C: FlipTimes<Time = T>>(&mut self, times: &mut C, mut child: usize) {
        while child > 0 {
            let parent = (child - 1) / 2;
            if !self.precedes(times, child, parent) {
                break;
            }
            self.heap.swap(child, parent);
            child = parent;
        }
    }

    fn precedes<C: FlipTimes<Time = T>>(&self, times: &mut C, a: usize, b: usize) -> bool {
        let (a, b) = (&self.heap[a], &self.heap[b]);
        match times.compare(a, b) {
            Ordering::Less => true,
            Ordering::Greater => false,
            Ordering::Equal => a.arrival < b.arrival,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::time::Undecided;
    use super::*;
    use crate::mesh::{TetId, VertexId};

    /// Times that are plain integers.
    struct Integers;

    impl FlipTimes for Integers {
        type Time = i32;
        const EXACT: bool = true;
        fn time(&mut self, _: [VertexId; 5]) -> Option<i32> {
            None
        }
        fn compare(&mut self, a: &Event<i32>, b: &Event<i32>) -> Ordering {
            a.time.cmp(&b.time)
        }
        fn undecided(&self) -> Undecided {
            Undecided::default()
        }
    }

    #[test]
    fn events_come_in_order_of_time_then_of_arrival() {
        let mut queue = FlipQueue::default();
        for arrival in 0..200u64 {
            let event = Event {
                circuit: [VertexId(0); 5],
                tet: TetId(0),
                time: (arrival * 37 % 41) as i32,
                arrival,
            };
            queue.push(&mut Integers, event);
        }
        let mut order = Vec::new();
        while let Some(event) = queue.pop(&mut Integers) {
            order.push((event.time, event.arrival));
        }
        assert_eq!(order.len(), 200);
        assert!(order.is_sorted());
    }
}
