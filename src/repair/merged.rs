//! Coplanar facets that are in contact with others are merged as [`Complex::new`](crate::plc::Complex::new) would merge
//! them: the edges between them are there only because a file knows nothing but triangles, and may cross others.

use super::Refused;
use super::areas::facet_of;
use super::draft::{Draft, Replacement};
use super::inside::facets_in_contact;
use crate::check::{Contacts, Parts};
use crate::exchange::Segment;
use crate::plc::{loose_edges, merged_polygons};

/// Merges facets of a PLC whose facets are valid for themselves; whether there were any.
pub(super) fn merge(draft: &mut Draft, parts: &Parts, found: &Contacts) -> Result<bool, Refused> {
    let mut in_contact = vec![false; draft.plc.facets.len()];
    for index in facets_in_contact(parts, found) {
        in_contact[index] = true;
    }
    let mut gone = vec![false; draft.plc.facets.len()];
    let mut replacements = Vec::new();
    for polygon in merged_polygons(&draft.plc, &draft.representative, draft.delta)? {
        if polygon.facets.len() == 1 || !polygon.facets.iter().any(|&f| in_contact[f]) {
            continue;
        }
        let facet = facet_of(&draft.plc.vertices, &polygon).ok_or(Refused::NeedsVertex)?;
        polygon.facets.iter().for_each(|&f| gone[f] = true);
        replacements.push(Replacement {
            facet,
            edges: polygon.edges,
            from: polygon.facets,
        });
    }
    if replacements.is_empty() {
        return Ok(false);
    }
    keep_loose_edges(draft, &gone)?;
    draft.replace(&gone, replacements)?;
    Ok(true)
}

/// Edges of facets that bound nothing of their area stay as segments when the facets go.
pub(super) fn keep_loose_edges(draft: &mut Draft, gone: &[bool]) -> Result<(), Refused> {
    let mut kept = Vec::new();
    for index in (0..gone.len()).filter(|&i| gone[i]) {
        let facet = draft.facet(index)?;
        if facet.polygons.len() > 1 || facet.polygons[0].len() > 3 {
            kept.extend(loose_edges(&facet, &facet.polygon()?));
        }
    }
    let segment = |ends| Segment { ends, marker: 0 };
    draft.plc.segments.extend(kept.into_iter().map(segment));
    Ok(())
}
