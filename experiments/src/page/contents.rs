//! What the page shows, in which order. A new experiment needs an entry here; a file that no entry names is shown at the end.

/// A file of results.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// `NAME.svg` and its caption.
    Figure(&'static str, &'static str),
    /// `NAME.csv`, to be read, and its caption.
    Table(&'static str, &'static str),
    /// The pictures of a directory, and their caption.
    Pictures(&'static str, &'static str),
    /// One column of `NAME.csv` by two others.
    Pivot(Pivot),
    /// `NAME.csv`, all rows, to be looked things up in.
    Rows(&'static str, &'static str),
    /// The same, of the rows alone that have this value in this column.
    Chosen(&'static str, &'static str, [&'static str; 2]),
}

/// One column of a CSV file by two others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pivot {
    /// `FILE.csv`.
    pub file: &'static str,
    /// What is shown.
    pub caption: &'static str,
    /// Only rows that have this value in this column.
    pub only: [&'static str; 2],
    /// The column whose values are the rows, and the one whose values are the columns.
    pub by: [&'static str; 2],
    /// Which of those values, in this order.
    pub columns: &'static [&'static str],
    /// The column that is shown.
    pub value: &'static str,
}

impl Part {
    /// The file.
    pub fn file(self) -> String {
        match self {
            Part::Figure(name, _) => format!("{name}.svg"),
            Part::Pictures(name, _) => format!("{name}/"),
            Part::Pivot(pivot) => format!("{}.csv", pivot.file),
            Part::Table(name, _) | Part::Rows(name, _) | Part::Chosen(name, ..) => {
                format!("{name}.csv")
            }
        }
    }
}

/// One experiment.
#[derive(Clone, Copy, Debug)]
pub struct Section {
    /// Its stem.
    pub stem: &'static str,
    /// The heading.
    pub title: &'static str,
    /// Its files.
    pub parts: &'static [Part],
}

use Part::{Chosen, Figure, Rows, Table};

const NUMBER_TYPES: &[&str] = &[
    "naive", "f32", "f64", "bits:106", "bits:256", "filtered", "exact",
];

const FAILURE_RATE: Pivot = Pivot {
    file: "flip_order",
    caption: "The part of the inputs on which flips fail, by family and number type of the flip times.",
    only: ["subfamily", "all"],
    by: ["family", "times"],
    columns: NUMBER_TYPES,
    value: "failure_rate",
};

const SCHOENHARDT: Pivot = Pivot {
    caption: "Inputs on which flips get stuck at Schönhardt’s polyhedron.",
    value: "stuck_schoenhardt",
    ..FAILURE_RATE
};

/// All sections, in the order of the page.
pub const SECTIONS: [Section; 13] = [
    Section {
        stem: "fig8",
        title: "The scene (Fig. 8)",
        parts: &[
            Figure("fig8", "The tetrahedra that the rectangle crosses."),
            Figure("fig8-after", "What fills their place after the insertion."),
            Table("fig8", "What the pictures show."),
        ],
    },
    Section {
        stem: "fig9",
        title: "Time by cavity size (Fig. 9)",
        parts: &[
            Figure("fig9-small", "Small cavities: the paper’s left plot."),
            Figure(
                "fig9-paper",
                "102 to 1840 crossing tetrahedra: the paper’s right plot.",
            ),
            Figure(
                "fig9-small-rounded",
                "Small cavities, without exact times, which the paper did not have.",
            ),
            Figure(
                "fig9-paper-rounded",
                "102 to 1840 crossing tetrahedra, without exact times.",
            ),
            Figure("fig9-full", "All sizes, logarithmic."),
            Table("fig9-summary", "Medians by size class and method."),
            Figure(
                "fig9-tetgen",
                "Cavities and filtered flips beside TetGen’s two modes, logarithmic.",
            ),
            Rows("fig9-tetgen", "TetGen’s runs, where it is installed."),
            Rows("fig9", "All scenes and methods."),
        ],
    },
    Section {
        stem: "table1",
        title: "CDTs of models (Table 1)",
        parts: &[Table("table1", "All models, the paper’s among them.")],
    },
    Section {
        stem: "table2",
        title: "What polygon insertion spends its time on (Table 2)",
        parts: &[Table(
            "table2",
            "Parts of the time of polygon insertion, in per cent, the paper’s among them.",
        )],
    },
    Section {
        stem: "models",
        title: "The generated models",
        parts: &[Part::Pictures("models", "One model of each kind.")],
    },
    Section {
        stem: "growth",
        title: "Growth up to a million crossing tetrahedra",
        parts: &[
            Figure(
                "growth",
                "Seconds against the number of vertices, with a line n log n.",
            ),
            Table("growth-summary", "Fitted powers."),
            Table("growth", "All sizes."),
        ],
    },
    Section {
        stem: "exactness_cost",
        title: "What exact flip times cost",
        parts: &[
            Table("exactness_cost-targets", "The project’s targets."),
            Table(
                "exactness_cost-summary",
                "Medians by input, size class and method.",
            ),
            Rows("exactness_cost", "All inputs and methods."),
        ],
    },
    Section {
        stem: "flip_order",
        title: "The order of flips, rounded and exact",
        parts: &[
            Figure(
                "flip_order-precision",
                "Failure rate against the precision of flip times, by family.",
            ),
            Part::Pivot(FAILURE_RATE),
            Part::Pivot(SCHOENHARDT),
            Rows("flip_order", "All families and number types."),
            Chosen(
                "flip_order-failures",
                "Runs that failed with times in f64.",
                ["times", "f64"],
            ),
        ],
    },
    Section {
        stem: "failures",
        title: "Failures of the paper’s kind",
        parts: &[Table("failures", "One row per failure.")],
    },
    Section {
        stem: "updates",
        title: "Deleting polygons and inserting them again",
        parts: &[Table("updates", "One row per scene or model.")],
    },
    Section {
        stem: "steiner",
        title: "Steiner points of segment recovery",
        parts: &[
            Table("steiner-summary", "By source and method."),
            Rows("steiner", "All models and methods."),
        ],
    },
    Section {
        stem: "rivals",
        title: "Beside TetGen and HXT",
        parts: &[
            Table("rivals-targets", "The project’s targets."),
            Rows("rivals", "All inputs and programs."),
        ],
    },
    Section {
        stem: "scaling",
        title: "Scaling up to ten million points",
        parts: &[
            Figure("scaling", "Seconds against size, with a line n log n."),
            Table("scaling", "All sizes."),
        ],
    },
];

/// The names of files that are shown elsewhere on the page.
pub const SHOWN_ELSEWHERE: [&str; 1] = ["RUNS.csv"];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::registry::ALL;
    use std::collections::BTreeSet;

    #[test]
    fn every_experiment_has_a_section_and_every_file_one_place() {
        for e in ALL.map(|e| e.about()) {
            let section = SECTIONS.iter().find(|s| s.stem == e.name);
            assert!(section.is_some(), "{} has no section", e.name);
        }
        let parts = SECTIONS.iter().flat_map(|s| s.parts);
        let parts = parts.filter(|p| !matches!(p, Part::Pivot(_)));
        let files: Vec<String> = parts.map(|p| p.file()).collect();
        let distinct: BTreeSet<&String> = files.iter().collect();
        assert_eq!(distinct.len(), files.len());
    }
}
