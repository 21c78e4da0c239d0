//! Segment recovery: Steiner points until every segment is a chain of edges of the Delaunay tetrahedralization
//! (paper §2; Si & Gärtner 2005).
//!
//! # Why presence is enough
//! The CDT theorem wants every segment *strongly* Delaunay: a sphere through its ends with no other vertex in or on it.
//! An edge of one of several Delaunay tetrahedralizations of cospherical vertices is less. But ours is the regular
//! tetrahedralization of the vertices with infinitesimal weights in general position: every edge of it is an edge of a
//! simplicial convex hull in R⁴ (as far as lifted points go), which has a supporting hyperplane that touches it nowhere
//! else, so it is strongly regular for those weights. The CDT theorem holds for weighted CDTs (Shewchuk 2008), so the
//! PLC has a CDT for the perturbed weights, which is what polygon insertion, with the same perturbation, builds.
//!
//! Each missing subsegment is split ([`super::split`]), the longest first: then neighbours that are about as long are
//! split alike, and their points stay level with each other. An insertion can destroy other subsegments, so those in its
//! conflict zone are looked at again, and no others.
//!
//! # Thrift
//! Which points are inserted is a choice. Two ways are tried from the start, and the one that needs fewer points is kept:
//! the place that the rules of [`super::split`] say, and the place that destroys the fewest other subsegments
//! (`harmless.rs`). The second one is abandoned where it is not ahead of the first after a while. In the end, points
//! that turn out unnecessary are removed (`prune.rs`).

use super::reach::{Reaches, Span};
use super::scout::{Scouted, crossed_by, scout};
use super::scratch::Table;
use super::split::{self, Reference, Subsegment, split_parameter};
use super::subsegments::key;
pub use super::subsegments::{SegmentIndex, Subsegments};
use super::turn::inner_edges;
use crate::delaunay::Delaunay;
use crate::error::{Failure, GaveUp, InvalidPlc};
use crate::mesh::{Incidence, TetId, VertexId};
use crate::number::{Dyadic, Exact, Vec3};
use crate::plc::Complex;
use crate::predicate::{Parameter, PointStore};
use rustc_hash::FxHashSet;
use std::collections::BinaryHeap;

/// Inserts Steiner points into the Delaunay tetrahedralization of the complex's vertices until every segment is there.
///
/// # Errors
/// [`InvalidPlc`] where a vertex lies on a segment; [`GaveUp::SegmentTooShort`] where a segment cannot be divided any
/// more in the store's coordinates, as happens where segments or facets intersect.
pub fn recover_segments<P: PointStore>(
    complex: &Complex,
    points: &mut P,
    delaunay: &mut Delaunay,
) -> Result<(Subsegments, Incidence), Failure> {
    let first = points.len();
    let subsegments = Subsegments::new(complex, first);
    let index = SegmentIndex::new(complex);
    let incidence = Incidence::new(&delaunay.mesh, first);
    let missing = |&[a, b]: &[VertexId; 2]| {
        let start = incidence.tet_at(a).expect("every vertex is in the mesh");
        !matches!(scout(points, &delaunay.mesh, start, a, b), Scouted::Edge(_))
    };
    let missing: Vec<[VertexId; 2]> = subsegments
        .all_ends()
        .iter()
        .copied()
        .filter(missing)
        .collect();
    if missing.is_empty() {
        return Ok((subsegments, incidence));
    }
    let mut levels: Vec<Level> = Vec::new();
    let mut attempt = |delaunay: &Delaunay, placement, levels: &mut Vec<Level>| {
        points.truncate(first);
        let mut recovery = SegmentRecovery {
            points: &mut *points,
            delaunay: delaunay.clone(),
            incidence: incidence.clone(),
            subsegments: subsegments.clone(),
            index: &index,
            placement,
            missing: BinaryHeap::new(),
            lost: Vec::new(),
            zone: Table::default(),
            reaches: Reaches::default(),
            harmful: Vec::new(),
            touched: None,
        };
        missing.iter().for_each(|&[a, b]| recovery.enqueue(a, b));
        recovery.run(levels)
    };
    let by_rules = attempt(delaunay, Placement::ByRules, &mut levels);
    let most = match &by_rules {
        Ok(recovered) => recovered.subsegments.steiner_count(),
        Err(Failure::GaveUp(GaveUp::SegmentTooShort { .. } | GaveUp::SegmentsTooClose { .. })) => {
            levels.clear();
            MOST_VERTICES_PER_SEGMENT
        }
        Err(_) => return by_rules.map(|r| (r.subsegments, r.incidence)),
    };
    let harmless = Placement::Harmless {
        most,
        effort: 1_000_000 + EFFORT_PER_POINT * most,
    };
    let recovered = match (by_rules, attempt(delaunay, harmless, &mut levels)) {
        (Ok(rules), Ok(harmless)) => {
            let fewer = harmless.subsegments.steiner_count() < rules.subsegments.steiner_count();
            if fewer { harmless } else { rules }
        }
        (Ok(recovered), _) | (_, Ok(recovered)) => recovered,
        (Err(failure), _) => return Err(failure),
    };
    points.truncate(first);
    recovered.subsegments.place(points);
    let recovered = recovered.pruned(points);
    *delaunay = recovered.delaunay;
    Ok((recovered.subsegments, recovered.incidence))
}

/// A request for one more Steiner point.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Request {
    /// Here, on a polygon.
    Point([f64; 3]),
    /// Somewhere on this subsegment.
    Split([VertexId; 2]),
}

/// What more Steiner points have led to.
#[derive(Clone, Debug, Default)]
pub struct Added {
    /// For each request the new vertex, or `None` if there is a vertex already, or the subsegment is no more.
    pub vertices: Vec<Option<VertexId>>,
    /// All vertices whose stars have changed.
    pub touched: FxHashSet<VertexId>,
}

/// Inserts more Steiner points, and those with which segments are recovered that these destroy, into a Delaunay
/// tetrahedralization that has all segments.
///
/// # Errors
/// The same as [`recover_segments`].
pub fn add_steiner_points<P: PointStore>(
    requests: &[Request],
    index: &SegmentIndex,
    points: &mut P,
    delaunay: &mut Delaunay,
    subsegments: &mut Subsegments,
    incidence: &mut Incidence,
) -> Result<Added, Failure> {
    let mut recovery = SegmentRecovery {
        points,
        delaunay: std::mem::take(delaunay),
        incidence: std::mem::take(incidence),
        subsegments: std::mem::take(subsegments),
        index,
        placement: Placement::ByRules,
        missing: BinaryHeap::new(),
        lost: Vec::new(),
        zone: Table::default(),
        reaches: Reaches::default(),
        harmful: Vec::new(),
        touched: Some(FxHashSet::default()),
    };
    let requests = requests.iter();
    let vertices: Result<Vec<_>, Failure> = requests.map(|&r| recovery.add(r)).collect();
    let recovered =
        vertices.and_then(|vertices| recovery.recover_missing(&mut Vec::new()).map(|()| vertices));
    recovery.subsegments.finish();
    *delaunay = recovery.delaunay;
    *subsegments = recovery.subsegments;
    *incidence = recovery.incidence;
    Ok(Added {
        vertices: recovered?,
        touched: recovery.touched.unwrap_or_default(),
    })
}

/// How many tetrahedra the search for harmless places may look at, for each Steiner point of the result to be improved.
const EFFORT_PER_POINT: usize = 1500;

/// No valid segment of ordinary input needs so many vertices. Edges that nearly overlap, an ulp apart all along, would
/// need one every few ulps.
const MOST_VERTICES_PER_SEGMENT: usize = 1 << 14;

/// A tetrahedralization with all segments.
pub(super) struct Recovered {
    pub(super) delaunay: Delaunay,
    pub(super) incidence: Incidence,
    pub(super) subsegments: Subsegments,
}

/// How far recovery was when it came to subsegments that were shorter than all before.
#[derive(Clone, Copy, Debug)]
struct Level {
    /// The bits of the length of the first one.
    length: u64,
    /// The number of Steiner points.
    count: usize,
}

/// Where Steiner points are put.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Placement {
    /// Where the rules of [`super::split`] say.
    ByRules,
    /// Where the fewest other subsegments are destroyed.
    Harmless {
        /// More Steiner points than this are of no use: there is a result with so many.
        most: usize,
        /// How many more tetrahedra may be looked at in the search for places.
        effort: usize,
    },
}

pub(super) struct SegmentRecovery<'a, P> {
    pub(super) points: &'a mut P,
    pub(super) delaunay: Delaunay,
    incidence: Incidence,
    pub(super) subsegments: Subsegments,
    pub(super) index: &'a SegmentIndex,
    pub(super) placement: Placement,
    /// Subsegments to look at, by the bits of their squared length, which are in the order of the lengths.
    missing: BinaryHeap<(u64, [VertexId; 2])>,
    /// Memory used again.
    pub(super) reaches: Reaches,
    pub(super) harmful: Vec<Span>,
    lost: Vec<[VertexId; 2]>,
    zone: Table<bool>,
    /// The vertices whose stars have changed, if that is of interest.
    touched: Option<FxHashSet<VertexId>>,
}

impl<P: PointStore> SegmentRecovery<'_, P> {
    /// Splits what is missing, the longest first, until nothing is.
    fn run(mut self, levels: &mut Vec<Level>) -> Result<Recovered, Failure> {
        self.recover_missing(levels)?;
        self.subsegments.finish();
        Ok(Recovered {
            delaunay: self.delaunay,
            incidence: self.incidence,
            subsegments: self.subsegments,
        })
    }

    /// By the rules, notes how far it is when it comes to shorter subsegments; otherwise gives up if it is not ahead of
    /// that, once it has a quarter of the points that would make it useless.
    fn recover_missing(&mut self, levels: &mut Vec<Level>) -> Result<(), Failure> {
        let mut shortest = u64::MAX;
        let mut next = 0;
        while let Some((length, [a, b])) = self.missing.pop() {
            if length < shortest {
                shortest = length;
                let count = self.subsegments.steiner_count();
                match self.placement {
                    Placement::ByRules => levels.push(Level { length, count }),
                    Placement::Harmless { most, .. } => {
                        while levels.get(next).is_some_and(|level| level.length > length) {
                            next += 1;
                        }
                        let not_ahead = levels.get(next).is_some_and(|level| level.count <= count);
                        if not_ahead && count > most / 4 {
                            let segment = [a, b];
                            return Err(GaveUp::TooManySteinerPoints { segment }.into());
                        }
                    }
                }
            }
            self.recover(a, b)?;
        }
        Ok(())
    }

    fn add(&mut self, request: Request) -> Result<Option<VertexId>, Failure> {
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
                let t = self.place(s, [a, b], None)?;
                self.split(s, [a, b], t).map(Some)
            }
        }
    }

    fn enqueue(&mut self, a: VertexId, b: VertexId) {
        let (p, q) = (self.points.rounded(a), self.points.rounded(b));
        let length = split::distance(p, q);
        self.missing.push((length.to_bits(), key(a, b)));
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
        match scout(self.points, &self.delaunay.mesh, start, a, b) {
            Scouted::Edge(_) => Ok(()),
            Scouted::Vertex(v) => Err(self.vertex_on_segment(s, v)),
            Scouted::Crosses(first) => {
                let t = self.place(s, [a, b], Some(first))?;
                self.split(s, [a, b], t).map(|_| ())
            }
        }
    }

    fn vertex_on_segment(&self, s: u32, v: VertexId) -> Failure {
        let segment = self.subsegments.ends(s);
        let Some(other) = self.subsegments.segment_of_steiner(v) else {
            return InvalidPlc::VertexOnSegment { segment, vertex: v }.into();
        };
        if other == s {
            // Rounding has put the vertices of one segment into the wrong order.
            return self.too_short(segment);
        }
        let segments = [segment, self.subsegments.ends(other)];
        if segments_meet(self.points, segments) {
            InvalidPlc::SegmentsMeet { segments }.into()
        } else {
            GaveUp::SegmentsTooClose { segments }.into()
        }
    }

    /// A segment that cannot be divided any more: if a vertex of the input lies on it or another segment meets it, that
    /// is why. Linear time, on the way out.
    fn too_short(&self, segment: [VertexId; 2]) -> Failure {
        let inputs = (0..self.subsegments.first_steiner()).map(VertexId::new);
        let mut in_mesh =
            inputs.filter(|&v| self.incidence.tet_at(v).is_some() && !segment.contains(&v));
        if let Some(vertex) = in_mesh.find(|&v| lies_between(self.points, segment, v)) {
            return InvalidPlc::VertexOnSegment { segment, vertex }.into();
        }
        let shares_end = |other: &[VertexId; 2]| other.iter().any(|v| segment.contains(v));
        let mut others = self
            .subsegments
            .all_ends()
            .iter()
            .filter(|other| !shares_end(other));
        match others.find(|&&other| segments_meet(self.points, [segment, other])) {
            Some(&other) => {
                let segments = [segment, other];
                InvalidPlc::SegmentsMeet { segments }.into()
            }
            None => GaveUp::SegmentTooShort { segment }.into(),
        }
    }

    /// The encroaching vertex that sees ab under the largest angle, among those of the crossed tetrahedra.
    fn reference(&self, s: u32, [a, b]: [VertexId; 2], crossed: &[TetId]) -> Option<Reference> {
        let mesh = &self.delaunay.mesh;
        let (pa, pb) = (self.points.rounded(a), self.points.rounded(b));
        let vertices = crossed.iter().flat_map(|&t| mesh.vertices(t));
        let seen = vertices
            .filter(|&v| v != a && v != b)
            .map(|v| (split::sight(self.points.rounded(v), pa, pb), v));
        let (_, v) = seen.min_by(|x, y| x.0.total_cmp(&y.0).then(x.1.cmp(&y.1)))?;
        let shares = self.shared_end(s, v);
        Some(Reference {
            point: self.points.rounded(v),
            shares,
        })
    }

    /// Which end of segment s the vertex v has in common with it: v is on, or an end of, another segment from there.
    pub(super) fn shared_end(&self, s: u32, v: VertexId) -> Option<usize> {
        let ends = self.subsegments.ends(s);
        match self.subsegments.segment_of_steiner(v) {
            Some(other) => (0..2).find(|&i| self.subsegments.ends(other).contains(&ends[i])),
            None => (0..2).find(|&i| self.index.find(v, ends[i]).is_some()),
        }
    }

    /// Where to split the subsegment ab of segment s, which is missing and first crosses `first`, or is there.
    fn place(
        &mut self,
        s: u32,
        [a, b]: [VertexId; 2],
        first: Option<TetId>,
    ) -> Result<Parameter, Failure> {
        let ends = self.subsegments.ends(s);
        let count = self.subsegments.steiner_count();
        let vertices = self.subsegments.vertices_on(s);
        let useless = match self.placement {
            Placement::ByRules => false,
            Placement::Harmless { most, effort } => count >= most || effort == 0,
        };
        if useless || vertices >= MOST_VERTICES_PER_SEGMENT {
            let segment = ends;
            return Err(GaveUp::TooManySteinerPoints { segment }.into());
        }
        let mut range = [a, b].map(|v| self.subsegments.parameter(s, v));
        range.sort_unstable_by(Parameter::order);
        let subsegment = Subsegment {
            ends: ends.map(|v| self.points.rounded(v)),
            range: range.map(|t| t.value),
            vertices,
        };
        let crossed = first.map(|first| crossed_by(self.points, &self.delaunay.mesh, first, a, b));
        let crossed = crossed.unwrap_or_default();
        let reference = self.reference(s, [a, b], &crossed);
        let Some(t) = split_parameter(&subsegment, reference) else {
            let middle = Parameter::middle(range[0], range[1]);
            return middle.ok_or_else(|| self.too_short(ends));
        };
        Ok(match self.placement {
            Placement::Harmless { .. } => self
                .less_harmful(s, [a, b], &subsegment, t, &crossed)
                .into(),
            Placement::ByRules => t.into(),
        })
    }

    /// Splits the subsegment ab of segment s at the parameter t.
    fn split(&mut self, s: u32, [a, b]: [VertexId; 2], t: Parameter) -> Result<VertexId, Failure> {
        let ends = self.subsegments.ends(s);
        let v = self.points.push_on_segment(ends[0], ends[1], t);
        if let Some(near) = self.incidence.tet_at(a) {
            self.delaunay.start_at(near);
        }
        if !self.insert(v) {
            return Err(self.too_short(ends));
        }
        for [a, b] in self.subsegments.split(s, [a, b], t, v) {
            self.enqueue(a, b);
        }
        Ok(v)
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
        if let Some(touched) = &mut self.touched {
            let (mesh, zone) = (&self.delaunay.mesh, self.delaunay.conflicts());
            touched.extend(zone.iter().flat_map(|&t| mesh.vertices(t)));
            touched.insert(v);
        }
        self.delaunay.replace_conflicts(v);
        self.incidence
            .update(&self.delaunay.mesh, self.delaunay.created());
        true
    }

    /// The subsegments among the edges inside the conflict zone are about to vanish. Others stay, and what is missing stays
    /// missing, so that the queue holds the missing subsegments, each once.
    fn queue_lost(&mut self) {
        let mut lost = std::mem::take(&mut self.lost);
        let conflicts = self.delaunay.conflicts();
        self.zone.clear();
        for t in conflicts {
            self.zone.set(t.index(), true);
        }
        inner_edges(
            &self.delaunay.mesh,
            conflicts,
            |t| self.zone.get(t.index()),
            (),
            |(), _| Some(()),
            |[a, b], ()| {
                if self.subsegments.segment_of(a, b).is_some() {
                    lost.push([a, b]);
                }
            },
        );
        for [a, b] in lost.drain(..) {
            self.enqueue(a, b);
        }
        self.lost = lost;
    }
}

/// Whether v lies in the interior of the segment ab. Exact.
fn lies_between<P: PointStore>(points: &P, [a, b]: [VertexId; 2], v: VertexId) -> bool {
    if !points.collinear([a, b, v]) {
        return false;
    }
    let [a, b, v] = [a, b, v].map(|v| points.coordinates::<Dyadic>(v));
    v.sub(&a).dot(&v.sub(&b)).exact_sign().is_negative()
}

/// Whether two segments without a common end have a common point. Exact.
fn segments_meet<P: PointStore>(points: &P, [[a, b], [c, d]]: [[VertexId; 2]; 2]) -> bool {
    if !points.orient3d([a, b, c, d]).is_zero() {
        return false;
    }
    let [a, b, c, d] = [a, b, c, d].map(|v| points.coordinates::<Dyadic>(v));
    let (ab, cd) = (b.sub(&a), d.sub(&c));
    let normal = ab.cross(&cd);
    let sign = |x: Dyadic| x.exact_sign();
    // On which side of the line through p along u a point q lies, in the common plane.
    let side = |p: &Vec3<Dyadic>, u: &Vec3<Dyadic>, q: &Vec3<Dyadic>| {
        sign(u.cross(&q.sub(p)).dot(&normal))
    };
    if !sign(normal.dot(&normal)).is_zero() {
        let straddles = |p, u, q, r| !(side(p, u, q) * side(p, u, r)).is_positive();
        return straddles(&a, &ab, &c, &d) && straddles(&c, &cd, &a, &b);
    }
    // Parallel: they meet if they are on one line and an end of one is between the ends of the other.
    let off = ab.cross(&c.sub(&a));
    let between = |p: &Vec3<Dyadic>, q: &Vec3<Dyadic>, r: &Vec3<Dyadic>| {
        !sign(q.sub(p).dot(&q.sub(r))).is_positive()
    };
    sign(off.dot(&off)).is_zero()
        && (between(&a, &c, &b) || between(&a, &d, &b) || between(&c, &a, &d))
}
