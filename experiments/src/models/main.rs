//! Pictures of the generated models.
//!
//! **Question.** What do the models of [`tetflip::generate`] look like?
//!
//! **Inputs.** One model of each kind, with a size that still shows its facets.
//!
//! **Results.** `models/KIND.png`, in grey: facets by their angle to the light, the nearest at every pixel, and their edges.
//! Of models in a box, or with much inside, what lies on
//! the bounding box is drawn as lines.
//!
//! **Expected.** Every model is valid ([`tetflip::check`]), and every picture shows it: neither blank nor full.

mod camera;
mod image;

use camera::Camera;
use clap::Parser;
use image::Image;
use std::error::Error;
use std::path::PathBuf;
use std::process::ExitCode;
use tetflip::check::check;
use tetflip::generate::{Kind, generate};
use tetflip::plc::Plc;

/// Pictures of the generated models.
#[derive(Parser)]
struct Arguments {
    /// Small pictures.
    #[arg(long)]
    quick: bool,
    /// Where the results go. [default: results, or target/quick-results with --quick]
    #[arg(long, value_name = "DIR")]
    results: Option<PathBuf>,
}

fn main() -> ExitCode {
    match run(Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("models: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: Arguments) -> Result<(), Box<dyn Error>> {
    let (width, directory) = if arguments.quick {
        (60, "target/quick-results")
    } else {
        (240, "results")
    };
    let directory = arguments.results.unwrap_or_else(|| directory.into());
    let directory = directory.join("models");
    std::fs::create_dir_all(&directory)?;
    for kind in Kind::ALL {
        let plc = generate(kind, 1, size(kind));
        let conflicts = check(&plc, Some(1)).conflicts.len();
        let image = draw(&plc, in_box(kind), width);
        let ink = image.ink();
        if conflicts > 0 || !(0.02..0.98).contains(&ink) {
            return Err(
                format!("{kind}: {conflicts} conflicts, {ink} of the picture drawn").into(),
            );
        }
        let path = directory.join(format!("{kind}.png"));
        image.write(&path)?;
        println!("{}: {} facets", path.display(), plc.facets.len());
    }
    Ok(())
}

/// Small enough for a picture.
fn size(kind: Kind) -> usize {
    match kind {
        Kind::Schoenhardt => 8,
        Kind::Chazelle => 46,
        Kind::Fan | Kind::Needles => 70,
        Kind::Cells | Kind::Confetti => 150,
        Kind::Crankcase => 500,
        Kind::Sponge | Kind::Knot | Kind::Maze => 1100,
        Kind::Terrain => 2500,
        _ => 400,
    }
}

/// Whether the sides of the bounding box hide the rest.
fn in_box(kind: Kind) -> bool {
    matches!(
        kind,
        Kind::Cells
            | Kind::Chazelle
            | Kind::Cheese
            | Kind::Confetti
            | Kind::Crankcase
            | Kind::Fan
            | Kind::Needles
    )
}

fn draw(plc: &Plc, in_box: bool, width: usize) -> Image {
    let camera = Camera::of(plc);
    let mut image = Image::new(width);
    for facet in &plc.facets {
        let polygons: Vec<Vec<[f64; 3]>> = facet
            .polygons
            .iter()
            .map(|polygon| polygon.iter().map(|v| plc.vertices[v.index()]).collect())
            .collect();
        if !(in_box && camera.is_side(&polygons[0])) {
            image.fill(&polygons.iter().map(|p| camera.view(p)).collect::<Vec<_>>());
        }
    }
    for facet in &plc.facets {
        for polygon in &facet.polygons {
            let corners: Vec<[f64; 3]> = polygon.iter().map(|v| plc.vertices[v.index()]).collect();
            let corners = camera.view(&corners);
            for i in 0..corners.len() {
                image.line(corners[i], corners[(i + 1) % corners.len()]);
            }
        }
    }
    image
}
