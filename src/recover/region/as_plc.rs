//! A region of a polygon as a PLC of its own, so that an insertion that failed in it can be done again by itself.
//!
//! The PLC has the vertices of R, in the order of their identities, which is that of the perturbation; the triangles of
//! R's boundary and the subpolygons inside R as facets, so that the inside of R is triangulated as it was; and last, so
//! that it is inserted last, the part of f in R. Every facet has a marker of its own, so that none are merged.
//!
//! What a PLC cannot say: with other polygons in the mesh, edges on R's boundary need not be edges of the Delaunay
//! tetrahedralization of R's vertices, and then they get Steiner points; the frame of f is chosen anew from its
//! vertices in R; rounded times that are equal are flipped in order of arrival, which depends on the numbering of the
//! tetrahedra.

use super::{Region, Side, Sides};
use crate::exchange::{Facet, Plc};
use crate::mesh::{TetMesh, VertexId};
use crate::predicate::PointStore;
use crate::recover::subpolygons::Subpolygons;
use rustc_hash::FxHashMap;
use std::collections::{BTreeMap, BTreeSet};

/// A region as a PLC. Coordinates are doubles: those of a store of other numbers are rounded.
pub fn region_as_plc<P: PointStore>(
    mesh: &TetMesh,
    sides: &Sides<P>,
    region: &Region,
    subpolygons: &Subpolygons,
) -> Plc {
    let points = sides.points();
    let vertices: BTreeSet<(u32, VertexId)> = region
        .tets
        .iter()
        .flat_map(|&t| mesh.vertices(t))
        .map(|v| (points.identity(v), v))
        .collect();
    let number: FxHashMap<VertexId, VertexId> = vertices
        .iter()
        .enumerate()
        .map(|(i, &(_, v))| (v, VertexId::new(i)))
        .collect();
    let boundary = region.boundary(mesh);
    let triangles = boundary.iter().map(|&c| mesh.facet(c));
    let inner = region.inner_subpolygons(mesh, subpolygons);
    let mut facets: Vec<Vec<Vec<VertexId>>> =
        triangles.chain(inner).map(|t| vec![t.to_vec()]).collect();
    facets.push(border_of_polygon(mesh, sides, region));
    Plc {
        first_index: 0,
        vertices: vertices.iter().map(|&(_, v)| points.rounded(v)).collect(),
        facets: (1..)
            .zip(facets)
            .map(|(marker, polygons)| Facet {
                polygons: polygons
                    .into_iter()
                    .map(|p| p.iter().map(|v| number[v]).collect())
                    .collect(),
                holes: Vec::new(),
                marker,
            })
            .collect(),
        ..Plc::default()
    }
}

/// The border of the part of f in R, as closed walks: the border of the part of R's boundary to the left of f.
fn border_of_polygon<P: PointStore>(
    mesh: &TetMesh,
    sides: &Sides<P>,
    region: &Region,
) -> Vec<Vec<VertexId>> {
    // How often each edge is passed, less how often in the other direction. Where R's boundary touches itself an edge
    // may be passed twice before it is passed back.
    let mut passed: BTreeMap<[VertexId; 2], i32> = BTreeMap::new();
    for c in region.boundary(mesh) {
        let [x, y, z] = mesh.facet(c);
        if ![x, y, z].iter().any(|&v| sides.of(v) == Side::Left) {
            continue;
        }
        for [a, b] in [[x, y], [y, z], [z, x]] {
            *passed.entry([a, b]).or_insert(0) += 1;
            *passed.entry([b, a]).or_insert(0) -= 1;
        }
    }
    let once = |(edge, n): ([VertexId; 2], i32)| std::iter::repeat_n(edge, n.max(0) as usize);
    let edges: Vec<[VertexId; 2]> = passed.into_iter().flat_map(once).collect();
    closed_walks(&edges)
}

/// Directed edges, as many into each vertex as out of it, as closed walks that pass each vertex at most once.
fn closed_walks(edges: &[[VertexId; 2]]) -> Vec<Vec<VertexId>> {
    let mut next: BTreeMap<VertexId, Vec<VertexId>> = BTreeMap::new();
    for &[a, b] in edges {
        next.entry(a).or_default().push(b);
    }
    let mut walks = Vec::new();
    while let Some((&start, _)) = next.iter().find(|(_, ends)| !ends.is_empty()) {
        let mut path = vec![start];
        while let Some(v) = path
            .last()
            .and_then(|last| next.get_mut(last))
            .and_then(Vec::pop)
        {
            match path.iter().position(|&w| w == v) {
                Some(i) => {
                    walks.push(path.split_off(i));
                    path.push(v);
                }
                None => path.push(v),
            }
        }
    }
    walks
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn walks_are_cut_where_they_meet() {
        let edges = [[0, 1], [1, 2], [2, 0], [2, 3], [3, 4], [4, 2]];
        let edges = edges.map(|e| e.map(VertexId));
        let mut walks = closed_walks(&edges);
        walks.iter_mut().for_each(|w| w.sort_unstable());
        walks.sort_unstable();
        assert_eq!(walks, [[0, 1, 2].map(VertexId), [2, 3, 4].map(VertexId)]);
    }
}
