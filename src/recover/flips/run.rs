//! From the name of a number type to the flips in that type.

use super::compact::{Compact, CompactScratch};
use super::room::InMesh;
use super::{
    Deleted, ExactTimes, FilteredTimes, FlipCounts, FlipDeletion, FlipInsertion, FlipOutcome,
    FlipTimes, Kept, Motion, RoundedTimes, VertexNumbers, Watch, WideTimes,
};
use crate::clock::TaskClock;
use crate::mesh::{Corner, TetId, TetMesh, VertexId};
use crate::number::{Dyadic, Wide, WidthTask};
use crate::predicate::{NaivePoints, PointStore};
use crate::recover::method::Times;
use crate::recover::region::{Region, Side, Sides};
use crate::recover::tables::Table;
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

/// Tables that are kept from region to region.
#[derive(Clone, Debug, Default)]
pub struct FlipScratch {
    marks: Table<bool>,
    numbers: VertexNumbers,
    compact: CompactScratch,
    /// Which task takes how long, if somebody asks.
    pub(in crate::recover) clock: TaskClock,
}

/// Inserts one region of a polygon by flips, ordered by times in the number type `times`.
pub fn flip_insert<P: PointStore>(
    mesh: &mut TetMesh,
    sides: &Sides<P>,
    region: &Region,
    times: Times,
    scratch: &mut FlipScratch,
    watch: Option<&mut dyn Watch>,
) -> Flipped {
    if times == Times::Filtered && watch.is_none() && region.tets.len() >= COMPACT {
        return compact_insert(mesh, sides, region, scratch);
    }
    if times.is_naive() {
        return naive_insert(mesh, sides, region, times, scratch, watch);
    }
    let job = Job {
        mesh,
        sides,
        region,
        scratch,
        watch: watch.map(|w| w as &mut dyn Watch),
    };
    job.run_with(|job, motion| match times {
        Times::F32 => job.run(RoundedTimes::<P, f32>::new(motion)),
        Times::F64 => job.run(RoundedTimes::<P, f64>::new(motion)),
        Times::Wide(bits) => job.run(WideTimes::new(bits, motion)),
        Times::Filtered => job.run(FilteredTimes::new(motion)),
        Times::Exact => job.run(ExactTimes::<P, Dyadic>::new(motion)),
        Times::Rational => job.run(ExactTimes::<P, BigRational>::new(motion)),
        #[cfg(feature = "rug")]
        Times::Rug => job.run(ExactTimes::<P, rug::Rational>::new(motion)),
        Times::Naive | Times::NaiveWide(_) => unreachable!("naive times have been dealt with"),
    })
}

/// All predicates rounded, to doubles or to some number of bits: sides of the plane, convexity of flips, insphere of the
/// second patch, the sign of D.
fn naive_insert<P: PointStore>(
    mesh: &mut TetMesh,
    sides: &Sides<P>,
    region: &Region,
    times: Times,
    scratch: &mut FlipScratch,
    watch: Option<&mut dyn Watch>,
) -> Flipped {
    let bits = match times {
        Times::NaiveWide(bits) => Some(bits),
        _ => None,
    };
    let view = match bits {
        None => NaivePoints::new::<f64>(sides.points()),
        Some(bits) => bits.run(View(sides.points())),
    };
    let job = Job {
        mesh,
        sides: &sides.seen_through(&view),
        region,
        scratch,
        watch: watch.map(|w| w as &mut dyn Watch),
    };
    job.run_with(|job, motion| match bits {
        None => job.run(RoundedTimes::<_, f64>::naive(motion)),
        Some(bits) => job.run(WideTimes::naive(bits, motion)),
    })
}

/// Regions of so many tetrahedra are worth a copy.
const COMPACT: usize = 100;

/// The same as [`Times::Filtered`] in the mesh, in a copy of the region.
fn compact_insert<P: PointStore>(
    mesh: &mut TetMesh,
    sides: &Sides<P>,
    region: &Region,
    scratch: &mut FlipScratch,
) -> Flipped {
    let mut copy = Compact::new(mesh, sides, region, &mut scratch.compact);
    let parts = copy.room;
    let is_left = |v: VertexId| parts.is_left(v);
    let motion = Motion::of_few(&copy.points, copy.frame, &is_left);
    let tets = copy.tets();
    let times = FilteredTimes::new(&motion);
    let mut room = parts;
    let insertion = FlipInsertion::new(&mut copy.mesh, &copy.points, &mut room, times);
    let (outcome, counts) = insertion.timed_by(&mut scratch.clock).insert(tets);
    let outcome = match outcome {
        FlipOutcome::Done => done_but_for(copy.crossing()),
        outcome => outcome,
    };
    Flipped {
        outcome,
        tets: copy.put_back(mesh, region),
        counts,
    }
}

/// The outcome when the queue is empty.
fn done_but_for(crossing: usize) -> FlipOutcome {
    match crossing {
        0 => FlipOutcome::Done,
        crossing => FlipOutcome::Stuck { crossing },
    }
}

/// Deletes the polygon that consists of `faces`, the triangles opposite these corners, by flips backwards, ordered by
/// times in the number type `times`. Only times are rounded, even if the number type is a naive one.
pub fn flip_delete<P: PointStore>(
    mesh: &mut TetMesh,
    sides: &Sides<P>,
    faces: &[Corner],
    kept: Kept,
    times: Times,
    scratch: &mut FlipScratch,
) -> Deleted {
    let is_left = |v: VertexId| sides.of(v) == Side::Left;
    let numbers = std::mem::take(&mut scratch.numbers);
    let motion = Motion::with_numbers(sides.points(), sides.frame, &is_left, numbers);
    let (p, m, marks) = (sides.points(), &motion, &mut scratch.marks);
    let deleted = match times {
        Times::F32 => {
            FlipDeletion::new(mesh, p, kept, RoundedTimes::<P, f32>::new(m), marks).delete(faces)
        }
        Times::F64 | Times::Naive => {
            FlipDeletion::new(mesh, p, kept, RoundedTimes::<P, f64>::new(m), marks).delete(faces)
        }
        Times::Wide(bits) | Times::NaiveWide(bits) => {
            FlipDeletion::new(mesh, p, kept, WideTimes::new(bits, m), marks).delete(faces)
        }
        Times::Filtered => {
            FlipDeletion::new(mesh, p, kept, FilteredTimes::new(m), marks).delete(faces)
        }
        Times::Exact => {
            FlipDeletion::new(mesh, p, kept, ExactTimes::<P, Dyadic>::new(m), marks).delete(faces)
        }
        Times::Rational => {
            FlipDeletion::new(mesh, p, kept, ExactTimes::<P, BigRational>::new(m), marks)
                .delete(faces)
        }
        #[cfg(feature = "rug")]
        Times::Rug => {
            FlipDeletion::new(mesh, p, kept, ExactTimes::<P, rug::Rational>::new(m), marks)
                .delete(faces)
        }
    };
    scratch.numbers = motion.into_numbers();
    deleted
}

/// One insertion whose number type is yet to be chosen.
struct Job<'a, P> {
    mesh: &'a mut TetMesh,
    sides: &'a Sides<'a, P>,
    region: &'a Region,
    scratch: &'a mut FlipScratch,
    watch: Option<&'a mut dyn Watch>,
}

impl<P: PointStore> Job<'_, P> {
    /// Lets `choose` run the job, given what moves.
    fn run_with(self, choose: impl FnOnce(Job<'_, P>, &Motion<'_, P>) -> Flipped) -> Flipped {
        let (sides, numbers) = (self.sides, std::mem::take(&mut self.scratch.numbers));
        let is_left = |v: VertexId| sides.of(v) == Side::Left;
        let motion = Motion::with_numbers(sides.points(), sides.frame, &is_left, numbers);
        let job = Job {
            mesh: self.mesh,
            sides,
            region: self.region,
            scratch: &mut *self.scratch,
            watch: self.watch.map(|w| w as &mut dyn Watch),
        };
        let flipped = choose(job, &motion);
        self.scratch.numbers = motion.into_numbers();
        flipped
    }

    fn run<C: FlipTimes>(self, times: C) -> Flipped {
        let FlipScratch { marks, clock, .. } = self.scratch;
        let (sides, tets) = (self.sides, &self.region.tets);
        let mut room = InMesh::new(sides, tets, marks);
        let mut watch = self.watch;
        let insertion = FlipInsertion::new(self.mesh, sides.points(), &mut room, times);
        let insertion = insertion.watched_by(watch.as_mut().map(|w| &mut **w as &mut dyn Watch));
        let (outcome, counts) = insertion.timed_by(clock).insert(tets.iter().copied());
        let tets = room.tets();
        let crosses = |&&t: &&TetId| sides.crosses_tet(self.mesh, t);
        let outcome = match outcome {
            FlipOutcome::Done => done_but_for(tets.iter().filter(crosses).count()),
            outcome => outcome,
        };
        if let Some(watch) = watch {
            let vertices: Vec<_> = tets.iter().map(|&t| self.mesh.vertices(t)).collect();
            watch.end(outcome, &vertices);
        }
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
