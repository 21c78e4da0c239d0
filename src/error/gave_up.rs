//! Outcomes that are the algorithm's.

use super::{Names, displays_with_ids};
use crate::exchange::Plc;
use crate::mesh::VertexId;

/// Outcomes that are the algorithm's, not (or not provably) the input's.
#[derive(Clone, PartialEq, Debug)]
pub enum GaveUp {
    /// A segment cannot be divided further in the store's coordinates.
    SegmentTooShort {
        /// The ends of the segment.
        segment: [VertexId; 2],
        /// The vertex nearest to it.
        nearest: Option<Nearest>,
    },
    /// A segment, or all together, would need too many Steiner points: usually vertices or other segments are as near
    /// to one as rounding.
    TooManySteinerPoints {
        /// The ends of the segment.
        segment: [VertexId; 2],
        /// The number of Steiner points by now.
        points: usize,
        /// The vertex nearest to the segment.
        nearest: Option<Nearest>,
    },
    /// Two segments do not intersect, but come so close that a Steiner point on the one, rounded, lies on the other.
    SegmentsTooClose {
        /// The ends of both.
        segments: [[VertexId; 2]; 2],
    },
    /// A polygon that is flat only to rounding has no CDT that the algorithm can find without further Steiner points.
    NotFlat {
        /// The facets of the polygon.
        facets: Vec<usize>,
        /// What could not be done.
        reason: NotFlatReason,
    },
    /// Float flips ended without the polygon: some crossing tetrahedra are left, and no flip on the queue can be done.
    Stuck {
        /// The facets of the polygon.
        facets: Vec<usize>,
        /// The crossing tetrahedra that are left.
        crossing: usize,
        /// The region, to try again; see [`Failure::region`](super::Failure::region).
        region: Box<Plc>,
    },
    /// Flips ended with a face in the region that is not locally Delaunay.
    NotDelaunay {
        /// The facets of the polygon.
        facets: Vec<usize>,
        /// The faces.
        faces: usize,
        /// The region, to try again; see [`Failure::region`](super::Failure::region).
        region: Box<Plc>,
    },
    /// An event came off the exact flip queue that cannot be performed. This cannot happen for a flat polygon in an
    /// edge-protected PLC: the PLC is not valid near the polygon, or there is a bug in tetflip.
    FlipOrder {
        /// The facets of the polygon.
        facets: Vec<usize>,
        /// The region, to try again; see [`Failure::region`](super::Failure::region).
        region: Box<Plc>,
    },
    /// Flips by rounded predicates ended with tetrahedra that are flat or inside out.
    Inverted {
        /// The facets of the polygon.
        facets: Vec<usize>,
        /// The tetrahedra.
        tets: usize,
        /// The region, to try again; see [`Failure::region`](super::Failure::region).
        region: Box<Plc>,
    },
    /// Flips in rounded order removed triangles of polygons that had been inserted before.
    Displaced {
        /// The facets of the polygon.
        facets: Vec<usize>,
        /// The triangles.
        triangles: usize,
        /// The region, to try again; see [`Failure::region`](super::Failure::region).
        region: Box<Plc>,
    },
    /// Flips in rounded order were stopped, because there were more than there can be.
    Endless {
        /// The facets of the polygon.
        facets: Vec<usize>,
        /// The region, to try again; see [`Failure::region`](super::Failure::region).
        region: Box<Plc>,
    },
}

/// A vertex near to a segment.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Nearest {
    /// The vertex, which is no end of the segment.
    pub vertex: VertexId,
    /// Its distance from the segment, up to rounding.
    pub distance: f64,
}

impl Nearest {
    fn text(self, names: Names) -> String {
        let vertex = names.vertex(self.vertex);
        format!(
            ": the distance of vertex {vertex} from it is {:e}",
            self.distance
        )
    }
}

/// What stopped the insertion of a polygon that is flat only to rounding.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum NotFlatReason {
    /// The mesh does not tell on which side of an edge the polygon lies.
    AmbiguousSide,
    /// The two cavities triangulate the polygon differently, or flips leave a face that is not locally Delaunay
    /// (paper, Fig. 4).
    Incompatible,
    /// A segment crosses it, because of rounding only.
    CrossedBySegment {
        /// The ends of the segment.
        segment: [VertexId; 2],
    },
    /// It crosses another polygon, because of rounding only.
    CrossedByPolygon {
        /// The facets of the other polygon.
        facets: Vec<usize>,
    },
}

impl GaveUp {
    /// The lists of facets in it.
    pub(super) fn facets_mut(&mut self) -> Vec<&mut Vec<usize>> {
        match self {
            GaveUp::SegmentTooShort { .. }
            | GaveUp::TooManySteinerPoints { .. }
            | GaveUp::SegmentsTooClose { .. } => Vec::new(),
            GaveUp::NotFlat { facets, reason } => match reason {
                NotFlatReason::CrossedByPolygon { facets: others } => vec![facets, others],
                _ => vec![facets],
            },
            GaveUp::Stuck { facets, .. }
            | GaveUp::NotDelaunay { facets, .. }
            | GaveUp::FlipOrder { facets, .. }
            | GaveUp::Inverted { facets, .. }
            | GaveUp::Displaced { facets, .. }
            | GaveUp::Endless { facets, .. } => vec![facets],
        }
    }

    pub(super) fn text(&self, names: Names) -> String {
        match self {
            GaveUp::SegmentTooShort { segment, nearest } => format!(
                "segment {} cannot be divided any further{}",
                names.edge(*segment),
                nearest.map(|near| near.text(names)).unwrap_or_default()
            ),
            GaveUp::TooManySteinerPoints {
                segment,
                points,
                nearest,
            } => format!(
                "{points} Steiner points are not enough for segment {} and others{}",
                names.edge(*segment),
                nearest.map(|near| near.text(names)).unwrap_or_default()
            ),
            GaveUp::SegmentsTooClose { segments: [a, b] } => format!(
                "segments {} and {} come too close for rounded Steiner points",
                names.edge(*a),
                names.edge(*b)
            ),
            GaveUp::NotFlat { facets, reason } => format!(
                "polygon not exactly flat, {}: {}",
                reason.text(names),
                names.facets(facets)
            ),
            GaveUp::Stuck {
                facets, crossing, ..
            } => format!(
                "flips with rounded times stuck, {crossing} crossing tetrahedra left: {}",
                names.facets(facets)
            ),
            GaveUp::NotDelaunay { facets, faces, .. } => format!(
                "flips left {faces} faces that are not locally Delaunay: {}",
                names.facets(facets)
            ),
            GaveUp::FlipOrder { facets, .. } => format!(
                "an exactly ordered flip is impossible (intersections, or a bug): {}",
                names.facets(facets)
            ),
            GaveUp::Inverted { facets, tets, .. } => format!(
                "flips by rounded predicates made {tets} flat or inverted tetrahedra: {}",
                names.facets(facets)
            ),
            GaveUp::Displaced {
                facets, triangles, ..
            } => format!(
                "flips with rounded times removed {triangles} triangles of other facets: {}",
                names.facets(facets)
            ),
            GaveUp::Endless { facets, .. } => format!(
                "flips with rounded times do not come to an end: {}",
                names.facets(facets)
            ),
        }
    }
}

impl NotFlatReason {
    fn text(&self, names: Names) -> String {
        match self {
            NotFlatReason::AmbiguousSide => "its sides are ambiguous at an edge".to_owned(),
            NotFlatReason::Incompatible => {
                "its two sides need incompatible triangulations".to_owned()
            }
            NotFlatReason::CrossedBySegment { segment } => {
                format!("segment {} crosses it after rounding", names.edge(*segment))
            }
            NotFlatReason::CrossedByPolygon { facets } => format!(
                "it crosses another one after rounding ({})",
                names.facets(facets)
            ),
        }
    }
}

displays_with_ids!(GaveUp);
displays_with_ids!(NotFlatReason);
