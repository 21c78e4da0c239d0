//! Polygons that are flat only to rounding, inserted as they are (paper, end of §3.1 and of §3.2).
//!
//! # The algorithm
//! Flips insert f as if its vertices were on its plane (§3.2). What they leave right of f is Delaunay, piles of *shims*
//! (tetrahedra with all vertices on f) against f included: to the flips all of f's vertices are on one plane, and shims
//! count as right of it. The surface of f is drawn below all of them: [`rightmost`]. So right of it everything is as it
//! is to be, without shims, and what is left of it is a tetrahedralization with the shims, on a floor that is fixed
//! now. It need not be locally Delaunay, as the flips have treated vertices of f that are off the plane as if they were
//! on it. Flips of faces that are not locally Delaunay, 2-3, 3-2 and 4-4, repair it (`repair.rs`), and take the shims
//! away wherever the left side does not want them.
//!
//! Then the result is looked at, in exact arithmetic: the surface covers f once in projection and has all its vertices,
//! and each face of the new tetrahedra that is on no polygon is locally Delaunay. If something is wrong f is tried from
//! behind, where left and right change places; if it is wrong again, the mesh is as it was.
//!
//! # When it works
//! Let f's vertices be δ off its plane, in projection at least μ outside (in power) of the circumcircles of radius r of
//! the triangles of their Delaunay triangulation, and all other vertices η off the plane inside of those circles. If
//! δ·r²/η < μ, both sides want the Delaunay triangulation of f. Where four vertices of f are on one circle to rounding,
//! μ is 0, and each side may want either diagonal. If the right side wants the right one of the two, the left side can
//! have what it wants: the same, or the left one with a shim between them. If the right side wants the left one and the
//! left side the right one, there is no CDT without another vertex (Fig. 4).
//!
//! Complexity: that of the flips, and linear time for the look.

mod changed;
mod delete;
mod repair;

pub(crate) use delete::delete_whole;

use super::cover::{count_shims, covers_simply};
use super::{Current, PolygonInsertion, not_flat};
use crate::delaunay::is_locally_delaunay;
use crate::error::{Failure, NotFlatReason};
use crate::mesh::{Corner, TetId, VertexId};
use crate::predicate::PointStore;
use crate::recover::flatten::Fit;
use crate::recover::flips::{FlipOutcome, FlipRegion};
use crate::recover::method::FlipOrder;
use crate::recover::region::Side;
use crate::recover::region::missing::Covering;
use crate::recover::region::surface::rightmost;
use crate::recover::subpolygons::face;
use changed::Changed;
use rustc_hash::FxHashSet;

/// How often f is searched for missing regions.
const MOST_ROUNDS: usize = 8;

impl<'a, P: PointStore> PolygonInsertion<'a, P> {
    /// Inserts f, which is flat only to rounding, from either side. If it is refused the mesh has the tetrahedra that
    /// it had.
    pub(super) fn insert_whole(&mut self, f: Current<'a, P>) -> Result<Current<'a, P>, Failure> {
        let reversed = |f: &Current<'a, P>| Current {
            sides: f.sides.reversed(),
            boundary: f.boundary.iter().map(|&[a, b]| [b, a]).collect(),
            ..*f
        };
        match self.plc.pieces.fit(f.f) {
            Fit::Both => {}
            Fit::Right => return self.insert_from_right(&f, true).map(|()| f),
            Fit::Left => return self.insert_from_right(&reversed(&f), true).map(|()| f),
        }
        let refused = match self.insert_from_right(&f, false) {
            Ok(()) => return Ok(f),
            Err(refused) => refused,
        };
        let behind = reversed(&f);
        let is_in = self.insert_from_right(&behind, false).is_ok()
            || self.may_fit_on_one_side
                && (self.insert_from_right(&f, true).is_ok()
                    || self.insert_from_right(&behind, true).is_ok());
        if is_in { Ok(f) } else { Err(refused) }
    }

    /// Inserts f so that its right side is constrained Delaunay. Unless it `may_not_fit` on the left side, both are.
    fn insert_from_right(&mut self, f: &Current<P>, may_not_fit: bool) -> Result<(), Failure> {
        let mut changed = Changed::default();
        let bad = self.insert_and_look(f, &mut changed);
        let bad = bad.and_then(|bad| {
            let fits = bad.is_empty() || may_not_fit && bad.iter().all(|&c| self.is_left(f, c));
            let refused = || not_flat(f.polygon, NotFlatReason::Incompatible);
            fits.then_some(bad).ok_or_else(refused)
        });
        let result = match bad {
            Ok(bad) => {
                let created: Vec<TetId> = changed.new_tets().collect();
                self.counts.shims += count_shims(&self.cdt.mesh, &f.sides, &created);
                let faces = bad.iter().map(|&c| face(self.cdt.mesh.facet(c)));
                self.tolerated.extend(faces.map(|t| (t, f.f as u32)));
                Ok(())
            }
            Err(failure) => {
                for t in &self.noted {
                    self.cdt.subpolygons.remove(t);
                }
                changed.undo(self.cdt);
                Err(failure)
            }
        };
        self.noted.clear();
        result
    }

    /// Inserts f so that its right side is constrained Delaunay, and returns the faces that are not locally Delaunay.
    fn insert_and_look(
        &mut self,
        f: &Current<P>,
        changed: &mut Changed,
    ) -> Result<Vec<Corner>, Failure> {
        let refused = |reason| not_flat(f.polygon, reason);
        let mut rounds = 0;
        let covering = loop {
            let covering = self.surface(f)?;
            if covering.seeds.is_empty() {
                break covering;
            }
            if rounds == MOST_ROUNDS {
                return Err(refused(NotFlatReason::AmbiguousSide));
            }
            for &seed in &covering.seeds {
                let mesh = &self.cdt.mesh;
                if mesh.is_alive(seed) && f.sides.crosses_tet(mesh, seed) {
                    self.flip_whole(f, seed, changed)?;
                }
            }
            rounds += 1;
        };
        let faces = self.facets(&covering);
        if !covers_simply(&faces, &f.boundary) || !has_all(f, &faces) {
            return Err(refused(NotFlatReason::AmbiguousSide));
        }
        if faces
            .iter()
            .any(|&t| self.cdt.subpolygons.contains_key(&face(t)))
        {
            return Err(refused(NotFlatReason::AmbiguousSide));
        }
        self.cover(f, &faces);
        self.repair(changed.new_tets(), changed);
        Ok(self.not_locally_delaunay(changed))
    }

    fn surface(&self, f: &Current<P>) -> Result<Covering, Failure> {
        let (mesh, incidence) = (&self.cdt.mesh, &self.cdt.incidence);
        let found = rightmost(mesh, incidence, &f.sides, &f.boundary);
        found.map_err(|_| not_flat(f.polygon, NotFlatReason::AmbiguousSide))
    }

    /// Flips in the region of one tetrahedron.
    fn flip_whole(
        &mut self,
        f: &Current<P>,
        seed: TetId,
        changed: &mut Changed,
    ) -> Result<(), Failure> {
        let memory = std::mem::take(&mut self.cdt.scratch.region);
        let region = memory.regrown(&self.cdt.mesh, &f.sides, seed);
        self.check_crossings(f, &region)?;
        changed.removes(&self.cdt.mesh, &region.tets);
        let scratch = &mut self.cdt.scratch.flips;
        let order = FlipOrder::FILTERED;
        let flipped = order.insert(&mut self.cdt.mesh, &f.sides, &region, scratch, None);
        changed.creates(&flipped.tets);
        self.cdt.created(&flipped.tets);
        self.counts.regions += 1;
        self.counts.crossing_tets += region.tets.len() as u64;
        self.counts.largest_region = self.counts.largest_region.max(region.tets.len() as u64);
        self.counts.flips.add(&flipped.counts);
        self.cdt.scratch.region = region;
        match flipped.outcome {
            FlipOutcome::Done => Ok(()),
            _ => Err(not_flat(f.polygon, NotFlatReason::Incompatible)),
        }
    }

    /// The faces of the new tetrahedra that are not locally Delaunay, and neither on polygons nor tolerated.
    fn not_locally_delaunay(&self, changed: &Changed) -> Vec<Corner> {
        let (mesh, points) = (&self.cdt.mesh, &self.plc.points);
        let finite = changed.new_tets().filter(|&t| !mesh.is_ghost(t));
        let corners = finite.flat_map(|t| (0..4).map(move |slot| t.corner(slot)));
        let bad = corners.filter(|&c| !is_locally_delaunay(points, mesh, c));
        bad.filter(|&c| {
            let t = face(mesh.facet(c));
            !self.cdt.subpolygons.contains_key(&t) && !self.tolerated.contains_key(&t)
        })
        .collect()
    }

    /// Whether neither tetrahedron at a face has a vertex right of f.
    fn is_left(&self, f: &Current<P>, c: Corner) -> bool {
        let mesh = &self.cdt.mesh;
        let vertices = mesh.vertices(c.tet()).into_iter();
        let mut vertices = vertices.chain([mesh.apex_across(c)]);
        vertices.all(|v| f.sides.of(v) != Side::Right)
    }
}

/// Whether the faces have all vertices of f.
fn has_all<P>(f: &Current<P>, faces: &[[VertexId; 3]]) -> bool {
    let found: FxHashSet<VertexId> = faces.iter().flatten().copied().collect();
    f.polygon.vertices.iter().all(|v| found.contains(v))
}
