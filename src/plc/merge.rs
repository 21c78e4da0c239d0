//! Adjacent coplanar facets become one polygon, so that nobody has to recover edges that are there only because a file
//! format knows nothing but triangles.
//!
//! Two facets are joined across an edge if it is an edge of these two alone, once in each, was not given explicitly,
//! both facets have the same marker, and all their vertices lie exactly on one plane. (Nearly flat facets are joined
//! afterwards, if at all: [`super::merge_near`].) Two such facets on the same side of their edge overlap, whatever
//! their markers: an error. Joining is transitive (union-find), and because every join is on one exact plane, so is the
//! whole group. Edges dropped are those across which two facets were joined, and no others: an explicit segment inside
//! the merged polygon stays in both directions.
//!
//! O(n + k) for k edges of polygons on n vertices with few edges each, one orientation test for each edge between
//! triangles.

use super::facet::{sorted, undirected};
use super::frame;
use super::plane::{Projected, Projection, orient3d};
use super::{EdgeName, FacetName, PlcError, Polygon};
use crate::exchange::Plc;
use crate::mesh::{Groups, VertexId};
use rustc_hash::FxHashSet;

/// A directed edge of a polygon, by its greater end.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Side {
    pub(super) end: VertexId,
    pub(super) polygon: u32,
    /// Whether it leads to its greater end.
    pub(super) ascends: bool,
}

/// Polygons after merging.
pub(super) struct Merged {
    /// The polygons, in order of their lowest facets.
    pub polygons: Vec<Polygon>,
    /// The edges that are edges no more, with increasing ends.
    pub dropped: FxHashSet<[VertexId; 2]>,
}

/// What becomes of polygons that overlap beside a common edge.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Overlapping {
    /// That is an error.
    Refused,
    /// They are not merged with each other.
    LeftApart,
}

/// Merges what can be merged. `explicit` holds the edges that must stay, with increasing ends.
pub(super) fn merge(
    plc: &Plc,
    polygons: Vec<Polygon>,
    explicit: &FxHashSet<[VertexId; 2]>,
    overlapping: Overlapping,
) -> Result<Merged, PlcError> {
    let mut groups = UnionFind::new(polygons.len());
    let mut dropped = FxHashSet::default();
    let sides = sides(plc.vertices.len(), &polygons);
    for least in (0..plc.vertices.len()).map(VertexId::new) {
        for sides in sides.of(least).chunk_by(|s, t| s.end == t.end) {
            let &[s, t] = sides else { continue };
            let (i, j, edge) = (s.polygon as usize, t.polygon as usize, [least, s.end]);
            let [f, g] = [&polygons[i], &polygons[j]];
            if i == j || !coplanar(plc, f, g) {
                continue;
            }
            let flipped = is_flipped(plc, f, g);
            if (s.ascends == t.ascends) != flipped {
                if overlapping == Overlapping::LeftApart {
                    continue;
                }
                return Err(overlap(plc, f, g, edge));
            }
            if f.marker != g.marker || explicit.contains(&edge) {
                continue;
            }
            groups.join(i, j, flipped);
            dropped.insert(edge);
        }
    }
    if dropped.is_empty() {
        return Ok(Merged { polygons, dropped });
    }

    // The root of a group is its lowest polygon, so this is the order of lowest facets.
    let roots: Vec<usize> = (0..polygons.len()).map(|i| groups.find(i).0).collect();
    let members = roots.iter().zip(0usize..);
    let members = Groups::new(
        polygons.len(),
        members.map(|(&root, i)| (VertexId::new(root), i)),
    );
    let mut joined = Vec::new();
    for i in 0..polygons.len() {
        let group = members.of(VertexId::new(i));
        if group.len() > 1 {
            match join(plc, &polygons, group, &mut groups, &dropped) {
                Err(error) if overlapping == Overlapping::Refused => return Err(error),
                result => joined.push(result.ok()),
            }
        }
    }
    let mut joined = joined.into_iter();
    let mut merged = Vec::new();
    let mut apart = vec![false; roots.len()];
    for (i, polygon) in polygons.into_iter().enumerate() {
        if members.of(VertexId::new(i)).len() > 1 {
            match joined.next().flatten() {
                Some(joined) => merged.push(joined),
                None => apart[i] = true,
            }
        }
        if apart[roots[i]] || members.of(VertexId::new(roots[i])).len() == 1 {
            merged.push(polygon);
        }
    }
    Ok(Merged {
        polygons: merged,
        dropped,
    })
}

/// All edges of all polygons by their lesser ends, of n vertices, sorted so that those with the same ends are together.
pub(super) fn sides(n: usize, polygons: &[Polygon]) -> Groups<Side> {
    let mut sides = Groups::new(n, (0u32..).zip(polygons).flat_map(sides_of));
    sides.sort_groups(|&side| side);
    sides
}

fn sides_of((polygon, f): (u32, &Polygon)) -> impl Iterator<Item = (VertexId, Side)> + Clone + '_ {
    let side = move |&[a, b]: &[VertexId; 2]| {
        let side = Side {
            end: a.max(b),
            polygon,
            ascends: a < b,
        };
        (a.min(b), side)
    };
    f.edges.iter().map(side)
}

/// Whether all vertices of f and g are exactly on one plane.
fn coplanar(plc: &Plc, f: &Polygon, g: &Polygon) -> bool {
    let [a, b, c] = points(plc, f.frame);
    let on_plane = |v: VertexId| {
        f.frame.contains(&v) || orient3d([a, b, c, plc.vertices[v.index()]]).is_zero()
    };
    f.flat && g.flat && g.frame.iter().all(|&v| on_plane(v))
}

/// Whether the frames of two coplanar polygons turn in opposite directions.
fn is_flipped(plc: &Plc, f: &Polygon, g: &Polygon) -> bool {
    let (projection, sign) =
        Projection::of(points(plc, f.frame)).expect("a frame is not collinear");
    let plane = Projected {
        points: &plc.vertices,
        projection,
    };
    plane.orient(g.frame) != sign
}

/// The polygon of a group, oriented as its lowest member.
fn join(
    plc: &Plc,
    polygons: &[Polygon],
    group: &[usize],
    groups: &mut UnionFind,
    dropped: &FxHashSet<[VertexId; 2]>,
) -> Result<Polygon, PlcError> {
    let mut sides = Vec::new();
    for &polygon in group {
        let (_, flipped) = groups.find(polygon);
        for &[a, b] in &polygons[polygon].edges {
            let directed = if flipped { [b, a] } else { [a, b] };
            if !dropped.contains(&undirected(directed)) {
                sides.push((directed, polygon));
            }
        }
    }
    sides.sort_unstable();
    if let Some(pair) = sides.windows(2).find(|pair| pair[0].0 == pair[1].0) {
        let [f, g] = [&polygons[pair[0].1], &polygons[pair[1].1]];
        return Err(overlap(plc, f, g, pair[0].0));
    }
    let first = &polygons[group[0]];
    let vertices = sorted(
        group
            .iter()
            .flat_map(|&i| polygons[i].vertices.iter().copied())
            .collect(),
    );
    let [a, b, c] = frame::choose(&plc.vertices, &vertices).expect("a polygon is not collinear");
    let mut joined = Polygon {
        edges: sides.into_iter().map(|(edge, _)| edge).collect(),
        vertices,
        frame: [a, b, c],
        flat: true,
        facets: group
            .iter()
            .flat_map(|&i| polygons[i].facets.iter().copied())
            .collect(),
        marker: first.marker,
    };
    if is_flipped(plc, first, &joined) {
        joined.frame = [a, c, b];
    }
    Ok(joined)
}

fn points(plc: &Plc, frame: [VertexId; 3]) -> [[f64; 3]; 3] {
    frame.map(|v| plc.vertices[v.index()])
}

fn overlap(plc: &Plc, f: &Polygon, g: &Polygon, edge: [VertexId; 2]) -> PlcError {
    PlcError::FacetsOverlap {
        first: FacetName::new(plc, f.facets[0]),
        second: FacetName::new(plc, g.facets[0]),
        edge: EdgeName::new(plc, edge),
    }
}

/// Union-find, where every element knows whether it is flipped with respect to the root of its group.
struct UnionFind {
    parent: Vec<(usize, bool)>,
}

impl UnionFind {
    fn new(n: usize) -> UnionFind {
        UnionFind {
            parent: (0..n).map(|i| (i, false)).collect(),
        }
    }

    /// The lowest element of the group of i, and whether i is flipped with respect to it.
    fn find(&mut self, i: usize) -> (usize, bool) {
        let (mut root, mut flipped) = (i, false);
        while self.parent[root].0 != root {
            flipped ^= self.parent[root].1;
            root = self.parent[root].0;
        }
        let (mut at, mut rest) = (i, flipped);
        while self.parent[at].0 != at {
            let (next, step) = self.parent[at];
            self.parent[at] = (root, rest);
            rest ^= step;
            at = next;
        }
        (root, flipped)
    }

    fn join(&mut self, i: usize, j: usize, flipped: bool) {
        let ((a, i_flipped), (b, j_flipped)) = (self.find(i), self.find(j));
        let between = flipped ^ i_flipped ^ j_flipped;
        if a != b {
            self.parent[a.max(b)] = (a.min(b), between);
        }
    }
}
