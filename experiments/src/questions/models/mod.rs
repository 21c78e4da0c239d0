//! Pictures of the generated models.
//!
//! **Question.** What do the models of [`tetflip::generate`] look like?
//!
//! **Inputs.** One model of each kind, with a size that still shows its facets.
//!
//! **Results.** `models/KIND.png`, in grey: facets by their angle to the light, the nearest at every pixel, and their
//! edges. Of models in a box, or with much inside, what lies on the bounding box is drawn as lines.
//!
//! **Expected.** Every model is valid ([`tetflip::check`]), and every picture shows it: neither blank nor full.

mod camera;
mod image;

use crate::frame::{About, Answer, Context, Experiment, Failed, check_rows};
use camera::Camera;
use image::Image;
use tetflip::check::check;
use tetflip::exchange::Plc;
use tetflip::generate::{Kind, generate};
use tetflip::mesh::VertexId;

/// The question.
pub struct Models;

/// One model.
struct Pictured {
    kind: Kind,
    conflicts: usize,
    ink: f64,
}

impl Experiment for Models {
    fn about(&self) -> About {
        About {
            name: "models",
            question: "what the generated models look like",
            seconds: 2,
        }
    }

    fn run(&self, context: &Context) -> Result<Answer, Failed> {
        let width = if context.quick { 60 } else { 240 };
        let directory = context.results.directory().join("models");
        std::fs::create_dir_all(&directory)?;
        let mut answer = context.answer();
        let mut rows = Vec::new();
        for kind in Kind::ALL {
            let plc = generate(kind, 1, size(kind));
            let image = draw(&plc, in_box(kind), width);
            let path = directory.join(format!("{kind}.png"));
            image.write(&path)?;
            answer.files.push(path);
            answer.say(format!("{kind}: {} facets", plc.facets.len()));
            let conflicts = check(&plc, Some(1)).conflicts.len();
            rows.push(Pictured {
                kind,
                conflicts,
                ink: image.ink(),
            });
        }
        answer.expectations = check_rows(
            &rows,
            |r| r.kind.to_string(),
            &[
                ("every model is valid", &|r| r.conflicts == 0),
                ("every picture shows something", &|r| {
                    (0.02..0.98).contains(&r.ink)
                }),
            ],
        );
        Ok(answer)
    }
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
    let corners = |polygon: &Vec<VertexId>| -> Vec<[f64; 3]> {
        polygon.iter().map(|v| plc.vertices[v.index()]).collect()
    };
    for facet in &plc.facets {
        let polygons: Vec<Vec<[f64; 3]>> = facet.polygons.iter().map(corners).collect();
        if !(in_box && camera.is_side(&polygons[0])) {
            image.fill(&polygons.iter().map(|p| camera.view(p)).collect::<Vec<_>>());
        }
    }
    for polygon in plc.facets.iter().flat_map(|f| &f.polygons) {
        let seen = camera.view(&corners(polygon));
        for i in 0..seen.len() {
            image.line(seen[i], seen[(i + 1) % seen.len()]);
        }
    }
    image
}
