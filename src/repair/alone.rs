//! Facets and segments that are not valid for themselves: repeated corners are left out, what has no area or no length
//! is dropped, and edges are divided at corners of the same facet that lie on them.

use super::Refused;
use super::draft::Draft;
use super::notes::Repairs;
use crate::check::Parts;
use crate::exchange::{NoteCode, Plc, Segment};
use crate::mesh::VertexId;
use crate::plc::{EdgeName, FacetInput, FacetName, PlcError, VertexName};

/// Mends all facets and segments that have an error.
///
/// # Errors
/// The first error that is left.
pub(super) fn mend(plc: &Plc, parts: &Parts, repairs: &mut Repairs) -> Result<Draft, PlcError> {
    let mut draft = Draft::of(plc, parts.delta);
    let mut broken: Vec<usize> = parts.errors.iter().flat_map(PlcError::facets).collect();
    broken.sort_unstable();
    broken.dedup();
    let mut gone = vec![false; plc.facets.len()];
    for index in broken {
        let name = FacetName::new(plc, index);
        if !mend_facet(&mut draft, index, repairs)? {
            repairs.add(
                NoteCode::DegenerateFacets,
                name.to_string(),
                &[],
                &[name.number],
            );
            // Segments in it are meant for themselves.
            let polygons = &mut draft.plc.facets[index].polygons;
            polygons.retain(|polygon| polygon.len() == 2);
            gone[index] = polygons.is_empty();
        }
    }
    let at = |v: VertexId| draft.representative[v.index()];
    let is_point = |s: &Segment| at(s.ends[0]) == at(s.ends[1]);
    for segment in draft.plc.segments.iter().filter(|s| is_point(s)) {
        let example = format!("segment {}", EdgeName::new(plc, segment.ends));
        let ends = segment.ends.map(|v| VertexName::new(plc, v).number);
        repairs.add(NoteCode::DegenerateFacets, example, &ends, &[]);
    }
    let representative = &draft.representative;
    let at = |v: VertexId| representative[v.index()];
    draft
        .plc
        .segments
        .retain(|s| at(s.ends[0]) != at(s.ends[1]));
    match draft.replace(&gone, Vec::new()) {
        Ok(()) => Ok(draft),
        Err(Refused::Facet(error)) => Err(error),
        Err(Refused::NeedsVertex) => unreachable!("nothing was put into the place of a facet"),
    }
}

/// Mends a facet; `false` if nothing is left of it.
fn mend_facet(draft: &mut Draft, index: usize, repairs: &mut Repairs) -> Result<bool, PlcError> {
    // Of several errors the check has told only one.
    let exists = |v: &&VertexId| v.index() < draft.representative.len();
    let mut corners = draft.plc.facets[index].polygons.iter().flatten();
    if let Some(&v) = corners.find(|v| !exists(v)) {
        return Err(PlcError::NoSuchVertex {
            facet: FacetName::new(&draft.plc, index),
            vertex: VertexName::new(&draft.plc, v),
        });
    }
    loop {
        if draft.plc.facets[index].polygons.is_empty() {
            return Ok(false);
        }
        let checked = FacetInput::new(&draft.plc, index, &draft.representative, draft.delta);
        let checked = checked.and_then(|facet| match facet.is_area() {
            true => facet.polygon().map(drop),
            false => Ok(()),
        });
        match checked {
            Ok(()) => return Ok(true),
            Err(PlcError::RepeatedVertex { facet, vertex }) => {
                let example = format!("vertex {vertex} in {facet}");
                repairs.add(
                    NoteCode::RepeatedCorner,
                    example,
                    &[vertex.number],
                    &[facet.number],
                );
                let before = draft.plc.facets[index].polygons.len();
                leave_out_repeated(draft, index);
                note_dropped(draft, index, before, repairs);
            }
            Err(PlcError::TooFewVertices { .. }) => {
                let before = draft.plc.facets[index].polygons.len();
                drop_thin(draft, index);
                note_dropped(draft, index, before, repairs);
            }
            Err(PlcError::ZeroArea { .. }) => return Ok(false),
            Err(PlcError::VertexOnEdge {
                facet,
                vertex,
                edge: name,
            }) if name.0.iter().all(|end| end.id != vertex.id) => {
                let edge = name.0.map(|end| end.id);
                let example = format!("vertex {vertex} on edge {name} of {facet}");
                repairs.add(
                    NoteCode::VertexOnEdge,
                    example,
                    &[vertex.number],
                    &[facet.number],
                );
                divide_edge(draft, index, edge, vertex.id);
            }
            Err(error) => return Err(error),
        }
    }
}

/// Notes polygons that have been dropped from a facet of which something is left.
fn note_dropped(draft: &Draft, index: usize, before: usize, repairs: &mut Repairs) {
    let left = draft.plc.facets[index].polygons.len();
    if left > 0 && left < before {
        let name = FacetName::new(&draft.plc, index);
        let example = format!("a polygon of {name}");
        repairs.add(NoteCode::DegenerateFacets, example, &[], &[name.number]);
    }
}

/// Leaves out corners that are equal to the one before. A polygon of which fewer than three are left is dropped, unless
/// it was a segment; that then is a vertex.
fn leave_out_repeated(draft: &mut Draft, index: usize) {
    let representative = &draft.representative;
    let of = |v: VertexId| representative[v.index()];
    draft.plc.facets[index].polygons.retain_mut(|polygon| {
        let given = polygon.len();
        polygon.dedup_by_key(|v| of(*v));
        while polygon.len() > 1 && of(polygon[0]) == of(polygon[polygon.len() - 1]) {
            polygon.pop();
        }
        given < 3 || polygon.len() >= 3
    });
}

/// Drops closed polygons of fewer than three different corners.
fn drop_thin(draft: &mut Draft, index: usize) {
    let representative = &draft.representative;
    let of = |v: VertexId| representative[v.index()];
    draft.plc.facets[index].polygons.retain(|polygon| {
        let first = polygon[..polygon.len().min(2)].iter().map(|&v| of(v));
        let first: Vec<VertexId> = first.collect();
        polygon.len() < 3 || !polygon.iter().all(|&v| first.contains(&of(v)))
    });
}

/// Divides an edge of a facet at a vertex.
fn divide_edge(draft: &mut Draft, index: usize, [a, b]: [VertexId; 2], vertex: VertexId) {
    let representative = &draft.representative;
    let of = |v: VertexId| representative[v.index()];
    let is_edge = |x: VertexId, y: VertexId| {
        let (x, y) = (of(x), of(y));
        (x, y) == (of(a), of(b)) || (y, x) == (of(a), of(b))
    };
    let mut divided = Vec::new();
    for polygon in &draft.plc.facets[index].polygons {
        match polygon[..] {
            [x, y] if is_edge(x, y) => divided.extend([vec![x, vertex], vec![vertex, y]]),
            [_] | [_, _] => divided.push(polygon.clone()),
            _ => {
                let mut corners = Vec::with_capacity(polygon.len() + 1);
                for (i, &v) in polygon.iter().enumerate() {
                    corners.push(v);
                    if is_edge(v, polygon[(i + 1) % polygon.len()]) {
                        corners.push(vertex);
                    }
                }
                divided.push(corners);
            }
        }
    }
    draft.plc.facets[index].polygons = divided;
}
