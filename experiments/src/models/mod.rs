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

use crate::expectation::{Check, check_rows};
use crate::experiment::{Answer, Context, Experiment};
use camera::Camera;
use image::Image;
use std::error::Error;
use tetflip::check::check;
use tetflip::exchange::Plc;
use tetflip::generate::{Kind, generate};

/// The question and its cost.
pub const EXPERIMENT: Experiment = Experiment {
    name: "models",
    question: "what the generated models look like",
    seconds: 2,
    run,
};

/// One model.
struct Pictured {
    kind: Kind,
    facets: usize,
    conflicts: usize,
    ink: f64,
}

fn run(context: &Context) -> Result<Answer, Box<dyn Error>> {
    let width = if context.quick { 60 } else { 240 };
    let directory = context.results.directory().join("models");
    std::fs::create_dir_all(&directory)?;
    let (mut files, mut rows) = (Vec::new(), Vec::new());
    for kind in Kind::ALL {
        let plc = generate(kind, 1, size(kind));
        let image = draw(&plc, in_box(kind), width);
        let path = directory.join(format!("{kind}.png"));
        image.write(&path)?;
        files.push(path);
        rows.push(Pictured {
            kind,
            facets: plc.facets.len(),
            conflicts: check(&plc, Some(1)).conflicts.len(),
            ink: image.ink(),
        });
    }
    let checks: [Check<Pictured>; 2] = [
        ("every model is valid", &|r| r.conflicts == 0),
        ("every picture shows something", &|r| {
            (0.02..0.98).contains(&r.ink)
        }),
    ];
    let lines = rows
        .iter()
        .map(|r| format!("{}: {} facets\n", r.kind, r.facets));
    Ok(Answer {
        text: lines.collect(),
        files,
        expectations: check_rows(&rows, &checks, |r| r.kind.to_string()),
    })
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
