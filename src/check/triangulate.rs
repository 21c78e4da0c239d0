//! A fixed triangulation of a facet's polygon, in its projection along a coordinate axis.
//!
//! A sweep over the vertices in lexicographic order (after Hertel & Mehlhorn, *Fast triangulation of simple polygons*,
//! 1983, for any planar straight-line graph instead of one polygon). Between two edges that are consecutive along the
//! sweep line, where the polygon is, a *chain* of vertices separates what has been triangulated, on its left, from what
//! has not.
//!
//! Invariant: a chain runs from the left end of the edge below to that of the edge above, and no vertex of it could be
//! cut off: it bulges towards the sweep line. So its last vertex in the order sees the sweep line, and what else a new
//! vertex sees of it is beside that.
//!
//! The triangulation depends on the vertices, the edges and the projection, not on the order of corners or their sense.
//! All signs are exact. O(k log k) for k vertices, and O(k) more for every vertex without an edge to its left.

use crate::mesh::VertexId;
use crate::number::Sign;
use crate::plc::{Polygon, Projected, orient2d};
use std::cmp::Ordering;
use std::collections::VecDeque;

type Triangle = [VertexId; 3];
type Chain = VecDeque<VertexId>;

/// An edge of the polygon, its left end first, and on which sides of it the polygon lies.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Edge {
    left: VertexId,
    right: VertexId,
    above: bool,
    below: bool,
}

/// Triangles that cover the polygon, counterclockwise in the projection, whose corners are all vertices of the polygon.
pub(crate) fn triangulate(plane: &Projected, polygon: &Polygon) -> Vec<Triangle> {
    let mut events = polygon.vertices.clone();
    events.sort_by(|&p, &q| order(plane, p, q));
    let starting = edges_by_left_end(plane, polygon);
    let mut sweep = Sweep {
        plane,
        edges: Vec::new(),
        gaps: vec![None],
        triangles: Vec::new(),
    };
    for p in events {
        let first = starting.partition_point(|e| order(plane, e.left, p).is_lt());
        let last = first + starting[first..].partition_point(|e| e.left == p);
        sweep.pass(p, &starting[first..last]);
    }
    sweep.triangles
}

/// The lexicographic order in the projection.
fn order(plane: &Projected, p: VertexId, q: VertexId) -> Ordering {
    let ([pu, pv], [qu, qv]) = (plane.at(p), plane.at(q));
    // Comparisons of doubles, for which −0 = 0; they are finite.
    let compare = |x: f64, y: f64| x.partial_cmp(&y).expect("coordinates are finite");
    compare(pu, qu)
        .then_with(|| compare(pv, qv))
        .then(p.cmp(&q))
}

/// Every edge once, sorted by its left end, those with the same left end from below to above.
fn edges_by_left_end(plane: &Projected, polygon: &Polygon) -> Vec<Edge> {
    let counterclockwise = plane.orient(polygon.frame).is_positive();
    let side = |&[a, b]: &[VertexId; 2]| {
        let forward = order(plane, a, b).is_lt();
        let (left, right) = if forward { (a, b) } else { (b, a) };
        let above = forward == counterclockwise;
        Edge {
            left,
            right,
            above,
            below: !above,
        }
    };
    let mut edges: Vec<Edge> = polygon.edges.iter().map(side).collect();
    edges.sort_unstable();
    edges.dedup_by(|second, first| {
        let same = (first.left, first.right) == (second.left, second.right);
        if same {
            first.above |= second.above;
            first.below |= second.below;
        }
        same
    });
    edges.sort_by(|e, f| {
        let turn = || orient2d(plane.at(e.left), plane.at(e.right), plane.at(f.right));
        order(plane, e.left, f.left).then_with(|| match turn() {
            Sign::Positive => Ordering::Less,
            Sign::Zero => e.right.cmp(&f.right),
            Sign::Negative => Ordering::Greater,
        })
    });
    edges
}

struct Sweep<'a> {
    plane: &'a Projected<'a>,
    /// The edges across the sweep line, from below to above.
    edges: Vec<Edge>,
    /// The gaps between them, one more than edges: the chain where the polygon is.
    gaps: Vec<Option<Chain>>,
    triangles: Vec<Triangle>,
}

impl Sweep<'_> {
    fn orient(&self, a: VertexId, b: VertexId, c: VertexId) -> Sign {
        self.plane.orient([a, b, c])
    }

    /// Moves the sweep line past p, at which the edges `starting` start.
    fn pass(&mut self, p: VertexId, starting: &[Edge]) {
        let is_above = |e: &Edge| self.orient(e.left, e.right, p).is_positive() && e.right != p;
        let low = self.edges.partition_point(is_above);
        let high = low + self.edges[low..].partition_point(|e| e.right == p);
        let (below, above) = if low == high {
            match self.gaps[low].take() {
                Some(chain) => {
                    let (below, above) = self.split(chain, p);
                    (Some(below), Some(above))
                }
                None => (None, None),
            }
        } else {
            for gap in low + 1..high {
                if let Some(chain) = self.gaps[gap].take() {
                    self.close(&chain, p);
                }
            }
            let below = self.gaps[low].take().map(|chain| self.append(chain, p));
            let above = self.gaps[high].take().map(|chain| self.prepend(p, chain));
            (below, above)
        };
        let mut gaps = Vec::with_capacity(starting.len() + 1);
        if starting.is_empty() {
            gaps.push(below.zip(above).map(|(mut below, above)| {
                below.extend(above.into_iter().skip(1));
                below
            }));
        } else {
            gaps.push(below);
            let between = &starting[..starting.len() - 1];
            gaps.extend(between.iter().map(|e| e.above.then(|| Chain::from([p]))));
            gaps.push(above);
        }
        self.gaps.splice(low..=high, gaps);
        self.edges.splice(low..high, starting.iter().copied());
    }

    /// Whether p, right of the edge ab of a chain, which goes up, sees it.
    fn sees(&self, p: VertexId, a: VertexId, b: VertexId) -> bool {
        self.orient(a, b, p).is_negative()
    }

    /// The gap ends at p: all of its chain is joined to p.
    fn close(&mut self, chain: &Chain, p: VertexId) {
        let ends = chain.iter().zip(chain.iter().skip(1));
        let seen: Vec<Triangle> = ends.map(|(&a, &b)| [a, p, b]).collect();
        self.triangles.extend(seen);
    }

    /// The edge above the gap ended at p.
    fn append(&mut self, mut chain: Chain, p: VertexId) -> Chain {
        while let Some(k) = chain.len().checked_sub(2) {
            let (a, b) = (chain[k], chain[k + 1]);
            if !self.sees(p, a, b) {
                break;
            }
            self.triangles.push([a, p, b]);
            chain.pop_back();
        }
        chain.push_back(p);
        chain
    }

    /// The edge below the gap ended at p.
    fn prepend(&mut self, p: VertexId, mut chain: Chain) -> Chain {
        while chain.len() >= 2 {
            let (a, b) = (chain[0], chain[1]);
            if !self.sees(p, a, b) {
                break;
            }
            self.triangles.push([a, p, b]);
            chain.pop_front();
        }
        chain.push_front(p);
        chain
    }

    /// p is inside the gap: the chain below it, which ends with it, and that above it.
    fn split(&mut self, mut chain: Chain, p: VertexId) -> (Chain, Chain) {
        let last = (0..chain.len()).max_by(|&i, &j| order(self.plane, chain[i], chain[j]));
        let last = last.expect("a chain has vertices");
        let above = chain.split_off(last);
        chain.push_back(above[0]);
        (self.append(chain, p), self.prepend(p, above))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exchange::{Facet, Plc};
    use crate::plc::{Complex, Projection};

    /// Twice the area and the number of the triangles of one facet, in the plane z = 0 and in either sense; all of them
    /// are counterclockwise.
    fn area_and_count(
        points: &[[f64; 2]],
        polygons: &[&[u32]],
        holes: &[[f64; 2]],
    ) -> (f64, usize) {
        let space: Vec<_> = points.iter().map(|&[u, v]| [u, v, 0.0]).collect();
        let of = |reversed: bool| {
            let polygon = |p: &&[u32]| {
                let mut ids: Vec<_> = p.iter().map(|&v| VertexId(v)).collect();
                if reversed {
                    ids.reverse();
                }
                ids
            };
            let facet = Facet {
                polygons: polygons.iter().map(polygon).collect(),
                holes: holes.iter().map(|&[u, v]| [u, v, 0.0]).collect(),
                marker: 0,
            };
            let plc = Plc {
                vertices: space.clone(),
                facets: vec![facet],
                ..Plc::default()
            };
            let complex = Complex::new(&plc, false).unwrap();
            let polygon = &complex.polygons[0];
            let corner = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
            let projection = Projection::of(corner).unwrap().0;
            let points = &space;
            let plane = Projected { points, projection };
            let mut triangles = triangulate(&plane, polygon);
            assert!(triangles.iter().all(|&t| plane.orient(t).is_positive()));
            let area = |&[a, b, c]: &Triangle| {
                let [[au, av], [bu, bv], [cu, cv]] = [a, b, c].map(|v| plane.at(v));
                (bu - au) * (cv - av) - (bv - av) * (cu - au)
            };
            let total: f64 = triangles.iter().map(area).sum();
            triangles.sort_unstable();
            (total, triangles)
        };
        let (area, triangles) = of(false);
        assert_eq!((area, &triangles), (of(true).0, &of(true).1));
        (area, triangles.len())
    }

    #[test]
    fn combs_holes_slits_and_floating_vertices() {
        // A comb, whose teeth end in collinear points.
        let mut comb = vec![[0.0, 0.0]];
        comb.extend((0..9).map(|i| [f64::from(i), if i % 2 == 0 { 5.0 } else { 1.0 }]));
        comb.push([8.0, 0.0]);
        let all: Vec<u32> = (0..11).rev().collect();
        assert_eq!(area_and_count(&comb, &[&all], &[]), (48.0, 9));
        let square = |low: f64, high: f64| [[low, low], [high, low], [high, high], [low, high]];
        let points = [
            &square(0.0, 9.0)[..],
            &square(3.0, 6.0),
            &[[1.0, 1.0], [7.0, 8.0]],
        ]
        .concat();
        let frame: [&[u32]; 2] = [&[0, 1, 2, 3], &[4, 5, 6, 7]];
        // V − E + F = 2: eight vertices; with the hole 8 triangles, without it 10.
        assert_eq!(area_and_count(&points, &frame, &[[4.0, 5.0]]), (144.0, 8));
        assert_eq!(area_and_count(&points, &frame, &[]), (162.0, 10));
        // A slit from a corner, and a floating vertex.
        assert_eq!(
            area_and_count(&points, &[frame[0], &[0, 8], &[9]], &[]),
            (162.0, 6)
        );
        assert_eq!(
            area_and_count(&points, &[frame[0], &[8, 9], &[4]], &[]),
            (162.0, 8)
        );
    }
}
