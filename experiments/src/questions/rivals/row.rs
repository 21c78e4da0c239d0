//! The rows of `rivals.csv`.

use crate::frame::{Expectation, check_rows};
use crate::measure::outcome;
use crate::measure::sample::rounded;
use serde::Serialize;

/// One program on one input. The README of the package has the meaning of the columns.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Row {
    pub input: String,
    pub kind: &'static str,
    #[serde(skip)]
    pub generic: bool,
    pub vertices: usize,
    pub facets: usize,
    pub program: &'static str,
    pub method: String,
    #[serde(skip)]
    pub is_ours: bool,
    #[serde(skip)]
    pub verifies: bool,
    pub version: String,
    pub threads: u32,
    pub runs: usize,
    pub outcome: &'static str,
    pub seconds: Option<f64>,
    pub min_seconds: Option<f64>,
    pub polygon_seconds: Option<f64>,
    pub wall_seconds: Option<f64>,
    pub peak_mebibytes: Option<f64>,
    pub tetrahedra: Option<usize>,
    pub steiner_points: Option<usize>,
    pub seconds_over_tetgen: Option<f64>,
    pub polygons_over_tetgen: Option<f64>,
    pub memory_over_tetgen: Option<f64>,
    pub seconds_over_tetgen_16: Option<f64>,
    pub seconds_over_hxt: Option<f64>,
    pub wall_over_hxt_2: Option<f64>,
    pub verification_over_construction: Option<f64>,
    pub wall_over_one_thread: Option<f64>,
}

impl Row {
    /// Of an input that the programs cannot be given.
    pub fn not_written(input: String, kind: &'static str) -> Row {
        Row {
            input,
            kind,
            program: "tetflip",
            is_ours: true,
            outcome: "not-written",
            ..Row::default()
        }
    }

    /// Whether all runs succeeded.
    pub fn is_ok(&self) -> bool {
        self.outcome == outcome::OK
    }

    /// The input and the program, for messages.
    pub fn name(&self) -> String {
        format!("{}, {} {}", self.input, self.program, self.method)
    }

    /// What its input is called, without the size.
    pub fn family(&self) -> &str {
        self.input.split('/').next().unwrap_or_default()
    }
}

/// A ratio of two numbers that are known.
pub fn ratio(a: Option<f64>, b: Option<f64>) -> Option<f64> {
    let ratio = a? / b?;
    ratio.is_finite().then(|| rounded(ratio))
}

/// Our rows get their ratios to the others' on the same input.
pub fn add_ratios(rows: &mut [Row]) {
    let all = rows.to_vec();
    for row in rows.iter_mut().filter(|r| r.is_ours && r.is_ok()) {
        let find = |program: &str, method: &str, threads| {
            all.iter().find(|r| {
                (&*r.input, r.program, &*r.method, r.threads)
                    == (&*row.input, program, method, threads)
                    && r.is_ok()
            })
        };
        if row.threads > 1 {
            let alone = find("tetflip", &row.method, 1);
            row.wall_over_one_thread = ratio(row.wall_seconds, alone.and_then(|a| a.wall_seconds));
            let hxt = find("hxt", "delaunay", row.threads);
            row.wall_over_hxt_2 = ratio(row.wall_seconds, hxt.and_then(|h| h.wall_seconds));
            continue;
        }
        if row.verifies {
            let construction = find("tetflip", "cavity", 1).or(find("tetflip", "delaunay", 1));
            row.verification_over_construction =
                ratio(row.seconds, construction.and_then(|c| c.seconds));
            continue;
        }
        if let Some(tetgen) = find("tetgen", "cavity", 1) {
            row.seconds_over_tetgen = ratio(row.seconds, tetgen.seconds);
            row.polygons_over_tetgen = ratio(row.polygon_seconds, tetgen.polygon_seconds);
            row.memory_over_tetgen = ratio(row.peak_mebibytes, tetgen.peak_mebibytes);
        }
        let newer = find("tetgen-1.6", "cavity", 1);
        row.seconds_over_tetgen_16 = ratio(row.seconds, newer.and_then(|t| t.seconds));
        let hxt = find("hxt", "delaunay", 1);
        row.seconds_over_hxt = ratio(row.seconds, hxt.and_then(|h| h.seconds));
    }
}

/// What the rows must say. Of times nothing is asserted.
pub fn expectations(rows: &[Row]) -> Vec<Expectation> {
    let same = |row: &Row| {
        let others = rows
            .iter()
            .filter(|r| r.input == row.input && r.tetrahedra.is_some());
        others.map(|r| r.tetrahedra).all(|n| n == row.tetrahedra)
    };
    check_rows(
        rows,
        Row::name,
        &[
            ("this library succeeds on every input but a user's", &|r| {
                !r.is_ours || r.is_ok() || r.kind.starts_with("model")
            }),
            (
                "all programs give equally many tetrahedra for points in general position",
                &|r| !r.generic || r.tetrahedra.is_none() || same(r),
            ),
        ],
    )
}

#[cfg(test)]
pub mod tests {
    use super::*;
    use crate::frame::expectation::assert_each_can_fail;

    /// A row for tests.
    pub fn row(input: &str, program: &'static str, method: &str, seconds: f64) -> Row {
        Row {
            input: input.to_string(),
            kind: if input.starts_with("slab") {
                "scene"
            } else {
                "model"
            },
            program,
            method: method.to_string(),
            is_ours: program == "tetflip",
            verifies: method == "verify",
            threads: 1,
            outcome: outcome::OK,
            seconds: Some(seconds),
            polygon_seconds: Some(seconds / 2.0),
            peak_mebibytes: Some(10.0 * seconds),
            ..Row::default()
        }
    }

    #[test]
    fn ratios_are_ours_over_theirs() {
        let mut rows = [
            row("a", "tetflip", "cavity", 1.0),
            row("a", "tetflip", "verify", 3.0),
            row("a", "tetgen", "cavity", 4.0),
            row("b", "tetflip", "cavity", 2.0),
            row("slab/300", "tetflip", "cavity", 9.0),
            row("slab/3000", "tetflip", "cavity", 1.0),
            row("slab/300", "tetgen", "cavity", 1.0),
            row("slab/3000", "tetgen", "cavity", 2.0),
            row("a", "tetgen-1.6", "cavity", 2.0),
        ];
        add_ratios(&mut rows);
        assert_eq!(rows[0].seconds_over_tetgen, Some(0.25));
        assert_eq!(rows[0].seconds_over_tetgen_16, Some(0.5));
        assert_eq!(rows[1].verification_over_construction, Some(3.0));
        assert_eq!(rows[1].seconds_over_tetgen, None);
        assert_eq!(
            (rows[2].seconds_over_tetgen, rows[3].seconds_over_tetgen),
            (None, None)
        );
        let wall = |program, threads, seconds| Row {
            threads,
            wall_seconds: Some(seconds),
            seconds_over_hxt: None,
            ..row("uniform/1000000", program, "delaunay", 2.0)
        };
        let mut walls = [
            wall("tetflip", 1, 4.0),
            wall("tetflip", 2, 3.0),
            wall("hxt", 1, 7.0),
            wall("hxt", 2, 6.0),
        ];
        add_ratios(&mut walls);
        let of = |r: &Row| {
            (
                r.wall_over_one_thread,
                r.wall_over_hxt_2,
                r.seconds_over_hxt,
            )
        };
        assert_eq!(of(&walls[0]), (None, None, Some(1.0)));
        assert_eq!(of(&walls[1]), (Some(0.75), Some(0.5), None));
        let good = [
            row("a", "tetgen", "cavity", 4.0),
            row("a", "tetflip", "cavity", 1.0),
        ];
        let good = good.map(|r| Row {
            kind: "points",
            generic: true,
            tetrahedra: Some(7),
            ..r
        });
        assert_each_can_fail(
            expectations,
            &good,
            &[
                (&|r| (r.outcome, r.tetrahedra) = ("failed", None), &[0]),
                (&|r| r.tetrahedra = Some(8), &[1]),
            ],
        );
    }
}
