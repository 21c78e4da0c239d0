//! Polygon insertion by bistellar flips (paper §3.2 and Fig. 7; Shewchuk 2003).
//!
//! [`FlipInsertion::insert`] and `certify` are the figure's two procedures, line by line. The order of
//! the queue is that of a [`FlipTimes`]: rounded quotients as in the paper, with the paper's three patches (§3.3), each
//! counted; or exact quotients with the perturbation of the weights, which need no patch. The orders that there are
//! stand in one table, `order.rs`; [`FlipNumbers`] is what one more of the caller's own must do.
//!
//! Large regions are flipped in a copy (`compact.rs`) if the number type asks for it and nobody observes.

mod ablated;
mod adaptive;
mod compact;
mod counts;
mod deletion;
mod event;
mod exact;
mod filter;
mod filtered;
mod motion;
mod moves;
mod numbers;
mod observer;
mod order;
mod patches;
mod region_view;
mod rounded;
mod run;
mod ties;
mod time;
mod wide;

pub use ablated::{AblatedNumbers, NoEnclosures, NoIntegers, NoPerturbation, RoundedKeys};
use counts::most_flips;
pub use counts::{FlipCounts, FlipOutcome};
pub use deletion::{Blocked, Deleted, FlipDeletion, Kept};
use event::Facets;
pub use event::{Event, Signs};
pub use exact::ExactTimes;
pub use filtered::{AblatedOrder, Ablation, FilteredTimes, NoAblation};
pub use motion::{LeftVertices, PolygonMotion, VertexNumbers};
use moves::is_flippable;
pub use moves::{Flip, FlipKind, flip_of_triangle};
pub use numbers::{ExactNumbers, FilteredNumbers, FlipNumbers, RoundedNumbers, WideNumbers};
pub use observer::{Fate, FlipObserver};
pub use order::{Exactness, FlipOrder, NumberTask, NumberType, UnknownOrder};
pub use region_view::RegionView;
pub use rounded::{Evaluation, RoundedTimes};
pub use run::{FlipRegion, FlipScratch, Flipped, flip_delete};
pub use ties::{QueueRule, Rules, TieRule};
pub use time::{FlipTime, FlipTimes, Undecided};
pub use wide::WideTimes;

use crate::clock::{Task, TaskClock};
use crate::kinetic::EventQueue;
use crate::mesh::{Corner, TetId, TetMesh, VertexId};
use crate::predicate::PointStore;
use crate::recover::region::{Side, Sides, crossing_facets};
use arrayvec::ArrayVec;

/// The tetrahedra that a flip created.
type Created = ArrayVec<TetId, 4>;

/// Edges whose flips have been queued in one round of certifications: of at most four tetrahedra.
type Edges = ArrayVec<[VertexId; 3], 16>;

#[inline(always)]
fn is_same([a, b, c]: [VertexId; 3], [p, q, r]: [VertexId; 3]) -> bool {
    (a == p) & (b == q) & (c == r)
}

/// How many events ahead of the next one memory is fetched for.
const FAR: usize = 16;

/// A region of so many tetrahedra does not fit into a processor's second cache.
const LARGE: usize = 10_000;

/// The insertion of one missing region of a polygon.
pub struct FlipInsertion<'a, P, C: FlipTimes, R> {
    mesh: &'a mut TetMesh,
    points: &'a P,
    /// R, and the sides of f.
    region: &'a mut R,
    times: C,
    queue: EventQueue<C::Order>,
    /// The list L of §3.3.
    postponed: Vec<Event>,
    counts: FlipCounts,
    /// Whether to fetch from memory ahead of time.
    is_large: bool,
    /// In an inexact order nothing proves that the flips come to an end: all are refused after this many.
    most_flips: u64,
    observer: Option<&'a mut dyn FlipObserver>,
    clock: Option<&'a mut TaskClock>,
}

impl<'a, P: PointStore, C: FlipTimes, R: RegionView> FlipInsertion<'a, P, C, R> {
    /// Prepares the insertion into a region.
    pub fn new(mesh: &'a mut TetMesh, points: &'a P, region: &'a mut R, times: C) -> Self {
        FlipInsertion {
            mesh,
            points,
            region,
            times,
            queue: EventQueue::earliest_first(),
            postponed: Vec::new(),
            counts: FlipCounts::default(),
            is_large: false,
            most_flips: u64::MAX,
            observer: None,
            clock: None,
        }
    }

    /// The same, observed.
    pub fn observed_by(mut self, observer: Option<&'a mut dyn FlipObserver>) -> Self {
        self.observer = observer;
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
        if let Some(observer) = &mut self.observer {
            observer.event(circuit, fate);
        }
    }

    /// FlipInsertPolygon of Fig. 7, for R as it is filled by the given tetrahedra. O(n log n) comparisons for n events.
    /// Whatever the outcome, the tetrahedra of the view fill R afterwards; whether crossing ones are left is not looked
    /// at.
    pub fn insert(
        mut self,
        tets: impl ExactSizeIterator<Item = TetId>,
    ) -> (FlipOutcome, FlipCounts) {
        self.is_large = tets.len() > LARGE;
        self.queue.reserve(tets.len() + tets.len() / 2);
        if !C::EXACT {
            self.most_flips = most_flips(tets.len());
        }
        for t in tets {
            let mut list = Facets::default();
            self.list_facets(t, self.first_facets(t), &mut list);
            self.certify_all(&list);
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
                Ok((flip, created)) => {
                    self.tell(event.circuit, Fate::Flipped(flip.kind()));
                    self.end(Task::Flipping);
                    self.certify_around(&flip, &created);
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

    /// The next event of the queue. What those after it will look at is fetched meanwhile: each place of the memory
    /// once it is known from the one before.
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
        self.queue.pop(self.times.order())
    }

    /// Certify of Fig. 7: queues the crossing triangle opposite corner `s` if it must be flipped at some time.
    ///
    /// In exact order only what is possible now is queued, and a 3-2 or 4-4 flip only once for its edge, `done` being
    /// the edges of this round. Nothing is lost: as long as the star of the edge stays as it is the flip stays
    /// impossible, and when it changes, then by a flip that puts a new tetrahedron at the edge. A triangle between that
    /// one and an old one is then certified; if there is none the whole star is new, and inside of a 2-3 flip, whose
    /// circuit has been flipped already. The paper queues more, and so do we with rounded times.
    #[inline(always)]
    fn certify(&mut self, s: Corner, done: &mut Edges) {
        let (mesh, points) = (&*self.mesh, self.points);
        let circuit = event::circuit(mesh, s);
        let mut edge = None;
        let is_wanted = |signs: Signs, may_rise: bool| {
            let is_possible = if signs.negative | signs.positive == 0b111 {
                is_flippable(mesh, s, signs.negative)
            } else {
                flip_of_triangle(points, mesh, s, signs).is_some()
            };
            if !(is_possible & may_rise) {
                return false;
            }
            if signs.negative != 0b111 {
                edge = flip_of_triangle(points, mesh, s, signs).and_then(|flip| flip.edge());
            }
            edge.is_none_or(|edge| !done.iter().any(|&other| is_same(edge, other)))
        };
        let tet = *mesh.tet(s.tet()).0;
        let Some(due) = self.times.time_across(tet, circuit, is_wanted) else {
            return;
        };
        if let Some(edge) = edge {
            done.push(edge);
        }
        let event = Event {
            circuit,
            tet: s.tet(),
            signs: due.signs,
        };
        self.queue
            .push(self.times.order(), event, due.key, due.time);
    }

    /// Certifies the crossing triangles on the boundary of the flipped volume, now filled by `created`.
    ///
    /// A 4-4 flip is two flips at once, one on each side of the plane of the old and the new edge. The two triangles of
    /// that plane are on the boundary of both, so they are certified, too; forgetting them leaves the queue without the
    /// flips that must come next. (The inner triangles of a 2-3 or 3-2 flip belong to the circuit that has just been
    /// flipped and stay locally convex.)
    fn certify_around(&mut self, flip: &Flip, created: &[TetId]) {
        let mut list = Facets::default();
        for (&t, mut facets) in created.iter().zip(flip.outer_facets()) {
            if flip.kind() == FlipKind::FourFour {
                facets |= self.first_facets(t);
            }
            self.list_facets(t, facets, &mut list);
        }
        self.certify_all(&list);
    }

    /// Certifies the triangles of a list, one round.
    #[inline(never)]
    fn certify_all(&mut self, list: &Facets) {
        let mut done = Edges::new();
        for &s in list.as_slice() {
            self.certify(s, &mut done);
        }
    }

    /// The facets of a tetrahedron whose corners are less than those on the other side: of each facet, one.
    #[inline(always)]
    fn first_facets(&self, t: TetId) -> u8 {
        let twins = self.mesh.tet(t).1;
        let first = |slot: usize| u8::from(t.corner(slot) < twins[slot]) << slot;
        first(0) | first(1) | first(2) | first(3)
    }

    /// Lists the crossing triangles among some facets of a tetrahedron, but for the boundary of R.
    #[inline(always)]
    fn list_facets(&self, t: TetId, facets: u8, list: &mut Facets) {
        let (vertices, twins) = self.mesh.tet(t);
        let crossing = facets & crossing_facets(self.region.left_and_right(vertices));
        for (slot, twin) in twins.iter().enumerate() {
            let is_crossing = crossing >> slot & 1 == 1;
            list.push_if(
                t.corner(slot),
                is_crossing & self.region.contains(twin.tet()),
            );
        }
    }

    /// Flip of Fig. 7: the flip that removes the triangle opposite corner `s`. Returns the new tetrahedra.
    fn flip(&mut self, s: Corner, signs: Signs) -> Result<(Flip, Created), Refused> {
        if self.counts.flips() >= self.most_flips {
            return Err(Refused::Endless);
        }
        let flip = flip_of_triangle(self.points, self.mesh, s, signs).ok_or(Refused::Impossible)?;
        if !flip.old().iter().all(|&t| self.region.contains(t)) {
            return Err(Refused::OutsideRegion);
        }
        let created = flip.perform(self.mesh);
        match flip {
            Flip::TwoThree(..) => {
                self.region.enter(created[2]);
                self.counts.two_three += 1;
            }
            Flip::ThreeTwo([_, _, gone], _) => {
                self.region.leave(gone);
                self.counts.three_two += 1;
            }
            Flip::FourFour(..) => self.counts.four_four += 1,
        }
        Ok((flip, created))
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
