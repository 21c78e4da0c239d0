//! From a number type, by name or as a type of the caller's own, to the flips in that type.

use super::compact::{Compact, CompactScratch};
use super::numbers::{FlipNumbers, is_exact};
use super::order::{FlipOrder, NumberTask};
use super::region_view::InMesh;
use super::{
    Deleted, FlipCounts, FlipDeletion, FlipInsertion, FlipObserver, FlipOutcome, Kept,
    PolygonMotion, VertexNumbers,
};
use crate::clock::TaskClock;
use crate::mesh::{Corner, TetId, TetMesh, VertexId};
use crate::predicate::PointStore;
use crate::recover::region::{Region, Side, Sides};
use crate::recover::tables::Table;

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

/// Inserts regions by flips in some order: a [`FlipOrder`], or [`FlipNumbers`] of the caller's own.
pub trait FlipRegion<P> {
    /// Whether the order of flips is the true one.
    fn is_exact(&self) -> bool;

    /// Whether not even orientations are exact.
    fn is_naive(&self) -> bool;

    /// Inserts one region of a polygon.
    fn insert(
        &self,
        mesh: &mut TetMesh,
        sides: &Sides<P>,
        region: &Region,
        scratch: &mut FlipScratch,
        observer: Option<&mut dyn FlipObserver>,
    ) -> Flipped;
}

impl<P: PointStore> FlipRegion<P> for FlipOrder {
    fn is_exact(&self) -> bool {
        FlipOrder::is_exact(*self)
    }

    fn is_naive(&self) -> bool {
        FlipOrder::is_naive(*self)
    }

    fn insert(
        &self,
        mesh: &mut TetMesh,
        sides: &Sides<P>,
        region: &Region,
        scratch: &mut FlipScratch,
        observer: Option<&mut dyn FlipObserver>,
    ) -> Flipped {
        self.run(Job {
            mesh,
            sides,
            region,
            scratch,
            observer: observer.map(|o| o as &mut dyn FlipObserver),
        })
    }
}

impl<P: PointStore, T: FlipNumbers> FlipRegion<P> for T {
    fn is_exact(&self) -> bool {
        is_exact::<T, P>()
    }

    fn is_naive(&self) -> bool {
        T::NAIVE
    }

    fn insert(
        &self,
        mesh: &mut TetMesh,
        sides: &Sides<P>,
        region: &Region,
        scratch: &mut FlipScratch,
        observer: Option<&mut dyn FlipObserver>,
    ) -> Flipped {
        let observer = observer.map(|o| o as &mut dyn FlipObserver);
        let job = Job {
            mesh,
            sides,
            region,
            scratch,
            observer,
        };
        job.with(self)
    }
}

/// Regions of so many tetrahedra are worth a copy.
const COPY: usize = 100;

/// One insertion whose number type is yet to be chosen.
struct Job<'a, P> {
    mesh: &'a mut TetMesh,
    sides: &'a Sides<'a, P>,
    region: &'a Region,
    scratch: &'a mut FlipScratch,
    observer: Option<&'a mut dyn FlipObserver>,
}

impl<P: PointStore> NumberTask for Job<'_, P> {
    type Output = Flipped;

    fn with<T: FlipNumbers>(self, numbers: &T) -> Flipped {
        if T::IN_COPY && self.observer.is_none() && self.region.tets.len() >= COPY {
            return self.insert_in_copy(numbers);
        }
        if !T::NAIVE {
            return self.insert_in_mesh(numbers);
        }
        let view = numbers.view(self.sides.points());
        let job = Job {
            mesh: self.mesh,
            sides: &self.sides.seen_through(&view),
            region: self.region,
            scratch: self.scratch,
            observer: self.observer.map(|o| o as &mut dyn FlipObserver),
        };
        job.insert_in_mesh(numbers)
    }
}

impl<P: PointStore> Job<'_, P> {
    fn insert_in_mesh<T: FlipNumbers>(self, numbers: &T) -> Flipped {
        let sides = self.sides;
        let is_left = |v: VertexId| sides.of(v) == Side::Left;
        let table = std::mem::take(&mut self.scratch.numbers);
        let motion = PolygonMotion::with_numbers(sides.points(), sides.frame, &is_left, table);
        let FlipScratch { marks, clock, .. } = self.scratch;
        let mut region = InMesh::new(sides, &self.region.tets, marks);
        let mut observer = self.observer;
        let times = numbers.times(&motion);
        let insertion = FlipInsertion::new(self.mesh, sides.points(), &mut region, times);
        let reborrowed = observer.as_mut().map(|o| &mut **o as &mut dyn FlipObserver);
        let insertion = insertion.observed_by(reborrowed).timed_by(clock);
        let (outcome, counts) = insertion.insert(self.region.tets.iter().copied());
        let tets = region.tets();
        let crosses = |&&t: &&TetId| sides.crosses_tet(self.mesh, t);
        let outcome = match outcome {
            FlipOutcome::Done => done_but_for(tets.iter().filter(crosses).count()),
            outcome => outcome,
        };
        if let Some(observer) = observer {
            let vertices: Vec<_> = tets.iter().map(|&t| self.mesh.vertices(t)).collect();
            observer.end(outcome, &vertices);
        }
        self.scratch.numbers = motion.into_numbers();
        Flipped {
            outcome,
            tets,
            counts,
        }
    }

    /// The same in a copy of the region.
    fn insert_in_copy<T: FlipNumbers>(self, numbers: &T) -> Flipped {
        let Job {
            mesh,
            sides,
            region,
            scratch,
            ..
        } = self;
        let mut copy = Compact::new(mesh, sides, region, &mut scratch.compact);
        let parts = copy.view;
        let is_left = |v: VertexId| parts.is_left(v);
        let motion = PolygonMotion::of_few(&copy.points, copy.frame, &is_left);
        let tets = copy.tets();
        let times = numbers.times(&motion);
        let mut view = parts;
        let insertion = FlipInsertion::new(&mut copy.mesh, &copy.points, &mut view, times);
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
}

/// The outcome when the queue is empty.
fn done_but_for(crossing: usize) -> FlipOutcome {
    match crossing {
        0 => FlipOutcome::Done,
        crossing => FlipOutcome::Stuck { crossing },
    }
}

/// Deletes the polygon that consists of `faces`, the triangles opposite these corners, by flips backwards in the given
/// order. Only times are rounded, even if the order is a naive one.
pub fn flip_delete<P: PointStore>(
    mesh: &mut TetMesh,
    sides: &Sides<P>,
    faces: &[Corner],
    kept: Kept,
    order: FlipOrder,
    scratch: &mut FlipScratch,
) -> Deleted {
    order.without_naivety().run(DeletionJob {
        mesh,
        sides,
        faces,
        kept,
        scratch,
    })
}

/// One deletion whose number type is yet to be chosen.
struct DeletionJob<'a, P> {
    mesh: &'a mut TetMesh,
    sides: &'a Sides<'a, P>,
    faces: &'a [Corner],
    kept: Kept<'a>,
    scratch: &'a mut FlipScratch,
}

impl<P: PointStore> NumberTask for DeletionJob<'_, P> {
    type Output = Deleted;

    fn with<T: FlipNumbers>(self, numbers: &T) -> Deleted {
        let sides = self.sides;
        let is_left = |v: VertexId| sides.of(v) == Side::Left;
        let table = std::mem::take(&mut self.scratch.numbers);
        let motion = PolygonMotion::with_numbers(sides.points(), sides.frame, &is_left, table);
        let times = numbers.times(&motion);
        let marks = &mut self.scratch.marks;
        let deletion = FlipDeletion::new(self.mesh, sides.points(), self.kept, times, marks);
        let deleted = deletion.delete(self.faces);
        self.scratch.numbers = motion.into_numbers();
        deleted
    }
}
