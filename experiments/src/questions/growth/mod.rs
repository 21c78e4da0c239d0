//! Growth over three orders of magnitude.
//!
//! **Question.** How do the times of flips in exact order and of cavity retriangulation grow with the size of the
//! region? Flips need O(n log n) time for n flips (Shewchuk 2003), cavities little more than linear time in practice.
//!
//! **Inputs.** The scene of the paper's Fig. 8 ([`crate::inputs::slab`]) with 1000 to 1 000 000 crossing
//! tetrahedra, one seed. A row is the insertion of the rectangle by one method. And points with quadratically many
//! tetrahedra ([`quadratic`](mod@quadratic)).
//!
//! **Columns.** [`Row`], [`fit::Summary`]; the README of this package has their meaning. Seconds are processor time of
//! the insertion alone, in one thread.
//!
//! **Expected.** Both methods succeed at every size and give the same tetrahedra; asserted at the end. Nothing
//! is asserted of times.

mod fit;
mod quadratic;

use crate::frame::row::Timed;
use crate::frame::{About, Answer, Context, Expectation, Experiment, Failed, check_rows};
use crate::inputs::slab::{OfScene, Slab};
use crate::measure::method::Method;
use crate::measure::outcome;
use crate::measure::rounds::{Effort, Scene};
use crate::measure::sample::rounded;
use crate::pictures::plot::{Plot, PlotError, Scale, Series};
use serde::Serialize;
use tetflip::recover::polygons::{FlipOrder, Insertion};

/// The question.
pub struct Growth;

/// The methods, in the order of tables.
const METHODS: [Method; 2] = [
    Method(Insertion::Flip(FlipOrder::FILTERED)),
    Method(Insertion::Cavity),
];

impl Experiment for Growth {
    fn about(&self) -> About {
        About {
            name: "growth",
            question: "growth of the times of flips and of cavities up to a million crossing tetrahedra",
            seconds: 15,
        }
    }

    fn run(&self, context: &Context) -> Result<Answer, Failed> {
        let sizes = [1000, 3000, 10_000, 30_000, 100_000, 300_000, 1_000_000];
        let sizes = &sizes[..if context.quick { 3 } else { 7 }];
        let seconds = if context.quick { 0.2 } else { 1.0 };
        let name = |size: &u64| format!("about {size} crossing tetrahedra");
        let measure = |&size: &u64| measure(Slab::crossing(size), &effort(seconds, size));
        let rows = context.measure(sizes, |&size| size, name, measure);
        let mut answer = context.answer();
        let shown = "vertices crossing_tets method repetitions median_seconds microseconds_per_tet peak_megabytes";
        answer.csv("growth", &rows, shown)?;
        let shown = "method from_vertices to_vertices exponent worst_factor exponent_beyond_n_log_n \
                     worst_factor_n_log_n";
        answer.csv("growth-summary", &fit::summaries(&rows, &METHODS), shown)?;
        answer.file("growth.svg", &plot(&rows)?)?;
        answer.expectations = expectations(&rows);
        quadratic(context, &mut answer)?;
        Ok(answer)
    }
}

/// The second part: where there are quadratically many flips.
fn quadratic(context: &Context, answer: &mut Answer) -> Result<(), Failed> {
    let sizes: &[usize] = match context.quick {
        true => &[32, 64, 128],
        false => &[32, 64, 128, 256, 512, 1024],
    };
    let of_kind = |&kind: &&'static str| sizes.iter().map(move |&n| (kind, n));
    let inputs: Vec<_> = quadratic::KINDS.iter().flat_map(of_kind).collect();
    let effort = Effort {
        seconds: if context.quick { 0.02 } else { 0.3 },
        least: 3,
        most: 101,
        of_slow: 3,
    };
    let rows = context.measure(
        &inputs,
        |&(_, n)| (n * n) as u64,
        |(kind, n)| format!("{kind}, {n} points"),
        |&(kind, n)| vec![quadratic::measure(kind, n, &effort)],
    );
    let shown = "input points crossing_tets flips queued median_seconds outcome";
    answer.csv("growth-quadratic", &rows, shown)?;
    let shown = "input to_points flips_exponent most_flips_over_square seconds_exponent";
    answer.csv(
        "growth-quadratic-summary",
        &quadratic::summaries(&rows),
        shown,
    )?;
    answer.expectations.extend(check_rows(
        &rows,
        |r| format!("{}, {} points", r.input, r.points),
        &[(
            "flips succeed where they are quadratically many, and cavities give the same tetrahedra",
            &|r: &quadratic::Row| r.outcome == outcome::OK && r.agrees == Some(true),
        )],
    ));
    Ok(())
}

/// How often the insertions of one size are timed: large ones less often.
fn effort(seconds: f64, crossing: u64) -> Effort {
    let least = match crossing {
        0..=30_000 => 5,
        30_001..=300_000 => 3,
        _ => 2,
    };
    Effort {
        seconds,
        least,
        most: 101,
        of_slow: 0,
    }
}

/// `growth.csv`: one method at one size. The README of the package has the meaning of the columns.
#[derive(Clone, Debug, Default, PartialEq)]
struct Row {
    scene: OfScene,
    method: OfMethod,
    timed: Timed,
    counts: Counts,
}

crate::row_of_groups!(Row: scene, method, timed, counts);

#[derive(Clone, Debug, Default, PartialEq, Serialize)]
struct OfMethod {
    method: String,
}

#[derive(Clone, Debug, Default, PartialEq, Serialize)]
struct Counts {
    microseconds_per_tet: Option<f64>,
    outcome: &'static str,
    flips: u64,
    queued: u64,
    comparisons: u64,
    compared_exactly: u64,
    fallbacks: u64,
    peak_megabytes: Option<f64>,
    repeatable: bool,
    agrees: Option<bool>,
}

impl Row {
    fn new(slab: Slab, method: Method) -> Row {
        let (scene, method) = (
            OfScene::new(slab),
            OfMethod {
                method: method.to_string(),
            },
        );
        Row {
            scene,
            method,
            ..Row::default()
        }
    }

    fn is_ok(&self) -> bool {
        self.counts.outcome == outcome::OK
    }

    /// The number of vertices and the median seconds of a success.
    fn point(&self) -> Option<(f64, f64)> {
        let seconds = self.timed.median_seconds.filter(|_| self.is_ok())?;
        Some((self.scene.vertices as f64, seconds))
    }
}

/// Both methods on copies of one tetrahedralization, timed in turns: one row per method.
fn measure(slab: Slab, effort: &Effort) -> Vec<Row> {
    let scene = match Scene::measure(&slab.plc(), &METHODS, effort, |_| false) {
        Ok(scene) => scene,
        Err(failure) => {
            let mut rows = METHODS.map(|m| Row::new(slab, m)).to_vec();
            let outcome = outcome::word::<()>(&Err(failure));
            rows.iter_mut().for_each(|r| r.counts.outcome = outcome);
            return rows;
        }
    };
    let (agree, peak_megabytes) = (scene.agrees(), peak_megabytes());
    let rows = scene.runs.iter().map(|r| {
        let mut row = Row::new(slab, r.method);
        let (counts, flips) = (&r.counts, &r.counts.flips);
        row.scene.steiner_points = scene.steiner_points;
        row.scene.regions = counts.regions;
        row.scene.crossing_tets = counts.crossing_tets;
        row.timed = Timed::of(&r.seconds);
        let per_tet = |s| rounded(s * 1e6 / counts.crossing_tets as f64);
        row.counts = Counts {
            microseconds_per_tet: row
                .timed
                .median_seconds
                .map(per_tet)
                .filter(|x| x.is_finite()),
            outcome: outcome::word(&r.result),
            flips: flips.flips(),
            queued: flips.queued,
            comparisons: flips.comparisons,
            compared_exactly: flips.compared_exactly,
            fallbacks: counts.cavity_fallbacks + counts.flip_fallbacks,
            peak_megabytes,
            repeatable: r.repeatable,
            agrees: r.result.is_ok().then_some(agree),
        };
        row
    });
    rows.collect()
}

/// The most memory that this process has had so far, both meshes and the copies included; only Linux tells.
fn peak_megabytes() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|l| l.strip_prefix("VmHWM:"))?;
    let kilobytes: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(rounded(kilobytes / 1e3))
}

fn expectations(rows: &[Row]) -> Vec<Expectation> {
    let name = |r: &Row| format!("{} vertices, {}", r.scene.vertices, r.method.method);
    check_rows(
        rows,
        name,
        &[
            ("both methods succeed at every size", &|r| r.is_ok()),
            ("they give the same tetrahedra", &|r| {
                r.counts.agrees != Some(false)
            }),
            (
                "one region, no Steiner point, nothing left to another method",
                &|r| {
                    !r.is_ok()
                        || (r.scene.regions, r.scene.steiner_points, r.counts.fallbacks)
                            == (1, 0, 0)
                },
            ),
            ("repetitions repeat counts and outcome", &|r| {
                !r.is_ok() || r.counts.repeatable
            }),
        ],
    )
}

/// `growth.svg`: seconds against vertices, with a line n log n through the first point of the first method.
fn plot(rows: &[Row]) -> Result<String, PlotError> {
    let series = METHODS.map(|method| {
        let name = method.to_string();
        let points = rows.iter().filter(|r| r.method.method == name);
        Series::new(&name, points.filter_map(Row::point))
    });
    let plot = Plot {
        title: "Inserting a rectangle into a Delaunay tetrahedralization",
        x_label: "vertices n",
        y_label: "median seconds",
        scale: Scale::Log,
        guides: vec![series[0].n_log_n()],
        series: series.into(),
    };
    plot.svg()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::expectation::assert_each_can_fail;

    #[test]
    fn a_small_size_has_good_rows() {
        let rows = measure(Slab::crossing(300), &effort(0.2, 1_000_000));
        assert_eq!(rows.len(), 2);
        assert!((200..400).contains(&rows[0].scene.crossing_tets));
        assert!(rows[0].counts.flips > 0 && rows[1].counts.flips == 0);
        assert!(
            rows.iter()
                .all(|r| r.counts.microseconds_per_tet > Some(0.0))
        );
        assert_each_can_fail(
            expectations,
            &rows,
            &[
                (
                    &|r| (r.counts.outcome, r.counts.agrees) = ("stuck", None),
                    &[0],
                ),
                (&|r| r.counts.agrees = Some(false), &[1]),
                (&|r| r.counts.fallbacks = 1, &[2]),
                (&|r| r.counts.repeatable = false, &[3]),
            ],
        );
        assert!(plot(&rows).unwrap().contains("n log n"));
    }

    #[test]
    fn a_scene_without_a_tetrahedralization_has_rows() {
        let rows = measure(Slab::crossing(0), &effort(0.2, 0));
        assert!(rows.iter().all(|r| r.counts.outcome == "flat-vertex-set"));
        assert!(!expectations(&rows)[0].holds());
    }
}
