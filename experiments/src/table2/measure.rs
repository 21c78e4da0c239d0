//! One model, both algorithms, with the clock of the tasks on.

use super::Row;
use crate::outcome;
use crate::sample::{median, rounded};
use tetflip::cdt::{Cdt, Options};
use tetflip::clock::Task;
use tetflip::error::Failure;
use tetflip::exchange::Plc;
use tetflip::recover::polygons::{Insertion, Times};
use tetflip::report::Report;

/// Scenes of `fig9` with about so many crossing tetrahedra.
pub fn scenes(quick: bool) -> Vec<(String, Plc)> {
    let sizes: &[u64] = if quick { &[300] } else { &[1000, 30_000] };
    let scene = |&size: &u64| (format!("slab/{size}"), crate::growth::slab(size).plc());
    sizes.iter().map(scene).collect()
}

/// Two rows: cavities and flips.
pub fn measure(
    name: &str,
    source: &'static str,
    beside: &'static str,
    plc: &Plc,
    rounds: usize,
) -> Vec<Row> {
    let algorithms = [
        ("cavity", Insertion::Cavity),
        ("flip", Insertion::Flip(Times::Filtered)),
    ];
    let rows = algorithms.into_iter().map(|(word, insertion)| {
        let row = Row {
            source,
            model: name.to_string(),
            beside,
            insertion: word,
            ..Row::default()
        };
        match shares(plc, insertion, rounds, row.clone()) {
            Ok(row) => row,
            Err(failure) => Row {
                outcome: outcome::word::<()>(&Err(failure)),
                ..row
            },
        }
    });
    rows.collect()
}

fn shares(plc: &Plc, insertion: Insertion, rounds: usize, row: Row) -> Result<Row, Failure> {
    let cdt = Cdt::begin(plc, &Options::default(), &mut Report::default())?;
    let mut runs = Vec::new();
    let mut crossing = 0;
    for _ in 0..rounds {
        let (mut cdt, mut report) = (cdt.clone(), Report::default());
        cdt.time_tasks();
        let counts = cdt.insert_polygons(insertion, &mut report, &mut |_| ())?;
        crossing = counts.crossing_tets;
        runs.push((report.seconds.polygons, cdt.task_seconds()));
    }
    let seconds: Vec<f64> = runs.iter().map(|r| r.0).collect();
    let share = |task: Task| {
        let sample: Vec<f64> = runs
            .iter()
            .map(|(all, tasks)| 100.0 * tasks.of(task) / all)
            .collect();
        median(&sample).map(rounded)
    };
    let mut row = Row {
        crossing_tets: Some(crossing),
        seconds: median(&seconds).map(rounded),
        outcome: outcome::OK,
        ..row
    };
    if insertion == Insertion::Cavity {
        row.cavity_delaunay = share(Task::CavityDelaunay);
        row.cavity_faces = share(Task::CavityFaces);
        row.polygon_faces = share(Task::PolygonFaces);
        row.merging = share(Task::Merging);
    } else {
        row.queueing = share(Task::Queueing);
        row.flipping = share(Task::Flipping);
    }
    let tasks = [
        row.cavity_delaunay,
        row.cavity_faces,
        row.polygon_faces,
        row.merging,
        row.queueing,
        row.flipping,
    ];
    let known: f64 = tasks.into_iter().flatten().sum();
    row.other = Some(rounded(100.0 - known));
    Ok(row)
}
