//! The tetrahedra with their faces and edges looked up by vertices: sorted arrays, nothing that the mesh itself claims.

use crate::mesh::VertexId;
use crate::verify::lookup::gather::{Corner, FEW, Face};
use crate::verify::lookup::spheres::Spheres;
use crate::verify::lookup::sweep::sweep;
use crate::verify::options::MOST_TETS;
use crate::verify::signs::points::Points;
use std::borrow::Cow;
use std::ops::Range;
use std::sync::OnceLock;

/// The face opposite each corner, ordered such that the corner is on its positive side (the normal points inwards).
pub(crate) const INWARD: [[usize; 3]; 4] = [[1, 3, 2], [0, 2, 3], [0, 3, 1], [0, 1, 2]];

/// The incidence tables.
pub(crate) struct Tables<'a> {
    /// The tetrahedra, positive ones (as far as they are consistent at all).
    pub(crate) tets: Cow<'a, [[VertexId; 4]]>,
    /// The faces, by their smallest vertices: all, or those that may be asked for ([`Tables::new`]).
    pub(crate) faces: Vec<Face>,
    /// How many faces there are in all.
    pub(crate) total: usize,
    /// Which faces are not, or hardly, locally Delaunay.
    pub(crate) spheres: Spheres,
    /// Whether every tetrahedron is positive.
    pub(crate) is_positive: bool,
    /// The faces with one tetrahedron.
    boundary: Vec<u32>,
    /// The faces with more than two tetrahedra.
    pub(crate) crowded: Vec<usize>,
    /// The faces both of whose tetrahedra are on one side, in increasing order.
    pub(crate) same_side: Vec<usize>,
    /// The faces whose smallest vertex is v: `faces[face_start[v]..face_start[v + 1]]`; sorted if there are more than
    /// [`FEW`].
    face_start: Vec<u32>,
    /// Whether a vertex is in a tetrahedron.
    used: Vec<bool>,
    /// The tetrahedra at each vertex; many meshes are verified without.
    stars: OnceLock<Stars>,
}

/// `star[start[v]..start[v + 1]]`.
struct Stars {
    start: Vec<u32>,
    star: Vec<u32>,
}

/// The two, smaller first.
pub(crate) fn sorted2([a, b]: [VertexId; 2]) -> [VertexId; 2] {
    if a < b { [a, b] } else { [b, a] }
}

/// The three in increasing order.
fn sorted3([a, b, c]: [VertexId; 3]) -> [VertexId; 3] {
    let (a, b) = (a.min(b), a.max(b));
    let (b, c) = (b.min(c), b.max(c));
    [a.min(b), a.max(b), c]
}

impl<'a> Tables<'a> {
    /// `used` says which points are in a tetrahedron. If `asked` is given, only some faces are kept: those all of
    /// whose vertices it holds, those with other than two tetrahedra on opposite sides, and those that are not
    /// locally Delaunay.
    pub(crate) fn new(
        points: &Points,
        tets: Cow<'a, [[VertexId; 4]]>,
        used: Vec<bool>,
        asked: Option<Vec<bool>>,
    ) -> Tables<'a> {
        assert!(tets.len() <= MOST_TETS, "structure has been checked");
        let found = sweep(points, &tets, used.len(), asked.as_deref());
        let mut face_start = found.starts;
        face_start.push(found.faces.len() as u32);
        Tables {
            tets,
            faces: found.faces,
            total: found.total,
            spheres: found.spheres,
            is_positive: found.is_positive,
            boundary: found.boundary,
            crowded: found.crowded,
            same_side: found.same_side,
            face_start,
            used,
            stars: OnceLock::new(),
        }
    }

    /// The tetrahedra at a vertex, in increasing order; none for a point outside the mesh.
    pub(crate) fn star(&self, v: VertexId) -> &[u32] {
        if !self.is_used(v) {
            return &[];
        }
        let stars = self.stars.get_or_init(|| {
            let mut start = vec![0u32; self.used.len() + 1];
            for v in self.tets.iter().flatten() {
                start[v.index() + 1] += 1;
            }
            for i in 1..start.len() {
                start[i] += start[i - 1];
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
    pub(crate) fn neighbours(&self, v: VertexId) -> Vec<VertexId> {
        let tets = self.star(v).iter().flat_map(|&t| self.tets[t as usize]);
        let mut neighbours: Vec<VertexId> = tets.filter(|&w| w != v).collect();
        neighbours.sort_unstable();
        neighbours.dedup();
        neighbours
    }

    /// Whether any tetrahedron has the vertex.
    pub(crate) fn is_used(&self, v: VertexId) -> bool {
        self.used.get(v.index()).copied().unwrap_or(false)
    }

    /// The tetrahedra around an edge.
    fn around(&self, [a, b]: [VertexId; 2]) -> impl Iterator<Item = u32> + '_ {
        let (hub, other) = if self.star(a).len() <= self.star(b).len() {
            (a, b)
        } else {
            (b, a)
        };
        let star = self.star(hub).iter().copied();
        star.filter(move |&t| self.tets[t as usize].contains(&other))
    }

    /// The faces around an edge, in increasing order.
    pub(crate) fn fan(&self, edge: [VertexId; 2]) -> Vec<usize> {
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
    pub(crate) fn has_edge(&self, edge: [VertexId; 2]) -> bool {
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
    pub(crate) fn find_face(&self, face: [VertexId; 3]) -> Option<usize> {
        let key = sorted3(face);
        let range = self.faces_from(key[0]);
        let faces = &self.faces[range.clone()];
        let found = match faces.len() > FEW {
            true => faces.binary_search_by(|f| f.key.cmp(&key)).ok()?,
            false => faces
                .iter()
                .position(|f| f.key[1] == key[1] && f.key[2] == key[2])?,
        };
        Some(range.start + found)
    }

    /// A side of a face, ordered such that its tetrahedron is on the positive side of the plane.
    #[inline]
    pub(crate) fn inward(&self, corner: Corner) -> [VertexId; 3] {
        let tet = self.tets[corner.tet()];
        INWARD[corner.corner()].map(|k| tet[k])
    }

    /// The faces with one tetrahedron.
    pub(crate) fn boundary(&self) -> impl ExactSizeIterator<Item = (usize, &Face)> {
        let faces = self.boundary.iter().map(|&f| f as usize);
        faces.map(|f| (f, &self.faces[f]))
    }

    /// How many tetrahedra have a face.
    pub(crate) fn tets_at(&self, f: usize) -> Vec<usize> {
        let key = self.faces[f].key;
        let star = self.star(key[0]).iter().map(|&t| t as usize);
        star.filter(|&t| key.iter().all(|v| self.tets[t].contains(v)))
            .collect()
    }
}

/// Sorts by edges, whose ends are below `vertices`; what is at one edge keeps its order.
pub(crate) fn sort_by_edge<T: Copy>(items: &mut Vec<([VertexId; 2], T)>, vertices: usize) {
    let mut start = vec![0u32; vertices + 1];
    for (edge, _) in items.iter() {
        start[edge[0].index() + 1] += 1;
    }
    for i in 1..start.len() {
        start[i] += start[i - 1];
    }
    let mut next = start.clone();
    let mut sorted = items.clone();
    for item in items.iter() {
        let place = &mut next[item.0[0].index()];
        sorted[*place as usize] = *item;
        *place += 1;
    }
    for range in start.windows(2) {
        let at_vertex = &mut sorted[range[0] as usize..range[1] as usize];
        at_vertex.sort_by_key(|(edge, _)| edge[1]);
    }
    *items = sorted;
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
        let at = |x: f64, y: f64, z: f64| [x, y, z];
        let points = Points::new(vec![
            at(0., 0., 0.),
            at(1., 0., 0.),
            at(0., 1., 0.),
            at(0., 0., 1.),
            at(0., 0., -1.),
            at(9., 9., 9.),
        ]);
        let tets = vec![[v(0), v(1), v(2), v(3)], [v(2), v(1), v(0), v(4)]];
        let used = vec![true, true, true, true, true, false];
        let some = Tables::new(
            &points,
            (&tets[..]).into(),
            used.clone(),
            Some(vec![false; 6]),
        );
        assert_eq!((some.faces.len(), some.total), (6, 7));
        assert!(some.is_positive && some.same_side.is_empty() && some.crowded.is_empty());
        let tables = Tables::new(&points, tets.into(), used, None);
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
