//! Intersections that recovery runs into.

use super::{Names, displays_with_ids};
use crate::mesh::VertexId;

/// Parts of the input that intersect. Vertex ids count from 0; facets are indices into
/// [`crate::exchange::Plc::facets`].
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum InvalidPlc {
    /// A vertex in the interior of a segment.
    VertexOnSegment {
        /// The ends of the segment.
        segment: [VertexId; 2],
        /// The vertex.
        vertex: VertexId,
    },
    /// Two segments that cross or overlap.
    SegmentsMeet {
        /// The ends of both.
        segments: [[VertexId; 2]; 2],
    },
    /// A vertex in the interior of a polygon that does not have it.
    VertexOnPolygon {
        /// The facets of the polygon.
        facets: Vec<usize>,
        /// The vertex.
        vertex: VertexId,
    },
    /// A segment that passes through the interior of a polygon.
    SegmentThroughPolygon {
        /// The facets of the polygon.
        facets: Vec<usize>,
        /// The ends of the segment.
        segment: [VertexId; 2],
    },
    /// Two polygons that intersect.
    PolygonsIntersect {
        /// The facets of the one.
        first: Vec<usize>,
        /// The facets of the other.
        second: Vec<usize>,
    },
}

impl InvalidPlc {
    /// The lists of facets in it.
    pub(super) fn facets_mut(&mut self) -> Vec<&mut Vec<usize>> {
        match self {
            InvalidPlc::VertexOnSegment { .. } | InvalidPlc::SegmentsMeet { .. } => Vec::new(),
            InvalidPlc::VertexOnPolygon { facets, .. }
            | InvalidPlc::SegmentThroughPolygon { facets, .. } => vec![facets],
            InvalidPlc::PolygonsIntersect { first, second } => vec![first, second],
        }
    }

    pub(super) fn text(&self, names: Names) -> String {
        match self {
            InvalidPlc::VertexOnSegment { segment, vertex } => format!(
                "vertex {} lies in the interior of segment {}",
                names.vertex(*vertex),
                names.edge(*segment)
            ),
            InvalidPlc::SegmentsMeet { segments: [a, b] } => format!(
                "segments {} and {} intersect",
                names.edge(*a),
                names.edge(*b)
            ),
            InvalidPlc::VertexOnPolygon { facets, vertex } => format!(
                "vertex {} lies in the interior of {}, which does not have it",
                names.vertex(*vertex),
                names.facets(facets)
            ),
            InvalidPlc::SegmentThroughPolygon { facets, segment } => format!(
                "segment {} passes through {}",
                names.edge(*segment),
                names.facets(facets)
            ),
            InvalidPlc::PolygonsIntersect { first, second } => {
                format!(
                    "{} intersects {}",
                    names.facets(first),
                    names.facets(second)
                )
            }
        }
    }
}

displays_with_ids!(InvalidPlc);
