//! One call for users: a PLC and options in; a mesh with a report and notes out, or an error that says who is to blame.

use super::early_check::{EarlyCheck, Verdict};
use super::mesh_error::MeshError;
use super::{Options, run};
use crate::error::{DomainError, Failure};
use crate::exchange::{ExportedMesh, Note, NoteCode, Plc, Precision, PrecisionChoice};
use crate::mesh::VertexId;
use crate::plc::{FlatnessRule, MergeCounts, VertexName};
use crate::predicate::Steiner;
use crate::recover::polygons::{FlipOrder, Insertion};
use crate::recover::segments::GoOn;
use crate::repair::{Welding, divide};
use crate::report::Report;

/// What the user chooses for [`mesh`].
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct MeshOptions {
    /// How polygons are inserted.
    pub insertion: Insertion,
    /// Keep everything in the convex hull of the vertices, instead of what the facets enclose. Hole points are
    /// ignored then.
    pub keep_hull: bool,
    /// Merge facets that are exactly coplanar, adjacent and equally marked into one polygon, so that their common edges
    /// are not constrained.
    pub merge_coplanar: bool,
    /// How far coordinates may be from what was meant. Adjacent facets with equal markers that are coplanar to this
    /// precision are merged as exactly coplanar ones are; facets may be as far from flat.
    pub precision: PrecisionChoice,
    /// Merge adjacent facets with equal markers that meet at this angle or more, too, in degrees: TetGen does so at
    /// 179.9.
    pub merge_angle: Option<f64>,
    /// Divide facets that are not flat into triangles, however far from flat they are. Without that, those are divided
    /// that are off their plane by a thousandth of their diameter at most, unless the precision is exact.
    pub divide: bool,
    /// How Steiner points are represented.
    pub steiner: SteinerChoice,
    /// Leave vertices out that no tetrahedron has, and number the others anew.
    pub drop_unused: bool,
    /// Repair nothing: refuse inputs of which parts intersect, or are degenerate, in ways that [`crate::repair`] mends.
    pub strict: bool,
}

/// How Steiner points are represented.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum SteinerChoice {
    /// Rounded; exact if that has no solution.
    #[default]
    Auto,
    /// As doubles: segments and polygons with Steiner points are straight and flat up to rounding (paper).
    Rounded,
    /// Exactly: straight and flat; rounded only on output.
    Exact,
}

impl Default for MeshOptions {
    fn default() -> MeshOptions {
        MeshOptions::DEFAULT
    }
}

impl MeshOptions {
    /// What is usual.
    pub const DEFAULT: MeshOptions = MeshOptions {
        insertion: Insertion::Flip(FlipOrder::FILTERED),
        keep_hull: false,
        merge_coplanar: true,
        precision: PrecisionChoice::Auto,
        merge_angle: None,
        divide: false,
        steiner: SteinerChoice::Auto,
        drop_unused: false,
        strict: false,
    };

    fn with(&self, steiner: Steiner) -> Options {
        Options {
            insertion: self.insertion,
            keep_hull: self.keep_hull,
            merge_coplanar: self.merge_coplanar,
            steiner,
        }
    }
}

/// A mesh, and what there is to say about it.
#[derive(Clone, Debug)]
pub struct Meshed {
    /// The tetrahedra, the faces on facets, the edges on segments.
    pub mesh: ExportedMesh,
    /// Counts, seconds, and notes.
    pub report: Report,
}

impl Meshed {
    /// What was forgiven, assumed, dropped or ignored.
    pub fn notes(&self) -> &[Note] {
        &self.report.notes
    }
}

/// The CDT of a PLC: what its facets enclose, without the parts that hold a hole point.
///
/// An input of which parts intersect is repaired where that is possible exactly ([`crate::repair`], with notes),
/// unless it is to be [strict](MeshOptions::strict); otherwise it is refused. It is looked at closely only where a
/// run fails or needs many Steiner points: a run that succeeds has found out on its way that the input is valid, up
/// to the rounding of Steiner points.
///
/// Steiner points on segments are doubles if that has a solution, otherwise exact ([`SteinerChoice::Auto`], with a
/// note). Before that is tried, and before anything is said of a failure, the input is checked for intersections, so
/// that these are named and nobody believes that the algorithm gave up on a valid input.
///
/// ```
/// # use tetflip::{cdt::MeshOptions, exchange::{Facet, Plc}, mesh::VertexId};
/// let vertices = vec![[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [0., 0., 1.]];
/// let facet = |corners: [u32; 3]| Facet { polygons: vec![corners.map(VertexId).to_vec()], ..Facet::default() };
/// let mut facets = vec![facet([0, 2, 1]), facet([0, 1, 3]), facet([1, 2, 3])];
///
/// // A face is missing.
/// let open = Plc { vertices: vertices.clone(), facets: facets.clone(), ..Plc::default() };
/// let error = tetflip::mesh(&open, &MeshOptions::default()).expect_err("it is open");
/// assert!(error.is_of_input());
/// assert!(error.to_string().contains("3 edges"));
///
/// facets.push(facet([2, 0, 3]));
/// let closed = Plc { vertices, facets, ..Plc::default() };
/// let meshed = tetflip::mesh(&closed, &MeshOptions::default())?;
/// assert_eq!(meshed.mesh.tets.len(), 1);
/// assert!(meshed.notes().is_empty());
/// # Ok::<(), tetflip::cdt::MeshError>(())
/// ```
///
/// # Errors
/// [`MeshError`]: what is wrong with the input, or that the algorithm gave up. There is no partial mesh.
pub fn mesh(plc: &Plc, options: &MeshOptions) -> Result<Meshed, MeshError> {
    mesh_with_progress(plc, options, &mut |_| {})
}

/// [`mesh`], with somebody who is told how many polygons are done.
///
/// # Errors
/// The same.
pub fn mesh_with_progress(
    plc: &Plc,
    options: &MeshOptions,
    progress: &mut dyn FnMut(usize),
) -> Result<Meshed, MeshError> {
    let precision = options.precision.of(&plc.vertices);
    let mut welding = Welding::of(plc, precision.delta);
    let mut result = mesh_divided(
        plc,
        welding.plc.as_ref().unwrap_or(plc),
        options,
        precision,
        progress,
    );
    if result.is_err() && welding.plc.is_some() {
        // What has been welded may have come too close to other parts.
        welding.give_up();
        result = mesh_divided(plc, plc, options, precision, progress);
    }
    if let Ok(meshed) = &mut result {
        meshed
            .report
            .notes
            .extend(welding.notes(plc, precision.delta));
    }
    let report = match &mut result {
        Ok(meshed) => &mut meshed.report,
        Err(error) => &mut *error.report,
    };
    report.precision = precision;
    report.welded_vertices = welding.welded.iter().map(|c| c.len() - 1).sum();
    result
}

/// The most that a facet may be off its plane, as a part of its diameter, to be divided without being asked for it.
const DIVIDED: f64 = 1e-3;

/// The mesh of an input, or of one with vertices welded, with facets divided that are not flat.
fn mesh_divided(
    original: &Plc,
    plc: &Plc,
    options: &MeshOptions,
    precision: Precision,
    progress: &mut dyn FnMut(usize),
) -> Result<Meshed, MeshError> {
    let most = match (options.divide, options.precision) {
        (true, _) => f64::INFINITY,
        (false, PrecisionChoice::Exact) => 0.0,
        (false, _) => DIVIDED,
    };
    let divided = match options.strict || most == 0.0 {
        true => None,
        false => divide(plc, precision.delta, most),
    };
    let Some((divided, note)) = divided else {
        return mesh_to(original, plc, options, precision, progress);
    };
    let mut result = mesh_to(original, &divided, options, precision, progress);
    let report = match &mut result {
        Ok(meshed) => &mut meshed.report,
        Err(error) => &mut *error.report,
    };
    report.input_facets = original.facets.len();
    report.notes.insert(0, note);
    result
}

/// The mesh of what an input has been made to, with facets merged that are flat to the precision.
fn mesh_to(
    original: &Plc,
    plc: &Plc,
    options: &MeshOptions,
    precision: Precision,
    progress: &mut dyn FnMut(usize),
) -> Result<Meshed, MeshError> {
    let rule = FlatnessRule {
        merge_angle: options.merge_angle,
        ..FlatnessRule::of(precision)
    };
    let call = |rule| Call {
        options,
        rule,
        original,
        delta: precision.delta,
    };
    let mut result = call(rule).mesh(plc, progress);
    // Facets that are one to the precision of the input may be too close to others, or too hard to insert.
    if let Err(error) = &result
        && error.findings.is_none()
        && error.report.merged_near.polygons > 0
    {
        let (facets, why) = (error.report.merged_near.facets, error.failure.describe(plc));
        result = call(rule.apart()).mesh(plc, progress).map(|mut meshed| {
            let text = format!(
                "{facets} facets are coplanar with others to the precision {precision}, but are left apart: {why}"
            );
            meshed.report.notes.push(Note::new(NoteCode::LeftApart, facets, text));
            meshed
        });
    }
    if let Ok(meshed) = &mut result
        && meshed.report.merged_near.polygons > 0
    {
        let merged = meshed.report.merged_near;
        let text = merged_text(merged, precision, options.merge_angle);
        let note = Note::new(NoteCode::FlatToPrecision, merged.facets, text);
        meshed.report.notes.push(note);
    }
    result
}

/// What has been merged that is not exactly coplanar, in words.
fn merged_text(merged: MergeCounts, precision: Precision, angle: Option<f64>) -> String {
    let MergeCounts {
        polygons,
        facets,
        left_apart,
        ..
    } = merged;
    let by_angle = angle.map_or(String::new(), |angle| {
        format!(", or within {} degrees of it", 180.0 - angle)
    });
    let apart = match left_apart {
        0 => String::new(),
        n => format!("; {n} more such groups make no polygon and are left apart"),
    };
    format!(
        "{facets} facets become {polygons} polygons: each group is on one plane to the precision {precision}{by_angle}\
         {apart}; --precision exact keeps them apart"
    )
}

/// How a run ends, and its report.
type Outcome = (Result<ExportedMesh, Failure>, Report);

/// One call, with all that is decided.
struct Call<'a> {
    options: &'a MeshOptions,
    rule: FlatnessRule,
    /// The input as it was given.
    original: &'a Plc,
    /// The precision of the input.
    delta: f64,
}

impl Call<'_> {
    /// The mesh, of the input or of what it is repaired to.
    fn mesh(&self, plc: &Plc, progress: &mut dyn FnMut(usize)) -> Result<Meshed, MeshError> {
        let options = self.options;
        let early = EarlyCheck::new(plc, options, self.delta);
        let (result, report) = self.attempt(plc, first_choice(options), progress, &|needed| {
            early.go_on(needed)
        });
        // What is wrong with the input comes before anything that the algorithm can say.
        if let Err(failure) = &result
            && may_be_of_input(failure)
        {
            match early.verdict() {
                Verdict::Valid => {}
                Verdict::Repaired(repaired, notes) => {
                    return self.mesh_repaired(&repaired, notes, progress);
                }
                Verdict::Wrong(findings) => {
                    let failure = failure.clone();
                    return Err(MeshError::of_findings(
                        self.original,
                        failure,
                        findings,
                        report,
                    ));
                }
            }
        }
        self.finish(plc, (result, report), progress)
    }

    /// One run.
    fn attempt(
        &self,
        plc: &Plc,
        steiner: Steiner,
        progress: &mut dyn FnMut(usize),
        go_on: &GoOn<'_>,
    ) -> Outcome {
        let mut report = Report::default();
        let options = self.options.with(steiner);
        let result = run(plc, &options, &self.rule, &mut report, progress, go_on);
        (result, report)
    }

    /// What comes of a run on a valid PLC, which is repeated with exact Steiner points if that is necessary.
    fn finish(
        &self,
        plc: &Plc,
        (mut result, mut report): Outcome,
        progress: &mut dyn FnMut(usize),
    ) -> Result<Meshed, MeshError> {
        // With exact Steiner points nothing is merged that is not exactly coplanar.
        if self.options.steiner == SteinerChoice::Auto
            && report.merged_near.polygons == 0
            && let Some(why) = needs_exact(plc, &result, &report)
        {
            let (again, again_report) = self.attempt(plc, Steiner::Exact, progress, &|_| true);
            if again.is_ok() || result.is_err() {
                let how = if again.is_ok() { "made" } else { "tried" };
                (result, report) = (again, again_report);
                let text = format!("with rounded Steiner points: {why}; {how} with exact ones");
                let note = Note::new(NoteCode::ExactSteiner, 1, text);
                report.notes.insert(0, note);
            }
        }
        match result {
            Ok(mut mesh) => {
                let note = number(plc, self.options.drop_unused, &mut mesh);
                report.notes.extend(note);
                Ok(Meshed { mesh, report })
            }
            Err(failure) => Err(MeshError::new(plc, failure, report)),
        }
    }

    /// The mesh of a PLC that another one was repaired to, with notes.
    fn mesh_repaired(
        &self,
        repaired: &Plc,
        notes: Vec<Note>,
        progress: &mut dyn FnMut(usize),
    ) -> Result<Meshed, MeshError> {
        let steiner = first_choice(self.options);
        let outcome = self.attempt(repaired, steiner, progress, &|_| true);
        let mut result = self.finish(repaired, outcome, progress);
        let report = match &mut result {
            Ok(Meshed { mesh, report }) => {
                mesh.face_table.add_markers(&self.original.facets);
                report
            }
            Err(error) => &mut *error.report,
        };
        report.input_facets = self.original.facets.len();
        report.notes.splice(0..0, notes);
        result
    }
}

/// How Steiner points are represented at first.
fn first_choice(options: &MeshOptions) -> Steiner {
    match options.steiner {
        SteinerChoice::Auto | SteinerChoice::Rounded => Steiner::Rounded,
        SteinerChoice::Exact => Steiner::Exact,
    }
}

/// Numbers the vertices of the mesh: those of the input first, in their order. Notes if some have other numbers than in
/// the input, where numbers may have gaps.
fn number(plc: &Plc, drop_unused: bool, mesh: &mut ExportedMesh) -> Option<Note> {
    let inputs = plc.vertices.len();
    let kept: Vec<VertexId> = match drop_unused {
        true => mesh.drop_unused(),
        false => (0..inputs).map(VertexId::new).collect(),
    };
    let of_input = kept.iter().take_while(|v| v.index() < inputs).enumerate();
    let numbers: Vec<(i64, VertexId)> = of_input
        .map(|(new, &old)| (VertexName::new(plc, old).number, VertexId::new(new)))
        .collect();
    let in_mesh = |v: VertexId| i64::from(mesh.first_index) + i64::from(v.0);
    let changed = numbers.iter().filter(|&&(old, new)| old != in_mesh(new));
    let changed = changed.count();
    let dropped = inputs - numbers.len();
    if changed == 0 && dropped == 0 {
        return None;
    }
    mesh.renumbered = numbers;
    let text = format!(
        "{changed} vertices have other numbers in the mesh than in the input, and {dropped} are left out, as no \
         tetrahedron has them; NAME.map holds old and new numbers"
    );
    Some(Note::new(NoteCode::Renumbered, changed, text))
}

/// Why exact Steiner points are to be tried.
fn needs_exact(
    plc: &Plc,
    result: &Result<ExportedMesh, Failure>,
    report: &Report,
) -> Option<String> {
    let left_whole = report.flattening.left_whole;
    match result {
        Err(failure) if failure.is_due_to_rounding() => Some(failure.describe(plc)),
        // Whether such polygons can be inserted may depend on the algorithm; the mesh should not.
        Ok(_) if left_whole > 0 => Some(format!(
            "{left_whole} polygons would need too many points to be cut into flat pieces"
        )),
        _ => None,
    }
}

/// Whether facets that intersect, or are degenerate, can be the reason.
fn may_be_of_input(failure: &Failure) -> bool {
    match failure {
        Failure::Plc(_) | Failure::Invalid(_) | Failure::GaveUp(_) | Failure::Stopped => true,
        // A surface may be closed as soon as its edges are divided where vertices lie on them.
        Failure::Domain(DomainError::Open { .. } | DomainError::NothingEnclosed) => true,
        // All else is asked only where polygons meet like those of a PLC.
        Failure::Domain(_) | Failure::Delaunay(_) | Failure::NoSuchPolygon(_) => false,
    }
}
