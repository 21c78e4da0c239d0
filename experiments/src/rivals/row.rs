//! The rows of the tables: `rivals.csv` and `rivals-targets.csv`.

use super::plan::MILLION;
use crate::outcome;
use crate::sample::rounded;
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
    pub seconds_over_hxt: Option<f64>,
    pub wall_over_hxt_2: Option<f64>,
    pub verification_over_construction: Option<f64>,
    pub wall_over_one_thread: Option<f64>,
}

impl Row {
    /// Whether all runs succeeded.
    pub fn is_ok(&self) -> bool {
        self.outcome == outcome::OK
    }

    /// The input and the program, for messages.
    pub fn name(&self) -> String {
        format!("{}, {} {}", self.input, self.program, self.method)
    }

    fn family(&self) -> &str {
        self.input.split('/').next().unwrap_or_default()
    }
}

fn ratio(a: Option<f64>, b: Option<f64>) -> Option<f64> {
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
        let hxt = find("hxt", "delaunay", 1);
        row.seconds_over_hxt = ratio(row.seconds, hxt.and_then(|h| h.seconds));
    }
}

/// A bound of the project's on a ratio. Missed ones are reported, not asserted.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Target {
    pub what: String,
    pub inputs: usize,
    pub bound: f64,
    pub measured: f64,
    pub reached: bool,
}

/// All targets that the rows say something about.
pub fn targets(rows: &[Row]) -> Vec<Target> {
    let mut targets = Vec::new();
    let mut add = |what: &str, bound: f64, measured: Vec<f64>| {
        if let Some(worst) = measured.iter().copied().max_by(f64::total_cmp) {
            targets.push(Target {
                what: what.to_string(),
                inputs: measured.len(),
                bound,
                measured: worst,
                reached: worst <= bound,
            });
        }
    };
    let ours: Vec<&Row> = rows.iter().filter(|r| r.is_ours && r.is_ok()).collect();
    let each = |wanted: &dyn Fn(&Row) -> bool, field: fn(&Row) -> Option<f64>| -> Vec<f64> {
        let wanted = ours.iter().filter(|r| wanted(r));
        wanted.filter_map(|r| field(r)).collect()
    };
    let million = |r: &Row| r.family() == "uniform" && r.vertices >= MILLION && !r.verifies;
    let of_million = "1,000,000 uniform points";
    add(
        &format!("{of_million}: seconds / TetGen's"),
        0.45,
        each(&million, |r| r.seconds_over_tetgen),
    );
    add(
        &format!("{of_million}: seconds / HXT's"),
        0.8,
        each(&million, |r| r.seconds_over_hxt),
    );
    add(
        &format!("{of_million}: wall clock on two threads / HXT's"),
        0.8,
        each(&million, |r| r.wall_over_hxt_2),
    );
    add(
        &format!("{of_million}: memory / TetGen's"),
        0.5,
        each(&million, |r| r.memory_over_tetgen),
    );
    add(
        "lattices and spheres: seconds per point / uniform points",
        2.0,
        degenerate(&ours),
    );
    for method in ["cavity", "flips"] {
        for kind in ["generated", "model"] {
            let what = format!("{kind} surfaces, {method}: sum of seconds / TetGen's");
            add(&what, 0.5, sum_over_tetgen(rows, kind, method));
        }
        let large = |r: &Row| r.kind == "scene" && r.method == method && vertices_cross(r);
        add(
            &format!(
                "scenes from 1,000 crossing tetrahedra on, {method}: worst seconds for the polygon / TetGen's"
            ),
            0.6,
            each(&large, |r| r.polygons_over_tetgen),
        );
    }
    add(
        "models' points: sum of seconds / TetGen's",
        0.45,
        sum_over_tetgen(rows, "model points", "delaunay"),
    );
    for (what, points) in [("a CDT", false), ("points alone", true)] {
        let of = |r: &Row| (r.kind == "points") == points;
        add(
            &format!("verification of {what} / construction, worst input"),
            1.0,
            each(&of, |r| r.verification_over_construction),
        );
    }
    targets
}

/// Whether a scene has about 1000 crossing tetrahedra or more.
fn vertices_cross(row: &Row) -> bool {
    let about = row
        .input
        .split('/')
        .nth(1)
        .and_then(|n| n.parse::<u64>().ok());
    about.is_some_and(|n| n >= 1000)
}

/// Seconds per point over those of as many uniform points.
fn degenerate(ours: &[&Row]) -> Vec<f64> {
    let per_point = |r: &Row| r.seconds.map(|s| s / r.vertices as f64);
    let points = ours
        .iter()
        .filter(|r| r.kind == "points" && !r.verifies && r.threads == 1);
    let uniform = points
        .clone()
        .filter(|r| r.family() == "uniform")
        .min_by_key(|r| r.vertices);
    let Some(uniform) = uniform.and_then(|r| per_point(r)) else {
        return Vec::new();
    };
    let degenerate = points.filter(|r| ["lattice", "tenths", "sphere"].contains(&r.family()));
    degenerate
        .filter_map(|r| ratio(per_point(r), Some(uniform)))
        .collect()
}

/// The sums are over the inputs on which both succeed.
fn sum_over_tetgen(rows: &[Row], kind: &str, method: &str) -> Vec<f64> {
    let (mut ours, mut theirs) = (0.0, 0.0);
    for row in rows.iter().filter(|r| r.kind == kind && r.is_ok()) {
        let other = rows
            .iter()
            .find(|r| r.input == row.input && r.program == "tetgen" && r.is_ok());
        if let (true, Some(other)) = (row.is_ours && row.method == method, other) {
            ours += row.seconds.unwrap_or(0.0);
            theirs += other.seconds.unwrap_or(0.0);
        }
    }
    ratio(Some(ours), Some(theirs).filter(|&t| t > 0.0))
        .into_iter()
        .collect()
}

/// The rows for people.
pub fn table(rows: &[Row]) -> String {
    let mut text = format!(
        "{:<28} {:<9} {:<9} {:>7} {:>10} {:>10} {:>9} {:>9}  outcome\n",
        "input", "program", "method", "threads", "seconds", "polygons", "MiB", "tets"
    );
    let number = |x: Option<f64>| x.map_or("–".to_string(), |x| format!("{x:.4}"));
    for r in rows {
        text += &format!(
            "{:<28} {:<9} {:<9} {:>7} {:>10} {:>10} {:>9} {:>9}  {}\n",
            r.input,
            r.program,
            r.method,
            r.threads,
            number(r.seconds),
            number(r.polygon_seconds),
            r.peak_mebibytes
                .map_or("–".to_string(), |m| format!("{m:.0}")),
            r.tetrahedra.map_or("–".to_string(), |n| n.to_string()),
            r.outcome
        );
    }
    text
}

/// The targets for people.
pub fn targets_text(targets: &[Target]) -> String {
    let line = |t: &Target| {
        let mark = if t.reached { "reached" } else { "MISSED" };
        format!(
            "{mark:<8} {:>7.3} (at most {}) {}\n",
            t.measured, t.bound, t.what
        )
    };
    targets.iter().map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(input: &str, program: &'static str, method: &str, seconds: f64) -> Row {
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
        ];
        add_ratios(&mut rows);
        assert_eq!(rows[0].seconds_over_tetgen, Some(0.25));
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
        let found = targets(&rows);
        let of = |start: &str| {
            let mut found = found.iter().filter(|t| t.what.starts_with(start));
            found.next().map(|t| (t.measured, t.reached))
        };
        assert_eq!(of("model surfaces, cavity"), Some((0.25, true)));
        assert_eq!(of("scenes from 1,000"), Some((0.5, true)));
        assert_eq!(of("verification"), Some((3.0, false)));
        assert_eq!(of("1,000,000"), None);
    }
}
