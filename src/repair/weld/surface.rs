//! The surface of an input, and whether it stays what it is when clusters of its vertices become one.

use super::distance;
use crate::exchange::Plc;
use crate::mesh::VertexId;
use crate::plc::{representatives, undirected};
use rustc_hash::{FxHashMap, FxHashSet};

/// The facets as polygons of different vertices, and their edges.
pub(super) struct Surface {
    pub(super) representative: Vec<VertexId>,
    pub(super) polygons: Vec<Vec<VertexId>>,
    /// How many polygons each edge has.
    pub(super) edges: FxHashMap<[VertexId; 2], usize>,
    /// The polygons at each vertex.
    pub(super) at: FxHashMap<VertexId, Vec<u32>>,
}

impl Surface {
    pub(super) fn new(plc: &Plc) -> Surface {
        let representative = representatives(&plc.vertices);
        let of = |v: &VertexId| representative[v.index()];
        let all = plc.facets.iter().flat_map(|f| &f.polygons);
        let polygons: Vec<Vec<VertexId>> = all
            .filter(|p| p.len() > 2)
            .map(|p| ring(p.iter().map(of)))
            .filter(|p| p.len() > 2)
            .collect();
        let mut edges = FxHashMap::default();
        for edge in polygons.iter().flat_map(|p| sides(p)) {
            *edges.entry(edge).or_insert(0) += 1;
        }
        Surface {
            representative,
            at: polygons_at(&polygons),
            polygons,
            edges,
        }
    }

    /// The vertices of open edges, and of polygons no larger than `small`.
    pub(super) fn movable(&self, plc: &Plc, small: f64) -> FxHashSet<VertexId> {
        let open = self.edges.iter().filter(|(_, count)| **count == 1);
        let mut movable: FxHashSet<VertexId> = open.flat_map(|(ends, _)| *ends).collect();
        let at = |v: &VertexId| plc.vertices[v.index()];
        for polygon in &self.polygons {
            let pairs = || polygon.iter().enumerate();
            if pairs().all(|(i, v)| polygon[..i].iter().all(|w| distance(at(v), at(w)) <= small)) {
                movable.extend(polygon);
            }
        }
        movable
    }

    /// Which clusters would change the surface if all were welded.
    pub(super) fn changes(&self, clusters: &[Vec<VertexId>]) -> Vec<bool> {
        let mut cluster_of: FxHashMap<VertexId, usize> = FxHashMap::default();
        for (i, cluster) in clusters.iter().enumerate() {
            cluster_of.extend(cluster.iter().map(|&v| (v, i)));
        }
        let to = |v: &VertexId| cluster_of.get(v).map_or(*v, |&i| clusters[i][0]);
        let mut wrong = vec![false; clusters.len()];
        let blame = |polygon: &[VertexId], wrong: &mut Vec<bool>| {
            polygon
                .iter()
                .filter_map(|v| cluster_of.get(v))
                .for_each(|&i| wrong[i] = true);
        };
        let after: Vec<Vec<VertexId>> = self
            .polygons
            .iter()
            .map(|p| ring(p.iter().map(to)))
            .collect();
        // Parts of the surface of which nothing is left.
        for part in self.parts() {
            if part.iter().all(|&p| after[p].len() < 3) {
                part.iter()
                    .for_each(|&p| blame(&self.polygons[p], &mut wrong));
            }
        }
        let mut same: FxHashMap<Vec<VertexId>, usize> = FxHashMap::default();
        for (i, polygon) in after.iter().enumerate().filter(|(_, p)| p.len() > 2) {
            let mut corners = polygon.clone();
            corners.sort_unstable();
            let repeats = corners.windows(2).any(|w| w[0] == w[1]);
            let earlier = same.insert(corners, i);
            let was_same = |j: usize| {
                let sorted = |p: &[VertexId]| {
                    let mut p = p.to_vec();
                    p.sort_unstable();
                    p
                };
                sorted(&self.polygons[i]) == sorted(&self.polygons[j])
            };
            if repeats || earlier.is_some_and(|j| !was_same(j)) {
                blame(&self.polygons[i], &mut wrong);
                earlier
                    .iter()
                    .for_each(|&j| blame(&self.polygons[j], &mut wrong));
            }
        }
        self.check_edges(&after, &cluster_of, clusters, &mut wrong);
        let at_after = polygons_at(&after);
        for (i, cluster) in clusters.iter().enumerate() {
            let before = cluster
                .iter()
                .map(|v| fans(*v, &self.polygons, self.at.get(v)));
            let most = before.max().unwrap_or(0).max(1);
            let now = fans(cluster[0], &after, at_after.get(&cluster[0]));
            wrong[i] |= now == 0 || now > most || !self.is_contractible(cluster);
        }
        wrong
    }

    /// Edges with more polygons than two and than any of those that are one now had.
    fn check_edges(
        &self,
        after: &[Vec<VertexId>],
        cluster_of: &FxHashMap<VertexId, usize>,
        clusters: &[Vec<VertexId>],
        wrong: &mut [bool],
    ) {
        let to = |v: VertexId| cluster_of.get(&v).map_or(v, |&i| clusters[i][0]);
        let mut most: FxHashMap<[VertexId; 2], usize> = FxHashMap::default();
        for (ends, &count) in &self.edges {
            let ends = undirected(ends.map(to));
            let most = most.entry(ends).or_insert(2);
            *most = count.max(*most);
        }
        let mut now: FxHashMap<[VertexId; 2], usize> = FxHashMap::default();
        for edge in after.iter().filter(|p| p.len() > 2).flat_map(|p| sides(p)) {
            *now.entry(edge).or_insert(0) += 1;
        }
        for (ends, count) in now {
            if count > most.get(&ends).copied().unwrap_or(2) {
                let owners = ends.iter().filter_map(|v| cluster_of.get(v));
                owners.for_each(|&i| wrong[i] = true);
            }
        }
    }

    /// Whether what vanishes in a cluster, its polygons and edges, is contractible, or closed to that by filling a
    /// hole.
    fn is_contractible(&self, cluster: &[VertexId]) -> bool {
        let inside = |v: &VertexId| cluster.binary_search(v).is_ok();
        let mut polygons: Vec<u32> = cluster
            .iter()
            .flat_map(|v| self.at.get(v).into_iter().flatten().copied())
            .collect();
        polygons.sort_unstable();
        polygons.dedup();
        let mut edges: FxHashSet<[VertexId; 2]> = FxHashSet::default();
        let mut faces = 0;
        for p in polygons {
            let polygon = &self.polygons[p as usize];
            edges.extend(sides(polygon).filter(|ends| ends.iter().all(inside)));
            faces += usize::from(polygon.iter().all(inside));
        }
        if faces == 0 {
            // Edges alone are trees, or loops: around a hole, or else the fans around the vertex tell.
            return true;
        }
        let mut parts: FxHashMap<VertexId, VertexId> = cluster.iter().map(|&v| (v, v)).collect();
        fn find(parts: &FxHashMap<VertexId, VertexId>, mut v: VertexId) -> VertexId {
            while parts[&v] != v {
                v = parts[&v];
            }
            v
        }
        let mut components = cluster.len();
        for &[a, b] in &edges {
            let [a, b] = [find(&parts, a), find(&parts, b)];
            if a != b {
                parts.insert(a, b);
                components -= 1;
            }
        }
        cluster.len() + faces == edges.len() + components
    }

    /// The polygons of each connected part.
    pub(super) fn parts(&self) -> Vec<Vec<usize>> {
        let mut part = vec![usize::MAX; self.polygons.len()];
        let mut parts: Vec<Vec<usize>> = Vec::new();
        for first in 0..self.polygons.len() {
            if part[first] != usize::MAX {
                continue;
            }
            part[first] = parts.len();
            let mut members = vec![first];
            let mut next = 0;
            while let Some(&p) = members.get(next) {
                next += 1;
                for v in &self.polygons[p] {
                    for &q in &self.at[v] {
                        if part[q as usize] == usize::MAX {
                            part[q as usize] = parts.len();
                            members.push(q as usize);
                        }
                    }
                }
            }
            parts.push(members);
        }
        parts
    }
}

/// The corners of a polygon without those that are the same as the one before.
fn ring(corners: impl Iterator<Item = VertexId>) -> Vec<VertexId> {
    let mut ring: Vec<VertexId> = corners.collect();
    ring.dedup();
    while ring.len() > 1 && ring.first() == ring.last() {
        ring.pop();
    }
    ring
}

/// The edges of a polygon with increasing ends.
pub(super) fn sides(p: &[VertexId]) -> impl Iterator<Item = [VertexId; 2]> + '_ {
    (0..p.len()).map(|i| undirected([p[i], p[(i + 1) % p.len()]]))
}

fn polygons_at(polygons: &[Vec<VertexId>]) -> FxHashMap<VertexId, Vec<u32>> {
    let mut at: FxHashMap<VertexId, Vec<u32>> = FxHashMap::default();
    for (i, polygon) in polygons.iter().enumerate().filter(|(_, p)| p.len() > 2) {
        for &v in polygon {
            let list = at.entry(v).or_default();
            if list.last() != Some(&(i as u32)) {
                list.push(i as u32);
            }
        }
    }
    at
}

/// How many fans the polygons at a vertex are: those with common edges at it are one.
fn fans(v: VertexId, polygons: &[Vec<VertexId>], around: Option<&Vec<u32>>) -> usize {
    let around = around.map_or(&[][..], |list| list);
    // The fan of each edge at v, by its other end.
    let mut fan_of: FxHashMap<VertexId, usize> = FxHashMap::default();
    let mut count = 0;
    let mut joined: Vec<usize> = Vec::new();
    fn find(joined: &[usize], mut fan: usize) -> usize {
        while joined[fan] != fan {
            fan = joined[fan];
        }
        fan
    }
    for &p in around {
        let polygon = &polygons[p as usize];
        let fan = joined.len();
        joined.push(fan);
        count += 1;
        for [a, b] in sides(polygon).filter(|ends| ends.contains(&v)) {
            let other = if a == v { b } else { a };
            let first = *fan_of.entry(other).or_insert(fan);
            let (x, y) = (find(&joined, first), find(&joined, fan));
            if x != y {
                joined[y] = x;
                count -= 1;
            }
        }
    }
    count
}
