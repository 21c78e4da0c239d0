//! What the exact order costs alone: filtered times, and the same without one of their parts, in the same copy of the
//! region, with the same evaluation, in the same queue.
//!
//! A part is left out by a type of the library's ([`Ablation`]); nothing else differs, and only the flips are timed,
//! not the search for the region. The arms take turns in one process; the seconds are its processor time, so that other
//! work on the machine counts as little as it can; and a ratio is one of the times in one turn. An insertion that an
//! inexact order cannot finish without a patch, or that ends in other tetrahedra, has no time.

use crate::families::Draw;
use crate::inputs::slab::Slab;
use crate::measure::outcome;
use crate::measure::sample::{median, rounded};
use crate::questions::flip_order::measure::DIFFERENT;
use crate::rivals::process::processor_seconds;
use serde::Serialize;
use std::cell::Cell;
use tetflip::cdt::Cdt;
use tetflip::exchange::Plc;
use tetflip::mesh::{TetMesh, VertexId};
use tetflip::predicate::DoublePoints;
use tetflip::recover::flips::{
    AblatedNumbers, Ablation, FilteredNumbers, FlipCounts, FlipObserver, FlipRegion, FlipScratch,
    Flipped, NoEnclosures, NoIntegers, NoPerturbation, RoundedKeys,
};
use tetflip::recover::region::{Region, Sides};
use tetflip::report::Report;

use super::input::{Cut, Input, Kind};

/// The arms: what they leave out, and the largest size class.
const ARMS: [(&str, u64); 5] = [
    (FILTERED, u64::MAX),
    ("rounded-keys", u64::MAX),
    ("no-perturbation", u64::MAX),
    ("no-integers", u64::MAX),
    ("no-enclosures", 3000),
];

/// Nothing is left out.
pub const FILTERED: &str = "filtered";

type Order = dyn FlipRegion<DoublePoints>;

fn ablated<A: Ablation + 'static>() -> Box<Order> {
    Box::new(AblatedNumbers::<A>::default())
}

fn order(arm: &str) -> Box<Order> {
    match arm {
        "rounded-keys" => ablated::<RoundedKeys>(),
        "no-perturbation" => ablated::<NoPerturbation>(),
        "no-integers" => ablated::<NoIntegers>(),
        "no-enclosures" => ablated::<NoEnclosures>(),
        _ => Box::new(FilteredNumbers),
    }
}

/// One input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scene {
    kind: &'static str,
    about: u64,
    seed: u64,
}

/// How often, and on what.
pub struct Plan {
    /// In the order of the rows.
    pub scenes: Vec<Scene>,
    seconds: f64,
    least: usize,
}

impl Plan {
    /// A minute or two.
    pub fn full() -> Plan {
        let sizes = [
            (50, 24),
            (100, 24),
            (300, 24),
            (1000, 24),
            (3000, 16),
            (10_000, 12),
            (30_000, 8),
        ];
        let others = [(500, 12), (5000, 8)];
        Plan {
            scenes: scenes(&sizes, &others),
            seconds: 0.3,
            least: 5,
        }
    }

    /// A few seconds.
    pub fn quick() -> Plan {
        Plan {
            scenes: scenes(&[(100, 2), (1000, 2)], &[(500, 1)]),
            seconds: 0.02,
            least: 2,
        }
    }
}

fn scenes(generic: &[(u64, u64)], others: &[(u64, u64)]) -> Vec<Scene> {
    let kinds = [
        ("generic", generic),
        ("rectangle", others),
        ("lattice", others),
        ("tenths", others),
    ];
    let of_kind = |(kind, sizes): (&'static str, &[(u64, u64)])| -> Vec<Scene> {
        let of_size =
            |&(about, seeds): &(u64, u64)| (1..=seeds).map(move |seed| Scene { kind, about, seed });
        sizes.iter().flat_map(of_size).collect()
    };
    kinds.into_iter().flat_map(of_kind).collect()
}

impl Scene {
    /// For messages.
    pub fn name(&self) -> String {
        format!("price, {}:{} of about {}", self.kind, self.seed, self.about)
    }

    /// A part of the progress bar.
    pub fn weight(&self) -> u64 {
        self.about.max(1000)
    }

    fn plc(&self) -> Plc {
        let of = |kind| Input {
            kind,
            about: self.about,
            seed: self.seed,
        };
        match self.kind {
            "lattice" => of(Kind::Lattice(Cut::Between)).plc(),
            "tenths" => of(Kind::Tenths(Cut::Between)).plc(),
            kind => {
                let mut plc = Slab {
                    vertices: (self.about as f64 / 3.3) as usize,
                    half_height: 0.01,
                    seed: self.seed,
                }
                .plc();
                if kind == "generic" {
                    generic_corners(&mut plc, self.seed);
                }
                plc
            }
        }
    }
}

/// The corners of the rectangle move outwards in its plane, each otherwise, so that they are on no circle, and no flip
/// time is a tie.
fn generic_corners(plc: &mut Plc, seed: u64) {
    let mut draw = Draw::new(seed, 15);
    for &v in &plc.facets[0].polygons[0] {
        for x in &mut plc.vertices[v.index()][..2] {
            *x *= 1.0 + 0.05 * draw.fraction().abs();
        }
    }
}

/// `exactness_cost-price.csv`: one arm on one input.
#[allow(missing_docs)]
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Row {
    pub input: &'static str,
    pub about: u64,
    pub seed: u64,
    pub crossing_tets: u64,
    pub arm: &'static str,
    pub turns: usize,
    pub median_seconds: Option<f64>,
    pub filtered_over_arm: Option<f64>,
    pub outcome: &'static str,
    pub flips: u64,
    pub comparisons: u64,
    pub compared_exactly: u64,
    pub ties: u64,
}

/// An order whose flips are timed.
struct Clocked<'a> {
    order: &'a Order,
    seconds: Cell<f64>,
}

impl FlipRegion<DoublePoints> for Clocked<'_> {
    fn is_exact(&self) -> bool {
        self.order.is_exact()
    }

    fn is_naive(&self) -> bool {
        false
    }

    fn insert(
        &self,
        mesh: &mut TetMesh,
        sides: &Sides<DoublePoints>,
        region: &Region,
        scratch: &mut FlipScratch,
        observer: Option<&mut dyn FlipObserver>,
    ) -> Flipped {
        let start = processor_seconds();
        let flipped = self.order.insert(mesh, sides, region, scratch, observer);
        self.seconds
            .set(self.seconds.get() + processor_seconds() - start);
        flipped
    }
}

/// One run of an arm.
struct Run {
    /// None if it failed.
    seconds: Option<f64>,
    outcome: &'static str,
    crossing_tets: u64,
    counts: FlipCounts,
    tets: Vec<[VertexId; 4]>,
}

fn run(cdt: &Cdt, order: &Order, wants_tets: bool) -> Run {
    let clocked = Clocked {
        order,
        seconds: Cell::new(0.0),
    };
    let (mut cdt, mut report) = (cdt.clone(), Report::default());
    let result = cdt.insert_polygons_in(&clocked, &mut report, None);
    let mut tets = Vec::new();
    if wants_tets {
        let mesh = cdt.mesh();
        tets.extend(mesh.finite().map(|t| mesh.vertices(t)));
        tets.iter_mut().for_each(|t| t.sort_unstable());
        tets.sort_unstable();
    }
    Run {
        seconds: result.is_ok().then(|| clocked.seconds.get()),
        outcome: outcome::word(&result),
        crossing_tets: report.insertion_counts.crossing_tets,
        counts: report.insertion_counts.flips,
        tets,
    }
}

/// One row per arm.
///
/// # Panics
/// If the input has no tetrahedralization: it is one of ours.
pub fn measure(scene: &Scene, plan: &Plan) -> Vec<Row> {
    let plc = scene.plc();
    let cdt = Cdt::with_segments(&plc, true, &mut Report::default());
    let cdt = cdt.expect("a rectangle, and vertices beside it");
    let arms: Vec<&'static str> = ARMS
        .iter()
        .filter(|arm| scene.about <= arm.1)
        .map(|arm| arm.0)
        .collect();
    let orders: Vec<Box<Order>> = arms.iter().map(|arm| order(arm)).collect();
    let mut first: Vec<Run> = orders.iter().map(|o| run(&cdt, &**o, true)).collect();
    let (filtered, others) = first.split_first_mut().expect("filtered is the first");
    for run in others.iter_mut().filter(|r| r.seconds.is_some()) {
        if run.tets != filtered.tets {
            (run.seconds, run.outcome) = (None, DIFFERENT);
        }
    }
    let once: f64 = first.iter().filter_map(|r| r.seconds).sum();
    let turns = ((plan.seconds / once) as usize).clamp(plan.least, 101);
    // By turn, then by arm. The first runs have warmed up what there is to warm up.
    let mut seconds = vec![vec![None; arms.len()]; turns];
    for (turn, seconds) in seconds.iter_mut().enumerate() {
        for i in 0..arms.len() {
            let arm = (turn + i) % arms.len();
            if first[arm].seconds.is_some() {
                seconds[arm] = run(&cdt, &*orders[arm], false).seconds;
            }
        }
    }
    let row = |(i, &arm): (usize, &&'static str)| {
        let of_arm: Vec<f64> = seconds.iter().filter_map(|turn| turn[i]).collect();
        let ratios = seconds.iter().filter_map(|turn| Some(turn[0]? / turn[i]?));
        let ratios: Vec<f64> = ratios.filter(|r| r.is_finite()).collect();
        let run = &first[i];
        Row {
            input: scene.kind,
            about: scene.about,
            seed: scene.seed,
            crossing_tets: run.crossing_tets,
            arm,
            turns: of_arm.len(),
            median_seconds: median(&of_arm).map(rounded),
            filtered_over_arm: median(&ratios).map(rounded),
            outcome: run.outcome,
            flips: run.counts.flips(),
            comparisons: run.counts.comparisons,
            compared_exactly: run.counts.compared_exactly,
            ties: run.counts.ties,
        }
    };
    arms.iter().enumerate().map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_arms_of_a_generic_scene_make_the_same_flips() {
        let scene = Scene {
            kind: "generic",
            about: 500,
            seed: 1,
        };
        let rows = measure(&scene, &Plan::quick());
        assert_eq!(rows.len(), ARMS.len());
        for row in &rows {
            assert_eq!(row.outcome, outcome::OK, "{row:?}");
            assert_eq!(row.flips, rows[0].flips);
            assert!(row.turns >= 2 && row.filtered_over_arm > Some(0.0));
        }
        assert_eq!(
            (rows[0].arm, rows[0].filtered_over_arm),
            (FILTERED, Some(1.0))
        );
        assert_eq!((rows[0].ties, rows[1].compared_exactly), (rows[0].ties, 0));
        assert!(rows[4].compared_exactly > rows[0].compared_exactly);
    }

    #[test]
    fn what_an_inexact_order_cannot_finish_has_no_time() {
        let scene = Scene {
            kind: "lattice",
            about: 500,
            seed: 1,
        };
        let rows = measure(&scene, &Plan::quick());
        for row in &rows {
            assert_eq!(row.median_seconds.is_some(), row.outcome == outcome::OK);
            // The exact orders, and those that leave ties to arrival.
            let is_exact = !["rounded-keys", "no-perturbation"].contains(&row.arm);
            assert_eq!(row.outcome == outcome::OK, is_exact, "{row:?}");
        }
    }
}
