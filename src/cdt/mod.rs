//! The pipeline: a PLC in, its CDT out, one call per phase.
//!
//! ```text
//! Plc ─ Complex::new ─ delaunay ─ recover_segments ─ insert_polygons ─ export ─ ExportedMesh
//! ```

mod call;
mod early_check;
mod export;
mod inside;
mod interpolation;
mod mesh_error;
mod open;

pub mod flips;

pub use crate::exchange::{Precision, PrecisionChoice};
#[doc(hidden)]
pub use crate::plc::FlatnessRule;
pub use crate::predicate::Steiner;
pub use crate::recover::polygons::Insertion;
pub use crate::update::DeletionCounts;
pub use call::{MeshOptions, Meshed, SteinerChoice, mesh, mesh_with_progress};
pub use mesh_error::MeshError;

use crate::clock::TaskSeconds;
use crate::delaunay::{Delaunay, delaunay, delaunay_by};
use crate::error::{DeletionRefused, Failure};
use crate::exchange::ExportedMesh;
use crate::exchange::Plc;
use crate::mesh::{TetMesh, VertexId};
use crate::plc::{Complex, PlcError};
use crate::predicate::{DoublePoints, PointStore};
use crate::recover::flatten::flatten;
use crate::recover::flips::{FlipObserver, FlipRegion};
use crate::recover::polygons::{FlipOrder, PolygonCounts, PolygonInsertion, try_whole};
use crate::recover::segments::{GoOn, Subsegments, recover_segments};
use crate::recover::workspace::{ConstrainedMesh, EdgeProtectedPlc};
use crate::report::{Phase, Report};
use crate::update::PolygonDeletion;
use open::encloses_nothing;
use std::cell::OnceCell;
use std::sync::Arc;

/// What the user chooses.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Options {
    /// How polygons are inserted.
    pub insertion: Insertion,
    /// Keep everything in the convex hull of the vertices, instead of what the facets enclose.
    pub keep_hull: bool,
    /// Merge facets that are exactly coplanar, adjacent and equally marked into one polygon, so that their common edges
    /// are not constrained.
    pub merge_coplanar: bool,
    /// How Steiner points are represented.
    pub steiner: Steiner,
}

impl Default for Options {
    fn default() -> Options {
        Options {
            insertion: Insertion::Flip(FlipOrder::FILTERED),
            keep_hull: false,
            merge_coplanar: true,
            steiner: Steiner::Rounded,
        }
    }
}

/// A tetrahedralization of the convex hull of a PLC's vertices in which all segments, and those polygons that have been
/// inserted, are unions of edges and triangles, and everything else is Delaunay as far as they allow.
///
/// Polygons are inserted all at once ([`Cdt::insert_polygons`]) or one by one ([`Cdt::insert_polygon`]), and deleted
/// ([`Cdt::delete_polygon`]), in any order: which are there alone determines the tetrahedra, if they are exactly flat.
#[derive(Clone, Debug)]
pub struct Cdt {
    complex: Arc<Complex>,
    /// The complex with its Steiner points, and its polygons in pieces.
    plc: EdgeProtectedPlc<DoublePoints>,
    /// Its tetrahedralization.
    cdt: ConstrainedMesh,
}

impl Cdt {
    /// The first phases: the checked complex, the Delaunay tetrahedralization of its vertices, and Steiner points until
    /// all segments are there (paper §2). Steiner points are rounded to doubles.
    ///
    /// # Errors
    /// [`Failure`], naming the vertices, segments or facets.
    pub fn with_segments(
        plc: &Plc,
        merge_coplanar: bool,
        report: &mut Report,
    ) -> Result<Self, Failure> {
        let options = Options {
            merge_coplanar,
            ..Options::default()
        };
        Cdt::begin(plc, &options, report)
    }

    /// The same with Steiner points as `options` say. If they are exact, polygons of the input that are flat only to
    /// rounding are divided into triangles first, so that everything is exactly flat and stays so.
    ///
    /// # Errors
    /// [`Failure`], naming the vertices, segments or facets.
    pub fn begin(plc: &Plc, options: &Options, report: &mut Report) -> Result<Self, Failure> {
        Cdt::begin_watched(plc, options, &FlatnessRule::EXACT, report, &|_| true, false)
    }

    /// [`Cdt::begin`], with somebody who is told how many Steiner points will be needed at least, and may stop the run.
    /// If the polygons `must_enclose` something, and it is clear that they do not, no Steiner points are searched for.
    fn begin_watched(
        plc: &Plc,
        options: &Options,
        rule: &FlatnessRule,
        report: &mut Report,
        go_on: &GoOn<'_>,
        must_enclose: bool,
    ) -> Result<Self, Failure> {
        report.steiner = options.steiner;
        report.input_vertices = plc.vertices.len();
        report.input_facets = plc.facets.len();
        let complex = report.time(Phase::Complex, |report| {
            // What is not exactly flat would be divided again.
            let rule = match options.steiner {
                Steiner::Rounded => *rule,
                Steiner::Exact => rule.apart(),
            };
            let (mut complex, merged) = Complex::flat_to(plc, options.merge_coplanar, &rule)?;
            report.merged_near = merged;
            if options.steiner == Steiner::Exact {
                report.triangulated_polygons = complex.triangulate_not_flat(plc)?;
            }
            Ok::<_, PlcError>(Arc::new(complex))
        })?;
        report.segments = complex.segments.len();
        report.polygons = complex.polygons.len();
        let mut points = DoublePoints::new(plc.vertices.clone()).with_steiner(options.steiner);
        let distinct: Vec<VertexId> = (0..points.len())
            .map(VertexId::new)
            .filter(|&v| complex.representative[v.index()] == v)
            .collect();
        report.duplicate_vertices = points.len() - distinct.len();
        // What flips in a rounded order do may depend on how the tetrahedra are stored, and that on the number of
        // threads.
        let rounded = matches!(options.insertion, Insertion::Flip(times) if !times.is_exact());
        let mut delaunay = report.time(Phase::Delaunay, |_| {
            if rounded {
                delaunay_by(&points, &distinct, 1)
            } else {
                delaunay(&points, &distinct)
            }
        })?;
        report.delaunay_tets = delaunay.mesh.finite().count();
        let nothing = OnceCell::new();
        let watch = |needed: usize| {
            let nothing =
                nothing.get_or_init(|| encloses_nothing(&complex).filter(|_| must_enclose));
            nothing.is_none() && go_on(needed)
        };
        let recovered = report.time(Phase::Segments, |_| {
            recover_segments(&complex, &mut points, &mut delaunay, &watch)
        });
        if let Some(error) = nothing.into_inner().flatten() {
            return Err(error.into());
        }
        report.steiner_points = points.len() - plc.vertices.len();
        report.steiner_not_doubles = points.count_not_double();
        let (mut subsegments, mut incidence) = recovered?;
        report.steiner_points_on_segment = subsegments.count_exact(&points);
        // What an exact input needs is done as it always was.
        let is_rounded = rule.delta > 0.0;
        let try_whole = |points: &DoublePoints, delaunay: &Delaunay, (s, i): (&_, &_), pieces| {
            let plc = EdgeProtectedPlc {
                points: points.clone(),
                subsegments: Subsegments::clone(s),
                pieces,
            };
            try_whole(plc, &delaunay.mesh, i, must_enclose)
        };
        let pieces = report.time(Phase::Flattening, |report| {
            flatten(
                &complex,
                &mut points,
                &mut delaunay,
                &mut subsegments,
                &mut incidence,
                (
                    is_rounded.then_some(&try_whole as _),
                    &mut report.flattening,
                ),
                go_on,
            )
        })?;
        report.steiner_points = points.len() - plc.vertices.len();
        let polygons = pieces.complex.polygons.len();
        Ok(Cdt {
            cdt: ConstrainedMesh::new(delaunay.mesh, incidence, polygons),
            plc: EdgeProtectedPlc {
                points,
                subsegments,
                pieces,
            },
            complex,
        })
    }

    /// The vertices: those of the input, then Steiner points.
    pub fn points(&self) -> &DoublePoints {
        &self.plc.points
    }

    /// The tetrahedra, ghosts included.
    pub fn mesh(&self) -> &TetMesh {
        &self.cdt.mesh
    }

    /// Inserts all polygons of the complex (paper §3) that are not in the mesh. `progress` is told how many are done.
    ///
    /// # Errors
    /// The first polygon that cannot be inserted, and why.
    pub fn insert_polygons(
        &mut self,
        insertion: Insertion,
        report: &mut Report,
        progress: &mut dyn FnMut(usize),
    ) -> Result<PolygonCounts, Failure> {
        self.insert_polygons_observed(insertion, report, progress, None)
    }

    /// [`Cdt::insert_polygons`], with somebody who is told about every flip.
    ///
    /// # Errors
    /// The same.
    pub fn insert_polygons_observed<'a>(
        &'a mut self,
        insertion: Insertion,
        report: &mut Report,
        progress: &mut dyn FnMut(usize),
        observer: Option<&'a mut dyn FlipObserver>,
    ) -> Result<PolygonCounts, Failure> {
        // Progress is told in polygons of the complex.
        let pieces = self.plc.pieces.clone_firsts();
        let cut = (0..self.complex.polygons.len()).filter(|&f| self.plc.pieces.is_cut(f));
        let not_flat = cut.count() as u64;
        self.insert(Ok(insertion), not_flat, report, observer, |polygons| {
            polygons.insert_all(&mut |done| {
                progress(pieces.partition_point(|&first| first <= done) - 1)
            })
        })
    }

    /// [`Cdt::insert_polygons`] by flips in numbers of the caller's own
    /// ([`FlipNumbers`](crate::recover::flips::FlipNumbers)). The report names no insertion then.
    ///
    /// # Errors
    /// The same.
    pub fn insert_polygons_in<'a>(
        &'a mut self,
        numbers: &'a dyn FlipRegion<DoublePoints>,
        report: &mut Report,
        observer: Option<&'a mut dyn FlipObserver>,
    ) -> Result<PolygonCounts, Failure> {
        let cut = (0..self.complex.polygons.len()).filter(|&f| self.plc.pieces.is_cut(f));
        let not_flat = cut.count() as u64;
        self.insert(Err(numbers), not_flat, report, observer, |polygons| {
            polygons.insert_all(&mut |_| ())
        })
    }

    /// Inserts polygon `f`, an index in [`Complex::polygons`]; nothing happens if it is in the mesh. The counts, also
    /// those in the report, are of this polygon.
    ///
    /// # Errors
    /// Why it cannot be inserted. Some of its missing regions may have been; what they consist of now stays.
    pub fn insert_polygon(
        &mut self,
        f: usize,
        insertion: Insertion,
        report: &mut Report,
    ) -> Result<PolygonCounts, Failure> {
        if f >= self.complex.polygons.len() {
            return Err(Failure::NoSuchPolygon(f));
        }
        let mut pieces = self.plc.pieces.of(f);
        let not_flat = u64::from(self.plc.pieces.is_cut(f));
        self.insert(Ok(insertion), not_flat, report, None, |polygons| {
            pieces.try_for_each(|piece| polygons.insert(piece))
        })
    }

    /// By an algorithm of the crate, or by flips in numbers of the caller's own.
    fn insert<'a>(
        &'a mut self,
        by: Result<Insertion, &'a dyn FlipRegion<DoublePoints>>,
        not_flat: u64,
        report: &mut Report,
        observer: Option<&'a mut dyn FlipObserver>,
        run: impl FnOnce(&mut PolygonInsertion<DoublePoints>) -> Result<(), Failure>,
    ) -> Result<PolygonCounts, Failure> {
        report.insertion = by.ok();
        report.time(Phase::Polygons, move |report| {
            let mut polygons = match by {
                Ok(insertion) => PolygonInsertion::new(&self.plc, &mut self.cdt, insertion),
                Err(numbers) => PolygonInsertion::by_own_flips(&self.plc, &mut self.cdt, numbers),
            }
            .observed_by(observer);
            let result = run(&mut polygons);
            let mut counts = polygons.counts();
            counts.not_flat = not_flat;
            report.insertion_counts = counts;
            result.map(|()| counts)
        })
    }

    /// From now on, the tasks of polygon insertion are timed ([`Cdt::task_seconds`]), which slows flips down a little.
    pub fn time_tasks(&mut self) {
        self.cdt.scratch.time_tasks();
    }

    /// The seconds of the tasks since [`Cdt::time_tasks`]; zeros if it was not called.
    pub fn task_seconds(&self) -> TaskSeconds {
        self.cdt.scratch.task_seconds()
    }

    /// Deletes polygon `f`, an index in [`Complex::polygons`], from the mesh, which becomes what it would be if `f` had
    /// never been inserted. Its segments stay. [`Cdt::export`] then does not know the polygon: its triangles are no
    /// faces of the mesh, and it bounds nothing.
    ///
    /// Bistellar flips in exact order, those of the insertion backwards (Shewchuk 2003): the time depends on the part
    /// of the mesh that changes, not on its size. A polygon that is exactly flat, with the Steiner points on its
    /// boundary, can always be deleted.
    ///
    /// ```
    /// # use tetflip::cdt::{Cdt, Insertion, flips::FlipOrder};
    /// # use tetflip::{error::DeletionRefused, exchange::{Facet, Plc}, mesh::VertexId, report::Report};
    /// // A triangle, and a pair of vertices whose common edge passes through it.
    /// let vertices = vec![[0., 0., 0.], [9., 0., 0.], [0., 9., 0.], [2., 2., 1.], [2., 2., -1.]];
    /// let triangle = [0, 1, 2].map(VertexId).to_vec();
    /// let facets = vec![Facet { polygons: vec![triangle], ..Facet::default() }];
    /// let plc = Plc { vertices, facets, ..Plc::default() };
    ///
    /// let mut report = Report::default();
    /// let mut cdt = Cdt::with_segments(&plc, true, &mut report)?;
    /// assert_eq!(cdt.mesh().finite().count(), 3);
    /// let f = cdt.polygon_of_facet(0).expect("facet 0 has an area");
    ///
    /// cdt.insert_polygon(f, Insertion::Flip(FlipOrder::FILTERED), &mut report)?;
    /// assert_eq!(cdt.mesh().finite().count(), 2);
    ///
    /// let counts = cdt.delete_polygon(f)?;
    /// assert_eq!(counts.flips.two_three, 1);
    /// assert_eq!(cdt.mesh().finite().count(), 3);
    ///
    /// let again = cdt.delete_polygon(f);
    /// assert_eq!(again, Err(DeletionRefused::NotInserted { facets: vec![0] }));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Why it cannot be deleted. The mesh then has the tetrahedra that it had.
    pub fn delete_polygon(&mut self, f: usize) -> Result<DeletionCounts, DeletionRefused> {
        self.delete_polygon_by(f, FlipOrder::FILTERED)
    }

    /// [`Cdt::delete_polygon`] with a choice of how flip times are represented. With exact ones the result is the same;
    /// rounded ones may be refused where exact ones are not, but do not end in a wrong mesh either: all other
    /// predicates are exact here, whatever `order` says.
    ///
    /// # Errors
    /// The same.
    pub fn delete_polygon_by(
        &mut self,
        f: usize,
        order: FlipOrder,
    ) -> Result<DeletionCounts, DeletionRefused> {
        let polygon = self.complex.polygons.get(f);
        let polygon = polygon.ok_or(DeletionRefused::NoSuchPolygon(f))?;
        if !self.is_inserted(f) {
            let facets = polygon.facets.clone();
            return Err(DeletionRefused::NotInserted { facets });
        }
        let polygons = &self.plc.pieces.complex.polygons;
        let is_flat = polygons[self.plc.pieces.of(f)].iter().all(|p| p.flat);
        // What is flat only to rounding may not fit again.
        let before = (!is_flat).then(|| self.cdt.clone());
        let mut counts = DeletionCounts::default();
        let mut refused = None;
        for piece in self.plc.pieces.of(f) {
            match PolygonDeletion::new(&self.plc, &mut self.cdt).delete(piece, order) {
                Ok(of_piece) => {
                    counts.add(&of_piece);
                    self.cdt.inserted[piece] = false;
                }
                Err(reason) => {
                    refused = Some(reason);
                    break;
                }
            }
        }
        let Some(reason) = refused else {
            return Ok(counts);
        };
        if let Some(before) = before {
            self.cdt = before;
            return Err(reason);
        }
        // What has been deleted of it can be inserted, as it was.
        self.insert_polygon(
            f,
            Insertion::Flip(FlipOrder::FILTERED),
            &mut Report::default(),
        )
        .expect("it was in the mesh");
        Err(reason)
    }

    /// Whether polygon `f` is in the mesh.
    pub fn is_inserted(&self, f: usize) -> bool {
        f < self.complex.polygons.len()
            && self.cdt.inserted[self.plc.pieces.of(f)].iter().all(|&i| i)
    }

    /// The polygon that a facet of the input belongs to, possibly with others that are coplanar; `None` if the facet is
    /// made of segments and vertices only. Linear time.
    pub fn polygon_of_facet(&self, facet: usize) -> Option<usize> {
        let mut polygons = self.complex.polygons.iter();
        polygons.position(|polygon| polygon.facets.contains(&facet))
    }

    /// The checked PLC.
    pub fn complex(&self) -> &Complex {
        &self.complex
    }
}

/// The whole pipeline, once, without the policy of [`mesh`]: failures are as the algorithm runs into them. `report`
/// is filled as far as the run came; `progress` is told how many polygons are done.
///
/// # Errors
/// [`Failure`]; there is no partial mesh.
pub fn tetrahedralize(
    plc: &Plc,
    options: &Options,
    report: &mut Report,
    progress: &mut dyn FnMut(usize),
) -> Result<ExportedMesh, Failure> {
    run(
        plc,
        options,
        &FlatnessRule::EXACT,
        report,
        progress,
        &|_| true,
    )
}

/// [`tetrahedralize`] with a rule for what counts as flat.
///
/// # Errors
/// The same.
#[doc(hidden)]
pub fn tetrahedralize_to(
    plc: &Plc,
    options: &Options,
    rule: &FlatnessRule,
    report: &mut Report,
    progress: &mut dyn FnMut(usize),
) -> Result<ExportedMesh, Failure> {
    run(plc, options, rule, report, progress, &|_| true)
}

/// [`tetrahedralize`], with somebody who may stop the run.
fn run(
    plc: &Plc,
    options: &Options,
    rule: &FlatnessRule,
    report: &mut Report,
    progress: &mut dyn FnMut(usize),
    go_on: &GoOn<'_>,
) -> Result<ExportedMesh, Failure> {
    let must_enclose = !options.keep_hull;
    let mut cdt = Cdt::begin_watched(plc, options, rule, report, go_on, must_enclose)?;
    cdt.insert_polygons(options.insertion, report, progress)?;
    cdt.export(plc, options.keep_hull, report)
}
