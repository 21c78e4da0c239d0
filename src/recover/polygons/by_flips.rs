//! Polygon insertion by flips in one region, with a look at the result where the order of the flips is not exact.

use super::flip_result::{FlipResult, RegionFailure};
use super::{Current, PolygonInsertion};
use crate::error::{Failure, GaveUp};
use crate::mesh::VertexId;
use crate::predicate::PointStore;
use crate::recover::flips::{FlipObserver, FlipOutcome, FlipRegion, polygon_faces};
use crate::recover::region::{Region, region_as_plc};
use crate::recover::subpolygons::{Face, face};

impl<P: PointStore> PolygonInsertion<'_, P> {
    /// Flips in one region of f, which is flat; flips displace no polygons. If they fail the region is restored.
    pub(super) fn by_flips(
        &mut self,
        f: &Current<P>,
        region: &Region,
        flips: &dyn FlipRegion<P>,
    ) -> Result<Vec<usize>, Failure> {
        let sides = &f.sides;
        let mesh = &self.cdt.mesh;
        let before: Vec<[VertexId; 4]> = region.tets.iter().map(|&t| mesh.vertices(t)).collect();
        if let Some(observer) = &mut self.observer {
            observer.begin(f.f, sides.frame, &before);
        }
        let inner = match flips.is_exact() {
            true => Vec::new(),
            false => region.inner_subpolygons(mesh, &self.cdt.subpolygons),
        };
        let observer = self.observer.as_deref_mut();
        let observer = observer.map(|o| o as &mut dyn FlipObserver);
        let scratch = &mut self.cdt.scratch.flips;
        let flipped = flips.insert(&mut self.cdt.mesh, sides, region, scratch, observer);
        let tets = flipped.tets;
        self.counts.flips.add(&flipped.counts);
        self.cdt.created(&tets);
        let faces = polygon_faces(&self.cdt.mesh, sides, &tets);
        let result = FlipResult {
            mesh: &self.cdt.mesh,
            sides,
            tets: &tets,
            subpolygons: &self.cdt.subpolygons,
        };
        let verdict = match flipped.outcome {
            FlipOutcome::Impossible => Err(RegionFailure::Impossible),
            FlipOutcome::Endless => Err(RegionFailure::Endless),
            // The sides were rounded, so that the outcome may be wrong.
            _ if flips.is_naive() => result.check_orientation().and(result.check_crossings()),
            FlipOutcome::Stuck { crossing } => Err(RegionFailure::Stuck(crossing)),
            FlipOutcome::Done => Ok(()),
        };
        // Exact times on a flat polygon of a valid PLC make the CDT, by proof; what is wrong with an invalid one is
        // found and named by the next search. Rounded times can leave triangles that are not locally Delaunay.
        let verdict = if flips.is_exact() {
            verdict
        } else {
            let on_f: Vec<Face> = faces.iter().map(|&t| face(t)).collect();
            verdict
                .and_then(|()| result.check_subpolygons(&inner))
                .and_then(|()| result.check_delaunay(&on_f))
        };
        if let Err(failure) = verdict {
            let mut tets = self.cdt.mesh.replace(&tets, &before);
            self.cdt.created(&tets);
            tets.sort_unstable();
            return Err(self.flips_failed(f, &Region::of(tets), failure));
        }
        self.cover(f, &faces);
        Ok(Vec::new())
    }

    /// The failure of flips, with the region, which has been restored, as a PLC.
    fn flips_failed(&self, f: &Current<P>, region: &Region, failure: RegionFailure) -> Failure {
        let facets = f.polygon.facets.clone();
        let (mesh, subpolygons) = (&self.cdt.mesh, &self.cdt.subpolygons);
        let region = Box::new(region_as_plc(mesh, &f.sides, region, subpolygons));
        match failure {
            RegionFailure::Stuck(crossing) => GaveUp::Stuck {
                facets,
                crossing,
                region,
            },
            RegionFailure::NotDelaunay(faces) => GaveUp::NotDelaunay {
                facets,
                faces,
                region,
            },
            RegionFailure::Impossible => GaveUp::FlipOrder { facets, region },
            RegionFailure::Inverted(tets) => GaveUp::Inverted {
                facets,
                tets,
                region,
            },
            RegionFailure::Displaced(triangles) => GaveUp::Displaced {
                facets,
                triangles,
                region,
            },
            RegionFailure::Endless => GaveUp::Endless { facets, region },
        }
        .into()
    }
}
