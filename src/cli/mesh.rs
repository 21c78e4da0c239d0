//! `tetflip mesh`: the CDT of a PLC.

use super::input::Input;
use super::output::Output;
use super::verify::merge_angle;
use super::{Stop, check_outputs, failure_path, warn};
use clap::ValueEnum;
use serde::Serialize;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use tetflip::cdt::{MeshError, MeshOptions, Meshed, SteinerChoice, mesh_with_progress};
use tetflip::error::Failure;
use tetflip::exchange::{Note, Plc, PrecisionChoice};
use tetflip::format::{write_complete, write_poly};
use tetflip::predicate::Steiner;
use tetflip::recover::polygons::{FlipOrder, Insertion};
use tetflip::report::Report;
use tetflip::verify::{Domain, VerifyOptions, verify};

#[derive(clap::Args)]
pub(crate) struct MeshArguments {
    /// The PLC: .poly, .smesh, .node, .off, .stl, .ply, .obj or .mesh; `-` reads stdin.
    input: PathBuf,
    /// Where to write the mesh: NAME.node writes NAME.node, .ele, .face and .edge; NAME.vtu is for ParaView; `-`
    /// writes to stdout.
    #[arg(short, long)]
    output: Option<PathBuf>,
    /// The format of the input, whatever its name, or of the output `-`: vtu. It may be given for each.
    #[arg(long, value_name = "FORMAT")]
    format: Vec<String>,
    /// How polygons are inserted.
    #[arg(long, value_enum, default_value_t = InsertArgument::Flip)]
    insert: InsertArgument,
    /// The number type of the flip queue (with --insert flip).
    ///
    /// Exact: `filtered` (mostly decided by floats), `exact` (dyadic), `rational`, `rug` (GMP, only if built with the
    /// feature rug). Rounded, which can fail: `f64:paper` or `f64` (adaptive predicates, as in the paper), `f64:tetgen`
    /// (the same with weights in plain doubles), `f64:plain`, `f32`, `bits:N` (N mantissa bits; every operation
    /// rounded), `f64:once`, `f32:once`, `once:N` (two exact determinants, each rounded once); with the rules
    /// `,ties=arrival|perturbed|circuit` and `,queue=all|possible`. All predicates of an insertion rounded, which fails
    /// oftener: `naive` (doubles), `naive:N`. N is 8, 11, 14, 16, 18, 20, 22, 24, 26, 28, 32, 36, 40, 44, 48, 53, 64,
    /// 80, 106, 160 or 256.
    /// [default: filtered]
    #[arg(long, value_name = "TYPE")]
    times: Option<FlipOrder>,
    /// How Steiner points on segments are represented.
    #[arg(long, value_enum, default_value_t = SteinerArgument::Auto)]
    steiner: SteinerArgument,
    /// Keep the whole convex hull instead of what the facets enclose; hole points are ignored.
    #[arg(long)]
    hull: bool,
    /// Do not merge coplanar adjacent facets: constrain their common edges, too.
    #[arg(long)]
    no_merge: bool,
    /// How far coordinates may be from what was meant: `auto` (what their values tell), `exact`, or a distance.
    ///
    /// Adjacent facets with equal markers that lie on one plane to this precision are one polygon, and facets may be
    /// as far from flat. `auto`: half a unit of float32 if all coordinates are values of it; else half a unit of the
    /// last of their significant digits (6 or more) or decimals (3 or more); else 8 units of double. Short numbers are
    /// exact. `exact` moves, merges and flattens nothing.
    #[arg(long, value_name = "auto|exact|DISTANCE", default_value = "auto")]
    precision: PrecisionChoice,
    /// Merge adjacent facets with equal markers that meet at this angle or more, too, in degrees: TetGen does so at
    /// 179.9. What is lower than that is given up.
    #[arg(long, value_name = "DEGREES", value_parser = merge_angle, conflicts_with = "no_merge")]
    merge_angle: Option<f64>,
    /// Divide facets that are not flat into triangles, however far from flat they are. (Those off their plane by a
    /// thousandth of their diameter are divided anyway, unless with --precision exact.)
    #[arg(long, conflicts_with = "strict")]
    divide: bool,
    /// Leave out vertices that no tetrahedron has, and number the others anew: NAME.map holds old and new numbers.
    #[arg(long)]
    drop_unused: bool,
    /// Repair nothing: refuse vertices and edges on facets, facets that overlap or are equal, and degenerate ones.
    #[arg(long)]
    strict: bool,
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
    let options = MeshOptions {
        insertion: insertion(arguments)?,
        keep_hull: arguments.hull,
        merge_coplanar: !arguments.no_merge,
        precision: arguments.precision,
        merge_angle: arguments.merge_angle,
        divide: arguments.divide,
        steiner: match arguments.steiner {
            SteinerArgument::Auto => SteinerChoice::Auto,
            SteinerArgument::Rounded => SteinerChoice::Rounded,
            SteinerArgument::Exact => SteinerChoice::Exact,
        },
        drop_unused: arguments.drop_unused,
        strict: arguments.strict,
    };
    let (input, formats) = Input::new(&arguments.input, &arguments.format)?;
    let output = Output::new(arguments.output.as_deref(), &formats, &input)?;
    let report = arguments.report.as_deref();
    check_outputs(&input, output.path(), report)?;
    let (plc, read_notes) = input.read()?;
    let bar = progress_bar(plc.facets.len(), arguments.quiet);
    let result = mesh_with_progress(&plc, &options, &mut |done| bar.set_position(done as u64));
    bar.finish_and_clear();
    match result {
        Ok(meshed) => finish(arguments, &output, &plc, read_notes, meshed),
        Err(error) => Err(refuse(arguments, &input, output.path(), read_notes, error)),
    }
}

/// Verifies a mesh, if that is wanted, writes it, and says what it is.
fn finish(
    arguments: &MeshArguments,
    output: &Output,
    plc: &Plc,
    read_notes: Vec<Note>,
    meshed: Meshed,
) -> Result<(), Stop> {
    let Meshed { mesh, mut report } = meshed;
    print_and_join(read_notes, &mut report);
    write_report(arguments, "ok", &report)?;
    if arguments.verify {
        let verdict = verify(plc, &mesh, verify_options(arguments, &report));
        report.verified_by_integers = Some(verdict.counts.exact_signs);
        write_report(arguments, "ok", &report)?;
        if !verdict.is_ok() {
            return Err(Stop::failed(format!(
                "the mesh is not a CDT of the input, nothing is written\n{verdict}"
            )));
        }
    }
    output.save(&mesh)?;
    remove_old_region(output)?;
    if !arguments.quiet {
        output.say(&format!(
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

/// The message of a failure, after its report has been written.
fn refuse(
    arguments: &MeshArguments,
    input: &Input,
    output: Option<&Path>,
    read_notes: Vec<Note>,
    mut error: MeshError,
) -> Stop {
    print_and_join(read_notes, &mut error.report);
    let mut message = error.to_string();
    if let Err(stop) = write_report(arguments, &message, &error.report) {
        return stop;
    }
    let input = input.words();
    if arguments.strict && error.is_repairable() {
        message += "\nwithout --strict, what is listed here would be repaired";
    }
    if error.findings.is_some() {
        message += &format!("\nfor all that is wrong: tetflip check {input}");
    }
    if let Failure::Domain(domain) = &*error.failure
        && !domain.open_edges().is_empty()
    {
        message += &format!("\nto see the open edges: tetflip check {input} -o bad.vtu");
    }
    if error.is_of_input() {
        return Stop::input(message);
    }
    if let Some(region) = error.failure.region() {
        message += &dump_region(arguments, output, region);
    }
    Stop::failed(message)
}

/// What the verifier is asked of a mesh that this program has made.
fn verify_options(arguments: &MeshArguments, report: &Report) -> VerifyOptions {
    let default = VerifyOptions::default();
    VerifyOptions {
        domain: match arguments.hull {
            true => Domain::Hull,
            false => Domain::Inside,
        },
        tolerance: match report.steiner {
            Steiner::Rounded => default.tolerance,
            Steiner::Exact => 0.0,
        },
        precision: match report.merged_near.polygons + report.welded_vertices {
            0 => 0.0,
            _ => report.precision.delta,
        },
        merge_angle: arguments.merge_angle,
        ..default
    }
}

/// Prints the notes, also of a quiet run that succeeds, and puts those of the reader, which has printed them, in front.
fn print_and_join(read_notes: Vec<Note>, report: &mut Report) {
    report.notes.iter().for_each(|note| warn(&note.to_string()));
    report.notes.splice(0..0, read_notes);
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
fn remove_old_region(output: &Output) -> Result<(), Stop> {
    let Some(path) = output.path().map(failure_path) else {
        return Ok(());
    };
    match std::fs::remove_file(&path) {
        Err(error) if error.kind() != ErrorKind::NotFound => {
            Err(Stop::input(format!("{}: {error}", path.display())))
        }
        _ => Ok(()),
    }
}

/// Writes the region of failed flips, and says where it is and how to try again.
fn dump_region(arguments: &MeshArguments, output: Option<&Path>, region: &Plc) -> String {
    let Some(output) = output else {
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
        "\nits region is in {path}; try again with: tetflip mesh {path} --hull --precision exact --insert flip --times \
         {times}"
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

/// Writes the report, if there is a place for it.
fn write_report(arguments: &MeshArguments, outcome: &str, report: &Report) -> Result<(), Stop> {
    let Some(path) = &arguments.report else {
        return Ok(());
    };
    let file = ReportFile {
        input: arguments.input.display().to_string(),
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
