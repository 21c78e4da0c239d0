//! Number types of flips as types: what makes the flip times of a region. A caller's own is one more implementation of
//! [`FlipNumbers`], or [`ExactNumbers`] over an own [`Exact`] type, or [`RoundedNumbers`] over an own [`Float`].

use super::exact::ExactTimes;
use super::filtered::FilteredTimes;
use super::motion::PolygonMotion;
use super::rounded::{Evaluation, RoundedTimes};
use super::ties::Rules;
use super::time::FlipTimes;
use super::wide::WideTimes;
use crate::number::{Bits, Exact, Float, Wide, WidthTask};
use crate::predicate::{NaivePoints, PointStore};
use std::marker::PhantomData;

/// A number type of flips.
pub trait FlipNumbers {
    /// The flip times in this type, for vertices in any store.
    type Times<'a, P: PointStore + 'a>: FlipTimes;

    /// Whether large regions are flipped in a copy, which pays if evaluating a time is cheap.
    const IN_COPY: bool = false;

    /// Whether all predicates are rounded while a region is flipped: sides of the plane, convexity of flips, insphere
    /// of the second patch. Then points are seen as [`FlipNumbers::view`] says.
    const NAIVE: bool = false;

    /// Makes the flip times of a region.
    fn times<'a, P: PointStore>(&self, motion: &'a PolygonMotion<'a, P>) -> Self::Times<'a, P>;

    /// How naive numbers see points.
    fn view<'a, P: PointStore>(&self, points: &'a P) -> NaivePoints<'a, P> {
        NaivePoints::new::<f64>(points)
    }
}

/// Whether the order of flips in some numbers is the true one.
pub(super) const fn is_exact<'a, T: FlipNumbers, P: PointStore + 'a>() -> bool {
    <T::Times<'a, P> as FlipTimes>::EXACT
}

/// Exact quotients of an exact type.
pub struct ExactNumbers<N>(PhantomData<N>);

impl<N> Default for ExactNumbers<N> {
    fn default() -> Self {
        ExactNumbers(PhantomData)
    }
}

impl<N: Exact> FlipNumbers for ExactNumbers<N> {
    type Times<'a, P: PointStore + 'a> = ExactTimes<'a, P, N>;

    fn times<'a, P: PointStore>(&self, motion: &'a PolygonMotion<'a, P>) -> Self::Times<'a, P> {
        ExactTimes::new(motion)
    }
}

/// Float enclosures, and dyadic numbers where they overlap.
pub struct FilteredNumbers;

impl FlipNumbers for FilteredNumbers {
    type Times<'a, P: PointStore + 'a> = FilteredTimes<'a, P>;

    const IN_COPY: bool = true;

    fn times<'a, P: PointStore>(&self, motion: &'a PolygonMotion<'a, P>) -> Self::Times<'a, P> {
        FilteredTimes::new(motion)
    }
}

/// Quotients rounded in a float type.
pub struct RoundedNumbers<N> {
    /// How N and D are evaluated.
    pub evaluation: Evaluation,
    /// Which events are queued, and what is done about ties.
    pub rules: Rules,
    numbers: PhantomData<N>,
}

impl<N> RoundedNumbers<N> {
    /// Evaluated and ordered as told.
    pub fn new(evaluation: Evaluation, rules: Rules) -> Self {
        RoundedNumbers {
            evaluation,
            rules,
            numbers: PhantomData,
        }
    }
}

impl<N: Float> FlipNumbers for RoundedNumbers<N> {
    type Times<'a, P: PointStore + 'a> = RoundedTimes<'a, P, N>;

    fn times<'a, P: PointStore>(&self, motion: &'a PolygonMotion<'a, P>) -> Self::Times<'a, P> {
        RoundedTimes::new(motion, self.evaluation, self.rules)
    }
}

/// Quotients rounded to some number of bits.
pub struct WideNumbers {
    /// How many.
    pub bits: Bits,
    /// How N and D are evaluated.
    pub evaluation: Evaluation,
    /// Which events are queued, and what is done about ties.
    pub rules: Rules,
}

impl FlipNumbers for WideNumbers {
    type Times<'a, P: PointStore + 'a> = WideTimes<'a, P>;

    fn times<'a, P: PointStore>(&self, motion: &'a PolygonMotion<'a, P>) -> Self::Times<'a, P> {
        WideTimes::new(self.bits, motion, self.evaluation, self.rules)
    }
}

/// Everything rounded to doubles.
pub struct NaiveNumbers;

impl FlipNumbers for NaiveNumbers {
    type Times<'a, P: PointStore + 'a> = RoundedTimes<'a, P, f64>;

    const NAIVE: bool = true;

    fn times<'a, P: PointStore>(&self, motion: &'a PolygonMotion<'a, P>) -> Self::Times<'a, P> {
        RoundedTimes::new(motion, Evaluation::Naive, Rules::default())
    }
}

/// Everything rounded to some number of bits.
pub struct NaiveWideNumbers(pub Bits);

impl FlipNumbers for NaiveWideNumbers {
    type Times<'a, P: PointStore + 'a> = WideTimes<'a, P>;

    const NAIVE: bool = true;

    fn times<'a, P: PointStore>(&self, motion: &'a PolygonMotion<'a, P>) -> Self::Times<'a, P> {
        WideTimes::new(self.0, motion, Evaluation::Naive, Rules::default())
    }

    fn view<'a, P: PointStore>(&self, points: &'a P) -> NaivePoints<'a, P> {
        self.0.run(View(points))
    }
}

/// Points to be seen through a [`Wide`].
struct View<'a, P>(&'a P);

impl<'a, P: PointStore> WidthTask for View<'a, P> {
    type Output = NaivePoints<'a, P>;

    fn with<const BITS: u32>(self) -> NaivePoints<'a, P> {
        NaivePoints::new::<Wide<BITS>>(self.0)
    }
}
