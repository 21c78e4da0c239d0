//! The second and the third of the paper's patches for rounded times (§3.3): flips of triangles that are not locally
//! Delaunay between non-crossing tetrahedra, and flips that were impossible when their time came. (The first one, flips
//! that would remove a tetrahedron outside of R, is discarding the event.)

use super::{Fate, FlipInsertion, FlipTimes, Refused, RegionView, Signs, event};
use crate::mesh::{Corner, TetId};
use crate::predicate::PointStore;

impl<P: PointStore, C: FlipTimes, R: RegionView> FlipInsertion<'_, P, C, R> {
    /// The second and third patch of §3.3, for rounded times, after a flip that created `created`.
    pub(super) fn patch_after_flip(&mut self, created: &[TetId]) {
        self.restore_non_crossing(created);
        let mut progress = true;
        while progress {
            progress = false;
            for event in std::mem::take(&mut self.postponed) {
                let Some(s) = event.corner_if_alive(self.mesh) else {
                    self.tell(event.circuit, Fate::DroppedFromList);
                    continue;
                };
                match self.flip(s, event.signs) {
                    Ok((flip, created)) => {
                        self.counts.performed_from_list += 1;
                        self.tell(event.circuit, Fate::FlippedFromList(flip.kind()));
                        self.certify_around(&flip, &created);
                        self.restore_non_crossing(&created);
                        progress = true;
                    }
                    Err(Refused::OutsideRegion) => {
                        self.counts.discarded_outside += 1;
                        self.tell(event.circuit, Fate::DroppedFromList);
                    }
                    Err(Refused::Impossible) => self.postponed.push(event),
                    Err(Refused::Endless) => {}
                }
            }
        }
    }

    /// The second patch: makes the triangles between non-crossing tetrahedra of R locally Delaunay, starting with those
    /// of `created`. (Lawson's algorithm; it can get stuck, and then leaves the triangle.)
    fn restore_non_crossing(&mut self, created: &[TetId]) {
        if created.iter().all(|&t| self.crosses(t)) {
            return;
        }
        let mut pending: Vec<TetId> = created.to_vec();
        while let Some(t) = pending.pop() {
            if !self.region.contains(t) || self.crosses(t) {
                continue;
            }
            let bad = (0..4)
                .map(|slot| t.corner(slot))
                .find(|&s| self.is_bad_non_crossing(s));
            let Some(s) = bad else { continue };
            let circuit = event::circuit(self.mesh, s);
            if let Ok((flip, created)) = self.flip(s, Signs::UNKNOWN) {
                self.tell(circuit, Fate::FlippedNonCrossing(flip.kind()));
                self.counts.non_crossing += 1;
                self.certify_around(&flip, &created);
                pending.extend(created);
            }
        }
    }

    /// Whether both tetrahedra on a triangle are in R and non-crossing, and it is not locally Delaunay.
    fn is_bad_non_crossing(&self, s: Corner) -> bool {
        let n = self.mesh.neighbor(s);
        let facet = self.mesh.facet(s);
        if !self.region.contains(n)
            || self.crosses(n)
            || facet.iter().all(|&v| self.region.is_on(v))
        {
            return false;
        }
        let circuit = event::circuit(self.mesh, s);
        self.points.insphere(circuit).is_positive()
    }

    /// Whether a tetrahedron of R has vertices on both sides of f.
    fn crosses(&self, t: TetId) -> bool {
        let [left, right] = self.region.left_and_right(&self.mesh.vertices(t));
        left != 0 && right != 0
    }
}
