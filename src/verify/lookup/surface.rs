//! The faces that the mesh lists, as a surface: which of them lie on one facet is found by going from its boundary
//! over their edges, in O(m) for m faces.
//!
//! # Why what is found covers the facet
//! Let D be the directed edges that bound the facet (with the facet on their left in a projection along an axis; it
//! may be a group of facets, with holes). A set S of faces is collected, each with the direction that makes it
//! counterclockwise, such that no directed edge occurs twice in S, those of D occur and their opposites do not, and
//! the opposite of every other directed edge in S is in S as well. So the boundary of S, as a chain, is D. The number
//! of faces of S over a point of the plane changes where the point crosses an edge by what the boundary says; it is
//! the same as that of the facet over the point, 1 inside and 0 outside, since both are 0 far away. So S is projected
//! one to one onto the facet: every edge inside has two faces and the areas add up.

use crate::mesh::VertexId;
use crate::verify::lookup::tables::{Tables, sort_by_edge};
use crate::verify::signs::points::Points;

/// A directed edge: twice the index of the edge, and one more from the larger to the smaller end.
type Half = u32;

/// Some faces with their edges.
pub(crate) struct Surface {
    /// By their index in the tables, in increasing order.
    pub(crate) faces: Vec<u32>,
    /// The vertices of each, in increasing order.
    keys: Vec<[VertexId; 3]>,
    /// The edges ab, bc, ac of each.
    edges_of: Vec<[u32; 3]>,
    /// All edges, sorted.
    edges: Vec<[VertexId; 2]>,
    /// The edges whose smaller end is v: `edges[at_vertex[v]..at_vertex[v + 1]]`.
    at_vertex: Vec<u32>,
    /// The faces at edge e: `around[start[e]..start[e + 1]]`.
    start: Vec<u32>,
    around: Vec<u32>,
}

impl Surface {
    /// Of these faces, in increasing order. `vertices` is one more than the largest vertex.
    pub(crate) fn new(vertices: usize, tables: &Tables, faces: Vec<u32>) -> Surface {
        let mut surface = Surface {
            faces,
            keys: Vec::new(),
            edges_of: Vec::new(),
            edges: Vec::new(),
            at_vertex: vec![0; vertices + 1],
            start: vec![0],
            around: Vec::new(),
        };
        let keys = surface.faces.iter().map(|&f| tables.faces[f as usize].key);
        surface.keys = keys.collect();
        let mut uses: Vec<([VertexId; 2], (u32, u8))> = Vec::with_capacity(3 * surface.keys.len());
        for (i, &[a, b, c]) in surface.keys.iter().enumerate() {
            for (k, edge) in [[a, b], [b, c], [a, c]].into_iter().enumerate() {
                uses.push((edge, (i as u32, k as u8)));
            }
        }
        sort_by_edge(&mut uses, vertices);
        surface.edges_of = vec![[0; 3]; surface.keys.len()];
        for around in uses.chunk_by(|x, y| x.0 == y.0) {
            let edge = around[0].0;
            surface.at_vertex[edge[0].index() + 1] += 1;
            for &(_, (i, k)) in around {
                surface.edges_of[i as usize][usize::from(k)] = surface.edges.len() as u32;
                surface.around.push(i);
            }
            surface.edges.push(edge);
            surface.start.push(surface.around.len() as u32);
        }
        for v in 0..vertices {
            surface.at_vertex[v + 1] += surface.at_vertex[v];
        }
        surface
    }

    /// The index of an edge, smaller end first.
    fn find(&self, edge: [VertexId; 2]) -> Option<u32> {
        let v = edge[0].index();
        let &[start, end] = self.at_vertex.get(v..v + 2)? else {
            return None;
        };
        let at_vertex = &self.edges[start as usize..end as usize];
        let found = at_vertex.binary_search_by_key(&edge[1], |e| e[1]).ok()?;
        Some(start + found as u32)
    }

    /// Whether an edge, smaller end first, is an edge of one of the faces.
    pub(crate) fn has_edge(&self, edge: [VertexId; 2]) -> bool {
        self.find(edge).is_some()
    }

    fn half(&self, [a, b]: [VertexId; 2]) -> Option<Half> {
        match a < b {
            true => Some(2 * self.find([a, b])?),
            false => Some(2 * self.find([b, a])? + 1),
        }
    }

    fn ends(&self, half: Half) -> [VertexId; 2] {
        let [a, b] = self.edges[half as usize / 2];
        if half.is_multiple_of(2) {
            [a, b]
        } else {
            [b, a]
        }
    }
}

/// Looks for faces on one facet after the other.
pub(crate) struct Flood<'a> {
    surface: &'a Surface,
    points: &'a Points,
    /// The number of the facet on the boundary of which, and of a face of which, a directed edge was last.
    bounds: Vec<u32>,
    has: Vec<u32>,
    facet: u32,
    /// The directed edges whose face is still to be found.
    open: Vec<Half>,
}

impl<'a> Flood<'a> {
    pub(crate) fn new(surface: &'a Surface, points: &'a Points) -> Flood<'a> {
        Flood {
            surface,
            points,
            bounds: vec![0; 2 * surface.edges.len()],
            has: vec![0; 2 * surface.edges.len()],
            facet: 0,
            open: Vec::new(),
        }
    }

    /// The faces, by index in the tables, that cover the facet with this directed boundary in the plane of the axes
    /// and whose vertices are all accepted; none if there are no such faces or more than one choice.
    pub(crate) fn cover(
        &mut self,
        axes: [usize; 2],
        boundary: &[[VertexId; 2]],
        accepts: &mut dyn FnMut(VertexId) -> bool,
    ) -> Option<Vec<usize>> {
        // Without a boundary (all edges of a closed surface are merged away) nothing would be asked for.
        if boundary.is_empty() {
            return None;
        }
        self.facet += 1;
        self.open.clear();
        for &edge in boundary {
            let half = self.surface.half(edge)?;
            let mark = &mut self.bounds[half as usize];
            if std::mem::replace(mark, self.facet) == self.facet {
                return None;
            }
            self.open.push(half);
        }
        let mut faces = Vec::new();
        while let Some(half) = self.open.pop() {
            if self.has[half as usize] == self.facet {
                continue;
            }
            let face = self.left_of(half, axes, accepts)?;
            faces.push(self.surface.faces[face as usize] as usize);
            let ends = self.surface.ends(half);
            for h in self.halves(face, ends) {
                self.add(h)?;
            }
        }
        faces.sort_unstable();
        Some(faces)
    }

    /// The only face with the edge whose third vertex is accepted and on the left.
    fn left_of(
        &self,
        half: Half,
        axes: [usize; 2],
        accepts: &mut dyn FnMut(VertexId) -> bool,
    ) -> Option<u32> {
        let surface = self.surface;
        let [a, b] = surface.ends(half);
        let edge = half as usize / 2;
        let around =
            &surface.around[surface.start[edge] as usize..surface.start[edge + 1] as usize];
        let mut found = None;
        for &face in around {
            let key = surface.keys[face as usize];
            let apex = key.into_iter().find(|&v| v != a && v != b)?;
            if accepts(apex) && self.points.orient2d(axes, [a, b, apex]).is_positive() {
                if found.is_some() {
                    return None;
                }
                found = Some(face);
            }
        }
        found
    }

    /// The directed edges of a face in the direction of one of them.
    fn halves(&self, face: u32, [a, b]: [VertexId; 2]) -> [Half; 3] {
        let [x, y, z] = self.surface.keys[face as usize];
        let [xy, yz, xz] = self.surface.edges_of[face as usize].map(|e| 2 * e);
        match [(x, y), (y, z), (z, x)].contains(&(a, b)) {
            true => [xy, yz, xz + 1],
            false => [xy + 1, yz + 1, xz],
        }
    }

    /// Adds a directed edge of a face.
    fn add(&mut self, half: Half) -> Option<()> {
        let (own, other) = (half as usize, (half ^ 1) as usize);
        if std::mem::replace(&mut self.has[own], self.facet) == self.facet {
            return None;
        }
        let bounds = [own, other].map(|h| self.bounds[h] == self.facet);
        let is_closed = self.has[other] == self.facet;
        match bounds {
            // An edge that the boundary has in both directions is inside.
            [false, false] | [true, true] => {
                if !is_closed {
                    self.open.push(half ^ 1);
                }
                Some(())
            }
            [true, false] => (!is_closed).then_some(()),
            [false, true] => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exchange::ExportedMesh;
    use crate::exchange::{Plc, Segment};
    use crate::verify::tests::with_case;

    /// The cube with vertex x + 2y + 4z in six tetrahedra around its diagonal.
    fn cube() -> (Plc, ExportedMesh) {
        let tets = [
            [0, 1, 3, 7],
            [0, 5, 1, 7],
            [0, 3, 2, 7],
            [0, 2, 6, 7],
            [0, 4, 5, 7],
            [0, 6, 4, 7],
        ];
        let mesh = ExportedMesh {
            vertices: (0..8u8)
                .map(|i| [i & 1, i >> 1 & 1, i >> 2].map(f64::from))
                .collect(),
            tets: tets.map(|t| t.map(VertexId)).to_vec(),
            ..ExportedMesh::default()
        };
        let plc = Plc {
            vertices: mesh.vertices.clone(),
            segments: vec![Segment {
                ends: [VertexId(0), VertexId(1)],
                marker: 0,
            }],
            ..Plc::default()
        };
        (plc, mesh)
    }

    fn loop_of(ring: &[u32]) -> Vec<[VertexId; 2]> {
        let next = ring.iter().cycle().skip(1);
        let edges = ring.iter().zip(next);
        edges.map(|(&a, &b)| [VertexId(a), VertexId(b)]).collect()
    }

    /// The bottom of the cube is covered by its two triangles, if they are all there, counterclockwise, and its own.
    #[test]
    fn covers_are_found_and_nothing_else() {
        let (plc, mesh) = cube();
        with_case(&plc, &mesh, |case| {
            let every: Vec<u32> = (0..case.tables.faces.len() as u32).collect();
            let cover = |faces: &[u32], ring: &[u32], refused: u32| {
                let surface = Surface::new(case.points.len(), case.tables, faces.to_vec());
                let mut flood = Flood::new(&surface, case.points);
                let accepts = &mut |v: VertexId| v.0 < 4 && v.0 != refused;
                flood.cover([0, 1], &loop_of(ring), accepts)
            };
            let square = cover(&every, &[0, 1, 3, 2], 9).expect("two triangles");
            let keys = square
                .iter()
                .map(|&f| case.tables.faces[f].key.map(|v| v.0));
            assert_eq!(keys.collect::<Vec<_>>(), [[0, 1, 3], [0, 2, 3]]);
            assert_eq!(cover(&every, &[0, 2, 3, 1], 9), None, "the other way round");
            assert_eq!(
                cover(&every, &[0, 1, 3, 2], 3),
                None,
                "a vertex is not accepted"
            );
            assert_eq!(cover(&every, &[], 9), None, "no boundary");
            assert_eq!(cover(&every, &[0, 1, 2], 9), None, "there is no edge 12");
            assert_eq!(cover(&every, &[0, 1, 3], 9), Some(vec![square[0]]));
            for missing in square {
                let some: Vec<u32> = every
                    .iter()
                    .copied()
                    .filter(|&f| f as usize != missing)
                    .collect();
                assert_eq!(
                    cover(&some, &[0, 1, 3, 2], 9),
                    None,
                    "a triangle is missing"
                );
            }
        });
    }
}
