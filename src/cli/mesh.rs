//! `tetflip mesh`: the CDT of a PLC.

use super::{Stop, check_outputs, failure_path, read, save, say};
use clap::ValueEnum;
use serde::Serialize;
use std::path::{Path, PathBuf};
use tetflip::cdt::{Options, tetrahedralize};
use tetflip::check::check;
use tetflip::error::{Failure, GaveUp, InvalidPlc};
use tetflip::format::write_poly;
use tetflip::plc::Plc;
use tetflip::recover::polygons::{Insertion, Times};
use tetflip::report::Report;
use tetflip::verify::{Domain, VerifyOptions, verify};

#[derive(clap::Args)]
pub(crate) struct MeshArguments {
    /// The PLC: .poly, .smesh, .node, .off or .stl.
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
    #[arg(long, value_name = "TYPE", default_value_t = Times::Filtered)]
    times: Times,
    /// Keep the whole convex hull instead of what the facets enclose.
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

/// Makes the CDT and writes it.
pub(crate) fn mesh(arguments: &MeshArguments) -> Result<(), Stop> {
    let options = Options {
        insertion: insertion(arguments),
        keep_hull: arguments.hull,
        merge_coplanar: !arguments.no_merge,
    };
    check_outputs(
        &arguments.input,
        arguments.output.as_deref(),
        arguments.report.as_deref(),
    )?;
    let plc = read(&arguments.input)?;
    let mut report = Report::default();
    let bar = progress_bar(plc.facets.len(), arguments.quiet);
    let result = tetrahedralize(&plc, &options, &mut report, &mut |done| {
        bar.set_position(done as u64)
    });
    bar.finish_and_clear();
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
        let domain = if arguments.hull {
            Domain::Hull
        } else {
            Domain::Inside
        };
        let verdict = verify(
            &plc,
            &mesh,
            VerifyOptions {
                domain,
                ..VerifyOptions::default()
            },
        );
        if !verdict.is_ok() {
            return Err(Stop::failed(format!(
                "the mesh is not a CDT of the input, nothing is written\n{verdict}"
            )));
        }
    }
    save(arguments.output.as_deref(), &mesh)?;
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
    Ok(())
}

fn insertion(arguments: &MeshArguments) -> Insertion {
    match arguments.insert {
        InsertArgument::Cavity => Insertion::Cavity,
        InsertArgument::GiftWrap => Insertion::GiftWrap,
        InsertArgument::Flip => Insertion::Flip(arguments.times),
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
    let times = match insertion(arguments) {
        Insertion::Flip(times) => times,
        // What cavities fall back on.
        Insertion::Cavity | Insertion::GiftWrap => Times::Filtered,
    };
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
    std::fs::write(path, text + "\n")
        .map_err(|error| Stop::input(format!("{}: {error}", path.display())))
}

/// A bar on stderr, where that is a terminal.
fn progress_bar(polygons: usize, quiet: bool) -> indicatif::ProgressBar {
    if quiet {
        return indicatif::ProgressBar::hidden();
    }
    // Hidden by itself where stderr is no terminal.
    indicatif::ProgressBar::new(polygons as u64)
}
