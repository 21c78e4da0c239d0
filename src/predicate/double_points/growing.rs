//! How double points grow: by points and by Steiner points on segments, which may be taken back.

use super::DoublePoints;
use crate::mesh::VertexId;
use crate::number::Parameter;
use crate::predicate::segment_point::{SegmentPoint, rounded_between};
use crate::predicate::{GrowingStore, Steiner};

impl GrowingStore for DoublePoints {
    /// # Panics
    /// If a coordinate is not finite.
    fn push(&mut self, p: [f64; 3]) -> VertexId {
        let before = self.range;
        for x in p {
            assert!(x.is_finite(), "coordinates are finite");
        }
        if self.range.include(p) {
            self.earlier.push((self.points.len(), before));
        }
        self.push_unchecked(p)
    }

    fn truncate(&mut self, n: usize) {
        self.points.truncate(n);
        while self.segment_points.pop_if(|(i, _)| *i >= n).is_some() {}
        while let Some((_, range)) = self.earlier.pop_if(|(i, _)| *i >= n) {
            self.range = range;
        }
        if let Some(identities) = &mut self.identities {
            identities.truncate(n);
        }
    }

    /// [`Steiner::Rounded`] rounds each coordinate of p + t(q−p) to a double, so that the point is off the line by
    /// about half an ulp, or not at all where the result is representable. p and q must have double coordinates.
    fn push_on_segment(&mut self, p: VertexId, q: VertexId, t: Parameter) -> VertexId {
        let ends = [p, q].map(|v| self.points[v.index()]);
        if self.steiner == Steiner::Rounded
            && let Some(doubles) = rounded_between(ends, t)
        {
            return self.push(doubles);
        }
        let point = match SegmentPoint::new(ends, t) {
            Err(doubles) => return self.push(doubles),
            Ok(point) => point,
        };
        if self.steiner == Steiner::Rounded {
            return self.push(point.rounded);
        }
        let place = self.segment_points.len() as f64;
        self.segment_points.push((self.points.len(), point));
        self.push_unchecked([f64::NAN, f64::NAN, place])
    }
}

impl DoublePoints {
    fn push_unchecked(&mut self, p: [f64; 3]) -> VertexId {
        let v = VertexId::new(self.points.len());
        self.points.push(p);
        if let Some(identities) = &mut self.identities {
            identities.push(v.0);
        }
        v
    }
}
