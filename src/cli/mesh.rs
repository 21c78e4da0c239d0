//! `tetflip mesh`: the CDT of a PLC.

use super::{Stop, check_outputs, failure_path, read, save, say, warn};
use clap::ValueEnum;
use serde::Serialize;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use tetflip::cdt::{Options, tetrahedralize};
use tetflip::check::check;
use tetflip::error::{Failure, GaveUp, InvalidPlc};
use tetflip::exchange::Plc;
use tetflip::format::{write_complete, write_poly};
use tetflip::predicate::Steiner;
use tetflip::recover::polygons::{FlipOrder, Insertion};
use tetflip::report::Report;
use tetflip::verify::{Domain, VerifyOptions, verify};

#[derive(clap::Args)]
pub(crate) struct MeshArguments {
    /// The PLC: .poly, .smesh, .node, .off, .stl, .ply, .obj or .mesh.
    input: PathBuf,
    /// Where to write the mesh: NAME.node writes NAME.node, .ele, .face and .edge; NAME.vtu is for ParaView.
    #[arg(short, long)]
    output: Option<PathBuf>,
    /// How polygons are inserted.
    #[arg(long, value_enum, default_value_t = InsertArgument::Flip)]
    insert: InsertArgument,
    /// The number type of the flip queue (with --insert flip).
    ///
    /// Exact: `filtered` (mostly decided by floats), `exact` (dyadic), `rational`, `rug` (GMP, only if built with the feature
    /// rug). Rounded, which can fail: `f64` (the paper's), `f32`, `bits:N` (N mantissa bits). All predicates of an
    /// insertion rounded, which fails oftener: `naive` (doubles), `naive:N`. N is 8, 11, 14, 16, 18, 20, 22, 24, 26, 28, 32,
    /// 36, 40, 44, 48, 53, 64, 80, 106, 160 or 256.
    /// [default: filtered]
    #[arg(long, value_name = "TYPE")]
    times: Option<FlipOrder>,
    /// How Steiner points on segments are represented.
    #[arg(long, value_enum, default_value_t = SteinerArgument::Auto)]
    steiner: SteinerArgument,
    /// Keep the whole convex hull instead of what the facets enclose. Where they enclose nothing it is kept in any case.
    #[arg(long)]
    hull: bool,
    /// Do not merge coplanar adjacent facets: constrain their common edges, too.
    #[arg(long)]
    no_merge: bool,
    /// Verify the mesh exactly before it is written.
    #[arg(long)]
    verify: bool,
    /// Write counts and seconds per phase as JSON.
    #[arg(long, value_name = "FILE.json")]
    report: Option<PathBuf>,
    /// No progress and no summary.
    #[arg(short, long)]
    quiet: bool,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum InsertArgument {
    /// Cavity retriangulation (paper §3.1).
    Cavity,
    /// Gift wrapping of the cavities: the baseline, in quadratic time.
    GiftWrap,
    /// Bistellar flips (paper §3.2).
    Flip,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum SteinerArgument {
    /// Rounded; exact if that has no solution. The summary and the report say which.
    Auto,
    /// As doubles: segments and polygons with Steiner points are straight and flat up to rounding (paper).
    Rounded,
    /// Exactly: straight and flat; rounded only on output. NAME.steiner holds the exact positions.
    Exact,
}

/// Makes the CDT and writes it.
pub(crate) fn mesh(arguments: &MeshArguments) -> Result<(), Stop> {
    let mut options = Options {
        insertion: insertion(arguments)?,
        keep_hull: arguments.hull,
        merge_coplanar: !arguments.no_merge,
        steiner: match arguments.steiner {
            SteinerArgument::Auto | SteinerArgument::Rounded => Steiner::Rounded,
            SteinerArgument::Exact => Steiner::Exact,
        },
    };
    check_outputs(
        &arguments.input,
        arguments.output.as_deref(),
        arguments.report.as_deref(),
    )?;
    let (plc, _) = read(&arguments.input)?;
    let mut report = Report::default();
    let bar = progress_bar(plc.facets.len(), arguments.quiet);
    let mut result = tetrahedralize(&plc, &options, &mut report, &mut |done| {
        bar.set_position(done as u64)
    });
    let mut notes = Vec::new();
    let why = match &result {
        _ if arguments.steiner != SteinerArgument::Auto => None,
        Err(failure) if failure.is_due_to_rounding() => Some(failure.describe(&plc)),
        // Whether such polygons can be inserted may depend on the algorithm; what this program makes should not.
        Ok(_) if report.flattening.left_whole > 0 => Some(format!(
            "{} polygons would need too many points to be cut into flat pieces",
            report.flattening.left_whole
        )),
        _ => None,
    };
    if let Some(why) = why {
        let exact = Options {
            steiner: Steiner::Exact,
            ..options
        };
        let mut exact_report = Report::default();
        let again = tetrahedralize(&plc, &exact, &mut exact_report, &mut |done| {
            bar.set_position(done as u64)
        });
        if again.is_ok() || result.is_err() {
            notes.push(format!(
                "with rounded Steiner points: {why}; made with exact ones"
            ));
            (options, report, result) = (exact, exact_report, again);
        }
    }
    bar.finish_and_clear();
    if report.hull_instead {
        let note = "the facets enclose nothing (an open surface?): the convex hull is kept";
        notes.push(note.to_owned());
    }
    if !report.spoilt_by_rounding.is_empty() {
        notes.push(spoilt_by_rounding(
            &report.spoilt_by_rounding,
            plc.first_index,
        ));
    }
    let mut status = 2;
    let outcome = match &result {
        Ok(_) => "ok".to_owned(),
        Err(failure) => {
            let gave_up = matches!(failure, Failure::GaveUp(_));
            match explanation(&arguments.input, &plc, failure) {
                // Whatever the algorithm ran into, the input is to blame, and the check names facets more closely.
                Some(why) if !matches!(failure, Failure::Plc(_)) => {
                    format!("invalid PLC: {why}\n({})", failure.describe(&plc))
                }
                Some(why) => format!("{}\n{why}", failure.describe(&plc)),
                None => {
                    status = if gave_up { 1 } else { 2 };
                    failure.describe(&plc)
                }
            }
        }
    };
    if let Some(path) = &arguments.report {
        write_report(path, &arguments.input, &outcome, &report)?;
    }
    let mesh = result.map_err(|failure| Stop {
        message: match failure.region() {
            Some(region) if status == 1 => outcome + &dump_region(arguments, region),
            _ => outcome,
        },
        status,
    })?;
    if arguments.verify {
        let domain = if arguments.hull || report.hull_instead {
            Domain::Hull
        } else {
            Domain::Inside
        };
        let verdict = verify(
            &plc,
            &mesh,
            VerifyOptions {
                domain,
                tolerance: match options.steiner {
                    Steiner::Rounded => VerifyOptions::default().tolerance,
                    Steiner::Exact => 0.0,
                },
                ..VerifyOptions::default()
            },
        );
        report.verified_by_integers = Some(verdict.counts.exact_signs);
        if let Some(path) = &arguments.report {
            write_report(path, &arguments.input, "ok", &report)?;
        }
        if !verdict.is_ok() {
            return Err(Stop::failed(format!(
                "the mesh is not a CDT of the input, nothing is written\n{verdict}"
            )));
        }
    }
    save(arguments.output.as_deref(), &mesh)?;
    remove_old_region(arguments)?;
    if !arguments.quiet {
        say(&format!(
            "{} vertices ({} Steiner points), {} tetrahedra, {} faces on facets; {} flips{}",
            mesh.vertices.len(),
            report.steiner_points,
            mesh.tets.len(),
            mesh.faces.len(),
            report.insertion_counts.flips.flips(),
            if arguments.verify { "; verified" } else { "" },
        ));
    }
    notes.iter().for_each(|note| warn(note));
    Ok(())
}

/// Names the tetrahedra that are positive only with exact Steiner points.
fn spoilt_by_rounding(tets: &[usize], first_index: u32) -> String {
    const LISTED: usize = 20;
    let names = tets.iter().take(LISTED);
    let names: Vec<String> = names
        .map(|t| (t + first_index as usize).to_string())
        .collect();
    format!(
        "{} tetrahedra are positive, but not with Steiner points rounded to doubles: {}{} (the report lists all)",
        tets.len(),
        names.join(", "),
        if tets.len() > LISTED { ", …" } else { "" }
    )
}

fn insertion(arguments: &MeshArguments) -> Result<Insertion, Stop> {
    match (arguments.insert, arguments.times) {
        (InsertArgument::Flip, times) => Ok(Insertion::Flip(times.unwrap_or(FlipOrder::FILTERED))),
        (_, Some(times)) => Err(Stop::input(format!(
            "--times {times} is about flips: it needs --insert flip"
        ))),
        (InsertArgument::Cavity, None) => Ok(Insertion::Cavity),
        (InsertArgument::GiftWrap, None) => Ok(Insertion::GiftWrap),
    }
}

/// Removes the region that an earlier run with the same output failed in: it is no part of this one.
fn remove_old_region(arguments: &MeshArguments) -> Result<(), Stop> {
    let Some(path) = arguments.output.as_deref().map(failure_path) else {
        return Ok(());
    };
    match std::fs::remove_file(&path) {
        Err(error) if error.kind() != ErrorKind::NotFound => {
            Err(Stop::input(format!("{}: {error}", path.display())))
        }
        _ => Ok(()),
    }
}

/// What the check says of the input of a failed run, if it is not a valid PLC.
fn explanation(input: &Path, plc: &Plc, failure: &Failure) -> Option<String> {
    /// How many findings are listed.
    const LISTED: usize = 8;
    // Other failures are not about facets that intersect.
    match failure {
        Failure::Invalid(
            InvalidPlc::PointOnPolygon { .. } | InvalidPlc::RegionsDisagree { .. },
        )
        | Failure::GaveUp(GaveUp::NothingInside)
        | Failure::Delaunay(_)
        | Failure::NoSuchPolygon(_) => return None,
        Failure::Plc(_) | Failure::Invalid(_) | Failure::GaveUp(_) => {}
    }
    let findings = check(plc, Some(LISTED));
    let told = failure.describe(plc);
    let errors = findings.errors.iter().map(ToString::to_string);
    let conflicts = findings.conflicts.iter().map(|c| c.describe(plc));
    let mut lines: Vec<String> = errors
        .chain(conflicts)
        .filter(|line| !told.ends_with(line))
        .collect();
    if findings.is_valid() || lines.is_empty() {
        return None;
    }
    if lines.len() > LISTED || findings.stopped {
        lines.truncate(LISTED);
        lines.push("…".to_owned());
    }
    let input = input.display();
    lines.push(format!("for all that is wrong: tetflip check {input}"));
    Some(lines.join("\n"))
}

/// Writes the region of failed flips, and says where it is and how to try again.
fn dump_region(arguments: &MeshArguments, region: &Plc) -> String {
    let Some(output) = &arguments.output else {
        return "; with --output, the region is written beside it".to_owned();
    };
    let path = failure_path(output);
    if let Err(error) = write_poly(&path, region) {
        return format!("; the region cannot be written: {error}");
    }
    // Filtered is also what cavities fall back on.
    let times = arguments.times.unwrap_or(FlipOrder::FILTERED);
    let path = path.display();
    format!(
        "\nits region is in {path}; try again with: tetflip mesh {path} --hull --insert flip --times {times}"
    )
}

/// The report as a file: the run, then what the library counted.
#[derive(Serialize)]
struct ReportFile<'a> {
    input: String,
    outcome: &'a str,
    #[serde(flatten)]
    report: &'a Report,
}

fn write_report(path: &Path, input: &Path, outcome: &str, report: &Report) -> Result<(), Stop> {
    let file = ReportFile {
        input: input.display().to_string(),
        outcome,
        report,
    };
    let text = serde_json::to_string_pretty(&file).map_err(Stop::input)?;
    write_complete(path, (text + "\n").as_bytes()).map_err(Stop::input)
}

/// A bar on stderr, where that is a terminal.
fn progress_bar(polygons: usize, quiet: bool) -> indicatif::ProgressBar {
    if quiet {
        return indicatif::ProgressBar::hidden();
    }
    // Hidden by itself where stderr is no terminal.
    indicatif::ProgressBar::new(polygons as u64)
}
