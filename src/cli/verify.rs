//! `tetflip verify`: a mesh, whoever wrote it, against its PLC.

use super::input::Input;
use super::{Stop, say, warn};
use clap::ValueEnum;
use std::path::PathBuf;
use tetflip::exchange::{Note, NoteCode, Precision, PrecisionChoice};
use tetflip::format::read_mesh;
use tetflip::verify::{Domain, Verdict, VerifyOptions, verify};

#[derive(clap::Args)]
pub(crate) struct VerifyArguments {
    /// The PLC; `-` reads stdin.
    plc: PathBuf,
    /// The mesh: NAME.node, with NAME.ele and, if there, NAME.face and NAME.edge beside it; or Medit's NAME.mesh.
    mesh: PathBuf,
    /// The format of the PLC, whatever its name: poly, smesh, node, off, stl, ply, obj or mesh.
    #[arg(long, value_name = "FORMAT")]
    format: Vec<String>,
    /// Which part of space the mesh is meant to fill.
    #[arg(long, value_enum, default_value_t = DomainArgument::Auto)]
    domain: DomainArgument,
    /// How far a Steiner point may be from its segment or facet, in units in the last place of the largest coordinate.
    /// [default: 8, or 0 where NAME.steiner gives exact positions]
    #[arg(long, value_parser = tolerance)]
    tolerance: Option<f64>,
    /// Facets with one marker may have been merged if the angle between them is at least this many degrees. TetGen
    /// merges from 179.9 on. Only asked where the mesh does not hold with exactly coplanar facets merged, and then
    /// said.
    #[arg(long, value_parser = merge_angle, default_value_t = 179.9)]
    merge_angle: f64,
    /// How far coordinates may be from what was meant: `auto` (what their values tell, see `mesh --help`), `exact`, or
    /// a distance. Adjacent facets with equal markers on one plane to this precision may have been merged.
    #[arg(long, value_name = "auto|exact|DISTANCE", default_value = "auto")]
    precision: PrecisionChoice,
    /// Refuse a mesh in which facets have been merged that are not on one plane to the precision.
    #[arg(long)]
    strict: bool,
    /// Check everything but that faces which are on no facet are locally Delaunay.
    #[arg(long)]
    any_triangulation: bool,
    /// Say nothing but notes; else only the exit status.
    #[arg(short, long)]
    quiet: bool,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum DomainArgument {
    /// The inside; the convex hull only where the facets enclose nothing.
    Auto,
    /// The convex hull, whether hole points are meshed or not.
    Hull,
    /// What the facets enclose.
    Inside,
}

fn tolerance(word: &str) -> Result<f64, String> {
    let number: f64 = word.parse().map_err(|_| "not a number".to_owned())?;
    let good = number.is_finite() && number >= 0.0;
    good.then_some(number)
        .ok_or("not a finite number from 0 on".to_owned())
}

pub(super) fn merge_angle(word: &str) -> Result<f64, String> {
    let number: f64 = word.parse().map_err(|_| "not a number".to_owned())?;
    let good = (0.0..=180.0).contains(&number);
    good.then_some(number)
        .ok_or("not an angle between 0 and 180 degrees".to_owned())
}

/// A way to read the input more leniently.
struct Reading {
    merge_angle: Option<f64>,
    code: NoteCode,
    why: String,
    but: &'static str,
}

/// The ways that are allowed, less lenient ones first.
fn readings(arguments: &VerifyArguments, precision: Precision) -> Vec<Reading> {
    let mut readings = Vec::new();
    if precision.delta > 0.0 {
        readings.push(Reading {
            merge_angle: None,
            code: NoteCode::FlatToPrecision,
            why: format!("between facets on one plane to the precision {precision}"),
            but: " (see --precision)",
        });
    }
    if !arguments.strict {
        readings.push(Reading {
            merge_angle: Some(arguments.merge_angle),
            code: NoteCode::MergedByAngle,
            why: format!(
                "between facets that meet at {} degrees or more",
                arguments.merge_angle
            ),
            but: " (see --strict)",
        });
    }
    readings
}

fn violations(verdict: &Verdict) -> usize {
    verdict.totals.values().sum()
}

/// Verifies a mesh against its PLC.
pub(crate) fn verify_files(arguments: &VerifyArguments) -> Result<(), Stop> {
    let input = Input::alone(&arguments.plc, &arguments.format)?;
    let (plc, mesh) = rayon::join(|| input.read(), || read_mesh(&arguments.mesh));
    let ((plc, _), mesh) = (plc?, mesh.map_err(Stop::input)?);
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
        any_triangulation: arguments.any_triangulation,
        ..VerifyOptions::default()
    };
    let precision = arguments.precision.of(&plc.vertices);
    let mut verdict = verify(&plc, &mesh, exactly);
    let mut leniency = None;
    for reading in readings(arguments, precision) {
        if verdict.is_ok() {
            break;
        }
        let lenient = verify(
            &plc,
            &mesh,
            VerifyOptions {
                precision: precision.delta,
                merge_angle: reading.merge_angle,
                ..exactly
            },
        );
        // Say which of the readings of the input the verdict is about.
        if lenient.is_ok() || violations(&lenient) < violations(&verdict) {
            let merged = &lenient.counts.segments_merged;
            let more = merged.saturating_sub(verdict.counts.segments_merged);
            let welded = match lenient.counts.welded {
                0 => String::new(),
                n => format!("{n} input vertices are welded to others; "),
            };
            let text = format!(
                "{welded}{more} facet edges of the input are missing {}: the mesh's maker merged facets that are not \
                 exactly coplanar; they are verified as merged{}",
                reading.why, reading.but
            );
            leniency = Some(Note::new(reading.code, more, text));
            verdict = lenient;
        }
    }
    let notes = leniency.iter().chain(&verdict.notes);
    notes.for_each(|note| warn(&note.to_string()));
    if !arguments.quiet {
        say(verdict.to_string().trim_end());
    }
    if verdict.is_ok() {
        Ok(())
    } else {
        let claim = match arguments.any_triangulation {
            true => "the mesh is not a tetrahedralization of the PLC",
            false => "the mesh is not a CDT of the PLC",
        };
        Err(Stop::failed(claim))
    }
}
