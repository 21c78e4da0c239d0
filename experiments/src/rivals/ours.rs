//! This library as one of the programs.

use super::contestant::Ours;
use super::process::processor_seconds;
use std::error::Error;
use std::path::Path;
use std::time::Instant;
use tetflip::cdt::{Cdt, Options};
use tetflip::delaunay::delaunay;
use tetflip::exchange::ExportedMesh;
use tetflip::exchange::Plc;
use tetflip::format::read_plc;
use tetflip::mesh::VertexId;
use tetflip::predicate::DoublePoints;
use tetflip::recover::polygons::{FlipOrder, Insertion};
use tetflip::report::Report;
use tetflip::verify::{Domain, VerifyOptions, verify};

/// Does what the word says with a file, and prints what `measure` reads.
///
/// # Errors
/// If the word is unknown, or the file has no CDT.
pub fn take_part(word: &str, path: &Path) -> Result<(), Box<dyn Error>> {
    let all = Ours::ALL.into_iter();
    let what = all
        .clone()
        .find(|o| o.word() == word)
        .ok_or_else(|| format!("unknown word {word}"))?;
    let (plc, _) = read_plc(path)?;
    if plc.facets.is_empty() && what == Ours::Delaunay {
        return points_only(plc);
    }
    let insertion = match what {
        Ours::Flips => Insertion::Flip(FlipOrder::FILTERED),
        _ => Insertion::Cavity,
    };
    let (mesh, constructed, polygons, steiner) = cdt(&plc, insertion)?;
    let (seconds, wall) = if what == Ours::Verifier {
        let options = VerifyOptions {
            domain: Domain::Hull,
            ..VerifyOptions::default()
        };
        let (start, wall) = (processor_seconds(), Instant::now());
        let verdict = verify(&plc, &mesh, options);
        if !verdict.is_ok() {
            return Err("the mesh is refused".into());
        }
        (processor_seconds() - start, Some(wall.elapsed()))
    } else {
        (constructed, None)
    };
    println!("tetrahedra: {}", mesh.tets.len());
    println!("seconds: {seconds}");
    if let Some(wall) = wall {
        println!("wall: {}", wall.as_secs_f64());
    }
    println!("polygons: {polygons}");
    println!("steiner: {steiner}");
    Ok(())
}

/// Points that are known to be distinct.
fn points_only(plc: Plc) -> Result<(), Box<dyn Error>> {
    let points = DoublePoints::new(plc.vertices);
    let all: Vec<VertexId> = (0..points.as_slice().len()).map(VertexId::new).collect();
    let (start, wall) = (processor_seconds(), Instant::now());
    let result = delaunay(&points, &all)?;
    let (seconds, wall) = (processor_seconds() - start, wall.elapsed());
    println!("tetrahedra: {}", result.mesh.finite().count());
    println!("seconds: {seconds}");
    println!("wall: {}", wall.as_secs_f64());
    Ok(())
}

/// The mesh of the convex hull, the seconds of its construction, of these for polygons, and the number of Steiner
/// points. As in TetGen's phases, inside and outside are not told apart and no arrays are made while the clock runs.
fn cdt(plc: &Plc, insertion: Insertion) -> Result<(ExportedMesh, f64, f64, usize), Box<dyn Error>> {
    let mut report = Report::default();
    let start = processor_seconds();
    let mut cdt = Cdt::begin(plc, &Options::default(), &mut report)
        .map_err(|failure| failure.describe(plc).to_string())?;
    let middle = processor_seconds();
    cdt.insert_polygons(insertion, &mut report, &mut |_| ())
        .map_err(|failure| failure.describe(plc).to_string())?;
    let end = processor_seconds();
    let mesh = cdt
        .export(plc, true, &mut report)
        .map_err(|failure| failure.describe(plc).to_string())?;
    Ok((mesh, end - start, end - middle, report.steiner_points))
}
