//! Rounded times whose number of mantissa bits is known only at run time. A time of any width is kept as its exact
//! value, so that the insertion is compiled once, and only the polynomials for every width.

use super::event::Signs;
use super::motion::PolygonMotion;
use super::rounded::{Evaluation, RoundedTimes};
use super::ties::{FlipTies, QueueRule, Rules};
use super::time::{FlipTime, FlipTimes, Undecided};
use crate::kinetic::WideOrder;
use crate::mesh::VertexId;
use crate::number::{Bits, Dyadic, Wide, WidthTask};
use crate::predicate::PointStore;

/// [`RoundedTimes`] in a [`Wide`] of some number of bits.
pub struct WideTimes<'a, P> {
    times: Box<dyn AnyWidth + 'a>,
    queue: QueueRule,
    order: WideOrder<FlipTies<'a, P, Dyadic>>,
}

/// [`FlipTimes`] without the type of its times.
trait AnyWidth {
    fn time(&mut self, circuit: [VertexId; 5]) -> Option<Dyadic>;
    fn undecided(&self) -> Undecided;
}

impl<P: PointStore, const BITS: u32> AnyWidth for RoundedTimes<'_, P, Wide<BITS>> {
    fn time(&mut self, circuit: [VertexId; 5]) -> Option<Dyadic> {
        FlipTimes::time(self, circuit).map(|timing| timing.time.into_value())
    }

    fn undecided(&self) -> Undecided {
        FlipTimes::undecided(self)
    }
}

impl<'a, P: PointStore> WideTimes<'a, P> {
    /// [`RoundedTimes::new`].
    pub fn new(
        bits: Bits,
        motion: &'a PolygonMotion<'a, P>,
        evaluation: Evaluation,
        Rules { ties, queue }: Rules,
    ) -> Self {
        WideTimes {
            times: bits.run(Make { motion, evaluation }),
            queue,
            order: WideOrder {
                ties: FlipTies::new(ties, motion),
            },
        }
    }
}

struct Make<'a, P> {
    motion: &'a PolygonMotion<'a, P>,
    evaluation: Evaluation,
}

impl<'a, P: PointStore> WidthTask for Make<'a, P> {
    type Output = Box<dyn AnyWidth + 'a>;

    fn with<const BITS: u32>(self) -> Self::Output {
        // The rules are kept outside.
        let times =
            RoundedTimes::<P, Wide<BITS>>::new(self.motion, self.evaluation, Rules::default());
        Box::new(times)
    }
}

impl<'a, P: PointStore> FlipTimes for WideTimes<'a, P> {
    type Order = WideOrder<FlipTies<'a, P, Dyadic>>;
    const EXACT: bool = false;

    fn order(&mut self) -> &mut Self::Order {
        &mut self.order
    }

    fn time_across(
        &mut self,
        _: [VertexId; 4],
        circuit: [VertexId; 5],
        is_wanted: impl FnOnce(Signs, bool) -> bool,
    ) -> Option<FlipTime<Self::Order>> {
        let time = self.times.time(circuit)?;
        if !self.queue.admits(is_wanted) {
            return None;
        }
        Some(FlipTime {
            key: (),
            time: self.order.ties.settled(circuit, time),
            signs: Signs::UNKNOWN,
        })
    }

    fn undecided(&self) -> Undecided {
        self.times.undecided()
    }
}
