//! Rounded times whose number of mantissa bits is known only at run time. A time of any width is kept as its exact value,
//! so that the insertion is compiled once, and only the polynomials for every width.

use super::event::Signs;
use super::motion::Motion;
use super::rounded::RoundedTimes;
use super::time::{FlipTimes, Timed, Timing, Undecided};
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
        FlipTimes::time(self, circuit).map(|timing| timing.time.into_value())
    }

    fn undecided(&self) -> Undecided {
        FlipTimes::undecided(self)
    }
}

impl<'a> WideTimes<'a> {
    /// [`RoundedTimes::new`].
    pub fn new<P: PointStore>(bits: Bits, motion: &'a Motion<'a, P>) -> Self {
        let naive = false;
        WideTimes(bits.run(Make { motion, naive }))
    }

    /// [`RoundedTimes::naive`].
    pub fn naive<P: PointStore>(bits: Bits, motion: &'a Motion<'a, P>) -> Self {
        let naive = true;
        WideTimes(bits.run(Make { motion, naive }))
    }
}

struct Make<'a, P> {
    motion: &'a Motion<'a, P>,
    naive: bool,
}

impl<'a, P: PointStore> WidthTask for Make<'a, P> {
    type Output = Box<dyn AnyWidth + 'a>;

    fn with<const BITS: u32>(self) -> Self::Output {
        Box::new(if self.naive {
            RoundedTimes::<P, Wide<BITS>>::naive(self.motion)
        } else {
            RoundedTimes::<P, Wide<BITS>>::new(self.motion)
        })
    }
}

impl FlipTimes for WideTimes<'_> {
    /// Doubles would not tell times of more bits, or with larger exponents, apart.
    type Key = ();
    type Time = Dyadic;
    const EXACT: bool = false;

    fn time_across(
        &mut self,
        _: [VertexId; 4],
        circuit: [VertexId; 5],
        _: impl FnOnce(Signs, bool) -> bool,
    ) -> Option<Timing<(), Dyadic>> {
        self.0.time(circuit).map(|time| Timing {
            key: (),
            time,
            signs: Signs::UNKNOWN,
        })
    }

    fn about((): ()) -> Option<f64> {
        None
    }

    fn compare_keys((): (), (): ()) -> Option<Ordering> {
        None
    }

    fn compare(&mut self, a: Timed<Dyadic>, b: Timed<Dyadic>) -> Ordering {
        a.1.cmp(b.1)
    }

    fn undecided(&self) -> Undecided {
        self.0.undecided()
    }
}
