//! The star of a new vertex: one tetrahedron on each facet of the conflict zone's boundary, glued to each other.
//!
//! The boundary is a triangulated sphere, so that each directed edge belongs to one of its facets, and the facet on the
//! other side has the reversed edge: a table by pairs of vertices finds it (as in Marot, Pellerin & Remacle 2019). The
//! vertices of a boundary, about 16 of them, are numbered from 0 in order of appearance, by a sparse set (Briggs &
//! Torczon 1993), which needs no clearing, so that the table is small and stays in the nearest cache. Boundaries of
//! more vertices than it has rows use a larger one (`large.rs`).

use super::large::Large;
use crate::mesh::{Corner, TetId, TetMesh, VertexId};

/// The largest number of vertices of a boundary for which the table is used; a power of two.
const ROWS: usize = 64;

/// Scratch memory, between the filling of one cavity and of the next.
#[derive(Clone, Debug)]
pub(super) struct Star {
    /// The number of a vertex, if [`Star::members`] says so; by id plus one, so that the vertex at infinity is the
    /// first.
    numbers: Vec<u8>,
    /// The vertices of the boundary, by number.
    members: [VertexId; ROWS],
    count: usize,
    /// For the directed edge from the vertex with number i to that with number j, at ROWS·i + j, the new corner
    /// opposite the facet that it spans with the new vertex. What is not on this boundary is left over from others.
    opposite: Box<[Corner; ROWS * ROWS]>,
    /// In place of the table, for boundaries of more vertices.
    large: Large,
}

/// A facet of the conflict zone's boundary, seen from inside.
#[derive(Clone, Copy, Debug)]
pub(super) struct BoundaryFacet {
    vertices: [VertexId; 3],
    /// The corner of the tetrahedron in the zone.
    pub inside: Corner,
    /// The corner of the tetrahedron behind it.
    outside: Corner,
    /// The numbers of the vertices, once they are known.
    numbers: [u8; 3],
}

impl BoundaryFacet {
    #[inline(always)]
    pub fn new(vertices: [VertexId; 3], inside: Corner, outside: Corner) -> BoundaryFacet {
        BoundaryFacet {
            vertices,
            inside,
            outside,
            numbers: [0; 3],
        }
    }

    /// The tetrahedron behind it.
    #[inline]
    pub fn behind(&self) -> TetId {
        self.outside.tet()
    }
}

impl Default for Star {
    fn default() -> Star {
        Star {
            numbers: Vec::new(),
            members: [VertexId::INFINITE; ROWS],
            count: 0,
            opposite: Box::new([Corner::NONE; ROWS * ROWS]),
            large: Large::default(),
        }
    }
}

impl Star {
    /// Makes `new`, which may be in the cavity, the tetrahedra that join p to the facets of the boundary. Linear time.
    pub fn fill(
        &mut self,
        mesh: &mut TetMesh,
        p: VertexId,
        boundary: &mut [BoundaryFacet],
        new: &[TetId],
    ) {
        self.count = 0;
        for (facet, &t) in boundary.iter_mut().zip(new) {
            // Written out: array::map is not inlined here.
            let [a, b, c] = facet.vertices;
            let [i, j, k] = [self.number(a), self.number(b), self.number(c)];
            facet.numbers = [i, j, k];
            self.opposite[place(j, k)] = t.corner(1);
            self.opposite[place(k, i)] = t.corner(2);
            self.opposite[place(i, j)] = t.corner(3);
        }
        if self.count > ROWS {
            return self.fill_large(mesh, p, boundary, new);
        }
        for (facet, &t) in boundary.iter().zip(new) {
            let [i, j, k] = facet.numbers;
            let [x, y, z] = [
                self.opposite[place(k, j)],
                self.opposite[place(i, k)],
                self.opposite[place(j, i)],
            ];
            let [a, b, c] = facet.vertices;
            mesh.overwrite(t, [p, a, b, c], [facet.outside, x, y, z]);
            mesh.set_twin(facet.outside, t.corner(0));
        }
    }

    /// [`Star::fill`] for boundaries of many vertices.
    #[cold]
    fn fill_large(
        &mut self,
        mesh: &mut TetMesh,
        p: VertexId,
        boundary: &[BoundaryFacet],
        new: &[TetId],
    ) {
        let facets = boundary.iter().map(|facet| facet.vertices);
        self.large.fill(facets, new);
        for (n, (facet, &t)) in boundary.iter().zip(new).enumerate() {
            let [a, b, c] = facet.vertices;
            let [x, y, z] = self.large.across(n);
            mesh.overwrite(t, [p, a, b, c], [facet.outside, x, y, z]);
            mesh.set_twin(facet.outside, t.corner(0));
        }
    }

    /// The number of a vertex of this boundary; meaningless once there are more than [`ROWS`].
    #[inline(always)]
    fn number(&mut self, v: VertexId) -> u8 {
        let i = v.0.wrapping_add(1) as usize;
        if i >= self.numbers.len() {
            self.numbers.resize(i + 1, 0);
        }
        let known = usize::from(self.numbers[i]);
        if known < self.count && self.members[known % ROWS] == v {
            return self.numbers[i];
        }
        if self.count >= ROWS {
            self.count = ROWS + 1;
            return 0;
        }
        let number = self.count as u8;
        self.numbers[i] = number;
        self.members[self.count] = v;
        self.count += 1;
        number
    }
}

#[inline]
fn place(from: u8, to: u8) -> usize {
    (usize::from(from) * ROWS + usize::from(to)) % (ROWS * ROWS)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::delaunay::delaunay;
    use crate::predicate::DoublePoints;

    /// The centre of a sphere full of vertices: more of them around its cavity than the table has rows.
    #[test]
    fn fills_a_cavity_of_many_vertices() {
        let n = 4 * ROWS;
        let spiral = (0..n).map(|i| {
            let z = 1.0 - (2 * i + 1) as f64 / n as f64;
            let (sin, cos) = (2.4 * i as f64).sin_cos();
            let r = (1.0 - z * z).sqrt();
            [r * cos, r * sin, z]
        });
        let points = DoublePoints::new(spiral.chain([[0.0; 3]]).collect());
        let all: Vec<VertexId> = (0..=n).map(VertexId::new).collect();
        let mut grown = delaunay(&points, &all[..n]).expect("not on one plane");
        grown.insert(&points, all[n]);
        assert!(grown.created().len() > 2 * ROWS);
        assert_eq!(grown.mesh.check(), Ok(()));
        let expected = delaunay(&points, &all).expect("not on one plane");
        let canonical = |mesh: &TetMesh| {
            let mut tets: Vec<[VertexId; 4]> = mesh.all().map(|t| mesh.vertices(t)).collect();
            tets.iter_mut().for_each(|v| v.sort_unstable());
            tets.sort_unstable();
            tets
        };
        assert_eq!(canonical(&grown.mesh), canonical(&expected.mesh));
    }
}
