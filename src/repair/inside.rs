//! Vertices and edges exactly inside facets that do not have them: the facets get them, as one-vertex and two-vertex
//! polygons.

use super::Refused;
use super::draft::Draft;
use super::notes::Repairs;
use crate::check::{Contacts, Parts};
use crate::exchange::NoteCode;
use crate::mesh::VertexId;
use crate::plc::{
    EdgeName, FacetName, Polygon, Projected, Projection, VertexName, by_angle, sorted, undirected,
};

/// Completes the facets, whose edges have been divided. O(n log n) for facets that have few vertices, or few edges at
/// each.
pub(super) fn complete(
    draft: &mut Draft,
    parts: &Parts,
    found: &Contacts,
    repairs: &mut Repairs,
) -> Result<(), Refused> {
    add_vertices(draft, parts, found, repairs)?;
    let all = draft.edges();
    for index in facets_in_contact(parts, found) {
        let facet = draft.facet(index)?;
        if !facet.is_area() {
            continue;
        }
        let polygon = facet.polygon()?;
        let mut own: Vec<_> = facet.edges().map(undirected).collect();
        own.sort_unstable();
        let area = Area::new(&draft.plc.vertices, &polygon);
        let mut inside = Vec::new();
        for &a in &polygon.vertices {
            let first = all.partition_point(|e| e[0] < a);
            for &edge in all[first..].iter().take_while(|e| e[0] == a) {
                let is_candidate = polygon.vertices.binary_search(&edge[1]).is_ok()
                    && own.binary_search(&edge).is_err();
                if is_candidate && area.is_entered(edge) {
                    inside.push(edge);
                }
            }
        }
        for edge in inside {
            let facet = FacetName::new(&draft.plc, index);
            let example = format!("edge {} in {facet}", EdgeName::new(&draft.plc, edge));
            repairs.add(NoteCode::EdgeInFacet, example, &[], &[facet.number]);
            draft.plc.facets[index].polygons.push(edge.to_vec());
        }
    }
    Ok(())
}

/// The facets that are in contact with other parts, in order.
pub(super) fn facets_in_contact(parts: &Parts, found: &Contacts) -> Vec<usize> {
    let in_contact = found.pairs.iter().flatten();
    let facets = in_contact.filter_map(|&part| parts.parts[part as usize].facet());
    let mut facets: Vec<usize> = facets.collect();
    facets.sort_unstable();
    facets.dedup();
    facets
}

/// Adds to facets the vertices that lie on them and are not on their edges.
fn add_vertices(
    draft: &mut Draft,
    parts: &Parts,
    found: &Contacts,
    repairs: &mut Repairs,
) -> Result<(), Refused> {
    for group in found.on_triangles.chunk_by(|s, t| s.0 == t.0) {
        let Some(index) = parts.parts[group[0].0 as usize].facet() else {
            continue;
        };
        let own = sorted(draft.facet(index)?.polygons.concat());
        for &(_, v) in group.iter().filter(|(_, v)| own.binary_search(v).is_err()) {
            let facet = FacetName::new(&draft.plc, index);
            let vertex = VertexName::new(&draft.plc, v);
            let example = format!("vertex {vertex} on {facet}");
            repairs.add(
                NoteCode::VertexOnFacet,
                example,
                &[vertex.number],
                &[facet.number],
            );
            draft.plc.facets[index].polygons.push(vec![v]);
        }
    }
    Ok(())
}

/// The area of a polygon about its vertices.
struct Area<'a> {
    plane: Projected<'a>,
    /// Directed edges with the polygon on their left in the projection, and the same reversed. Both sorted.
    left: Vec<[VertexId; 2]>,
    right: Vec<[VertexId; 2]>,
}

impl<'a> Area<'a> {
    fn new(points: &'a [[f64; 3]], polygon: &Polygon) -> Area<'a> {
        let frame = polygon.frame.map(|v| points[v.index()]);
        let (projection, sign) = Projection::of(frame).expect("a frame is not collinear");
        let mut left = polygon.edges.clone();
        let mut right: Vec<_> = left.iter().map(|&[a, b]| [b, a]).collect();
        right.sort_unstable();
        if sign.is_negative() {
            std::mem::swap(&mut left, &mut right);
        }
        Area {
            plane: Projected { points, projection },
            left,
            right,
        }
    }

    /// Whether an edge ab, whose ends are vertices of the polygon and which is no edge of it, leads from a into its
    /// interior. If it does and crosses no edge of the polygon, it is inside.
    fn is_entered(&self, [a, b]: [VertexId; 2]) -> bool {
        let ends = |list: &[[VertexId; 2]]| {
            let first = list.partition_point(|e| e[0] < a);
            let at_a = list[first..].iter().take_while(|e| e[0] == a);
            at_a.map(|e| e[1]).collect::<Vec<_>>()
        };
        let mut around = sorted([ends(&self.left), ends(&self.right)].concat());
        if around.is_empty() {
            // A vertex that floats in the polygon.
            return true;
        }
        let [at, towards] = [a, b].map(|v| self.plane.at(v));
        around.sort_by(|&v, &w| by_angle(at, self.plane.at(v), self.plane.at(w)));
        let order = |v: VertexId| by_angle(at, self.plane.at(v), towards);
        let next = around.partition_point(|&v| order(v).is_lt());
        if around.get(next).is_some_and(|&v| order(v).is_eq()) {
            return false;
        }
        let before = around[(next + around.len() - 1) % around.len()];
        self.left.binary_search(&[a, before]).is_ok()
    }
}
