//! A mesh without the vertices that no tetrahedron has.

use super::{Attributes, ExportedMesh};
use crate::mesh::VertexId;

impl ExportedMesh {
    /// Removes the vertices that no tetrahedron has, but for the ends of segments that exact positions refer to. The
    /// others keep their order and get successive numbers; returns the old id of each.
    pub fn drop_unused(&mut self) -> Vec<VertexId> {
        let mut used = vec![false; self.vertices.len()];
        let ends = self.exact.iter().flat_map(|p| p.ends);
        let positions = self.exact.iter().map(|p| p.vertex);
        let corners = self.tets.iter().flatten().copied();
        for v in corners.chain(ends).chain(positions) {
            used[v.index()] = true;
        }
        let kept: Vec<VertexId> = (0..used.len())
            .filter(|&v| used[v])
            .map(VertexId::new)
            .collect();
        if kept.len() == used.len() {
            return kept;
        }
        let mut new = vec![VertexId(0); used.len()];
        for (i, v) in kept.iter().enumerate() {
            new[v.index()] = VertexId::new(i);
        }
        let new = |v: VertexId| new[v.index()];
        self.vertices = kept.iter().map(|v| self.vertices[v.index()]).collect();
        let rows = kept.iter().flat_map(|&v| match self.attributes.per_vertex {
            0 => &[],
            _ => self.attributes.of(v),
        });
        self.attributes = Attributes {
            per_vertex: self.attributes.per_vertex,
            values: rows.copied().collect(),
        };
        if !self.vertex_markers.is_empty() {
            let markers = kept.iter().map(|v| self.vertex_markers[v.index()]);
            self.vertex_markers = markers.collect();
        }
        for position in &mut self.exact {
            position.vertex = new(position.vertex);
            position.ends = position.ends.map(new);
        }
        self.tets.iter_mut().for_each(|t| *t = t.map(new));
        for face in &mut self.faces {
            face.vertices = face.vertices.map(new);
        }
        for edge in &mut self.edges {
            edge.vertices = edge.vertices.map(new);
        }
        kept
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exchange::ExportedFace;

    #[test]
    fn what_is_left_is_numbered_anew() {
        let v = VertexId;
        let mut mesh = ExportedMesh {
            vertices: (0..6).map(|i| [f64::from(i); 3]).collect(),
            attributes: Attributes {
                per_vertex: 2,
                values: (0..12).map(f64::from).collect(),
            },
            vertex_markers: vec![0, 1, 2, 3, 4, 5],
            tets: vec![[v(0), v(2), v(3), v(5)]],
            faces: vec![ExportedFace {
                vertices: [v(0), v(5), v(3)],
                marker: 7,
            }],
            ..ExportedMesh::default()
        };
        assert_eq!(mesh.drop_unused(), [v(0), v(2), v(3), v(5)]);
        assert_eq!(mesh.tets, [[v(0), v(1), v(2), v(3)]]);
        assert_eq!(mesh.faces[0].vertices, [v(0), v(3), v(2)]);
        assert_eq!(mesh.vertices[1], [2.0; 3]);
        assert_eq!(mesh.attributes.of(v(3)), [10.0, 11.0]);
        assert_eq!(mesh.vertex_markers, [0, 2, 3, 5]);
    }
}
