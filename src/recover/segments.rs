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
//! Each missing subsegment is split ([`super::split`]); an insertion can destroy other subsegments, so those in its
//! conflict zone are looked at again, and no others.

use super::scout::{Scouted, crossed_by, scout};
use super::split::{self, Reference, Subsegment, split_parameter};
use crate::delaunay::Delaunay;
use crate::error::{Failure, GaveUp, InvalidPlc};
use crate::mesh::{Incidence, TetId, TetMesh, VertexId};
use crate::number::{Dyadic, Exact, Vec3};
use crate::plc::Complex;
use crate::predicate::PointStore;
use rustc_hash::{FxHashMap, FxHashSet};

/// The segments of a complex and how they are divided into subsegments.
#[derive(Clone, Debug, Default)]
pub struct Subsegments {
    /// The segment of each subsegment, by its vertices in ascending order.
    of: FxHashMap<[VertexId; 2], u32>,
    /// For each segment its vertices with their parameters; from end to end once recovery is finished.
    chains: Vec<Vec<(f64, VertexId)>>,
    /// For each Steiner point, the segment it lies on and its parameter there, or `None` if it lies on a polygon; indexed
    /// from `first_steiner`.
    steiner: Vec<Option<(u32, f64)>>,
    first_steiner: usize,
    ends: Vec<[VertexId; 2]>,
}

impl Subsegments {
    fn new(complex: &Complex, first_steiner: usize) -> Subsegments {
        let ends: Vec<[VertexId; 2]> = complex.segments.iter().map(|s| s.ends).collect();
        Subsegments {
            of: ends
                .iter()
                .enumerate()
                .map(|(i, &[a, b])| (key(a, b), i as u32))
                .collect(),
            chains: ends
                .iter()
                .map(|&[a, b]| vec![(0.0, a), (1.0, b)])
                .collect(),
            steiner: Vec::new(),
            first_steiner,
            ends,
        }
    }

    /// The segment that ab is a subsegment of, as an index in [`Complex::segments`].
    pub fn segment_of(&self, a: VertexId, b: VertexId) -> Option<u32> {
        self.of.get(&key(a, b)).copied()
    }

    /// The segment that a Steiner point lies on; `None` for vertices of the input and for Steiner points on polygons.
    pub fn segment_of_steiner(&self, v: VertexId) -> Option<u32> {
        let i = v.index().checked_sub(self.first_steiner)?;
        let place = self.steiner.get(i).copied().flatten();
        place.map(|(s, _)| s)
    }

    /// Whether a and b are vertices of one segment of the input.
    pub fn share_segment(&self, index: &SegmentIndex, a: VertexId, b: VertexId) -> bool {
        let is_on = |s: u32, v: VertexId| {
            self.ends[s as usize].contains(&v) || self.segment_of_steiner(v) == Some(s)
        };
        let place = |v: VertexId| self.segment_of_steiner(v);
        match place(a).or(place(b)) {
            Some(s) => is_on(s, a) && is_on(s, b),
            None => index.find(a, b).is_some(),
        }
    }

    /// The vertices of segment `s` from its first end to its second.
    pub fn chain(&self, s: u32) -> impl DoubleEndedIterator<Item = VertexId> + '_ {
        self.chains[s as usize].iter().map(|&(_, v)| v)
    }

    /// The vertices of the segment ab of the input, from a to b; a and b alone if they are not the ends of one: then ab is
    /// an edge of a polygon that has been cut.
    pub fn chain_between(&self, index: &SegmentIndex, a: VertexId, b: VertexId) -> Vec<VertexId> {
        let Some(s) = index.find(a, b) else {
            return vec![a, b];
        };
        let chain = self.chain(s);
        if self.ends[s as usize][0] == a {
            chain.collect()
        } else {
            chain.rev().collect()
        }
    }

    /// How many Steiner points there are.
    pub fn steiner_count(&self) -> usize {
        self.steiner.len()
    }

    /// The parameter of a vertex of segment s.
    fn parameter(&self, s: u32, v: VertexId) -> f64 {
        match v.index().checked_sub(self.first_steiner) {
            Some(i) => self.steiner[i].expect("it lies on segment s").1,
            None if v == self.ends[s as usize][0] => 0.0,
            None => 1.0,
        }
    }

    /// Divides the subsegment ab of segment s at v, which has the parameter t.
    fn split(&mut self, s: u32, [a, b]: [VertexId; 2], t: f64, v: VertexId) -> [[VertexId; 2]; 2] {
        self.of.remove(&key(a, b));
        self.of.insert(key(a, v), s);
        self.of.insert(key(v, b), s);
        debug_assert_eq!(v.index(), self.first_steiner + self.steiner.len());
        self.steiner.push(Some((s, t)));
        self.chains[s as usize].push((t, v));
        [[a, v], [v, b]]
    }

    /// Brings the chains into order, once all Steiner points are there.
    fn finish(&mut self) {
        for chain in &mut self.chains {
            chain.sort_unstable_by(|x, y| x.0.total_cmp(&y.0));
        }
    }
}

/// Finds a segment of the input by its ends.
#[derive(Clone, Debug)]
pub struct SegmentIndex(FxHashMap<[VertexId; 2], u32>);

impl SegmentIndex {
    /// The index of a complex.
    pub fn new(complex: &Complex) -> SegmentIndex {
        let segments = complex.segments.iter().enumerate();
        SegmentIndex(
            segments
                .map(|(i, s)| (key(s.ends[0], s.ends[1]), i as u32))
                .collect(),
        )
    }

    fn find(&self, a: VertexId, b: VertexId) -> Option<u32> {
        self.0.get(&key(a, b)).copied()
    }
}

fn key(a: VertexId, b: VertexId) -> [VertexId; 2] {
    if a < b { [a, b] } else { [b, a] }
}

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
    let incidence = Incidence::new(&delaunay.mesh, points.len());
    let mut recovery = SegmentRecovery {
        subsegments: Subsegments::new(complex, points.len()),
        points,
        delaunay,
        incidence,
        missing: Vec::new(),
        touched: None,
    };
    // The queue is a stack; the first segments of the input come first.
    for segment in complex.segments.iter().rev() {
        recovery.missing.push(segment.ends);
    }
    recovery.finish()?;
    Ok((recovery.subsegments, recovery.incidence))
}

/// A request for one more Steiner point.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Steiner {
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
    requests: &[Steiner],
    points: &mut P,
    delaunay: &mut Delaunay,
    subsegments: &mut Subsegments,
    incidence: &mut Incidence,
) -> Result<Added, Failure> {
    let mut recovery = SegmentRecovery {
        subsegments: std::mem::take(subsegments),
        points,
        delaunay,
        incidence: std::mem::take(incidence),
        missing: Vec::new(),
        touched: Some(FxHashSet::default()),
    };
    let mut vertices = Vec::with_capacity(requests.len());
    for &request in requests {
        vertices.push(recovery.add(request)?);
    }
    recovery.finish()?;
    *subsegments = recovery.subsegments;
    *incidence = recovery.incidence;
    Ok(Added {
        vertices,
        touched: recovery.touched.unwrap_or_default(),
    })
}

/// No valid segment of ordinary input needs so many vertices. Edges that nearly overlap, an ulp apart all along, would
/// need one every few ulps.
const MOST_VERTICES_PER_SEGMENT: usize = 1 << 16;

struct SegmentRecovery<'a, P> {
    points: &'a mut P,
    delaunay: &'a mut Delaunay,
    incidence: Incidence,
    subsegments: Subsegments,
    /// Subsegments to look at.
    missing: Vec<[VertexId; 2]>,
    /// The vertices whose stars have changed, if that is of interest.
    touched: Option<FxHashSet<VertexId>>,
}

impl<P: PointStore> SegmentRecovery<'_, P> {
    /// Recovers what is missing, and brings the chains into order.
    fn finish(&mut self) -> Result<(), Failure> {
        while let Some([a, b]) = self.missing.pop() {
            self.recover(a, b)?;
        }
        self.subsegments.finish();
        Ok(())
    }

    fn add(&mut self, request: Steiner) -> Result<Option<VertexId>, Failure> {
        match request {
            Steiner::Point(p) => {
                let v = self.points.push(p);
                if !self.insert(v) {
                    self.points.truncate(v.index());
                    return Ok(None);
                }
                self.subsegments.steiner.push(None);
                Ok(Some(v))
            }
            Steiner::Split([a, b]) => match self.subsegments.segment_of(a, b) {
                Some(s) => self.split(s, a, b, None).map(Some),
                None => Ok(None),
            },
        }
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
                let reference = self.reference(s, first, a, b);
                self.split(s, a, b, reference).map(|_| ())
            }
        }
    }

    fn vertex_on_segment(&self, s: u32, v: VertexId) -> Failure {
        let segment = self.subsegments.ends[s as usize];
        let Some(other) = self.subsegments.segment_of_steiner(v) else {
            return InvalidPlc::VertexOnSegment { segment, vertex: v }.into();
        };
        let segments = [segment, self.subsegments.ends[other as usize]];
        if segments_meet(self.points, segments) {
            InvalidPlc::SegmentsMeet { segments }.into()
        } else {
            GaveUp::SegmentsTooClose { segments }.into()
        }
    }

    /// A segment that cannot be divided any more: if a vertex of the input lies on it or another segment meets it, that
    /// is why. Linear time, on the way out.
    fn too_short(&self, segment: [VertexId; 2]) -> Failure {
        let inputs = (0..self.subsegments.first_steiner).map(VertexId::new);
        let mut in_mesh =
            inputs.filter(|&v| self.incidence.tet_at(v).is_some() && !segment.contains(&v));
        if let Some(vertex) = in_mesh.find(|&v| lies_between(self.points, segment, v)) {
            return InvalidPlc::VertexOnSegment { segment, vertex }.into();
        }
        let shares_end = |other: &[VertexId; 2]| other.iter().any(|v| segment.contains(v));
        let mut others = self
            .subsegments
            .ends
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
    fn reference(&self, s: u32, first: TetId, a: VertexId, b: VertexId) -> Option<Reference> {
        let mesh = &self.delaunay.mesh;
        let (pa, pb) = (self.points.rounded(a), self.points.rounded(b));
        let crossed = crossed_by(self.points, mesh, first, a, b);
        let vertices = crossed.iter().flat_map(|&t| mesh.vertices(t));
        let seen = vertices
            .filter(|&v| v != a && v != b)
            .map(|v| (split::sight(self.points.rounded(v), pa, pb), v));
        let (_, v) = seen.min_by(|x, y| x.0.total_cmp(&y.0).then(x.1.cmp(&y.1)))?;
        let ends = self.subsegments.ends[s as usize];
        let theirs = self
            .subsegments
            .segment_of_steiner(v)
            .map(|other| self.subsegments.ends[other as usize]);
        let shares = theirs.and_then(|theirs| (0..2).find(|&i| theirs.contains(&ends[i])));
        Some(Reference {
            point: self.points.rounded(v),
            shares,
        })
    }

    fn split(
        &mut self,
        s: u32,
        a: VertexId,
        b: VertexId,
        reference: Option<Reference>,
    ) -> Result<VertexId, Failure> {
        let ends = self.subsegments.ends[s as usize];
        if self.subsegments.chains[s as usize].len() >= MOST_VERTICES_PER_SEGMENT {
            let segment = ends;
            return Err(GaveUp::TooManySteinerPoints { segment }.into());
        }
        let mut range = [a, b].map(|v| self.subsegments.parameter(s, v));
        range.sort_unstable_by(f64::total_cmp);
        let subsegment = Subsegment {
            ends: ends.map(|v| self.points.rounded(v)),
            range,
        };
        let t = split_parameter(&subsegment, reference).ok_or_else(|| self.too_short(ends))?;
        let v = self.points.push_on_segment(ends[0], ends[1], t);
        if let Some(near) = self.incidence.tet_at(a) {
            self.delaunay.start_at(near);
        }
        if !self.insert(v) {
            return Err(self.too_short(ends));
        }
        self.missing.extend(self.subsegments.split(s, [a, b], t, v));
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
        self.queue_endangered();
        if let Some(touched) = &mut self.touched {
            let mesh = &self.delaunay.mesh;
            touched.extend(
                self.delaunay
                    .conflicts()
                    .iter()
                    .flat_map(|&t| mesh.vertices(t)),
            );
            touched.insert(v);
        }
        self.delaunay.replace_conflicts(v);
        self.incidence
            .update(&self.delaunay.mesh, self.delaunay.created());
        true
    }

    /// Every subsegment among the edges of the conflict zone may be about to vanish.
    fn queue_endangered(&mut self) {
        for &t in self.delaunay.conflicts() {
            for [a, b] in edges_of(&self.delaunay.mesh, t) {
                if self.subsegments.segment_of(a, b).is_some() {
                    self.missing.push([a, b]);
                }
            }
        }
    }
}

fn edges_of(mesh: &TetMesh, t: TetId) -> [[VertexId; 2]; 6] {
    let [a, b, c, d] = mesh.vertices(t);
    [[a, b], [a, c], [a, d], [b, c], [b, d], [c, d]]
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
