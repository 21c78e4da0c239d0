//! Coplanar facets that overlap: they are divided along each other, and each piece is one facet, whoever has it.

use super::Refused;
use super::areas::{facet_of, polygon_of};
use super::draft::{Draft, Replacement};
use super::inside::facets_in_contact;
use super::merged::keep_loose_edges;
use super::notes::Repairs;
use crate::check::{Contacts, Parts};
use crate::exchange::{NoteCode, Plc, Segment};
use crate::mesh::VertexId;
use crate::plc::{
    Faces, FacetName, Polygon, Projected, Projection, has_conflict, orient3d, sorted, undirected,
};
use rustc_hash::FxHashMap;
use std::collections::BTreeMap;

/// Divides facets that overlap, which have all edges and vertices that lie in them. O(n log n + ck) for groups of
/// overlapping facets with k edges in c components.
pub(super) fn divide(
    draft: &mut Draft,
    parts: &Parts,
    found: &Contacts,
    repairs: &mut Repairs,
) -> Result<(), Refused> {
    let mut polygons: BTreeMap<usize, Polygon> = BTreeMap::new();
    for index in facets_in_contact(parts, found) {
        let facet = draft.facet(index)?;
        if facet.is_area() {
            let polygon = facet.polygon()?;
            if polygon.flat {
                polygons.insert(index, polygon);
            }
        }
    }
    let mut gone = vec![false; draft.plc.facets.len()];
    let mut replacements = Vec::new();
    for members in groups(&draft.plc, &polygons, parts, found) {
        let group = Group::new(&draft.plc, &polygons, &members)?;
        let Some(group) = group else { continue };
        group.report(repairs);
        replacements.append(&mut group.pieces()?);
        for &f in &group.overlapping {
            gone[f] = true;
        }
        let segments = group.between_markers();
        draft.plc.segments.extend(segments);
    }
    if !replacements.is_empty() {
        keep_loose_edges(draft, &gone)?;
        draft.replace(&gone, replacements)?;
    }
    Ok(())
}

/// The facets in contact, those together that are coplanar, directly or through others; sorted.
fn groups(
    plc: &Plc,
    polygons: &BTreeMap<usize, Polygon>,
    parts: &Parts,
    found: &Contacts,
) -> Vec<Vec<usize>> {
    let mut leader: BTreeMap<usize, usize> = polygons.keys().map(|&f| (f, f)).collect();
    fn lead(leader: &mut BTreeMap<usize, usize>, f: usize) -> usize {
        let mut at = f;
        while leader[&at] != at {
            let next = leader[&leader[&at]];
            leader.insert(at, next);
            at = next;
        }
        at
    }
    for pair in &found.pairs {
        let [Some(f), Some(g)] = pair.map(|part| parts.parts[part as usize].facet()) else {
            continue;
        };
        let (Some(p), Some(q)) = (polygons.get(&f), polygons.get(&g)) else {
            continue;
        };
        if coplanar(plc, p, q) {
            let (f, g) = (lead(&mut leader, f), lead(&mut leader, g));
            leader.insert(f.max(g), f.min(g));
        }
    }
    let mut groups: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for &f in polygons.keys() {
        groups.entry(lead(&mut leader, f)).or_default().push(f);
    }
    groups
        .into_values()
        .filter(|group| group.len() > 1)
        .collect()
}

fn coplanar(plc: &Plc, f: &Polygon, g: &Polygon) -> bool {
    let at = |v: VertexId| plc.vertices[v.index()];
    let [a, b, c] = f.frame.map(at);
    g.frame
        .iter()
        .all(|&v| f.frame.contains(&v) || orient3d([a, b, c, at(v)]).is_zero())
}

/// Coplanar facets of which some overlap.
struct Group<'a> {
    plc: &'a Plc,
    plane: Projected<'a>,
    faces: Faces,
    /// The facets that have each face.
    covers: Vec<Vec<usize>>,
    /// The facets that have a face in common with others; sorted.
    overlapping: Vec<usize>,
    /// The vertices in faces that are on no edge.
    floating: Vec<Vec<VertexId>>,
}

impl<'a> Group<'a> {
    /// Divides the plane of some facets by all their edges; `None` if none of them overlap.
    fn new(
        plc: &'a Plc,
        polygons: &BTreeMap<usize, Polygon>,
        members: &[usize],
    ) -> Result<Option<Group<'a>>, Refused> {
        let points = &plc.vertices;
        let frame = polygons[&members[0]].frame.map(|v| points[v.index()]);
        let (projection, _) = Projection::of(frame).expect("a frame is not collinear");
        let plane = Projected { points, projection };
        // The facets to the left of directed edges.
        let mut left: FxHashMap<[VertexId; 2], Vec<usize>> = FxHashMap::default();
        for &f in members {
            let turned = plane.orient(polygons[&f].frame).is_negative();
            for &[a, b] in &polygons[&f].edges {
                let edge = if turned { [b, a] } else { [a, b] };
                left.entry(edge).or_default().push(f);
            }
        }
        let mut edges: Vec<_> = left.keys().copied().map(undirected).collect();
        edges.sort_unstable();
        edges.dedup();
        if has_conflict(&plane, &edges) {
            return Err(Refused::NeedsVertex);
        }
        let faces = Faces::new(&plane, &edges);
        // A facet has all edges of the others that lie in it, and so all of the boundary of each face in it.
        let covers: Vec<Vec<usize>> = faces
            .list
            .iter()
            .map(|face| {
                let edge = face.edges().next().expect("a face has a boundary");
                left.get(&edge).cloned().unwrap_or_default()
            })
            .collect();
        let shared = covers.iter().filter(|of| of.len() > 1).flatten();
        let mut overlapping: Vec<usize> = shared.copied().collect();
        overlapping.sort_unstable();
        overlapping.dedup();
        if overlapping.is_empty() {
            return Ok(None);
        }
        let ends = sorted(edges.concat());
        let mut floating = vec![Vec::new(); faces.list.len()];
        let vertices = members
            .iter()
            .flat_map(|f| polygons[f].vertices.iter().copied());
        for v in sorted(vertices.collect()) {
            if ends.binary_search(&v).is_err()
                && let Some(face) = faces.at(plane.at(v))
            {
                floating[face].push(v);
            }
        }
        Ok(Some(Group {
            plc,
            plane,
            faces,
            covers,
            overlapping,
            floating,
        }))
    }

    /// The faces that overlapping facets have, as facets.
    fn pieces(&self) -> Result<Vec<Replacement>, Refused> {
        let mut pieces = Vec::new();
        for (i, face) in self.faces.list.iter().enumerate() {
            let from = &self.covers[i];
            let is_new = |f: &usize| self.overlapping.binary_search(f).is_ok();
            if !from.iter().any(is_new) {
                continue;
            }
            let markers = from.iter().map(|&f| self.plc.facets[f].marker);
            let mut polygon = polygon_of(&self.plane, face, &self.floating[i]);
            polygon.marker = markers.filter(|&m| m != 0).min().unwrap_or(0);
            let facet = facet_of(self.plane.points, &polygon).ok_or(Refused::NeedsVertex)?;
            pieces.push(Replacement {
                facet,
                edges: polygon.edges,
                from: from.clone(),
            });
        }
        Ok(pieces)
    }

    /// The different markers of the facets that have each face.
    fn markers(&self) -> Vec<Vec<i64>> {
        let of = |from: &Vec<usize>| {
            let mut markers: Vec<i64> = from.iter().map(|&f| self.plc.facets[f].marker).collect();
            markers.sort_unstable();
            markers.dedup();
            markers
        };
        self.covers.iter().map(of).collect()
    }

    /// Edges where facets of one marker end though the piece beyond them has the same marker as the piece before:
    /// pieces with several markers are given one of them, and must not be merged with pieces that have that one alone.
    fn between_markers(&self) -> Vec<Segment> {
        let markers = self.markers();
        let mut sides: Vec<([VertexId; 2], &[i64])> = Vec::new();
        for (face, markers) in self.faces.list.iter().zip(&markers) {
            sides.extend(face.edges().map(|edge| (undirected(edge), &markers[..])));
        }
        sides.sort_unstable();
        let mut segments = Vec::new();
        for group in sides.chunk_by(|s, t| s.0 == t.0) {
            let beyond = group.get(1).map_or(&[][..], |side| side.1);
            let several = group[0].1.len() > 1 || beyond.len() > 1;
            if several && group[0].1 != beyond {
                let ends = group[0].0;
                segments.push(Segment { ends, marker: 0 });
            }
        }
        segments
    }

    /// Notes which facets are the same, and which overlap otherwise.
    fn report(&self, repairs: &mut Repairs) {
        let mut faces_of: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for (face, from) in self.covers.iter().enumerate() {
            from.iter()
                .for_each(|&f| faces_of.entry(f).or_default().push(face));
        }
        let mut same: BTreeMap<&[usize], Vec<usize>> = BTreeMap::new();
        for &f in &self.overlapping {
            same.entry(&faces_of[&f]).or_default().push(f);
        }
        let names = |list: &[usize]| {
            const SHOWN: usize = 4;
            let names = list
                .iter()
                .take(SHOWN)
                .map(|&f| FacetName::new(self.plc, f));
            let more = if list.len() > SHOWN { ", …" } else { "" };
            names
                .map(|name| name.to_string())
                .collect::<Vec<_>>()
                .join(", ")
                + more
        };
        let numbers = |list: &[usize]| -> Vec<i64> {
            list.iter()
                .map(|&f| FacetName::new(self.plc, f).number)
                .collect()
        };
        for equal in same.values().filter(|equal| equal.len() > 1) {
            repairs.add(NoteCode::RepeatedFacets, names(equal), &[], &numbers(equal));
        }
        // Those that have a face in common with one that is not the same.
        let shared = self.covers.iter().filter(|from| from.len() > 1);
        let partly = shared.filter(|from| from.iter().any(|f| faces_of[f] != faces_of[&from[0]]));
        let mut partly: Vec<usize> = partly.flatten().copied().collect();
        partly.sort_unstable();
        partly.dedup();
        if !partly.is_empty() {
            repairs.add(
                NoteCode::FacetsOverlap,
                names(&partly),
                &[],
                &numbers(&partly),
            );
        }
    }
}
