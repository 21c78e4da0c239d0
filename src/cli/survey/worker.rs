//! The process of one run: reads a model, checks it or makes a mesh of it and verifies that, and says on its standard
//! output, a JSON value a line, how far it is and what came of it. Whatever happens to it, happens to this run alone.
//!
//! Its standard input is the line to its master: when that closes, because time is over or the master is gone, it ends.

use super::limits::{limit_memory, limit_processor, peak_mib};
use super::method::{Algorithm, Steiner};
use super::tetgen::run_tetgen;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fmt::{self, Write as _};
use std::io::{self, Read, Write as _};
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;
use tetflip::cdt::{FlatnessRule, Options, PrecisionChoice, tetrahedralize_to};
use tetflip::check::check_to;
use tetflip::error::{DomainError, Failure, GaveUp};
use tetflip::exchange::ExportedMesh;
use tetflip::exchange::Plc;
use tetflip::format::{FormatError, read_plc};
use tetflip::lab::fnv1a;
use tetflip::recover::polygons::Insertion;
use tetflip::repair::Welding;
use tetflip::report::Report;
use tetflip::verify::{Domain, Verdict, VerifyOptions, verify};

/// From where on TetGen takes facets for coplanar, in degrees.
const MERGE_ANGLE: f64 = 179.9;
/// After how many intersections of the input the search for more ends.
const CONFLICTS: usize = 1000;
/// How many violations are written out.
const SHOWN: usize = 3;

/// What a run is to do.
#[derive(Clone, Debug)]
pub(super) struct Job<'a> {
    pub algorithm: Algorithm,
    pub steiner: Steiner,
    pub keep_hull: bool,
    pub merge_coplanar: bool,
    pub precision: PrecisionChoice,
    pub verify: bool,
    /// MiB.
    pub memory: u64,
    /// Seconds.
    pub timeout: f64,
    /// The program to compare with, and where it can leave files.
    pub tetgen: &'a Path,
    pub scratch: Option<&'a Path>,
}

/// A line from a worker to its master.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) enum Line {
    /// What it begins to do.
    Stage(String),
    /// What came of it; a later one replaces an earlier one.
    Result(Box<Findings>),
    /// Its memory, when it is told to stop.
    Peak(Option<f64>),
}

/// What a run has found out. Words and counts of the columns of the table.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct Findings {
    pub outcome: String,
    pub kind: String,
    pub message: String,
    pub verified: String,
    pub violations: usize,
    pub defects: String,
    pub vertices: Option<usize>,
    pub facets: Option<usize>,
    pub steiner_points: Option<usize>,
    pub tetrahedra: Option<usize>,
    pub flips: Option<u64>,
    pub regions: Option<usize>,
    pub mesh_hash: Option<u64>,
    pub peak_mib: Option<f64>,
    pub seconds_read: f64,
    pub seconds_mesh: f64,
    pub seconds_verify: Option<f64>,
    /// The report of the library, if it is ours.
    pub report: serde_json::Value,
}

impl Findings {
    pub(super) fn ends(
        &mut self,
        outcome: &str,
        kind: impl Into<String>,
        message: impl Into<String>,
    ) {
        self.outcome = outcome.to_owned();
        self.kind = kind.into();
        self.message = message.into();
    }
}

/// Another program that the worker waits for, so that it can be ended with the worker.
pub(super) type Partner = Arc<tetflip::lab::process::Partner>;

/// The whole process: what came of it is in the lines.
pub(super) fn work(model: &Path, job: &Job) {
    let limits = limit_memory(job.memory);
    // Ten seconds more than the master grants: only for those whom no master ends.
    let limits = limits.and(limit_processor(job.timeout.ceil() as u64 + 10));
    let partner = Partner::default();
    let mut findings = Findings::default();
    if let Err(message) = limits.and_then(|()| watch_master(&partner, job)) {
        findings.ends("error", "Limits", message);
        return send_result(findings, false);
    }
    send(&Line::Stage("reading".to_owned()));
    let start = Instant::now();
    let plc = match read_plc(model) {
        Ok((plc, _)) => plc,
        Err(error) => {
            findings.ends("unreadable", format_kind(&error), error.to_string());
            return send_result(findings, false);
        }
    };
    findings.seconds_read = start.elapsed().as_secs_f64();
    findings.vertices = Some(plc.vertices.len());
    findings.facets = Some(plc.facets.len());
    send(&Line::Stage(
        match job.algorithm {
            Algorithm::Check => "checking",
            _ => "meshing",
        }
        .to_owned(),
    ));
    let mesh = match job.algorithm {
        Algorithm::Check => {
            check_input(&plc, job.precision.of(&plc.vertices).delta, &mut findings);
            None
        }
        Algorithm::Ours(insertion) => ours(&plc, insertion, job, &mut findings),
        Algorithm::TetgenCavity | Algorithm::TetgenFlip => {
            run_tetgen(&plc, job, &partner, &mut findings)
        }
    };
    let foreign = job.algorithm.is_foreign();
    let Some(mesh) = mesh else {
        return send_result(findings, foreign);
    };
    describe(&mesh, &plc, &mut findings);
    if job.verify {
        // Should the verification not end, the mesh has still been made.
        findings.peak_mib = peak_mib(foreign);
        send(&Line::Result(Box::new(findings.clone())));
        send(&Line::Stage("verifying".to_owned()));
        judge(&plc, &mesh, job, &mut findings);
    }
    send_result(findings, foreign)
}

/// Ends the process, its partner and its files as soon as the master closes the line.
fn watch_master(partner: &Partner, job: &Job) -> Result<(), String> {
    let partner = Arc::clone(partner);
    let scratch = job.scratch.map(Path::to_owned);
    let watch = move || {
        let mut byte = [0];
        while matches!(io::stdin().read(&mut byte), Ok(1)) {}
        if let Ok(mut child) = partner.lock()
            && let Some(child) = child.as_mut()
        {
            // It may have ended by itself.
            let _ = child.kill();
            let _ = child.wait();
        }
        if let Some(scratch) = scratch {
            let _ = std::fs::remove_dir_all(scratch);
        }
        send(&Line::Peak(peak_mib(false)));
        std::process::exit(3)
    };
    let thread = std::thread::Builder::new().stack_size(256 << 10);
    thread
        .spawn(watch)
        .map(|_| ())
        .map_err(|error| error.to_string())
}

fn ours(
    plc: &Plc,
    insertion: Insertion,
    job: &Job,
    findings: &mut Findings,
) -> Option<ExportedMesh> {
    let options = Options {
        insertion,
        keep_hull: job.keep_hull,
        merge_coplanar: job.merge_coplanar,
        steiner: match job.steiner {
            Steiner::Rounded => tetflip::predicate::Steiner::Rounded,
            Steiner::Exact => tetflip::predicate::Steiner::Exact,
        },
    };
    let mut report = Report::default();
    let mut inserting = false;
    let start = Instant::now();
    let precision = job.precision.of(&plc.vertices);
    let rule = FlatnessRule::of(precision);
    let welding = Welding::of(plc, precision.delta);
    let welded = welding.plc.as_ref().unwrap_or(plc);
    let mut progress = |_| {
        if !inserting {
            send(&Line::Stage("inserting polygons".to_owned()));
            inserting = true;
        }
    };
    let mut result = tetrahedralize_to(welded, &options, &rule, &mut report, &mut progress);
    if result.is_err() && report.merged_near.polygons > 0 {
        report = Report::default();
        result = tetrahedralize_to(welded, &options, &rule.apart(), &mut report, &mut progress);
    }
    report.precision = precision;
    report.welded_vertices = welding.welded.iter().map(|c| c.len() - 1).sum();
    findings.seconds_mesh = start.elapsed().as_secs_f64();
    findings.steiner_points = Some(report.steiner_points);
    findings.flips = Some(report.insertion_counts.flips.flips());
    findings.report = serde_json::to_value(&report).expect("a report is JSON");
    match result {
        Ok(mesh) => {
            findings.ends("ok", "", "");
            Some(mesh)
        }
        Err(failure) => {
            let (outcome, kind) = failure_words(&failure);
            findings.ends(outcome, kind, failure.describe(plc));
            None
        }
    }
}

/// Finds the intersections of the input: the first is the message, all are counted, up to [`CONFLICTS`].
fn check_input(plc: &Plc, delta: f64, findings: &mut Findings) {
    let start = Instant::now();
    let found = check_to(plc, Some(CONFLICTS), delta);
    findings.seconds_mesh = start.elapsed().as_secs_f64();
    findings.violations = found.errors.len() + found.conflicts.len();
    let first_error = found.errors.first().map(|e| (variant(e), e.to_string()));
    let first_conflict = || {
        let conflict = found.conflicts.first()?;
        Some((variant(&conflict.kind), conflict.describe(plc)))
    };
    match first_error.or_else(first_conflict) {
        Some((kind, message)) => findings.ends("invalid", kind, message),
        None => findings.ends("ok", "", ""),
    }
    let mut kinds: BTreeMap<String, usize> = BTreeMap::new();
    let errors = found.errors.iter().map(variant);
    for kind in errors.chain(found.conflicts.iter().map(|c| variant(&c.kind))) {
        *kinds.entry(kind).or_default() += 1;
    }
    findings.defects = list(kinds);
}

/// Each kind with its number.
fn list(kinds: impl IntoIterator<Item = (impl fmt::Display, usize)>) -> String {
    let kinds = kinds.into_iter().map(|(kind, n)| format!("{kind}: {n}"));
    kinds.collect::<Vec<_>>().join("; ")
}

fn describe(mesh: &ExportedMesh, plc: &Plc, findings: &mut Findings) {
    findings.tetrahedra = Some(mesh.tets.len());
    let more = mesh.vertices.len().saturating_sub(plc.vertices.len());
    findings.steiner_points = findings.steiner_points.or(Some(more));
    let mut regions: Vec<u64> = mesh.regions.iter().map(|r| r.to_bits()).collect();
    regions.sort_unstable();
    regions.dedup();
    findings.regions = Some(regions.len());
    // What the .ele file holds.
    let corners = mesh.tets.iter().flatten().flat_map(|v| v.0.to_le_bytes());
    let attributes = mesh.regions.iter().flat_map(|r| r.to_bits().to_le_bytes());
    findings.mesh_hash = Some(fnv1a(corners.chain(attributes)));
}

fn judge(plc: &Plc, mesh: &ExportedMesh, job: &Job, findings: &mut Findings) {
    let start = Instant::now();
    let mut options = VerifyOptions {
        domain: if job.keep_hull {
            Domain::Hull
        } else {
            Domain::Inside
        },
        precision: job.precision.of(&plc.vertices).delta,
        cap: SHOWN,
        ..VerifyOptions::default()
    };
    if job.steiner == Steiner::Exact {
        options.tolerance = 0.0;
    }
    let mut verdict = verify(plc, mesh, options);
    findings.verified = if verdict.is_ok() { "yes" } else { "no" }.to_owned();
    if !verdict.is_ok() && job.algorithm.is_foreign() {
        options.merge_angle = Some(MERGE_ANGLE);
        let merged = verify(plc, mesh, options);
        if merged.is_ok() {
            findings.verified = "merged".to_owned();
            verdict = merged;
        }
    }
    findings.seconds_verify = Some(start.elapsed().as_secs_f64());
    if !verdict.is_ok() {
        let message = first_violations(&verdict);
        findings.ends("refused", "Verifier", message);
    }
    findings.violations = verdict.totals.values().sum();
    let kinds = verdict
        .totals
        .iter()
        .map(|(kind, n)| format!("{kind}: {n}"));
    findings.defects = kinds.collect::<Vec<_>>().join("; ");
}

fn first_violations(verdict: &Verdict) -> String {
    let shown = verdict.violations.iter().take(SHOWN);
    shown
        .map(ToString::to_string)
        .collect::<Vec<_>>()
        .join("; ")
}

/// The outcome, and the name of the error's variant.
fn failure_words(failure: &Failure) -> (&'static str, String) {
    match failure {
        Failure::Delaunay(error) => ("degenerate", variant(error)),
        Failure::Plc(error) => ("invalid", variant(error)),
        Failure::Invalid(error) => ("invalid", variant(error)),
        Failure::Domain(error @ (DomainError::Open { .. } | DomainError::NothingEnclosed)) => {
            ("open", variant(error))
        }
        Failure::Domain(error) => ("invalid", variant(error)),
        Failure::GaveUp(GaveUp::NotFlat { reason, .. }) => {
            ("gave up", format!("NotFlat{}", variant(reason)))
        }
        Failure::GaveUp(error) => ("gave up", variant(error)),
        other => ("error", variant(other)),
    }
}

fn format_kind(error: &FormatError) -> String {
    match error {
        FormatError::Malformed { reason, .. } => variant(reason),
        other => variant(other),
    }
}

/// The name of an enum's variant: the first word of its debug output. The rest may be a whole region, and is not made.
fn variant(value: &impl fmt::Debug) -> String {
    struct FirstWord(String);
    impl fmt::Write for FirstWord {
        fn write_str(&mut self, text: &str) -> fmt::Result {
            for letter in text.chars() {
                if !letter.is_ascii_alphanumeric() {
                    return Err(fmt::Error);
                }
                self.0.push(letter);
            }
            Ok(())
        }
    }
    let mut word = FirstWord(String::new());
    // The error is how it ends early.
    let _ = write!(word, "{value:?}");
    word.0
}

fn send_result(mut findings: Findings, foreign: bool) {
    if findings.peak_mib.is_none() || !foreign {
        findings.peak_mib = peak_mib(foreign);
    }
    send(&Line::Result(Box::new(findings)));
}

fn send(line: &Line) {
    let mut text = serde_json::to_string(line).expect("plain words and numbers");
    text.push('\n');
    let mut out = io::stdout().lock();
    // Without a master nobody listens.
    let _ = out.write_all(text.as_bytes()).and_then(|()| out.flush());
}

#[cfg(test)]
mod tests {
    use super::*;
    use tetflip::error::InvalidPlc;
    use tetflip::mesh::VertexId;

    #[test]
    fn kinds_are_the_names_of_variants() {
        let failure = Failure::from(InvalidPlc::VertexOnSegment {
            segment: [VertexId(0), VertexId(1)],
            vertex: VertexId(2),
        });
        assert_eq!(
            failure_words(&failure),
            ("invalid", "VertexOnSegment".to_owned())
        );
        let failure = Failure::from(DomainError::NothingEnclosed);
        assert_eq!(
            failure_words(&failure),
            ("open", "NothingEnclosed".to_owned())
        );
        let failure = Failure::from(GaveUp::FlipOrder {
            facets: vec![1],
            region: Box::default(),
        });
        assert_eq!(failure_words(&failure), ("gave up", "FlipOrder".to_owned()));
    }
}
