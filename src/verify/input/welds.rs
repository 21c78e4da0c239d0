//! Input vertices that a mesh has not, because they were welded to others: moved by twice the stated precision at most.
//!
//! Such a vertex is taken for another one if that is within 2δ of it, along each axis, and no third one that the mesh
//! has is within ten times that; if both are ends of open edges, or corners of polygons that are smaller than 2δ; and
//! if something is left of each connected part of the surface. That the mesh fills what the facets enclose then, and
//! covers them, is asked by the claims as ever.

use crate::exchange::Plc;
use crate::mesh::VertexId;
use crate::verify::lookup::tables::sorted2;
use rustc_hash::{FxHashMap, FxHashSet};

/// How much farther than 2δ other vertices must be.
const GAP: f64 = 10.0;

/// Rounding of the comparisons, relative.
const SLACK: f64 = 1e-9;

/// Gives vertices the point of the one that they were welded to; returns how many. `is_used` says which points the mesh
/// has.
pub(crate) fn find(
    plc: &Plc,
    site_of: &mut [VertexId],
    is_used: impl Fn(VertexId) -> bool,
    precision: f64,
) -> usize {
    let gone: Vec<usize> = (0..site_of.len())
        .filter(|&i| !is_used(site_of[i]))
        .collect();
    if precision <= 0.0 || gone.is_empty() {
        return 0;
    }
    let near = 2.0 * precision * (1.0 + SLACK);
    let movable = movable(plc, site_of, near);
    let at = |i: usize| plc.vertices[i];
    let apart = |p: [f64; 3], q: [f64; 3]| (0..3).map(|k| (p[k] - q[k]).abs()).fold(0.0, f64::max);
    // Those that the mesh has, by their first coordinates; one of each place.
    let mut there: Vec<usize> = (0..site_of.len())
        .filter(|&i| is_used(site_of[i]))
        .collect();
    there.sort_unstable_by_key(|&i| site_of[i]);
    there.dedup_by_key(|&mut i| site_of[i]);
    there.sort_unstable_by(|&i, &j| at(i)[0].total_cmp(&at(j)[0]));
    let mut welds: FxHashMap<VertexId, VertexId> = FxHashMap::default();
    for &i in gone.iter().filter(|&&i| movable.contains(&site_of[i])) {
        let reach = GAP * near;
        let start = there.partition_point(|&j| at(j)[0] < at(i)[0] - reach);
        let ahead = there[start..]
            .iter()
            .take_while(|&&j| at(j)[0] <= at(i)[0] + reach);
        let mut close = ahead.filter(|&&j| apart(at(i), at(j)) <= reach);
        if let (Some(&j), None) = (close.next(), close.next())
            && apart(at(i), at(j)) <= near
            && movable.contains(&site_of[j])
        {
            welds.insert(site_of[i], site_of[j]);
        }
    }
    let to = |v: VertexId| welds.get(&v).copied().unwrap_or(v);
    if welds.is_empty() || !leaves_all_parts(plc, site_of, to) {
        return 0;
    }
    let welded = site_of.iter().filter(|v| welds.contains_key(v)).count();
    site_of.iter_mut().for_each(|v| *v = to(*v));
    welded
}

/// The polygons of facets that are more than segments.
fn polygons(plc: &Plc) -> impl Iterator<Item = &Vec<VertexId>> {
    plc.facets
        .iter()
        .flat_map(|f| &f.polygons)
        .filter(|p| p.len() > 2)
}

/// The ends of edges that only one polygon has, and the corners of polygons no larger than `small`.
fn movable(plc: &Plc, site_of: &[VertexId], small: f64) -> FxHashSet<VertexId> {
    let mut count: FxHashMap<[VertexId; 2], usize> = FxHashMap::default();
    let mut movable = FxHashSet::default();
    for polygon in polygons(plc) {
        let n = polygon.len();
        for i in 0..n {
            let ends = [polygon[i], polygon[(i + 1) % n]].map(|v| site_of[v.index()]);
            *count.entry(sorted2(ends)).or_default() += usize::from(ends[0] != ends[1]);
        }
        let is_small = (0..3).all(|k| {
            let values = || polygon.iter().map(|v| plc.vertices[v.index()][k]);
            values().fold(f64::MIN, f64::max) - values().fold(f64::MAX, f64::min) <= small
        });
        if is_small {
            movable.extend(polygon.iter().map(|v| site_of[v.index()]));
        }
    }
    movable.extend(
        count
            .iter()
            .filter(|(_, n)| **n == 1)
            .flat_map(|(ends, _)| *ends),
    );
    movable
}

/// Whether each connected part of the surface has a polygon with three different points.
fn leaves_all_parts(plc: &Plc, site_of: &[VertexId], to: impl Fn(VertexId) -> VertexId) -> bool {
    let mut leader: FxHashMap<VertexId, VertexId> = FxHashMap::default();
    fn find(leader: &mut FxHashMap<VertexId, VertexId>, v: VertexId) -> VertexId {
        let mut root = v;
        while let Some(&next) = leader.get(&root).filter(|&&next| next != root) {
            root = next;
        }
        leader.insert(v, root);
        root
    }
    for polygon in polygons(plc) {
        for pair in polygon.windows(2) {
            let [a, b] = [pair[0], pair[1]].map(|v| find(&mut leader, site_of[v.index()]));
            leader.insert(a.max(b), a.min(b));
        }
    }
    let (mut all, mut left) = (FxHashSet::default(), FxHashSet::default());
    for polygon in polygons(plc) {
        let part = find(&mut leader, site_of[polygon[0].index()]);
        all.insert(part);
        let mut points: Vec<VertexId> = polygon.iter().map(|v| to(site_of[v.index()])).collect();
        points.sort_unstable();
        points.dedup();
        if points.len() > 2 {
            left.insert(part);
        }
    }
    all == left
}
