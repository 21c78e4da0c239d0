//! `tetflip verify`: a mesh, whoever wrote it, against its PLC.

use super::input::Input;
use super::{Stop, say, warn};
use clap::ValueEnum;
use std::path::PathBuf;
use tetflip::exchange::{Note, NoteCode};
use tetflip::format::read_mesh;
use tetflip::verify::{Domain, VerifyOptions, verify};

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
    /// Refuse a mesh in which facets that are not exactly coplanar have been merged.
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

fn merge_angle(word: &str) -> Result<f64, String> {
    let number: f64 = word.parse().map_err(|_| "not a number".to_owned())?;
    let good = (0.0..=180.0).contains(&number);
    good.then_some(number)
        .ok_or("not an angle between 0 and 180 degrees".to_owned())
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
    let mut verdict = verify(&plc, &mesh, exactly);
    let mut merged_by_angle = None;
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
            let merged = &lenient.counts.segments_merged;
            let more = merged.saturating_sub(verdict.counts.segments_merged);
            let text = format!(
                "{more} facet edges of the input are missing between facets that meet at {} degrees or more: the \
                 mesh's maker merged facets that are not exactly coplanar; they are verified as merged (see --strict)",
                arguments.merge_angle
            );
            merged_by_angle = Some(Note::new(NoteCode::MergedByAngle, more, text));
            verdict = lenient;
        }
    }
    let notes = merged_by_angle.iter().chain(&verdict.notes);
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
