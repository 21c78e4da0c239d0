//! Facets that do not say what is inside, and points that contradict them.

use super::{Names, PointKind, displays_with_ids};
use crate::mesh::VertexId;

/// Why it is not known, or not to be believed, which tetrahedra are in the domain. Edges are ends of segments of the
/// input, the lesser first, in ascending order.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum DomainError {
    /// No facet encloses anything, and none has an open edge: there are no facets with an area, for instance.
    NothingEnclosed,
    /// The surface is open: facets end at these edges with the outside on both sides.
    Open {
        /// The open edges.
        edges: Vec<[VertexId; 2]>,
    },
    /// A hole point removes a part of space into which facets end, so that it may leak from the part that it was
    /// meant for.
    HoleLeaks {
        /// The index of the hole point.
        hole: usize,
        /// The open edges there.
        edges: Vec<[VertexId; 2]>,
    },
    /// A hole point removes a region that a region point names.
    HoleInRegion {
        /// The index of the hole point.
        hole: usize,
        /// The index of the region point.
        region: usize,
    },
    /// The hole points remove everything that the facets enclose.
    HolesLeaveNothing {
        /// The indices of the hole points.
        holes: Vec<usize>,
    },
    /// A hole point or region point lies on a facet.
    PointOnFacet {
        /// Which of them.
        kind: PointKind,
        /// Its index in its list, from 0.
        index: usize,
    },
    /// Two region points lie in one region and give it different attributes.
    RegionsDisagree {
        /// Their indices, from 0.
        points: [usize; 2],
    },
}

impl DomainError {
    /// The open edges in question.
    pub fn open_edges(&self) -> &[[VertexId; 2]] {
        match self {
            DomainError::Open { edges } | DomainError::HoleLeaks { edges, .. } => edges,
            _ => &[],
        }
    }

    pub(super) fn text(&self, names: Names) -> String {
        let hole = |index: usize| names.point(PointKind::Hole, index);
        let region = |index: usize| names.point(PointKind::Region, index);
        match self {
            DomainError::NothingEnclosed => {
                "the facets enclose nothing; --hull keeps the convex hull of the vertices"
                    .to_owned()
            }
            DomainError::Open { edges } => format!(
                "the surface is open: at {} the outside is on both sides of a facet that ends there: {}; --hull keeps \
                 the convex hull of the vertices",
                count_edges(edges),
                names.edges(edges)
            ),
            DomainError::HoleLeaks { hole: index, edges } => format!(
                "{} may leak: the part of space that it removes has facets that end in it, at {}: {}",
                hole(*index),
                count_edges(edges),
                names.edges(edges)
            ),
            DomainError::HoleInRegion { hole: h, region: r } => {
                format!("{} removes the region of {}", hole(*h), region(*r))
            }
            DomainError::HolesLeaveNothing { holes } => {
                let names: Vec<String> = holes.iter().take(4).map(|&h| hole(h)).collect();
                let more = if holes.len() > 4 { ", …" } else { "" };
                let verb = if holes.len() == 1 { "leaves" } else { "leave" };
                format!("{}{more} {verb} nothing of the domain", names.join(", "))
            }
            DomainError::PointOnFacet { kind, index } => {
                format!("{} lies on a facet", names.point(*kind, *index))
            }
            DomainError::RegionsDisagree { points: [a, b] } => format!(
                "{} and {} give different attributes to one region",
                region(*a),
                region(*b)
            ),
        }
    }
}

fn count_edges(edges: &[[VertexId; 2]]) -> String {
    match edges.len() {
        1 => "1 edge".to_owned(),
        count => format!("{count} edges"),
    }
}

displays_with_ids!(DomainError);
