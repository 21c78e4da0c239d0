//! All polygons, one missing region at a time, by any of the algorithms (paper §3, §3.3).

mod by_flips;
mod by_retriangulation;
mod counts;
mod cover;
mod flip_result;
mod intersections;
mod trial;
mod whole;

pub use super::method::{FlipOrder, Insertion, NumberType};
pub use counts::{PolygonCounts, RepairCounts};
pub(crate) use trial::try_whole;
pub(crate) use whole::delete_whole;

use super::flips::{FlipObserver, FlipRegion};
use super::region::Sides;
use super::region::missing::{self, Covering, Obstacle};
use super::subpolygons::Face;
use super::workspace::{ConstrainedMesh, EdgeProtectedPlc};
use crate::error::{Failure, GaveUp, InvalidPlc, NotFlatReason};
use crate::mesh::{TetId, VertexId};
use crate::plc::Polygon;
use crate::predicate::PointStore;
use rustc_hash::FxHashMap;
use std::collections::VecDeque;

/// Inserts polygons into the tetrahedralization of an edge-protected PLC.
pub(crate) struct PolygonInsertion<'a, P> {
    plc: &'a EdgeProtectedPlc<P>,
    cdt: &'a mut ConstrainedMesh,
    insertion: Insertion,
    counts: PolygonCounts,
    /// The triangles noted for the polygon that is being inserted.
    noted: Vec<Face>,
    /// Whether a polygon that is flat only to rounding may fit on one side only, as long as it is not known which.
    may_fit_on_one_side: bool,
    /// The faces that are not locally Delaunay beside polygons that fit on one side only, with those.
    tolerated: FxHashMap<Face, u32>,
    /// Flips in numbers of the caller's own, in the place of `insertion`.
    own_flips: Option<&'a dyn FlipRegion<P>>,
    /// Who observes the flips.
    observer: Option<&'a mut dyn FlipObserver>,
}

/// The polygon f that is being inserted.
struct Current<'a, P> {
    /// Its index.
    f: usize,
    polygon: &'a Polygon,
    sides: Sides<'a, P>,
    /// The directed subsegments that bound it.
    boundary: Vec<[VertexId; 2]>,
    /// Whether it may displace others, being inserted for the first time.
    may_displace: bool,
}

impl<'a, P: PointStore> PolygonInsertion<'a, P> {
    /// Nothing is inserted yet.
    pub fn new(
        plc: &'a EdgeProtectedPlc<P>,
        cdt: &'a mut ConstrainedMesh,
        insertion: Insertion,
    ) -> PolygonInsertion<'a, P> {
        PolygonInsertion {
            plc,
            cdt,
            insertion,
            counts: PolygonCounts::default(),
            noted: Vec::new(),
            may_fit_on_one_side: false,
            tolerated: FxHashMap::default(),
            own_flips: None,
            observer: None,
        }
    }

    /// The same, by flips in numbers of the caller's own.
    pub fn by_own_flips(
        plc: &'a EdgeProtectedPlc<P>,
        cdt: &'a mut ConstrainedMesh,
        flips: &'a dyn FlipRegion<P>,
    ) -> PolygonInsertion<'a, P> {
        let exact = PolygonInsertion::new(plc, cdt, Insertion::Flip(FlipOrder::FILTERED));
        PolygonInsertion {
            own_flips: Some(flips),
            ..exact
        }
    }

    /// The same, with somebody who is told about every flip.
    pub fn observed_by(self, observer: Option<&'a mut dyn FlipObserver>) -> Self {
        PolygonInsertion { observer, ..self }
    }

    /// What has been done.
    pub fn counts(&self) -> PolygonCounts {
        self.counts
    }

    /// Inserts all polygons that are not in the mesh. `progress` is told how many are done.
    ///
    /// # Errors
    /// The first polygon that cannot be inserted, by name.
    pub fn insert_all(&mut self, progress: &mut dyn FnMut(usize)) -> Result<(), Failure> {
        let n = self.plc.pieces.complex.polygons.len();
        self.cdt.subpolygons.reserve(n);
        // Those that are flat only to rounding find the mesh as it was when they were tried.
        let plc = self.plc;
        let polygons = plc.pieces.complex.polygons.iter();
        for (f, _) in polygons.enumerate().filter(|(_, polygon)| !polygon.flat) {
            self.insert(f)?;
        }
        for f in 0..n {
            self.insert(f)?;
            progress(f + 1);
        }
        Ok(())
    }

    /// Inserts polygon `f`, unless it is in the mesh, and again those that it displaces.
    ///
    /// # Errors
    /// The first polygon that cannot be inserted, by name.
    pub fn insert(&mut self, f: usize) -> Result<(), Failure> {
        if self.cdt.inserted[f] {
            return Ok(());
        }
        // Displaced polygons are reinserted at once, and may not displace others, so that this ends.
        let mut queue = VecDeque::from([(f, true)]);
        while let Some((f, first_time)) = queue.pop_front() {
            let displaced = self.insert_polygon(f, first_time)?;
            self.cdt.inserted[f] = true;
            self.counts.reinserted += displaced.len() as u64;
            for g in displaced {
                self.cdt.inserted[g] = false;
                queue.push_back((g, false));
            }
        }
        self.counts.polygons += 1;
        Ok(())
    }

    /// Inserts polygon `f`, and returns the polygons that it displaced.
    fn insert_polygon(&mut self, f: usize, may_displace: bool) -> Result<Vec<usize>, Failure> {
        let polygon = &self.plc.pieces.complex.polygons[f];
        if let Some(triangle) = self.triangle_in_mesh(polygon) {
            self.counts.already_present += u64::from(may_displace);
            self.cdt.subpolygons.insert(triangle, f as u32);
            return Ok(Vec::new());
        }
        let f = self.begin(f, may_displace);
        if !f.sides.flat {
            let f = self.insert_whole(f)?;
            self.cdt.scratch.sides = f.sides.into_table();
            return Ok(Vec::new());
        }
        let displaced = self.insert_missing_regions(&f)?;
        self.cdt.scratch.sides = f.sides.into_table();
        Ok(displaced)
    }

    /// The boundary of polygon `f`, and what is needed to tell its sides.
    fn begin(&mut self, f: usize, may_displace: bool) -> Current<'a, P> {
        let plc = self.plc;
        let polygon = &plc.pieces.complex.polygons[f];
        let boundary = plc.subsegments.boundary(polygon);
        let on_boundary = boundary.iter().flatten();
        let sides = Sides::with_table(
            &plc.points,
            polygon,
            polygon.vertices.iter().chain(on_boundary).copied(),
            std::mem::take(&mut self.cdt.scratch.sides),
        );
        Current {
            f,
            polygon,
            sides,
            boundary,
            may_displace,
        }
    }

    /// Searches f, which is flat, for missing regions and inserts them, until there are none (paper §3.3). Returns the
    /// polygons that this displaced.
    fn insert_missing_regions(&mut self, f: &Current<P>) -> Result<Vec<usize>, Failure> {
        let mut displaced: Vec<usize> = Vec::new();
        let mut covering = self.search(f)?;
        if f.may_displace {
            self.counts.already_present += u64::from(covering.seeds.is_empty());
        }
        // A region may be hidden behind another one, from which segments inside f part it, until that one is inserted.
        while !covering.seeds.is_empty() {
            self.note(f, &self.facets(&covering));
            let mut inserted = false;
            for &seed in &covering.seeds {
                // The region of a seed may have been inserted with that of another one.
                let mesh = &self.cdt.mesh;
                if mesh.is_alive(seed) && f.sides.crosses_tet(mesh, seed) {
                    displaced.extend(self.insert_region(f, seed)?);
                    inserted = true;
                }
            }
            // Each round covers more of f.
            if !inserted {
                return Err(not_flat(f.polygon, NotFlatReason::AmbiguousSide));
            }
            covering = self.search(f)?;
        }
        self.settle(f, &self.facets(&covering));
        displaced.sort_unstable();
        displaced.dedup();
        Ok(displaced)
    }

    /// What of f is in the mesh.
    fn search(&self, f: &Current<P>) -> Result<Covering, Failure> {
        let (mesh, incidence) = (&self.cdt.mesh, &self.cdt.incidence);
        let is_of_f = |t: Face| self.cdt.subpolygons.get(&t) == Some(&(f.f as u32));
        let found = missing::search(mesh, incidence, &f.sides, &f.boundary, &is_of_f);
        found.map_err(|obstacle| match obstacle {
            // Otherwise the vertex may be beyond an edge of f with Steiner points that are off the plane.
            Obstacle::Stray(vertex) if !self.is_on_segment(vertex) => {
                let facets = f.polygon.facets.clone();
                InvalidPlc::VertexOnPolygon { facets, vertex }.into()
            }
            Obstacle::Stray(_) | Obstacle::Nothing(_) => {
                not_flat(f.polygon, NotFlatReason::AmbiguousSide)
            }
        })
    }

    /// Whether v is a Steiner point on a segment.
    fn is_on_segment(&self, v: VertexId) -> bool {
        self.plc.subsegments.segment_of_steiner(v).is_some()
    }

    /// The triangles of f that are in the mesh, seen from its left side.
    fn facets(&self, covering: &Covering) -> Vec<[VertexId; 3]> {
        let corners = covering.faces.iter();
        corners.map(|&c| self.cdt.mesh.facet(c)).collect()
    }

    /// Inserts f where the tetrahedron `seed` crosses it, and returns the polygons that this displaced.
    fn insert_region(&mut self, f: &Current<P>, seed: TetId) -> Result<Vec<usize>, Failure> {
        let memory = std::mem::take(&mut self.cdt.scratch.region);
        let region = memory.regrown(&self.cdt.mesh, &f.sides, seed);
        self.check_crossings(f, &region)?;
        self.counts.regions += 1;
        self.counts.crossing_tets += region.tets.len() as u64;
        self.counts.largest_region = self.counts.largest_region.max(region.tets.len() as u64);
        let order = match self.insertion {
            Insertion::Flip(order) => order,
            Insertion::Cavity | Insertion::GiftWrap => FlipOrder::FILTERED,
        };
        let retriangulated = match self.insertion {
            Insertion::Flip(_) => None,
            Insertion::Cavity | Insertion::GiftWrap => self.by_retriangulation(f, &region),
        };
        let displaced = match retriangulated {
            Some(displaced) => displaced,
            None => self.by_flips(f, &region, self.own_flips.unwrap_or(&order))?,
        };
        self.cdt.scratch.region = region;
        Ok(displaced)
    }
}

/// A polygon that cannot be inserted because it is not flat.
fn not_flat(polygon: &Polygon, reason: NotFlatReason) -> Failure {
    let facets = polygon.facets.clone();
    GaveUp::NotFlat { facets, reason }.into()
}
