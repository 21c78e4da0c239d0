//! All polygons, one missing region at a time, by either algorithm (paper §3, §3.3).

use super::cavity::{self, Face, Refused, face};
use super::flips::{
    ExactTimes, FilteredTimes, FlipInsertion, FlipOutcome, FlipTimes, Motion, RoundedTimes,
    VertexNumbers, Watch, polygon_faces,
};
pub use super::method::{Insertion, PolygonCounts, Times};
use super::missing::{self, Obstacle};
use super::region::Region;
use super::scratch::Table;
use super::segments::{SegmentIndex, Subsegments};
use super::side::{Side, SideTable, Sides};
use crate::error::{Failure, GaveUp, InvalidPlc, NotFlatReason};
use crate::mesh::{Incidence, TetId, TetMesh, VertexId};
use crate::number::Dyadic;
use crate::plc::{Complex, Polygon};
use crate::predicate::PointStore;
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::VecDeque;

/// The triangles of the mesh that lie on polygons, by their vertices in ascending order.
pub type Subpolygons = FxHashMap<Face, u32>;

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
    /// Who watches the flips.
    pub watch: Option<&'a mut dyn Watch>,
}

/// Tables that are kept from polygon to polygon.
#[derive(Clone, Debug, Default)]
pub struct Scratch {
    pub(super) marks: Table<bool>,
    pub(super) numbers: VertexNumbers,
    pub(super) sides: SideTable,
}

/// The triangles of a region's part of f, after its insertion.
type Faces = Vec<[VertexId; 3]>;

/// Why one region could not be inserted, in one orientation of f.
enum RegionFailure {
    Stuck(usize),
    NotDelaunay(usize),
    Impossible,
}

impl<P: PointStore> PolygonInsertion<'_, P> {
    /// Inserts all polygons of the complex that are not in the mesh. `progress` is told how many are done.
    ///
    /// # Errors
    /// The first polygon that cannot be inserted, by name.
    pub fn insert_all(&mut self, progress: &mut dyn FnMut(usize)) -> Result<(), Failure> {
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
        if !covering.seeds.is_empty() {
            let faces: Faces = covering.faces.iter().map(|&c| self.mesh.facet(c)).collect();
            self.register(f, &faces);
            for &seed in &covering.seeds {
                // The region of a seed may have been inserted with that of another one.
                if self.mesh.is_alive(seed) && sides.crosses_tet(self.mesh, seed) {
                    displaced.extend(self.insert_region(f, sides, flat, seed, may_displace)?);
                }
            }
            covering = self.search(f, sides, boundary)?;
            if !covering.seeds.is_empty() {
                return Err(self.not_flat(f, NotFlatReason::AmbiguousSide));
            }
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
        let region = Region::grow(self.mesh, sides, seed);
        self.check_crossings(f, sides, flat, &region)?;
        self.counts.regions += 1;
        self.counts.crossing_tets += region.tets.len() as u64;
        self.counts.largest_region = self.counts.largest_region.max(region.tets.len() as u64);
        if self.insertion == Insertion::Cavity {
            if let Some(displaced) = self.by_cavity(f, sides, &region, may_displace) {
                return Ok(displaced);
            }
            if !flat
                && let Some(displaced) = self.by_cavity(f, &sides.reversed(), &region, may_displace)
            {
                return Ok(displaced);
            }
            self.counts.cavity_fallbacks += 1;
        }
        let times = match self.insertion {
            Insertion::Cavity => Times::Filtered,
            Insertion::Flip(times) => times,
        };
        let mut result = self.by_flips(f, sides, flat, region, times);
        if !flat && let Err((_, region)) = result {
            result = self.by_flips(f, &sides.reversed(), flat, region, times);
        }
        result.map(|()| Vec::new()).map_err(|(failure, _)| {
            let facets = self.complex.polygons[f].facets.clone();
            match failure {
                RegionFailure::Stuck(crossing) if flat => GaveUp::Stuck { facets, crossing }.into(),
                RegionFailure::NotDelaunay(faces) if flat => {
                    GaveUp::NotDelaunay { facets, faces }.into()
                }
                RegionFailure::Impossible if flat => GaveUp::FlipOrder { facets }.into(),
                _ => self.not_flat(f, NotFlatReason::Incompatible),
            }
        })
    }

    /// In a valid PLC no segment and no other polygon crosses f.
    fn check_crossings(
        &self,
        f: usize,
        sides: &Sides<P>,
        flat: bool,
        region: &Region,
    ) -> Result<(), Failure> {
        let certain = |vertices: &[VertexId]| {
            flat && vertices
                .iter()
                .all(|&v| self.subsegments.segment_of_steiner(v).is_none())
        };
        let facets = || self.complex.polygons[f].facets.clone();
        for segment in region.crossing_edges(self.mesh, sides) {
            let [a, b] = segment;
            if self.subsegments.segment_of(a, b).is_some() {
                return Err(if certain(&segment) {
                    let facets = facets();
                    InvalidPlc::SegmentThroughPolygon { facets, segment }.into()
                } else {
                    self.not_flat(f, NotFlatReason::Crossed)
                });
            }
        }
        for c in region.crossing_triangles(self.mesh, sides) {
            let facet = self.mesh.facet(c);
            if let Some(&other) = self.subpolygons.get(&face(facet)) {
                return Err(if certain(&facet) {
                    let second = self.complex.polygons[other as usize].facets.clone();
                    InvalidPlc::PolygonsIntersect {
                        first: facets(),
                        second,
                    }
                    .into()
                } else {
                    self.not_flat(f, NotFlatReason::Crossed)
                });
            }
        }
        Ok(())
    }

    /// Cavity retriangulation of one region; `None` if it is refused.
    fn by_cavity(
        &mut self,
        f: usize,
        sides: &Sides<P>,
        region: &Region,
        may_displace: bool,
    ) -> Option<Vec<usize>> {
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
        let r = result.ok()?;
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
        Some(polygons.map(|g| g as usize).collect())
    }

    /// Flips in one region. If they fail the region is restored, and given back.
    fn by_flips(
        &mut self,
        f: usize,
        sides: &Sides<P>,
        flat: bool,
        region: Region,
        times: Times,
    ) -> Result<(), (RegionFailure, Region)> {
        let before: Vec<[VertexId; 4]> =
            region.tets.iter().map(|&t| self.mesh.vertices(t)).collect();
        if let Some(watch) = &mut self.watch {
            watch.begin(f, sides.frame, &before);
        }
        let is_left = |v: VertexId| sides.of(v) == Side::Left;
        let numbers = std::mem::take(&mut self.scratch.numbers);
        let motion = Motion::with_numbers(self.points, sides.frame, &is_left, numbers);
        let m = &motion;
        let (outcome, tets) = match times {
            Times::F32 => self.run(sides, &region, RoundedTimes::<P, f32>::new(m)),
            Times::F64 => self.run(sides, &region, RoundedTimes::<P, f64>::new(m)),
            Times::Filtered => self.run(sides, &region, FilteredTimes::new(m)),
            Times::Exact => self.run(sides, &region, ExactTimes::<P, Dyadic>::new(m)),
            #[cfg(feature = "rug")]
            Times::Rug => self.run(sides, &region, ExactTimes::<P, rug::Rational>::new(m)),
        };
        self.scratch.numbers = motion.into_numbers();
        self.incidence.update(self.mesh, &tets);
        let faces = polygon_faces(self.mesh, sides, &tets);
        let failure = match outcome {
            FlipOutcome::Stuck { crossing } => Some(RegionFailure::Stuck(crossing)),
            FlipOutcome::Impossible => Some(RegionFailure::Impossible),
            FlipOutcome::Done => self.check_delaunay(flat, times, &tets, &faces).err(),
        };
        if let Some(failure) = failure {
            let mut tets = self.mesh.replace(&tets, &before);
            self.incidence.update(self.mesh, &tets);
            tets.sort_unstable();
            return Err((failure, Region { tets }));
        }
        self.counts.shims += count_shims(self.mesh, sides, &tets);
        self.register(f, &faces);
        Ok(())
    }

    fn run<C: FlipTimes>(
        &mut self,
        sides: &Sides<P>,
        region: &Region,
        times: C,
    ) -> (FlipOutcome, Vec<TetId>) {
        let (outcome, tets, counts) =
            FlipInsertion::new(self.mesh, sides, region, times, &mut self.scratch.marks)
                .watched_by(self.watch.as_deref_mut().map(|w| w as &mut dyn Watch))
                .insert(region);
        self.counts.flips.add(&counts);
        (outcome, tets)
    }

    /// Rounded times can leave triangles that are not locally Delaunay, and so can a polygon that is not flat (paper,
    /// end of §3.2). Exact times on a flat polygon cannot.
    fn check_delaunay(
        &self,
        flat: bool,
        times: Times,
        tets: &[TetId],
        faces: &[[VertexId; 3]],
    ) -> Result<(), RegionFailure> {
        let proved = flat && !matches!(times, Times::F32 | Times::F64);
        if proved {
            // In a valid PLC, that is; what is wrong with an invalid one is found and named by the next search.
            return Ok(());
        }
        let on_f: FxHashSet<Face> = faces.iter().map(|&t| face(t)).collect();
        let corners = tets
            .iter()
            .flat_map(|&t| (0..4).map(move |slot| t.corner(slot)));
        let bad = corners
            .filter(|&c| !self.mesh.is_ghost(self.mesh.neighbor(c)))
            .filter(|&c| {
                let [a, b, d, e] = self.mesh.vertices(c.tet());
                self.points
                    .insphere([a, b, d, e, self.mesh.apex_across(c)])
                    .is_positive()
            })
            .filter(|&c| {
                let t = face(self.mesh.facet(c));
                !on_f.contains(&t) && !self.subpolygons.contains_key(&t)
            })
            .count();
        if bad > 0 {
            Err(RegionFailure::NotDelaunay(bad))
        } else {
            Ok(())
        }
    }

    /// Notes the triangles with which an insertion covered f.
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
            let ghost = |t: TetId| self.mesh.is_ghost(t);
            ghost(t)
                || ghost(self.mesh.neighbor(corner))
                || !self
                    .points
                    .insphere([v[0], v[1], v[2], v[3], self.mesh.apex_across(corner)])
                    .is_positive()
        })
    }

    fn not_flat(&self, f: usize, reason: NotFlatReason) -> Failure {
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
pub(super) fn boundary_subsegments(
    subsegments: &Subsegments,
    index: &SegmentIndex,
    f: &Polygon,
) -> Vec<[VertexId; 2]> {
    let chains = f
        .edges
        .iter()
        .map(|&[a, b]| subsegments.chain_between(index, a, b));
    chains
        .flat_map(|chain| chain.windows(2).map(|w| [w[0], w[1]]).collect::<Vec<_>>())
        .collect()
}

fn count_shims<P: PointStore>(mesh: &TetMesh, sides: &Sides<P>, tets: &[TetId]) -> u64 {
    let is_shim = |&&t: &&TetId| mesh.vertices(t).iter().all(|&v| sides.of(v) == Side::On);
    tets.iter().filter(is_shim).count() as u64
}
