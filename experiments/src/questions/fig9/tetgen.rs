//! TetGen on the same scenes, where it is installed: its cavity retriangulation and its flips, which are rounded.
//!
//! Its seconds are those that it prints for the whole of segments and polygons. Each mode runs once more with its
//! output written, and the output is verified as ours is.

use super::Row as Ours;
use crate::inputs::slab::Slab;
use crate::measure::outcome;
use crate::measure::sample::{median, minimum, rounded};
use crate::rivals::process;
use serde::Serialize;
use std::time::Duration;
use tetflip::exchange::Plc;
use tetflip::lab::tetgen::{Files, Switches, figures};
use tetflip::verify::{Domain, VerifyOptions, verify};

/// What tables call the modes, and whether they are flips.
pub const MODES: [(&str, bool); 2] = [("cavity", false), ("flips", true)];

/// Its flips take quadratic time: five seconds for 15 000 crossing tetrahedra. Scenes with more vertices are left out.
const MOST_FOR_FLIPS: usize = 4500;

/// How often a mode is timed.
const ROUNDS: usize = 3;

/// One line of `fig9-tetgen.csv`: one mode in one scene.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Row {
    pub seed: u64,
    pub vertices: usize,
    pub half_height: f64,
    pub crossing_tets: u64,
    pub mode: &'static str,
    pub runs: usize,
    pub median_seconds: Option<f64>,
    pub min_seconds: Option<f64>,
    pub outcome: &'static str,
    pub tetrahedra: Option<usize>,
    pub verified: Option<bool>,
    pub ours_over_tetgen: Option<f64>,
}

impl Row {
    /// For messages.
    pub fn name(&self) -> String {
        format!(
            "{} vertices, seed {}, TetGen's {}",
            self.vertices, self.seed, self.mode
        )
    }
}

/// Both modes in turns; `ours` are the rows of the experiment, of this scene and others.
pub fn measure(program: &str, slab: Slab, ours: &[Ours], limit: Duration) -> Vec<Row> {
    let plc = slab.plc();
    let files = tempfile::tempdir()
        .ok()
        .and_then(|d| Some((Files::write(&plc, d.path()).ok()?, d)));
    let Some((files, _directory)) = files else {
        return Vec::new();
    };
    let run = |flips, writes| {
        let switches = Switches {
            flips,
            writes,
            ..Switches::CAVITY
        };
        let input = files.input().to_string_lossy().into_owned();
        process::run(program, &[switches.to_string(), input], limit)
    };
    let mut modes = MODES.to_vec();
    modes.retain(|(_, flips)| !flips || slab.vertices <= MOST_FOR_FLIPS);
    let mut rows: Vec<(Row, Vec<f64>)> = Vec::new();
    for &(mode, flips) in &modes {
        let verified = run(flips, true)
            .ok
            .then(|| verified(&files, &plc))
            .flatten();
        rows.push((
            Row {
                mode,
                verified,
                ..Row::of(slab, ours)
            },
            Vec::new(),
        ));
    }
    for _ in 0..ROUNDS {
        for ((row, seconds), &(_, flips)) in rows.iter_mut().zip(&modes) {
            let ran = run(flips, false);
            if let Some(figures) = figures(&ran.text).filter(|_| ran.ok) {
                seconds.extend(figures.polygon_seconds);
                row.tetrahedra = Some(figures.tetrahedra);
            }
        }
    }
    for (row, seconds) in &mut rows {
        let ok = seconds.len() == ROUNDS;
        row.outcome = if ok { outcome::OK } else { "failed" };
        row.runs = seconds.len();
        row.median_seconds = median(seconds).filter(|_| ok).map(rounded);
        row.min_seconds = minimum(seconds).filter(|_| ok).map(rounded);
        let times = if row.mode == "cavity" { "" } else { "filtered" };
        let beside = ours
            .iter()
            .find(|r| row.is_beside(r) && r.method.times == times);
        let ours = beside.and_then(Ours::seconds);
        row.ours_over_tetgen = ours.zip(row.median_seconds).map(|(a, b)| rounded(a / b));
    }
    rows.into_iter().map(|(row, _)| row).collect()
}

impl Row {
    /// A row that has its scene.
    fn of(slab: Slab, ours: &[Ours]) -> Row {
        let Slab {
            vertices,
            half_height,
            seed,
        } = slab;
        let mut row = Row {
            seed,
            vertices,
            half_height,
            ..Row::default()
        };
        let crossing = ours.iter().find(|r| row.is_beside(r));
        row.crossing_tets = crossing.map_or(0, |r| r.scene.crossing_tets);
        row
    }

    /// Whether one of our rows is of the same scene.
    fn is_beside(&self, ours: &Ours) -> bool {
        (self.vertices, self.seed) == (ours.scene.vertices, ours.scene.seed)
    }
}

/// How we compare and how often it fails, for people.
pub fn text(rows: &[Row]) -> String {
    let mut text = "\nBeside TetGen, median ratios of our time to its time:\n".to_string();
    for (mode, _) in MODES {
        let of_mode: Vec<&Row> = rows.iter().filter(|r| r.mode == mode).collect();
        let ratios: Vec<f64> = of_mode.iter().filter_map(|r| r.ours_over_tetgen).collect();
        let ratio = median(&ratios).map_or("–".to_string(), |r| format!("{r:.3}"));
        text += &format!("  {mode:<7} {ratio} ({} scenes)\n", of_mode.len());
        for row in of_mode {
            if row.outcome != outcome::OK || row.verified != Some(true) {
                let verdict = match row.verified {
                    None => "no mesh",
                    Some(true) => "the CDT",
                    Some(false) => "not the CDT",
                };
                text += &format!("    {}: {}, {verdict}\n", row.name(), row.outcome);
            }
        }
    }
    text
}

/// Whether what it has written is the CDT; none if it has written nothing.
fn verified(files: &Files, plc: &Plc) -> Option<bool> {
    let options = VerifyOptions {
        domain: Domain::Hull,
        ..VerifyOptions::default()
    };
    Some(verify(plc, &files.mesh().ok()?, options).is_ok())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_program_that_fails_has_rows() {
        let mut ours = Ours::default();
        (
            ours.scene.vertices,
            ours.scene.seed,
            ours.scene.crossing_tets,
        ) = (30, 1, 90);
        let measured = |vertices| {
            let slab = Slab {
                vertices,
                half_height: 0.01,
                seed: 1,
            };
            measure(
                "/no/such/program",
                slab,
                std::slice::from_ref(&ours),
                Duration::from_secs(1),
            )
        };
        let rows = measured(30);
        assert_eq!(rows.len(), 2);
        for row in rows {
            assert_eq!(
                (row.outcome, row.runs, row.crossing_tets),
                ("failed", 0, 90)
            );
            assert_eq!((row.median_seconds, row.verified), (None, None));
        }
        // Its flips are spared large scenes.
        let modes: Vec<&str> = measured(MOST_FOR_FLIPS + 1)
            .iter()
            .map(|r| r.mode)
            .collect();
        assert_eq!(modes, ["cavity"]);
    }
}
