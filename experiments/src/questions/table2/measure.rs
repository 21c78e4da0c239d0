//! One model, both algorithms, with the clock of the tasks on.

use super::{End, Of, Row, Run, Shares};
use crate::measure::outcome;
use crate::measure::sample::{median, rounded};
use tetflip::cdt::{Cdt, Options};
use tetflip::clock::Task;
use tetflip::error::Failure;
use tetflip::exchange::Plc;
use tetflip::recover::polygons::{FlipOrder, Insertion};
use tetflip::report::Report;

/// Two rows: cavities and flips.
pub fn measure(of: &Of, plc: &Plc, rounds: usize) -> Vec<Row> {
    let algorithms = [
        ("cavity", Insertion::Cavity),
        ("flip", Insertion::Flip(FlipOrder::FILTERED)),
    ];
    let rows = algorithms.map(|(word, insertion)| {
        let mut row = shares(plc, insertion, rounds).unwrap_or_else(|failure| {
            let end = End {
                other: None,
                outcome: outcome::word::<()>(&Err(failure)),
            };
            Row {
                end,
                ..Row::default()
            }
        });
        row.of = of.clone();
        row.run.insertion = word;
        row
    });
    rows.into()
}

fn shares(plc: &Plc, insertion: Insertion, rounds: usize) -> Result<Row, Failure> {
    let cdt = Cdt::begin(plc, &Options::default(), &mut Report::default())?;
    let mut runs = Vec::new();
    let mut run = Run::default();
    for _ in 0..rounds {
        let (mut cdt, mut report) = (cdt.clone(), Report::default());
        cdt.time_tasks();
        let counts = cdt.insert_polygons(insertion, &mut report, &mut |_| ())?;
        run.crossing_tets = Some(counts.crossing_tets);
        runs.push((report.seconds.polygons, cdt.task_seconds()));
    }
    let seconds: Vec<f64> = runs.iter().map(|r| r.0).collect();
    run.seconds = median(&seconds).map(rounded);
    let share = |task: Task| {
        let of_run = runs.iter().map(|(all, tasks)| 100.0 * tasks.of(task) / all);
        median(&of_run.collect::<Vec<f64>>()).map(rounded)
    };
    let shares = match insertion {
        Insertion::Cavity => Shares {
            cavity_delaunay: share(Task::CavityDelaunay),
            cavity_faces: share(Task::CavityFaces),
            polygon_faces: share(Task::PolygonFaces),
            merging: share(Task::Merging),
            ..Shares::default()
        },
        _ => Shares {
            queueing: share(Task::Queueing),
            flipping: share(Task::Flipping),
            ..Shares::default()
        },
    };
    let end = End {
        other: Some(rounded(100.0 - shares.sum())),
        outcome: outcome::OK,
    };
    Ok(Row {
        of: Of::default(),
        run,
        shares,
        end,
    })
}
