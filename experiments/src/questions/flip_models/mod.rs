//! Rounded flip times on models.
//!
//! **Question.** How often do flips with rounded times fail on models as people make them: of how many missing regions
//! of polygons, and of how many models? How many regions have ties that the perturbation alone decides?
//!
//! **Inputs.** The generated models of Table 1, small ones of every kind and several seeds, and those of a directory of
//! the user's, in every format that is read.
//!
//! **Columns.** [`row::Row`], [`row::Summary`]; the README of this package has their meaning.
//!
//! **Expected.** The exact orders insert every region without a patch, and cavities end in the same tetrahedra;
//! asserted at the end. Rounded times may fail.

mod measure;
mod row;
mod trial;

use crate::frame::{About, Answer, Context, Experiment, Failed};
use crate::inputs::suite::{self, Model};
use crate::questions::flip_order::plan::{DOUBLES, PERTURBED, by_perturbation};
use std::path::Path;
use tetflip::format::read_plc;
use tetflip::recover::polygons::{FlipOrder, NumberType};

/// The question.
pub struct FlipModels;

/// How many arms there are.
#[cfg(test)]
const ARMS: usize = 9;

/// The arms that `flip_order` runs on all its inputs, and single precision.
fn arms() -> Vec<FlipOrder> {
    let mut arms = vec![FlipOrder::FILTERED, FlipOrder::EXACT];
    arms.extend(DOUBLES.map(FlipOrder::new));
    arms.extend(PERTURBED.map(by_perturbation));
    arms.push(FlipOrder::new(NumberType::F32));
    arms
}

impl Experiment for FlipModels {
    fn about(&self) -> About {
        About {
            name: "flip_models",
            question: "how often flips with rounded times fail on models, by region and by model",
            seconds: 60,
        }
    }

    fn run(&self, context: &Context) -> Result<Answer, Failed> {
        let mut models = suite::built_in(context.quick);
        models.extend(suite::small(context.quick));
        let mut skipped = Vec::new();
        if let Some(directory) = &context.models {
            models.extend(of_directory(directory, &mut skipped)?);
        }
        let arms = arms();
        let measure = |model: &Model| measure::measure(model, &arms);
        let rows: Vec<row::Row> = context
            .measure_on_all_processors(&models, measure)
            .into_iter()
            .flatten()
            .collect();
        let mut answer = context.answer();
        answer.csv("flip_models", &rows, "")?;
        let shown = "source times models regions tied_regions patched_regions failed_regions failed_tied failed_models";
        answer.csv("flip_models-summary", &row::summaries(&rows, &arms), shown)?;
        for what in skipped {
            answer.say(format!("skipped: {what}"));
        }
        answer.expectations = row::expectations(&rows);
        Ok(answer)
    }
}

/// The files of a directory that are PLCs with facets, in order of name; the others are named, but for those in no
/// format that is read.
fn of_directory(directory: &Path, skipped: &mut Vec<String>) -> Result<Vec<Model>, Failed> {
    let mut paths: Vec<_> = std::fs::read_dir(directory)?
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.is_file())
        .collect();
    paths.sort();
    let mut models = Vec::new();
    for path in paths {
        match read_plc(&path) {
            Ok((plc, _)) if !plc.facets.is_empty() => models.push(Model::of_file(path)),
            Ok(_) => skipped.push(format!("{}: no facets", path.display())),
            Err(error) => skipped.push(format!("{}: {error}", path.display())),
        }
    }
    Ok(models)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arms_are_different() {
        let mut names: Vec<String> = arms().iter().map(FlipOrder::to_string).collect();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), ARMS);
    }
}
