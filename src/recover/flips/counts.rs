//! What insertions by flips report: counts, and how they ended.

use super::{FlipKind, FlipTimes};
use crate::kinetic::EventQueue;
use serde::Serialize;

/// What the flips of one or several insertions were.
#[derive(Clone, Copy, Default, PartialEq, Eq, Debug, Serialize)]
pub struct FlipCounts {
    /// 2-to-3 flips.
    pub two_three: u64,
    /// 3-to-2 flips.
    pub three_two: u64,
    /// 4-to-4 flips.
    pub four_four: u64,
    /// Events put on the queue.
    pub queued: u64,
    /// Events whose triangle was gone when they came off the queue.
    pub stale: u64,
    /// Events that came off the queue with both tetrahedra in place, but whose flip was impossible; rounded times only.
    /// They go to the list L (third patch of §3.3).
    pub postponed: u64,
    /// Of those, flips done later from L.
    pub performed_from_list: u64,
    /// Events discarded because their flip would have removed a tetrahedron outside R (first patch).
    pub discarded_outside: u64,
    /// Flips of non-crossing triangles that were not locally Delaunay (second patch).
    pub non_crossing: u64,
    /// Flip times discarded because the rounded quotient was not finite.
    pub overflows: u64,
    /// Comparisons of times in the queue.
    pub comparisons: u64,
    /// Of those, left by float enclosures to exact quotients; filtered times only.
    pub compared_exactly: u64,
    /// Of those, left by equal quotients to the perturbation; exact times only.
    pub ties: u64,
    /// Of those, comparisons of two events of one circuit, which need no perturbation.
    pub one_circuit: u64,
    /// Events whose quotient was computed in exact numbers of any size; exact times only.
    pub big_quotients: u64,
}

impl FlipCounts {
    /// All flips.
    pub fn flips(&self) -> u64 {
        self.two_three + self.three_two + self.four_four
    }

    pub(super) fn count(&mut self, kind: FlipKind) {
        match kind {
            FlipKind::TwoThree => self.two_three += 1,
            FlipKind::ThreeTwo => self.three_two += 1,
            FlipKind::FourFour => self.four_four += 1,
        }
    }

    /// Notes what the queue and its order have counted.
    pub(super) fn record<C: FlipTimes>(&mut self, queue: &EventQueue<C::Order>, times: &C) {
        let undecided = times.undecided();
        self.queued = queue.arrived();
        self.comparisons = queue.comparisons();
        self.compared_exactly = undecided.compared_exactly;
        self.ties = undecided.ties;
        self.one_circuit = undecided.one_circuit;
        self.big_quotients = undecided.big_quotients;
        self.overflows = undecided.overflows;
    }

    /// Adds the counts of another insertion.
    pub fn add(&mut self, other: &FlipCounts) {
        self.two_three += other.two_three;
        self.three_two += other.three_two;
        self.four_four += other.four_four;
        self.queued += other.queued;
        self.stale += other.stale;
        self.postponed += other.postponed;
        self.performed_from_list += other.performed_from_list;
        self.discarded_outside += other.discarded_outside;
        self.non_crossing += other.non_crossing;
        self.overflows += other.overflows;
        self.comparisons += other.comparisons;
        self.compared_exactly += other.compared_exactly;
        self.ties += other.ties;
        self.one_circuit += other.one_circuit;
        self.big_quotients += other.big_quotients;
    }
}

/// How an insertion ended.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum FlipOutcome {
    /// No crossing tetrahedron is left.
    Done,
    /// The queue is empty, and this many crossing tetrahedra are left.
    Stuck {
        /// Crossing tetrahedra left.
        crossing: usize,
    },
    /// An event came off the exact queue with both tetrahedra in place, but its flip is impossible or would remove a
    /// tetrahedron outside R. With exact times and a flat polygon in an edge-protected PLC this cannot happen.
    Impossible,
    /// Inexact orders only: more flips than any insertion needs.
    Endless,
}

/// The most flips that an insertion into a region of `n` tetrahedra may do in an inexact order. Usually they are fewer
/// than 5n.
pub(super) fn most_flips(n: usize) -> u64 {
    1000 + 100 * n as u64
}
