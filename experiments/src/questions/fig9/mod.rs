//! The experiment of §3.4 and Figs. 8 and 9.
//!
//! **Question.** How do the times of cavity retriangulation and of flips grow with the size of the cavity, and what
//! does an exact order of the flips cost compared with the paper's rounded times?
//!
//! **Inputs.** Random vertices near the x-y plane and a rectangle in it ([`crate::inputs::slab`]); from about 30
//! crossing tetrahedra to 100 000, several seeds for each size. A row is the insertion of the rectangle by one method.
//!
//! TetGen inserts the same rectangles where it is installed, in its two modes ([`tetgen`]).
//!
//! **Columns.** Of `fig9.csv`: [`Row`]; of `fig9-summary.csv`: [`summary::Summary`]; of `fig9-tetgen.csv`:
//! [`tetgen::Row`]. The README of this package has their meaning. Seconds are processor time of the polygon insertion
//! alone, in one thread.
//!
//! **Expected.** Cavities and exact flips always succeed; every success is verified and all of one scene are the same
//! mesh. Flips with rounded times may fail: then the row has the outcome. Asserted at the end.

mod plots;
mod summary;
mod tetgen;

use crate::frame::row::Timed;
use crate::frame::{About, Answer, Context, Expectation, Experiment, Failed, check_rows};
use crate::inputs::slab::{OfScene, Slab};
use crate::measure::method::Method;
use crate::measure::outcome;
use crate::measure::rounds::{Effort, End, Scene};
use serde::Serialize;
use tetflip::recover::polygons::PolygonCounts;

/// The figure.
pub struct Fig9;

impl Experiment for Fig9 {
    fn about(&self) -> About {
        About {
            name: "fig9",
            question: "time of both algorithms by the number of crossing tetrahedra (paper, Fig. 9)",
            seconds: 205,
        }
    }

    fn run(&self, context: &Context) -> Result<Answer, Failed> {
        let (scenes, effort) = context.plan(quick, full);
        let methods = Method::all();
        let measure = |&slab: &Slab| measure(slab, &methods, &effort);
        let rows = context.measure(&scenes, weight, Slab::name, measure);
        let summaries = summary::summaries(&rows, &methods);
        let mut answer = context.answer();
        answer.say("Median milliseconds of the insertion of the rectangle:\n");
        answer.say(summary::table(&summaries, &methods));
        answer.csv("fig9", &rows, "")?;
        answer.csv("fig9-summary", &summaries, "")?;
        for figure in plots::FIGURES {
            answer.file(figure.file, &figure.svg(&rows, &methods)?)?;
        }
        answer.say(outcome::failures(&rows, |r| {
            (r.name(), r.end.outcome, r.end.left)
        }));
        if let Some(program) = &context.tetgen {
            let name = |slab: &Slab| format!("TetGen, {}", slab.name());
            let measure = |&slab: &Slab| tetgen::measure(program, slab, &rows, context.limit);
            let beside = context.measure(&scenes, weight, name, measure);
            answer.csv("fig9-tetgen", &beside, "")?;
            answer.file("fig9-tetgen.svg", &plots::beside_tetgen(&rows, &beside)?)?;
            answer.say(tetgen::text(&beside));
        } else {
            answer.say("skipped: TetGen is not installed");
        }
        answer.expectations = expectations(&rows);
        Ok(answer)
    }
}

/// The scenes, in the order of the rows, and how often each insertion is timed.
type Plan = (Vec<Slab>, Effort);

/// From about 30 crossing tetrahedra to 100 000, with the paper's two ranges in small steps.
fn full() -> Plan {
    let small = (10..=32).step_by(2).map(|n| (n, 5));
    let paper = (40..=560).step_by(20).map(|n| (n, 3));
    let large = [
        (900, 3),
        (1800, 3),
        (4500, 3),
        (9000, 3),
        (18_000, 2),
        (30_000, 2),
    ];
    let effort = Effort {
        seconds: 0.35,
        least: 3,
        most: 501,
        of_slow: 0,
    };
    (scenes(small.chain(paper).chain(large)), effort)
}

/// The same questions in a few seconds, not fit for conclusions about time.
fn quick() -> Plan {
    let effort = Effort {
        seconds: 0.05,
        least: 3,
        most: 21,
        of_slow: 0,
    };
    (
        scenes([(10, 2), (30, 2), (60, 2), (300, 2), (1000, 1)]),
        effort,
    )
}

/// A scene's part of the progress bar: small ones fill their time, large ones need a time in proportion to their size.
fn weight(slab: &Slab) -> u64 {
    slab.vertices.max(1000) as u64
}

/// Scenes with seeds 1, 2, … for each pair of a number of vertices and a number of seeds.
fn scenes(sizes: impl IntoIterator<Item = (usize, u64)>) -> Vec<Slab> {
    let scenes = sizes.into_iter().flat_map(|(vertices, seeds)| {
        (1..=seeds).map(move |seed| Slab {
            vertices,
            half_height: 0.01,
            seed,
        })
    });
    scenes.collect()
}

/// One line of `fig9.csv`: one method in one scene. The README of the package has the meaning of the columns.
#[derive(Clone, Debug, Default, PartialEq)]
struct Row {
    scene: OfScene,
    method: OfMethod,
    timed: Timed,
    flips: Flips,
    end: End,
}

crate::row_of_groups!(Row: scene, method, timed, flips, end);

#[derive(Clone, Debug, Default, PartialEq, Serialize)]
struct OfMethod {
    insertion: &'static str,
    times: String,
}

#[derive(Clone, Debug, Default, PartialEq, Serialize)]
struct Flips {
    two_three: u64,
    three_two: u64,
    four_four: u64,
    queued: u64,
    stale: u64,
    postponed: u64,
    performed_from_list: u64,
    discarded_outside: u64,
    non_crossing: u64,
    overflows: u64,
    compared_exactly: u64,
    ties: u64,
    swallowed: u64,
    cavity_fallbacks: u64,
}

impl Flips {
    fn of(counts: &PolygonCounts) -> Flips {
        let flips = &counts.flips;
        Flips {
            two_three: flips.two_three,
            three_two: flips.three_two,
            four_four: flips.four_four,
            queued: flips.queued,
            stale: flips.stale,
            postponed: flips.postponed,
            performed_from_list: flips.performed_from_list,
            discarded_outside: flips.discarded_outside,
            non_crossing: flips.non_crossing,
            overflows: flips.overflows,
            compared_exactly: flips.compared_exactly,
            ties: flips.ties,
            swallowed: counts.swallowed,
            cavity_fallbacks: counts.cavity_fallbacks,
        }
    }
}

impl Row {
    /// A row that has its scene and its method.
    fn new(slab: Slab, method: Method) -> Row {
        let method = OfMethod {
            insertion: method.insertion(),
            times: method.times(),
        };
        Row {
            scene: OfScene::new(slab),
            method,
            ..Row::default()
        }
    }

    /// Whether this is a run of `method`.
    fn is_of(&self, method: Method) -> bool {
        (self.method.insertion, &self.method.times) == (method.insertion(), &method.times())
    }

    /// The median time of a success.
    fn seconds(&self) -> Option<f64> {
        self.timed.median_seconds.filter(|_| self.end.is_ok())
    }

    /// The scene and the method, for messages.
    fn name(&self) -> String {
        let (scene, method) = (&self.scene, &self.method);
        let name = format!(
            "{} vertices, seed {}, {}",
            scene.vertices, scene.seed, method.insertion
        );
        format!("{name} {}", method.times).trim_end().to_string()
    }
}

/// Every method on a copy of the same tetrahedralization, timed in turns and verified: one row per method.
fn measure(slab: Slab, methods: &[Method], effort: &Effort) -> Vec<Row> {
    let plc = slab.plc();
    let mut rows: Vec<Row> = methods.iter().map(|&m| Row::new(slab, m)).collect();
    // All methods are timed equally often.
    match Scene::measure(&plc, methods, effort, |_| false) {
        Ok(scene) => {
            for ((row, runs), end) in rows.iter_mut().zip(&scene.runs).zip(scene.ends(&plc)) {
                row.scene.steiner_points = scene.steiner_points;
                row.scene.regions = runs.counts.regions;
                row.scene.crossing_tets = runs.counts.crossing_tets;
                row.timed = Timed::of(&runs.seconds);
                row.flips = Flips::of(&runs.counts);
                row.end = end;
            }
        }
        Err(failure) => {
            let outcome = outcome::word::<()>(&Err(failure));
            rows.iter_mut().for_each(|r| r.end.outcome = outcome);
        }
    }
    rows
}

/// Of times nothing is asserted: they are the machine's.
fn expectations(rows: &[Row]) -> Vec<Expectation> {
    let safe = Method::all().into_iter().filter(|m| m.always_succeeds());
    let safe: Vec<Method> = safe.collect();
    let is_safe = |r: &Row| safe.iter().any(|&m| r.is_of(m));
    let patches = |r: &Row| {
        [
            r.flips.postponed,
            r.flips.discarded_outside,
            r.flips.non_crossing,
            r.flips.overflows,
        ]
    };
    check_rows(
        rows,
        Row::name,
        &[
            ("cavities and exact flips always succeed", &|r| {
                r.end.is_ok() || !is_safe(r)
            }),
            ("every result is verified to be the CDT", &|r| {
                !r.end.is_ok() || r.end.verified == Some(true)
            }),
            ("all results of one scene are equal", &|r| {
                !r.end.is_ok() || r.end.agrees == Some(true)
            }),
            ("exact flips need none of the paper's patches", &|r| {
                !is_safe(r) || patches(r) == [0; 4]
            }),
            ("no cavity is left to flips", &|r| {
                r.flips.cavity_fallbacks == 0
            }),
            ("every scene has one region and no Steiner point", &|r| {
                (r.scene.regions, r.scene.steiner_points) == (1, 0)
            }),
            ("repetitions repeat counts and outcome", &|r| {
                r.end.repeatable
            }),
        ],
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::expectation::assert_each_can_fail;

    const SLAB: Slab = Slab {
        vertices: 40,
        half_height: 0.01,
        seed: 1,
    };

    const EFFORT: Effort = Effort {
        seconds: 0.0,
        least: 3,
        most: 3,
        of_slow: 0,
    };

    #[test]
    fn a_small_scene_succeeds_in_all_ways() {
        let methods = &Method::all()[..4];
        let rows = measure(SLAB, methods, &EFFORT);
        for row in &rows {
            assert!(
                row.timed.min_seconds <= row.timed.median_seconds
                    && row.timed.min_seconds > Some(0.0)
            );
            assert!(row.timed.repetitions == 3 && (50..400).contains(&row.scene.crossing_tets));
            assert_eq!(row.scene, rows[0].scene);
            assert_eq!(row.flips.queued > 0, row.method.insertion == "flip");
        }
        assert_eq!(rows[2].name(), "40 vertices, seed 1, flip f64:plain");
        // The last one is of exact flips.
        assert_each_can_fail(
            expectations,
            &rows,
            &[
                (
                    &|r| (r.end.outcome, r.end.agrees, r.end.verified) = ("stuck", None, None),
                    &[0],
                ),
                (&|r| r.end.verified = Some(false), &[1]),
                (&|r| r.end.verified = None, &[1]),
                (&|r| r.end.agrees = Some(false), &[2]),
                (&|r| r.flips.postponed = 1, &[3]),
                (&|r| r.flips.cavity_fallbacks = 1, &[4]),
                (&|r| r.scene.regions = 2, &[5]),
                (&|r| r.scene.steiner_points = 1, &[5]),
                (&|r| r.end.repeatable = false, &[6]),
            ],
        );
        let mut rounded = rows[2].clone();
        (rounded.end.outcome, rounded.flips.postponed) = ("stuck", 3);
        assert!(
            expectations(&[rounded]).iter().all(Expectation::holds),
            "rounded times may fail"
        );
    }

    #[test]
    fn a_scene_without_a_tetrahedralization_has_rows() {
        // Nothing but the rectangle, which does not span space.
        let rows = measure(
            Slab {
                vertices: 0,
                ..SLAB
            },
            &Method::all(),
            &EFFORT,
        );
        assert_eq!(rows.len(), Method::all().len());
        assert!(
            rows.iter()
                .all(|r| r.end.outcome == "flat-vertex-set" && r.timed == Timed::default())
        );
    }

    #[test]
    fn no_scene_twice() {
        for (scenes, _) in [full(), quick()] {
            let names: std::collections::BTreeSet<String> = scenes.iter().map(Slab::name).collect();
            assert_eq!(names.len(), scenes.len());
        }
    }
}
