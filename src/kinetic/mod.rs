//! What all flips in order of time share: a queue of events, the exact order of their times, and rounded orders beside
//! it.
//!
//! The heights of lifted vertices move linearly with the time τ, so that what certifies a simplex as locally convex, a
//! determinant in those heights, is linear, too:
//!
//! > S(τ) = N + τ·D + Σ e_i·ε_i,
//!
//! with infinitesimal weights ε_0 ≫ ε_1 ≫ … of the vertices. Where D > 0, S becomes zero at τ = −N/D (perturbed): that
//! is when the simplex must be flipped, an *event* (in the words of Basch, Guibas & Hershberger 1997: the failure time
//! of a certificate).
//!
//! - [`EventQueue`] gives the events in order. Of times it asks for nothing but a [`TimeOrder`].
//! - [`Motion`] is what an exact order asks of the geometry: N, D and the e_i of an event in numbers of some type.
//! - [`ExactOrder`] compares exact quotients; [`FilteredOrder`] compares float enclosures, and exact quotients where
//!   those overlap; [`RoundedOrder`] compares rounded quotients, as the paper does.
//! - [`AblatedFilter`] is the filtered order without one of its parts.
//!
//! Nothing here knows of tetrahedra, of dimensions, or of what moves. The insertion of polygons
//! ([`crate::recover::flips`]) is one user.

mod ablated;
mod bounded;
mod enclosure;
mod exact;
mod filtered;
mod order;
mod queue;
mod quotient;
mod rounded;
#[cfg(test)]
mod sorting_by_swaps;

pub use ablated::AblatedFilter;
pub use bounded::Bounded;
pub use enclosure::Enclosure;
pub use exact::{ExactOrder, Motion};
pub use filtered::{FilteredOrder, FilteredTime, InQuanta};
pub use order::{TimeOrder, Timed};
pub use queue::EventQueue;
pub use quotient::Quotient;
pub use rounded::{ArrivalOrder, RoundedOrder, TieBreaker, WideOrder};
