//! Why a segment cannot be recovered: a vertex lies on it, another segment meets it or comes too close, or coordinates
//! are too coarse to divide it any further. Exact.

use super::recovery::SegmentRecovery;
use crate::error::{Failure, GaveUp, InvalidPlc, Nearest};
use crate::mesh::VertexId;
use crate::number::vector::{dot, minus, square};
use crate::number::{Dyadic, Exact, Vec3};
use crate::predicate::{GrowingStore, PointStore};

impl<P: GrowingStore> SegmentRecovery<'_, P> {
    /// Why segment s cannot be recovered, on which the vertex v lies.
    pub(super) fn vertex_on_segment(&self, s: u32, v: VertexId) -> Failure {
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
    pub(super) fn too_short(&self, segment: [VertexId; 2]) -> Failure {
        let inputs = (0..self.subsegments.first_steiner()).map(VertexId::new);
        let mut in_mesh =
            inputs.filter(|&v| self.incidence.tet_at(v).is_some() && !segment.contains(&v));
        if let Some(vertex) = in_mesh.find(|&v| lies_between(self.points, segment, v)) {
            return InvalidPlc::VertexOnSegment { segment, vertex }.into();
        }
        let shares_end = |other: &[VertexId; 2]| other.iter().any(|v| segment.contains(v));
        let mut others = self.subsegments.all_ends();
        match others
            .find(|&other| !shares_end(&other) && segments_meet(self.points, [segment, other]))
        {
            Some(other) => {
                let segments = [segment, other];
                InvalidPlc::SegmentsMeet { segments }.into()
            }
            None => {
                let nearest = self.nearest(segment);
                GaveUp::SegmentTooShort { segment, nearest }.into()
            }
        }
    }

    /// What there is to say when there are too many Steiner points.
    pub(super) fn too_many(&self, segment: [VertexId; 2]) -> Failure {
        let points = self.subsegments.steiner_count();
        let nearest = self.nearest(segment);
        let too_many = GaveUp::TooManySteinerPoints {
            segment,
            points,
            nearest,
        };
        too_many.into()
    }

    /// The vertex of the input nearest to a segment. Linear time, on the way out.
    fn nearest(&self, segment: [VertexId; 2]) -> Option<Nearest> {
        let [a, b] = segment.map(|v| self.points.rounded(v));
        let along = minus(b, a);
        let distance = |v: VertexId| {
            let from = minus(self.points.rounded(v), a);
            let t = (dot(from, along) / dot(along, along)).clamp(0.0, 1.0);
            square(minus(from, along.map(|x| t * x))).sqrt()
        };
        let inputs = (0..self.subsegments.first_steiner()).map(VertexId::new);
        let others = inputs.filter(|v| self.incidence.tet_at(*v).is_some() && !segment.contains(v));
        let near = others.map(|vertex| Nearest {
            vertex,
            distance: distance(vertex),
        });
        near.min_by(|x, y| x.distance.total_cmp(&y.distance))
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
