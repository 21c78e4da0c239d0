//! Fig. 8 as a picture.
//!
//! **Question.** What does the scene of §3.4 look like: a rectangle that cuts through the Delaunay tetrahedralization of random
//! vertices, and the region of tetrahedra that it crosses?
//!
//! **Inputs.** The scene of `fig9` ([`crate::scene`]) with 45 vertices. In the picture heights are stretched.
//!
//! **Columns.** [`Row`]; the README of this package has their meaning.
//!
//! **Expected.** The rectangle has one missing region, and after its insertion nothing crosses it.

use crate::expectation::Expectation;
use crate::experiment::{Answer, Context, Experiment};
use crate::order::Trace;
use crate::picture::{POLYGON, Picture, Stage};
use crate::scene::Slab;
use serde::Serialize;
use std::error::Error;
use tetflip::cdt::Cdt;
use tetflip::exchange::Plc;
use tetflip::mesh::VertexId;
use tetflip::number::Sign;
use tetflip::predicate::PointStore;
use tetflip::recover::polygons::{Insertion, Times};
use tetflip::report::Report;

/// The figure.
pub const EXPERIMENT: Experiment = Experiment {
    name: "fig8",
    question: "the scene with its missing region, before and after (paper, Fig. 8)",
    seconds: 1,
    run,
};

const SLAB: Slab = Slab {
    vertices: 45,
    half_height: 0.01,
    seed: 1,
};

/// `fig8.csv`: what the picture shows.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    vertices: usize,
    seed: u64,
    regions: u64,
    crossing_tets: u64,
    tetrahedra_after: usize,
    crossing_after: usize,
}

fn run(context: &Context) -> Result<Answer, Box<dyn Error>> {
    let plc = SLAB.plc();
    let (mut report, mut trace) = (Report::default(), Trace::default());
    let mut cdt = Cdt::with_segments(&plc, true, &mut report)
        .map_err(|failure| failure.describe(&plc).to_string())?;
    let before = cdt.clone();
    let insertion = Insertion::Flip(Times::Filtered);
    let counts = cdt
        .insert_polygons_watched(insertion, &mut report, &mut |_| (), Some(&mut trace))
        .map_err(|failure| failure.describe(&plc).to_string())?;
    let region = trace.insertions.first().ok_or("the rectangle was there")?;
    let after = region.end.as_ref().map(|(_, tets)| tets.clone());
    let after = after.ok_or("the insertion has not ended")?;
    let side = |v: u32| side(&before, region.frame, v);
    let crosses = |tet: &[VertexId; 4]| {
        let has = |wanted| tet.iter().any(|v| side(v.0) == wanted);
        has(1) && has(-1)
    };
    let rows = [Row {
        vertices: plc.vertices.len(),
        seed: SLAB.seed,
        regions: counts.regions,
        crossing_tets: counts.crossing_tets,
        tetrahedra_after: after.len(),
        crossing_after: after.iter().filter(|t| crosses(t)).count(),
    }];
    let results = &context.results;
    let files = vec![
        context.record("fig8", &rows)?,
        results.text(
            "fig8.svg",
            &picture(&plc, &before, region.frame, &region.before, "before"),
        )?,
        results.text(
            "fig8-after.svg",
            &picture(&plc, &before, region.frame, &after, "after"),
        )?,
    ];
    let [row] = &rows;
    let is = |holds: bool| {
        if holds {
            Vec::new()
        } else {
            vec![format!("{row:?}")]
        }
    };
    Ok(Answer {
        text: format!(
            "{} vertices; {} tetrahedra cross the rectangle, {} fill their place afterwards",
            row.vertices, row.crossing_tets, row.tetrahedra_after
        ),
        files,
        expectations: vec![
            Expectation {
                statement: "the rectangle has one missing region",
                broken_by: is(row.regions == 1 && row.crossing_tets > 0),
            },
            Expectation {
                statement: "nothing crosses it afterwards",
                broken_by: is(row.crossing_after == 0),
            },
        ],
    })
}

fn side(cdt: &Cdt, [a, b, c]: [VertexId; 3], v: u32) -> i8 {
    match cdt.points.orient3d([a, b, c, VertexId(v)]) {
        Sign::Positive => 1,
        Sign::Negative => -1,
        Sign::Zero => 0,
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
    picture.tetrahedra(&tets, |v| stage.spot(at(v)), |v| side(cdt, frame, v), false);
    let caption = format!(
        "{} random vertices and a rectangle, {when} its insertion:\nthe {} tetrahedra of the missing region. Red edges cross\nthe rectangle; heights are stretched.",
        SLAB.vertices,
        tets.len()
    );
    picture.svg(
        "Fig. 8: inserting a rectangle into a Delaunay tetrahedralization",
        &caption,
    )
}
