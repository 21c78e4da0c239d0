//! One input: all programs in turns.

use super::plan::{Files, Input, Kind};
use super::row::Row;
use crate::measure::outcome;
use crate::measure::sample::{median, minimum, rounded};
use crate::rivals::contestant::{Contestant, Ours};
use crate::rivals::process::{Ran, run};
use std::time::Duration;
use tetflip::lab::tetgen::{Figures, Switches, figures, number_after};

const TETGEN16: &str = include_str!("../../rivals/tetgen16.py");
const HXT: &str = include_str!("../../rivals/hxt.py");

/// One row for each program that takes part.
pub fn measure(
    input: &Input,
    files: &Files,
    programs: &[Contestant],
    rounds: usize,
    limit: Duration,
) -> Vec<Row> {
    let part = programs.iter().filter(|p| input.is_for(p, files));
    let part: Vec<&Contestant> = part.collect();
    let mut runs: Vec<Vec<(Option<Figures>, Ran)>> = vec![Vec::new(); part.len()];
    for round in 0..rounds {
        for i in 0..part.len() {
            let i = (round + i) % part.len();
            // Who has failed fails again.
            if runs[i].first().is_none_or(|(figures, _)| figures.is_some()) {
                runs[i].push(once(part[i], files, limit));
            }
        }
    }
    let rows = part.iter().zip(&runs);
    rows.map(|(contestant, runs)| row(input, files, contestant, runs))
        .collect()
}

fn once(contestant: &Contestant, files: &Files, limit: Duration) -> (Option<Figures>, Ran) {
    let path = files.path.to_string_lossy().into_owned();
    match contestant {
        Contestant::Ours(what, threads) => {
            let this = std::env::current_exe().unwrap_or_default();
            let threads = threads.to_string();
            let arguments = [
                "contestant".to_string(),
                what.word().to_string(),
                path,
                threads,
            ];
            let ran = run(&this.to_string_lossy(), &arguments, limit);
            (of_ours(&ran), ran)
        }
        Contestant::TetGen { program, .. } => {
            let facets = files.facets > 0;
            let switches = Switches {
                facets,
                writes: false,
                ..Switches::CAVITY
            };
            let ran = run(program, &[switches.to_string(), path], limit);
            (figures(&ran.text).filter(|_| ran.ok), ran)
        }
        Contestant::TetGen16 { python, .. } => {
            // It makes a CDT only with D; without, it looks for any tetrahedralization that has the facets.
            let switches = if files.facets > 0 { "pDcO0NEF" } else { "NEF" };
            let arguments = ["-c", TETGEN16, &path, switches].map(str::to_string);
            let ran = run(python, &arguments, limit);
            let figures = figures(&ran.text).filter(|_| ran.ok);
            // As below.
            let ran = Ran {
                peak_mebibytes: None,
                ..ran
            };
            (figures, ran)
        }
        Contestant::Hxt {
            python, threads, ..
        } => {
            let arguments = ["-c".to_string(), HXT.to_string(), path, threads.to_string()];
            let ran = run(python, &arguments, limit);
            let figures = of_hxt(&ran);
            // The memory is Python's rather than HXT's.
            let ran = Ran {
                peak_mebibytes: None,
                ..ran
            };
            (figures, ran)
        }
    }
}

fn of_ours(ran: &Ran) -> Option<Figures> {
    let after = |heading| number_after(&ran.text, heading);
    Some(Figures {
        seconds: after("seconds:").filter(|_| ran.ok)?,
        polygon_seconds: after("polygons:"),
        wall: after("wall:"),
        tetrahedra: after("tetrahedra:")? as usize,
        steiner_points: after("steiner:").map(|n| n as usize),
    })
}

fn of_hxt(ran: &Ran) -> Option<Figures> {
    let after = |heading| number_after(&ran.text, heading);
    Some(Figures {
        seconds: after("CPU").filter(|_| ran.ok)?,
        polygon_seconds: None,
        wall: after("(Wall"),
        tetrahedra: after("tetrahedra:")? as usize,
        steiner_points: None,
    })
}

fn row(
    input: &Input,
    files: &Files,
    contestant: &Contestant,
    runs: &[(Option<Figures>, Ran)],
) -> Row {
    let good: Vec<&Figures> = runs.iter().filter_map(|(f, _)| f.as_ref()).collect();
    let of = |field: fn(&Figures) -> Option<f64>| -> Vec<f64> {
        good.iter().filter_map(|f| field(f)).collect()
    };
    let seconds = of(|f| Some(f.seconds));
    let peaks = runs.iter().filter_map(|(_, ran)| ran.peak_mebibytes);
    let peaks: Vec<f64> = peaks.collect();
    let all_ok = good.len() == runs.len();
    Row {
        input: input.name.clone(),
        kind: input.kind.word(),
        generic: input.kind == Kind::Points { generic: true },
        vertices: files.vertices,
        facets: files.facets,
        program: contestant.name(),
        method: contestant.method(),
        is_ours: matches!(contestant, Contestant::Ours(..)),
        verifies: matches!(contestant, Contestant::Ours(Ours::Verifier, _)),
        version: contestant.version(),
        threads: contestant.threads(),
        runs: runs.len(),
        outcome: if all_ok { outcome::OK } else { "failed" },
        seconds: median(&seconds).map(rounded),
        min_seconds: minimum(&seconds).map(rounded),
        polygon_seconds: median(&of(|f| f.polygon_seconds)).map(rounded),
        wall_seconds: median(&of(|f| f.wall)).map(rounded),
        peak_mebibytes: median(&peaks).map(rounded),
        tetrahedra: good.first().map(|f| f.tetrahedra),
        steiner_points: good.first().and_then(|f| f.steiner_points),
        ..Row::default()
    }
}
