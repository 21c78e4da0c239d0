//! What the check finds: errors of single facets, conflicts of two parts, and notes on what is unusual but allowed.

use crate::exchange::Plc;
use crate::mesh::VertexId;
use crate::plc::{EdgeName, FacetName, PlcError, VertexName};
use serde::Serialize;

/// A part of a PLC that can be in conflict with another.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Part {
    /// A facet, by its index in [`Plc::facets`], with all its vertices and edges.
    Facet(usize),
    /// A segment, by its index in [`Plc::segments`], that is not an edge of any facet.
    Segment(usize),
    /// A vertex that belongs to no facet and no segment.
    Vertex(VertexId),
}

impl Part {
    /// The facet, if it is one.
    pub fn facet(self) -> Option<usize> {
        match self {
            Part::Facet(index) => Some(index),
            Part::Segment(_) | Part::Vertex(_) => None,
        }
    }

    /// The part in a message.
    pub fn name(self, plc: &Plc) -> String {
        match self {
            Part::Facet(index) => FacetName::new(plc, index).to_string(),
            Part::Segment(index) => {
                format!("segment {}", EdgeName::new(plc, plc.segments[index].ends))
            }
            Part::Vertex(v) => format!("isolated vertex {}", VertexName::new(plc, v)),
        }
    }
}

/// How two parts are in conflict. Vertices are the first with their coordinates; edges have increasing ends.
///
/// Two parts can intersect in many places and ways; the kind is that of a place where they do worst, in the order given
/// here.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Kind {
    /// They are the same facet.
    SameFacet,
    /// Their common part has an area.
    FacetsOverlap,
    /// They intersect in a line that is an edge of neither.
    FacetsCross,
    /// An edge of the first lies, at least in part, inside the second, which does not have it.
    EdgeInFacet {
        /// The edge.
        edge: [VertexId; 2],
    },
    /// Two edges are collinear and overlap, but are not the same.
    EdgesOverlap {
        /// That of the first part, and that of the second.
        edges: [[VertexId; 2]; 2],
    },
    /// The first part, a segment, passes through the second.
    EdgeThroughFacet {
        /// The segment.
        edge: [VertexId; 2],
    },
    /// A vertex of the first lies inside the second, which does not have it.
    VertexInFacet {
        /// The vertex.
        vertex: VertexId,
    },
    /// Two edges have an interior point in common.
    EdgesCross {
        /// That of the first part, and that of the second.
        edges: [[VertexId; 2]; 2],
    },
    /// A vertex of the first lies in the interior of an edge of the second.
    VertexOnEdge {
        /// The vertex.
        vertex: VertexId,
        /// The edge.
        edge: [VertexId; 2],
    },
}

impl Kind {
    /// A word for it, as in JSON.
    pub fn word(&self) -> &'static str {
        match self {
            Kind::SameFacet => "same-facet",
            Kind::FacetsOverlap => "facets-overlap",
            Kind::FacetsCross => "facets-cross",
            Kind::EdgeInFacet { .. } => "edge-in-facet",
            Kind::EdgesOverlap { .. } => "edges-overlap",
            Kind::EdgeThroughFacet { .. } => "edge-through-facet",
            Kind::VertexInFacet { .. } => "vertex-in-facet",
            Kind::EdgesCross { .. } => "edges-cross",
            Kind::VertexOnEdge { .. } => "vertex-on-edge",
        }
    }

    /// The vertex in question, if there is one.
    pub fn vertex(&self) -> Option<VertexId> {
        match *self {
            Kind::VertexInFacet { vertex } | Kind::VertexOnEdge { vertex, .. } => Some(vertex),
            _ => None,
        }
    }

    /// The edges in question.
    pub fn edges(&self) -> Vec<[VertexId; 2]> {
        match *self {
            Kind::EdgeInFacet { edge }
            | Kind::EdgeThroughFacet { edge }
            | Kind::VertexOnEdge { edge, .. } => vec![edge],
            Kind::EdgesOverlap { edges } | Kind::EdgesCross { edges } => edges.to_vec(),
            _ => Vec::new(),
        }
    }
}

/// Two parts that intersect elsewhere than in vertices and edges that both have.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Conflict {
    /// How.
    pub kind: Kind,
    /// The two parts: first the one that has the vertex or the first edge of [`Conflict::kind`]; of two facets of equal
    /// roles, that of the lower index.
    pub parts: [Part; 2],
    /// A point of the intersection: computed exactly, then each coordinate rounded to a double next to it.
    pub point: [f64; 3],
    /// Whether these two parts can be made to fit without a new vertex ([`crate::repair`]).
    pub repairable: bool,
}

impl Conflict {
    /// The message, with vertices and facets numbered as in the user's file.
    pub fn describe(&self, plc: &Plc) -> String {
        let [first, second] = self.parts.map(|part| part.name(plc));
        // A segment or an isolated vertex is its own edge or vertex.
        let of_first = match self.parts[0] {
            Part::Facet(_) => format!(" of {first}"),
            _ => String::new(),
        };
        let of_second = match self.parts[1] {
            Part::Facet(_) => format!(" of {second}"),
            _ => String::new(),
        };
        let edge = |ends| EdgeName::new(plc, ends);
        let vertex = |v| VertexName::new(plc, v);
        let what = match self.kind {
            Kind::SameFacet => format!("{first} and {second} are the same"),
            Kind::FacetsOverlap => format!("{first} and {second} overlap"),
            Kind::FacetsCross => format!("{first} and {second} cross"),
            Kind::EdgeInFacet { edge: e } => {
                let e = edge(e);
                format!("edge {e}{of_first} lies inside {second}, which does not have it")
            }
            Kind::EdgesOverlap { edges: [e, f] } => {
                let (e, f) = (edge(e), edge(f));
                format!("edge {e}{of_first} and edge {f}{of_second} overlap")
            }
            Kind::EdgeThroughFacet { edge: e } => {
                format!("edge {}{of_first} passes through {second}", edge(e))
            }
            Kind::VertexInFacet { vertex: v } => {
                let v = vertex(v);
                format!("vertex {v}{of_first} lies inside {second}, which does not have it")
            }
            Kind::EdgesCross { edges: [e, f] } => {
                let (e, f) = (edge(e), edge(f));
                format!("edge {e}{of_first} and edge {f}{of_second} cross")
            }
            Kind::VertexOnEdge { vertex: v, edge: e } => {
                let (v, e) = (vertex(v), edge(e));
                format!("vertex {v}{of_first} lies on edge {e}{of_second}")
            }
        };
        let [x, y, z] = self.point;
        format!("{what}, at ({x}, {y}, {z})")
    }
}

/// What is unusual in a PLC, but allowed.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Notes {
    /// Vertices with the coordinates of an earlier one, and that one: they are taken for one vertex.
    pub duplicate_vertices: Vec<[VertexId; 2]>,
    /// Vertices that no facet and no segment refers to.
    pub unused_vertices: Vec<VertexId>,
    /// Edges with a facet on one side only: the surface is open there.
    pub open_edges: Vec<[VertexId; 2]>,
    /// Edges with facets on more than two sides, and how many. An edge inside a facet has it on both sides.
    pub branching_edges: Vec<([VertexId; 2], usize)>,
}

/// Everything that the check finds.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Findings {
    /// Facets and segments that are not valid for themselves, and coordinates that are not finite. Such facets take no
    /// part in the search for conflicts.
    pub errors: Vec<PlcError>,
    /// The pairs of parts that are in conflict, each once, by their indices.
    pub conflicts: Vec<Conflict>,
    /// Whether the search was ended when the wanted number of conflicts had been found, so that there may be more.
    pub stopped: bool,
    /// What is unusual.
    pub notes: Notes,
}

impl Findings {
    /// Whether the PLC is valid.
    pub fn is_valid(&self) -> bool {
        self.errors.is_empty() && self.conflicts.is_empty()
    }

    /// Whether all that is wrong is what [`crate::repair`] mends, as far as the search went.
    pub fn is_repairable(&self) -> bool {
        self.errors.iter().all(PlcError::is_repairable)
            && self.conflicts.iter().all(|conflict| conflict.repairable)
    }
}
