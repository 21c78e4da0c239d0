//! The tetrahedra with their faces and edges looked up by vertices: sorted arrays, nothing that the mesh itself claims.

use crate::mesh::VertexId;
use std::ops::Range;

/// The face opposite each corner, ordered such that the corner is on its positive side (the normal points inwards).
pub(super) const INWARD: [[usize; 3]; 4] = [[1, 3, 2], [0, 2, 3], [0, 3, 1], [0, 1, 2]];

/// A face and the tetrahedra that have it.
pub(super) struct Face {
    /// The vertices, sorted.
    pub(super) key: [VertexId; 3],
    /// (tetrahedron, opposite corner) of the first two tetrahedra; the second is there only if `tets` > 1.
    pub(super) sides: [(u32, u8); 2],
    /// How many tetrahedra have the face.
    pub(super) tets: u32,
}

/// The incidence tables.
pub(super) struct Tables {
    /// The tetrahedra, positive ones (as far as they are consistent at all).
    pub(super) tets: Vec<[VertexId; 4]>,
    /// The faces, sorted by key.
    pub(super) faces: Vec<Face>,
    /// (smaller end, larger end, face) for all edges of all faces, sorted.
    fans: Vec<(VertexId, VertexId, u32)>,
    star_start: Vec<u32>,
    star: Vec<u32>,
    neighbour_start: Vec<u32>,
    neighbours: Vec<VertexId>,
}

/// The two, smaller first.
pub(super) fn sorted2([a, b]: [VertexId; 2]) -> [VertexId; 2] {
    if a < b { [a, b] } else { [b, a] }
}

/// The three in increasing order.
pub(super) fn sorted3(mut t: [VertexId; 3]) -> [VertexId; 3] {
    t.sort_unstable();
    t
}

impl Tables {
    /// `vertices` is the number of points that tetrahedra may name.
    pub(super) fn new(tets: Vec<[VertexId; 4]>, vertices: usize) -> Tables {
        let mut uses: Vec<([VertexId; 3], u32, u8)> = Vec::with_capacity(4 * tets.len());
        for (t, tet) in tets.iter().enumerate() {
            for (i, face) in INWARD.iter().enumerate() {
                uses.push((sorted3(face.map(|k| tet[k])), t as u32, i as u8));
            }
        }
        uses.sort_unstable();
        let faces: Vec<Face> = uses
            .chunk_by(|x, y| x.0 == y.0)
            .map(|group| Face {
                key: group[0].0,
                sides: [0, group.len().min(2) - 1].map(|k| (group[k].1, group[k].2)),
                tets: group.len() as u32,
            })
            .collect();
        let mut fans = Vec::with_capacity(3 * faces.len());
        for (f, Face { key: [a, b, c], .. }) in faces.iter().enumerate() {
            fans.extend([(*a, *b, f as u32), (*a, *c, f as u32), (*b, *c, f as u32)]);
        }
        fans.sort_unstable();
        let (star_start, star) = rows(
            vertices,
            0,
            tets.iter()
                .enumerate()
                .flat_map(|(t, tet)| tet.map(|v| (v, t as u32))),
        );
        let edges = fans.chunk_by(|x, y| (x.0, x.1) == (y.0, y.1));
        let (neighbour_start, neighbours) = rows(
            vertices,
            VertexId(0),
            edges.flat_map(|e| [(e[0].0, e[0].1), (e[0].1, e[0].0)]),
        );
        Tables {
            tets,
            faces,
            fans,
            star_start,
            star,
            neighbour_start,
            neighbours,
        }
    }

    /// The tetrahedra at a vertex; none for a point outside the mesh.
    pub(super) fn star(&self, v: VertexId) -> &[u32] {
        &self.star[row(&self.star_start, v)]
    }

    /// The vertices that an edge joins to v.
    pub(super) fn neighbours(&self, v: VertexId) -> &[VertexId] {
        &self.neighbours[row(&self.neighbour_start, v)]
    }

    /// Whether any tetrahedron has the vertex.
    pub(super) fn is_used(&self, v: VertexId) -> bool {
        !self.star(v).is_empty()
    }

    /// The faces around an edge.
    pub(super) fn fan(&self, edge: [VertexId; 2]) -> impl Iterator<Item = usize> + '_ {
        let [a, b] = sorted2(edge);
        let start = self.fans.partition_point(|&(x, y, _)| (x, y) < (a, b));
        self.fans[start..]
            .iter()
            .take_while(move |&&(x, y, _)| (x, y) == (a, b))
            .map(|&(_, _, f)| f as usize)
    }

    /// Whether ab is an edge.
    pub(super) fn has_edge(&self, edge: [VertexId; 2]) -> bool {
        self.fan(edge).next().is_some()
    }

    /// The face with these vertices.
    pub(super) fn find_face(&self, face: [VertexId; 3]) -> Option<usize> {
        let key = sorted3(face);
        self.faces.binary_search_by(|f| f.key.cmp(&key)).ok()
    }

    /// A side of a face, ordered such that its tetrahedron is on the positive side of the plane.
    pub(super) fn inward(&self, (t, corner): (u32, u8)) -> [VertexId; 3] {
        let tet = self.tets[t as usize];
        INWARD[usize::from(corner)].map(|k| tet[k])
    }

    /// The vertex of the tetrahedron that is opposite the face.
    pub(super) fn apex(&self, (t, corner): (u32, u8)) -> VertexId {
        self.tets[t as usize][usize::from(corner)]
    }

    /// The faces with one tetrahedron.
    pub(super) fn boundary(&self) -> impl Iterator<Item = (usize, &Face)> {
        self.faces.iter().enumerate().filter(|(_, f)| f.tets == 1)
    }
}

/// Pairs (vertex, item) gathered by vertex: the items of v are `items[start[v]..start[v + 1]]`.
fn rows<T: Copy>(
    vertices: usize,
    blank: T,
    pairs: impl Iterator<Item = (VertexId, T)> + Clone,
) -> (Vec<u32>, Vec<T>) {
    let mut start = vec![0u32; vertices + 1];
    for (v, _) in pairs.clone() {
        start[v.index() + 1] += 1;
    }
    for i in 0..vertices {
        start[i + 1] += start[i];
    }
    let mut next = start.clone();
    let mut items = vec![blank; start[vertices] as usize];
    for (v, item) in pairs {
        items[next[v.index()] as usize] = item;
        next[v.index()] += 1;
    }
    (start, items)
}

fn row(start: &[u32], v: VertexId) -> Range<usize> {
    if v.index() + 1 < start.len() {
        start[v.index()] as usize..start[v.index() + 1] as usize
    } else {
        0..0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inward_faces_are_even_permutations() {
        for (i, face) in INWARD.iter().enumerate() {
            let order = [face[0], face[1], face[2], i];
            let inversions = (0..4)
                .flat_map(|x| (0..x).map(move |y| (y, x)))
                .filter(|&(y, x)| order[y] > order[x])
                .count();
            assert_eq!(inversions % 2, 0, "{order:?}");
        }
    }

    #[test]
    fn two_tetrahedra() {
        let v = |i| VertexId(i);
        let tables = Tables::new(vec![[v(0), v(1), v(2), v(3)], [v(2), v(1), v(0), v(4)]], 6);
        assert_eq!(tables.faces.len(), 7);
        assert_eq!(tables.boundary().count(), 6);
        assert_eq!(tables.neighbours(v(3)), [v(0), v(1), v(2)]);
        assert_eq!(tables.star(v(0)), [0, 1]);
        assert!(tables.has_edge([v(4), v(0)]) && !tables.has_edge([v(3), v(4)]));
        assert!(!tables.is_used(v(5)) && !tables.is_used(v(9)));
        assert_eq!(tables.fan([v(1), v(0)]).count(), 3);
        assert!(tables.find_face([v(2), v(1), v(0)]).is_some());
    }
}
