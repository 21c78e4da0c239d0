//! One input: rounds of deletions and insertions.

use super::Row;
use crate::inputs::slab::Slab;
use crate::inputs::suite::Model;
use crate::measure::outcome;
use crate::measure::sample::{median, rounded};
use std::time::Instant;
use tetflip::cdt::{Cdt, Options};
use tetflip::error::Failure;
use tetflip::exchange::Plc;
use tetflip::mesh::{TetMesh, VertexId};
use tetflip::recover::polygons::{FlipOrder, Insertion};
use tetflip::report::Report;

/// How many polygons of a model are updated.
pub const MOST_POLYGONS: usize = 300;

const FLIPS: Insertion = Insertion::Flip(FlipOrder::FILTERED);

/// What is updated.
pub enum Input {
    /// The scene of Fig. 8 with about so many crossing tetrahedra.
    Scene(u64),
    /// A model.
    Model(Model),
}

impl Input {
    /// For tables and messages.
    pub fn name(&self) -> String {
        match self {
            Input::Scene(crossing) => format!("slab/{crossing}"),
            Input::Model(model) => model.name.clone(),
        }
    }

    fn source(&self) -> &'static str {
        match self {
            Input::Scene(_) => "scene",
            Input::Model(model) => model.source,
        }
    }

    /// The complex, if it can be read.
    fn plc(&self) -> Option<Plc> {
        match self {
            Input::Scene(crossing) => Some(Slab::crossing(*crossing).plc()),
            Input::Model(model) => model.plc().ok(),
        }
    }
}

/// Of one round.
#[derive(Default)]
struct Round {
    /// Both deletions of each polygon.
    delete: f64,
    cavity: f64,
    flips: f64,
    refused: usize,
    crossing_tets: u64,
    insertion_flips: u64,
    deletion_flips: u64,
}

/// The row; none for a file that cannot be read.
pub fn measure(input: &Input, seconds: f64) -> Option<Row> {
    let plc = input.plc()?;
    let row = Row {
        source: input.source(),
        model: input.name(),
        vertices: plc.vertices.len(),
        ..Row::default()
    };
    let is_scene = matches!(input, Input::Scene(_));
    let measured = updated(&plc, row.clone(), seconds, is_scene);
    Some(measured.unwrap_or_else(|failure| Row {
        outcome: outcome::word::<()>(&Err(failure)),
        ..row
    }))
}

/// The row of an input with facets; `scene` if there is one polygon alone.
fn updated(plc: &Plc, row: Row, seconds: f64, scene: bool) -> Result<Row, Failure> {
    let mut report = Report::default();
    let start = Instant::now();
    let mut cdt = Cdt::begin(plc, &Options::default(), &mut report)?;
    let before = scene.then(|| tets(cdt.mesh()));
    cdt.insert_polygons(Insertion::Cavity, &mut report, &mut |_| ())?;
    let build = start.elapsed().as_secs_f64();
    let first = tets(cdt.mesh());

    let polygons = cdt.complex().polygons.len();
    let stride = polygons.div_ceil(MOST_POLYGONS).max(1);
    let chosen: Vec<usize> = (0..polygons).step_by(stride).collect();
    let without_is_before = before.map(|before| {
        let mut without = cdt.clone();
        let deleted = (0..polygons).all(|f| without.delete_polygon(f).is_ok());
        deleted && tets(without.mesh()) == before
    });
    let mut rounds: Vec<Round> = Vec::new();
    let start = Instant::now();
    while rounds.is_empty() || (start.elapsed().as_secs_f64() < seconds && rounds.len() < 101) {
        rounds.push(round(&mut cdt, &chosen)?);
    }
    let median = |of: fn(&Round) -> f64| {
        let sample: Vec<f64> = rounds.iter().map(of).collect();
        median(&sample).filter(|_| !chosen.is_empty())
    };
    let (delete, cavity) = (median(|r| r.delete / 2.0), median(|r| r.cavity));
    let flips = median(|r| r.flips);
    let one = &rounds[0];
    let ratio = |a: Option<f64>, b: Option<f64>| a.zip(b).map(|(a, b)| rounded(a / b));
    let update = delete
        .zip(cavity)
        .map(|(a, b)| (a + b) / chosen.len() as f64);
    Ok(Row {
        polygons,
        updated: chosen.len(),
        not_flat: report.flattening.not_flat as usize,
        refused: one.refused,
        rounds: rounds.len(),
        crossing_tets: one.crossing_tets,
        insertion_flips: one.insertion_flips,
        deletion_flips: one.deletion_flips,
        delete_seconds: delete.map(rounded),
        cavity_seconds: cavity.map(rounded),
        flip_seconds: flips.map(rounded),
        build_seconds: Some(rounded(build)),
        delete_over_flips: ratio(delete, flips),
        update_over_build: ratio(update, Some(build)),
        outcome: outcome::OK,
        without_is_before,
        same: Some(tets(cdt.mesh()) == first),
        ..row
    })
}

/// Each polygon: deleted, inserted by a cavity, deleted, inserted by flips. One whose deletion is refused stays.
fn round(cdt: &mut Cdt, chosen: &[usize]) -> Result<Round, Failure> {
    let mut round = Round::default();
    for &f in chosen {
        for insertion in [Insertion::Cavity, FLIPS] {
            let start = Instant::now();
            let deleted = cdt.delete_polygon(f);
            let seconds = start.elapsed().as_secs_f64();
            let Ok(deleted) = deleted else {
                round.refused += 1;
                break;
            };
            round.delete += seconds;
            let start = Instant::now();
            let counts = cdt.insert_polygon(f, insertion, &mut Report::default())?;
            let seconds = start.elapsed().as_secs_f64();
            if insertion == FLIPS {
                round.flips += seconds;
                round.insertion_flips += counts.flips.flips();
                round.deletion_flips += deleted.flips.flips();
                round.crossing_tets += counts.crossing_tets;
            } else {
                round.cavity += seconds;
            }
        }
    }
    Ok(round)
}

/// The tetrahedra by their vertices, in order.
fn tets(mesh: &TetMesh) -> Vec<[VertexId; 4]> {
    let sorted = |t| {
        let mut vertices = mesh.vertices(t);
        vertices.sort_unstable();
        vertices
    };
    let mut tets: Vec<[VertexId; 4]> = mesh.finite().map(sorted).collect();
    tets.sort_unstable();
    tets
}

#[cfg(test)]
mod tests {
    use super::super::expectations;
    use super::*;
    use crate::frame::expectation::assert_each_can_fail;
    use crate::inputs::suite;

    #[test]
    fn a_scene_and_a_model_come_back() {
        let model = suite::built_in(true).swap_remove(2);
        let inputs = [Input::Model(model), Input::Scene(100)];
        let rows: Vec<Row> = inputs.iter().filter_map(|i| measure(i, 0.0)).collect();
        assert!(
            rows.iter()
                .all(|r| r.outcome == outcome::OK && r.same == Some(true))
        );
        assert!(rows[0].updated > 100);
        assert_eq!(
            (rows[1].updated, rows[1].refused, rows[1].without_is_before),
            (1, 0, Some(true))
        );
        assert!(rows[1].insertion_flips > 100 && rows[1].deletion_flips > 50);
        assert_each_can_fail(
            expectations,
            &rows,
            &[
                (&|r| r.outcome = "stuck", &[0]),
                (&|r| r.refused = 1, &[1]),
                (&|r| r.without_is_before = Some(false), &[2]),
                (&|r| r.same = Some(false), &[3]),
            ],
        );
    }
}
