//! The models of Tables 1 and 2: generated ones of the paper's kinds and sizes, larger ones, and those of the user's.

use crate::frame::Context;
use std::path::{Path, PathBuf};
use tetflip::exchange::Plc;
use tetflip::format::read_plc;
use tetflip::generate::{Kind, generate};

/// One model.
#[derive(Clone, Debug)]
pub struct Model {
    /// What tables call it: `KIND/SEED/SIZE`, or the name of a file.
    pub name: String,
    /// `generated` or `models`.
    pub source: &'static str,
    /// The column of the paper's Table 1 that it stands beside: the same model, or one made after its kind and size.
    pub beside: &'static str,
    recipe: Recipe,
}

#[derive(Clone, Debug)]
enum Recipe {
    Generated(Kind, u64, usize),
    File(PathBuf),
}

/// After the paper's columns: kind, seed, facets.
const PAPERS: [(&str, Kind, u64, usize); 8] = [
    ("DEMO04", Kind::Crankcase, 4, 2372),
    ("DEMO05", Kind::Crankcase, 5, 2280),
    ("anc101", Kind::Bracket, 101, 2772),
    ("monster4", Kind::Part, 4, 2784),
    ("mohne-a", Kind::Gear, 1, 5560),
    ("thru-mazewheel", Kind::Maze, 1, 5622),
    ("cognit", Kind::Star, 1, 5792),
    ("nasty_cheese", Kind::Cheese, 1, 17_782),
];

/// Other kinds, and larger ones.
const OTHERS: [(Kind, u64, usize); 10] = [
    (Kind::Bend, 1, 600),
    (Kind::Shaft, 1, 4000),
    (Kind::Cells, 1, 4000),
    (Kind::Terrain, 1, 6000),
    (Kind::Schoenhardt, 1, 800),
    (Kind::Chazelle, 1, 60),
    (Kind::Sponge, 1, 5000),
    (Kind::Knot, 1, 5000),
    (Kind::Confetti, 1, 2000),
    (Kind::Terrain, 2, 60_000),
];

/// The built-in models; with `quick`, those after the paper's columns, but a tenth as large.
pub fn built_in(quick: bool) -> Vec<Model> {
    let model = |beside, kind: Kind, seed, size| Model {
        name: format!("{kind}/{seed}/{size}"),
        source: "generated",
        beside,
        recipe: Recipe::Generated(kind, seed, size),
    };
    let papers = PAPERS.into_iter();
    let divisor = if quick { 10 } else { 1 };
    let papers = papers.map(|(beside, kind, seed, size)| model(beside, kind, seed, size / divisor));
    let others = OTHERS.into_iter().filter(|_| !quick);
    let others = others.map(|(kind, seed, size)| model("", kind, seed, size));
    papers.chain(others).collect()
}

/// Small models of every kind, with several seeds; with `quick`, one seed.
pub fn small(quick: bool) -> Vec<Model> {
    let (seeds, size) = (if quick { 1..=1 } else { 1..=10 }, 60);
    let of_kind = |kind: Kind| {
        // Chazelle's polyhedron needs quadratically many Steiner points.
        let size = if kind == Kind::Chazelle {
            size / 10
        } else {
            size
        };
        seeds.clone().map(move |seed| Model {
            name: format!("{kind}/{seed}/{size}"),
            source: "generated",
            beside: "",
            recipe: Recipe::Generated(kind, seed, size),
        })
    };
    Kind::ALL.into_iter().flat_map(of_kind).collect()
}

/// The built-in models, and those of the user's directory if one is named.
///
/// # Errors
/// If the directory cannot be read.
pub fn all(context: &Context) -> std::io::Result<Vec<Model>> {
    let mut models = built_in(context.quick);
    if let Some(directory) = &context.models {
        models.extend(
            files_with_facets(directory)?
                .into_iter()
                .map(Model::of_file),
        );
    }
    Ok(models)
}

/// The files of a directory that are PLCs with facets, in order of name.
///
/// # Errors
/// If the directory cannot be read.
pub fn files_with_facets(directory: &Path) -> std::io::Result<Vec<PathBuf>> {
    let entries = std::fs::read_dir(directory)?;
    let mut paths: Vec<PathBuf> = entries.filter_map(|e| Some(e.ok()?.path())).collect();
    paths.sort();
    paths.retain(|path| read_plc(path).is_ok_and(|(plc, _)| !plc.facets.is_empty()));
    Ok(paths)
}

impl Model {
    /// A file; it is beside the paper's column of its name.
    pub fn of_file(path: PathBuf) -> Model {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let stem = path
            .file_stem()
            .unwrap_or_default()
            .to_string_lossy()
            .to_lowercase();
        let beside = PAPERS.iter().map(|p| p.0).find(|p| {
            let column = p.to_lowercase();
            stem == column || stem.replace('-', "_") == column.replace('-', "_")
        });
        Model {
            name: name.into_owned(),
            source: "models",
            beside: beside.unwrap_or(""),
            recipe: Recipe::File(path),
        }
    }

    /// The complex.
    ///
    /// # Errors
    /// If it is a file that cannot be read.
    pub fn plc(&self) -> Result<Plc, tetflip::format::FormatError> {
        match &self.recipe {
            Recipe::Generated(kind, seed, size) => Ok(generate(*kind, *seed, *size)),
            Recipe::File(path) => read_plc(path).map(|(plc, _)| plc),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_different_and_models_of_about_the_size() {
        let mut models = built_in(false);
        models.extend(small(false));
        let mut names: Vec<&str> = models.iter().map(|m| &*m.name).collect();
        names.sort_unstable();
        names.dedup();
        assert_eq!(
            names.len(),
            PAPERS.len() + OTHERS.len() + 10 * Kind::ALL.len()
        );
        for model in models.iter().filter(|m| !m.beside.is_empty()) {
            let Recipe::Generated(_, _, size) = model.recipe else {
                panic!("a generated one");
            };
            let facets = model.plc().expect("generated").facets.len();
            assert!(facets > 0 && facets <= 2 * size, "{}: {facets}", model.name);
        }
    }

    #[test]
    fn files_stand_beside_their_columns() {
        let beside = |path: &str| Model::of_file(path.into()).beside;
        assert_eq!(beside("a/thru_mazewheel.off"), "thru-mazewheel");
        assert_eq!(beside("ANC101.ply"), "anc101");
        assert_eq!(beside("bunny.off"), "");
    }
}
