//! Facets that are farther from flat than the precision of the input are divided into triangles.

use super::draft::{Draft, Replacement};
use super::merged::keep_loose_edges;
use crate::exchange::{Facet, Note, NoteCode, Plc};
use crate::mesh::VertexId;
use crate::plc::{FacetInput, FacetName, PlcError, representatives, triangles_of};

/// Divides the facets with vertices off their plane by more than `delta`, but at most `most` times the diameter of the
/// facet: by the constrained Delaunay triangulation of its projection. `None` if there are no such facets. What cannot
/// be divided stays as it is.
pub fn divide(plc: &Plc, delta: f64, most: f64) -> Option<(Plc, Note)> {
    let representative = representatives(&plc.vertices);
    let exists = |v: &VertexId| v.index() < plc.vertices.len();
    let is_large = |facet: &Facet| facet.polygons.iter().map(Vec::len).sum::<usize>() > 3;
    let mut gone = vec![false; plc.facets.len()];
    let mut replacements = Vec::new();
    let (mut names, mut farthest) = (Vec::new(), 0.0f64);
    for (index, facet) in plc.facets.iter().enumerate().filter(|(_, f)| is_large(f)) {
        let corners = || facet.polygons.iter().flatten();
        let finite = |v: &VertexId| plc.vertices[v.index()].iter().all(|x| x.is_finite());
        if !corners().all(|v| exists(v) && finite(v))
            || !facet.holes.iter().flatten().all(|x| x.is_finite())
        {
            continue;
        }
        let to = |delta| FacetInput::new(plc, index, &representative, delta);
        let Ok(input) = to(delta).map(|input| (input.is_area(), input.polygon())) else {
            continue;
        };
        let (true, Err(PlcError::NotPlanar { distance, .. })) = input else {
            continue;
        };
        if distance > most * diameter(plc, facet) {
            continue;
        }
        let polygon = to(f64::INFINITY).and_then(|input| input.polygon());
        let Ok(pieces) = polygon.and_then(|polygon| triangles_of(plc, &polygon)) else {
            continue;
        };
        for piece in pieces {
            replacements.push(Replacement {
                facet: Facet {
                    polygons: vec![piece.frame.to_vec()],
                    marker: facet.marker,
                    ..Facet::default()
                },
                edges: piece.edges,
                from: vec![index],
            });
        }
        gone[index] = true;
        names.push(FacetName::new(plc, index));
        farthest = farthest.max(distance);
    }
    let first = names.first()?;
    let count = names.len();
    let more = if count > 1 { ", …" } else { "" };
    let text = format!(
        "{count} facets are divided into triangles, as they are up to {farthest:.3e} from flat: {first}{more}"
    );
    let note =
        Note::new(NoteCode::FacetsDivided, count, text).on_facets(names.iter().map(|n| n.number));
    let mut draft = Draft::of(plc, f64::INFINITY);
    keep_loose_edges(&mut draft, &gone).ok()?;
    draft.replace(&gone, replacements).ok()?;
    Some((draft.plc, note))
}

/// The diagonal of the bounding box of a facet.
fn diameter(plc: &Plc, facet: &Facet) -> f64 {
    let extent = |k: usize| {
        let values = || {
            facet
                .polygons
                .iter()
                .flatten()
                .map(|v| plc.vertices[v.index()][k])
        };
        values().fold(f64::MIN, f64::max) - values().fold(f64::MAX, f64::min)
    };
    (0..3).map(|k| extent(k) * extent(k)).sum::<f64>().sqrt()
}
