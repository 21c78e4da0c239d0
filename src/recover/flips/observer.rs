//! Observing flips: for experiments and pictures. An insertion that nobody observes pays one untaken branch per event.

use super::FlipOutcome;
use super::moves::FlipKind;
use crate::mesh::VertexId;

/// What became of an event that came off the queue, or a flip that a patch of §3.3 did.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Fate {
    /// Its triangle was gone.
    Stale,
    /// It was flipped when its turn came.
    Flipped(FlipKind),
    /// Its flip was impossible: it goes to the list L, or ends an insertion in exact order.
    Impossible,
    /// Its flip would have removed a tetrahedron outside R.
    OutsideRegion,
    /// Flipped from the list L (third patch).
    FlippedFromList(FlipKind),
    /// Left the list L without a flip: its triangle is gone, or its flip would now remove a tetrahedron outside R.
    DroppedFromList,
    /// A triangle between non-crossing tetrahedra that was not locally Delaunay (second patch); no event.
    FlippedNonCrossing(FlipKind),
}

/// Is told what happens. All methods do nothing by default.
pub trait FlipObserver {
    /// The insertion of one missing region of a polygon (by its index in [`crate::plc::Complex`]) begins. Left vertices
    /// are those v of the region's tetrahedra with orient3d(frame, v) > 0; a polygon that is flat only to rounding may
    /// be tried twice, the second time from behind.
    fn begin(&mut self, polygon: usize, frame: [VertexId; 3], region: &[[VertexId; 4]]) {
        let _ = (polygon, frame, region);
    }

    /// An event, by its circuit v, x, y, z, w: the triangle xyz between the tetrahedra vxyz and wxzy.
    fn event(&mut self, circuit: [VertexId; 5], fate: Fate) {
        let _ = (circuit, fate);
    }

    /// The insertion of the region has ended; `tets` fill it. If it has failed they are about to be undone.
    fn end(&mut self, outcome: FlipOutcome, tets: &[[VertexId; 4]]) {
        let _ = (outcome, tets);
    }
}
