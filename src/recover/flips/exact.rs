//! Flip times as exact quotients in any exact number type.

use super::event::{Event, Signs};
use super::filter::Filter;
use super::motion::{Circuits, PolygonMotion};
use super::time::{FlipTime, FlipTimes, Undecided};
use crate::kinetic::{ExactOrder, Quotient};
use crate::mesh::VertexId;
use crate::number::Exact;
use crate::predicate::PointStore;
use std::cmp::Ordering;

/// Times in exact numbers, ties decided by the perturbation of the weights. Floats find most triangles that never flip.
pub struct ExactTimes<'a, P, N> {
    filter: Filter<'a, P>,
    order: ExactOrder<Circuits<'a, P, N>, N, 5>,
}

impl<'a, P: PointStore, N: Exact> ExactTimes<'a, P, N> {
    /// For the given motion.
    pub fn new(motion: &'a PolygonMotion<'a, P>) -> Self {
        ExactTimes {
            filter: Filter::new(motion),
            order: ExactOrder::new(Circuits::new(motion)),
        }
    }

    /// N and D, if D > 0: the sign of D is found in floats if they are certain of it.
    pub fn quotient(&mut self, circuit: [VertexId; 5]) -> Option<Quotient<N>> {
        self.filter.rising(circuit)?;
        self.order.quotient(&Event::of_circuit(circuit))
    }

    /// Which of two events, given by circuit and quotient, comes first: the sign of t_0, then the perturbation.
    pub fn compare_quotients(
        &mut self,
        a: ([VertexId; 5], &Quotient<N>),
        b: ([VertexId; 5], &Quotient<N>),
    ) -> Ordering {
        let (ea, eb) = (Event::of_circuit(a.0), Event::of_circuit(b.0));
        self.order.compare_quotients((&ea, a.1), (&eb, b.1))
    }
}

impl<'a, P: PointStore, N: Exact> FlipTimes for ExactTimes<'a, P, N> {
    type Order = ExactOrder<Circuits<'a, P, N>, N, 5>;
    const EXACT: bool = true;

    #[inline]
    fn order(&mut self) -> &mut Self::Order {
        &mut self.order
    }

    fn time_across(
        &mut self,
        _: [VertexId; 4],
        circuit: [VertexId; 5],
        is_wanted: impl FnOnce(Signs, bool) -> bool,
    ) -> Option<FlipTime<Self::Order>> {
        let rising = self.filter.rising(circuit)?;
        let signs = self.filter.signs(&rising);
        if !is_wanted(signs, true) {
            return None;
        }
        let time = self.order.quotient(&Event::of_circuit(circuit))?;
        Some(FlipTime {
            key: (),
            time,
            signs,
        })
    }

    fn undecided(&self) -> Undecided {
        Undecided {
            ties: self.order.ties,
            one_circuit: self.order.one_circuit,
            big_quotients: self.order.quotients,
            ..Undecided::default()
        }
    }
}
