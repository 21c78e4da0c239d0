//! 3-2 and 4-4 flips of the edges of shims, with the surface of a polygon moved along.

use super::{CutPolygons, Repair};
use crate::mesh::{TetId, VertexId};
use crate::predicate::PointStore;
use crate::recover::subpolygons::{Face, face};
use rustc_hash::{FxHashMap, FxHashSet};

/// A flip in place of the tetrahedra around an edge.
pub(super) struct Flip {
    pub(super) old: Vec<TetId>,
    pub(super) new: Vec<[VertexId; 4]>,
    /// Faces that are no subpolygons any more, and those that are instead.
    uncovered: Vec<Face>,
    covered: Vec<(Face, u32)>,
}

impl<P: PointStore> Repair<'_, P> {
    /// A flip of an edge of tetrahedron t after which there are fewer shims.
    pub(super) fn flip(&self, t: TetId, cut: &CutPolygons) -> Option<Flip> {
        let mut v = self.mesh.vertices(t);
        v.sort_unstable();
        let edges = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];
        edges
            .into_iter()
            .find_map(|[i, j]| self.flip_of_edge(t, [v[i], v[j]], cut))
    }

    fn flip_of_edge(&self, t: TetId, [p, q]: [VertexId; 2], cut: &CutPolygons) -> Option<Flip> {
        if self.subsegments.segment_of(p, q).is_some() {
            return None;
        }
        let old: Vec<TetId> = self.mesh.around(t, p, q).take(5).collect();
        if old.len() > 4 || !old.iter().all(|&t| self.is_kept(t)) {
            return None;
        }
        let region = |t: TetId| self.marks.region.get(t.index());
        if old.iter().any(|&t| region(t) != region(old[0])) {
            return None;
        }
        // The tetrahedra are (p, q, ring[i], ring[i + 1]), positive.
        let ring: Vec<VertexId> = old
            .iter()
            .map(|&t| self.mesh.vertex(self.mesh.exit_around(t, p, q)))
            .collect();
        let starts = if ring.len() == 3 { 1 } else { 2 };
        let is_shim = |&&v: &&[VertexId; 4]| cut.common(v).is_some();
        let before = old
            .iter()
            .filter(|&&t| cut.common(self.mesh.vertices(t)).is_some())
            .count();
        // Those of the smallest vertex first, so that the choice does not depend on where the ring starts.
        let least = (0..ring.len()).min_by_key(|&i| ring[i]).expect("a ring");
        (least..least + starts).find_map(|start| {
            let r = |i: usize| ring[(start + i) % ring.len()];
            let triangles = [[r(0), r(1), r(2)], [r(0), r(2), r(3)]];
            let new: Vec<[VertexId; 4]> = triangles[..ring.len() - 2]
                .iter()
                .flat_map(|&[a, b, c]| [[a, b, c, q], [a, c, b, p]])
                .collect();
            let fewer = new.iter().filter(is_shim).count() < before;
            let positive = |&v: &[VertexId; 4]| self.points.orient3d(v).is_positive();
            if !fewer
                || !new.iter().all(positive)
                || ring.len() == 4 && self.subsegments.share_segment(r(0), r(2))
            {
                return None;
            }
            let mut flip = Flip {
                old: old.clone(),
                new,
                uncovered: Vec::new(),
                covered: Vec::new(),
            };
            (self.moves_surface(&mut flip, [p, q], &ring) && self.leaves_delaunay(&flip))
                .then_some(flip)
        })
    }

    /// Whether the polygons at the edge that is removed can be made of other triangles; notes them.
    fn moves_surface(&self, flip: &mut Flip, [p, q]: [VertexId; 2], ring: &[VertexId]) -> bool {
        let covered: Vec<(VertexId, u32)> = ring
            .iter()
            .filter_map(|&r| Some((r, *self.subpolygons.get(&face([p, q, r]))?)))
            .collect();
        let (r, s, piece) = match covered[..] {
            [] => return true,
            [(r, piece), (s, other)] => {
                let f = self.pieces.polygon_of(piece as usize);
                let same = f == self.pieces.polygon_of(other as usize);
                if !same
                    || !self.pieces.is_cut(f)
                    || self.subsegments.share_segment(r, s)
                    || !self.is_convex(f, [p, r, q, s])
                {
                    return false;
                }
                (r, s, piece)
            }
            _ => return false,
        };
        flip.uncovered = vec![face([p, q, r]), face([p, q, s])];
        flip.covered = vec![(face([p, r, s]), piece), (face([q, r, s]), piece)];
        flip.covered.iter().all(|&(t, _)| {
            let is_face = |v: &[VertexId; 4]| t.iter().all(|x| v.contains(x));
            !self.subpolygons.contains_key(&t) && flip.new.iter().any(is_face)
        })
    }

    /// Whether all faces of the new tetrahedra are on polygons, on the hull, or locally Delaunay.
    fn leaves_delaunay(&self, flip: &Flip) -> bool {
        let mut behind: FxHashMap<Face, VertexId> = FxHashMap::default();
        for &t in &flip.old {
            for c in (0..4).map(|slot| t.corner(slot)) {
                if !flip.old.contains(&self.mesh.neighbor(c)) {
                    behind.insert(face(self.mesh.facet(c)), self.mesh.apex_across(c));
                }
            }
        }
        let covered: FxHashSet<Face> = flip.covered.iter().map(|c| c.0).collect();
        flip.new.iter().all(|&v| {
            (0..4).all(|slot| {
                let others: Vec<VertexId> = (0..4).filter(|&i| i != slot).map(|i| v[i]).collect();
                let t = face([others[0], others[1], others[2]]);
                if covered.contains(&t) || self.subpolygons.contains_key(&t) {
                    return true;
                }
                let apex = behind.get(&t).copied().or_else(|| {
                    let neighbour = flip
                        .new
                        .iter()
                        .find(|w| **w != v && t.iter().all(|x| w.contains(x)))?;
                    neighbour.iter().copied().find(|x| !t.contains(x))
                });
                let apex = apex.expect("each face is inside or on the boundary");
                let [a, b, c, d] = v;
                apex.is_infinite()
                    || !self
                        .points
                        .insphere_unperturbed([a, b, c, d, apex])
                        .is_positive()
            })
        })
    }

    pub(super) fn apply(&mut self, flip: Flip) {
        let region = self.marks.region.get(flip.old[0].index()).copied();
        for &t in &flip.old {
            self.marks.kept[t.index()] = false;
        }
        let mesh = self.mesh.to_mut();
        let new = mesh.replace(&flip.old, &flip.new);
        self.incidence.to_mut().update(mesh, &new);
        self.marks.kept.resize(mesh.capacity(), false);
        for &t in &new {
            self.marks.kept[t.index()] = true;
        }
        if let Some(region) = region {
            self.marks.region.resize(mesh.capacity(), 0.0);
            for &t in &new {
                self.marks.region[t.index()] = region;
            }
        }
        if !flip.uncovered.is_empty() {
            let subpolygons = self.subpolygons.to_mut();
            for t in &flip.uncovered {
                subpolygons.remove(t);
            }
            subpolygons.extend(flip.covered);
        }
    }
}
