//! The search for simplices of different parts that touch, shared by the check and by the repair of inputs.

use super::contact::{self, Point};
use super::meet::{Simplex, meet};
use super::parts::{Owner, Parts};
use super::tree::{Corners, Simplices};
use crate::exchange::Plc;
use crate::mesh::{Groups, TetMesh, VertexId};
use crate::plc::orient3d;
use rustc_hash::FxHashMap;
use std::ops::ControlFlow;
use std::sync::OnceLock;

/// A simplex of the search, by its index among those of its dimension.
#[derive(Clone, Copy)]
pub(super) enum Face {
    /// A vertex.
    Vertex(VertexId),
    /// An index in [`Parts::edges`].
    Edge(usize),
    /// The part of a triangle.
    Triangle(u32),
}

/// All vertices, edges and triangles of the parts of a PLC.
pub(super) struct Search<'a> {
    plc: &'a Plc,
    pub parts: &'a Parts,
    /// Whether coplanar facets are merged, so that edges between them are none.
    merging: bool,
    corners: Vec<Corners>,
    faces: Vec<Face>,
    /// The first edge and the first triangle.
    starts: [usize; 2],
    /// The simplices of a tetrahedralization; empty if there is none.
    known: Vec<bool>,
    /// The vertices by their coordinates.
    by_place: OnceLock<FxHashMap<[u64; 3], VertexId>>,
}

impl<'a> Search<'a> {
    /// With a tetrahedralization of all vertices, pairs of simplices that it has are left out: they touch in common
    /// vertices and edges only.
    pub fn new(
        plc: &'a Plc,
        parts: &'a Parts,
        merging: bool,
        mesh: Option<&TetMesh>,
    ) -> Search<'a> {
        let vertices = (0..parts.representative.len()).map(VertexId::new);
        let vertices: Vec<_> = vertices
            .filter(|&v| !parts.owners_of_vertex(v).is_empty())
            .collect();
        let mut corners: Vec<_> = vertices.iter().map(|&v| [v; 3]).collect();
        let mut faces: Vec<_> = vertices.into_iter().map(Face::Vertex).collect();
        let first_edge = corners.len();
        let edges = parts.edges.iter();
        corners.extend(edges.map(|e| [e.ends[0], e.ends[1], e.ends[1]]));
        faces.extend((0..parts.edges.len()).map(Face::Edge));
        let first_triangle = corners.len();
        let (triangles, owners): (Vec<_>, Vec<_>) = triangles(parts).unzip();
        let known = mesh.map(|mesh| known(parts, &triangles, mesh));
        corners.extend(triangles);
        faces.extend(owners.into_iter().map(Face::Triangle));
        Search {
            plc,
            parts,
            merging,
            corners,
            faces,
            starts: [first_edge, first_triangle],
            known: known.map_or_else(Vec::new, |[edges, triangles]| {
                [vec![true; first_edge], edges, triangles].concat()
            }),
            by_place: OnceLock::new(),
        }
    }

    /// The simplices, in the broad phase.
    pub fn simplices(&self) -> Simplices<'_> {
        let points = &self.plc.vertices;
        Simplices::new(points, &self.corners, self.starts, &self.known)
    }

    /// What a simplex of [`Search::simplices`] is.
    pub fn face(&self, i: usize) -> Face {
        self.faces[i]
    }

    fn points(&self, i: usize) -> [Point; 3] {
        self.corners[i].map(|v| self.plc.vertices[v.index()])
    }

    /// Whether two simplices without a common vertex have a common point; the first has not the higher dimension.
    pub fn touch(&self, i: usize, j: usize) -> bool {
        let [p, q] = [i, j].map(|k| self.points(k));
        match (self.faces[i], self.faces[j]) {
            (Face::Vertex(_), Face::Edge(_)) => contact::point_on_edge(p[0], [q[0], q[1]]),
            (Face::Vertex(_), _) => contact::point_on_triangle(p[0], q),
            (Face::Edge(_), Face::Edge(_)) => contact::edges_meet([p[0], p[1]], [q[0], q[1]]),
            _ => contact::edge_meets_triangle([p[0], p[1]], q),
        }
    }

    /// Whether two simplices that touch do so in a way that needs a new vertex: an edge crosses another, or the
    /// interior of a triangle of another part, where there is no vertex. Edges that merging drops do not count as
    /// edges.
    pub fn needs_vertex(&self, i: usize, j: usize) -> bool {
        let [p, q] = [i, j].map(|k| self.points(k));
        match (self.faces[i], self.faces[j]) {
            (Face::Edge(e), Face::Edge(f)) => {
                contact::edges_cross([p[0], p[1]], [q[0], q[1]])
                    && self.is_hard(e)
                    && self.is_hard(f)
                    && !self.meet_in_vertex(self.edge_simplex(e), self.edge_simplex(f))
            }
            (Face::Edge(e), Face::Triangle(part)) => {
                let others = self.owners(e).iter().any(|owner| owner.part != part);
                let corners = self.corners[j];
                let declared = [false; 3];
                others
                    && contact::edge_pierces([p[0], p[1]], q)
                    && !self.meet_in_vertex(self.edge_simplex(e), Simplex { corners, declared })
            }
            _ => false,
        }
    }

    /// Whether two parts intersect in a way that needs a new vertex.
    pub fn parts_need_vertex(&self, pair: [usize; 2]) -> bool {
        let lists = pair.map(|i| &self.parts.simplices[self.parts.ranges[i].clone()]);
        let candidates = super::rank::candidates(&self.plc.vertices, lists);
        candidates.into_iter().any(|(s, t)| {
            let edge = |simplex: &Simplex, i: usize| {
                let ends = simplex.edge(i);
                let found = self.parts.edges.binary_search_by(|e| e.ends.cmp(&ends));
                found.expect("an edge of a part is in the list")
            };
            let sides = |simplex: &Simplex| -> Vec<usize> {
                let [a, b, c] = simplex.corners;
                let count = [0, 1, 3][usize::from(a != b) + usize::from(b != c)];
                (0..count).map(|i| edge(simplex, i)).collect()
            };
            let (of_s, of_t) = (sides(s), sides(t));
            self.cross_between(s, t)
                || of_s
                    .iter()
                    .any(|&e| of_t.iter().any(|&f| self.edges_need_vertex(e, f)))
                || t.is_triangle() && of_s.iter().any(|&e| self.pierces(e, t))
                || s.is_triangle() && of_t.iter().any(|&e| self.pierces(e, s))
        })
    }

    fn edges_need_vertex(&self, e: usize, f: usize) -> bool {
        let [p, q] = [e, f].map(|k| self.parts.edges[k].ends);
        !p.iter().any(|v| q.contains(v)) && {
            let first = self.starts[0];
            self.needs_vertex(first + e, first + f)
        }
    }

    fn pierces(&self, e: usize, triangle: &Simplex) -> bool {
        let ends = self.parts.edges[e]
            .ends
            .map(|v| self.plc.vertices[v.index()]);
        let corners = triangle.corners.map(|v| self.plc.vertices[v.index()]);
        contact::edge_pierces(ends, corners)
            && !self.meet_in_vertex(self.edge_simplex(e), *triangle)
    }

    /// Whether two triangles that are not coplanar intersect in a line that is an edge of neither.
    fn cross_between(&self, s: &Simplex, t: &Simplex) -> bool {
        use super::meet::Place::Interior;
        if !s.is_triangle() || !t.is_triangle() {
            return false;
        }
        let [a, b, c] = s.corners.map(|v| self.plc.vertices[v.index()]);
        let on_plane = |v: &VertexId| orient3d([a, b, c, self.plc.vertices[v.index()]]).is_zero();
        if t.corners.iter().all(on_plane) {
            return false;
        }
        let found = meet(&self.plc.vertices, s, t);
        found.is_some_and(|m| m.dimension == 1 && m.places == [Interior, Interior])
    }

    fn owners(&self, e: usize) -> &[Owner] {
        &self.parts.edge_owners[self.parts.edges[e].owners.clone()]
    }

    fn edge_simplex(&self, e: usize) -> Simplex {
        let [a, b] = self.parts.edges[e].ends;
        Simplex {
            corners: [a, b, b],
            declared: [true; 3],
        }
    }

    /// Whether an edge is declared, and is not between two facets that merging makes one. (If it is explicit as well,
    /// then this is not seen here.)
    fn is_hard(&self, e: usize) -> bool {
        let mut declared = self.owners(e).iter().filter(|owner| owner.declared);
        let (first, second, third) = (declared.next(), declared.next(), declared.next());
        let (Some(first), Some(second), None) = (first, second, third) else {
            return first.is_some();
        };
        let pair = [first.part as usize, second.part as usize];
        !(self.merging && self.may_be_merged(pair, self.parts.edges[e].ends))
    }

    /// Whether two facets are on one plane, on different sides of a common edge, and equally marked.
    fn may_be_merged(&self, pair: [usize; 2], ends: [VertexId; 2]) -> bool {
        let [Some(f), Some(g)] = pair.map(|i| self.parts.parts[i].facet()) else {
            return false;
        };
        let apex = |part: usize| {
            let simplices = &self.parts.simplices[self.parts.ranges[part].clone()];
            let mut triangles = simplices.iter().filter(|s| s.is_triangle());
            let at_edge = triangles.find(|s| ends.iter().all(|v| s.corners.contains(v)));
            at_edge.and_then(|s| s.corners.into_iter().find(|v| !ends.contains(v)))
        };
        let [Some(x), Some(y)] = pair.map(apex) else {
            return false;
        };
        let [a, b, c, d] = [ends[0], ends[1], x, y].map(|v| self.plc.vertices[v.index()]);
        self.plc.facets[f].marker == self.plc.facets[g].marker
            && orient3d([a, b, c, d]).is_zero()
            && contact::on_different_sides([a, b], c, d)
    }

    /// Whether the one point that two simplices have in common is a vertex.
    fn meet_in_vertex(&self, s: Simplex, t: Simplex) -> bool {
        let points = &self.plc.vertices;
        let key = |p: [f64; 3]| p.map(|x| (x + 0.0).to_bits());
        let by_place = self.by_place.get_or_init(|| {
            let vertices = (0..points.len()).map(VertexId::new);
            vertices.map(|v| (key(points[v.index()]), v)).collect()
        });
        let Some(found) = meet(points, &s, &t) else {
            return false;
        };
        by_place.get(&key(found.point)).is_some_and(|v| {
            let vertex = Simplex {
                corners: [*v; 3],
                declared: [true; 3],
            };
            // The point is rounded.
            [s, t]
                .iter()
                .all(|simplex| meet(points, &vertex, simplex).is_some())
        })
    }

    /// Visits the pairs of a part of the one simplex and another part of the other, the lower first.
    pub fn pairs_of_owners(
        &self,
        [first, second]: [Face; 2],
        visit: &mut dyn FnMut([u32; 2]) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let owners = |face: Face| -> Vec<u32> {
            match face {
                Face::Vertex(v) => self.parts.owners_of_vertex(v).to_vec(),
                Face::Edge(e) => self.owners(e).iter().map(|owner| owner.part).collect(),
                Face::Triangle(part) => vec![part],
            }
        };
        let (first, second) = (owners(first), owners(second));
        for &f in &first {
            for &g in second.iter().filter(|&&g| g != f) {
                visit([f.min(g), f.max(g)])?;
            }
        }
        ControlFlow::Continue(())
    }

    /// Visits pairs of parts that have an equal edge, a diagonal of one of them, or an equal triangle.
    pub fn equal_simplices(
        &self,
        visit: &mut dyn FnMut([u32; 2]) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let mut add = |f: u32, g: u32| match f == g {
            true => ControlFlow::Continue(()),
            false => visit([f.min(g), f.max(g)]),
        };
        for edge in &self.parts.edges {
            let owners = &self.parts.edge_owners[edge.owners.clone()];
            let diagonals = owners.iter().filter(|o| !o.declared);
            for (owner, other) in diagonals.flat_map(|o| owners.iter().map(move |p| (o, p))) {
                add(owner.part, other.part)?;
            }
        }
        let mut all: Vec<([VertexId; 3], u32)> = triangles(self.parts).collect();
        all.sort_unstable();
        for group in all.chunk_by(|s, t| s.0 == t.0) {
            for (i, s) in group.iter().enumerate() {
                for t in &group[i + 1..] {
                    add(s.1, t.1)?;
                }
            }
        }
        ControlFlow::Continue(())
    }
}

/// Which edges of the parts, and which triangles, a tetrahedralization has; of edges only those of such triangles.
fn known(parts: &Parts, triangles: &[Corners], mesh: &TetMesh) -> [Vec<bool>; 2] {
    let by_least = triangles.iter().zip(0usize..);
    let by_least = by_least.map(|(&[a, b, c], i)| (a, ([b, c], i)));
    let by_least = Groups::new(parts.representative.len(), by_least);
    let mut of_triangles = vec![false; triangles.len()];
    for t in mesh.finite() {
        let mut corners = mesh.vertices(t);
        corners.sort_unstable();
        let [a, b, c, d] = corners;
        for [least, second, third] in [[a, b, c], [a, b, d], [a, c, d], [b, c, d]] {
            for &(others, i) in by_least.of(least) {
                of_triangles[i] |= others == [second, third];
            }
        }
    }
    let mut of_edges = vec![false; parts.edges.len()];
    for (&[a, b, c], _) in triangles
        .iter()
        .zip(&of_triangles)
        .filter(|(_, known)| **known)
    {
        for ends in [[a, b], [b, c], [a, c]] {
            let found = parts.edges.binary_search_by(|e| e.ends.cmp(&ends));
            of_edges[found.expect("an edge of a triangle is in the list")] = true;
        }
    }
    [of_edges, of_triangles]
}

/// The triangles with sorted corners and their parts.
fn triangles(parts: &Parts) -> impl Iterator<Item = ([VertexId; 3], u32)> {
    let of_part = |(part, range): (usize, &std::ops::Range<usize>)| {
        let triangles = parts.simplices[range.clone()].iter();
        let triangles = triangles.filter(|s| s.is_triangle());
        triangles.map(move |s| {
            let mut corners = s.corners;
            corners.sort_unstable();
            (corners, part as u32)
        })
    };
    parts.ranges.iter().enumerate().flat_map(of_part)
}
