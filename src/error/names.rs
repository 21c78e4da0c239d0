//! What vertices, facets and points are called in messages: as the user's file numbers them or, where no file is at
//! hand, by their ids. Each error has one text, which is written with either.

use crate::exchange::Plc;
use crate::mesh::VertexId;
use crate::plc::{EdgeName, FacetName, VertexName};
use std::fmt::Display;

/// Names for one input, or ids.
#[derive(Clone, Copy)]
pub(super) struct Names<'a>(Option<&'a Plc>);

impl<'a> Names<'a> {
    /// Ids, from 0.
    pub const IDS: Names<'static> = Names(None);

    /// How many facets of a polygon are named.
    const FACETS: usize = 4;

    /// How many edges of a list are named.
    const EDGES: usize = 20;

    /// The numbers of the file that `plc` was read from.
    pub fn of(plc: &'a Plc) -> Names<'a> {
        Names(Some(plc))
    }

    /// A vertex.
    pub fn vertex(self, v: VertexId) -> String {
        match self.0 {
            Some(plc) => VertexName::new(plc, v).to_string(),
            None => v.to_string(),
        }
    }

    /// An edge or a segment.
    pub fn edge(self, ends: [VertexId; 2]) -> String {
        match self.0 {
            Some(plc) => EdgeName::new(plc, ends).to_string(),
            None => format!("{}-{}", ends[0], ends[1]),
        }
    }

    /// A triangle.
    pub fn triangle(self, corners: [VertexId; 3]) -> String {
        corners.map(|v| self.vertex(v)).join("-")
    }

    /// The first edges of a list.
    pub fn edges(self, edges: &[[VertexId; 2]]) -> String {
        let names = edges.iter().map(|&e| self.edge(e));
        list(names, edges.len(), Names::EDGES)
    }

    /// The facets of a polygon.
    pub fn facets(self, facets: &[usize]) -> String {
        let name = |&f: &usize| match self.0 {
            Some(plc) if f < plc.facets.len() => FacetName::new(plc, f).to_string(),
            _ => format!("facet {f}"),
        };
        list(facets.iter().map(name), facets.len(), Names::FACETS)
    }

    /// A point of a list of hole points or region points, with its coordinates in full where they are known.
    pub fn point(self, kind: PointKind, index: usize) -> String {
        let Some(plc) = self.0 else {
            return format!("{kind} point {index}");
        };
        let point = match kind {
            PointKind::Hole => plc.holes.get(index).copied(),
            PointKind::Region => plc.regions.get(index).map(|r| r.point),
        };
        let number = index + plc.first_index.min(1) as usize;
        match point {
            Some(point) => format!("{kind} point {number} {}", Coordinates(point)),
            None => format!("{kind} point {number}"),
        }
    }
}

/// The first `most` of `count` names, and how many more there are.
fn list(names: impl Iterator<Item = String>, count: usize, most: usize) -> String {
    let names: Vec<String> = names.take(most).collect();
    match count.saturating_sub(most) {
        0 => names.join(", "),
        more => format!("{} and {more} more", names.join(", ")),
    }
}

/// Which list a point is in.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum PointKind {
    /// A point in a part of the domain that is to be removed.
    Hole,
    /// A point that names a region.
    Region,
}

impl Display for PointKind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.pad(match self {
            PointKind::Hole => "hole",
            PointKind::Region => "region",
        })
    }
}

/// Coordinates in a message: in full, so that they are read back as the same doubles.
pub(crate) struct Coordinates(pub [f64; 3]);

impl Display for Coordinates {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let [x, y, z] = self.0;
        write!(f, "({x}, {y}, {z})")
    }
}
