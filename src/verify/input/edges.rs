//! The edges of the facets and the segments, each once.
//!
//! An edge that one facet has alone may be a part of longer edges of others, or consist of several: where two sheets
//! meet along a line that they divide differently (a T-junction). It is divided at those ends of other such edges
//! that are exactly on it, so that every piece knows its facets.

use crate::exchange::Plc;
use crate::mesh::VertexId;
use crate::threads;
use crate::verify::lookup::slabs::{self, Slabs};
use crate::verify::lookup::tables::sorted2;
use crate::verify::signs::points::Points;
use rustc_hash::FxHashMap;
use std::cmp::Ordering;

/// Fewer elements are one thread's work.
const FEW: usize = 1 << 12;

/// An edge of facets or a segment given for itself; several coinciding ones are one.
pub(crate) struct InputEdge {
    /// Its ends, smaller first.
    pub(crate) ends: [VertexId; 2],
    /// The facets that have it as an edge of one of their polygons, in increasing order, without those that are equal
    /// to others.
    pub(crate) facets: Vec<usize>,
    /// Whether [`Plc::segments`] or a polygon with two vertices lists it.
    pub(crate) explicit: bool,
}

/// All edges.
pub(crate) struct Edges {
    /// In order of their ends.
    pub(crate) edges: Vec<InputEdge>,
    /// For each facet the indices of its own, in increasing order.
    pub(crate) of_facet: Vec<Vec<usize>>,
    /// (facet, earlier facet that it is equal to), in increasing order.
    pub(crate) repeated: Vec<(usize, usize)>,
}

/// The vertices on an edge, in order from its smaller to its larger end.
type Cuts = FxHashMap<[VertexId; 2], Vec<VertexId>>;

/// All edges of facets that have an area, and all segments.
pub(crate) fn all(
    plc: &Plc,
    points: &Points,
    site_of: &[VertexId],
    has_area: impl Fn(usize) -> bool,
) -> Edges {
    let whole = collect(plc, site_of, &has_area, &Cuts::default());
    let cuts = cuts(points, &whole);
    if cuts.is_empty() {
        return whole;
    }
    collect(plc, site_of, &has_area, &cuts)
}

fn collect(
    plc: &Plc,
    site_of: &[VertexId],
    has_area: &impl Fn(usize) -> bool,
    cuts: &Cuts,
) -> Edges {
    // (ends, facet, whether it is listed for itself), where no facet comes last.
    let mut uses: Vec<([VertexId; 2], u32, bool)> = Vec::new();
    let mut add = |a: VertexId, b: VertexId, facet: u32, explicit: bool| {
        let ends = sorted2([site_of[a.index()], site_of[b.index()]]);
        // The lookup is for nothing as a rule.
        let Some(cuts) = (!cuts.is_empty()).then(|| cuts.get(&ends)).flatten() else {
            uses.push((ends, facet, explicit));
            return;
        };
        let mut from = ends[0];
        for &to in cuts.iter().chain(&ends[1..]) {
            uses.push((sorted2([from, to]), facet, explicit));
            from = to;
        }
    };
    for (f, facet) in plc.facets.iter().enumerate() {
        let named = if has_area(f) { f as u32 } else { u32::MAX };
        for polygon in &facet.polygons {
            let n = polygon.len();
            // A polygon with two vertices is one edge, and one vertex is none.
            for i in 0..if n == 2 { 1 } else { n } {
                if n == 2 || named != u32::MAX {
                    add(polygon[i], polygon[(i + 1) % n], named, n == 2);
                }
            }
        }
    }
    for segment in &plc.segments {
        add(segment.ends[0], segment.ends[1], u32::MAX, true);
    }
    uses.retain(|(ends, ..)| ends[0] != ends[1]);
    threads::sort(&mut uses, FEW);
    let mut of_facet = vec![Vec::new(); plc.facets.len()];
    let mut edges: Vec<InputEdge> = Vec::new();
    for uses in uses.chunk_by(|x, y| x.0 == y.0) {
        let facets = uses.iter().map(|u| u.1 as usize);
        let mut facets: Vec<usize> = facets.filter(|&f| f != u32::MAX as usize).collect();
        facets.dedup();
        for &f in &facets {
            of_facet[f].push(edges.len());
        }
        edges.push(InputEdge {
            ends: uses[0].0,
            facets,
            explicit: uses.iter().any(|u| u.2),
        });
    }
    let repeated = repeated(plc, &edges, &of_facet);
    for &(f, _) in &repeated {
        for &e in &of_facet[f] {
            edges[e].facets.retain(|&g| g != f);
        }
    }
    Edges {
        edges,
        of_facet,
        repeated,
    }
}

/// The facets that have the edges and hole points of an earlier one.
fn repeated(plc: &Plc, edges: &[InputEdge], of_facet: &[Vec<usize>]) -> Vec<(usize, usize)> {
    let mut repeated = Vec::new();
    for (e, edge) in edges.iter().enumerate() {
        // Equal facets have the same first edge.
        let mut first: Vec<usize> = Vec::new();
        for &f in edge.facets.iter().filter(|&&f| of_facet[f][0] == e) {
            let is_equal = |&&g: &&usize| {
                of_facet[f] == of_facet[g] && plc.facets[f].holes == plc.facets[g].holes
            };
            match first.iter().find(is_equal) {
                Some(&g) => repeated.push((f, g)),
                None => first.push(f),
            }
        }
    }
    repeated.sort_unstable();
    repeated
}

/// The ends of edges of one facet that are inside other such edges.
fn cuts(points: &Points, all: &Edges) -> Cuts {
    let open: Vec<[VertexId; 2]> = all
        .edges
        .iter()
        .filter(|e| e.facets.len() == 1)
        .map(|e| e.ends)
        .collect();
    let mut found = Cuts::default();
    if open.is_empty() {
        return found;
    }
    let intervals = |axis: usize| -> Vec<[f64; 2]> {
        let edges = open.iter().map(|e| e.map(|v| points.at(v)[axis]));
        edges.map(|[a, b]| [a.min(b), a.max(b)]).collect()
    };
    let axes = [0, 1, 2].map(|k| (k, intervals(k)));
    let least = axes
        .iter()
        .min_by(|x, y| slabs::depth(&x.1).total_cmp(&slabs::depth(&y.1)));
    let (axis, across) = least.expect("three axes");
    let lookup = Slabs::new(across);
    let mut ends: Vec<VertexId> = open.iter().flatten().copied().collect();
    ends.sort_unstable();
    ends.dedup();
    let pairs = threads::collect(ends.len(), FEW, |i, pairs| {
        let v = ends[i];
        let mut near = Vec::new();
        lookup.around(points.at(v)[*axis], points.at(v)[*axis], &mut near);
        let edges = near.into_iter().map(|e| open[e as usize]);
        pairs.extend(edges.filter(|&e| is_inside(points, e, v)).map(|e| (e, v)));
    });
    for (edge, v) in pairs {
        found.entry(edge).or_default().push(v);
    }
    for (&[a, b], inside) in &mut found {
        inside.sort_by(|&v, &w| match along(points, [a, b]) {
            (axis, Ordering::Greater) => points.order(axis, w, v),
            (axis, _) => points.order(axis, v, w),
        });
    }
    found
}

/// The axis along which an edge is longest, and how its ends are ordered along it.
fn along(points: &Points, [a, b]: [VertexId; 2]) -> (usize, Ordering) {
    let length = |k: usize| (points.at(a)[k] - points.at(b)[k]).abs();
    let axis = (0..3)
        .max_by(|&i, &j| length(i).total_cmp(&length(j)))
        .expect("three axes");
    (axis, points.order(axis, a, b))
}

/// Whether a vertex is exactly on an edge and none of its ends.
fn is_inside(points: &Points, [a, b]: [VertexId; 2], v: VertexId) -> bool {
    let [p, q, x] = [a, b, v].map(|v| points.at(v));
    let in_box = (0..3).all(|k| p[k].min(q[k]) <= x[k] && x[k] <= p[k].max(q[k]));
    in_box && v != a && v != b && points.collinear([a, b, v])
}
