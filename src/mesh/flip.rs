//! The three bistellar flips as topology: gluing by hand, in the memory of the old tetrahedra.
//!
//! Throughout, v and w are the ends of the edge that a flip creates. A corner "opposite p" of an old tetrahedron sees a
//! facet of the flipped volume's boundary; what lies behind it stays and is glued to a new tetrahedron.

use super::topology::slot_of;
use super::{Corner, TetId, TetMesh, VertexId};

impl TetMesh {
    /// Which facets of the tetrahedra that [`TetMesh::two_to_three`] returns are on the boundary of the flipped volume,
    /// by the bits of the opposite corners.
    pub(crate) const OUTER_OF_THREE: [u8; 4] = [0b0011, 0b0101, 0b1001, 0];
    /// The same for [`TetMesh::three_to_two`].
    pub(crate) const OUTER_OF_TWO: [u8; 4] = [0b1011, 0b1101, 0, 0];
    /// The same for [`TetMesh::four_to_four`].
    pub(crate) const OUTER_OF_FOUR: [u8; 4] = [0b0011, 0b0101, 0b0011, 0b0101];

    /// 2-3: vxyz and wxzy become the three tetrahedra around vw, with w in place of x, of y and of z.
    pub fn two_to_three(
        &mut self,
        [t1, t2]: [TetId; 2],
        [v, x, y, z, w]: [VertexId; 5],
    ) -> [TetId; 3] {
        let (old1, old2) = (self.tet(t1), self.tet(t2));
        let behind1 = [behind(old1, x), behind(old1, y), behind(old1, z)];
        let behind2 = [behind(old2, x), behind(old2, y), behind(old2, z)];
        let (a, b) = (t1, t2);
        let c = self.add([v, x, y, w]);
        let (b1, c1) = (b.corner(1), c.corner(1));
        self.put(a, [v, w, y, z], [behind2[0], behind1[0], b1, c1]);
        let (a2, c2) = (a.corner(2), c.corner(2));
        self.put(b, [v, x, w, z], [behind2[1], a2, behind1[1], c2]);
        let (a3, b3) = (a.corner(3), b.corner(3));
        self.put(c, [v, x, y, w], [behind2[2], a3, b3, behind1[2]]);
        [a, b, c]
    }

    /// 3-2: vpqr, wprq and the third tetrahedron around pq become two on the triangle vwr.
    pub fn three_to_two(
        &mut self,
        [t1, t2, t3]: [TetId; 3],
        [v, w, p, q, r]: [VertexId; 5],
    ) -> [TetId; 2] {
        let old = [self.tet(t2), self.tet(t1), self.tet(t3)];
        let behind_p = [behind(old[0], p), behind(old[1], p), behind(old[2], p)];
        let behind_q = [behind(old[0], q), behind(old[1], q), behind(old[2], q)];
        self.remove(t3);
        let (a, b) = (t1, t2);
        self.put(
            a,
            [v, w, q, r],
            [behind_p[0], behind_p[1], b.corner(1), behind_p[2]],
        );
        self.put(
            b,
            [v, p, w, r],
            [behind_q[0], a.corner(2), behind_q[1], behind_q[2]],
        );
        [a, b]
    }

    /// 4-4: vpqr, wprq, vqpu, wpqu around pq become four around vw, for v, w, p, q on one plane.
    pub fn four_to_four(
        &mut self,
        [t1, t2, t3, t4]: [TetId; 4],
        [v, w, p, q, r, u]: [VertexId; 6],
    ) -> [TetId; 4] {
        let behind_p = [t1, t2, t3, t4].map(|t| behind(self.tet(t), p));
        let behind_q = [t1, t2, t3, t4].map(|t| behind(self.tet(t), q));
        let [a, b, c, d] = [t1, t2, t3, t4];
        self.put(
            a,
            [v, w, q, r],
            [behind_p[1], behind_p[0], b.corner(1), d.corner(3)],
        );
        self.put(
            b,
            [v, p, w, r],
            [behind_q[1], a.corner(2), behind_q[0], c.corner(3)],
        );
        self.put(
            c,
            [v, w, p, u],
            [behind_q[3], behind_q[2], d.corner(1), b.corner(3)],
        );
        self.put(
            d,
            [v, q, w, u],
            [behind_p[3], c.corner(2), behind_p[2], a.corner(3)],
        );
        [a, b, c, d]
    }
}

/// What lies across the facet of a tetrahedron opposite its vertex p.
#[inline(always)]
pub(crate) fn behind((vertices, twins): (&[VertexId; 4], &[Corner; 4]), p: VertexId) -> Corner {
    twins[slot_of(vertices, p)]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ids<const N: usize>(v: [u32; N]) -> [VertexId; N] {
        v.map(VertexId)
    }

    /// The double pyramid over a cycle of vertices with tips 0 and 1, cut into tetrahedra around the axis, closed by
    /// mirrored tetrahedra behind its boundary. (Combinatorics only.)
    fn around_axis(cycle: &[u32]) -> (TetMesh, Vec<TetId>) {
        let mut mesh = TetMesh::new();
        let n = cycle.len();
        let tet = |i: usize| ids([0, 1, cycle[i], cycle[(i + 1) % n]]);
        let inner: Vec<TetId> = (0..n).map(|i| mesh.add(tet(i))).collect();
        let outer: Vec<TetId> = (0..n)
            .map(|i| {
                let [a, b, c, d] = tet(i);
                mesh.add([b, a, c, d])
            })
            .collect();
        for i in 0..n {
            // Around the axis, in front and behind.
            mesh.glue(inner[i].corner(2), inner[(i + 1) % n].corner(3));
            mesh.glue(outer[i].corner(2), outer[(i + 1) % n].corner(3));
            mesh.glue(inner[i].corner(0), outer[i].corner(1));
            mesh.glue(inner[i].corner(1), outer[i].corner(0));
        }
        assert_eq!(mesh.check(), Ok(()));
        (mesh, inner)
    }

    fn sorted_tets(mesh: &TetMesh) -> Vec<[VertexId; 4]> {
        let mut tets: Vec<[VertexId; 4]> = mesh
            .all()
            .map(|t| {
                let mut v = mesh.vertices(t);
                v.sort_unstable();
                v
            })
            .collect();
        tets.sort_unstable();
        tets
    }

    /// Which facets of tetrahedra are not shared by two of them.
    fn outer(mesh: &TetMesh, tets: &[TetId]) -> Vec<u8> {
        let bit = |c: Corner| u8::from(!tets.contains(&mesh.neighbor(c))) << c.slot();
        let facets = |&t: &TetId| (0..4).map(|slot| bit(t.corner(slot))).sum();
        tets.iter().map(facets).collect()
    }

    #[test]
    fn three_to_two_and_back() {
        let (mut mesh, t) = around_axis(&[2, 3, 4]);
        let before = sorted_tets(&mesh);
        // v = 2, w = 4, r = 3: t[0] = 0123 is vpqr with p = 0, q = 1 up to an even permutation, t[1] has w.
        let [a, b] = mesh.three_to_two([t[0], t[1], t[2]], ids([2, 4, 0, 1, 3]));
        assert_eq!(mesh.check(), Ok(()));
        assert_eq!(mesh.len(), before.len() - 1);
        assert_eq!(outer(&mesh, &[a, b]), TetMesh::OUTER_OF_TWO[..2]);
        // The triangle 2 3 4 lies between a = 2413 with 1 and b = 2043 with 0.
        let three = mesh.two_to_three([a, b], ids([1, 3, 2, 4, 0]));
        assert_eq!(outer(&mesh, &three), TetMesh::OUTER_OF_THREE[..3]);
        assert_eq!(mesh.check(), Ok(()));
        assert_eq!(sorted_tets(&mesh), before);
    }

    #[test]
    fn four_to_four_and_back() {
        let (mut mesh, t) = around_axis(&[2, 3, 4, 5]);
        let before = sorted_tets(&mesh);
        // v = 2, r = 3, w = 4, u = 5.
        let [a, b, c, d] = mesh.four_to_four([t[0], t[1], t[3], t[2]], ids([2, 4, 0, 1, 3, 5]));
        assert_eq!(mesh.check(), Ok(()));
        assert_ne!(sorted_tets(&mesh), before);
        assert_eq!(outer(&mesh, &[a, b, c, d]), TetMesh::OUTER_OF_FOUR);
        // Back: the edge 24 with 1 and 0 for v and w.
        mesh.four_to_four([a, b, d, c], ids([1, 0, 2, 4, 3, 5]));
        assert_eq!(mesh.check(), Ok(()));
        assert_eq!(sorted_tets(&mesh), before);
    }
}
