//! Adjacent facets that lie on one plane up to the precision of the input become one polygon: a flat face that was
//! triangulated and then rounded.
//!
//! A group of polygons grows from its largest one, across edges that two polygons alone have, one on each side, with
//! the same marker, and that are not given explicitly. A polygon joins if some plane is within δ, along each axis, of
//! all vertices of the group and of its own ([`crate::number::slab`]); the plane is that of the whole group, so that
//! nothing drifts around a curve. It must lie on the same side as the others in projection: so the group does not go
//! around the rim of a thin plate.
//!
//! A group becomes one polygon if that is exactly a right one: in the projection of its frame, where signs are exact,
//! no member is turned over, and the edges that are left bound an area on their left, once. Then the members cover that
//! area once: they are positive, so that they cover a point as often as the edges go around it. Otherwise the members
//! are left apart.
//!
//! Which polygons form a group depends on their geometry and on the numbers of vertices, not on the order of facets.
//!
//! O(n log n) for n edges, as long as planes are moved seldom; each such move is linear in the size of its group.

use super::Polygon;
use super::crossing;
use super::facet::{sorted, undirected};
use super::flatness::FlatnessRule;
use super::frame;
use super::merge::sides;
use super::plane::{Projected, Projection, orient3d};
use super::subdivision::bound_area;
use crate::exchange::Plc;
use crate::mesh::{Groups, VertexId};
use crate::number::Sign;
use crate::number::slab::Slab;
use crate::number::vector::{cross, dot, minus, square};
use rustc_hash::FxHashSet;

/// What has been merged that is not exactly coplanar.
#[derive(Clone, Copy, Default, PartialEq, Eq, Debug, serde::Serialize)]
pub struct MergeCounts {
    /// Polygons that consist of several facets.
    pub polygons: usize,
    /// The facets, exactly coplanar ones counted as one, that they consist of.
    pub facets: usize,
    /// The edges between those.
    pub edges: usize,
    /// Groups of facets that are on one plane, but are left apart, as they make no right polygon.
    pub left_apart: usize,
}

/// Polygons after merging.
pub(super) struct MergedNear {
    /// The polygons, in order of their lowest members.
    pub polygons: Vec<Polygon>,
    /// The edges that are edges no more, with increasing ends.
    pub dropped: FxHashSet<[VertexId; 2]>,
    pub counts: MergeCounts,
}

/// An edge that two polygons alone have, with the same marker, and which may go.
#[derive(Clone, Copy)]
struct Contact {
    edge: [VertexId; 2],
    polygons: [usize; 2],
    /// Whether the polygons are oriented in opposite ways.
    flipped: bool,
}

/// Merges what can be merged. `explicit` holds the edges that must stay, with increasing ends.
pub(super) fn merge_near(
    plc: &Plc,
    polygons: Vec<Polygon>,
    explicit: &FxHashSet<[VertexId; 2]>,
    rule: &FlatnessRule,
) -> MergedNear {
    let growing = Growing {
        plc,
        polygons: &polygons,
        rule,
    };
    let contacts = contacts(plc, &polygons, explicit);
    let near: Vec<bool> = contacts.iter().map(|c| growing.is_near(c)).collect();
    let mut merged = MergedNear {
        polygons: Vec::new(),
        dropped: FxHashSet::default(),
        counts: MergeCounts::default(),
    };
    if !near.contains(&true) {
        merged.polygons = polygons;
        return merged;
    }
    let both = |(c, &near): (&Contact, &bool)| {
        let [i, j] = c.polygons;
        [(i, j, c.flipped), (j, i, c.flipped)].map(|pair| (near, pair))
    };
    let pairs = contacts.iter().zip(&near).flat_map(both);
    let pairs = pairs.filter(|&(near, _)| near);
    let neighbours = Groups::new(
        polygons.len(),
        pairs
            .map(|(_, (i, j, flipped))| (VertexId::new(i), (j, flipped)))
            .collect::<Vec<_>>()
            .iter()
            .copied(),
    );
    let groups = growing.groups(&neighbours);
    let mut group_of: Vec<Option<(usize, bool)>> = vec![None; polygons.len()];
    for (g, members) in groups.iter().enumerate() {
        for &(i, flipped) in members {
            group_of[i] = Some((g, flipped));
        }
    }
    let mut inner: Vec<Vec<[VertexId; 2]>> = vec![Vec::new(); groups.len()];
    for c in &contacts {
        if let [Some((g, f)), Some((h, e))] = c.polygons.map(|i| group_of[i])
            && g == h
            && c.flipped == (f != e)
        {
            inner[g].push(c.edge);
        }
    }
    let mut joined: Vec<Option<Polygon>> = Vec::with_capacity(groups.len());
    for (members, edges) in groups.iter().zip(&inner) {
        let polygon = growing.join(members, edges);
        match &polygon {
            Some(_) => {
                merged.counts.polygons += 1;
                merged.counts.facets += members.len();
                merged.counts.edges += edges.len();
                merged.dropped.extend(edges);
            }
            None => merged.counts.left_apart += 1,
        }
        joined.push(polygon);
    }
    let mut joined_is_placed = vec![false; groups.len()];
    for (i, polygon) in polygons.into_iter().enumerate() {
        match group_of[i] {
            Some((g, _)) if joined[g].is_some() || joined_is_placed[g] => {
                merged.polygons.extend(joined[g].take());
                joined_is_placed[g] = true;
            }
            _ => merged.polygons.push(polygon),
        }
    }
    merged
}

/// All edges across which polygons may be joined, in order of their ends.
fn contacts(plc: &Plc, polygons: &[Polygon], explicit: &FxHashSet<[VertexId; 2]>) -> Vec<Contact> {
    let mut found = Vec::new();
    let sides = sides(plc.vertices.len(), polygons);
    for least in (0..plc.vertices.len()).map(VertexId::new) {
        for sides in sides.of(least).chunk_by(|s, t| s.end == t.end) {
            let &[s, t] = sides else { continue };
            let (i, j, edge) = (s.polygon as usize, t.polygon as usize, [least, s.end]);
            if i != j && polygons[i].marker == polygons[j].marker && !explicit.contains(&edge) {
                found.push(Contact {
                    edge,
                    polygons: [i, j],
                    flipped: s.ascends == t.ascends,
                });
            }
        }
    }
    found
}

struct Growing<'a> {
    plc: &'a Plc,
    polygons: &'a [Polygon],
    rule: &'a FlatnessRule,
}

impl Growing<'_> {
    fn at(&self, v: VertexId) -> [f64; 3] {
        self.plc.vertices[v.index()]
    }

    fn frame(&self, i: usize) -> [[f64; 3]; 3] {
        self.polygons[i].frame.map(|v| self.at(v))
    }

    /// Whether two polygons may be on one plane: the triangles of their frames are.
    fn is_near(&self, contact: &Contact) -> bool {
        let [p, q] = contact.polygons.map(|i| self.frame(i));
        let by_angle = self
            .rule
            .merge_angle
            .is_some_and(|angle| deviation(p, q) <= 180.0 - angle);
        by_angle
            || (self.rule.merge
                && match (Slab::of(p), Slab::of(q)) {
                    (Some(mut slab), _) => slab.fit(&q, 0, self.rule.delta),
                    (_, Some(mut slab)) => slab.fit(&p, 0, self.rule.delta),
                    (None, None) => true,
                })
    }

    /// The groups of two members or more, each from its largest member on. A member with whether its orientation is
    /// opposite to that of the first.
    fn groups(&self, neighbours: &Groups<(usize, bool)>) -> Vec<Vec<(usize, bool)>> {
        let area = |i: usize| {
            let [a, b, c] = self.frame(i);
            square(cross(minus(b, a), minus(c, a)))
        };
        let of = |i: usize| neighbours.of(VertexId::new(i));
        let mut seeds: Vec<(f64, usize)> = (0..self.polygons.len())
            .filter(|&i| !of(i).is_empty())
            .map(|i| (area(i), i))
            .collect();
        seeds.sort_by(|(a, i), (b, j)| {
            let vertices = |i: &usize| &self.polygons[*i].vertices;
            b.total_cmp(a).then_with(|| vertices(i).cmp(vertices(j)))
        });
        let mut taken = vec![false; self.polygons.len()];
        let mut groups = Vec::new();
        for (_, seed) in seeds {
            if taken[seed] {
                continue;
            }
            let Some(mut group) = Group::new(self, seed) else {
                continue;
            };
            taken[seed] = true;
            let mut next = 0;
            while let Some(&(i, flipped)) = group.members.get(next) {
                next += 1;
                for &(j, turned) in of(i) {
                    if !taken[j] && group.takes(self, j, flipped != turned) {
                        taken[j] = true;
                    }
                }
            }
            if group.members.len() > 1 {
                groups.push(group.members);
            }
        }
        groups
    }

    /// The polygon of a group, oriented as its lowest member, if it is a right one. `inner` are the edges that go.
    fn join(&self, members: &[(usize, bool)], inner: &[[VertexId; 2]]) -> Option<Polygon> {
        let &(lowest, turn) = members.iter().min()?;
        let inner: FxHashSet<[VertexId; 2]> = inner.iter().copied().collect();
        let mut edges = Vec::new();
        let (mut vertices, mut facets) = (Vec::new(), Vec::new());
        for &(i, flipped) in members {
            let polygon = &self.polygons[i];
            for &[a, b] in &polygon.edges {
                if !inner.contains(&undirected([a, b])) {
                    edges.push(if flipped == turn { [a, b] } else { [b, a] });
                }
            }
            vertices.extend_from_slice(&polygon.vertices);
            facets.extend_from_slice(&polygon.facets);
        }
        edges.sort_unstable();
        facets.sort_unstable();
        facets.dedup();
        let vertices = sorted(vertices);
        let points = &self.plc.vertices;
        let [a, b, c] = frame::choose(points, &vertices)?;
        let corners = [a, b, c].map(|v| self.at(v));
        let (projection, sign) = Projection::of(corners)?;
        // Once more, beginning with these three.
        let all: Vec<[f64; 3]> = vertices.iter().map(|&v| self.at(v)).collect();
        if self.rule.merge_angle.is_none() && !Slab::of(corners)?.fit(&all, 0, self.rule.delta) {
            return None;
        }
        let plane = Projected { points, projection };
        // Positive as the lowest member is; no member is turned over or upright.
        let wanted = plane.orient(self.polygons[lowest].frame);
        let is_right = |&(i, flipped): &(usize, bool)| {
            let polygon = &self.polygons[i];
            let found = plane.orient(polygon.frame);
            let own = || Projection::of(self.frame(i)).map(|(own, _)| own.axis());
            let turned = if flipped == turn { found } else { -found };
            turned == wanted && (polygon.flat || own() == Some(projection.axis()))
        };
        if wanted.is_zero() || !members.iter().all(is_right) {
            return None;
        }
        let counterclockwise = |&[a, b]: &[VertexId; 2]| match wanted {
            Sign::Negative => [b, a],
            _ => [a, b],
        };
        let directed: Vec<[VertexId; 2]> = edges.iter().map(counterclockwise).collect();
        if !is_embedded(&plane, &directed, &vertices) {
            return None;
        }
        let frame = if sign == wanted { [a, b, c] } else { [a, c, b] };
        let corners = frame.map(|v| self.at(v));
        let on_plane = |v: &VertexId| {
            let [a, b, c] = corners;
            frame.contains(v) || orient3d([a, b, c, self.at(*v)]).is_zero()
        };
        Some(Polygon {
            edges,
            flat: vertices.iter().all(on_plane),
            vertices,
            frame,
            facets,
            marker: self.polygons[lowest].marker,
        })
    }
}

/// Whether edges, each with its area on the left, meet in common ends only and bound one area, and no vertex inside is
/// on them.
fn is_embedded(plane: &Projected, directed: &[[VertexId; 2]], vertices: &[VertexId]) -> bool {
    let mut twice = directed.to_vec();
    twice.sort_unstable();
    if twice.windows(2).any(|pair| pair[0] == pair[1]) {
        return false;
    }
    let mut edges: Vec<[VertexId; 2]> = directed.iter().copied().map(undirected).collect();
    edges.sort_unstable();
    edges.dedup();
    let ends = sorted(edges.concat());
    let mut floating = vertices.to_vec();
    floating.retain(|v| ends.binary_search(v).is_err());
    edges.iter().all(|[a, b]| plane.at(*a) != plane.at(*b))
        && crossing::find(plane, &edges, &floating).is_none()
        && bound_area(plane, directed)
}

/// A group that grows.
struct Group {
    members: Vec<(usize, bool)>,
    slab: Slab,
    /// Of the first member, for angles.
    frame: [[f64; 3]; 3],
    /// The orientation of the first member in the projection.
    sign: Sign,
    vertices: FxHashSet<VertexId>,
    points: Vec<[f64; 3]>,
}

impl Group {
    /// The group of one polygon, unless that is too close to a line.
    fn new(growing: &Growing, seed: usize) -> Option<Group> {
        let polygon = &growing.polygons[seed];
        let points: Vec<[f64; 3]> = polygon.vertices.iter().map(|&v| growing.at(v)).collect();
        let frame = growing.frame(seed);
        let mut slab = Slab::of(frame)?;
        let plane = Projected {
            points: &growing.plc.vertices,
            projection: Projection::along(slab.axis()),
        };
        let sign = plane.orient(polygon.frame);
        let fits = slab.fit(&points, 0, growing.rule.delta);
        ((fits || growing.rule.merge_angle.is_some()) && !sign.is_zero()).then(|| Group {
            members: vec![(seed, false)],
            slab,
            frame,
            sign,
            vertices: polygon.vertices.iter().copied().collect(),
            points,
        })
    }

    /// Takes a polygon into the group, if it is on the same plane and on the same side.
    fn takes(&mut self, growing: &Growing, i: usize, flipped: bool) -> bool {
        let polygon = &growing.polygons[i];
        let plane = Projected {
            points: &growing.plc.vertices,
            projection: Projection::along(self.slab.axis()),
        };
        let sign = plane.orient(polygon.frame);
        if (if flipped { -sign } else { sign }) != self.sign {
            return false;
        }
        let before = self.points.len();
        let vertices = polygon.vertices.iter();
        let new: Vec<VertexId> = vertices
            .copied()
            .filter(|v| !self.vertices.contains(v))
            .collect();
        self.points.extend(new.iter().map(|&v| growing.at(v)));
        let rule = growing.rule;
        let by_angle = rule
            .merge_angle
            .is_some_and(|angle| deviation(self.frame, growing.frame(i)) <= 180.0 - angle);
        let fits = by_angle || rule.merge && self.slab.fit(&self.points, before, rule.delta);
        if !fits {
            self.points.truncate(before);
            return false;
        }
        self.vertices.extend(new);
        self.members.push((i, flipped));
        true
    }
}

/// The angle between the planes of two triangles in degrees, at most 90. Rounded.
fn deviation(p: [[f64; 3]; 3], q: [[f64; 3]; 3]) -> f64 {
    let normal = |[a, b, c]: [[f64; 3]; 3]| cross(minus(b, a), minus(c, a));
    let (n, m) = (normal(p), normal(q));
    let sine = square(cross(n, m)).sqrt();
    sine.atan2(dot(n, m).abs()).to_degrees()
}
