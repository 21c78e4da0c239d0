//! What can be wrong with a PLC, in the numbering of the user's file.

use crate::exchange::Plc;
use crate::mesh::VertexId;
use std::fmt;

/// A vertex in a message: its id, and its number in the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct VertexName {
    /// The id, from 0.
    pub id: VertexId,
    /// The number in the file, from [`Plc::numbers`] or counted from [`Plc::first_index`].
    pub number: i64,
}

impl VertexName {
    /// The name of a vertex of `plc`.
    pub fn new(plc: &Plc, id: VertexId) -> VertexName {
        let counted = || i64::from(id.0) + i64::from(plc.first_index);
        let number = plc.numbers.get(id.index()).copied();
        VertexName {
            id,
            number: number.unwrap_or_else(counted),
        }
    }
}

impl fmt::Display for VertexName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.number)
    }
}

/// An edge in a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EdgeName(pub [VertexName; 2]);

impl EdgeName {
    /// The name of an edge of `plc`.
    pub fn new(plc: &Plc, ends: [VertexId; 2]) -> EdgeName {
        EdgeName(ends.map(|v| VertexName::new(plc, v)))
    }
}

impl fmt::Display for EdgeName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let EdgeName([a, b]) = self;
        write!(f, "{a}-{b}")
    }
}

/// A facet in a message: its index, and, since files do not number their facets, the corners of its first polygon.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FacetName {
    /// The index in the facets of the input, from 0; of a repaired facet, that of the first facet it comes from
    /// ([`Plc::origins`]).
    pub index: usize,
    /// The index, counted from 1 unless the file counts its vertices from 0.
    pub number: i64,
    /// The corners of the first polygon.
    pub corners: Vec<VertexName>,
}

impl FacetName {
    /// The name of a facet of `plc`.
    pub fn new(plc: &Plc, index: usize) -> FacetName {
        let origin = plc.origins.get(index).and_then(|of| of.first());
        FacetName::with_index(plc, index, origin.copied().unwrap_or(index))
    }

    /// The names of facets of the input, by their indices there; where `plc` is a repaired one, with the corners of the
    /// first facets that come from them. O(n) for n facets.
    pub(crate) fn of_input(plc: &Plc, facets: &[usize]) -> Vec<FacetName> {
        let place = |&f: &usize| match plc.origins.is_empty() {
            true => Some(f),
            false => plc.origins.iter().position(|of| of.contains(&f)),
        };
        let name = |f: &usize| Some(FacetName::with_index(plc, place(f)?, *f));
        facets.iter().filter_map(name).collect()
    }

    /// The facet at a place in `plc` with the index that the input gives it.
    fn with_index(plc: &Plc, place: usize, index: usize) -> FacetName {
        let corners = plc.facets[place].polygons.first();
        FacetName {
            index,
            number: index as i64 + i64::from(plc.first_index.min(1)),
            corners: corners
                .into_iter()
                .flatten()
                .map(|&v| VertexName::new(plc, v))
                .collect(),
        }
    }
}

impl fmt::Display for FacetName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        const SHOWN: usize = 6;
        write!(f, "facet {} (", self.number)?;
        for (i, corner) in self.corners.iter().take(SHOWN).enumerate() {
            write!(f, "{}{corner}", if i == 0 { "" } else { " " })?;
        }
        let more = if self.corners.len() > SHOWN {
            " …"
        } else {
            ""
        };
        write!(f, "{more})")
    }
}

/// Why a [`Plc`] is not a piecewise linear complex. Intersections between different facets are not looked for here.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PlcError {
    /// A coordinate is infinite or not a number.
    #[error("vertex {vertex} has a coordinate that is not finite")]
    VertexNotFinite {
        /// The vertex.
        vertex: VertexName,
    },
    /// A hole point or region point has a coordinate that is infinite or not a number.
    #[error("{kind} point {index} has a coordinate that is not finite")]
    PointNotFinite {
        /// "hole" or "region".
        kind: &'static str,
        /// Its index in its list, from 0.
        index: usize,
    },
    /// A table of vertices has not as many rows as there are vertices.
    #[error("there are {vertices} vertices, but {rows} {what}")]
    RowCount {
        /// What the rows are.
        what: &'static str,
        /// How many rows there are.
        rows: usize,
        /// How many vertices there are.
        vertices: usize,
    },
    /// A corner is not in the list of vertices.
    #[error("{facet} refers to vertex {vertex}, which does not exist")]
    NoSuchVertex {
        /// The facet.
        facet: FacetName,
        /// The id that is out of range.
        vertex: VertexName,
    },
    /// An end of a segment is not in the list of vertices.
    #[error("segment {segment} refers to vertex {vertex}, which does not exist")]
    NoSuchSegmentEnd {
        /// The segment.
        segment: EdgeName,
        /// The id that is out of range.
        vertex: VertexName,
    },
    /// The two ends of a segment are the same point.
    #[error("both ends of segment {segment} are the same point")]
    DegenerateSegment {
        /// The segment.
        segment: EdgeName,
    },
    /// A polygon has no vertex, or the facet no polygon.
    #[error("{facet} has no vertices")]
    Empty {
        /// The facet.
        facet: FacetName,
    },
    /// Two consecutive corners of a polygon are the same point.
    #[error("{facet} has vertex {vertex} twice in a row")]
    RepeatedVertex {
        /// The facet.
        facet: FacetName,
        /// The second of the two.
        vertex: VertexName,
    },
    /// A polygon with three or more corners but fewer than three points.
    #[error("{facet} has a polygon of fewer than three different vertices")]
    TooFewVertices {
        /// The facet.
        facet: FacetName,
    },
    /// All vertices are collinear, or the edges enclose nothing.
    #[error("{facet} has no area")]
    ZeroArea {
        /// The facet.
        facet: FacetName,
    },
    /// The hole points leave nothing of the facet.
    #[error("the hole points of {facet} leave nothing of it")]
    NothingLeft {
        /// The facet.
        facet: FacetName,
    },
    /// A hole point is on an edge, so that the part it names is unknown.
    #[error("hole point {hole} of {facet} lies on edge {edge}")]
    HoleOnEdge {
        /// The facet.
        facet: FacetName,
        /// The index of the hole point in the facet, from 0.
        hole: usize,
        /// The edge.
        edge: EdgeName,
    },
    /// The vertices are not on one plane, nor nearly.
    #[error("{facet} is not planar: vertex {vertex} is {distance:.3e} from the plane of others")]
    NotPlanar {
        /// The facet.
        facet: FacetName,
        /// The vertex that is farthest from the plane.
        vertex: VertexName,
        /// Its distance, rounded.
        distance: f64,
    },
    /// The facet is flat only to rounding, and its projection is too close to degenerate to be divided into triangles.
    #[error("{facet} is not exactly planar and cannot be divided into triangles")]
    NotTriangulated {
        /// The facet.
        facet: FacetName,
    },
    /// Two edges of a facet cross.
    #[error("edges {} and {} of {facet} cross", edges[0], edges[1])]
    EdgesCross {
        /// The facet.
        facet: FacetName,
        /// The edges.
        edges: [EdgeName; 2],
    },
    /// A vertex of a facet is in the interior of an edge of it.
    #[error("vertex {vertex} lies on edge {edge} of {facet}")]
    VertexOnEdge {
        /// The facet.
        facet: FacetName,
        /// The vertex.
        vertex: VertexName,
        /// The edge.
        edge: EdgeName,
    },
    /// Two facets are the same.
    #[error("{first} and {second} are the same")]
    SameFacet {
        /// The one that comes first.
        first: FacetName,
        /// The other.
        second: FacetName,
    },
    /// Two coplanar facets are on the same side of a common edge.
    #[error("{first} and {second} overlap beside their common edge {edge}")]
    FacetsOverlap {
        /// The one that comes first.
        first: FacetName,
        /// The other.
        second: FacetName,
        /// The common edge.
        edge: EdgeName,
    },
}

impl PlcError {
    /// Whether [`crate::repair`] mends this: what has no area or no length is dropped, a repeated corner is left out,
    /// and an edge is divided at the vertex that lies on it.
    pub fn is_repairable(&self) -> bool {
        matches!(
            self,
            PlcError::RepeatedVertex { .. }
                | PlcError::TooFewVertices { .. }
                | PlcError::ZeroArea { .. }
                | PlcError::VertexOnEdge { .. }
                | PlcError::DegenerateSegment { .. }
                | PlcError::SameFacet { .. }
                | PlcError::FacetsOverlap { .. }
        )
    }

    /// The facets in question, by their indices.
    pub fn facets(&self) -> Vec<usize> {
        match self {
            PlcError::VertexNotFinite { .. }
            | PlcError::PointNotFinite { .. }
            | PlcError::RowCount { .. }
            | PlcError::NoSuchSegmentEnd { .. }
            | PlcError::DegenerateSegment { .. } => Vec::new(),
            PlcError::NoSuchVertex { facet, .. }
            | PlcError::Empty { facet }
            | PlcError::RepeatedVertex { facet, .. }
            | PlcError::TooFewVertices { facet }
            | PlcError::ZeroArea { facet }
            | PlcError::NothingLeft { facet }
            | PlcError::HoleOnEdge { facet, .. }
            | PlcError::NotPlanar { facet, .. }
            | PlcError::NotTriangulated { facet }
            | PlcError::EdgesCross { facet, .. }
            | PlcError::VertexOnEdge { facet, .. } => vec![facet.index],
            PlcError::SameFacet { first, second }
            | PlcError::FacetsOverlap { first, second, .. } => vec![first.index, second.index],
        }
    }
}
