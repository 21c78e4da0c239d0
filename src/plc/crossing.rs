//! Edges of a facet that cross, and vertices inside edges: the facet is then no planar straight-line graph.
//!
//! A sweep in the first coordinate of the projection compares only edges whose bounding boxes meet; every comparison is
//! exact. O(k log k) for edges that are short compared with the facet, O(k²) at worst.

use super::plane::{Point, Projected, in_box, on_segment, orient2d};
use crate::mesh::VertexId;
use crate::number::Sign;

/// What is wrong between two edges, or a vertex and an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Conflict {
    /// They cross in their interiors.
    Cross([[VertexId; 2]; 2]),
    /// The vertex is in the interior of the edge.
    OnEdge(VertexId, [VertexId; 2]),
}

/// An edge with its bounding box; a floating vertex is an edge with equal ends.
struct Item {
    ends: [VertexId; 2],
    at: [Point; 2],
    low: Point,
    high: Point,
}

impl Item {
    fn new(plane: &Projected, ends: [VertexId; 2]) -> Item {
        let at = ends.map(|v| plane.at(v));
        let [[au, av], [bu, bv]] = at;
        Item {
            ends,
            at,
            low: [au.min(bu), av.min(bv)],
            high: [au.max(bu), av.max(bv)],
        }
    }

    fn is_vertex(&self) -> bool {
        self.ends[0] == self.ends[1]
    }
}

/// The first conflict of the sweep among distinct edges and floating vertices that belong to none of them.
pub(super) fn find(
    plane: &Projected,
    edges: &[[VertexId; 2]],
    floating: &[VertexId],
) -> Option<Conflict> {
    let points = floating.iter().map(|&v| [v, v]);
    let all = edges.iter().copied().chain(points);
    let mut items: Vec<Item> = all.map(|ends| Item::new(plane, ends)).collect();
    items.sort_by(|e, f| e.low[0].total_cmp(&f.low[0]));
    let mut active: Vec<&Item> = Vec::new();
    for item in &items {
        active.retain(|other| other.high[0] >= item.low[0]);
        for other in &active {
            if other.low[1] <= item.high[1] && item.low[1] <= other.high[1] {
                let conflict = between(other, item);
                if conflict.is_some() {
                    return conflict;
                }
            }
        }
        active.push(item);
    }
    None
}

/// Whether there is any conflict among distinct edges.
pub(crate) fn has_conflict(plane: &Projected, edges: &[[VertexId; 2]]) -> bool {
    find(plane, edges, &[]).is_some()
}

fn between(e: &Item, f: &Item) -> Option<Conflict> {
    let ([a, b], [c, d]) = (e.ends, f.ends);
    match (e.is_vertex(), f.is_vertex()) {
        (true, true) => None,
        (true, false) => on_edge(a, e.at[0], f),
        (false, true) => on_edge(c, f.at[0], e),
        (false, false) if a == c => beside(e, 1, f, 1),
        (false, false) if a == d => beside(e, 1, f, 0),
        (false, false) if b == c => beside(e, 0, f, 1),
        (false, false) if b == d => beside(e, 0, f, 0),
        (false, false) => apart(e, f),
    }
}

/// Two edges with a common end; the others are `e.ends[i]` and `f.ends[j]`.
fn beside(e: &Item, i: usize, f: &Item, j: usize) -> Option<Conflict> {
    on_edge(e.ends[i], e.at[i], f).or_else(|| on_edge(f.ends[j], f.at[j], e))
}

fn on_edge(v: VertexId, at: Point, edge: &Item) -> Option<Conflict> {
    on_segment(at, edge.at[0], edge.at[1]).then_some(Conflict::OnEdge(v, edge.ends))
}

/// Two edges without a common end.
fn apart(e: &Item, f: &Item) -> Option<Conflict> {
    let [a, b] = e.at;
    let [c, d] = f.at;
    let signs = [
        orient2d(c, d, a),
        orient2d(c, d, b),
        orient2d(a, b, c),
        orient2d(a, b, d),
    ];
    let ends = [(e, 0, f), (e, 1, f), (f, 0, e), (f, 1, e)];
    for (sign, (item, i, edge)) in signs.into_iter().zip(ends) {
        if sign.is_zero() && in_box(item.at[i], edge.at[0], edge.at[1]) {
            return Some(Conflict::OnEdge(item.ends[i], edge.ends));
        }
    }
    let opposite = |s: Sign, t: Sign| (s * t).is_negative();
    let cross = opposite(signs[0], signs[1]) && opposite(signs[2], signs[3]);
    cross.then_some(Conflict::Cross([e.ends, f.ends]))
}

#[cfg(test)]
mod tests {
    use super::super::plane::Projection;
    use super::*;
    use proptest::prelude::*;

    fn edge(a: u32, b: u32) -> [VertexId; 2] {
        [VertexId(a), VertexId(b)]
    }

    /// In the plane z = 0.
    fn found(points: &[[i32; 2]], edges: &[[VertexId; 2]], floating: &[u32]) -> Option<Conflict> {
        let points: Vec<_> = points
            .iter()
            .map(|&[u, v]| [f64::from(u), f64::from(v), 0.0])
            .collect();
        let corner = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let plane = Projected {
            points: &points,
            projection: Projection::of(corner).unwrap().0,
        };
        let floating: Vec<_> = floating.iter().map(|&v| VertexId(v)).collect();
        find(&plane, edges, &floating)
    }

    #[test]
    fn all_ways_to_meet() {
        let points = [[0, 0], [4, 0], [2, -1], [2, 1], [2, 0], [6, 0], [0, 3]];
        let cross = Conflict::Cross([edge(0, 1), edge(2, 3)]);
        assert_eq!(found(&points, &[edge(0, 1), edge(2, 3)], &[]), Some(cross));
        let on = |v, e| Some(Conflict::OnEdge(VertexId(v), e));
        assert_eq!(
            found(&points, &[edge(0, 1), edge(4, 3)], &[]),
            on(4, edge(0, 1))
        );
        assert_eq!(found(&points, &[edge(0, 1)], &[4]), on(4, edge(0, 1)));
        // Overlapping, with and without a common end.
        assert_eq!(
            found(&points, &[edge(0, 1), edge(0, 5)], &[]),
            on(1, edge(0, 5))
        );
        assert_eq!(
            found(&points, &[edge(0, 1), edge(4, 5)], &[]),
            on(1, edge(4, 5))
        );
        // In a row, at an angle, and apart on one line.
        assert_eq!(
            found(&points, &[edge(0, 4), edge(4, 1), edge(0, 6)], &[3]),
            None
        );
        assert_eq!(found(&points, &[edge(0, 4), edge(1, 5)], &[]), None);
    }

    proptest! {
        /// The sweep finds a conflict iff some pair has one.
        #[test]
        fn sweep_agrees_with_all_pairs(
            points in prop::collection::hash_set([0..7, 0..7], 12),
            ends in prop::collection::hash_set((0u32..9, 0u32..9), 1..8),
        ) {
            let points: Vec<[i32; 2]> = points.into_iter().collect();
            let edges: Vec<_> = ends.into_iter().filter(|(a, b)| a < b).map(|(a, b)| edge(a, b)).collect();
            let floating = [9, 10, 11];
            let pairs = (0..edges.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
            let expected = pairs.filter(|&(i, j)| found(&points, &[edges[i], edges[j]], &[]).is_some()).count()
                + edges.iter().filter(|&&e| found(&points, &[e], &floating).is_some()).count();
            prop_assert_eq!(found(&points, &edges, &floating).is_some(), expected > 0);
        }
    }
}
