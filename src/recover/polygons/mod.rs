//! All polygons, one missing region at a time, by any of the algorithms (paper §3, §3.3).

mod by_retriangulation;
mod counts;
mod flip_result;
mod intersections;

pub use super::method::{FlipOrder, Insertion, NumberType};
pub use super::subpolygons::Subpolygons;
pub use counts::PolygonCounts;

use super::flips::{FlipObserver, FlipOutcome, FlipRegion, FlipScratch, Flipped, polygon_faces};
use super::region::missing::{self, Obstacle};
use super::region::{Region, Side, SideTable, Sides, region_as_plc};
use super::retriangulate::cavity::CavityScratch;
use super::segments::{SegmentIndex, Subsegments};
use super::subpolygons::{Face, face};
use super::tables::Table;
use crate::clock::{TaskClock, TaskSeconds};
use crate::delaunay::is_locally_delaunay;
use crate::error::{Failure, GaveUp, InvalidPlc, NotFlatReason};
use crate::mesh::{Incidence, TetId, TetMesh, VertexId};
use crate::plc::{Complex, Polygon};
use crate::predicate::PointStore;
use flip_result::{FlipResult, RegionFailure};
use rustc_hash::FxHashSet;
use std::collections::VecDeque;

/// Inserts polygons into the tetrahedralization of an edge-protected PLC.
pub struct PolygonInsertion<'a, P> {
    /// The vertices.
    pub points: &'a P,
    /// The mesh.
    pub mesh: &'a mut TetMesh,
    /// Its vertex stars.
    pub incidence: &'a mut Incidence,
    /// The PLC.
    pub complex: &'a Complex,
    /// Its segments as they are in the mesh.
    pub subsegments: &'a Subsegments,
    /// Finds the segments of the input.
    pub index: &'a SegmentIndex,
    /// The triangles inserted so far.
    pub subpolygons: &'a mut Subpolygons,
    /// Which polygons are in the mesh.
    pub inserted: &'a mut [bool],
    /// Which algorithm.
    pub insertion: Insertion,
    /// What has been done.
    pub counts: PolygonCounts,
    /// The triangles noted for the polygon that is being inserted.
    pub candidates: Vec<Face>,
    /// Memory used again for every polygon.
    pub scratch: &'a mut Scratch,
    /// Flips in numbers of the caller's own, in the place of `insertion`.
    pub own_flips: Option<&'a dyn FlipRegion<P>>,
    /// Who observes the flips.
    pub observer: Option<&'a mut dyn FlipObserver>,
}

/// Tables that are kept from polygon to polygon.
#[derive(Clone, Debug, Default)]
pub struct Scratch {
    pub(crate) flips: FlipScratch,
    pub(super) cavity: CavityScratch,
    pub(crate) sides: SideTable,
    region: Table<bool>,
    pub(super) star: Vec<TetId>,
}

impl Scratch {
    /// From now on, tasks are timed.
    pub(crate) fn time_tasks(&mut self) {
        self.cavity.clock = TaskClock::started();
        self.flips.clock = TaskClock::started();
    }

    /// The seconds of tasks since [`Scratch::time_tasks`].
    pub(crate) fn task_seconds(&self) -> TaskSeconds {
        self.cavity.clock.seconds().and(self.flips.clock.seconds())
    }
}

/// How often a polygon that is flat only to rounding is searched for missing regions.
const ROUNDS_IF_NOT_FLAT: usize = 8;

/// The triangles of a region's part of f, after its insertion.
type Faces = Vec<[VertexId; 3]>;

impl<P: PointStore> PolygonInsertion<'_, P> {
    /// Inserts all polygons of the complex that are not in the mesh. `progress` is told how many are done.
    ///
    /// # Errors
    /// The first polygon that cannot be inserted, by name.
    pub fn insert_all(&mut self, progress: &mut dyn FnMut(usize)) -> Result<(), Failure> {
        self.subpolygons.reserve(self.complex.polygons.len());
        for f in 0..self.complex.polygons.len() {
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
        if self.inserted[f] {
            return Ok(());
        }
        // Displaced polygons are reinserted at once, and may not displace others, so that this ends.
        let mut queue = VecDeque::from([(f, true)]);
        while let Some((f, first_time)) = queue.pop_front() {
            let displaced = self.insert_polygon(f, first_time)?;
            self.inserted[f] = true;
            self.counts.reinserted += displaced.len() as u64;
            for g in displaced {
                self.inserted[g] = false;
                queue.push_back((g, false));
            }
        }
        self.counts.polygons += 1;
        Ok(())
    }

    /// Inserts polygon `f`, and returns the polygons that it displaced.
    fn insert_polygon(&mut self, f: usize, may_displace: bool) -> Result<Vec<usize>, Failure> {
        let polygon = &self.complex.polygons[f];
        if let Some(triangle) = self.triangle_in_mesh(polygon) {
            self.counts.already_present += u64::from(may_displace);
            self.subpolygons.insert(triangle, f as u32);
            return Ok(Vec::new());
        }
        let boundary = boundary_subsegments(self.subsegments, self.index, polygon);
        let on_boundary = boundary.iter().flatten().copied();
        let sides = Sides::with_table(
            self.points,
            polygon,
            polygon.vertices.iter().copied().chain(on_boundary),
            std::mem::take(&mut self.scratch.sides),
        );
        let result = self.insert_where_missing(f, &sides, &boundary, may_displace);
        self.scratch.sides = sides.into_table();
        result
    }

    /// The same, for a polygon whose sides and boundary are known.
    fn insert_where_missing(
        &mut self,
        f: usize,
        sides: &Sides<P>,
        boundary: &[[VertexId; 2]],
        may_displace: bool,
    ) -> Result<Vec<usize>, Failure> {
        let flat = sides.flat;
        let mut displaced: Vec<usize> = Vec::new();
        let mut covering = self.search(f, sides, boundary)?;
        if may_displace {
            self.counts.already_present += u64::from(covering.seeds.is_empty());
            self.counts.not_flat += u64::from(!flat);
        }
        // A region may be hidden behind another one, from which segments inside f part it, until that one is inserted.
        let mut rounds = 0;
        while !covering.seeds.is_empty() {
            let faces: Faces = covering.faces.iter().map(|&c| self.mesh.facet(c)).collect();
            self.register(f, &faces);
            let mut inserted = false;
            for &seed in &covering.seeds {
                // The region of a seed may have been inserted with that of another one.
                if self.mesh.is_alive(seed) && sides.crosses_tet(self.mesh, seed) {
                    displaced.extend(self.insert_region(f, sides, flat, seed, may_displace)?);
                    inserted = true;
                }
            }
            // Each round covers more of a flat f. If f is not flat nothing says so.
            rounds += 1;
            if !inserted || (!flat && rounds == ROUNDS_IF_NOT_FLAT) {
                return Err(self.not_flat(f, NotFlatReason::AmbiguousSide));
            }
            covering = self.search(f, sides, boundary)?;
        }
        // The corners are on the left side of f; seen from there, f lies to the left of its boundary edges.
        let seen_from_left = |[a, b, c]: [VertexId; 3]| [b, a, c];
        let faces = covering
            .faces
            .iter()
            .map(|&c| seen_from_left(self.mesh.facet(c)));
        let faces: Faces = faces.collect();
        self.settle(f, flat, &faces, boundary)?;
        displaced.sort_unstable();
        displaced.dedup();
        Ok(displaced)
    }

    fn search(
        &self,
        f: usize,
        sides: &Sides<P>,
        boundary: &[[VertexId; 2]],
    ) -> Result<missing::Covering, Failure> {
        let is_subpolygon = |t: Face| self.subpolygons.get(&t) == Some(&(f as u32));
        missing::search(self.mesh, self.incidence, sides, boundary, &is_subpolygon).map_err(
            |obstacle| match obstacle {
                // Otherwise the vertex may be beyond an edge of f with Steiner points that are off the plane.
                Obstacle::Stray(vertex)
                    if sides.flat && self.subsegments.segment_of_steiner(vertex).is_none() =>
                {
                    let facets = self.complex.polygons[f].facets.clone();
                    InvalidPlc::VertexOnPolygon { facets, vertex }.into()
                }
                Obstacle::Stray(_) | Obstacle::Nothing(_) => {
                    self.not_flat(f, NotFlatReason::AmbiguousSide)
                }
            },
        )
    }

    /// Inserts the region that `seed` belongs to, and returns the polygons that it displaced.
    fn insert_region(
        &mut self,
        f: usize,
        sides: &Sides<P>,
        flat: bool,
        seed: TetId,
        may_displace: bool,
    ) -> Result<Vec<usize>, Failure> {
        let marks = std::mem::take(&mut self.scratch.region);
        let region = Region::with_marks(self.mesh, sides, seed, marks);
        let result = self.insert_grown(f, sides, flat, &region, may_displace);
        self.scratch.region = region.into_marks();
        result
    }

    /// The same, once the region is known.
    fn insert_grown(
        &mut self,
        f: usize,
        sides: &Sides<P>,
        flat: bool,
        region: &Region,
        may_displace: bool,
    ) -> Result<Vec<usize>, Failure> {
        self.check_crossings(f, sides, flat, region)?;
        self.counts.regions += 1;
        self.counts.crossing_tets += region.tets.len() as u64;
        self.counts.largest_region = self.counts.largest_region.max(region.tets.len() as u64);
        let order = match self.insertion {
            Insertion::Flip(order) => order,
            Insertion::Cavity | Insertion::GiftWrap => {
                if let Some(displaced) = self.by_retriangulation(f, sides, region, may_displace) {
                    return Ok(displaced);
                }
                FlipOrder::FILTERED
            }
        };
        let flips = self.own_flips.unwrap_or(&order);
        let mut result = self.by_flips(f, sides, flat, region, flips);
        if !flat && let Err((_, region)) = &result {
            result = self.by_flips(f, &sides.reversed(), flat, region, flips);
        }
        result
            .map(|()| Vec::new())
            .map_err(|(failure, region)| self.flips_failed(f, sides, &region, failure))
    }

    /// The failure of flips, with the region, which has been restored, as a PLC.
    fn flips_failed(
        &self,
        f: usize,
        sides: &Sides<P>,
        region: &Region,
        failure: RegionFailure,
    ) -> Failure {
        if !sides.flat {
            return self.not_flat(f, NotFlatReason::Incompatible);
        }
        let facets = self.complex.polygons[f].facets.clone();
        let region = Box::new(region_as_plc(self.mesh, sides, region, self.subpolygons));
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

    /// Flips in one region. If they fail the region is restored, and given back.
    fn by_flips(
        &mut self,
        f: usize,
        sides: &Sides<P>,
        flat: bool,
        region: &Region,
        flips: &dyn FlipRegion<P>,
    ) -> Result<(), (RegionFailure, Region)> {
        let before: Vec<[VertexId; 4]> =
            region.tets.iter().map(|&t| self.mesh.vertices(t)).collect();
        if let Some(observer) = &mut self.observer {
            observer.begin(f, sides.frame, &before);
        }
        let inner = match flips.is_exact() {
            true => Vec::new(),
            false => region.inner_subpolygons(self.mesh, self.subpolygons),
        };
        let scratch = &mut self.scratch.flips;
        let observer = self.observer.as_deref_mut();
        let observer = observer.map(|o| o as &mut dyn FlipObserver);
        let Flipped {
            outcome,
            tets,
            counts,
        } = flips.insert(self.mesh, sides, region, scratch, observer);
        self.counts.flips.add(&counts);
        self.incidence.update(self.mesh, &tets);
        let faces = polygon_faces(self.mesh, sides, &tets);
        let judge = FlipResult {
            mesh: self.mesh,
            sides,
            tets: &tets,
            subpolygons: self.subpolygons,
        };
        let verdict = match outcome {
            FlipOutcome::Impossible => Err(RegionFailure::Impossible),
            FlipOutcome::Endless => Err(RegionFailure::Endless),
            // The sides were rounded, so that the outcome may be wrong.
            _ if flips.is_naive() => judge.check_orientation().and(judge.check_crossings()),
            FlipOutcome::Stuck { crossing } => Err(RegionFailure::Stuck(crossing)),
            FlipOutcome::Done => Ok(()),
        };
        // Exact times on a flat polygon of a valid PLC make the CDT, by proof; what is wrong with an invalid one is
        // found and named by the next search. Rounded times can leave triangles that are not locally Delaunay, and so
        // can a polygon that is not flat (paper, end of §3.2).
        let verdict = if flat && flips.is_exact() {
            verdict
        } else {
            let on_f: Vec<Face> = faces.iter().map(|&t| face(t)).collect();
            verdict
                .and_then(|()| judge.check_subpolygons(&inner))
                .and_then(|()| judge.check_delaunay(&on_f))
        };
        if let Err(failure) = verdict {
            let mut tets = self.mesh.replace(&tets, &before);
            self.incidence.update(self.mesh, &tets);
            tets.sort_unstable();
            return Err((failure, Region::of(tets)));
        }
        self.counts.shims += count_shims(self.mesh, sides, &tets);
        self.recovered(f, &faces);
        Ok(())
    }

    /// Notes the triangles with which the insertion of a region covered f.
    pub(super) fn recovered(&mut self, f: usize, faces: &Faces) {
        self.counts.recovered += faces.len() as u64;
        self.counts.most_recovered = self.counts.most_recovered.max(faces.len() as u64);
        self.register(f, faces);
    }

    /// Notes triangles of f that are in the mesh.
    fn register(&mut self, f: usize, faces: &Faces) {
        self.candidates.extend(faces.iter().map(|&t| face(t)));
        self.subpolygons
            .extend(faces.iter().map(|&t| (face(t), f as u32)));
    }

    /// Makes `faces`, found by the last search, the subpolygons of f. Where f is flat only to rounding, insertions may
    /// have noted triangles that are not in them, next to f's border; those must be locally Delaunay then, and f's own
    /// must cover it simply.
    fn settle(
        &mut self,
        f: usize,
        flat: bool,
        faces: &[[VertexId; 3]],
        boundary: &[[VertexId; 2]],
    ) -> Result<(), Failure> {
        let mut spurious: FxHashSet<Face> =
            std::mem::take(&mut self.candidates).into_iter().collect();
        for &t in faces {
            spurious.remove(&face(t));
            self.subpolygons.insert(face(t), f as u32);
        }
        let mut spurious: Vec<Face> = spurious.into_iter().collect();
        spurious.sort_unstable();
        for t in &spurious {
            self.subpolygons.remove(t);
        }
        let bad = |&t: &Face| !self.is_locally_delaunay(t);
        if !flat && (!covers_simply(faces, boundary) || spurious.iter().any(bad)) {
            return Err(self.not_flat(f, NotFlatReason::Incompatible));
        }
        Ok(())
    }

    /// Whether a triangle is gone from the mesh or is locally Delaunay in it.
    fn is_locally_delaunay(&self, [a, b, c]: Face) -> bool {
        let Some(t) = self.incidence.tet_at_edge(self.mesh, a, b) else {
            return true;
        };
        let with_triangle = self
            .mesh
            .around(t, a, b)
            .find(|&t| self.mesh.slot_of(t, c).is_some());
        with_triangle.is_none_or(|t| {
            let v = self.mesh.vertices(t);
            let apex = v
                .iter()
                .position(|v| ![a, b, c].contains(v))
                .expect("three of four vertices");
            let corner = t.corner(apex);
            self.mesh.is_ghost(t) || is_locally_delaunay(self.points, self.mesh, corner)
        })
    }

    pub(super) fn not_flat(&self, f: usize, reason: NotFlatReason) -> Failure {
        let facets = self.complex.polygons[f].facets.clone();
        GaveUp::NotFlat { facets, reason }.into()
    }
}

/// Whether oriented triangles have `boundary` as their boundary, and every other edge once in each direction.
fn covers_simply(faces: &[[VertexId; 3]], boundary: &[[VertexId; 2]]) -> bool {
    let mut open: FxHashSet<[VertexId; 2]> = FxHashSet::default();
    let edges = faces.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let border = boundary.iter().map(|&[a, b]| [b, a]);
    let mut simple = true;
    for [a, b] in edges.chain(border) {
        if !open.remove(&[b, a]) {
            simple &= open.insert([a, b]);
        }
    }
    simple && open.is_empty()
}

/// The directed subsegments that bound f.
pub(crate) fn boundary_subsegments(
    subsegments: &Subsegments,
    index: &SegmentIndex,
    f: &Polygon,
) -> Vec<[VertexId; 2]> {
    let mut boundary = Vec::with_capacity(f.edges.len());
    subsegments.append_boundary(index, f, &mut boundary);
    boundary
}

/// The tetrahedra whose vertices are all on f: none if that is flat.
pub(super) fn count_shims<P: PointStore>(mesh: &TetMesh, sides: &Sides<P>, tets: &[TetId]) -> u64 {
    if sides.flat {
        return 0;
    }
    let is_shim = |&&t: &&TetId| mesh.vertices(t).iter().all(|&v| sides.of(v) == Side::On);
    tets.iter().filter(is_shim).count() as u64
}
