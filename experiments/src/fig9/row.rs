//! One line of `fig9.csv`: one method in one scene.

use crate::method::Method;
use crate::outcome;
use crate::scene::Slab;
use serde::Serialize;
use tetflip::recover::polygons::PolygonCounts;

/// The columns; the README of the package has their meaning.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Row {
    pub seed: u64,
    pub vertices: usize,
    pub half_height: f64,
    pub steiner_points: usize,
    pub regions: u64,
    pub crossing_tets: u64,
    pub insertion: &'static str,
    pub times: String,
    pub repetitions: usize,
    pub median_seconds: Option<f64>,
    pub min_seconds: Option<f64>,
    pub two_three: u64,
    pub three_two: u64,
    pub four_four: u64,
    pub queued: u64,
    pub stale: u64,
    pub postponed: u64,
    pub performed_from_list: u64,
    pub discarded_outside: u64,
    pub non_crossing: u64,
    pub overflows: u64,
    pub compared_exactly: u64,
    pub ties: u64,
    pub swallowed: u64,
    pub cavity_fallbacks: u64,
    pub outcome: &'static str,
    pub left: usize,
    pub repeatable: bool,
    pub agrees: Option<bool>,
    pub verified: Option<bool>,
}

impl Row {
    /// A row that has its scene and its method.
    pub fn new(slab: Slab, method: Method) -> Row {
        Row {
            seed: slab.seed,
            vertices: slab.vertices,
            half_height: slab.half_height,
            insertion: method.insertion(),
            times: method.times(),
            ..Row::default()
        }
    }

    /// The row with these counts.
    pub fn with_counts(self, counts: &PolygonCounts) -> Row {
        let flips = &counts.flips;
        Row {
            regions: counts.regions,
            crossing_tets: counts.crossing_tets,
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
            ..self
        }
    }

    /// Whether this is a run of `method`.
    pub fn is_of(&self, method: Method) -> bool {
        (self.insertion, &self.times) == (method.insertion(), &method.times())
    }

    /// Whether the run succeeded.
    pub fn is_ok(&self) -> bool {
        self.outcome == outcome::OK
    }

    /// Whether two rows are of the same scene.
    pub fn same_scene(&self, other: &Row) -> bool {
        let scene = |r: &Row| (r.vertices, r.seed, r.half_height.to_bits());
        scene(self) == scene(other)
    }

    /// The scene and the method, for messages.
    pub fn name(&self) -> String {
        let Row {
            vertices,
            seed,
            insertion,
            times,
            ..
        } = self;
        format!("{vertices} vertices, seed {seed}, {insertion} {times}")
            .trim_end()
            .to_string()
    }
}
