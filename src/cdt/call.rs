//! One call for users: a PLC and options in; a mesh with a report and notes out, or an error that says who is to blame.

use super::early_check::EarlyCheck;
use super::{Options, run};
use crate::check::{Findings, check};
use crate::error::Failure;
use crate::exchange::{ExportedMesh, Note, NoteCode, Plc};
use crate::mesh::VertexId;
use crate::plc::VertexName;
use crate::predicate::Steiner;
use crate::recover::polygons::{FlipOrder, Insertion};
use crate::report::Report;
use std::fmt;

/// What the user chooses for [`mesh`].
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct MeshOptions {
    /// How polygons are inserted.
    pub insertion: Insertion,
    /// Keep everything in the convex hull of the vertices, instead of what the facets enclose. Hole points are
    /// ignored then.
    pub keep_hull: bool,
    /// Merge facets that are exactly coplanar, adjacent and equally marked into one polygon, so that their common edges
    /// are not constrained.
    pub merge_coplanar: bool,
    /// How Steiner points are represented.
    pub steiner: SteinerChoice,
    /// Leave vertices out that no tetrahedron has, and number the others anew.
    pub drop_unused: bool,
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
        MeshOptions {
            insertion: Insertion::Flip(FlipOrder::FILTERED),
            keep_hull: false,
            merge_coplanar: true,
            steiner: SteinerChoice::Auto,
            drop_unused: false,
        }
    }
}

impl MeshOptions {
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

/// Why [`mesh`] made no mesh. It displays with vertices, facets and points as the input numbers them.
#[derive(Clone, Debug)]
pub struct MeshError {
    /// What stopped the run.
    pub failure: Box<Failure>,
    /// The first things that [`check`] finds wrong with the input, if it was asked and found any. Then these are the
    /// reason, whatever the algorithm ran into.
    pub findings: Option<Box<Findings>>,
    /// The report as far as the run came.
    pub report: Box<Report>,
    message: String,
}

impl MeshError {
    /// How many findings are listed.
    const LISTED: usize = 8;

    fn new(plc: &Plc, failure: Failure, report: Report) -> MeshError {
        MeshError {
            message: failure.describe(plc),
            failure: Box::new(failure),
            findings: None,
            report: Box::new(report),
        }
    }

    /// An error of an input that is not valid: whatever the algorithm ran into, the input is to blame, and the check
    /// names facets more closely.
    fn of_findings(plc: &Plc, failure: Failure, findings: Findings, report: Report) -> MeshError {
        let message = match &failure {
            Failure::Plc(_) => {
                let mut lines = vec![failure.describe(plc)];
                lines.extend(listed(plc, &findings, &lines[0]));
                lines.join("\n")
            }
            // What the algorithm ran into first may depend on when the check was done.
            _ => format!("invalid PLC: {}", listed(plc, &findings, "").join("\n")),
        };
        MeshError {
            failure: Box::new(failure),
            findings: Some(Box::new(findings)),
            report: Box::new(report),
            message,
        }
    }

    /// Whether the input is to blame, and not the algorithm.
    pub fn is_of_input(&self) -> bool {
        self.findings.is_some() || self.failure.is_of_input()
    }
}

impl fmt::Display for MeshError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for MeshError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        Some(&*self.failure)
    }
}

/// The CDT of a PLC: what its facets enclose, without the parts that hold a hole point.
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
    let early = EarlyCheck::new(plc, MeshError::LISTED);
    let go_on = |needed: usize| early.go_on(needed);
    let mut run = |steiner: Steiner| {
        let mut report = Report::default();
        let result = run(plc, &options.with(steiner), &mut report, progress, &go_on);
        (result, report)
    };
    let first = match options.steiner {
        SteinerChoice::Auto | SteinerChoice::Rounded => Steiner::Rounded,
        SteinerChoice::Exact => Steiner::Exact,
    };
    let (mut result, mut report) = run(first);
    if let Err(failure) = &result
        && may_be_intersections(failure)
    {
        // Where parts of the input intersect, exact Steiner points cannot help either.
        let early = early.findings();
        let findings = early.unwrap_or_else(|| check(plc, Some(MeshError::LISTED)));
        if !findings.is_valid() {
            let failure = failure.clone();
            return Err(MeshError::of_findings(plc, failure, findings, report));
        }
    }
    if options.steiner == SteinerChoice::Auto
        && let Some(why) = needs_exact(plc, &result, &report)
    {
        let (again, again_report) = run(Steiner::Exact);
        if again.is_ok() || result.is_err() {
            (result, report) = (again, again_report);
            let text = format!("with rounded Steiner points: {why}; made with exact ones");
            report
                .notes
                .insert(0, Note::new(NoteCode::ExactSteiner, 1, text));
        }
    }
    match result {
        Ok(mut mesh) => {
            report
                .notes
                .extend(number(plc, options.drop_unused, &mut mesh));
            Ok(Meshed { mesh, report })
        }
        Err(failure) => Err(MeshError::new(plc, failure, report)),
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

/// Whether facets that intersect can be the reason.
fn may_be_intersections(failure: &Failure) -> bool {
    match failure {
        Failure::Plc(_) | Failure::Invalid(_) | Failure::GaveUp(_) | Failure::Stopped => true,
        // What is inside is asked only where polygons meet like those of a PLC.
        Failure::Domain(_) | Failure::Delaunay(_) | Failure::NoSuchPolygon(_) => false,
    }
}

/// What was found, one line each, without what has been `told` already.
fn listed(plc: &Plc, findings: &Findings, told: &str) -> Vec<String> {
    let errors = findings.errors.iter().map(ToString::to_string);
    let conflicts = findings.conflicts.iter().map(|c| c.describe(plc));
    let mut lines: Vec<String> = errors
        .chain(conflicts)
        .filter(|line| told.is_empty() || !told.ends_with(line))
        .collect();
    if lines.len() > MeshError::LISTED || findings.stopped {
        lines.truncate(MeshError::LISTED);
        lines.push("…".to_owned());
    }
    lines
}
