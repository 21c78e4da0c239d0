//! The recovery of missing subsegments, one after the other, with one way of placing Steiner points.
//!
//! Each missing subsegment is split, the longest first: then neighbours that are about as long are split alike, and
//! their points stay level with each other. An insertion can destroy other subsegments, those inside its conflict zone,
//! and no others; and the halves of what it splits may be missing. So the queue holds the missing subsegments, each
//! once, but for some that have come back.

use super::Request;
use super::conflict_intervals::{ConflictIntervals, Interval};
use super::inner_edges::inner_edges;
use super::segment_index::key;
use super::split::{self, Reference, Subsegment, split_parameter};
use super::straight_walk::{Ahead, Crossed, look_ahead};
use super::subsegments::Subsegments;
use crate::delaunay::Delaunay;
use crate::error::Failure;
use crate::mesh::{Incidence, TetId, VertexId};
use crate::number::Parameter;
use crate::predicate::GrowingStore;
use crate::recover::tables::Stamps;
use rustc_hash::FxHashSet;
use std::collections::BinaryHeap;

/// No valid segment of ordinary input needs so many vertices. Edges that nearly overlap, an ulp apart all along, would
/// need one every few ulps.
pub(super) const MOST_VERTICES_PER_SEGMENT: usize = 1 << 14;

/// How many Steiner points are too many for an input of n vertices. Long parallel edges may need a tenth of n² (those
/// of a cylinder whose faces are flat only to rounding do), and few need more, where vertices are farther from each
/// other than rounding; where they are not, there is hardly an end.
fn most_points(n: usize) -> usize {
    (1 << 12) + 32 * n + n.saturating_mul(n) / 4
}

/// How many tetrahedra the search for places of least loss may look at: so many, and so many for each Steiner point.
const EFFORT: [usize; 2] = [1_000_000, 1500];

/// A tetrahedralization with all segments.
#[derive(Clone)]
pub(super) struct Recovered {
    pub(super) delaunay: Delaunay,
    pub(super) incidence: Incidence,
    pub(super) subsegments: Subsegments,
}

/// What insertions have changed.
#[derive(Clone, Debug, Default)]
pub struct Changes {
    /// All vertices whose stars have changed.
    pub touched: FxHashSet<VertexId>,
    /// All edges that have vanished, and all subsegments that have been split.
    pub vanished: Vec<[VertexId; 2]>,
}

/// Where Steiner points are put.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Placement {
    /// Where the rules of [`super::split`] say.
    ByRules,
    /// Where the fewest other subsegments are destroyed.
    LeastLoss,
}

/// A subsegment to look at: the bits of its length, which are in the order of the lengths, and its ends, in one number,
/// since a queue compares a lot.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Missing(u128);

impl Missing {
    fn new(length: f64, [a, b]: [VertexId; 2]) -> Missing {
        Missing(u128::from(length.to_bits()) << 64 | u128::from(a.0) << 32 | u128::from(b.0))
    }

    /// The bits of its length, and its ends.
    fn parts(self) -> (u64, [VertexId; 2]) {
        let ends = [VertexId((self.0 >> 32) as u32), VertexId(self.0 as u32)];
        ((self.0 >> 64) as u64, ends)
    }
}

/// What is kept while segments are recovered.
pub(super) struct SegmentRecovery<'a, P> {
    pub(super) points: &'a mut P,
    pub(super) delaunay: Delaunay,
    pub(super) incidence: Incidence,
    pub(super) subsegments: Subsegments,
    placement: Placement,
    /// How many tetrahedra the search for places of least loss has looked at.
    pub(super) looked: usize,
    /// Subsegments to look at, the longest first.
    missing: BinaryHeap<Missing>,
    /// Memory used again.
    pub(super) conflicts: ConflictIntervals,
    pub(super) losses: Vec<Interval>,
    crossed: Crossed,
    lost: Vec<[VertexId; 2]>,
    zone: Stamps,
    /// What has changed, if that is of interest.
    pub(super) changes: Option<Changes>,
    /// Who is told how many Steiner points will be needed at least, and says whether to go on.
    pub(super) go_on: Option<&'a GoOn<'a>>,
}

/// Somebody who is told how many Steiner points will be needed at least, and says whether to go on.
pub type GoOn<'a> = dyn Fn(usize) -> bool + 'a;

impl<'a, P: GrowingStore> SegmentRecovery<'a, P> {
    pub(super) fn new(
        points: &'a mut P,
        start: Recovered,
        placement: Placement,
    ) -> SegmentRecovery<'a, P> {
        SegmentRecovery {
            points,
            delaunay: start.delaunay,
            incidence: start.incidence,
            subsegments: start.subsegments,
            placement,
            looked: 0,
            missing: BinaryHeap::new(),
            conflicts: ConflictIntervals::default(),
            losses: Vec::new(),
            crossed: Crossed::default(),
            lost: Vec::new(),
            zone: Stamps::default(),
            changes: None,
            go_on: None,
        }
    }

    /// To be recovered: subsegments that are missing.
    pub(super) fn enqueue_all(&mut self, missing: &[[VertexId; 2]]) {
        missing.iter().for_each(|&[a, b]| self.enqueue(a, b));
    }

    /// The length of the longest missing subsegment; `None` if none is missing.
    pub(super) fn longest(&self) -> Option<f64> {
        let (length, _) = self.missing.peek()?.parts();
        Some(f64::from_bits(length))
    }

    /// About as many Steiner points will be needed at least.
    pub(super) fn bound(&self) -> usize {
        self.subsegments.steiner_count() + self.missing.len()
    }

    /// Splits missing subsegments, the longest first, until none of at least this length is missing, or more than
    /// `most` points will be needed; whether it came to the first end.
    pub(super) fn recover_down_to(&mut self, length: f64, most: usize) -> Result<bool, Failure> {
        while self.longest().is_some_and(|longest| longest >= length) {
            if self.bound() > most {
                return Ok(false);
            }
            if self.go_on.is_some_and(|go_on| !go_on(self.bound())) {
                return Err(Failure::Stopped);
            }
            let missing = self.missing.pop().expect("there is a longest one");
            let (_, [a, b]) = missing.parts();
            self.recover(a, b)?;
        }
        Ok(self.bound() <= most)
    }

    pub(super) fn finish(self) -> Recovered {
        Recovered {
            delaunay: self.delaunay,
            incidence: self.incidence,
            subsegments: self.subsegments,
        }
    }

    /// Does what is requested, if it can be done; recovers nothing yet.
    pub(super) fn add(&mut self, request: Request) -> Result<Option<VertexId>, Failure> {
        match request {
            Request::Point(p) => {
                let v = self.points.push(p);
                if !self.insert(v) {
                    self.points.truncate(v.index());
                    return Ok(None);
                }
                self.subsegments.push_on_polygon();
                Ok(Some(v))
            }
            Request::Split([a, b]) => {
                let Some(s) = self.subsegments.segment_of(a, b) else {
                    return Ok(None);
                };
                self.crossed.clear();
                let t = self.place(s, [a, b])?;
                self.split(s, [a, b], t).map(Some)
            }
        }
    }

    fn enqueue(&mut self, a: VertexId, b: VertexId) {
        let (p, q) = (self.points.rounded(a), self.points.rounded(b));
        let length = split::distance(p, q);
        self.missing.push(Missing::new(length, key(a, b)));
    }

    /// Looks for the edge ab; splits it if it is missing. A subsegment that is no longer one is passed over.
    fn recover(&mut self, a: VertexId, b: VertexId) -> Result<(), Failure> {
        let Some(s) = self.subsegments.segment_of(a, b) else {
            return Ok(());
        };
        let start = self
            .incidence
            .tet_at(a)
            .expect("every vertex is in the mesh");
        let mesh = &self.delaunay.mesh;
        match look_ahead(self.points, mesh, start, a, b) {
            Ahead::Edge(_) => Ok(()),
            Ahead::Vertex(v) => Err(self.vertex_on_segment(s, v)),
            Ahead::Crosses(first) => {
                self.crossed.follow(self.points, mesh, first, a, b);
                let t = self.place(s, [a, b])?;
                self.split(s, [a, b], t).map(|_| ())
            }
        }
    }

    /// The encroaching vertex that sees ab under the largest angle, among those of the crossed tetrahedra.
    fn reference(&self, s: u32, [a, b]: [VertexId; 2]) -> Option<Reference> {
        let (pa, pb) = (self.points.rounded(a), self.points.rounded(b));
        let vertices = self.crossed.vertices.iter();
        let seen = vertices
            .filter(|&&v| v != a && v != b)
            .map(|&v| (split::angle_measure(self.points.rounded(v), pa, pb), v));
        let (_, v) = seen.min_by(|x, y| x.0.total_cmp(&y.0).then(x.1.cmp(&y.1)))?;
        let shares = self.shared_end(s, v);
        Some(Reference {
            point: self.points.rounded(v),
            shares,
        })
    }

    /// Which end of segment s the vertex v has in common with it: v is on, or an end of, another segment from there.
    fn shared_end(&self, s: u32, v: VertexId) -> Option<usize> {
        let ends = self.subsegments.ends(s);
        match self.subsegments.segment_of_steiner(v) {
            Some(other) => {
                let others = self.subsegments.ends(other);
                (0..2).find(|&i| others.contains(&ends[i]))
            }
            None => (0..2).find(|&i| self.subsegments.segment_with_ends(v, ends[i]).is_some()),
        }
    }

    /// Where to split the subsegment ab of segment s, which is there, or crosses what has been found before.
    fn place(&mut self, s: u32, [a, b]: [VertexId; 2]) -> Result<Parameter, Failure> {
        let ends = self.subsegments.ends(s);
        let count = self.subsegments.steiner_count();
        let vertices = self.subsegments.vertices_on(s);
        if self.looked > EFFORT[0] + EFFORT[1] * count
            || vertices >= MOST_VERTICES_PER_SEGMENT
            || count >= most_points(self.subsegments.first_steiner())
        {
            return Err(self.too_many(ends));
        }
        let directed = self.subsegments.directed(s, [a, b]);
        let range = directed.map(|v| self.subsegments.parameter(s, v));
        let subsegment = Subsegment {
            ends: ends.map(|v| self.points.rounded(v)),
            range: range.map(|t| t.value),
            vertices,
        };
        let reference = self.reference(s, [a, b]);
        let Some(t) = split_parameter(&subsegment, reference) else {
            let middle = Parameter::middle(range[0], range[1]);
            return middle.ok_or_else(|| self.too_short(ends));
        };
        Ok(match self.placement {
            Placement::LeastLoss => {
                let crossed = std::mem::take(&mut self.crossed);
                let place = self.place_of_least_loss(directed, &subsegment, t, &crossed.tets);
                self.crossed = crossed;
                place.into()
            }
            Placement::ByRules => t.into(),
        })
    }

    /// Splits the subsegment ab of segment s at the parameter t.
    fn split(&mut self, s: u32, [a, b]: [VertexId; 2], t: Parameter) -> Result<VertexId, Failure> {
        let ends = self.subsegments.ends(s);
        let v = self.points.push_on_segment(ends[0], ends[1], t);
        let [from, to] = [a, b].map(|v| self.subsegments.parameter(s, v).value);
        let near = self.crossed.at((t.value - from) / (to - from));
        if let Some(near) = near.or_else(|| self.incidence.tet_at(a)) {
            self.delaunay.start_at(near);
        }
        if !self.insert(v) {
            return Err(self.too_short(ends));
        }
        if let Some(changes) = &mut self.changes {
            changes.vanished.push([a, b]);
        }
        let (from_a, from_b) = self.created_edges(a, b);
        let [to_a, to_b] = self.subsegments.split(s, [a, b], t, v);
        for ([a, b], is_there) in [(to_a, from_a), (to_b, from_b)] {
            if !is_there {
                self.enqueue(a, b);
            }
        }
        Ok(v)
    }

    /// Whether a and b are joined to the vertex that has just been inserted.
    fn created_edges(&self, a: VertexId, b: VertexId) -> (bool, bool) {
        let mesh = &self.delaunay.mesh;
        let mut found = (false, false);
        for &t in self.delaunay.created() {
            let vertices = mesh.vertices(t);
            found.0 |= vertices.contains(&a);
            found.1 |= vertices.contains(&b);
        }
        found
    }

    /// Inserts v, unless there is a vertex where it is.
    fn insert(&mut self, v: VertexId) -> bool {
        let start = self.delaunay.locate(self.points, v);
        let corners = self.delaunay.mesh.vertices(start);
        let mut finite = corners.iter().filter(|w| !w.is_infinite());
        if finite.any(|&w| self.points.coincide(v, w)) {
            return false;
        }
        self.delaunay.find_conflicts(self.points, v, start);
        self.queue_lost();
        if let Some(changes) = &mut self.changes {
            let (mesh, zone) = (&self.delaunay.mesh, self.delaunay.conflicts());
            let touched = zone.iter().flat_map(|&t| mesh.vertices(t)).chain([v]);
            changes.touched.extend(touched);
            inner_edges(
                mesh,
                zone,
                |t: TetId| self.zone.contains(t.index()),
                |_| true,
                (),
                |(), _| Some(()),
                |edge, ()| changes.vanished.push(edge),
            );
        }
        self.delaunay.replace_conflicts(v);
        let created = self.delaunay.created();
        self.incidence.update(&self.delaunay.mesh, created);
        self.conflicts.forget(created);
        true
    }

    /// The subsegments among the edges inside the conflict zone are about to vanish. Others stay, and what is missing
    /// stays missing.
    fn queue_lost(&mut self) {
        let mut lost = std::mem::take(&mut self.lost);
        let (mesh, conflicts) = (&self.delaunay.mesh, self.delaunay.conflicts());
        self.zone.clear(mesh.capacity());
        for t in conflicts {
            self.zone.insert(t.index());
        }
        inner_edges(
            mesh,
            conflicts,
            |t: TetId| self.zone.contains(t.index()),
            |[a, b]| self.subsegments.segment_of(a, b).is_some(),
            (),
            |(), _| Some(()),
            |edge, ()| lost.push(edge),
        );
        for [a, b] in lost.drain(..) {
            self.enqueue(a, b);
        }
        self.lost = lost;
    }
}
