//! Why an input is no PLC: every facet that is not valid for itself, and every pair of parts that intersect where they
//! must not.
//!
//! # What is valid
//! The parts of a PLC are its facets, the segments that are edges of no facet, and the vertices of neither. Coincident
//! vertices are one vertex. Two parts may have nothing in common but vertices and edges that *both* have (Miller, Talmor,
//! Teng, Walkington & Wang 1996; Si & Shewchuk, §2). So a wall may stand on a floor only if the floor has the foot of the
//! wall among its edges, as a two-vertex polygon for instance. Each facet for itself must pass what
//! [`Complex::new`](crate::plc::Complex::new) asks: its polygons are planar to within rounding and do not cross.
//! Surfaces that are open or branch, isolated vertices and coincident ones are notes, not errors.
//!
//! A facet that is flat only to rounding is taken for the triangles of a fixed triangulation (that of its projection along
//! a coordinate axis, `triangulate`), which depends on its vertices and edges alone. Its edges are exactly those of the
//! file, so that facets side by side do not intersect by rounding. What it comes to when a part lies within rounding of such
//! a facet, but not on those triangles, is not decided here.
//!
//! # Method
//! Facets are triangulated. Pairs of simplices (vertices, edges, triangles) without a common vertex are found by dividing
//! space (`tree`) and tested exactly (`contact`). That is enough, with equal edges and triangles found by sorting:
//!
//! *Two triangles* that intersect elsewhere than in common vertices and edges show it in two of their faces without a
//! common vertex. (1) With no common vertex, it is two of their closed edges, or an edge and the other triangle, or a
//! vertex and the other triangle. (2) With one common vertex v, the intersection is a part of a cone with apex v; it reaches the
//! edge opposite to v of one of the two, which has no vertex of the other. (3) With a common edge vw, they are coplanar
//! and on one side of it: compare the angles at v and at w. If those of the one triangle are both not larger, its third
//! vertex lies in the other; otherwise two edges, one at v and one at w, cross. *An edge and a triangle*, *two edges* with
//! a common vertex: likewise, if one leaves v inside the other, the end that comes first is a vertex, or a point of the
//! edge opposite to v.
//!
//! Conversely every such contact of different parts is a conflict. Pairs of parts in contact are then examined
//! exactly (`meet`) for the kind of their conflict and a point of their intersection.
//!
//! O(n log n + c) for n simplices of bounded overlap and c contacts; see `tree` for what else there can be.

mod contact;
mod findings;
mod meet;
mod parts;
mod rank;
mod shared;
mod tree;
mod triangulate;

pub use findings::{Conflict, Findings, Kind, Notes, Part};

use crate::exchange::Plc;
use crate::mesh::VertexId;
use parts::Parts;
use rayon::prelude::*;
use rustc_hash::{FxHashMap, FxHashSet};
use std::ops::ControlFlow;
use tree::Simplices;

/// Checks a PLC. With `most`, the search ends when that many conflicts have been found; which these are depends on the
/// input alone.
pub fn check(plc: &Plc, most: Option<usize>) -> Findings {
    let parts = Parts::new(plc);
    let mut search = Search {
        points: &plc.vertices,
        parts: &parts,
        found: FxHashSet::default(),
        most: most.unwrap_or(usize::MAX),
    };
    let stopped = search.run().is_break();
    let mut found: Vec<[u32; 2]> = search.found.into_iter().collect();
    found.sort_unstable();
    let classify = |[first, second]: [u32; 2]| {
        rank::conflict(&plc.vertices, &parts, [first as usize, second as usize])
    };
    // A few are one thread's work.
    let conflicts = match found.len() {
        0..256 => found.into_iter().map(classify).collect(),
        _ => found.into_par_iter().map(classify).collect(),
    };
    Findings {
        conflicts,
        stopped,
        notes: notes(&parts),
        errors: parts.errors,
    }
}

/// The triangles, edges and vertices that each part consists of, in the triangulation that the check uses.
pub(crate) fn simplices_of_parts(plc: &Plc) -> FxHashMap<Part, Vec<Vec<VertexId>>> {
    let parts = Parts::new(plc);
    let corners = |s: &meet::Simplex| {
        let mut corners = s.corners.to_vec();
        corners.dedup();
        corners
    };
    let of = |range: &std::ops::Range<usize>| {
        parts.simplices[range.clone()].iter().map(corners).collect()
    };
    let lists = parts.ranges.iter().map(of);
    parts.parts.iter().copied().zip(lists).collect()
}

/// The search for pairs of parts in contact.
struct Search<'a> {
    points: &'a [[f64; 3]],
    parts: &'a Parts,
    /// Pairs of parts, the lower first.
    found: FxHashSet<[u32; 2]>,
    most: usize,
}

/// A simplex of the search, by its index among those of its dimension.
#[derive(Clone, Copy)]
enum Face {
    Vertex(VertexId),
    Edge(usize),
    Triangle(u32),
}

impl Search<'_> {
    fn run(&mut self) -> ControlFlow<()> {
        self.equal_edges()?;
        self.equal_triangles()?;
        self.contacts()
    }

    /// Edges that are a diagonal of one part and belong to another.
    fn equal_edges(&mut self) -> ControlFlow<()> {
        for edge in &self.parts.edges {
            let owners = &self.parts.edge_owners[edge.owners.clone()];
            let diagonals = owners.iter().filter(|o| !o.declared);
            for (owner, other) in diagonals.flat_map(|o| owners.iter().map(move |p| (o, p))) {
                self.add(owner.part, other.part)?;
            }
        }
        ControlFlow::Continue(())
    }

    /// Triangles that two facets have.
    fn equal_triangles(&mut self) -> ControlFlow<()> {
        let mut all: Vec<([VertexId; 3], u32)> = self.triangles().collect();
        all.sort_unstable();
        for group in all.chunk_by(|s, t| s.0 == t.0) {
            for (i, s) in group.iter().enumerate() {
                for t in &group[i + 1..] {
                    self.add(s.1, t.1)?;
                }
            }
        }
        ControlFlow::Continue(())
    }

    /// The triangles with sorted corners and their parts.
    fn triangles(&self) -> impl Iterator<Item = ([VertexId; 3], u32)> {
        let parts = self.parts;
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

    /// Simplices without a common vertex that touch.
    fn contacts(&mut self) -> ControlFlow<()> {
        let parts = self.parts;
        let vertices = (0..parts.representative.len()).map(VertexId::new);
        let vertices: Vec<_> = vertices
            .filter(|&v| !parts.owners_of_vertex(v).is_empty())
            .collect();
        let mut corners: Vec<_> = vertices.iter().map(|&v| [v; 3]).collect();
        let mut faces: Vec<_> = vertices.into_iter().map(Face::Vertex).collect();
        let first_edge = corners.len();
        corners.extend(
            parts
                .edges
                .iter()
                .map(|e| [e.ends[0], e.ends[1], e.ends[1]]),
        );
        faces.extend((0..parts.edges.len()).map(Face::Edge));
        let first_triangle = corners.len();
        let (triangles, owners): (Vec<_>, Vec<_>) = self.triangles().unzip();
        corners.extend(triangles);
        faces.extend(owners.into_iter().map(Face::Triangle));

        let points = self.points;
        let simplices = Simplices::new(points, &corners, [first_edge, first_triangle]);
        let touch = |i: usize, j: usize| {
            let [p, q] = [i, j].map(|k| corners[k].map(|v| points[v.index()]));
            match (faces[i], faces[j]) {
                (Face::Vertex(_), Face::Edge(_)) => contact::point_on_edge(p[0], [q[0], q[1]]),
                (Face::Vertex(_), _) => contact::point_on_triangle(p[0], q),
                (Face::Edge(_), Face::Edge(_)) => contact::edges_meet([p[0], p[1]], [q[0], q[1]]),
                _ => contact::edge_meets_triangle([p[0], p[1]], q),
            }
        };
        if self.most < usize::MAX {
            // The first ones are wanted.
            return simplices.pairs(&mut |i, j| match touch(i, j) {
                true => self.add_owners(faces[i], faces[j]),
                false => ControlFlow::Continue(()),
            });
        }
        let visit = |i: usize, j: usize, found: &mut FxHashSet<[u32; 2]>| {
            if touch(i, j) {
                let _ = pairs_of_owners(parts, [faces[i], faces[j]], &mut |pair| {
                    found.insert(pair);
                    ControlFlow::Continue(())
                });
            }
        };
        let join = |found: &mut FxHashSet<[u32; 2]>, more| found.extend(more);
        self.found.extend(simplices.collect(&visit, &join));
        ControlFlow::Continue(())
    }

    /// Every part of the one simplex is in conflict with every part of the other.
    fn add_owners(&mut self, first: Face, second: Face) -> ControlFlow<()> {
        pairs_of_owners(self.parts, [first, second], &mut |[f, g]| self.add(f, g))
    }

    fn add(&mut self, f: u32, g: u32) -> ControlFlow<()> {
        if f != g && self.found.len() < self.most {
            self.found.insert([f.min(g), f.max(g)]);
        }
        if f != g && self.found.len() >= self.most {
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    }
}

/// Visits the pairs of a part of one simplex and another part of another, the lower first.
fn pairs_of_owners(
    parts: &Parts,
    [first, second]: [Face; 2],
    visit: &mut dyn FnMut([u32; 2]) -> ControlFlow<()>,
) -> ControlFlow<()> {
    let owners = |face: Face| -> Vec<u32> {
        match face {
            Face::Vertex(v) => parts.owners_of_vertex(v).to_vec(),
            Face::Edge(e) => {
                let owners = &parts.edge_owners[parts.edges[e].owners.clone()];
                owners.iter().map(|owner| owner.part).collect()
            }
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

fn notes(parts: &Parts) -> Notes {
    let vertices = || (0..parts.representative.len()).map(VertexId::new);
    let representative = |v: VertexId| parts.representative[v.index()];
    let bounding = |wanted: fn(usize) -> bool| {
        let edges = parts.bounding.iter().copied();
        edges.filter(move |&(_, count)| wanted(count))
    };
    Notes {
        duplicate_vertices: vertices()
            .filter(|&v| representative(v) != v)
            .map(|v| [v, representative(v)])
            .collect(),
        unused_vertices: vertices().filter(|v| !parts.used[v.index()]).collect(),
        open_edges: bounding(|count| count == 1).map(|(edge, _)| edge).collect(),
        branching_edges: bounding(|count| count > 2).collect(),
    }
}
