//! Polygon insertion by bistellar flips (paper §3.2 and Fig. 7; Shewchuk 2003).
//!
//! [`FlipInsertion::insert`] and `certify` are the figure's two procedures, line by line. The order of
//! the queue is that of a [`FlipTimes`]: rounded quotients as in the paper, with the paper's three patches (§3.3), each
//! counted; or exact quotients with the perturbation of the weights, which need no patch.

mod event;
mod filtered;
mod moves;
mod queue;
mod time;
mod watch;

pub use event::Event;
pub use filtered::{FilteredTime, FilteredTimes};
pub use moves::{Flip, FlipKind, flip_of_triangle};
pub use queue::FlipQueue;
pub use time::{
    ExactTimes, FlipTimes, Float, LeftVertices, Quotient, RoundedTimes, Timed, Undecided,
};
pub use watch::{Fate, Watch};

use super::region::Region;
use super::side::{Side, Sides};
use crate::mesh::{Corner, TetId, TetMesh, VertexId};
use crate::predicate::PointStore;
use rustc_hash::FxHashSet;
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
    /// Comparisons that float enclosures left to exact quotients; filtered times only.
    pub compared_exactly: u64,
    /// Comparisons that two equal times left to the perturbation; exact times only.
    pub ties: u64,
}

impl FlipCounts {
    /// All flips.
    pub fn flips(&self) -> u64 {
        self.two_three + self.three_two + self.four_four
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
        self.compared_exactly += other.compared_exactly;
        self.ties += other.ties;
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
}

/// The insertion of one missing region of a polygon.
pub struct FlipInsertion<'a, P, C: FlipTimes> {
    mesh: &'a mut TetMesh,
    sides: &'a Sides<'a, P>,
    times: C,
    queue: FlipQueue<C::Time>,
    /// The tetrahedra that fill R now.
    region: FxHashSet<TetId>,
    /// The list L of §3.3.
    postponed: Vec<Event<C::Time>>,
    counts: FlipCounts,
    watch: Option<&'a mut dyn Watch>,
}

impl<'a, P: PointStore, C: FlipTimes> FlipInsertion<'a, P, C> {
    /// Prepares the insertion into `region`.
    pub fn new(mesh: &'a mut TetMesh, sides: &'a Sides<'a, P>, region: &Region, times: C) -> Self {
        FlipInsertion {
            mesh,
            sides,
            times,
            queue: FlipQueue::default(),
            region: region.tets.iter().copied().collect(),
            postponed: Vec::new(),
            counts: FlipCounts::default(),
            watch: None,
        }
    }

    /// The same, watched.
    pub fn watched_by(mut self, watch: Option<&'a mut dyn Watch>) -> Self {
        self.watch = watch;
        self
    }

    fn tell(&mut self, circuit: [VertexId; 5], fate: Fate) {
        if let Some(watch) = &mut self.watch {
            watch.event(circuit, fate);
        }
    }

    /// FlipInsertPolygon of Fig. 7. O(n log n) comparisons for n events. Returns the tetrahedra that fill R afterwards,
    /// sorted; whatever the outcome, they fill R.
    pub fn insert(mut self, region: &Region) -> (FlipOutcome, Vec<TetId>, FlipCounts) {
        for s in region.crossing_triangles(self.mesh, self.sides) {
            self.certify(s);
        }
        let mut outcome = FlipOutcome::Done;
        while let Some(event) = self.queue.pop(&mut self.times) {
            let Some(s) = event.corner_if_alive(self.mesh) else {
                self.counts.stale += 1;
                self.tell(event.circuit, Fate::Stale);
                continue;
            };
            match self.flip(s) {
                Ok((kind, created)) => {
                    self.tell(event.circuit, Fate::Flipped(kind));
                    self.certify_around(&created);
                    if !C::EXACT {
                        self.patch_after_flip(created);
                    }
                }
                Err(refused) if C::EXACT => {
                    self.tell(event.circuit, refused.fate());
                    outcome = FlipOutcome::Impossible;
                    break;
                }
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
        let mut tets: Vec<TetId> = self.region.into_iter().collect();
        tets.sort_unstable();
        let crossing = tets
            .iter()
            .filter(|&&t| self.sides.crosses_tet(self.mesh, t))
            .count();
        if crossing > 0 && outcome == FlipOutcome::Done {
            outcome = FlipOutcome::Stuck { crossing };
        }
        let undecided = self.times.undecided();
        self.counts.compared_exactly = undecided.compared_exactly;
        self.counts.ties = undecided.ties;
        self.counts.overflows = undecided.overflows;
        if let Some(watch) = self.watch {
            let vertices: Vec<_> = tets.iter().map(|&t| self.mesh.vertices(t)).collect();
            watch.end(outcome, &vertices);
        }
        (outcome, tets, self.counts)
    }

    /// Certify of Fig. 7: queues the crossing triangle opposite corner `s` if it must be flipped at some time.
    fn certify(&mut self, s: Corner) {
        let circuit = event::circuit(self.mesh, s);
        if let Some(time) = self.times.time(circuit) {
            let arrival = self.counts.queued;
            self.counts.queued += 1;
            let event = Event {
                circuit,
                tet: s.tet(),
                time,
                arrival,
            };
            self.queue.push(&mut self.times, event);
        }
    }

    /// Certifies the crossing triangles on the boundary of the flipped volume, now filled by `created`.
    ///
    /// A 4-4 flip is two flips at once, one on each side of the plane of the old and the new edge. The two triangles of
    /// that plane are on the boundary of both, so they are certified, too; forgetting them leaves the queue without the
    /// flips that must come next. (The inner triangles of a 2-3 or 3-2 flip belong to the circuit that has just been
    /// flipped and stay locally convex.)
    fn certify_around(&mut self, created: &[TetId]) {
        let two_flips = created.len() == 4;
        for &t in created {
            for slot in 0..4 {
                let s = t.corner(slot);
                let n = self.mesh.neighbor(s);
                let boundary = !created.contains(&n) || (two_flips && s < self.mesh.twin(s));
                if boundary && self.region.contains(&n) && self.sides.crosses(&self.mesh.facet(s)) {
                    self.certify(s);
                }
            }
        }
    }

    /// Flip of Fig. 7: the flip that removes the triangle opposite corner `s`. Returns the new tetrahedra.
    fn flip(&mut self, s: Corner) -> Result<(FlipKind, Vec<TetId>), Refused> {
        let flip =
            flip_of_triangle(self.sides.points(), self.mesh, s).ok_or(Refused::Impossible)?;
        if !flip.old.iter().all(|t| self.region.contains(t)) {
            return Err(Refused::OutsideRegion);
        }
        for t in &flip.old {
            self.region.remove(t);
        }
        let created = self.mesh.replace(&flip.old, &flip.new);
        self.region.extend(&created);
        match flip.kind {
            FlipKind::TwoThree => self.counts.two_three += 1,
            FlipKind::ThreeTwo => self.counts.three_two += 1,
            FlipKind::FourFour => self.counts.four_four += 1,
        }
        Ok((flip.kind, created))
    }

    /// The second and third patch of §3.3, for rounded times, after a flip that created `created`.
    fn patch_after_flip(&mut self, created: Vec<TetId>) {
        self.restore_non_crossing(created);
        let mut progress = true;
        while progress {
            progress = false;
            for event in std::mem::take(&mut self.postponed) {
                let Some(s) = event.corner_if_alive(self.mesh) else {
                    self.tell(event.circuit, Fate::DroppedFromList);
                    continue;
                };
                match self.flip(s) {
                    Ok((kind, created)) => {
                        self.counts.performed_from_list += 1;
                        self.tell(event.circuit, Fate::FlippedFromList(kind));
                        self.certify_around(&created);
                        self.restore_non_crossing(created);
                        progress = true;
                    }
                    Err(Refused::OutsideRegion) => {
                        self.counts.discarded_outside += 1;
                        self.tell(event.circuit, Fate::DroppedFromList);
                    }
                    Err(Refused::Impossible) => self.postponed.push(event),
                }
            }
        }
    }

    /// The second patch: makes the triangles between non-crossing tetrahedra of R locally Delaunay, starting with those
    /// of `created`. (Lawson's algorithm; it can get stuck, and then leaves the triangle.)
    fn restore_non_crossing(&mut self, created: Vec<TetId>) {
        let mut pending = created;
        while let Some(t) = pending.pop() {
            if !self.region.contains(&t) || self.sides.crosses_tet(self.mesh, t) {
                continue;
            }
            let bad = (0..4)
                .map(|slot| t.corner(slot))
                .find(|&s| self.is_bad_non_crossing(s));
            let Some(s) = bad else { continue };
            let circuit = event::circuit(self.mesh, s);
            if let Ok((kind, created)) = self.flip(s) {
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
        if !self.region.contains(&n)
            || self.sides.crosses_tet(self.mesh, n)
            || facet.iter().all(|&v| self.sides.of(v) == Side::On)
        {
            return false;
        }
        let [v, x, y, z, w] = event::circuit(self.mesh, s);
        self.sides.points().insphere([v, x, y, z, w]).is_positive()
    }
}

/// Why a triangle was not flipped.
enum Refused {
    /// The tetrahedra around it do not allow it.
    Impossible,
    /// It would remove a tetrahedron outside R.
    OutsideRegion,
}

impl Refused {
    fn fate(&self) -> Fate {
        match self {
            Refused::Impossible => Fate::Impossible,
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
    let corners = region
        .iter()
        .flat_map(|&t| (0..4).map(move |slot| t.corner(slot)));
    corners
        .filter(|&c| sides.of(mesh.vertex(c)) == Side::Left)
        .map(|c| mesh.facet(c))
        .filter(|facet| facet.iter().all(|&v| sides.of(v) == Side::On))
        .collect()
}
