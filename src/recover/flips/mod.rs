//! Polygon insertion by bistellar flips (paper §3.2 and Fig. 7; Shewchuk 2003).
//!
//! [`FlipInsertion::insert`] and `certify` are the figure's two procedures, line by line. The order of
//! the queue is that of a [`FlipTimes`]: rounded quotients as in the paper, with the paper's three patches (§3.3), each
//! counted; or exact quotients with the perturbation of the weights, which need no patch.
//!
//! Large regions are flipped in a copy (`compact.rs`) if the times are filtered ones and nobody watches.

mod compact;
mod deletion;
mod event;
mod filter;
mod filtered;
mod motion;
mod moves;
mod queue;
mod room;
mod rounded;
mod run;
mod time;
mod watch;
mod wide;

pub use deletion::{Blocked, Deleted, FlipDeletion, Kept};
pub use event::Event;
pub use filtered::{Enclosure, FilteredTime, FilteredTimes};
pub use motion::{LeftVertices, Motion, VertexNumbers};
pub use moves::{Flip, FlipKind, flip_of_triangle};
pub use queue::FlipQueue;
pub use room::Room;
pub use rounded::RoundedTimes;
pub use run::{FlipScratch, Flipped, flip_delete, flip_insert};
pub use time::{ExactTimes, FlipTimes, Float, Quotient, Timed, Timing, Undecided};
pub use watch::{Fate, Watch};
pub use wide::WideTimes;

use super::side::{Side, Sides, crossing_facets};
use crate::clock::{Task, TaskClock};
use crate::mesh::{Corner, TetId, TetMesh, VertexId};
use crate::number::Sign;
use crate::predicate::PointStore;
use arrayvec::ArrayVec;
use serde::Serialize;

/// What the flips of one or several insertions were.
#[derive(Clone, Copy, Default, PartialEq, Eq, Debug, Serialize)]
pub struct FlipCounts {
    /// 2-to-3 flips.
    pub two_three: u64,
    /// 3-to-2 flips.
    pub three_two: u64,
    /// 4-to-4 flips.
    pub four_four: u64,
    /// Events put on the queue.
    pub queued: u64,
    /// Events whose triangle was gone when they came off the queue.
    pub stale: u64,
    /// Events that came off the queue with both tetrahedra in place, but whose flip was impossible; rounded times only.
    /// They go to the list L (third patch of §3.3).
    pub postponed: u64,
    /// Of those, flips done later from L.
    pub performed_from_list: u64,
    /// Events discarded because their flip would have removed a tetrahedron outside R (first patch).
    pub discarded_outside: u64,
    /// Flips of non-crossing triangles that were not locally Delaunay (second patch).
    pub non_crossing: u64,
    /// Flip times discarded because the rounded quotient was not finite.
    pub overflows: u64,
    /// Comparisons of times in the queue.
    pub comparisons: u64,
    /// Of those, left by float enclosures to exact quotients; filtered times only.
    pub compared_exactly: u64,
    /// Of those, left by equal quotients to the perturbation; exact times only.
    pub ties: u64,
    /// Events whose quotient was computed in exact numbers of any size; exact times only.
    pub big_quotients: u64,
}

impl FlipCounts {
    /// All flips.
    pub fn flips(&self) -> u64 {
        self.two_three + self.three_two + self.four_four
    }

    fn count(&mut self, kind: FlipKind) {
        match kind {
            FlipKind::TwoThree => self.two_three += 1,
            FlipKind::ThreeTwo => self.three_two += 1,
            FlipKind::FourFour => self.four_four += 1,
        }
    }

    /// Notes what the queue and its order have counted.
    fn record<C: FlipTimes>(&mut self, queue: &FlipQueue<C>, times: &C) {
        let undecided = times.undecided();
        self.queued = queue.arrived();
        self.comparisons = queue.comparisons();
        self.compared_exactly = undecided.compared_exactly;
        self.ties = undecided.ties;
        self.big_quotients = undecided.big_quotients;
        self.overflows = undecided.overflows;
    }

    /// Adds the counts of another insertion.
    pub fn add(&mut self, other: &FlipCounts) {
        self.two_three += other.two_three;
        self.three_two += other.three_two;
        self.four_four += other.four_four;
        self.queued += other.queued;
        self.stale += other.stale;
        self.postponed += other.postponed;
        self.performed_from_list += other.performed_from_list;
        self.discarded_outside += other.discarded_outside;
        self.non_crossing += other.non_crossing;
        self.overflows += other.overflows;
        self.comparisons += other.comparisons;
        self.compared_exactly += other.compared_exactly;
        self.ties += other.ties;
        self.big_quotients += other.big_quotients;
    }
}

/// How an insertion ended.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum FlipOutcome {
    /// No crossing tetrahedron is left.
    Done,
    /// The queue is empty, and this many crossing tetrahedra are left.
    Stuck {
        /// Crossing tetrahedra left.
        crossing: usize,
    },
    /// An event came off the exact queue with both tetrahedra in place, but its flip is impossible or would remove a
    /// tetrahedron outside R. With exact times and a flat polygon in an edge-protected PLC this cannot happen.
    Impossible,
    /// Inexact orders only: more flips than any insertion needs.
    Endless,
}

/// The most flips that an insertion into a region of `n` tetrahedra may do in an inexact order. Usually they are fewer
/// than 5n.
fn most_flips(n: usize) -> u64 {
    1000 + 100 * n as u64
}

/// The tetrahedra that a flip created.
type Created = ArrayVec<TetId, 4>;

/// Edges whose flips have been queued in one round of certifications: of at most four tetrahedra.
type Edges = ArrayVec<[VertexId; 3], 16>;

/// How many events ahead of the next one memory is fetched for.
const FAR: usize = 16;

/// A region of so many tetrahedra does not fit into a processor's first cache.
const LARGE: usize = 1000;

/// The insertion of one missing region of a polygon.
pub struct FlipInsertion<'a, P, C: FlipTimes, R> {
    mesh: &'a mut TetMesh,
    points: &'a P,
    /// R, and the sides of f.
    room: &'a mut R,
    times: C,
    queue: FlipQueue<C>,
    /// The list L of §3.3.
    postponed: Vec<Event>,
    counts: FlipCounts,
    /// Whether to fetch from memory ahead of time.
    is_large: bool,
    /// In an inexact order nothing proves that the flips come to an end: all are refused after this many.
    most_flips: u64,
    watch: Option<&'a mut dyn Watch>,
    clock: Option<&'a mut TaskClock>,
}

impl<'a, P: PointStore, C: FlipTimes, R: Room> FlipInsertion<'a, P, C, R> {
    /// Prepares the insertion into a region.
    pub fn new(mesh: &'a mut TetMesh, points: &'a P, room: &'a mut R, times: C) -> Self {
        FlipInsertion {
            mesh,
            points,
            room,
            times,
            queue: FlipQueue::earliest_first(),
            postponed: Vec::new(),
            counts: FlipCounts::default(),
            is_large: false,
            most_flips: u64::MAX,
            watch: None,
            clock: None,
        }
    }

    /// The same, watched.
    pub fn watched_by(mut self, watch: Option<&'a mut dyn Watch>) -> Self {
        self.watch = watch;
        self
    }

    /// The same, with a clock of its tasks.
    pub fn timed_by(mut self, clock: &'a mut TaskClock) -> Self {
        clock.begin();
        self.clock = Some(clock);
        self
    }

    #[inline]
    fn end(&mut self, task: Task) {
        if let Some(clock) = &mut self.clock {
            clock.end(task);
        }
    }

    #[inline]
    fn tell(&mut self, circuit: [VertexId; 5], fate: Fate) {
        if let Some(watch) = &mut self.watch {
            watch.event(circuit, fate);
        }
    }

    /// FlipInsertPolygon of Fig. 7, for R as it is filled by the given tetrahedra. O(n log n) comparisons for n events.
    /// Whatever the outcome, the tetrahedra of the room fill R afterwards; whether crossing ones are left is not looked at.
    pub fn insert(
        mut self,
        tets: impl ExactSizeIterator<Item = TetId>,
    ) -> (FlipOutcome, FlipCounts) {
        self.is_large = tets.len() > LARGE;
        if !C::EXACT {
            self.most_flips = most_flips(tets.len());
        }
        for t in tets {
            self.certify_facets(t, |s, twin| s < twin, &mut Edges::new());
        }
        self.end(Task::Queueing);
        let mut outcome = FlipOutcome::Done;
        while let Some(event) = self.next_event() {
            let Some(s) = event.corner_if_alive(self.mesh) else {
                self.counts.stale += 1;
                self.tell(event.circuit, Fate::Stale);
                continue;
            };
            match self.flip(s, event.signs) {
                Ok((kind, created)) => {
                    self.tell(event.circuit, Fate::Flipped(kind));
                    self.end(Task::Flipping);
                    self.certify_around(&created);
                    self.end(Task::Queueing);
                    if !C::EXACT {
                        self.patch_after_flip(&created);
                    }
                }
                Err(refused) if C::EXACT => {
                    self.tell(event.circuit, refused.fate());
                    outcome = FlipOutcome::Impossible;
                    break;
                }
                Err(Refused::Endless) => break,
                Err(Refused::OutsideRegion) => {
                    self.counts.discarded_outside += 1;
                    self.tell(event.circuit, Fate::OutsideRegion);
                }
                Err(Refused::Impossible) => {
                    self.counts.postponed += 1;
                    self.tell(event.circuit, Fate::Impossible);
                    self.postponed.push(event);
                }
            }
        }
        if self.counts.flips() >= self.most_flips {
            outcome = FlipOutcome::Endless;
        }
        self.counts.record(&self.queue, &self.times);
        (outcome, self.counts)
    }

    /// The next event of the queue. What those after it will look at is fetched meanwhile: each place of the memory once it
    /// is known from the one before.
    #[inline]
    fn next_event(&mut self) -> Option<Event> {
        if self.is_large {
            self.queue.prefetch(FAR);
            if let Some(event) = self.queue.upcoming(FAR * 3 / 4) {
                self.mesh.prefetch(event.tet);
                for v in event.circuit {
                    self.times.prefetch(v);
                }
            }
            if let Some(event) = self.queue.upcoming(FAR / 2) {
                self.mesh.prefetch_neighbors(event.tet);
            }
            if let Some(s) = self
                .queue
                .upcoming(FAR / 4)
                .and_then(|event| event.corner_if_alive(self.mesh))
            {
                for &twin in self.mesh.tet(s.tet()).1 {
                    self.times.prefetch(self.mesh.vertex(twin));
                }
                self.mesh.prefetch_neighbors(self.mesh.neighbor(s));
            }
        }
        self.queue.pop(&mut self.times)
    }

    /// Certify of Fig. 7: queues the crossing triangle opposite corner `s` if it must be flipped at some time.
    ///
    /// In exact order only what is possible now is queued, and a 3-2 or 4-4 flip only once for its edge, `done` being the
    /// edges of this round. Nothing is lost: as long as the star of the edge stays as it is the flip stays impossible, and
    /// when it changes, then by a flip that puts a new tetrahedron at the edge. A triangle between that one and an old
    /// one is then certified; if there is none the whole star is new, and inside of a 2-3 flip, whose circuit has been
    /// flipped already. The paper queues more, and so do we with rounded times.
    fn certify(&mut self, s: Corner, lift: &C::Lift, done: &mut Edges) {
        let (mesh, points) = (&*self.mesh, self.points);
        let circuit = event::circuit(mesh, s);
        let mut edge = None;
        let is_wanted = |signs| {
            let flip = flip_of_triangle(points, mesh, s, signs);
            edge = flip.as_ref().and_then(Flip::edge);
            flip.is_some() && edge.is_none_or(|edge| !done.contains(&edge))
        };
        let Some(timing) = self.times.time_across(lift, circuit, is_wanted) else {
            return;
        };
        done.extend(edge);
        let signs = timing.signs;
        let event = Event {
            circuit,
            tet: s.tet(),
            signs,
        };
        self.queue.push(&mut self.times, event, timing);
    }

    /// Certifies the crossing triangles on the boundary of the flipped volume, now filled by `created`.
    ///
    /// A 4-4 flip is two flips at once, one on each side of the plane of the old and the new edge. The two triangles of
    /// that plane are on the boundary of both, so they are certified, too; forgetting them leaves the queue without the
    /// flips that must come next. (The inner triangles of a 2-3 or 3-2 flip belong to the circuit that has just been
    /// flipped and stay locally convex.)
    fn certify_around(&mut self, created: &[TetId]) {
        let two_flips = created.len() == 4;
        let mut done = Edges::new();
        for &t in created {
            let is_boundary = |s: Corner, twin: Corner| {
                let mut is_inner = false;
                for &t in created {
                    is_inner |= t == twin.tet();
                }
                !is_inner || (two_flips && s < twin)
            };
            self.certify_facets(t, is_boundary, &mut done);
        }
    }

    /// Certifies those crossing triangles of a tetrahedron, between two of R, that are chosen by corner and twin.
    #[inline(always)]
    fn certify_facets(
        &mut self,
        t: TetId,
        is_chosen: impl Fn(Corner, Corner) -> bool,
        done: &mut Edges,
    ) {
        let (vertices, twins) = self.mesh.tet(t);
        let mut chosen = crossing_facets(self.room.left_and_right(vertices));
        for (slot, &twin) in twins.iter().enumerate() {
            let is_chosen = is_chosen(t.corner(slot), twin) && self.room.contains(twin.tet());
            chosen &= !(u8::from(!is_chosen) << slot);
        }
        if chosen == 0 {
            return;
        }
        let lift = self.times.lift(*vertices);
        while chosen != 0 {
            self.certify(t.corner(chosen.trailing_zeros() as usize), &lift, done);
            chosen &= chosen - 1;
        }
    }

    /// Flip of Fig. 7: the flip that removes the triangle opposite corner `s`. Returns the new tetrahedra.
    fn flip(
        &mut self,
        s: Corner,
        signs: [Option<Sign>; 3],
    ) -> Result<(FlipKind, Created), Refused> {
        if self.counts.flips() >= self.most_flips {
            return Err(Refused::Endless);
        }
        let flip = flip_of_triangle(self.points, self.mesh, s, signs).ok_or(Refused::Impossible)?;
        if !flip.old().iter().all(|&t| self.room.contains(t)) {
            return Err(Refused::OutsideRegion);
        }
        let created = flip.perform(self.mesh);
        match flip {
            Flip::TwoThree(..) => {
                self.room.enter(created[2]);
                self.counts.two_three += 1;
            }
            Flip::ThreeTwo([_, _, gone], _) => {
                self.room.leave(gone);
                self.counts.three_two += 1;
            }
            Flip::FourFour(..) => self.counts.four_four += 1,
        }
        Ok((flip.kind(), created))
    }

    /// The second and third patch of §3.3, for rounded times, after a flip that created `created`.
    fn patch_after_flip(&mut self, created: &[TetId]) {
        self.restore_non_crossing(created);
        let mut progress = true;
        while progress {
            progress = false;
            for event in std::mem::take(&mut self.postponed) {
                let Some(s) = event.corner_if_alive(self.mesh) else {
                    self.tell(event.circuit, Fate::DroppedFromList);
                    continue;
                };
                match self.flip(s, event.signs) {
                    Ok((kind, created)) => {
                        self.counts.performed_from_list += 1;
                        self.tell(event.circuit, Fate::FlippedFromList(kind));
                        self.certify_around(&created);
                        self.restore_non_crossing(&created);
                        progress = true;
                    }
                    Err(Refused::OutsideRegion) => {
                        self.counts.discarded_outside += 1;
                        self.tell(event.circuit, Fate::DroppedFromList);
                    }
                    Err(Refused::Impossible) => self.postponed.push(event),
                    Err(Refused::Endless) => {}
                }
            }
        }
    }

    /// The second patch: makes the triangles between non-crossing tetrahedra of R locally Delaunay, starting with those
    /// of `created`. (Lawson's algorithm; it can get stuck, and then leaves the triangle.)
    fn restore_non_crossing(&mut self, created: &[TetId]) {
        if created.iter().all(|&t| self.crosses(t)) {
            return;
        }
        let mut pending: Vec<TetId> = created.to_vec();
        while let Some(t) = pending.pop() {
            if !self.room.contains(t) || self.crosses(t) {
                continue;
            }
            let bad = (0..4)
                .map(|slot| t.corner(slot))
                .find(|&s| self.is_bad_non_crossing(s));
            let Some(s) = bad else { continue };
            let circuit = event::circuit(self.mesh, s);
            if let Ok((kind, created)) = self.flip(s, [None; 3]) {
                self.tell(circuit, Fate::FlippedNonCrossing(kind));
                self.counts.non_crossing += 1;
                self.certify_around(&created);
                pending.extend(created);
            }
        }
    }

    /// Whether both tetrahedra on a triangle are in R and non-crossing, and it is not locally Delaunay.
    fn is_bad_non_crossing(&self, s: Corner) -> bool {
        let n = self.mesh.neighbor(s);
        let facet = self.mesh.facet(s);
        if !self.room.contains(n) || self.crosses(n) || facet.iter().all(|&v| self.room.is_on(v)) {
            return false;
        }
        let circuit = event::circuit(self.mesh, s);
        self.points.insphere(circuit).is_positive()
    }

    /// Whether a tetrahedron of R has vertices on both sides of f.
    fn crosses(&self, t: TetId) -> bool {
        let [left, right] = self.room.left_and_right(&self.mesh.vertices(t));
        left != 0 && right != 0
    }
}

/// Why a triangle was not flipped.
enum Refused {
    /// The tetrahedra around it do not allow it.
    Impossible,
    /// It would remove a tetrahedron outside R.
    OutsideRegion,
    /// There have been too many.
    Endless,
}

impl Refused {
    fn fate(&self) -> Fate {
        match self {
            Refused::Impossible | Refused::Endless => Fate::Impossible,
            Refused::OutsideRegion => Fate::OutsideRegion,
        }
    }
}

/// The faces with all vertices on f that separate a left vertex from the rest: the triangulation of f in the region.
pub fn polygon_faces<P: PointStore>(
    mesh: &TetMesh,
    sides: &Sides<P>,
    region: &[TetId],
) -> Vec<[VertexId; 3]> {
    let mut faces = Vec::new();
    for &t in region {
        let [left, right] = sides.left_and_right(&mesh.vertices(t));
        if left.is_power_of_two() && right == 0 {
            let facet = mesh.facet(t.corner(left.trailing_zeros() as usize));
            if facet.iter().all(|&v| sides.of(v) == Side::On) {
                faces.push(facet);
            }
        }
    }
    faces
}
