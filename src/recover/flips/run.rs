//! From the name of a number type to the flips in that type.

use super::{
    ExactTimes, FilteredTimes, FlipCounts, FlipInsertion, FlipOutcome, FlipTimes, RoundedTimes,
    Watch,
};
use crate::mesh::{TetId, TetMesh, VertexId};
use crate::number::{Dyadic, Exact, Float, FloatTask};
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
        Times::Wide(bits) => bits.run(Rounded(job)),
        Times::Filtered => job.filtered(),
        Times::Exact => job.exact::<Dyadic>(),
        Times::Rational => job.exact::<BigRational>(),
        #[cfg(feature = "rug")]
        Times::Rug => job.exact::<rug::Rational>(),
        Times::Naive => job.naive::<f64>(),
        Times::NaiveWide(bits) => bits.run(Naive(job)),
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

    /// All predicates rounded: sides of the plane, convexity of flips, insphere of the second patch, the sign of D.
    fn naive<N: Float>(self) -> Flipped {
        let exact = self.sides;
        let view = NaivePoints::<P, N>::new(exact.points());
        let sides = exact.seen_through(&view);
        let is_left = |v: VertexId| sides.of(v) == Side::Left;
        let times = RoundedTimes::<P, N>::naive(exact.points(), exact.frame, &is_left);
        let job = Job {
            mesh: self.mesh,
            sides: &sides,
            region: self.region,
            watch: self.watch.map(|w| w as &mut dyn Watch),
        };
        job.run(times)
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

/// [`Job::rounded`], for a type that is known by its number of bits.
struct Rounded<'a, P>(Job<'a, P>);

impl<P: PointStore> FloatTask for Rounded<'_, P> {
    type Output = Flipped;
    fn with<N: Float>(self) -> Flipped {
        self.0.rounded::<N>()
    }
}

/// [`Job::naive`], for a type that is known by its number of bits.
struct Naive<'a, P>(Job<'a, P>);

impl<P: PointStore> FloatTask for Naive<'_, P> {
    type Output = Flipped;
    fn with<N: Float>(self) -> Flipped {
        self.0.naive::<N>()
    }
}
