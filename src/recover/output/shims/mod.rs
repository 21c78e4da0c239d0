//! Shims of the domain, repaired where a flip does it (paper, end of §3.1 and of §3.2).
//!
//! A *shim* is a tetrahedron with all four vertices on one polygon f that had to be cut. The edges of f's pieces are
//! edges of the Delaunay tetrahedralization, and that leaves little to repair inside the domain:
//!
//! *Let ab and cd be edges of a Delaunay tetrahedralization that cross in projection, abcd a tetrahedron, and p a
//! vertex beyond the two faces of abcd at ab, or those at cd, and beyond no other. Then p is not in the circumsphere of
//! abcd.* For otherwise the Delaunay tetrahedralization of these five points would be the one without that edge; but an
//! edge that is Delaunay is so among any of the vertices that it belongs to. So whichever side of abcd the surface of f
//! runs along, a flip that removes abcd makes a face that is not locally Delaunay, but for ties, five points exactly on
//! one sphere: abcd "genuinely belongs in the CDT", and only a Steiner point would remove it. What can be done without
//! is this.
//!
//! - *2-2.* Where the domain is on one side of f only, the choice between ab and cd is free: with a shim next to the
//!   outside the surface of f runs along the wrong side of it. It is moved to the other side, and the shim is outside.
//!   No tetrahedron that is kept changes, so all their other faces are locally Delaunay as before.
//! - *3-2 and 4-4*, of an edge of the shim, with the surface of f moved along: accepted if all new tetrahedra are
//!   positive, and all faces on no polygon are locally Delaunay (without perturbation) afterwards: exact tests before
//!   anything changes.
//!
//! What remains is reported. The moved surface is one to one in projection, has the same boundary, and loses no
//! segment. Shims are tried in the order of their vertices, so that equal meshes are repaired equally.
//!
//! The repair is of what is written, not of the tetrahedralization in which polygons are inserted and deleted. Linear
//! time, but for the degrees of edges of shims.

mod edge_flip;

use crate::mesh::{Groups, Incidence, TetId, TetMesh, VertexId};
use crate::number::Sign;
use crate::predicate::PointStore;
use crate::recover::domain::DomainMarks;
use crate::recover::flatten::{Pieces, Plane, ShimCounts};
use crate::recover::segments::Subsegments;
use crate::recover::subpolygons::{Subpolygons, face};
use std::borrow::Cow;

/// Which polygons that were cut each vertex is on.
struct CutPolygons {
    at: Groups<u32>,
}

impl CutPolygons {
    /// `None` if none was cut. There are n vertices.
    fn new(pieces: &Pieces, n: usize) -> Option<CutPolygons> {
        let mut at: Vec<(VertexId, u32)> = Vec::new();
        let mut last = vec![
            usize::MAX;
            if pieces.cut_polygons().next().is_some() {
                n
            } else {
                0
            }
        ];
        for f in pieces.cut_polygons() {
            for &v in pieces.complex.polygons[pieces.of(f)]
                .iter()
                .flat_map(|piece| &piece.vertices)
            {
                if std::mem::replace(&mut last[v.index()], f) != f {
                    at.push((v, f as u32));
                }
            }
        }
        let at = Groups::new(n, at.iter().copied());
        (!last.is_empty()).then_some(CutPolygons { at })
    }

    /// In ascending order.
    fn of(&self, v: VertexId) -> &[u32] {
        self.at.of(v)
    }

    /// The first polygon that all four vertices are on.
    fn common(&self, [a, b, c, d]: [VertexId; 4]) -> Option<usize> {
        let on_all = |f: &u32| {
            let others = [b, c, d];
            others.iter().all(|&v| self.of(v).binary_search(f).is_ok())
        };
        let found = self.of(a).iter().copied().find(on_all);
        found.map(|f| f as usize)
    }
}

/// What is written, and what it consists of.
pub struct Repair<'a, P> {
    /// The vertices.
    pub points: &'a P,
    /// The tetrahedra.
    pub mesh: Cow<'a, TetMesh>,
    /// One at each vertex.
    pub incidence: Cow<'a, Incidence>,
    /// The triangles on pieces.
    pub subpolygons: Cow<'a, Subpolygons>,
    /// Which tetrahedra are in the domain.
    pub marks: DomainMarks,
    /// The pieces.
    pub pieces: &'a Pieces,
    /// The segments as they are in the mesh.
    pub subsegments: &'a Subsegments,
}

impl<P: PointStore> Repair<'_, P> {
    /// Repairs what can be repaired. `boundary`: whether the boundary of the domain may move.
    pub fn run(&mut self, boundary: bool) -> ShimCounts {
        let mut counts = ShimCounts::default();
        let Some(cut) = CutPolygons::new(self.pieces, self.points.len()) else {
            return counts;
        };
        let mut shims: Vec<([VertexId; 4], usize)> = self
            .mesh
            .finite()
            .filter(|t| self.marks.kept[t.index()])
            .filter_map(|t| {
                let mut v = self.mesh.vertices(t);
                let f = cut.common(v)?;
                v.sort_unstable();
                Some((v, f))
            })
            .collect();
        shims.sort_unstable();
        counts.found = shims.len() as u64;
        // One of a pile may have to wait for another.
        loop {
            let before = shims.len();
            let mut left = Vec::with_capacity(before);
            for (v, f) in shims {
                let Some(t) = self.find(v) else {
                    continue;
                };
                if boundary && self.two_two(t, f) {
                    counts.two_two += 1;
                } else if let Some(flip) = self.flip(t, &cut) {
                    match flip.old.len() {
                        3 => counts.three_two += 1,
                        _ => counts.four_four += 1,
                    }
                    left.extend(flip.new.iter().filter_map(|&v| {
                        let f = cut.common(v)?;
                        let mut v = v;
                        v.sort_unstable();
                        Some((v, f))
                    }));
                    self.apply(flip);
                } else {
                    left.push((v, f));
                }
            }
            shims = left;
            if shims.len() >= before {
                break;
            }
        }
        shims.retain(|&(v, _)| self.find(v).is_some());
        shims.sort_unstable();
        shims.dedup();
        counts.kept = shims.len() as u64;
        counts
    }

    /// The tetrahedron of the domain with these vertices.
    fn find(&self, [a, b, c, d]: [VertexId; 4]) -> Option<TetId> {
        let t = self.incidence.tet_at_edge(&self.mesh, a, b)?;
        let mut around = self.mesh.around(t, a, b);
        let t = around.find(|&t| self.mesh.has_vertices(t, &[c, d]))?;
        self.marks.kept[t.index()].then_some(t)
    }

    fn is_kept(&self, t: TetId) -> bool {
        !self.mesh.is_ghost(t) && self.marks.kept[t.index()]
    }

    fn is_covered(&self, v: [VertexId; 3]) -> bool {
        self.subpolygons.contains_key(&face(v))
    }

    /// Whether both triangulations of the walk pqrs are one to one in the projection of polygon f.
    fn is_convex(&self, f: usize, [p, q, r, s]: [VertexId; 4]) -> bool {
        let frame = self.pieces.complex.polygons[self.pieces.of(f).start].frame;
        let plane = Plane::new(self.points, frame);
        let turns =
            [[p, q, r], [q, r, s], [r, s, p], [s, p, q]].map(|[a, b, c]| plane.turn(a, b, c));
        turns[0] != Sign::Zero && turns.iter().all(|&turn| turn == turns[0])
    }

    /// Moves the surface of f to the other side of a shim that is next to the outside with two faces on f.
    fn two_two(&mut self, t: TetId, f: usize) -> bool {
        let mesh = &self.mesh;
        let corners = [0, 1, 2, 3].map(|slot| t.corner(slot));
        let (outer, inner): (Vec<_>, Vec<_>) = corners
            .into_iter()
            .partition(|&c| !self.is_kept(mesh.neighbor(c)));
        let (&[c, d], &[a, b]) = (&outer[..], &inner[..]) else {
            return false;
        };
        // The faces abc and abd are outside: those at the edge ab, opposite d and c.
        let piece = |corner| {
            let piece = self.subpolygons.get(&face(mesh.facet(corner)));
            piece.filter(|&&p| self.pieces.polygon_of(p as usize) == f)
        };
        let (Some(&piece), Some(_)) = (piece(c), piece(d)) else {
            return false;
        };
        let [a, b, c, d] = [a, b, c, d].map(|corner| mesh.vertex(corner));
        let is_inner = |[a, b, c]: [VertexId; 3]| !self.is_covered([a, b, c]);
        if !is_inner([a, c, d]) || !is_inner([b, c, d]) || !self.is_convex(f, [a, c, b, d]) {
            return false;
        }
        if self.subsegments.segment_of(a, b).is_some() || self.subsegments.share_segment(c, d) {
            return false;
        }
        // All others at ab are outside, and ab is on nothing else; cd is inside, on nothing.
        let at_ab = mesh.around(t, a, b).filter(|&n| n != t);
        let at_cd = mesh.around(t, c, d).filter(|&n| n != t);
        let covered_at = |p, q| {
            let faces = mesh.around(t, p, q).map(|n| mesh.exit_around(n, p, q));
            faces.filter(|&c| self.is_covered(mesh.facet(c))).count()
        };
        if at_ab.into_iter().any(|n| self.is_kept(n))
            || !at_cd.into_iter().all(|n| self.is_kept(n))
            || covered_at(a, b) != 2
            || covered_at(c, d) != 0
        {
            return false;
        }
        self.marks.kept[t.index()] = false;
        let subpolygons = self.subpolygons.to_mut();
        subpolygons.remove(&face([a, b, c]));
        subpolygons.remove(&face([a, b, d]));
        subpolygons.insert(face([a, c, d]), piece);
        subpolygons.insert(face([b, c, d]), piece);
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::delaunay::delaunay;
    use crate::plc::{Complex, Polygon};
    use crate::predicate::DoublePoints;
    use crate::recover::subpolygons::Face;
    use std::sync::Arc;

    /// A quadrilateral 0123 that is not flat, 4 exactly on the circumsphere of its corners, 5 beyond it on the other
    /// side. Of the two triangulations of 01234 the perturbation prefers the one with the shim 0123; a 3-2 flip removes
    /// it.
    #[test]
    fn a_flip_removes_a_shim_on_one_sphere() {
        let e = 2f64.powi(-48);
        let points = DoublePoints::new(vec![
            [1., 0., e],
            [0., 1., -e],
            [-1., 0., e],
            [0., -1., -e],
            [e, 0., 1.],
            [0., 0., -3.],
        ]);
        let ids: Vec<VertexId> = (0..6).map(VertexId::new).collect();
        let mesh = delaunay(&points, &ids).expect("in space").mesh;
        let of = |v: [usize; 4]| v.map(VertexId::new);
        assert!(mesh.sorted_tets().contains(&of([0, 1, 2, 3])), "a shim");
        let flat = [[0, 1, 3, 4], [0, 1, 3, 5], [1, 2, 3, 4], [1, 2, 3, 5]].map(of);

        let piece = |v: [usize; 3]| {
            let v = v.map(VertexId::new);
            let [a, b, c] = v;
            let mut vertices = v.to_vec();
            vertices.sort_unstable();
            Polygon {
                edges: vec![[a, b], [b, c], [c, a]],
                vertices,
                frame: v,
                flat: true,
                facets: vec![0],
                marker: 0,
            }
        };
        let pieces = Pieces {
            complex: Arc::new(Complex {
                polygons: vec![piece([0, 1, 3]), piece([1, 2, 3])],
                ..Complex::default()
            }),
            first: vec![0, 2],
            was_cut: vec![true],
            inner: vec![Vec::new()],
            fits: Vec::new(),
        };
        let triangle = |v: [usize; 3]| face(v.map(VertexId::new));
        let lower = [(triangle([0, 1, 3]), 0), (triangle([1, 2, 3]), 1)];
        let upper = [(triangle([0, 1, 2]), 0), (triangle([0, 2, 3]), 1)];
        let subsegments = Subsegments::default();
        let incidence = Incidence::new(&mesh, 6);
        // Wherever the surface runs, below the shim or above it.
        for surface in [lower, upper] {
            let subpolygons: Subpolygons = surface.into_iter().collect();
            let mut repair = Repair {
                points: &points,
                mesh: Cow::Borrowed(&mesh),
                incidence: Cow::Borrowed(&incidence),
                subpolygons: Cow::Borrowed(&subpolygons),
                marks: DomainMarks {
                    kept: (0..mesh.capacity())
                        .map(TetId::new)
                        .map(|t| mesh.is_alive(t) && !mesh.is_ghost(t))
                        .collect(),
                    region: Vec::new(),
                },
                pieces: &pieces,
                subsegments: &subsegments,
            };
            let counts = repair.run(false);
            let expected = ShimCounts {
                found: 1,
                three_two: 1,
                ..ShimCounts::default()
            };
            assert_eq!(counts, expected);
            assert_eq!(repair.mesh.sorted_tets(), flat);
            assert_eq!(repair.mesh.check(), Ok(()));
            let mut on_f: Vec<Face> = repair.subpolygons.keys().copied().collect();
            on_f.sort_unstable();
            assert_eq!(on_f, lower.map(|(t, _)| t));
        }
    }
}
