//! The planar subdivision that the edges of one facet make, and which of its faces belong to the facet: all but the
//! unbounded one and those that hold a hole point.
//!
//! Half-edges with the face on their left, sorted by angle about each vertex, linked to closed walks (de Berg, Cheong,
//! van Kreveld & Overmars, *Computational Geometry*, 2008, ch. 2). Each connected component has exactly one walk that
//! does not enclose a positive area: its outer boundary. That component lies in the innermost face of other components
//! that winds about one of its vertices, or in the unbounded face. All signs are exact.
//!
//! Edges must be distinct and meet in common ends only ([`super::crossing`]). O(k log k + (c + h)k) for k edges, c
//! components and floating vertices, h hole points.

use super::facet::undirected;
use super::plane::{Point, Projected, area_sign, on_segment, orient2d};
use crate::mesh::VertexId;
use crate::number::Sign;
use rustc_hash::FxHashSet;
use std::cmp::Ordering;

/// The part of the plane that belongs to a facet.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Area {
    /// Directed edges with the facet on their left. Sorted.
    pub edges: Vec<[VertexId; 2]>,
    /// The floating vertices that are in the facet.
    pub floating: Vec<VertexId>,
    /// Whether some face was removed by a hole point.
    pub holes_used: bool,
}

/// A hole point on an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct HoleOnEdge {
    /// The index of the hole point.
    pub hole: usize,
    /// The edge.
    pub edge: [VertexId; 2],
}

/// The facet's area, in the projection `plane`.
pub(super) fn area(
    plane: &Projected,
    edges: &[[VertexId; 2]],
    floating: &[VertexId],
    holes: &[Point],
) -> Result<Area, HoleOnEdge> {
    let graph = Subdivision::new(plane, edges);
    let mut kept = vec![true; graph.walks.len()];
    let mut holes_used = false;
    for (hole, &at) in holes.iter().enumerate() {
        for &edge in edges {
            if on_segment(at, plane.at(edge[0]), plane.at(edge[1])) {
                return Err(HoleOnEdge { hole, edge });
            }
        }
        if let Some(face) = graph.face_at(at) {
            kept[face] = false;
            holes_used = true;
        }
    }
    let in_facet = |face: Option<usize>| face.is_some_and(|f| kept[f]);
    let mut directed: Vec<_> = (0..graph.ends.len())
        .filter(|&h| in_facet(graph.face[graph.walk_of[h]]))
        .map(|h| graph.ends[h])
        .collect();
    directed.sort_unstable();
    let is_inside = |v: &VertexId| in_facet(graph.face_at(plane.at(*v)));
    Ok(Area {
        edges: directed,
        floating: floating.iter().copied().filter(is_inside).collect(),
        holes_used,
    })
}

/// Whether edges that meet in common ends only bound an area on their left, once: each face of the graph that they are
/// has all of its edges so directed, or none, and the unbounded one none. Both directions of an edge inside the area
/// are given.
pub(super) fn bound_area(plane: &Projected, directed: &[[VertexId; 2]]) -> bool {
    let mut edges: Vec<[VertexId; 2]> = directed.iter().copied().map(undirected).collect();
    edges.sort_unstable();
    edges.dedup();
    let given: FxHashSet<[VertexId; 2]> = directed.iter().copied().collect();
    let graph = Subdivision::new(plane, &edges);
    let mut is_inside: Vec<Option<bool>> = vec![None; graph.walks.len()];
    (0..graph.ends.len()).all(|h| {
        let inside = given.contains(&graph.ends[h]);
        match graph.face[graph.walk_of[h]] {
            None => !inside,
            Some(face) => *is_inside[face].get_or_insert(inside) == inside,
        }
    })
}

/// The half-edges of a plane graph and their walks. Half-edge 2i is edge i, 2i + 1 its reverse.
pub(super) struct Subdivision {
    ends: Vec<[VertexId; 2]>,
    /// The walk of each half-edge.
    walk_of: Vec<usize>,
    /// The half-edges after each one along its walk.
    next: Vec<usize>,
    /// The points of each walk in order.
    walks: Vec<Vec<Point>>,
    /// The connected component of each walk.
    component: Vec<usize>,
    /// Whether the walk bounds a face from outside; otherwise it is the outer boundary of its component.
    pub(super) bounded: Vec<bool>,
    /// How many faces of other components lie around each component.
    depth: Vec<usize>,
    /// The face to the left of each walk, named by the walk that bounds it from outside; `None` for the unbounded face.
    pub(super) face: Vec<Option<usize>>,
}

impl Subdivision {
    pub(super) fn new(plane: &Projected, edges: &[[VertexId; 2]]) -> Subdivision {
        let ends: Vec<_> = edges.iter().flat_map(|&[a, b]| [[a, b], [b, a]]).collect();
        let next = successors(plane, &ends);
        let mut graph = Subdivision {
            walk_of: vec![usize::MAX; ends.len()],
            ends,
            next,
            walks: Vec::new(),
            component: Vec::new(),
            bounded: Vec::new(),
            depth: Vec::new(),
            face: Vec::new(),
        };
        for start in 0..graph.ends.len() {
            if graph.walk_of[start] == usize::MAX {
                graph.trace(plane, start);
            }
        }
        let areas = graph.walks.iter().map(|w| area_sign(w));
        graph.bounded = areas.map(Sign::is_positive).collect();
        graph.find_components();
        graph.nest();
        graph
    }

    /// Follows the walk of a half-edge.
    fn trace(&mut self, plane: &Projected, start: usize) {
        let mut walk = Vec::new();
        let mut h = start;
        loop {
            self.walk_of[h] = self.walks.len();
            walk.push(plane.at(self.ends[h][0]));
            h = self.next[h];
            if h == start {
                break;
            }
        }
        self.walks.push(walk);
    }

    /// The vertices of each walk in order, each with an edge to the next one.
    pub(super) fn corners(&self) -> Vec<Vec<VertexId>> {
        let mut first = vec![usize::MAX; self.walks.len()];
        for (h, &walk) in self.walk_of.iter().enumerate().rev() {
            first[walk] = h;
        }
        let trace = |start: usize| {
            let mut corners = vec![self.ends[start][0]];
            let mut h = self.next[start];
            while h != start {
                corners.push(self.ends[h][0]);
                h = self.next[h];
            }
            corners
        };
        first.into_iter().map(trace).collect()
    }

    /// Walks on both sides of an edge are in one component.
    fn find_components(&mut self) {
        let mut beside = vec![Vec::new(); self.walks.len()];
        for (h, &walk) in self.walk_of.iter().enumerate() {
            beside[walk].push(self.walk_of[h ^ 1]);
        }
        self.component = vec![usize::MAX; self.walks.len()];
        let mut count = 0;
        for start in 0..self.walks.len() {
            if self.component[start] != usize::MAX {
                continue;
            }
            let mut stack = vec![start];
            while let Some(walk) = stack.pop() {
                if self.component[walk] == usize::MAX {
                    self.component[walk] = count;
                    stack.extend(&beside[walk]);
                }
            }
            count += 1;
        }
        self.depth = vec![0; count];
    }

    /// Finds the face in which each component lies.
    fn nest(&mut self) {
        let outer: Vec<usize> = (0..self.walks.len())
            .filter(|&w| !self.bounded[w])
            .collect();
        self.face = (0..self.walks.len()).map(Some).collect();
        if let &[walk] = &outer[..] {
            self.face[walk] = None;
            return;
        }
        let around: Vec<Vec<usize>> = outer.iter().map(|&w| self.faces_around(w)).collect();
        for (&walk, around) in outer.iter().zip(&around) {
            self.depth[self.component[walk]] = around.len();
        }
        for (&walk, around) in outer.iter().zip(&around) {
            self.face[walk] = self.innermost(around.iter().copied());
        }
    }

    /// The bounding walks of other components that wind about the component of `walk`.
    fn faces_around(&self, walk: usize) -> Vec<usize> {
        let at = self.walks[walk][0];
        (0..self.walks.len())
            .filter(|&w| self.component[w] != self.component[walk])
            .filter(|&w| self.bounded[w] && winds_about(&self.walks[w], at))
            .collect()
    }

    /// Of nested faces the innermost: the one whose component has most faces around it.
    fn innermost(&self, faces: impl Iterator<Item = usize>) -> Option<usize> {
        faces.max_by_key(|&w| self.depth[self.component[w]])
    }

    /// The bounded face that contains a point which is on no edge.
    pub(super) fn face_at(&self, at: Point) -> Option<usize> {
        let around =
            (0..self.walks.len()).filter(|&w| self.bounded[w] && winds_about(&self.walks[w], at));
        self.innermost(around)
    }
}

/// The half-edge that follows each one on the boundary of the face to its left: clockwise next about its head to its
/// own reverse.
fn successors(plane: &Projected, ends: &[[VertexId; 2]]) -> Vec<usize> {
    let mut outgoing: Vec<usize> = (0..ends.len()).collect();
    outgoing.sort_unstable_by(|&g, &h| {
        let ([a, b], [c, d]) = (ends[g], ends[h]);
        a.cmp(&c)
            .then_with(|| by_angle(plane.at(a), plane.at(b), plane.at(d)))
    });
    let mut next = vec![usize::MAX; ends.len()];
    let same_tail = |&g: &usize, &h: &usize| ends[g][0] == ends[h][0];
    for about in outgoing.chunk_by(same_tail) {
        for (i, &h) in about.iter().enumerate() {
            next[h ^ 1] = about[(i + about.len() - 1) % about.len()];
        }
    }
    next
}

/// Orders the directions from o to p and to q counterclockwise, from the positive first axis on.
pub(crate) fn by_angle(o: Point, p: Point, q: Point) -> Ordering {
    // Differences of doubles have the sign of the comparison; 0 for angles in [0, π), 1 for [π, 2π).
    let half = |p: Point| i32::from(p[1] < o[1] || p[1] == o[1] && p[0] < o[0]);
    half(p).cmp(&half(q)).then_with(|| match orient2d(o, p, q) {
        Sign::Positive => Ordering::Less,
        Sign::Zero => Ordering::Equal,
        Sign::Negative => Ordering::Greater,
    })
}

/// Whether a closed walk winds about a point that is not on it.
fn winds_about(walk: &[Point], at: Point) -> bool {
    let mut winding = 0;
    for (i, &p) in walk.iter().enumerate() {
        let q = walk[(i + 1) % walk.len()];
        if p[1] <= at[1] && at[1] < q[1] {
            winding += i32::from(orient2d(p, q, at).is_positive());
        } else if q[1] <= at[1] && at[1] < p[1] {
            winding -= i32::from(orient2d(p, q, at).is_negative());
        }
    }
    winding != 0
}

#[cfg(test)]
mod tests {
    use super::super::plane::Projection;
    use super::*;
    use proptest::prelude::*;

    /// The area in the plane z = 0, with edges as letters of points: "ab" is the edge from a to b.
    fn area_of(
        points: &[[f64; 2]],
        edges: &str,
        floating: &[u32],
        holes: &[Point],
    ) -> Result<Area, HoleOnEdge> {
        let points: Vec<_> = points.iter().map(|&[u, v]| [u, v, 0.0]).collect();
        let corner = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let projection = Projection::of(corner).unwrap().0;
        let plane = Projected {
            points: &points,
            projection,
        };
        let floating: Vec<_> = floating.iter().map(|&v| VertexId(v)).collect();
        area(&plane, &named(edges), &floating, holes)
    }

    fn named(edges: &str) -> Vec<[VertexId; 2]> {
        let id = |byte: u8| VertexId(u32::from(byte - b'a'));
        edges
            .split_whitespace()
            .map(|e| [id(e.as_bytes()[0]), id(e.as_bytes()[1])])
            .collect()
    }

    fn square(low: f64, high: f64) -> [[f64; 2]; 4] {
        [[low, low], [high, low], [high, high], [low, high]]
    }

    #[test]
    fn nested_squares_and_their_holes() {
        let points = [square(0.0, 9.0), square(1.0, 8.0), square(2.0, 7.0)].concat();
        let edges = "ab bc cd ad ef fg hg he ij jk kl il";
        let both = "ab bc cd da ef fe fg gf gh hg eh he ij ji jk kj kl lk il li";
        let sorted = |edges| {
            let mut edges = named(edges);
            edges.sort_unstable();
            edges
        };
        let directed = |holes: &[Point]| area_of(&points, edges, &[], holes).unwrap().edges;
        assert_eq!(directed(&[]), sorted(both));
        // A hole with an island, clockwise around the hole; a hole point outside changes nothing.
        let ring = "ab bc cd da fe gf hg eh ij jk kl li";
        assert_eq!(directed(&[[1.5, 1.5], [10.0, 0.0]]), sorted(ring));
        let middle = "ab bc cd da ef fe fg gf gh hg eh he ji kj lk il";
        assert_eq!(directed(&[[3.0, 3.0]]), sorted(middle));
        assert_eq!(
            directed(&[[0.5, 0.5]]),
            sorted("ef fg gh he ij ji jk kj kl lk il li")
        );
        let on_edge = area_of(&points, edges, &[], &[[4.0, 1.0]]);
        assert_eq!(on_edge.unwrap_err().edge, named("ef")[0]);
    }

    #[test]
    fn squares_that_share_a_corner_or_an_edge() {
        let points = [
            &square(0.0, 2.0)[..],
            &[[4.0, 2.0], [4.0, 4.0], [2.0, 4.0], [1.0, 3.0]],
        ]
        .concat();
        let corner = area_of(&points, "ab bc cd da ce ef fg gc", &[7], &[]).unwrap();
        assert_eq!(corner.edges, named("ab bc cd ce da ef fg gc"));
        assert_eq!(corner.floating, []);
        let points = [
            &square(0.0, 2.0)[..],
            &[[4.0, 0.0], [4.0, 2.0], [1.0, 1.0], [3.0, 1.0]],
        ]
        .concat();
        let edges = "ab bc cd da be ef fc";
        let edge = area_of(&points, edges, &[6, 7], &[]).unwrap();
        assert_eq!(edge.edges, named("ab bc be cb cd da ef fc"));
        assert_eq!(edge.floating.len(), 2);
        let left = area_of(&points, edges, &[6, 7], &[[3.0, 1.5]]).unwrap();
        assert_eq!(
            (left.edges, left.floating),
            (named("ab bc cd da"), vec![VertexId(6)])
        );
    }

    #[test]
    fn loose_edges() {
        // A spike inside, one outside, a floating edge inside, one outside.
        let points = [
            &square(0.0, 9.0)[..],
            &[
                [4.0, 4.0],
                [12.0, 12.0],
                [1.0, 5.0],
                [2.0, 5.0],
                [20.0, 0.0],
                [21.0, 0.0],
            ],
        ];
        let found = area_of(&points.concat(), "ab bc cd da ae cf gh ij", &[], &[]).unwrap();
        assert_eq!(found.edges, named("ab ae bc cd da ea gh hg"));
        let tree = area_of(&points.concat(), "ae cf", &[], &[]).unwrap();
        assert!(tree.edges.is_empty());
    }

    /// Side of the grid of the test below, in cells.
    const N: usize = 4;

    /// The vertex at column i, row j.
    fn lattice(i: usize, j: usize) -> VertexId {
        VertexId::new(j * (N + 1) + i)
    }

    /// The counterclockwise triangles of a grid whose cells are split along one diagonal or the other.
    fn triangles(diagonals: &[bool]) -> Vec<[VertexId; 3]> {
        let cells = (0..N).flat_map(|j| (0..N).map(move |i| (i, j)));
        let split = |((i, j), &diagonal): ((usize, usize), &bool)| {
            let [a, b, c, d] = [
                lattice(i, j),
                lattice(i + 1, j),
                lattice(i + 1, j + 1),
                lattice(i, j + 1),
            ];
            if diagonal {
                [[a, b, c], [c, d, a]]
            } else {
                [[a, b, d], [b, c, d]]
            }
        };
        cells.zip(diagonals).flat_map(split).collect()
    }

    proptest! {
        /// Some edges of a triangulated grid and some hole points: the faces are those that flooding finds.
        #[test]
        fn faces_agree_with_flooding(
            diagonals in prop::collection::vec(any::<bool>(), N * N),
            chosen in prop::collection::vec(0u32..100, 100),
            density in 20u32..90,
            holes in prop::collection::vec(0usize..2 * N * N, 0..3),
        ) {
            let triangles = triangles(&diagonals);
            let sides = |t: usize| (0..3).map(move |k| (k, t));
            let edge = |(k, t): (usize, usize)| [triangles[t][k], triangles[t][(k + 1) % 3]];
            let undirected = |[a, b]: [VertexId; 2]| [a.min(b), a.max(b)];
            let mut all: Vec<_> = (0..triangles.len()).flat_map(sides).map(edge).map(undirected).collect();
            all.sort_unstable();
            all.dedup();
            let picked = all.iter().zip(&chosen).filter(|(_, c)| **c < density);
            let edges: Vec<_> = picked.map(|(e, _)| *e).collect();
            let triangle_at = |[a, b]: [VertexId; 2]| (0..triangles.len()).flat_map(sides).find(|&s| edge(s) == [a, b]);

            // Flood from outside and from the holes, over edges that were not chosen.
            let mut open = vec![false; triangles.len()];
            let boundary = all.iter().filter(|e| !edges.contains(e)).filter_map(|&[a, b]| {
                match (triangle_at([a, b]), triangle_at([b, a])) {
                    (Some((_, t)), None) | (None, Some((_, t))) => Some(t),
                    _ => None,
                }
            });
            let mut stack: Vec<usize> = boundary.chain(holes.iter().copied()).collect();
            while let Some(t) = stack.pop() {
                if std::mem::replace(&mut open[t], true) {
                    continue;
                }
                for [a, b] in sides(t).map(edge) {
                    if !edges.contains(&undirected([a, b])) {
                        stack.extend(triangle_at([b, a]).map(|(_, t)| t));
                    }
                }
            }
            let directed = edges.iter().flat_map(|&[a, b]| [[a, b], [b, a]]);
            let mut expected: Vec<_> = directed.filter(|&e| triangle_at(e).is_some_and(|(_, t)| !open[t])).collect();
            expected.sort_unstable();

            let points: Vec<_> = (0..(N + 1) * (N + 1)).map(|v| [(v % (N + 1)) as f64, (v / (N + 1)) as f64]).collect();
            let sum = |t: usize, k: usize| triangles[t].map(|v| points[v.index()][k]).iter().sum::<f64>();
            let inside = |t: &usize| [0, 1].map(|k| sum(*t, k) / 3.0);
            let hole_points: Vec<_> = holes.iter().map(inside).collect();
            let space: Vec<_> = points.iter().map(|&[u, v]| [u, v, 0.0]).collect();
            let corner = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
            let projection = Projection::of(corner).unwrap().0;
            let plane = Projected { points: &space, projection };
            let floating = (0..points.len()).map(VertexId::new).filter(|v| !edges.concat().contains(v));
            let floating: Vec<_> = floating.collect();
            let found = area(&plane, &edges, &floating, &hole_points).unwrap();
            prop_assert_eq!(found.edges, expected);
            // All triangles about a floating vertex are in one face.
            for v in floating {
                let about = triangles.iter().position(|t| t.contains(&v)).unwrap();
                let on_hull = points[v.index()].iter().any(|&x| x == 0.0 || x == N as f64);
                prop_assert_eq!(found.floating.contains(&v), !on_hull && !open[about]);
            }
        }
    }
}
