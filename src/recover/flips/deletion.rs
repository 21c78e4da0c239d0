//! Polygon deletion by bistellar flips: insertion with time running backwards (Shewchuk 2003, "Updating and
//! constructing constrained Delaunay and constrained regular triangulations by flips"; the proofs are in
//! `paper/theory.tex`, section "Deletion").
//!
//! Under the heights of [`time`](super::time) the CDT with f is right for all large τ, and the CDT without f at τ = 0.
//! On the way back a triangle that is no constraint must be flipped iff it is not locally Delaunay at 0, so N > 0
//! (perturbed); then D < 0, as S = N + τ·D is negative now, and its time is −N/D. The greatest time comes first. These
//! are the flips of the insertion, inverted, in opposite order.
//!
//! An event carries the *mirrored* circuit (v, y, x, z, w): all its determinants have the opposite sign, N, D and the
//! coefficients, so that −N/D is the same with the same perturbation, over a positive denominator, as
//! [`FlipTimes`] wants it.
//!
//! Nothing is known in advance of the region, which grows with the flips; at first only f's own triangles can fail. If
//! the vertices have no CDT without f that keeps the other constraints, this shows as a flip that cannot or may not be
//! done, or that comes too late. Then everything is put back.
//!
//! Time: O(n log n) comparisons for n events.

use super::event::{self, Event, Signs};
use super::moves::{FlipKind, flip_of_triangle};
use super::time::{FlipTime, FlipTimes};
use super::{Created, FlipCounts};
use crate::delaunay::is_locally_delaunay;
use crate::kinetic::{EventQueue, TimeOrder};
use crate::mesh::{Corner, TetId, TetMesh, VertexId};
use crate::predicate::PointStore;
use crate::recover::subpolygons::{Face, face};
use crate::recover::tables::Table;
use std::cmp::Ordering;

/// The constraints that a deletion must leave in place.
pub struct Kept<'a> {
    /// Whether there is a subsegment between two vertices.
    pub edge: &'a dyn Fn([VertexId; 2]) -> bool,
    /// Whether a triangle, its vertices in ascending order, lies on another polygon.
    pub triangle: &'a dyn Fn(Face) -> bool,
}

/// Why the flips cannot lead back to a CDT without f.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Blocked {
    /// This subsegment would have to be removed.
    Edge([VertexId; 2]),
    /// This triangle of another polygon would have to be removed.
    Triangle(Face),
    /// The tetrahedra around this triangle do not allow the flip that must come next.
    NoFlip(Face),
    /// This triangle is not locally Delaunay, and it never was its turn to be flipped.
    TooLate(Face),
}

/// The end of a deletion.
pub struct Deleted {
    /// What went wrong, if anything.
    pub blocked: Option<Blocked>,
    /// The tetrahedra that were removed: all there were of the region.
    pub before: Vec<[VertexId; 4]>,
    /// The tetrahedra that fill the region afterwards, sorted. If the deletion was blocked they have the vertices that
    /// they had before, not the ids.
    pub tets: Vec<TetId>,
    /// The flips.
    pub counts: FlipCounts,
}

/// An event that has been flipped, and when.
type Performed<C> = (Event, FlipTime<<C as FlipTimes>::Order>);

/// The deletion of one polygon.
pub struct FlipDeletion<'a, P, C: FlipTimes> {
    mesh: &'a mut TetMesh,
    points: &'a P,
    kept: Kept<'a>,
    times: C,
    queue: EventQueue<C::Order>,
    /// The last flip and its time.
    last: Option<Performed<C>>,
    /// Which tetrahedra were created by flips.
    created: &'a mut Table<bool>,
    /// The removed tetrahedra that were not.
    before: Vec<[VertexId; 4]>,
    counts: FlipCounts,
}

impl<'a, P: PointStore, C: FlipTimes> FlipDeletion<'a, P, C> {
    /// Prepares a deletion. `marks` is a table for marking tetrahedra, kept from polygon to polygon.
    pub fn new(
        mesh: &'a mut TetMesh,
        points: &'a P,
        kept: Kept<'a>,
        times: C,
        marks: &'a mut Table<bool>,
    ) -> Self {
        marks.clear();
        FlipDeletion {
            mesh,
            points,
            kept,
            times,
            queue: EventQueue::latest_first(),
            last: None,
            created: marks,
            before: Vec::new(),
            counts: FlipCounts::default(),
        }
    }

    /// Deletes the polygon that consists of the triangles opposite the given corners. If that is blocked the mesh has
    /// the same tetrahedra as before.
    pub fn delete(mut self, faces: &[Corner]) -> Deleted {
        let result = self.flip_back(faces).and_then(|()| self.check_delaunay());
        let blocked = result.err();
        let mut tets = self.created_tets();
        if blocked.is_some() {
            tets = self.mesh.replace(&tets, &self.before);
            tets.sort_unstable();
        }
        self.counts.record(&self.queue, &self.times);
        Deleted {
            blocked,
            before: self.before,
            tets,
            counts: self.counts,
        }
    }

    fn flip_back(&mut self, faces: &[Corner]) -> Result<(), Blocked> {
        for &s in faces {
            self.certify(s)?;
        }
        while let Some(event) = self.queue.pop(self.times.order()) {
            let Some(s) = event.corner_if_alive(self.mesh) else {
                self.counts.stale += 1;
                continue;
            };
            self.go_back_to(event)?;
            let (kind, created) = self.flip(s)?;
            self.certify_around(kind, &created)?;
        }
        Ok(())
    }

    /// Queues the triangle opposite corner `s` if it must be flipped before τ = 0. Boundary triangles and constraints
    /// never must.
    fn certify(&mut self, s: Corner) -> Result<(), Blocked> {
        if self.mesh.is_ghost(s.tet()) || self.mesh.is_ghost(self.mesh.neighbor(s)) {
            return Ok(());
        }
        let circuit @ [v, x, y, z, w] = event::circuit(self.mesh, s);
        let triangle = face([x, y, z]);
        if !self.points.insphere(circuit).is_positive() || (self.kept.triangle)(triangle) {
            return Ok(());
        }
        let circuit = [v, y, x, z, w];
        let due = self.times.time(circuit);
        let due = due.ok_or(Blocked::TooLate(triangle))?;
        let event = Event {
            circuit,
            tet: s.tet(),
            signs: Signs::UNKNOWN,
        };
        self.queue
            .push(self.times.order(), event, due.key, due.time);
        Ok(())
    }

    /// Sets the clock to the time of `event`, unless that is already over. (The paper asks when the event is queued; if
    /// it is too late then, it comes off the queue before any other flip is done.)
    fn go_back_to(&mut self, event: Event) -> Result<(), Blocked> {
        let due = self.times.time(event.circuit);
        let due = due.expect("only events with a time are queued");
        let is_earlier = self.last.as_ref().is_none_or(|(last, at)| {
            let order = C::Order::compare_keys(due.key, at.key).unwrap_or_else(|| {
                let order = self.times.order();
                order.compare((&event, &due.time), (last, &at.time))
            });
            order == Ordering::Less
        });
        if !is_earlier {
            let [_, x, y, z, _] = event.circuit;
            return Err(Blocked::TooLate(face([x, y, z])));
        }
        self.last = Some((event, due));
        Ok(())
    }

    /// Removes the triangle opposite corner `s`.
    fn flip(&mut self, s: Corner) -> Result<(FlipKind, Created), Blocked> {
        let flip = flip_of_triangle(self.points, self.mesh, s, Signs::UNKNOWN)
            .ok_or_else(|| Blocked::NoFlip(face(self.mesh.facet(s))))?;
        if let Some([p, q, _]) = flip.edge()
            && (self.kept.edge)([p, q])
        {
            return Err(Blocked::Edge([p, q]));
        }
        let old = flip.old();
        for c in corners(old).filter(|&c| old.contains(&self.mesh.neighbor(c))) {
            let vanishing = face(self.mesh.facet(c));
            if (self.kept.triangle)(vanishing) {
                return Err(Blocked::Triangle(vanishing));
            }
        }
        for &t in old {
            if self.created.get(t.index()) {
                self.created.reset(t.index());
            } else {
                self.before.push(self.mesh.vertices(t));
            }
        }
        let created = flip.perform(self.mesh);
        for t in &created {
            self.created.set(t.index(), true);
        }
        self.counts.count(flip.kind());
        Ok((flip.kind(), created))
    }

    /// Certifies the triangles on the boundary of the flipped volume, and those in the plane of a 4-4 flip, which is
    /// two flips at once, one on each side of that plane. (The other inner triangles have been flipped into existence:
    /// their circuits are that of the event with the opposite sign.)
    fn certify_around(&mut self, kind: FlipKind, created: &[TetId]) -> Result<(), Blocked> {
        for c in corners(created) {
            let outer = !created.contains(&self.mesh.neighbor(c));
            if outer || (kind == FlipKind::FourFour && c < self.mesh.twin(c)) {
                self.certify(c)?;
            }
        }
        Ok(())
    }

    fn created_tets(&self) -> Vec<TetId> {
        self.created.ids().into_iter().map(TetId).collect()
    }

    /// That every triangle in and around the region is a constraint or locally Delaunay. It is, if all triangles that
    /// are not in the region were.
    fn check_delaunay(&self) -> Result<(), Blocked> {
        let tets = self.created_tets();
        let mut bad = corners(&tets)
            .filter(|&c| !is_locally_delaunay(self.points, self.mesh, c))
            .map(|c| face(self.mesh.facet(c)))
            .filter(|&t| !(self.kept.triangle)(t));
        bad.next().map_or(Ok(()), |t| Err(Blocked::TooLate(t)))
    }
}

fn corners(tets: &[TetId]) -> impl Iterator<Item = Corner> {
    let slots = |t: TetId| (0..4).map(move |slot| t.corner(slot));
    tets.iter().copied().flat_map(slots)
}
