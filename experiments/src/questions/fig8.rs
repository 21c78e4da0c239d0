//! Fig. 8 as a picture.
//!
//! **Question.** What does the scene of §3.4 look like: a rectangle that cuts through the Delaunay tetrahedralization
//! of random vertices, and the region of tetrahedra that it crosses?
//!
//! **Inputs.** The scene of `fig9` ([`crate::inputs::slab`]) with 45 vertices. In the picture heights are stretched.
//!
//! **Columns.** [`Row`]; the README of this package has their meaning.
//!
//! **Expected.** The rectangle has one missing region, and after its insertion nothing crosses it.

use crate::flips::order::Trace;
use crate::frame::{About, Answer, Context, Experiment, Failed, check_rows};
use crate::inputs::slab::Slab;
use crate::pictures::picture::{POLYGON, Picture, Stage, side};
use serde::Serialize;
use tetflip::cdt::Cdt;
use tetflip::error::Failure;
use tetflip::exchange::Plc;
use tetflip::mesh::VertexId;
use tetflip::recover::polygons::{FlipOrder, Insertion};
use tetflip::report::Report;

/// The figure.
pub struct Fig8;

const SLAB: Slab = Slab {
    vertices: 45,
    half_height: 0.01,
    seed: 1,
};

/// `fig8.csv`: what the picture shows.
#[derive(Clone, Debug, Serialize)]
struct Row {
    vertices: usize,
    seed: u64,
    regions: u64,
    crossing_tets: u64,
    tetrahedra_after: usize,
    crossing_after: usize,
}

impl Experiment for Fig8 {
    fn about(&self) -> About {
        About {
            name: "fig8",
            question: "the scene with its missing region, before and after (paper, Fig. 8)",
            seconds: 1,
        }
    }

    fn run(&self, context: &Context) -> Result<Answer, Failed> {
        let plc = SLAB.plc();
        let (mut report, mut trace) = (Report::default(), Trace::default());
        let described = |failure: Failure| failure.describe(&plc).to_string();
        let mut cdt = Cdt::with_segments(&plc, true, &mut report).map_err(described)?;
        let before = cdt.clone();
        let insertion = Insertion::Flip(FlipOrder::FILTERED);
        let counts = cdt
            .insert_polygons_observed(insertion, &mut report, &mut |_| (), Some(&mut trace))
            .map_err(described)?;
        let region = trace.insertions.first().ok_or("the rectangle was there")?;
        let (_, after) = region.end.as_ref().ok_or("the insertion has not ended")?;
        let crosses = |tet: &&[VertexId; 4]| {
            let sides = tet.map(|v| side(before.points(), region.frame, v.0));
            sides.contains(&1) && sides.contains(&-1)
        };
        let row = Row {
            vertices: plc.vertices.len(),
            seed: SLAB.seed,
            regions: counts.regions,
            crossing_tets: counts.crossing_tets,
            tetrahedra_after: after.len(),
            crossing_after: after.iter().filter(crosses).count(),
        };
        let mut answer = context.answer();
        answer.csv(
            "fig8",
            &[&row],
            "vertices crossing_tets tetrahedra_after crossing_after",
        )?;
        let picture = |tets, when| picture(&plc, &before, region.frame, tets, when);
        answer.file("fig8.svg", &picture(&region.before, "before"))?;
        answer.file("fig8-after.svg", &picture(after, "after"))?;
        answer.expectations = check_rows(
            &[row],
            |r| format!("{r:?}"),
            &[
                ("the rectangle has one missing region", &|r| {
                    r.regions == 1 && r.crossing_tets > 0
                }),
                ("nothing crosses it afterwards", &|r| r.crossing_after == 0),
            ],
        );
        Ok(answer)
    }
}

fn picture(
    plc: &Plc,
    cdt: &Cdt,
    frame: [VertexId; 3],
    tets: &[[VertexId; 4]],
    when: &str,
) -> String {
    let at = |v: u32| plc.vertices[v as usize];
    let stage = Stage::new(frame.map(|v| at(v.0)), &plc.vertices);
    let corners: Vec<_> = plc.facets[0].polygons[0]
        .iter()
        .map(|v| stage.spot(at(v.0)))
        .collect();
    let mut picture = Picture::default();
    picture.face(&corners, POLYGON, 0.55);
    let tets: Vec<[u32; 4]> = tets.iter().map(|t| t.map(|v| v.0)).collect();
    picture.tetrahedra(
        &tets,
        |v| stage.spot(at(v)),
        |v| side(cdt.points(), frame, v),
        false,
    );
    let caption = format!(
        "{} random vertices and a rectangle, {when} its insertion:\nthe {} tetrahedra of the missing region. Red \
         edges cross\nthe rectangle; heights are stretched.",
        SLAB.vertices,
        tets.len()
    );
    picture.svg(
        "Fig. 8: inserting a rectangle into a Delaunay tetrahedralization",
        &caption,
    )
}
