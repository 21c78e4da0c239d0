//! Rounded times whose number of mantissa bits is known only at run time. A time of any width is kept as its exact value,
//! so that the insertion is compiled once, and only the polynomials for every width.

use super::event::Event;
use super::time::{FlipTimes, LeftVertices, RoundedTimes, Undecided};
use crate::mesh::VertexId;
use crate::number::{Bits, Dyadic, Wide, WidthTask};
use crate::predicate::PointStore;
use std::cmp::Ordering;

/// [`RoundedTimes`] in a [`Wide`] of some number of bits.
pub struct WideTimes<'a>(Box<dyn AnyWidth + 'a>);

/// [`FlipTimes`] without the type of its times.
trait AnyWidth {
    fn time(&mut self, circuit: [VertexId; 5]) -> Option<Dyadic>;
    fn undecided(&self) -> Undecided;
}

impl<P: PointStore, const BITS: u32> AnyWidth for RoundedTimes<'_, P, Wide<BITS>> {
    fn time(&mut self, circuit: [VertexId; 5]) -> Option<Dyadic> {
        FlipTimes::time(self, circuit).map(Wide::into_value)
    }

    fn undecided(&self) -> Undecided {
        FlipTimes::undecided(self)
    }
}

impl<'a> WideTimes<'a> {
    /// [`RoundedTimes::new`].
    pub fn new<P: PointStore>(
        bits: Bits,
        points: &'a P,
        frame: [VertexId; 3],
        is_left: LeftVertices<'a>,
    ) -> Self {
        WideTimes(bits.run(Make {
            points,
            frame,
            is_left,
            naive: false,
        }))
    }

    /// [`RoundedTimes::naive`].
    pub fn naive<P: PointStore>(
        bits: Bits,
        points: &'a P,
        frame: [VertexId; 3],
        is_left: LeftVertices<'a>,
    ) -> Self {
        WideTimes(bits.run(Make {
            points,
            frame,
            is_left,
            naive: true,
        }))
    }
}

struct Make<'a, P> {
    points: &'a P,
    frame: [VertexId; 3],
    is_left: LeftVertices<'a>,
    naive: bool,
}

impl<'a, P: PointStore> WidthTask for Make<'a, P> {
    type Output = Box<dyn AnyWidth + 'a>;

    fn with<const BITS: u32>(self) -> Self::Output {
        let (points, frame, is_left) = (self.points, self.frame, self.is_left);
        Box::new(if self.naive {
            RoundedTimes::<P, Wide<BITS>>::naive(points, frame, is_left)
        } else {
            RoundedTimes::<P, Wide<BITS>>::new(points, frame, is_left)
        })
    }
}

impl FlipTimes for WideTimes<'_> {
    type Time = Dyadic;
    const EXACT: bool = false;

    fn time(&mut self, circuit: [VertexId; 5]) -> Option<Dyadic> {
        self.0.time(circuit)
    }

    fn compare(&mut self, a: &Event<Dyadic>, b: &Event<Dyadic>) -> Ordering {
        a.time.cmp(&b.time)
    }

    fn undecided(&self) -> Undecided {
        self.0.undecided()
    }
}
