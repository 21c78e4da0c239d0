//! `rivals-targets.csv`: the project's bounds on ratios to other programs.

use super::plan::MILLION;
use super::row::{Row, ratio};
use serde::Serialize;

/// What is measured of a million points, its bound, and the column.
type OfAMillion = (&'static str, f64, fn(&Row) -> Option<f64>);

const OF_A_MILLION: [OfAMillion; 4] = [
    ("seconds / TetGen's", 0.45, |r| r.seconds_over_tetgen),
    ("seconds / HXT's", 0.8, |r| r.seconds_over_hxt),
    ("wall clock on two threads / HXT's", 0.8, |r| {
        r.wall_over_hxt_2
    }),
    ("memory / TetGen's", 0.5, |r| r.memory_over_tetgen),
];

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
    for (of_what, bound, field) in OF_A_MILLION {
        add(
            &format!("1,000,000 uniform points: {of_what}"),
            bound,
            each(&million, field),
        );
    }
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
        let large = |r: &Row| r.kind == "scene" && r.method == method && is_large(r);
        let what = "worst seconds for the polygon / TetGen's";
        let what = format!("scenes from 1,000 crossing tetrahedra on, {method}: {what}");
        add(&what, 0.6, each(&large, |r| r.polygons_over_tetgen));
    }
    let sum = sum_over_tetgen(rows, "model points", "delaunay");
    add("models' points: sum of seconds / TetGen's", 0.45, sum);
    for (what, points) in [("a CDT", false), ("points alone", true)] {
        let what = format!("verification of {what} / construction, worst input");
        let of = |r: &Row| (r.kind == "points") == points;
        add(&what, 1.0, each(&of, |r| r.verification_over_construction));
    }
    targets
}

/// Whether a scene has about 1000 crossing tetrahedra or more.
fn is_large(row: &Row) -> bool {
    let about = row.input.split('/').nth(1).map(str::parse::<u64>);
    about.is_some_and(|n| n.is_ok_and(|n| n >= 1000))
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

#[cfg(test)]
mod tests {
    use super::super::row::add_ratios;
    use super::super::row::tests::row;
    use super::*;

    #[test]
    fn the_worst_is_measured() {
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
