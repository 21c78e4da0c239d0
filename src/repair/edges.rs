//! Vertices exactly on edges that do not have them: the edges are divided there, in all facets and segments.

use super::draft::Draft;
use super::notes::Repairs;
use crate::check::{Contacts, Parts};
use crate::exchange::{NoteCode, Segment};
use crate::mesh::VertexId;
use crate::plc::{EdgeName, VertexName, undirected};
use rustc_hash::FxHashMap;

/// Divides edges at the vertices that lie on them. O(n log n).
pub(super) fn divide(draft: &mut Draft, _parts: &Parts, found: &Contacts, repairs: &mut Repairs) {
    if found.on_edges.is_empty() {
        return;
    }
    for &(edge, v) in &found.on_edges {
        let (name, vertex) = (
            EdgeName::new(&draft.plc, edge),
            VertexName::new(&draft.plc, v),
        );
        let example = format!("vertex {vertex} on edge {name}");
        repairs.add(NoteCode::VertexOnEdge, example, &[vertex.number], &[]);
    }
    let chains = chains(&draft.plc.vertices, &found.on_edges);
    let representative = &draft.representative;
    let of = |v: VertexId| representative[v.index()];
    // The vertices between the ends of an edge, in its direction.
    let between = |a: VertexId, b: VertexId| -> Vec<VertexId> {
        let (a, b) = (of(a), of(b));
        let mut inner = chains.get(&undirected([a, b])).cloned().unwrap_or_default();
        if a > b {
            inner.reverse();
        }
        inner
    };
    for facet in &mut draft.plc.facets {
        let mut polygons = Vec::with_capacity(facet.polygons.len());
        for polygon in &facet.polygons {
            match polygon[..] {
                [] | [_] => polygons.push(polygon.clone()),
                [a, b] => {
                    let chain = [vec![a], between(a, b), vec![b]].concat();
                    polygons.extend(chain.windows(2).map(<[VertexId]>::to_vec));
                }
                _ => {
                    let mut corners = Vec::with_capacity(polygon.len());
                    for (i, &a) in polygon.iter().enumerate() {
                        corners.push(a);
                        corners.extend(between(a, polygon[(i + 1) % polygon.len()]));
                    }
                    polygons.push(corners);
                }
            }
        }
        facet.polygons = polygons;
    }
    let divided = draft.plc.segments.iter().flat_map(|segment| {
        let [a, b] = segment.ends;
        let chain = [vec![a], between(a, b), vec![b]].concat();
        let pieces = chain.windows(2).map(|pair| Segment {
            ends: [pair[0], pair[1]],
            ..*segment
        });
        pieces.collect::<Vec<_>>()
    });
    draft.plc.segments = divided.collect();
}

/// The vertices inside of each edge with increasing ends, in order from the lower end.
fn chains(
    points: &[[f64; 3]],
    on_edges: &[([VertexId; 2], VertexId)],
) -> FxHashMap<[VertexId; 2], Vec<VertexId>> {
    let chain = |group: &[([VertexId; 2], VertexId)]| {
        let edge = group[0].0;
        let [a, b] = edge.map(|v| points[v.index()]);
        let axis = (0..3).find(|&k| a[k] != b[k]);
        let axis = axis.expect("the ends of an edge are different points");
        let mut inner: Vec<VertexId> = group.iter().map(|&(_, v)| v).collect();
        inner.sort_by(|&v, &w| points[v.index()][axis].total_cmp(&points[w.index()][axis]));
        if a[axis] > b[axis] {
            inner.reverse();
        }
        (edge, inner)
    };
    on_edges.chunk_by(|e, f| e.0 == f.0).map(chain).collect()
}
