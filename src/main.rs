//! The command line program: arguments → library → files. No algorithm here.

use clap::{Parser, Subcommand, ValueEnum};
use serde::Serialize;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use tetflip::cdt::{Options, tetrahedralize};
use tetflip::delaunay::delaunay;
use tetflip::error::Failure;
use tetflip::format::{
    FormatError, mesh_paths, read_mesh, read_plc, read_poly, read_smesh, write_mesh, write_poly,
};
use tetflip::mesh::{ExportedFace, ExportedMesh, TetMesh, VertexId};
use tetflip::plc::{Complex, Plc};
use tetflip::predicate::{DoublePoints, Steiner};
use tetflip::recover::polygons::{Insertion, Times};
use tetflip::report::Report;
use tetflip::verify::{Domain, VerifyOptions, verify};

/// Constrained Delaunay tetrahedralizations, by cavity retriangulation or by exactly ordered bistellar flips.
///
/// Exit status: 0 success; 1 the algorithm gave up or a verification failed; 2 bad input or usage.
#[derive(Parser)]
#[command(version, max_term_width = 110)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Make the CDT of a PLC.
    Mesh(MeshArguments),
    /// Check a mesh, whoever wrote it, against its PLC, in exact arithmetic.
    Verify(VerifyArguments),
    /// Make the Delaunay tetrahedralization of the vertices of a file, ignoring its facets.
    Delaunay(DelaunayArguments),
}

#[derive(clap::Args)]
struct MeshArguments {
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
    #[arg(long, value_name = "TYPE", default_value_t = Times::Filtered)]
    times: Times,
    /// How Steiner points on segments are represented.
    #[arg(long, value_enum, default_value_t = SteinerArgument::Rounded)]
    steiner: SteinerArgument,
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

#[derive(clap::Args)]
struct VerifyArguments {
    /// The PLC.
    plc: PathBuf,
    /// The mesh: NAME.node, with NAME.ele and, if there, NAME.face and NAME.edge beside it.
    mesh: PathBuf,
    /// Which part of space the mesh is meant to fill.
    #[arg(long, value_enum, default_value_t = DomainArgument::Auto)]
    domain: DomainArgument,
    /// How far a Steiner point may be from its segment or facet, in units in the last place of the largest coordinate.
    /// [default: 8, or 0 where NAME.steiner gives exact positions]
    #[arg(long, value_parser = tolerance)]
    tolerance: Option<f64>,
    /// Facets with one marker may have been merged if the angle between them is at least this many degrees. TetGen merges
    /// from 179.9 on. Only asked where the mesh does not hold with exactly coplanar facets merged, and then said.
    #[arg(long, value_parser = merge_angle, default_value_t = 179.9)]
    merge_angle: f64,
    /// Refuse a mesh in which facets that are not exactly coplanar have been merged.
    #[arg(long)]
    strict: bool,
    /// Say nothing; only the exit status.
    #[arg(short, long)]
    quiet: bool,
}

#[derive(clap::Args)]
struct DelaunayArguments {
    /// The points: any input format.
    input: PathBuf,
    /// Where to write the mesh.
    #[arg(short, long)]
    output: Option<PathBuf>,
    /// No summary.
    #[arg(short, long)]
    quiet: bool,
}

fn tolerance(word: &str) -> Result<f64, String> {
    let number: f64 = word.parse().map_err(|_| "not a number".to_owned())?;
    let good = number.is_finite() && number >= 0.0;
    good.then_some(number)
        .ok_or("not a finite number from 0 on".to_owned())
}

fn merge_angle(word: &str) -> Result<f64, String> {
    let number: f64 = word.parse().map_err(|_| "not a number".to_owned())?;
    let good = (0.0..=180.0).contains(&number);
    good.then_some(number)
        .ok_or("not an angle between 0 and 180 degrees".to_owned())
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
    /// As doubles: segments and polygons with Steiner points are straight and flat up to rounding (paper).
    Rounded,
    /// Exactly: straight and flat; rounded only on output. NAME.steiner holds the exact positions.
    Exact,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum DomainArgument {
    /// The inside if the mesh is bounded by facets, else the hull.
    Auto,
    /// The convex hull.
    Hull,
    /// What the facets enclose.
    Inside,
}

/// A failure with its exit status.
struct Stop {
    message: String,
    status: u8,
}

impl Stop {
    fn input(message: impl ToString) -> Stop {
        Stop {
            message: message.to_string(),
            status: 2,
        }
    }

    fn failed(message: impl ToString) -> Stop {
        Stop {
            message: message.to_string(),
            status: 1,
        }
    }
}

fn main() -> ExitCode {
    let result = match Arguments::parse().command {
        Command::Mesh(arguments) => mesh(&arguments),
        Command::Verify(arguments) => verify_files(&arguments),
        Command::Delaunay(arguments) => delaunay_of_file(&arguments),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(stop) => {
            // A closed stderr must not turn the exit status into that of a panic.
            let _ = writeln!(std::io::stderr(), "tetflip: {}", stop.message);
            ExitCode::from(stop.status)
        }
    }
}

fn mesh(arguments: &MeshArguments) -> Result<(), Stop> {
    let options = Options {
        insertion: insertion(arguments),
        keep_hull: arguments.hull,
        merge_coplanar: !arguments.no_merge,
        steiner: match arguments.steiner {
            SteinerArgument::Rounded => Steiner::Rounded,
            SteinerArgument::Exact => Steiner::Exact,
        },
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
    let outcome = match &result {
        Ok(_) => "ok".to_owned(),
        Err(failure) => failure.describe(&plc),
    };
    if let Some(path) = &arguments.report {
        write_report(path, &arguments.input, &outcome, &report)?;
    }
    let mesh = result.map_err(|failure| Stop {
        message: match failure.region() {
            Some(region) => outcome + &dump_region(arguments, region),
            None => outcome,
        },
        status: if matches!(failure, Failure::GaveUp(_)) {
            1
        } else {
            2
        },
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
                tolerance: match options.steiner {
                    Steiner::Rounded => VerifyOptions::default().tolerance,
                    Steiner::Exact => 0.0,
                },
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
        if !report.spoilt_by_rounding.is_empty() {
            say(&spoilt_by_rounding(
                &report.spoilt_by_rounding,
                plc.first_index,
            ));
        }
    }
    Ok(())
}

/// Names the tetrahedra that are positive only with exact Steiner points.
fn spoilt_by_rounding(tets: &[usize], first_index: u32) -> String {
    const LISTED: usize = 20;
    let names: Vec<String> = tets
        .iter()
        .take(LISTED)
        .map(|t| (t + first_index as usize).to_string())
        .collect();
    format!(
        "{} tetrahedra are positive, but not with Steiner points rounded to doubles: {}{} (the report lists all)",
        tets.len(),
        names.join(", "),
        if tets.len() > LISTED { ", …" } else { "" }
    )
}

fn insertion(arguments: &MeshArguments) -> Insertion {
    match arguments.insert {
        InsertArgument::Cavity => Insertion::Cavity,
        InsertArgument::GiftWrap => Insertion::GiftWrap,
        InsertArgument::Flip => Insertion::Flip(arguments.times),
    }
}

/// Where the region of failed flips goes: beside the mesh that is not made.
fn failure_path(output: &Path) -> PathBuf {
    output.with_extension("failure.poly")
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

fn verify_files(arguments: &VerifyArguments) -> Result<(), Stop> {
    let plc = read(&arguments.plc)?;
    let mesh = read_mesh(&arguments.mesh).map_err(Stop::input)?;
    let exactly = VerifyOptions {
        domain: match arguments.domain {
            DomainArgument::Auto => Domain::Auto,
            DomainArgument::Hull => Domain::Hull,
            DomainArgument::Inside => Domain::Inside,
        },
        tolerance: arguments.tolerance.unwrap_or(match mesh.exact[..] {
            [] => VerifyOptions::default().tolerance,
            _ => 0.0,
        }),
        ..VerifyOptions::default()
    };
    let mut verdict = verify(&plc, &mesh, exactly);
    if !verdict.is_ok() && !arguments.strict {
        let leniently = VerifyOptions {
            merge_angle: Some(arguments.merge_angle),
            ..exactly
        };
        let lenient = verify(&plc, &mesh, leniently);
        // Say which of the two readings of the input the verdict is about.
        if lenient.is_ok()
            || lenient.totals.values().sum::<usize>() < verdict.totals.values().sum::<usize>()
        {
            if !arguments.quiet {
                say(&format!(
                    "{} facet edges of the input are missing between facets that meet at {} degrees or more: the mesh's \
                     maker merged facets that are not exactly coplanar; they are verified as merged (see --strict)",
                    lenient
                        .counts
                        .segments_merged
                        .saturating_sub(verdict.counts.segments_merged),
                    arguments.merge_angle
                ));
            }
            verdict = lenient;
        }
    }
    if !arguments.quiet {
        say(verdict.to_string().trim_end());
    }
    if verdict.is_ok() {
        Ok(())
    } else {
        Err(Stop::failed("the mesh is not a CDT of the PLC"))
    }
}

fn delaunay_of_file(arguments: &DelaunayArguments) -> Result<(), Stop> {
    check_outputs(&arguments.input, arguments.output.as_deref(), None)?;
    let plc = read(&arguments.input)?;
    let vertices_only = Plc {
        first_index: plc.first_index,
        vertices: plc.vertices,
        ..Plc::default()
    };
    let complex = Complex::new(&vertices_only, true).map_err(Stop::input)?;
    let points = DoublePoints::new(vertices_only.vertices);
    let distinct: Vec<VertexId> = (0..complex.representative.len())
        .map(VertexId::new)
        .filter(|&v| complex.representative[v.index()] == v)
        .collect();
    let duplicates = complex.representative.len() - distinct.len();
    let result = delaunay(&points, &distinct).map_err(Stop::input)?;
    let tets: Vec<[VertexId; 4]> = result
        .mesh
        .finite()
        .map(|t| result.mesh.vertices(t))
        .collect();
    if let Some(path) = &arguments.output {
        let mesh = ExportedMesh {
            first_index: vertices_only.first_index,
            vertices: points.as_slice().to_vec(),
            faces: hull_faces(&result.mesh),
            tets: tets.clone(),
            ..ExportedMesh::default()
        };
        save(Some(path), &mesh)?;
    }
    if !arguments.quiet {
        say(&format!(
            "{} distinct vertices ({duplicates} duplicates merged), {} tetrahedra",
            distinct.len(),
            tets.len()
        ));
    }
    Ok(())
}

/// The triangles of the convex hull, seen from outside.
fn hull_faces(mesh: &TetMesh) -> Vec<ExportedFace> {
    let ghosts = mesh
        .all()
        .filter_map(|t| Some(t.corner(mesh.slot_of(t, VertexId::INFINITE)?)));
    ghosts
        .map(|c| ExportedFace {
            vertices: mesh.facet(mesh.twin(c)),
            marker: 0,
        })
        .collect()
}

fn read(path: &Path) -> Result<Plc, Stop> {
    read_plc(path).map_err(|error| match error {
        FormatError::Io { .. } => Stop::input(error),
        error => Stop::input(format!("{}: {error}", path.display())),
    })
}

fn save(path: Option<&Path>, mesh: &ExportedMesh) -> Result<(), Stop> {
    match path {
        Some(path) => write_mesh(path, mesh).map(|_| ()).map_err(Stop::input),
        None => Ok(()),
    }
}

/// Refuses outputs that cannot be written or would replace an input, before any work is done.
fn check_outputs(input: &Path, mesh: Option<&Path>, report: Option<&Path>) -> Result<(), Stop> {
    let mut outputs: Vec<PathBuf> = report.map(Path::to_path_buf).into_iter().collect();
    if let Some(path) = mesh {
        outputs.extend(mesh_paths(path).map_err(Stop::input)?);
        outputs.push(failure_path(path));
    }
    let node = input.with_extension("node");
    for output in outputs {
        let replaces = |file: &Path| match (output.canonicalize(), file.canonicalize()) {
            (Ok(output), Ok(file)) => output == file,
            _ => false,
        };
        if replaces(input) || (replaces(&node) && reads_node_file(input)) {
            return Err(Stop::input(format!(
                "{} is an input and would be overwritten; choose another name",
                output.display()
            )));
        }
    }
    Ok(())
}

/// Whether the vertices of a `.poly` or `.smesh` file are in the `.node` file beside it.
fn reads_node_file(input: &Path) -> bool {
    let extension = input.extension().unwrap_or_default().to_ascii_lowercase();
    let bytes = std::fs::read(input).unwrap_or_default();
    let mut asked = false;
    let nodes = || {
        asked = true;
        std::fs::read(input.with_extension("node")).map_err(|source| FormatError::Io {
            path: input.to_owned(),
            source,
        })
    };
    // Errors are reported when the file is read in earnest.
    let _ = match extension.to_str() {
        Some("poly") => read_poly(&bytes, nodes),
        Some("smesh") => read_smesh(&bytes, nodes),
        _ => return false,
    };
    asked
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

/// Prints a line. That nobody reads it (a closed pipe) is no failure of the run.
fn say(line: &str) {
    let _ = writeln!(std::io::stdout(), "{line}");
}

/// A bar on stderr, where that is a terminal.
fn progress_bar(polygons: usize, quiet: bool) -> indicatif::ProgressBar {
    if quiet {
        return indicatif::ProgressBar::hidden();
    }
    // Hidden by itself where stderr is no terminal.
    indicatif::ProgressBar::new(polygons as u64)
}
