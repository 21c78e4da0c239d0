//! The planes of facets, and which vertices are on them.

use crate::mesh::VertexId;
use crate::verify::case::Case;

/// Whether a vertex is on one of the planes: exactly, or if it is a Steiner point within the tolerance.
pub(crate) fn is_on_planes(case: &Case, planes: &[([VertexId; 3], f64)], v: VertexId) -> bool {
    planes.iter().any(|&(plane, tolerance)| {
        case.points.is_on_plane(plane, v)
            || (!case.input.is_site(v) && case.points.near_plane(plane, v, tolerance))
    })
}

/// The planes of the facets with their tolerances: one if all are exactly on one.
pub(crate) fn planes(case: &Case, facets: &[usize]) -> Vec<([VertexId; 3], f64)> {
    let near = match facets.len() {
        1 => 0.0,
        _ => 4.0 * case.options.precision,
    };
    let facets = || facets.iter().map(|&f| &case.input.facets[f]);
    let mut planes = facets().filter_map(|facet| {
        // The bulge is rounded, and so is what is computed with it.
        let tolerance = match facet.flat {
            true => case.tolerance,
            false => facet.bulge + case.tolerance.max(case.rounding),
        };
        // Where facets are merged to a precision, what is inside one of them is so far from its plane at most.
        let tolerance = tolerance.max(near);
        facet.frame.map(|frame| (frame, tolerance))
    });
    let Some(first) = planes.next() else {
        return Vec::new();
    };
    if facets().count() == 1 {
        return vec![first];
    }
    let is_on_first = |&v: &VertexId| case.points.is_on_plane(first.0, v);
    let coplanar = facets().all(|facet| {
        (facet.flat || facet.frame.is_none()) && facet.vertices.iter().all(is_on_first)
    });
    let others = planes.filter(|_| !coplanar);
    std::iter::once(first).chain(others).collect()
}
