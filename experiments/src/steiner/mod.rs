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
pub mod rival;
mod row;

use crate::experiment::{Answer, Context, Experiment};
use crate::suite;
use families::Model;
use rival::{Rival, SWITCHES};
use row::Row;
use std::error::Error;
use std::path::{Path, PathBuf};
use tetflip::format::read_plc;

/// The column `source` of the built-in families.
const BUILT_IN: &str = "built-in";

/// The column `source` of the generated models, those of `table1`.
const GENERATED: &str = "generated";

/// The question and its cost.
pub const EXPERIMENT: Experiment = Experiment {
    name: "steiner",
    question: "Steiner points that segments need, on small angles and on models, here and elsewhere",
    seconds: 15,
    run,
};

fn run(context: &Context) -> Result<Answer, Box<dyn Error>> {
    let tetgen = context.tetgen.iter().map(|program| Rival {
        name: "tetgen".to_string(),
        program: program.clone(),
        switches: SWITCHES.to_string(),
    });
    let rivals: Vec<Rival> = tetgen.chain(context.rivals.iter().cloned()).collect();
    let mut sources = vec![
        (BUILT_IN, families::models(context.quick)),
        (GENERATED, generated(context.quick)?),
    ];
    if let Some(directory) = &context.models {
        sources.push(("models", read_models(directory)?));
    }
    let models = sources.iter().map(|(_, models)| models.len() as u64);
    let bar = context.bar(models.sum());
    let mut rows: Vec<Row> = Vec::new();
    for (source, models) in &sources {
        for model in models {
            bar.set_message(model.name.clone());
            rows.extend(measure::measure(source, model, &rivals, context.limit));
            bar.inc(1);
        }
    }
    bar.finish_and_clear();
    let summaries = row::summaries(&rows);
    Ok(Answer {
        text: row::table(&rows, &summaries),
        files: vec![
            context.record("steiner", &rows)?,
            context.record("steiner-summary", &summaries)?,
        ],
        expectations: expect::expectations(&rows),
    })
}

fn generated(quick: bool) -> Result<Vec<Model>, Box<dyn Error>> {
    let models = suite::built_in(quick).into_iter().map(|model| {
        Ok(Model {
            plc: model.plc()?,
            name: model.name,
        })
    });
    models.collect()
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
            plc: read_plc(path).ok()?.0,
        })
    };
    Ok(paths.iter().filter_map(model).collect())
}
