//! A PLC as parts made of simplices: the triangles of its facets, in a fixed triangulation, their edges, what floats
//! outside of any area, and the vertices.
//!
//! Facets that are not valid for themselves are named and left out. O(n log n).

use super::findings::Part;
use super::meet::Simplex;
use super::triangulate::triangulate;
use crate::exchange::Plc;
use crate::mesh::VertexId;
use crate::plc::{
    EdgeName, FacetInput, PlcError, Polygon, Projected, Projection, VertexName, representatives,
    undirected,
};
use std::ops::Range;

/// An edge of some parts.
pub(crate) struct Edge {
    /// The ends in increasing order.
    pub ends: [VertexId; 2],
    /// Its owners, a range of [`Parts::edge_owners`].
    pub owners: Range<usize>,
}

/// A part that has an edge.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Owner {
    /// The index of the part.
    pub part: u32,
    /// Whether it declares the edge, which is otherwise a diagonal of its triangulation.
    pub declared: bool,
}

/// The parts of a PLC.
#[derive(Default)]
pub(crate) struct Parts {
    /// How far vertices may be from the planes of their facets.
    pub delta: f64,
    /// The first vertex with the coordinates of each.
    pub representative: Vec<VertexId>,
    /// The valid facets, then the segments that are not edges of those, then the vertices of neither.
    pub parts: Vec<Part>,
    /// The simplices of each part, where none is a face of another: a range of [`Parts::simplices`].
    pub ranges: Vec<Range<usize>>,
    pub simplices: Vec<Simplex>,
    /// Every edge of every simplex once, by its ends.
    pub edges: Vec<Edge>,
    pub edge_owners: Vec<Owner>,
    /// The edges of the polygon of each facet, for facets given twice.
    pub outlines: Vec<Vec<[VertexId; 2]>>,
    /// What is wrong with facets and segments, each for itself.
    pub errors: Vec<PlcError>,
    /// Edges of facets with the number of their sides where there is a facet; increasing. An edge that floats in a
    /// facet has it on both sides.
    pub bounding: Vec<([VertexId; 2], usize)>,
    /// Vertices of facets or segments, valid or not.
    pub used: Vec<bool>,
    /// Where the owners of each vertex begin in the list that follows.
    vertex_starts: Vec<u32>,
    vertex_owners: Vec<u32>,
}

impl Parts {
    /// Takes a PLC apart. Vertices within `delta` of the plane of their facet, along each axis, are on it.
    pub fn new(plc: &Plc, delta: f64) -> Parts {
        let mut parts = Parts {
            delta,
            representative: representatives(&plc.vertices),
            used: vec![false; plc.vertices.len()],
            ..Parts::default()
        };
        let bad_vertices = parts.check_points(plc);
        let mut sides = Vec::new();
        for index in 0..plc.facets.len() {
            if let Err(error) = parts.add_facet(plc, index, &bad_vertices, &mut sides) {
                parts.errors.push(error);
            }
        }
        parts.bounding = counted(sides);
        parts.group_edges();
        let facets = parts.parts.len();
        parts.add_segments(plc, &bad_vertices);
        if parts.parts.len() > facets {
            parts.group_edges();
        }
        parts.add_vertices(plc, &bad_vertices);
        parts.group_vertices();
        parts
    }

    /// The parts that have a vertex.
    pub fn owners_of_vertex(&self, v: VertexId) -> &[u32] {
        let at = |i: usize| self.vertex_starts[i] as usize;
        &self.vertex_owners[at(v.index())..at(v.index() + 1)]
    }

    /// Names coordinates that are not finite, and returns which vertices have such.
    fn check_points(&mut self, plc: &Plc) -> Vec<bool> {
        let infinite = |p: &[f64; 3]| !p.iter().all(|x| x.is_finite());
        let bad: Vec<bool> = plc.vertices.iter().map(infinite).collect();
        for (i, _) in bad.iter().enumerate().filter(|(_, bad)| **bad) {
            let vertex = VertexName::new(plc, VertexId::new(i));
            self.errors.push(PlcError::VertexNotFinite { vertex });
        }
        let holes = plc.holes.iter().enumerate().map(|(i, p)| ("hole", i, p));
        let regions = plc.regions.iter().enumerate();
        let regions = regions.map(|(i, r)| ("region", i, &r.point));
        for (kind, index, point) in holes.chain(regions) {
            if infinite(point) {
                self.errors.push(PlcError::PointNotFinite { kind, index });
            }
        }
        bad
    }

    /// Adds a facet if it is valid. `sides` gets the edges that bound its area.
    fn add_facet(
        &mut self,
        plc: &Plc,
        index: usize,
        bad_vertices: &[bool],
        sides: &mut Vec<[VertexId; 2]>,
    ) -> Result<(), PlcError> {
        for &v in plc.facets[index].polygons.iter().flatten() {
            if let Some(used) = self.used.get_mut(v.index()) {
                *used = true;
            }
            if bad_vertices.get(v.index()) == Some(&true) {
                // Named with the vertex.
                return Ok(());
            }
        }
        let holes = &plc.facets[index].holes;
        if let Some(hole) = holes.iter().position(|p| !p.iter().all(|x| x.is_finite())) {
            let kind = "facet hole";
            return Err(PlcError::PointNotFinite { kind, index: hole });
        }
        let facet = FacetInput::new(plc, index, &self.representative, self.delta)?;
        if !facet.is_area() {
            let simplices = loose_simplices(&facet, None);
            self.add(Part::Facet(index), simplices, Vec::new());
            return Ok(());
        }
        // The edges of a facet that is not valid still close those of its neighbours.
        let polygon = facet
            .polygon()
            .inspect_err(|_| sides.extend(closing_edges(&facet)))?;
        let mut once: Vec<_> = polygon.edges.iter().copied().map(undirected).collect();
        once.sort_unstable();
        sides.extend(&once);
        once.dedup();
        let mut simplices = match (&polygon.edges[..], &facet.polygons[..]) {
            ([_, _, _], [corners]) if corners.len() == 3 => vec![Simplex {
                corners: [corners[0], corners[1], corners[2]],
                declared: [true; 3],
            }],
            _ => triangles(plc, &polygon, &once),
        };
        if facet.polygons.len() > 1 || facet.polygons[0].len() > 3 {
            simplices.extend(loose_simplices(&facet, Some((&polygon, &once))));
        }
        self.add(Part::Facet(index), simplices, once);
        Ok(())
    }

    fn add(&mut self, part: Part, simplices: Vec<Simplex>, outline: Vec<[VertexId; 2]>) {
        let start = self.simplices.len();
        self.simplices.extend(simplices);
        self.parts.push(part);
        self.ranges.push(start..self.simplices.len());
        self.outlines.push(outline);
    }

    /// Segments given for themselves, unless they are edges of facets.
    fn add_segments(&mut self, plc: &Plc, bad_vertices: &[bool]) {
        let mut seen = rustc_hash::FxHashSet::default();
        for (index, segment) in plc.segments.iter().enumerate() {
            let name = EdgeName::new(plc, segment.ends);
            let missing = segment
                .ends
                .iter()
                .find(|v| v.index() >= plc.vertices.len());
            if let Some(&v) = missing {
                let vertex = VertexName::new(plc, v);
                let segment = name;
                self.errors
                    .push(PlcError::NoSuchSegmentEnd { segment, vertex });
                continue;
            }
            segment
                .ends
                .iter()
                .for_each(|v| self.used[v.index()] = true);
            if segment.ends.iter().any(|v| bad_vertices[v.index()]) {
                continue;
            }
            let ends = undirected(segment.ends.map(|v| self.representative[v.index()]));
            if ends[0] == ends[1] {
                let segment = name;
                self.errors.push(PlcError::DegenerateSegment { segment });
                continue;
            }
            let declared = self
                .edges
                .binary_search_by(|e| e.ends.cmp(&ends))
                .is_ok_and(|i| {
                    let owners = &self.edge_owners[self.edges[i].owners.clone()];
                    owners.iter().any(|o| o.declared)
                });
            if !declared && seen.insert(ends) {
                self.add(Part::Segment(index), vec![edge_simplex(ends)], Vec::new());
            }
        }
    }

    /// Vertices of no part.
    fn add_vertices(&mut self, plc: &Plc, bad_vertices: &[bool]) {
        let mut part_of = vec![false; plc.vertices.len()];
        for v in self.simplices.iter().flat_map(|s| s.corners) {
            part_of[v.index()] = true;
        }
        // A vertex of an invalid facet alone is no conflict of its own.
        let mut used = vec![false; plc.vertices.len()];
        for (v, _) in self.used.iter().enumerate().filter(|(_, used)| **used) {
            used[self.representative[v].index()] = true;
        }
        for i in 0..plc.vertices.len() {
            let v = VertexId::new(i);
            let is_own = self.representative[i] == v && !bad_vertices[i];
            if is_own && !part_of[i] && !used[i] {
                self.add(Part::Vertex(v), vec![vertex_simplex(v)], Vec::new());
            }
        }
    }

    /// Lists every edge of every simplex once, with its owners.
    fn group_edges(&mut self) {
        let mut all: Vec<([VertexId; 2], Owner)> = Vec::with_capacity(3 * self.simplices.len());
        for (part, range) in self.ranges.iter().enumerate() {
            for simplex in &self.simplices[range.clone()] {
                for i in 0..3 {
                    let ends = simplex.edge(i);
                    let owner = Owner {
                        part: part as u32,
                        declared: simplex.declared[i],
                    };
                    if ends[0] != ends[1] {
                        all.push((ends, owner));
                    }
                }
            }
        }
        all.sort_unstable();
        all.dedup();
        self.edges.clear();
        for group in all.chunk_by(|e, f| e.0 == f.0) {
            let start = self.edges.last().map_or(0, |e| e.owners.end);
            self.edges.push(Edge {
                ends: group[0].0,
                owners: start..start + group.len(),
            });
        }
        self.edge_owners = all.into_iter().map(|(_, owner)| owner).collect();
    }

    /// Lists the parts of every vertex.
    fn group_vertices(&mut self) {
        let mut all: Vec<(VertexId, u32)> = Vec::with_capacity(3 * self.simplices.len());
        for (part, range) in self.ranges.iter().enumerate() {
            let corners = self.simplices[range.clone()].iter().flat_map(|s| s.corners);
            all.extend(corners.map(|v| (v, part as u32)));
        }
        all.sort_unstable();
        all.dedup();
        let starts = (0..=self.representative.len()).map(VertexId::new);
        let start = |v: VertexId| all.partition_point(|&(w, _)| w < v) as u32;
        self.vertex_starts = starts.map(start).collect();
        self.vertex_owners = all.into_iter().map(|(_, part)| part).collect();
    }
}

fn edge_simplex([a, b]: [VertexId; 2]) -> Simplex {
    Simplex {
        corners: [a, b, b],
        declared: [true; 3],
    }
}

fn vertex_simplex(v: VertexId) -> Simplex {
    Simplex {
        corners: [v; 3],
        declared: [true; 3],
    }
}

/// The triangulation of a polygon whose edges, with increasing ends, are given.
fn triangles(plc: &Plc, polygon: &Polygon, edges: &[[VertexId; 2]]) -> Vec<Simplex> {
    let frame = polygon.frame.map(|v| plc.vertices[v.index()]);
    let (projection, _) = Projection::of(frame).expect("a frame is not collinear");
    let plane = Projected {
        points: &plc.vertices,
        projection,
    };
    let is_edge = |a, b| edges.binary_search(&undirected([a, b])).is_ok();
    let triangles = triangulate(&plane, polygon).into_iter();
    let simplex = |[a, b, c]: [VertexId; 3]| Simplex {
        corners: [a, b, c],
        declared: [is_edge(a, b), is_edge(b, c), is_edge(c, a)],
    };
    triangles.map(simplex).collect()
}

/// The edges and vertices of a facet that its polygon does not have, if it has one.
fn loose_simplices(
    facet: &FacetInput,
    polygon: Option<(&Polygon, &[[VertexId; 2]])>,
) -> Vec<Simplex> {
    let in_polygon =
        |edge: &[VertexId; 2]| polygon.is_some_and(|(_, edges)| edges.binary_search(edge).is_ok());
    let mut edges: Vec<_> = facet.edges().map(undirected).collect();
    edges.retain(|e| !in_polygon(e));
    edges.sort_unstable();
    edges.dedup();
    let mut vertices = facet.polygons.concat();
    vertices.sort_unstable();
    vertices.dedup();
    let mut ends = edges.concat();
    ends.extend(
        polygon
            .into_iter()
            .flat_map(|(f, _)| f.vertices.iter().copied()),
    );
    ends.sort_unstable();
    vertices.retain(|v| ends.binary_search(v).is_err());
    let edges = edges.into_iter().map(edge_simplex);
    edges
        .chain(vertices.into_iter().map(vertex_simplex))
        .collect()
}

/// The edges of a facet's closed polygons.
fn closing_edges(facet: &FacetInput) -> Vec<[VertexId; 2]> {
    let mut edges: Vec<_> = facet.edges().map(undirected).collect();
    edges.sort_unstable();
    edges.dedup();
    edges
}

/// Every item once with its count.
fn counted(mut sides: Vec<[VertexId; 2]>) -> Vec<([VertexId; 2], usize)> {
    sides.sort_unstable();
    let groups = sides.chunk_by(|e, f| e == f);
    groups.map(|group| (group[0], group.len())).collect()
}
