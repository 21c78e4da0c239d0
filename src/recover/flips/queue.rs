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
        let mut child = self.heap.len() - 1;
        while child > 0 {
            let parent = (child - 1) / 2;
            if !self.precedes(times, child, parent) {
                break;
            }
            self.heap.swap(child, parent);
            child = parent;
        }
    }

    /// Removes the earliest event. O(log n) comparisons.
    pub fn pop<C: FlipTimes<Time = T>>(&mut self, times: &mut C) -> Option<Event<T>> {
        if self.heap.is_empty() {
            return None;
        }
        let first = self.heap.swap_remove(0);
        let mut parent = 0;
        loop {
            let children = [2 * parent + 1, 2 * parent + 2];
            let mut least = parent;
            for child in children
                .into_iter()
                .filter(|&child| child < self.heap.len())
            {
                if self.precedes(times, child, least) {
                    least = child;
                }
            }
            if least == parent {
                return Some(first);
            }
            self.heap.swap(parent, least);
            parent = least;
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
