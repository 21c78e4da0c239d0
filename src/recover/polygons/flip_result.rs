//! What flips have made of a region, judged in exact arithmetic.
//!
//! In exact order the result is right by proof (Shewchuk 2003), and only impossible events are failures. In rounded
//! order nothing is proved, and if predicates were rounded, too ([`FlipOrder::is_naive`]), tetrahedra may be inverted.
//! But each flip keeps the boundary of the volume that it fills, as a chain of oriented triangles. So if all tetrahedra
//! are positive at the end then they fill R, each point once; if moreover none crosses f, all subpolygons are still
//! there, and every other face is locally Delaunay, then they are the CDT, which is unique.
//!
//! [`FlipOrder::is_naive`]: crate::recover::flips::FlipOrder::is_naive

use crate::delaunay::is_locally_delaunay;
use crate::mesh::{Corner, TetId, TetMesh};
use crate::predicate::PointStore;
use crate::recover::region::Sides;
use crate::recover::subpolygons::Subpolygons;
use crate::recover::subpolygons::{Face, face};
use rustc_hash::FxHashSet;

/// Why one region could not be inserted, in one orientation of f.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum RegionFailure {
    /// This many crossing tetrahedra are left.
    Stuck(usize),
    /// This many faces are not locally Delaunay.
    NotDelaunay(usize),
    /// An exactly ordered flip is impossible.
    Impossible,
    /// This many tetrahedra are flat or inverted.
    Inverted(usize),
    /// This many triangles of other polygons are gone.
    Displaced(usize),
    /// There were more flips than there can be.
    Endless,
}

fn corners(tets: &[TetId]) -> impl Iterator<Item = Corner> {
    tets.iter()
        .flat_map(|&t| (0..4).map(move |slot| t.corner(slot)))
}

/// The result of flips in a region.
pub(super) struct FlipResult<'a, P> {
    /// The mesh.
    pub mesh: &'a TetMesh,
    /// The polygon f.
    pub sides: &'a Sides<'a, P>,
    /// The tetrahedra in the place of R.
    pub tets: &'a [TetId],
    /// The triangles that need not be locally Delaunay.
    pub subpolygons: &'a Subpolygons,
}

impl<P: PointStore> FlipResult<'_, P> {
    /// Whether all tetrahedra are positive.
    pub fn check_orientation(&self) -> Result<(), RegionFailure> {
        let points = self.sides.points();
        let positive = |t: TetId| points.orient3d(self.mesh.vertices(t)).is_positive();
        match self.tets.iter().filter(|&&t| !positive(t)).count() {
            0 => Ok(()),
            n => Err(RegionFailure::Inverted(n)),
        }
    }

    /// Whether none crosses f.
    pub fn check_crossings(&self) -> Result<(), RegionFailure> {
        let crosses = |t: TetId| self.sides.crosses_tet(self.mesh, t);
        match self.tets.iter().filter(|&&t| crosses(t)).count() {
            0 => Ok(()),
            n => Err(RegionFailure::Stuck(n)),
        }
    }

    /// Whether the triangles `inner` are still there.
    pub fn check_subpolygons(&self, inner: &[Face]) -> Result<(), RegionFailure> {
        if inner.is_empty() {
            return Ok(());
        }
        let present: FxHashSet<Face> = corners(self.tets)
            .map(|c| face(self.mesh.facet(c)))
            .collect();
        match inner.iter().filter(|t| !present.contains(*t)).count() {
            0 => Ok(()),
            n => Err(RegionFailure::Displaced(n)),
        }
    }

    /// Whether all faces but those `on_f` and other subpolygons are locally Delaunay, those on the boundary of R
    /// included.
    pub fn check_delaunay(&self, on_f: &[Face]) -> Result<(), RegionFailure> {
        let on_f: FxHashSet<Face> = on_f.iter().copied().collect();
        let points = self.sides.points();
        let bad = corners(self.tets)
            .filter(|&c| !is_locally_delaunay(points, self.mesh, c))
            .filter(|&c| {
                let t = face(self.mesh.facet(c));
                !on_f.contains(&t) && !self.subpolygons.contains_key(&t)
            });
        // From both sides, perhaps.
        let bad: FxHashSet<Face> = bad.map(|c| face(self.mesh.facet(c))).collect();
        match bad.len() {
            0 => Ok(()),
            n => Err(RegionFailure::NotDelaunay(n)),
        }
    }
}
