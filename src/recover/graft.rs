//! Polygon insertion by retriangulating R as a whole: cavities or gift wrapping, and what comes after a refusal.
//!
//! Cavity retriangulation, where it is chosen, is tried first, and gift wrapping of the two original cavities where it is
//! refused. Gift wrapping is refused only if f is not flat or the PLC not valid; then the caller flips.

use super::cavity::{self, Face, Refused, Retriangulation};
use super::gift_wrap::gift_wrap;
use super::method::Insertion;
use super::polygons::{PolygonInsertion, count_shims};
use super::region::Region;
use super::side::Sides;
use crate::predicate::PointStore;

impl<P: PointStore> PolygonInsertion<'_, P> {
    /// Retriangulates one region as a whole, and returns the polygons that this displaced; `None` if it is refused.
    pub(super) fn by_retriangulation(
        &mut self,
        f: usize,
        sides: &Sides<P>,
        region: &Region,
        may_displace: bool,
    ) -> Option<Vec<usize>> {
        // Where f is not flat, the two orientations differ.
        let reversed = (!sides.flat).then(|| sides.reversed());
        let mut orientations = std::iter::once(sides).chain(&reversed);
        if self.insertion == Insertion::Cavity {
            let found = orientations
                .clone()
                .find_map(|sides| self.by_cavity(sides, region, may_displace));
            if let Some(r) = found {
                return Some(self.graft(f, sides, &r));
            }
            self.counts.cavity_fallbacks += 1;
        }
        let found = orientations.find_map(|sides| self.by_gift_wrapping(sides, region));
        if found.is_none() {
            self.counts.flip_fallbacks += 1;
        } else if self.insertion == Insertion::Cavity {
            self.counts.gift_wrap_fallbacks += 1;
        }
        found.map(|r| self.graft(f, sides, &r))
    }

    fn by_cavity(
        &self,
        sides: &Sides<P>,
        region: &Region,
        may_displace: bool,
    ) -> Option<Retriangulation> {
        let is_subpolygon = |t: Face| self.subpolygons.contains_key(&t);
        let result =
            cavity::retriangulate(self.mesh, sides, region, &is_subpolygon).and_then(|r| {
                if !may_displace && !r.displaced.is_empty() {
                    Err(Refused::Displaces)
                } else if self.mesh.can_replace(&r.old, &r.new) {
                    Ok(r)
                } else {
                    Err(Refused::NotExposed)
                }
            });
        result.ok()
    }

    fn by_gift_wrapping(&self, sides: &Sides<P>, region: &Region) -> Option<Retriangulation> {
        let is_subpolygon = |t: Face| self.subpolygons.contains_key(&t);
        let wrapped = gift_wrap(self.mesh, sides, region, &is_subpolygon).ok()?;
        self.mesh
            .can_replace(&wrapped.old, &wrapped.new)
            .then_some(wrapped)
    }

    /// Puts a retriangulation into the mesh.
    fn graft(&mut self, f: usize, sides: &Sides<P>, r: &Retriangulation) -> Vec<usize> {
        let created = self.mesh.replace(&r.old, &r.new);
        self.incidence.update(self.mesh, &created);
        self.counts.swallowed += r.swallowed as u64;
        self.counts.displaced += r.displaced.len() as u64;
        self.counts.shims += count_shims(self.mesh, sides, &created);
        self.register(f, &r.faces);
        let polygons = r
            .displaced
            .iter()
            .filter_map(|t| self.subpolygons.remove(t));
        polygons.map(|g| g as usize).collect()
    }
}
