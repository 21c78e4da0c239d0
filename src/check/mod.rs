//! Why an input is no PLC: every facet that is not valid for itself, and every pair of parts that intersect where they
//! must not.
//!
//! # What is valid
//! The parts of a PLC are its facets, the segments that are edges of no facet, and the vertices of neither. Coincident
//! vertices are one vertex. Two parts may have nothing in common but vertices and edges that *both* have (Miller,
//! Talmor, Teng, Walkington & Wang 1996; Si & Shewchuk, §2). So a wall may stand on a floor only if the floor has the
//! foot of the wall among its edges, as a two-vertex polygon for instance. Each facet for itself must pass what
//! [`Complex::new`](crate::plc::Complex::new) asks: its polygons are planar to within rounding and do not cross.
//! Surfaces that are open or branch, isolated vertices and coincident ones are notes, not errors.
//!
//! A facet that is flat only to rounding is taken for the triangles of a fixed triangulation (that of its projection
//! along a coordinate axis, `triangulate`), which depends on its vertices and edges alone. Its edges are exactly those
//! of the file, so that facets side by side do not intersect by rounding. What it comes to when a part lies within
//! rounding of such a facet, but not on those triangles, is not decided here.
//!
//! # Method
//! Facets are triangulated. Pairs of simplices (vertices, edges, triangles) without a common vertex are found by
//! dividing space (`tree`) and tested exactly (`contact`). That is enough, with equal edges and triangles found by
//! sorting:
//!
//! *Two triangles* that intersect elsewhere than in common vertices and edges show it in two of their faces without a
//! common vertex. (1) With no common vertex, it is two of their closed edges, or an edge and the other triangle, or a
//! vertex and the other triangle. (2) With one common vertex v, the intersection is a part of a cone with apex v; it
//! reaches the edge opposite to v of one of the two, which has no vertex of the other. (3) With a common edge vw, they
//! are coplanar and on one side of it: compare the angles at v and at w. If those of the one triangle are both not
//! larger, its third vertex lies in the other; otherwise two edges, one at v and one at w, cross. *An edge and a
//! triangle*, *two edges* with a common vertex: likewise, if one leaves v inside the other, the end that comes first is
//! a vertex, or a point of the edge opposite to v.
//!
//! Conversely every such contact of different parts is a conflict. Pairs of parts in contact are then examined
//! exactly (`meet`) for the kind of their conflict and a point of their intersection.
//!
//! O(n log n + c) for n simplices of bounded overlap and c contacts; see `tree` for what else there can be.

mod contact;
mod contacts;
mod findings;
mod meet;
mod parts;
mod rank;
mod reach;
mod search;
mod shared;
mod tree;
mod triangulate;

pub(crate) use contacts::{Contacts, contacts, crossing_findings};
pub use findings::{Conflict, Findings, Kind, Notes, Part};
pub(crate) use parts::Parts;
pub(crate) use triangulate::triangulate;

use crate::exchange::Plc;
use crate::mesh::VertexId;
use rayon::prelude::*;
use rustc_hash::{FxHashMap, FxHashSet};
use search::Search;
use std::ops::ControlFlow;

/// Checks a PLC. With `most`, the search ends when that many conflicts have been found; which these are depends on the
/// input alone.
pub fn check(plc: &Plc, most: Option<usize>) -> Findings {
    check_to(plc, most, 0.0)
}

/// [`check`] to a precision: vertices within `delta` of the plane of their facet, along each axis, are on it.
pub fn check_to(plc: &Plc, most: Option<usize>, delta: f64) -> Findings {
    let parts = Parts::new(plc, delta);
    let search = Search::new(plc, &parts, true, None);
    let (found, stopped) = match most {
        Some(most) => first_pairs(&search, most),
        None => (all_pairs(&search), false),
    };
    let classify = |[first, second]: [u32; 2]| {
        let pair = [first as usize, second as usize];
        Conflict {
            repairable: !search.parts_need_vertex(pair),
            ..rank::conflict(&plc.vertices, &parts, pair)
        }
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

/// The first `most` pairs of parts in contact, by their indices, and whether there may be more.
fn first_pairs(search: &Search, most: usize) -> (Vec<[u32; 2]>, bool) {
    let mut found: FxHashSet<[u32; 2]> = FxHashSet::default();
    let mut add = |pair: [u32; 2]| {
        if found.len() < most {
            found.insert(pair);
        }
        match found.len() < most {
            true => ControlFlow::Continue(()),
            false => ControlFlow::Break(()),
        }
    };
    let mut run = || {
        search.equal_simplices(&mut add)?;
        search
            .simplices()
            .pairs(&mut |i, j| match search.touch(i, j) {
                true => search.pairs_of_owners([search.face(i), search.face(j)], &mut add),
                false => ControlFlow::Continue(()),
            })
    };
    let stopped = run().is_break();
    (sorted(found), stopped)
}

/// All pairs of parts in contact, by their indices.
fn all_pairs(search: &Search) -> Vec<[u32; 2]> {
    let mut found: FxHashSet<[u32; 2]> = FxHashSet::default();
    let _ = search.equal_simplices(&mut |pair| {
        found.insert(pair);
        ControlFlow::Continue(())
    });
    let visit = |i: usize, j: usize, found: &mut FxHashSet<[u32; 2]>| {
        if search.touch(i, j) {
            let _ = search.pairs_of_owners([search.face(i), search.face(j)], &mut |pair| {
                found.insert(pair);
                ControlFlow::Continue(())
            });
        }
    };
    let join = |found: &mut FxHashSet<[u32; 2]>, more| found.extend(more);
    let simplices = search.simplices();
    found.extend(simplices.collect(vec![simplices.everything()], &visit, &join));
    sorted(found)
}

fn sorted(pairs: FxHashSet<[u32; 2]>) -> Vec<[u32; 2]> {
    let mut pairs: Vec<_> = pairs.into_iter().collect();
    pairs.sort_unstable();
    pairs
}

/// The triangles, edges and vertices that each part consists of, in the triangulation that the check uses.
pub(crate) fn simplices_of_parts(plc: &Plc) -> FxHashMap<Part, Vec<Vec<VertexId>>> {
    let parts = Parts::new(plc, f64::INFINITY);
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
