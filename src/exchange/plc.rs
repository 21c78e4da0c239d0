//! The input as files hold it: vertices, facets made of polygons, floating segments, hole points, region points.

use crate::mesh::VertexId;

/// A piecewise linear complex as it was given, before any check.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Plc {
    /// The number of the first vertex in the file, in most formats 0 or 1; ids in this struct always count from 0.
    pub first_index: u32,
    /// The numbers of the vertices in the file, if they are not successive from [`Plc::first_index`] on; otherwise
    /// empty.
    pub numbers: Vec<i64>,
    /// Finite coordinates.
    pub vertices: Vec<[f64; 3]>,
    /// The attributes of the vertices.
    pub attributes: Attributes,
    /// The markers of the vertices, 0 for none; empty if no vertex has one.
    pub vertex_markers: Vec<i64>,
    /// The facets.
    pub facets: Vec<Facet>,
    /// The facets of the input that each facet comes from, if this PLC is a repaired one ([`crate::repair`]); empty for
    /// the input itself.
    pub origins: Vec<Vec<usize>>,
    /// Segments that belong to no facet (`.edge` files, two-vertex facets).
    pub segments: Vec<Segment>,
    /// A point in every part of the domain that is to be removed.
    pub holes: Vec<[f64; 3]>,
    /// Points that name regions.
    pub regions: Vec<Region>,
    /// What the file calls the facets with a marker (solids of STL, groups of OBJ), in the order of the file.
    pub marker_names: Vec<(i64, String)>,
}

impl Plc {
    /// The facets of the input that some facets come from, sorted: the facets themselves, unless this PLC is a repaired
    /// one.
    pub(crate) fn of_input(&self, facets: &[usize]) -> Vec<usize> {
        let mut of_input = match self.origins.is_empty() {
            true => facets.to_vec(),
            false => facets
                .iter()
                .flat_map(|&f| self.origins[f].iter().copied())
                .collect(),
        };
        of_input.sort_unstable();
        of_input.dedup();
        of_input
    }
}

/// A row of as many numbers for each vertex.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Attributes {
    /// How many numbers a vertex has.
    pub per_vertex: usize,
    /// The rows, one after the other.
    pub values: Vec<f64>,
}

impl Attributes {
    /// The attributes of vertex `v`.
    pub fn of(&self, v: VertexId) -> &[f64] {
        &self.values[v.index() * self.per_vertex..][..self.per_vertex]
    }
}

/// A planar facet: the area bounded by its polygons, without the parts that hold a hole point.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Facet {
    /// Closed polygons with three or more vertices; floating segments with two; floating vertices with one.
    pub polygons: Vec<Vec<VertexId>>,
    /// A point in every part of the facet that is to be left open.
    pub holes: Vec<[f64; 3]>,
    /// Boundary marker, 0 if none.
    pub marker: i64,
}

/// A segment given for itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Segment {
    /// The two ends.
    pub ends: [VertexId; 2],
    /// Boundary marker, 0 if none.
    pub marker: i64,
}

/// A point that gives its attribute to the region it lies in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Region {
    /// A point inside the region, on no facet.
    pub point: [f64; 3],
    /// The attribute of the region's tetrahedra.
    pub attribute: f64,
    /// A bound on tetrahedron volumes for mesh refinement, which this crate does not do; kept, not used.
    pub max_volume: Option<f64>,
}
