//! Places for a Steiner point that destroy no other subsegment.
//!
//! The place that the rules of [`super::split`] say is taken if it does no harm, that is, if no subsegment is lost in its
//! conflict zone and both halves of the split one are edges afterwards. If it does, other places are tried: short dyadic
//! fractions of the subsegment, the distances from the hub of the vertices around, and their projections. If all do harm,
//! the rules prevail: the least harm now is not the least in the end, because a point in an odd place forces others into
//! odd places.
//!
//! All of this is a choice only: wherever the point is put, recovery stays correct. So the trials are made with rounded
//! points and spheres, and may err. The search ends because the effort is bounded ([`super::segments::Placement`]).

use super::scout::crossed_by;
use super::segments::{Placement, SegmentRecovery, edges_of};
use super::split::{Subsegment, distance, dot, fewest_bits, sub};
use super::subsegments::key;
use crate::mesh::{TetId, VertexId};
use crate::predicate::{PointStore, RoundedSpheres};
use rustc_hash::FxHashSet;

/// Dyadic places are multiples of this part of the subsegment.
const PARTS: u32 = 64;
/// No place is nearer to an end than this part of the subsegment.
const MARGIN: f64 = 0.01;
/// How far places may be moved for the sake of fewer bits, as a part of the subsegment.
const SLACK: f64 = 1.0 / 512.0;
/// How many of the vertices around suggest places: near a hub there can be very many.
const MOST_SUGGESTIONS: usize = 24;

impl<P: PointStore> SegmentRecovery<'_, P> {
    /// The parameter of a harmless place on the subsegment ab of segment s, or else t, which the rules say.
    pub(super) fn harmless(
        &mut self,
        s: u32,
        [a, b]: [VertexId; 2],
        subsegment: &Subsegment,
        t: f64,
        first: TetId,
    ) -> f64 {
        let ends = self.subsegments.ends(s);
        let mut places = dyadic_places(subsegment.range);
        places.insert(0, t);
        places.extend(self.suggestions(s, [a, b], subsegment, first));
        let [t0, t1] = subsegment.range;
        let margin = MARGIN * (t1 - t0);
        places.retain(|&x| x == t || (t0 + margin <= x && x <= t1 - margin));
        let good = places
            .into_iter()
            .find(|&x| self.is_harmless(ends, [a, b], x, first));
        good.unwrap_or(t)
    }

    /// Places that the vertices around the subsegment suggest: at the same distance from a hub, or across.
    fn suggestions(
        &self,
        s: u32,
        [a, b]: [VertexId; 2],
        subsegment: &Subsegment,
        first: TetId,
    ) -> Vec<f64> {
        let mesh = &self.delaunay.mesh;
        let crossed = crossed_by(self.points, mesh, first, a, b);
        let vertices = crossed.iter().flat_map(|&t| mesh.vertices(t));
        let mut seen: Vec<VertexId> = vertices
            .filter(|&v| v != a && v != b && !v.is_infinite())
            .collect();
        seen.sort_unstable();
        seen.dedup();
        let [p, q] = subsegment.ends;
        let [t0, t1] = subsegment.range;
        let along = sub(q, p);
        let length = distance(p, q);
        let mut places = Vec::new();
        for v in seen.into_iter().take(MOST_SUGGESTIONS) {
            let x = self.points.rounded(v);
            if let Some(end) = self.shared_end(s, v) {
                let r = distance(x, subsegment.ends[end]) / length;
                places.push(if end == 0 { r } else { 1.0 - r });
            }
            let across = dot(sub(x, p), along) / dot(along, along);
            places.push(fewest_bits(across, SLACK * (t1 - t0)));
        }
        places
    }

    /// Whether a point at t destroys no subsegment, and both halves of ab are edges afterwards.
    fn is_harmless(
        &mut self,
        ends: [VertexId; 2],
        [a, b]: [VertexId; 2],
        t: f64,
        first: TetId,
    ) -> bool {
        let n = self.points.len();
        let [p, q] = ends.map(|v| self.points.rounded(v));
        let v = self
            .points
            .push([0, 1, 2].map(|i| p[i] + t * (q[i] - p[i])));
        self.delaunay.start_at(first);
        let start = self.delaunay.locate(self.points, v);
        let around = self.delaunay.mesh.vertices(start);
        let is_new = !around
            .iter()
            .any(|&w| !w.is_infinite() && self.points.coincide(v, w));
        if is_new {
            let seen = RoundedSpheres(&*self.points);
            self.delaunay.find_conflicts(&seen, v, start);
        }
        self.points.truncate(n);
        if !is_new {
            return false;
        }
        let zone = self.delaunay.conflicts();
        if let Placement::Harmless { effort, .. } = &mut self.placement {
            *effort = effort.saturating_sub(zone.len());
        }
        // The new point is joined to the vertices of the zone.
        let mesh = &self.delaunay.mesh;
        let joins = |w| zone.iter().any(|&t| mesh.slot_of(t, w).is_some());
        if !joins(a) || !joins(b) {
            return false;
        }
        // Edges on the boundary of the zone stay.
        let mut border: FxHashSet<[VertexId; 2]> = FxHashSet::default();
        for c in self.delaunay.conflict_boundary() {
            let [x, y, z] = mesh.facet(c);
            border.extend([key(x, y), key(y, z), key(z, x)]);
        }
        let edges = zone.iter().flat_map(|&t| edges_of(mesh, t));
        let mut inner = edges.filter(|&[x, y]| !border.contains(&key(x, y)));
        !inner.any(|[x, y]| self.subsegments.segment_of(x, y).is_some())
    }
}

/// The dyadic parts of a range, those with the fewest bits first, of these the middle ones first.
fn dyadic_places([t0, t1]: [f64; 2]) -> Vec<f64> {
    let mut parts: Vec<u32> = (1..PARTS).collect();
    parts.sort_by_key(|&k| (PARTS / (k & k.wrapping_neg()), (2 * k).abs_diff(PARTS), k));
    let length = t1 - t0;
    let place = |k| {
        fewest_bits(
            t0 + f64::from(k) / f64::from(PARTS) * length,
            SLACK * length,
        )
    };
    parts.into_iter().map(place).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_with_few_bits_come_first() {
        let places = dyadic_places([0.0, 1.0]);
        assert_eq!(places[..5], [0.5, 0.25, 0.75, 0.375, 0.625]);
        assert_eq!(places.len(), 63);
    }
}
