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
//! Each missing subsegment is split (`split.rs`), the longest first (`recovery.rs`).
//!
//! # Few points
//! Which points are inserted is a choice. Two ways are tried side by side until it is clear which one needs fewer
//! points (`best_of_two.rs`): the place that the rules of `split.rs` say, and the place that destroys the fewest other
//! subsegments (`least_loss.rs`). In the end, points that turn out unnecessary are removed (`prune.rs`).

mod best_of_two;
mod conflict_intervals;
mod inner_edges;
mod least_loss;
mod obstruction;
mod prune;
mod recovery;
mod segment_index;
mod split;
mod straight_walk;
mod subsegments;
mod why_missing;

use crate::delaunay::Delaunay;
use crate::error::Failure;
use crate::mesh::{Incidence, VertexId};
use crate::plc::Complex;
use crate::predicate::GrowingStore;
use best_of_two::recover_best_of_two;
pub use recovery::{Changes, GoOn};
use recovery::{Placement, Recovered, SegmentRecovery};
pub(crate) use segment_index::SegmentIndex;
pub(super) use split::angle_measure;
use straight_walk::{Ahead, look_ahead};
pub use subsegments::Subsegments;

/// Inserts Steiner points into the Delaunay tetrahedralization of the complex's vertices until every segment is there.
/// `go_on` is told, again and again, how many will be needed at least.
///
/// # Errors
/// [`InvalidPlc`](crate::error::InvalidPlc) where a vertex lies on a segment;
/// [`SegmentTooShort`](crate::error::GaveUp::SegmentTooShort) where a segment cannot be divided any more in the store's
/// coordinates, as happens where segments or facets intersect; [`Failure::Stopped`] if `go_on` says so. The
/// tetrahedralization may then be gone.
pub fn recover_segments<P: GrowingStore + Clone>(
    complex: &Complex,
    points: &mut P,
    delaunay: &mut Delaunay,
    go_on: &GoOn<'_>,
) -> Result<(Subsegments, Incidence), Failure> {
    let first = points.len();
    let subsegments = Subsegments::new(complex, first);
    let incidence = Incidence::new(&delaunay.mesh, first);
    let missing = |&[a, b]: &[VertexId; 2]| {
        let start = incidence.tet_at(a).expect("every vertex is in the mesh");
        !matches!(
            look_ahead(points, &delaunay.mesh, start, a, b),
            Ahead::Edge(_)
        )
    };
    let missing: Vec<[VertexId; 2]> = subsegments.all_ends().filter(missing).collect();
    if missing.is_empty() {
        return Ok((subsegments, incidence));
    }
    let start = Recovered {
        delaunay: std::mem::take(delaunay),
        incidence,
        subsegments,
    };
    let recovered = recover_best_of_two(points, start, &missing, go_on)?;
    points.truncate(first);
    recovered.subsegments.push_all(points);
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
    /// What their insertion has changed.
    pub changes: Changes,
}

/// Inserts more Steiner points, and those with which segments are recovered that these destroy, into a Delaunay
/// tetrahedralization that has all segments.
///
/// # Errors
/// The same as [`recover_segments`].
pub fn add_steiner_points<P: GrowingStore>(
    requests: &[Request],
    points: &mut P,
    delaunay: &mut Delaunay,
    subsegments: &mut Subsegments,
    incidence: &mut Incidence,
) -> Result<Added, Failure> {
    let start = Recovered {
        delaunay: std::mem::take(delaunay),
        incidence: std::mem::take(incidence),
        subsegments: std::mem::take(subsegments),
    };
    let mut recovery = SegmentRecovery::new(points, start, Placement::ByRules);
    recovery.changes = Some(Changes::default());
    let requests = requests.iter();
    let vertices: Result<Vec<_>, Failure> = requests.map(|&r| recovery.add(r)).collect();
    let recovered =
        vertices.and_then(|vertices| recovery.recover_down_to(0.0, usize::MAX).map(|_| vertices));
    let changes = recovery.changes.take().unwrap_or_default();
    let end = recovery.finish();
    *delaunay = end.delaunay;
    *subsegments = end.subsegments;
    *incidence = end.incidence;
    Ok(Added {
        vertices: recovered?,
        changes,
    })
}
