//! The tetrahedra with their faces and edges looked up by vertices: sorted arrays, nothing that the mesh itself claims.

use crate::mesh::VertexId;
use std::cell::OnceCell;
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
    /// The faces whose smallest vertex is v: `faces[face_start[v]..face_start[v + 1]]`.
    face_start: Vec<u32>,
    /// How many tetrahedra each vertex has.
    valence: Vec<u32>,
    /// The tetrahedra at each vertex; many meshes are verified without.
    stars: OnceCell<Stars>,
}

/// `star[start[v]..start[v + 1]]`.
struct Stars {
    start: Vec<u32>,
    star: Vec<u32>,
}

/// A tetrahedron's use of a face, of which the smallest vertex is known.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Use {
    /// The second and third vertex.
    others: u64,
    tet: u32,
    corner: u8,
}

/// The two, smaller first.
pub(super) fn sorted2([a, b]: [VertexId; 2]) -> [VertexId; 2] {
    if a < b { [a, b] } else { [b, a] }
}

/// The three in increasing order.
fn sorted3([a, b, c]: [VertexId; 3]) -> [VertexId; 3] {
    let (a, b) = (a.min(b), a.max(b));
    let (b, c) = (b.min(c), b.max(c));
    [a.min(b), a.max(b), c]
}

impl Tables {
    /// `vertices` is the number of points that tetrahedra may name.
    pub(super) fn new(tets: Vec<[VertexId; 4]>, vertices: usize) -> Tables {
        // Of the four faces, the three at the smallest vertex are gathered there, and one at the second.
        let ordered = || tets.iter().map(with_corners);
        let mut start = vec![0u32; vertices + 1];
        let mut valence = vec![0u32; vertices];
        for tet in ordered() {
            start[tet[0].0.index() + 1] += 3;
            start[tet[1].0.index() + 1] += 1;
            tet.iter().for_each(|(v, _)| valence[v.index()] += 1);
        }
        for i in 0..vertices {
            start[i + 1] += start[i];
        }
        let blank = Use {
            others: 0,
            tet: 0,
            corner: 0,
        };
        let mut uses = vec![blank; 4 * tets.len()];
        let mut next = start.clone();
        for (t, [a, b, c, d]) in ordered().enumerate() {
            for ([x, y, z], apex) in [
                ([a, b, c], d),
                ([a, b, d], c),
                ([a, c, d], b),
                ([b, c, d], a),
            ] {
                let place = &mut next[x.0.index()];
                uses[*place as usize] = Use {
                    others: u64::from(y.0.0) << 32 | u64::from(z.0.0),
                    tet: t as u32,
                    corner: apex.1,
                };
                *place += 1;
            }
        }
        let mut faces = Vec::with_capacity(2 * tets.len() + tets.len() / 4);
        let mut face_start = Vec::with_capacity(vertices + 1);
        for v in 0..vertices {
            face_start.push(faces.len() as u32);
            let uses = &mut uses[start[v] as usize..start[v + 1] as usize];
            uses.sort_unstable();
            faces.extend(uses.chunk_by(|x, y| x.others == y.others).map(|group| {
                let second = &group[group.len().min(2) - 1];
                let (b, c) = ((group[0].others >> 32) as u32, group[0].others as u32);
                Face {
                    key: [VertexId::new(v), VertexId(b), VertexId(c)],
                    sides: [&group[0], second].map(|u| (u.tet, u.corner)),
                    tets: group.len() as u32,
                }
            }));
        }
        face_start.push(faces.len() as u32);
        Tables {
            tets,
            faces,
            face_start,
            valence,
            stars: OnceCell::new(),
        }
    }

    /// The tetrahedra at a vertex, in increasing order; none for a point outside the mesh.
    pub(super) fn star(&self, v: VertexId) -> &[u32] {
        if !self.is_used(v) {
            return &[];
        }
        let stars = self.stars.get_or_init(|| {
            let mut start = Vec::with_capacity(self.valence.len() + 1);
            start.push(0);
            for valence in &self.valence {
                start.push(start[start.len() - 1] + valence);
            }
            let mut next = start.clone();
            let mut star = vec![0; 4 * self.tets.len()];
            for (t, tet) in self.tets.iter().enumerate() {
                for v in tet {
                    star[next[v.index()] as usize] = t as u32;
                    next[v.index()] += 1;
                }
            }
            Stars { start, star }
        });
        &stars.star[stars.start[v.index()] as usize..stars.start[v.index() + 1] as usize]
    }

    /// The vertices that an edge joins to v, in increasing order.
    pub(super) fn neighbours(&self, v: VertexId) -> Vec<VertexId> {
        let tets = self.star(v).iter().flat_map(|&t| self.tets[t as usize]);
        let mut neighbours: Vec<VertexId> = tets.filter(|&w| w != v).collect();
        neighbours.sort_unstable();
        neighbours.dedup();
        neighbours
    }

    /// Whether any tetrahedron has the vertex.
    pub(super) fn is_used(&self, v: VertexId) -> bool {
        self.valence.get(v.index()).is_some_and(|&n| n > 0)
    }

    /// The tetrahedra around an edge.
    fn around(&self, [a, b]: [VertexId; 2]) -> impl Iterator<Item = u32> + '_ {
        let valence = |v: VertexId| self.valence.get(v.index()).copied();
        let (hub, other) = if valence(a) <= valence(b) {
            (a, b)
        } else {
            (b, a)
        };
        let star = self.star(hub).iter().copied();
        star.filter(move |&t| self.tets[t as usize].contains(&other))
    }

    /// The faces around an edge, in increasing order.
    pub(super) fn fan(&self, edge: [VertexId; 2]) -> Vec<usize> {
        let mut fan = Vec::new();
        for t in self.around(edge) {
            let ends = self.tets[t as usize]
                .into_iter()
                .filter(|v| !edge.contains(v));
            fan.extend(ends.map(|v| {
                self.find_face([edge[0], edge[1], v])
                    .expect("the face of a tetrahedron")
            }));
        }
        fan.sort_unstable();
        fan.dedup();
        fan
    }

    /// Whether ab is an edge.
    pub(super) fn has_edge(&self, edge: [VertexId; 2]) -> bool {
        let [a, b] = sorted2(edge);
        if !self.is_used(a) || !self.is_used(b) {
            return false;
        }
        // Most edges have a face that has no smaller vertex.
        let faces = &self.faces[self.faces_from(a)];
        faces.iter().any(|f| f.key[1] == b || f.key[2] == b) || self.around(edge).next().is_some()
    }

    fn faces_from(&self, v: VertexId) -> Range<usize> {
        match self.face_start.get(v.index()..v.index() + 2) {
            Some(&[start, end]) => start as usize..end as usize,
            _ => 0..0,
        }
    }

    /// The face with these vertices.
    pub(super) fn find_face(&self, face: [VertexId; 3]) -> Option<usize> {
        let key = sorted3(face);
        let range = self.faces_from(key[0]);
        let faces = &self.faces[range.clone()];
        let found = faces.binary_search_by(|f| f.key[1..].cmp(&key[1..])).ok()?;
        Some(range.start + found)
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

/// The vertices of a tetrahedron in increasing order, with their corners.
#[inline]
fn with_corners(tet: &[VertexId; 4]) -> [(VertexId, u8); 4] {
    let mut sorted = [(tet[0], 0), (tet[1], 1), (tet[2], 2), (tet[3], 3)];
    for (i, j) in [(0, 1), (2, 3), (0, 2), (1, 3), (1, 2)] {
        if sorted[j].0 < sorted[i].0 {
            sorted.swap(i, j);
        }
    }
    sorted
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
        assert_eq!(tables.fan([v(1), v(0)]).len(), 3);
        assert!(tables.fan([v(3), v(4)]).is_empty());
        assert!(tables.find_face([v(2), v(1), v(0)]).is_some());
    }
}
