//! Every segment, and every edge of a facet, is a chain of mesh edges from end to end.
//!
//! The chain may pass through any vertex that is exactly on the segment, and through vertices that are not of the
//! input (Steiner points) within [`super::super::options::VerifyOptions::tolerance`] of it, since their coordinates
//! are rounded. It is found by a walk from one end along mesh edges, always forward in the segment's dominant
//! coordinate.
//!
//! Three exceptions, all counted: an edge that two coplanar facets with the same marker share on opposite sides may
//! have been merged away (unless it is listed as a segment); a segment with an end that is not in the domain, or that
//! leaves the domain from both of its ends, is outside of the part that was kept; everything else is missing.

use crate::mesh::VertexId;
use crate::number::vector::{cross, dot, minus};
use crate::threads;
use crate::verify::case::Case;
use crate::verify::claims::flatness;
use crate::verify::claims::listed::Listed;
use crate::verify::lookup::area::Area;
use crate::verify::lookup::tables::sorted2;
use crate::verify::verdict::Findings;
use crate::verify::violation::Violation;
use std::cmp::Ordering;

/// What became of a segment.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Fate {
    /// It is an edge.
    Edge,
    /// It is this chain of vertices, three or more.
    Chain(Vec<VertexId>),
    /// It is gone because the two facets at it are one.
    Merged,
    /// It is gone because all around it are coplanar facets, which overlap, with the same markers on both sides: these.
    Absorbed(Vec<usize>),
    /// It lies outside the domain.
    Outside,
    /// It should be there and is not.
    Missing,
}

impl Fate {
    /// The edges in its place.
    pub(crate) fn edges(&self, ends: [VertexId; 2]) -> Vec<[VertexId; 2]> {
        match self {
            Fate::Chain(chain) => chain.windows(2).map(|w| sorted2([w[0], w[1]])).collect(),
            _ => vec![ends],
        }
    }
}

/// Fewer edges are one thread's work.
const FEW: usize = 1 << 11;

/// The fate of each of the input's edges.
pub(crate) fn check(case: &Case, listed: &Listed, findings: &mut Findings) -> Vec<Fate> {
    let trial = findings.trial();
    let parts = threads::in_parts(case.input.edges.len(), FEW, |range| {
        let mut own = trial.clone();
        let fates: Vec<Fate> = range.map(|e| fate(case, e, listed, &mut own)).collect();
        (fates, own)
    });
    let mut fates = Vec::with_capacity(case.input.edges.len());
    for (part, own) in parts {
        fates.extend(part);
        findings.append(own);
    }
    fates
}

fn fate(case: &Case, e: usize, listed: &Listed, findings: &mut Findings) -> Fate {
    let edge = &case.input.edges[e];
    // Rounded Steiner points permit several chains: that of listed edges, if there is one, is meant.
    let found = chain(case, edge.ends, &|v| listed.neighbours(v).to_vec(), &|e| {
        listed.has(e)
    })
    .or_else(|| {
        let has_edge = |e| listed.surface.has_edge(sorted2(e)) || case.tables.has_edge(e);
        chain(case, edge.ends, &|v| case.tables.neighbours(v), &has_edge)
    });
    let unlisted = case.merges_near()
        && found
            .as_ref()
            .is_some_and(|c| is_unlisted(listed, c, edge.ends));
    let fate = if let Some(chain) = found.filter(|_| !unlisted || !is_mergeable(case, e)) {
        chain
    } else if is_mergeable(case, e) {
        Fate::Merged
    } else if leaves(case, edge.ends) {
        Fate::Outside
    } else {
        absorbed(case, e).map_or(Fate::Missing, Fate::Absorbed)
    };
    let counts = &mut findings.counts;
    match &fate {
        Fate::Edge => {
            counts.segments += 1;
            counts.subsegments += 1;
        }
        Fate::Chain(chain) => {
            counts.segments += 1;
            counts.subsegments += chain.len() - 1;
            for &v in &chain[1..chain.len() - 1] {
                if case.points.collinear([edge.ends[0], edge.ends[1], v]) {
                    counts.segment_vertices_exact += 1;
                } else {
                    counts.segment_vertices_rounded += 1;
                }
            }
        }
        Fate::Merged | Fate::Absorbed(_) => counts.segments_merged += 1,
        Fate::Outside => counts.segments_outside += 1,
        Fate::Missing => report(case, e, findings),
    }
    fate
}

/// Whether the mesh lists edges, but not those of the chain.
fn is_unlisted(listed: &Listed, chain: &Fate, ends: [VertexId; 2]) -> bool {
    listed.has_edges() && !chain.edges(ends).iter().any(|&e| listed.has(e))
}

/// Reports an input edge as missing.
pub(crate) fn report(case: &Case, e: usize, findings: &mut Findings) {
    let edge = &case.input.edges[e];
    findings.report(Violation::MissingSegment {
        ends: edge.ends.map(|v| case.place(v)),
        facets: edge.facets.clone(),
    });
}

/// A chain of some edges of the mesh, [`Fate::Edge`] or [`Fate::Chain`]. `neighbours` are the other ends of those at
/// a vertex.
fn chain(
    case: &Case,
    [a, b]: [VertexId; 2],
    neighbours: &dyn Fn(VertexId) -> Vec<VertexId>,
    has_edge: &dyn Fn([VertexId; 2]) -> bool,
) -> Option<Fate> {
    if has_edge([a, b]) {
        return Some(Fate::Edge);
    }
    if !case.tables.is_used(a) || !case.tables.is_used(b) {
        return None;
    }
    let along = minus(case.points.at(b), case.points.at(a)).map(f64::abs);
    let axis = (0..3)
        .max_by(|&i, &j| along[i].total_cmp(&along[j]))
        .expect("three axes");
    let forward = case.points.order(axis, a, b);
    let order = |v: VertexId, w: VertexId| match forward {
        Ordering::Greater => case.points.order(axis, w, v),
        _ => case.points.order(axis, v, w),
    };
    // Depth first, nearest first; a vertex that led nowhere is not tried again.
    let mut tried = vec![a];
    let mut path = vec![a];
    while let Some(&v) = path.last() {
        if v == b {
            return Some(Fate::Chain(path));
        }
        let step = neighbours(v)
            .into_iter()
            .filter(|&w| order(v, w).is_lt())
            .filter(|&w| w == b || order(w, b).is_lt())
            .filter(|w| !tried.contains(w) && (*w == b || is_on(case, [a, b], *w)))
            .min_by(|&w, &x| order(w, x).then(w.cmp(&x)));
        match step {
            Some(w) => {
                tried.push(w);
                path.push(w);
            }
            None => {
                path.pop();
            }
        }
    }
    None
}

fn is_on(case: &Case, ends: [VertexId; 2], v: VertexId) -> bool {
    if case.input.is_site(v) {
        case.points.collinear([ends[0], ends[1], v])
    } else {
        case.points.near_line(ends, v, case.tolerance)
    }
}

/// Whether the segment is outside the domain: one of its ends is in no tetrahedron, or neither end leads into one.
fn leaves(case: &Case, [a, b]: [VertexId; 2]) -> bool {
    let unused = !case.tables.is_used(a) || !case.tables.is_used(b);
    unused || (!case.locator.enters(a, &[b]) && !case.locator.enters(b, &[a]))
}

/// Whether the edge is of exactly two facets (not counting equal ones) with the same markers, on opposite sides of it,
/// whose planes are the same: exactly, to [`super::super::options::VerifyOptions::precision`], or within
/// [`super::super::options::VerifyOptions::merge_angle`].
fn is_mergeable(case: &Case, e: usize) -> bool {
    let edge = &case.input.edges[e];
    let [f, g] = edge.facets[..] else {
        return false;
    };
    let [m, n] = [f, g].map(|i| case.input.markers_of(case.plc, i));
    if edge.explicit || m != n {
        return false;
    }
    let facets = [f, g].map(|i| &case.input.facets[i]);
    let [Some(p), Some(q)] = facets.map(|facet| facet.frame) else {
        return false;
    };
    let [a, b, c] = p;
    let coplanar = facets[0].flat
        && facets[1]
            .vertices
            .iter()
            .all(|&v| case.points.orient([a, b, c, v]).is_zero());
    let axes = if coplanar {
        axes_of(case, p)
    } else if flatness::is_flat(case, &[f, g]) {
        flatness::axes(case, &[f, g])
    } else {
        axes_of(case, p).filter(|_| within_angle(case, p, q))
    };
    let Some(axes) = axes else {
        return false;
    };
    let sides = facets.map(|facet| {
        let edges: Vec<_> = facet
            .edges
            .iter()
            .map(|&e| case.input.edges[e].ends)
            .collect();
        let area = Area::new(case.points, axes, &edges, &facet.holes);
        area.sides(edge.ends).filter(|_| area.upright.is_none())
    });
    matches!(
        sides,
        [Some([true, false]), Some([false, true])] | [Some([false, true]), Some([true, false])]
    )
}

/// The facets around an edge, if all of them are exactly coplanar and the markers of those on both sides are the same:
/// an edge of one facet inside another one, or of several that overlap.
fn absorbed(case: &Case, e: usize) -> Option<Vec<usize>> {
    let edge = &case.input.edges[e];
    let first = *edge.facets.first().filter(|_| !edge.explicit)?;
    let frame = case.input.facets[first].frame?;
    let axes = axes_of(case, frame)?;
    let on_plane = |f: usize| {
        let mut vertices = case.input.facets[f].vertices.iter();
        vertices.all(|&v| case.points.is_on_plane(frame, v))
    };
    let mut around = Vec::new();
    let mut markers = [Vec::new(), Vec::new()];
    for f in case.input.facets_near(case.points, &edge.ends) {
        let facet = &case.input.facets[f];
        let is_own = edge.facets.contains(&f);
        if facet.frame.is_none() || !on_plane(f) {
            if is_own {
                return None;
            }
            continue;
        }
        let edges: Vec<_> = facet
            .edges
            .iter()
            .map(|&e| case.input.edges[e].ends)
            .collect();
        let area = Area::new(case.points, axes, &edges, &facet.holes);
        let inside = || area.is_kept(area.cell_at(&edge.ends));
        let sides = area.sides(edge.ends).unwrap_or_else(|| [inside(); 2]);
        for (side, markers) in sides.into_iter().zip(&mut markers) {
            if side {
                markers.extend(case.input.markers_of(case.plc, f));
            }
        }
        if sides.contains(&true) {
            around.push(f);
        }
    }
    for markers in &mut markers {
        markers.sort_unstable();
        markers.dedup();
    }
    (!markers[0].is_empty() && markers[0] == markers[1]).then_some(around)
}

fn within_angle(case: &Case, p: [VertexId; 3], q: [VertexId; 3]) -> bool {
    let Some(angle) = case.options.merge_angle else {
        return false;
    };
    let [n, m] = [p, q].map(|t| {
        let [a, b, c] = t.map(|v| case.points.at(v));
        cross(minus(b, a), minus(c, a))
    });
    // The frames are oriented at will, and the facets lie on opposite sides, so the dihedral angle is the one above
    // 90°.
    let sine = dot(cross(n, m), cross(n, m)).sqrt();
    let deviation = sine.atan2(dot(n, m).abs()).to_degrees();
    180.0 - deviation >= angle
}

/// The axes that remain when the one nearest to the normal of the plane is dropped, in right-handed order.
pub(crate) fn axes_of(case: &Case, frame: [VertexId; 3]) -> Option<[usize; 2]> {
    let [a, b, c] = frame.map(|v| case.points.at(v));
    let normal = cross(minus(b, a), minus(c, a)).map(f64::abs);
    let mut drop = [0, 1, 2];
    drop.sort_by(|&i, &j| normal[j].total_cmp(&normal[i]));
    drop.into_iter()
        .map(|k| [(k + 1) % 3, (k + 2) % 3])
        .find(|&axes| !case.points.orient2d(axes, frame).is_zero())
}
