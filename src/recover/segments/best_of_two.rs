//! Two ways of placing Steiner points, tried side by side: both recover the same segments, the longest first, until it
//! is clear which one needs fewer points.
//!
//! A recovery with k Steiner points and m missing subsegments will need about k + m points at least, its *bound*, since
//! each missing subsegment is split. (A few come back by themselves.) The bound rises with every subsegment that an
//! insertion destroys, and tells what is to come long before the number of points does. Both recoveries split the
//! longest subsegments first, so their bounds are compared whenever both have come down to some length:
//!
//! - The search for places of least loss, which is costly, is given up for good once its bound is behind.
//! - The rules, which are cheap, wait while their bound is far behind, and go on when the other one has caught up with
//!   it.
//!
//! So they end with the fewer points of both, unless places of least loss would have made up for a bad start. All of it
//! depends on numbers of points only, hence is deterministic.

use super::recovery::{GoOn, MOST_VERTICES_PER_SEGMENT, Placement, Recovered, SegmentRecovery};
use crate::error::{Failure, GaveUp};
use crate::mesh::VertexId;
use crate::predicate::GrowingStore;

/// The lengths of the subsegments down to which both recoveries come in turns: each is this part of the one before.
const STEP: f64 = 0.95;
/// Differences of so many points tell nothing.
const NOISE: usize = 16;

/// Recovers the missing subsegments in the better of the two ways. Those of `points` are then unspecified from the
/// first Steiner point on.
///
/// # Errors
/// Those of the recovery by the rules.
pub(super) fn recover_best_of_two<P: GrowingStore + Clone>(
    points: &mut P,
    start: Recovered,
    missing: &[[VertexId; 2]],
    go_on: &GoOn<'_>,
) -> Result<Recovered, Failure> {
    let mut copy = points.clone();
    let mut both = BestOfTwo {
        rules: SegmentRecovery::new(&mut copy, start.clone(), Placement::ByRules),
        least_loss: SegmentRecovery::new(points, start, Placement::LeastLoss),
    };
    both.rules.go_on = Some(go_on);
    both.least_loss.go_on = Some(go_on);
    both.rules.enqueue_all(missing);
    both.least_loss.enqueue_all(missing);
    Ok(match both.run()? {
        Placement::ByRules => both.rules.finish(),
        Placement::LeastLoss => both.least_loss.finish(),
    })
}

struct BestOfTwo<'a, P> {
    rules: SegmentRecovery<'a, P>,
    least_loss: SegmentRecovery<'a, P>,
}

impl<P: GrowingStore> BestOfTwo<'_, P> {
    /// Which one is better; that one is then complete.
    fn run(&mut self) -> Result<Placement, Failure> {
        let mut waits = false;
        loop {
            let Some(longest) = self.least_loss.longest() else {
                return self.rules_at_last();
            };
            let length = STEP * longest;
            let bound = self.rules.bound();
            let most = match self.rules.longest() {
                // There is a result with so many.
                None => bound - 1,
                Some(_) => 4 * bound + 1000,
            };
            if !matches!(self.least_loss.recover_down_to(length, most), Ok(true)) {
                return self.rules_alone();
            }
            let bound = self.least_loss.bound();
            let far = bound + bound / 4 + NOISE;
            waits = self.rules.bound() > if waits { bound } else { far };
            if waits {
                continue;
            }
            match self.rules.recover_down_to(length, far) {
                Ok(done) => waits = !done,
                Err(failure) => return self.least_loss_alone(failure),
            }
            let by_rules = self.rules.bound();
            if !waits && bound > by_rules + by_rules / 16 + NOISE {
                return self.rules_alone();
            }
        }
    }

    /// Once the search for places of least loss has come to its end.
    fn rules_at_last(&mut self) -> Result<Placement, Failure> {
        match self.rules.recover_down_to(0.0, self.least_loss.bound()) {
            Ok(true) => Ok(Placement::ByRules),
            Ok(false) => Ok(Placement::LeastLoss),
            Err(failure) if is_too_short(&failure) => Ok(Placement::LeastLoss),
            Err(failure) => Err(failure),
        }
    }

    fn rules_alone(&mut self) -> Result<Placement, Failure> {
        self.rules.recover_down_to(0.0, usize::MAX)?;
        Ok(Placement::ByRules)
    }

    /// After the rules have failed: places of least loss may exist where these find none.
    fn least_loss_alone(&mut self, failure: Failure) -> Result<Placement, Failure> {
        let most = MOST_VERTICES_PER_SEGMENT;
        let ends = is_too_short(&failure) && self.least_loss.recover_down_to(0.0, most) == Ok(true);
        if ends {
            Ok(Placement::LeastLoss)
        } else {
            Err(failure)
        }
    }
}

/// Whether a recovery found no place for a point.
fn is_too_short(failure: &Failure) -> bool {
    use GaveUp::{SegmentTooShort, SegmentsTooClose};
    matches!(
        failure,
        Failure::GaveUp(SegmentTooShort { .. } | SegmentsTooClose { .. })
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::delaunay::delaunay;
    use crate::exchange::Segment;
    use crate::mesh::Incidence;
    use crate::plc::Complex;
    use crate::predicate::{DoublePoints, PointStore};
    use crate::recover::segments::Subsegments;

    /// Layers of parallel rods, those of each across those of the one below.
    fn rods(n: u32) -> (DoublePoints, Complex) {
        let (mut vertices, mut segments) = (Vec::new(), Vec::new());
        for (layer, i) in (0..4u32).flat_map(|layer| (0..n).map(move |i| (layer, i))) {
            let (at, z) = (
                f64::from(i) + 0.1 * f64::from((i * i + layer) % 5),
                0.35 * f64::from(layer),
            );
            for end in [-0.5, f64::from(n) + 0.25 * f64::from((i + layer) % 3)] {
                vertices.push(if layer % 2 == 0 {
                    [end, at, z]
                } else {
                    [at, end, z]
                });
            }
            let ends = [vertices.len() - 2, vertices.len() - 1].map(VertexId::new);
            segments.push(Segment { ends, marker: 0 });
        }
        let complex = Complex {
            segments,
            ..Complex::default()
        };
        (DoublePoints::new(vertices), complex)
    }

    #[test]
    fn the_result_is_that_of_the_better_one() {
        for n in [4, 9, 14] {
            let (points, complex) = rods(n);
            let all: Vec<VertexId> = (0..points.len()).map(VertexId::new).collect();
            let delaunay = delaunay(&points, &all).expect("rods in space");
            let incidence = Incidence::new(&delaunay.mesh, points.len());
            let is_missing =
                |&[a, b]: &[VertexId; 2]| incidence.tet_at_edge(&delaunay.mesh, a, b).is_none();
            let subsegments = Subsegments::new(&complex, points.len());
            let missing: Vec<[VertexId; 2]> = subsegments.all_ends().filter(is_missing).collect();
            assert!(!missing.is_empty());
            let start = Recovered {
                incidence: incidence.clone(),
                delaunay: delaunay.clone(),
                subsegments,
            };
            let alone = |placement| {
                let mut points = points.clone();
                let mut recovery = SegmentRecovery::new(&mut points, start.clone(), placement);
                recovery.enqueue_all(&missing);
                assert_eq!(recovery.recover_down_to(0.0, usize::MAX), Ok(true));
                recovery.bound()
            };
            let both = [Placement::ByRules, Placement::LeastLoss].map(alone);
            let end = recover_best_of_two(&mut points.clone(), start.clone(), &missing, &|_| true);
            let end = end.expect("rods do not touch");
            let count = end.subsegments.steiner_count();
            assert!(
                both.contains(&count) && count <= both[0],
                "{count}, {both:?}"
            );
            for s in 0..complex.segments.len() as u32 {
                let chain: Vec<VertexId> = end.subsegments.chain(s).collect();
                for w in chain.windows(2) {
                    let found = end.incidence.tet_at_edge(&end.delaunay.mesh, w[0], w[1]);
                    assert!(found.is_some(), "a subsegment is missing");
                }
            }
        }
    }
}
