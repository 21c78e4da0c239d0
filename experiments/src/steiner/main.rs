//! How many Steiner points the segments need.
//!
//! **Question.** How many Steiner points does segment recovery insert, on small angles and on models, compared with other
//! programs, and how many of them lie exactly on their segment?
//!
//! **Inputs.** Built-in families with small angles ([`families`]); with `--models DIR` every model of a directory.
//!
//! **Columns.** [`row::Row`], [`row::Summary`]; the README of this package has their meaning.
//!
//! **Expected.** Recovery ends on all built-in models, and every mesh is verified ([`expect`]); asserted at the end.

mod expect;
mod families;
mod measure;
mod rival;
mod row;

use clap::Parser;
use families::Model;
use rival::{Rival, SWITCHES};
use row::Row;
use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;
use tetflip::format::read_plc;
use tetflip_experiments::expectation::{self, Expectation};
use tetflip_experiments::record::{Machine, Results};

/// The column `source` of the built-in families.
const BUILT_IN: &str = "built-in";

/// Steiner points on segments, here and elsewhere.
#[derive(Parser)]
struct Arguments {
    /// Only small models of the built-in families.
    #[arg(long)]
    quick: bool,
    /// Where the results go. [default: results, or target/quick-results with --quick]
    #[arg(long, value_name = "DIR")]
    results: Option<PathBuf>,
    /// Every .poly, .smesh, .off and .stl of this directory, too.
    #[arg(long, value_name = "DIR")]
    models: Option<PathBuf>,
    /// TetGen, to compare with.
    #[arg(long, value_name = "PROGRAM")]
    tetgen: Option<String>,
    /// More programs that take TetGen's switches and files.
    #[arg(long, value_name = "NAME=PROGRAM[:SWITCHES]")]
    rival: Vec<Rival>,
    /// How long another program may take for one model.
    #[arg(long, value_name = "SECONDS", default_value_t = 60)]
    limit: u64,
    /// Do not insert polygons and verify the meshes.
    #[arg(long)]
    segments_only: bool,
}

fn main() -> ExitCode {
    match run(Arguments::parse()) {
        Ok(code) => code,
        Err(error) => {
            eprintln!("steiner: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: Arguments) -> Result<ExitCode, Box<dyn Error>> {
    let default = if arguments.quick {
        "target/quick-results"
    } else {
        "results"
    };
    let directory = arguments.results.unwrap_or_else(|| default.into());
    let tetgen = arguments.tetgen.map(|program| Rival {
        name: "tetgen".to_string(),
        program,
        switches: SWITCHES.to_string(),
    });
    let rivals: Vec<Rival> = tetgen.into_iter().chain(arguments.rival).collect();
    let mut sources = vec![(BUILT_IN, families::models(arguments.quick))];
    if let Some(directory) = &arguments.models {
        sources.push(("models", read_models(directory)?));
    }

    let commit = Machine::detect().commit;
    let results = Results::create(&directory)?;
    let limit = Duration::from_secs(arguments.limit);
    let mut rows: Vec<Row> = Vec::new();
    for (source, models) in &sources {
        for model in models {
            let with_mesh = !arguments.segments_only;
            rows.extend(measure::measure(source, model, &rivals, limit, with_mesh));
        }
    }
    for row in &mut rows {
        row.commit.clone_from(&commit);
    }
    let summaries = row::summaries(&rows, &commit);
    let paths = [
        results.rows("steiner", &rows)?,
        results.rows("steiner-summary", &summaries)?,
    ];
    println!("{}", row::table(&rows, &summaries));
    for path in paths {
        println!("{}", path.display());
    }
    let expectations = expect::expectations(&rows);
    print!("\n{}", expectation::text(&expectations));
    Ok(if expectations.iter().all(Expectation::holds) {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    })
}

/// The models of a directory, in order of name; files that are no PLC are left out.
fn read_models(directory: &Path) -> Result<Vec<Model>, std::io::Error> {
    let mut paths: Vec<PathBuf> = std::fs::read_dir(directory)?
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| {
            let extension = path.extension().unwrap_or_default();
            ["poly", "smesh", "off", "stl"]
                .iter()
                .any(|&e| extension == e)
        })
        .collect();
    paths.sort();
    let model = |path: &PathBuf| {
        Some(Model {
            name: path.file_name()?.to_string_lossy().into_owned(),
            plc: read_plc(path).ok()?,
        })
    };
    Ok(paths.iter().filter_map(model).collect())
}
