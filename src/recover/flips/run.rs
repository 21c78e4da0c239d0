//! From the name of a number type to the flips in that type.

use super::{
    ExactTimes, FilteredTimes, FlipCounts, FlipInsertion, FlipOutcome, FlipTimes, RoundedTimes,
    Watch, WideTimes,
};
use crate::mesh::{TetId, TetMesh, VertexId};
use crate::number::{Bits, Dyadic, Exact, Float, Wide, WidthTask};
use crate::predicate::{NaivePoints, PointStore};
use crate::recover::method::Times;
use crate::recover::region::Region;
use crate::recover::side::{Side, Sides};
use num_rational::BigRational;

/// How the insertion of one region ended.
#[derive(Clone, Debug)]
pub struct Flipped {
    /// As far as the number type can tell.
    pub outcome: FlipOutcome,
    /// The tetrahedra that are in the place of R now, sorted.
    pub tets: Vec<TetId>,
    /// What was done.
    pub counts: FlipCounts,
}

/// Inserts one region of a polygon by flips, ordered by times in the number type `times`.
pub fn flip_insert<P: PointStore>(
    mesh: &mut TetMesh,
    sides: &Sides<P>,
    region: &Region,
    times: Times,
    watch: Option<&mut dyn Watch>,
) -> Flipped {
    let job = Job {
        mesh,
        sides,
        region,
        watch: watch.map(|w| w as &mut dyn Watch),
    };
    match times {
        Times::F32 => job.rounded::<f32>(),
        Times::F64 => job.rounded::<f64>(),
        Times::Wide(bits) => job.wide(bits),
        Times::Filtered => job.filtered(),
        Times::Exact => job.exact::<Dyadic>(),
        Times::Rational => job.exact::<BigRational>(),
        #[cfg(feature = "rug")]
        Times::Rug => job.exact::<rug::Rational>(),
        Times::Naive => job.naive(None),
        Times::NaiveWide(bits) => job.naive(Some(bits)),
    }
}

/// One insertion whose number type is yet to be chosen.
struct Job<'a, P> {
    mesh: &'a mut TetMesh,
    sides: &'a Sides<'a, P>,
    region: &'a Region,
    watch: Option<&'a mut dyn Watch>,
}

impl<P: PointStore> Job<'_, P> {
    fn rounded<N: Float>(self) -> Flipped {
        let (points, frame) = (self.sides.points(), self.sides.frame);
        let is_left = |v: VertexId| self.sides.of(v) == Side::Left;
        self.run(RoundedTimes::<P, N>::new(points, frame, &is_left))
    }

    fn wide(self, bits: Bits) -> Flipped {
        let (points, frame) = (self.sides.points(), self.sides.frame);
        let is_left = |v: VertexId| self.sides.of(v) == Side::Left;
        self.run(WideTimes::new(bits, points, frame, &is_left))
    }

    fn exact<N: Exact>(self) -> Flipped {
        let (points, frame) = (self.sides.points(), self.sides.frame);
        let is_left = |v: VertexId| self.sides.of(v) == Side::Left;
        self.run(ExactTimes::<P, N>::new(points, frame, &is_left))
    }

    fn filtered(self) -> Flipped {
        let (points, frame) = (self.sides.points(), self.sides.frame);
        let is_left = |v: VertexId| self.sides.of(v) == Side::Left;
        self.run(FilteredTimes::new(points, frame, &is_left))
    }

    /// All predicates rounded, to doubles or to some number of bits: sides of the plane, convexity of flips, insphere of
    /// the second patch, the sign of D.
    fn naive(self, bits: Option<Bits>) -> Flipped {
        let (points, frame) = (self.sides.points(), self.sides.frame);
        let view = match bits {
            None => NaivePoints::new::<f64>(points),
            Some(bits) => bits.run(View(points)),
        };
        let sides = self.sides.seen_through(&view);
        let is_left = |v: VertexId| sides.of(v) == Side::Left;
        let job = Job {
            mesh: self.mesh,
            sides: &sides,
            region: self.region,
            watch: self.watch.map(|w| w as &mut dyn Watch),
        };
        match bits {
            None => job.run(RoundedTimes::<P, f64>::naive(points, frame, &is_left)),
            Some(bits) => job.run(WideTimes::naive(bits, points, frame, &is_left)),
        }
    }

    fn run<C: FlipTimes>(self, times: C) -> Flipped {
        let (outcome, tets, counts) = FlipInsertion::new(self.mesh, self.sides, self.region, times)
            .watched_by(self.watch.map(|w| w as &mut dyn Watch))
            .insert(self.region);
        Flipped {
            outcome,
            tets,
            counts,
        }
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
