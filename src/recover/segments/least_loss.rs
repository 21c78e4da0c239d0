//! The place on a subsegment where a Steiner point destroys the fewest other subsegments.
//!
//! The place that the rules of [`super::split`] say is taken if nothing is lost there: no subsegment is inside its
//! conflict zone, and both halves of the split one are edges afterwards. Otherwise all places that leave both halves
//! are compared at once ([`super::conflict_intervals`]): the ends of the intervals where some subsegment is lost divide
//! them into cells. Of the cells in which the fewest are lost, the one nearest to the middle is taken, and in it a
//! place with few bits. Very narrow cells count: between two segments that are close together there is often only one
//! place that is level with the points of the other.
//!
//! Wherever the point is put, recovery stays correct, so floats do. The search ends because the effort is bounded
//! (`recovery.rs`).

use super::conflict_intervals::Interval;
use super::recovery::SegmentRecovery;
use super::split::{Subsegment, fewest_bits};
use crate::mesh::{TetId, VertexId};
use crate::predicate::GrowingStore;

/// No place is nearer to an end than this part of the subsegment.
const MARGIN: f64 = 0.005;
/// Cells that are narrower, as a part of the subsegment, are none.
const NARROW: f64 = 1e-5;
/// The place is in the middle of its cell, or this part of the cell away, for the sake of fewer bits.
const SLACK: f64 = 0.25;
/// If the circumspheres of so many tetrahedra reach a subsegment, the rules prevail.
const MOST_TETS: usize = 1000;

impl<P: GrowingStore> SegmentRecovery<'_, P> {
    /// The parameter of the best place on the subsegment ab, in the direction of its segment, if it is better than t,
    /// which the rules say. `crossed` are the tetrahedra that the subsegment crosses.
    pub(super) fn place_of_least_loss(
        &mut self,
        ab: [VertexId; 2],
        subsegment: &Subsegment,
        t: f64,
        crossed: &[TetId],
    ) -> f64 {
        let [t0, t1] = subsegment.range;
        let [low, high] = self.leaves_halves(ab, crossed);
        let range = [low.max(MARGIN), high.min(1.0 - MARGIN)];
        // If no place leaves both halves, more points have to come, and places for this one are no better than others.
        if range[0] >= range[1] {
            return t;
        }
        let now = (t - t0) / (t1 - t0);
        // Mostly the zone of this one place is much smaller than what all zones have together.
        if !self.find_losses(ab, crossed, [now, now]) {
            return t;
        }
        let lost_now = self.losses.len();
        if lost_now == 0 && low < now && now < high {
            return t;
        }
        if !self.find_losses(ab, crossed, range) {
            return t;
        }
        match best_cell(range, &self.losses) {
            Some((least, [low, high])) if least == 0 || least < lost_now => {
                let length = t1 - t0;
                let middle = t0 + 0.5 * (low + high) * length;
                let place = fewest_bits(middle, SLACK * (high - low) * length);
                // Not so if hardly any doubles are left between the ends.
                if t0 < place && place < t1 { place } else { t }
            }
            _ => t,
        }
    }

    /// Finds which subsegments are lost for which places in a range; whether there are not too many tetrahedra.
    fn find_losses(&mut self, ab: [VertexId; 2], crossed: &[TetId], range: Interval) -> bool {
        let mesh = &self.delaunay.mesh;
        let looked = self
            .conflicts
            .find(self.points, mesh, ab, crossed, range, MOST_TETS);
        self.looked += looked.unwrap_or(MOST_TETS);
        self.losses.clear();
        if looked.is_some() {
            let (subsegments, losses) = (&self.subsegments, &mut self.losses);
            let wanted = |[x, y]: [VertexId; 2]| subsegments.segment_of(x, y).is_some();
            self.conflicts
                .vanishing(mesh, range, wanted, |_, interval| losses.push(interval));
        }
        looked.is_some()
    }

    /// Between which places both halves of ab are edges.
    fn leaves_halves(&mut self, ab: [VertexId; 2], crossed: &[TetId]) -> Interval {
        let mesh = &self.delaunay.mesh;
        let [to_a, to_b] = ab.map(|v| {
            let conflicts = &mut self.conflicts;
            conflicts.joined(self.points, mesh, ab, v, crossed, MOST_TETS)
        });
        [to_b[0], to_a[1]]
    }
}

/// How many of the intervals contain x.
fn lost_at(losses: &[Interval], x: f64) -> usize {
    losses.iter().filter(|s| s[0] < x && x < s[1]).count()
}

/// Of the cells into which the ends of the intervals `losses` divide a range, one that is in the fewest of them, with
/// their number; of these the one nearest to the middle.
fn best_cell(range: Interval, losses: &[Interval]) -> Option<(usize, Interval)> {
    let inside = |x: &f64| range[0] < *x && *x < range[1];
    let mut ends: Vec<f64> = losses.iter().flatten().copied().filter(inside).collect();
    ends.extend(range);
    ends.sort_unstable_by(f64::total_cmp);
    let cells = ends.windows(2).map(|w| [w[0], w[1]]);
    let wide = cells.filter(|w| w[1] - w[0] > NARROW);
    let rated = wide.map(|cell| {
        let middle = 0.5 * (cell[0] + cell[1]);
        (lost_at(losses, middle), (middle - 0.5).abs(), cell)
    });
    let best = rated.min_by(|x, y| x.0.cmp(&y.0).then(x.1.total_cmp(&y.1)));
    best.map(|(lost, _, cell)| (lost, cell))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn in_the_best_cell_the_least_is_lost() {
        let cell = |losses: &[Interval]| best_cell([0.125, 0.875], losses);
        assert_eq!(cell(&[]), Some((0, [0.125, 0.875])));
        assert_eq!(cell(&[[0.0, 0.5]]), Some((0, [0.5, 0.875])));
        assert_eq!(cell(&[[0.3, 1.0], [0.0, 0.25]]), Some((0, [0.25, 0.3])));
        assert_eq!(cell(&[[0.0, 0.75], [0.25, 1.0]]), Some((1, [0.125, 0.25])));
        assert_eq!(
            cell(&[[0.0, 0.5], [0.5, 1.0], [0.0, 1.0]]),
            Some((2, [0.125, 0.5]))
        );
        let narrow = 0.5 + 0.5 * NARROW;
        assert_eq!(cell(&[[0.0, 0.5], [narrow, 1.0]]), Some((1, [0.125, 0.5])));
    }
}
