//! The kind of a conflict between two parts: of all places where they intersect the worst.

use super::findings::{Conflict, Kind, Part};
use super::meet::{Meet, Place, Simplex, meet};
use super::parts::Parts;

/// The conflict of two parts that are known to be in conflict, by their indices. Whether it is repairable is not known
/// here.
///
/// All pairs of their simplices whose bounding boxes overlap are examined, those found by a sweep along the first axis.
pub(super) fn conflict(points: &[[f64; 3]], parts: &Parts, pair: [usize; 2]) -> Conflict {
    let [first, second] = pair.map(|i| parts.parts[i]);
    let lists = pair.map(|i| &parts.simplices[parts.ranges[i].clone()]);
    let same = matches!((first, second), (Part::Facet(_), Part::Facet(_)))
        && parts.outlines[pair[0]] == parts.outlines[pair[1]]
        && triangles(lists[0]) == triangles(lists[1]);
    let mut worst: Option<Conflict> = None;
    for (s, t) in candidates(points, lists) {
        let Some(found) = meet(points, s, t) else {
            continue;
        };
        let Some((mut kind, swapped)) = kind(&found) else {
            continue;
        };
        if same && kind == Kind::FacetsOverlap {
            kind = Kind::SameFacet;
        }
        let parts = if swapped {
            [second, first]
        } else {
            [first, second]
        };
        if worst.is_none_or(|w| kind < w.kind) {
            let point = found.point;
            worst = Some(Conflict {
                kind,
                parts,
                point,
                repairable: false,
            });
        }
    }
    worst.expect("parts in contact have a conflict")
}

/// The sorted triangles, for comparison.
fn triangles(simplices: &[Simplex]) -> Vec<[crate::mesh::VertexId; 3]> {
    let sorted = |s: &Simplex| {
        let mut corners = s.corners;
        corners.sort_unstable();
        corners
    };
    let mut triangles: Vec<_> = simplices.iter().map(sorted).collect();
    triangles.sort_unstable();
    triangles
}

/// The kind of an intersection, and whether the parts change places in it; `None` if it is in a vertex or an edge of
/// both.
fn kind(meet: &Meet) -> Option<(Kind, bool)> {
    use Place::{Edge, Interior, Vertex};
    Some(match (meet.dimension, meet.places) {
        (2, _) => (Kind::FacetsOverlap, false),
        (1, [Edge(e), Edge(f)]) if e == f => return None,
        (1, [Edge(e), Edge(f)]) => (Kind::EdgesOverlap { edges: [e, f] }, false),
        (1, [Edge(edge), _]) => (Kind::EdgeInFacet { edge }, false),
        (1, [_, Edge(edge)]) => (Kind::EdgeInFacet { edge }, true),
        (1, _) => (Kind::FacetsCross, false),
        (_, [Vertex(_), Vertex(_)]) => return None,
        (_, [Vertex(vertex), Edge(edge)]) => (Kind::VertexOnEdge { vertex, edge }, false),
        (_, [Edge(edge), Vertex(vertex)]) => (Kind::VertexOnEdge { vertex, edge }, true),
        (_, [Vertex(vertex), Interior]) => (Kind::VertexInFacet { vertex }, false),
        (_, [Interior, Vertex(vertex)]) => (Kind::VertexInFacet { vertex }, true),
        (_, [Edge(e), Edge(f)]) => (Kind::EdgesCross { edges: [e, f] }, false),
        (_, [Edge(edge), Interior]) => (Kind::EdgeThroughFacet { edge }, false),
        (_, [Interior, Edge(edge)]) => (Kind::EdgeThroughFacet { edge }, true),
        (_, [Interior, Interior]) => (Kind::FacetsCross, false),
    })
}

/// Pairs of simplices of two lists whose bounding boxes overlap.
pub(super) fn candidates<'s>(
    points: &[[f64; 3]],
    lists: [&'s [Simplex]; 2],
) -> Vec<(&'s Simplex, &'s Simplex)> {
    struct Item<'s> {
        simplex: &'s Simplex,
        list: usize,
        low: [f64; 3],
        high: [f64; 3],
    }
    let mut items = Vec::new();
    for (list, simplices) in lists.into_iter().enumerate() {
        for simplex in simplices {
            let at = simplex.corners.map(|v| points[v.index()]);
            let bound = |pick: fn(f64, f64) -> f64| {
                [0, 1, 2].map(|k| at.iter().map(|p| p[k]).reduce(pick).expect("three corners"))
            };
            items.push(Item {
                simplex,
                list,
                low: bound(f64::min),
                high: bound(f64::max),
            });
        }
    }
    items.sort_by(|a, b| a.low[0].total_cmp(&b.low[0]));
    let mut active: [Vec<&Item>; 2] = [Vec::new(), Vec::new()];
    let mut pairs = Vec::new();
    for item in &items {
        let others = &mut active[1 - item.list];
        others.retain(|other| other.high[0] >= item.low[0]);
        let overlap =
            |o: &&&Item| (1..3).all(|k| o.low[k] <= item.high[k] && item.low[k] <= o.high[k]);
        for other in others.iter().filter(overlap) {
            pairs.push(match item.list {
                0 => (item.simplex, other.simplex),
                _ => (other.simplex, item.simplex),
            });
        }
        active[item.list].push(item);
    }
    pairs
}
