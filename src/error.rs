//! The ways in which a run can end without a mesh. Bad input and an algorithm that gave up are different things, and
//! both name the vertices and facets in question.

use crate::delaunay::DelaunayError;
use crate::exchange::Plc;
use crate::mesh::VertexId;
use crate::plc::{EdgeName, FacetName, PlcError, VertexName};

/// Why there is no tetrahedralization.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum Failure {
    /// The vertices do not span space.
    #[error(transparent)]
    Delaunay(#[from] DelaunayError),
    /// The input is no PLC: one of its facets or segments is not what it must be.
    #[error("invalid PLC: {0}")]
    Plc(#[from] PlcError),
    /// The input is no PLC: parts of it intersect.
    #[error("invalid PLC: {0}")]
    Invalid(#[from] InvalidPlc),
    /// The algorithm gave up on what may be a valid PLC.
    #[error("gave up: {0}")]
    GaveUp(#[from] GaveUp),
    /// The complex has no polygon of this index.
    #[error("there is no polygon {0}")]
    NoSuchPolygon(usize),
}

impl Failure {
    /// The region of the polygon that flips have failed to insert, as a PLC in which they can be tried again
    /// ([`region_as_plc`](crate::recover::region::region_as_plc)).
    pub fn region(&self) -> Option<&Plc> {
        match self {
            Failure::GaveUp(
                GaveUp::Stuck { region, .. }
                | GaveUp::NotDelaunay { region, .. }
                | GaveUp::FlipOrder { region, .. }
                | GaveUp::Inverted { region, .. }
                | GaveUp::Displaced { region, .. }
                | GaveUp::Endless { region, .. },
            ) => Some(region),
            _ => None,
        }
    }

    /// Whether Steiner points rounded to doubles can be the reason, so that exact ones are worth a try.
    pub fn is_due_to_rounding(&self) -> bool {
        matches!(
            self,
            Failure::GaveUp(
                GaveUp::NotFlat { .. }
                    | GaveUp::SegmentsTooClose { .. }
                    | GaveUp::SegmentTooShort { .. }
                    | GaveUp::TooManySteinerPoints { .. }
            )
        )
    }

    /// The message, with vertices and facets numbered as in the user's file.
    pub fn describe(&self, plc: &Plc) -> String {
        let facets = |list: &[usize]| {
            let names: Vec<String> = list
                .iter()
                .take(4)
                .map(|&i| FacetName::new(plc, i).to_string())
                .collect();
            let more = if list.len() > 4 {
                format!(" and {} more", list.len() - 4)
            } else {
                String::new()
            };
            names.join(", ") + &more
        };
        let edge = |&ends: &[VertexId; 2]| EdgeName::new(plc, ends);
        match self {
            Failure::Invalid(invalid) => match invalid {
                InvalidPlc::VertexOnSegment { segment, vertex } => {
                    let vertex = VertexName::new(plc, *vertex);
                    format!(
                        "invalid PLC: vertex {vertex} lies in the interior of segment {}",
                        edge(segment)
                    )
                }
                InvalidPlc::SegmentsMeet { segments: [a, b] } => {
                    format!(
                        "invalid PLC: segments {} and {} intersect",
                        edge(a),
                        edge(b)
                    )
                }
                InvalidPlc::VertexOnPolygon { facets: f, vertex } => {
                    let vertex = VertexName::new(plc, *vertex);
                    format!(
                        "invalid PLC: vertex {vertex} lies in the interior of {}, which does not have it",
                        facets(f)
                    )
                }
                InvalidPlc::SegmentThroughPolygon { facets: f, segment } => {
                    format!(
                        "invalid PLC: segment {} passes through {}",
                        edge(segment),
                        facets(f)
                    )
                }
                InvalidPlc::PointOnPolygon { .. } | InvalidPlc::RegionsDisagree { .. } => {
                    self.to_string()
                }
                InvalidPlc::PolygonsIntersect { first, second } => {
                    format!(
                        "invalid PLC: {} intersects {}",
                        facets(first),
                        facets(second)
                    )
                }
            },
            Failure::GaveUp(gave_up) => match gave_up {
                GaveUp::SegmentTooShort { segment } => format!(
                    "gave up: segment {} cannot be divided any further; facets probably intersect near it",
                    edge(segment)
                ),
                GaveUp::TooManySteinerPoints { segment } => format!(
                    "gave up: segment {} needs too many Steiner points; probably another edge nearly overlaps it",
                    edge(segment)
                ),
                GaveUp::SegmentsTooClose { segments: [a, b] } => format!(
                    "gave up: segments {} and {} come too close for rounded Steiner points",
                    edge(a),
                    edge(b)
                ),
                GaveUp::NotFlat { facets: f, reason } => {
                    let reason = match reason {
                        NotFlatReason::CrossedBySegment { segment } => {
                            format!("segment {} crosses it after rounding", edge(segment))
                        }
                        NotFlatReason::CrossedByPolygon { facets: other } => {
                            format!("it crosses another one after rounding ({})", facets(other))
                        }
                        _ => reason.to_string(),
                    };
                    format!("gave up: polygon not exactly flat, {reason}: {}", facets(f))
                }
                GaveUp::Stuck {
                    facets: f,
                    crossing,
                    ..
                } => {
                    format!(
                        "gave up: flips with rounded times stuck, {crossing} crossing tetrahedra left: {}",
                        facets(f)
                    )
                }
                GaveUp::NotDelaunay {
                    facets: f, faces, ..
                } => {
                    format!(
                        "gave up: flips left {faces} faces that are not locally Delaunay: {}",
                        facets(f)
                    )
                }
                GaveUp::FlipOrder { facets: f, .. } => {
                    format!(
                        "gave up: an exactly ordered flip is impossible (intersections, or a bug): {}",
                        facets(f)
                    )
                }
                GaveUp::Inverted {
                    facets: f, tets, ..
                } => {
                    format!(
                        "gave up: flips by rounded predicates made {tets} flat or inverted tetrahedra: {}",
                        facets(f)
                    )
                }
                GaveUp::Displaced {
                    facets: f,
                    triangles,
                    ..
                } => {
                    format!(
                        "gave up: flips with rounded times removed {triangles} triangles of other facets: {}",
                        facets(f)
                    )
                }
                GaveUp::Endless { facets: f, .. } => {
                    format!(
                        "gave up: flips with rounded times do not come to an end: {}",
                        facets(f)
                    )
                }
                GaveUp::NothingInside => self.to_string(),
            },
            Failure::Delaunay(_) | Failure::Plc(_) | Failure::NoSuchPolygon(_) => self.to_string(),
        }
    }
}

/// Intersections that recovery runs into. Vertex ids count from 0; facets are indices into [`crate::exchange::Plc::facets`].
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum InvalidPlc {
    /// A vertex in the interior of a segment.
    #[error("vertex {vertex} lies in the interior of segment {}–{}", segment[0], segment[1])]
    VertexOnSegment {
        /// The ends of the segment.
        segment: [VertexId; 2],
        /// The vertex.
        vertex: VertexId,
    },
    /// Two segments that cross or overlap.
    #[error("segments {}–{} and {}–{} intersect", segments[0][0], segments[0][1], segments[1][0], segments[1][1])]
    SegmentsMeet {
        /// The ends of both.
        segments: [[VertexId; 2]; 2],
    },
    /// A vertex in the interior of a polygon that does not have it.
    #[error(
        "vertex {vertex} lies in the interior of the polygon made of facets {facets:?}, which does not contain it"
    )]
    VertexOnPolygon {
        /// The facets of the polygon.
        facets: Vec<usize>,
        /// The vertex.
        vertex: VertexId,
    },
    /// A segment that passes through the interior of a polygon.
    #[error("segment {}–{} passes through the polygon made of facets {facets:?}", segment[0], segment[1])]
    SegmentThroughPolygon {
        /// The facets of the polygon.
        facets: Vec<usize>,
        /// The ends of the segment.
        segment: [VertexId; 2],
    },
    /// A hole point or region point lies on a facet.
    #[error("{kind} point {index} lies on a facet")]
    PointOnPolygon {
        /// "hole" or "region".
        kind: &'static str,
        /// Its index in its list, from 0.
        index: usize,
    },
    /// Two region points lie in one region and give it different attributes.
    #[error("region points {} and {} give different attributes to one region", points[0], points[1])]
    RegionsDisagree {
        /// Their indices, from 0.
        points: [usize; 2],
    },
    /// Two polygons that intersect.
    #[error("the polygons made of facets {first:?} and of facets {second:?} intersect")]
    PolygonsIntersect {
        /// The facets of the one.
        first: Vec<usize>,
        /// The facets of the other.
        second: Vec<usize>,
    },
}

/// Outcomes that are the algorithm's, not (or not provably) the input's.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum GaveUp {
    /// A segment cannot be divided further in the store's coordinates. Usually facets intersect near it.
    #[error("segment {}–{} cannot be divided any further; facets probably intersect near it", segment[0], segment[1])]
    SegmentTooShort {
        /// The ends of the segment.
        segment: [VertexId; 2],
    },
    /// A segment would need too many Steiner points: usually another one runs along it at the distance of rounding.
    #[error("segment {}–{} needs too many Steiner points; probably another edge nearly overlaps it", segment[0], segment[1])]
    TooManySteinerPoints {
        /// The ends of the segment.
        segment: [VertexId; 2],
    },
    /// Two segments do not intersect, but come so close that a Steiner point on the one, rounded, lies on the other.
    #[error("segments {}–{} and {}–{} come too close for rounded Steiner points", segments[0][0], segments[0][1], segments[1][0], segments[1][1])]
    SegmentsTooClose {
        /// The ends of both.
        segments: [[VertexId; 2]; 2],
    },
    /// A polygon that is flat only to rounding has no CDT that the algorithm can find without further Steiner points.
    #[error("the polygon made of facets {facets:?} is not exactly flat: {reason}")]
    NotFlat {
        /// The facets of the polygon.
        facets: Vec<usize>,
        /// What could not be done.
        reason: NotFlatReason,
    },
    /// Float flips ended without the polygon: some crossing tetrahedra are left, and no flip on the queue can be done.
    #[error(
        "flips with rounded times got stuck on the polygon made of facets {facets:?}, {crossing} crossing tetrahedra left"
    )]
    Stuck {
        /// The facets of the polygon.
        facets: Vec<usize>,
        /// The crossing tetrahedra that are left.
        crossing: usize,
        /// The region, to try again; see [`Failure::region`].
        region: Box<Plc>,
    },
    /// Flips ended with a face in the region that is not locally Delaunay.
    #[error(
        "flips on the polygon made of facets {facets:?} left {faces} faces that are not locally Delaunay"
    )]
    NotDelaunay {
        /// The facets of the polygon.
        facets: Vec<usize>,
        /// The faces.
        faces: usize,
        /// The region, to try again; see [`Failure::region`].
        region: Box<Plc>,
    },
    /// An event came off the exact flip queue that cannot be performed. This cannot happen for a flat polygon in an
    /// edge-protected PLC: the PLC is not valid near the polygon, or there is a bug in tetflip.
    #[error(
        "an exactly ordered flip on the polygon made of facets {facets:?} is impossible: intersections, or a bug in tetflip"
    )]
    FlipOrder {
        /// The facets of the polygon.
        facets: Vec<usize>,
        /// The region, to try again; see [`Failure::region`].
        region: Box<Plc>,
    },
    /// Flips by rounded predicates ended with tetrahedra that are flat or inside out.
    #[error(
        "flips by rounded predicates on the polygon made of facets {facets:?} made {tets} flat or inverted tetrahedra"
    )]
    Inverted {
        /// The facets of the polygon.
        facets: Vec<usize>,
        /// The tetrahedra.
        tets: usize,
        /// The region, to try again; see [`Failure::region`].
        region: Box<Plc>,
    },
    /// Flips in rounded order removed triangles of polygons that had been inserted before.
    #[error(
        "flips with rounded times on the polygon made of facets {facets:?} removed {triangles} triangles of others"
    )]
    Displaced {
        /// The facets of the polygon.
        facets: Vec<usize>,
        /// The triangles.
        triangles: usize,
        /// The region, to try again; see [`Failure::region`].
        region: Box<Plc>,
    },
    /// Flips in rounded order were stopped, because there were more than there can be.
    #[error(
        "flips with rounded times on the polygon made of facets {facets:?} do not come to an end"
    )]
    Endless {
        /// The facets of the polygon.
        facets: Vec<usize>,
        /// The region, to try again; see [`Failure::region`].
        region: Box<Plc>,
    },
    /// The surface encloses nothing, so that nothing is left without the convex hull.
    #[error(
        "the facets enclose no volume (an open surface?); keep the convex hull instead (--hull)"
    )]
    NothingInside,
}

/// What stopped the insertion of a polygon that is flat only to rounding.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum NotFlatReason {
    /// The mesh does not tell on which side of an edge the polygon lies.
    #[error("its sides are ambiguous at an edge")]
    AmbiguousSide,
    /// The two cavities triangulate the polygon differently, or flips leave a face that is not locally Delaunay
    /// (paper, Fig. 4).
    #[error("its two sides need incompatible triangulations")]
    Incompatible,
    /// A segment crosses it, because of rounding only.
    #[error("the segment {segment:?} crosses it after rounding")]
    CrossedBySegment {
        /// The ends of the segment.
        segment: [VertexId; 2],
    },
    /// It crosses another polygon, because of rounding only.
    #[error("it crosses the polygon made of facets {facets:?} after rounding")]
    CrossedByPolygon {
        /// The facets of the other polygon.
        facets: Vec<usize>,
    },
}

/// Why a polygon was not deleted. The mesh has the tetrahedra that it had.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum DeletionRefused {
    /// The complex has no polygon of this index.
    #[error("there is no polygon {0}")]
    NoSuchPolygon(usize),
    /// The polygon is not in the mesh: it has not been inserted, or has been deleted already.
    #[error("the polygon made of facets {facets:?} is not in the mesh")]
    NotInserted {
        /// The facets of the polygon.
        facets: Vec<usize>,
    },
    /// There is no CDT of these vertices without the polygon, but with the other constraints.
    #[error("without the polygon made of facets {facets:?} there is no CDT: {obstacle}")]
    NoCdt {
        /// The facets of the polygon.
        facets: Vec<usize>,
        /// What shows it.
        obstacle: Obstacle,
    },
    /// The polygon is flat only to rounding, and flips do not lead to a CDT without it. There may be one.
    #[error(
        "the polygon made of facets {facets:?} is not exactly flat, and flips cannot delete it: {obstacle}"
    )]
    NotFlat {
        /// The facets of the polygon.
        facets: Vec<usize>,
        /// Where they failed.
        obstacle: Obstacle,
    },
}

/// What is in the way of a deletion.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum Obstacle {
    /// This segment, given by its ends, or a part of it would have to vanish.
    #[error("it holds the segment {}–{} in place", .0[0], .0[1])]
    Segment([VertexId; 2]),
    /// A triangle of the polygon made of these facets would have to vanish.
    #[error("it holds the polygon made of facets {0:?} in place")]
    Polygon(Vec<usize>),
    /// The tetrahedra around this triangle, which is not locally Delaunay, cannot be flipped.
    #[error("the triangle {}–{}–{} cannot be flipped", .0[0], .0[1], .0[2])]
    NoFlip([VertexId; 3]),
    /// This triangle would not be locally Delaunay, and it is not its turn to be flipped.
    #[error("the triangle {}–{}–{} would not be locally Delaunay", .0[0], .0[1], .0[2])]
    TooLate([VertexId; 3]),
}
