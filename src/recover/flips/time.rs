//! When a crossing triangle must be flipped (paper, Equation (1)), in any number type.
//!
//! # The lifted determinant as a function of time
//! While f is inserted the heights of the left vertices grow, h_v(τ) = |v|² + τ·d_v with d_v = orient3d(frame, v) for a
//! left vertex and d_v = 0 for every other one, also for vertices of f that are not exactly on its plane. For the two
//! tetrahedra vxyz and wxzy of a triangle xyz, with the circuit's coefficients c of (v, x, y, z, w)
//! ([`formula`](crate::predicate::formula)),
//!
//! > S(τ) = N + τ·D,  N = insphere(v,x,y,z,w) = −Σ c_i|p_i − w|²,  D = −Σ c_i·d_i,
//!
//! is negative while the lifted triangle is locally convex. It is at τ = 0; if D ≤ 0 it stays so for ever (Fig. 7, line
//! 11); else it must be flipped at τ = −N/D (line 12).
//!
//! Under the weights ε_v, N becomes N + Σ ε_v c_v, and D is free of ε: what [`crate::kinetic`] needs for an exact
//! order. There, t_0 is of degree 11 in the coordinates and t_v of degree 9. If all terms of two events vanish then
//! their circuits are the same up to a factor, which happens only for two triangles of one 4-to-4 flip: they are one
//! event.

use super::event::{Event, Signs};
use crate::kinetic::TimeOrder;
use crate::mesh::VertexId;

/// A way to compute flip times, and the order in which they come.
pub trait FlipTimes {
    /// The order of the times.
    type Order: TimeOrder<Event = Event>;

    /// Whether the order is the true one, so that the patches of §3.3 are neither needed nor applied.
    const EXACT: bool;

    /// The order, for comparisons.
    fn order(&mut self) -> &mut Self::Order;

    /// The time at which the triangle xyz between vxyz and wxzy must be flipped; `None` if it never must, or if the
    /// number type cannot hold the time.
    fn time(&mut self, circuit: [VertexId; 5]) -> Option<FlipTime<Self::Order>> {
        let [v, x, y, z, _] = circuit;
        self.time_across([v, x, y, z], circuit, |_, may_rise| may_rise)
    }

    /// The same for a triangle of the given tetrahedron, vxyz up to an even permutation, on which rounding may depend.
    /// Exact orders ask, before they compute the quotient, whether the time is of interest, given the signs of c_x,
    /// c_y, c_z where they are known, and whether D may be positive: if not, the answer must be `false`. (One question
    /// for both, because neither answer can be foretold, and a branch that is foretold wrongly takes as long as much of
    /// the evaluation.)
    fn time_across(
        &mut self,
        tet: [VertexId; 4],
        circuit: [VertexId; 5],
        is_wanted: impl FnOnce(Signs, bool) -> bool,
    ) -> Option<FlipTime<Self::Order>>;

    /// Lets the processor fetch what is known of a vertex that will be lifted soon.
    fn prefetch(&self, v: VertexId) {
        let _ = v;
    }

    /// What the number type did not decide by itself.
    fn undecided(&self) -> Undecided;
}

/// When a triangle must be flipped.
pub struct FlipTime<O: TimeOrder> {
    /// For most comparisons.
    pub key: O::Key,
    /// For the others.
    pub time: O::Time,
    /// The signs of the circuit's coefficients c_x, c_y, c_z, where they are known.
    pub signs: Signs,
}

/// Counts of what a number type did not decide by itself.
#[derive(Clone, Copy, Default, Debug)]
pub struct Undecided {
    /// Comparisons that float enclosures left to exact quotients.
    pub compared_exactly: u64,
    /// Comparisons that exact quotients left to the perturbation.
    pub ties: u64,
    /// Of those, comparisons of two events of one circuit, which are one.
    pub one_circuit: u64,
    /// Events whose exact quotient had to be computed in numbers of any size.
    pub big_quotients: u64,
    /// Times discarded because a rounded quotient was not finite.
    pub overflows: u64,
}
