//! One line of `exactness_cost.csv`: one method on one input.

use super::input::Input;
use super::plan::methods;
use crate::frame::{Expectation, check_rows};
use crate::measure::method::Method;
use crate::measure::outcome;
use crate::measure::sample::rounded;
use serde::Serialize;
use tetflip::recover::flips::FlipCounts;
use tetflip::recover::polygons::{FlipOrder, Insertion};

/// The columns; the README of the package has their meaning.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Row {
    pub input: &'static str,
    pub about: u64,
    pub seed: u64,
    pub vertices: usize,
    pub steiner_points: usize,
    pub crossing_tets: u64,
    pub method: String,
    pub repetitions: usize,
    pub median_seconds: Option<f64>,
    pub min_seconds: Option<f64>,
    pub outcome: &'static str,
    pub left: usize,
    pub comparisons: u64,
    pub by_floats: Option<f64>,
    pub by_exact_quotients: Option<f64>,
    pub by_perturbation: Option<f64>,
    pub big_quotients: u64,
    pub queued: u64,
    pub stale: u64,
    pub flips: u64,
    pub patches: u64,
    pub fallbacks: u64,
    pub repeatable: bool,
    pub agrees: Option<bool>,
    pub verified: Option<bool>,
}

/// What decided the comparisons of flip times: parts of their number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Decided {
    pub by_floats: f64,
    pub by_exact_quotients: f64,
    pub by_perturbation: f64,
}

/// What decided the comparisons; `None` of rounded times, which are all there is, and if there were no comparisons.
pub fn decided(method: Method, counts: &FlipCounts) -> Option<Decided> {
    let Insertion::Flip(times) = method.0 else {
        return None;
    };
    if !times.is_exact() || counts.comparisons == 0 {
        return None;
    }
    // Only filtered times have enclosures; the others are exact from the start.
    let exactly = match times {
        FlipOrder::FILTERED => counts.compared_exactly,
        _ => counts.comparisons,
    };
    let part = |n: u64| rounded(n as f64 / counts.comparisons as f64);
    Some(Decided {
        by_floats: part(counts.comparisons - exactly),
        by_exact_quotients: part(exactly - counts.ties),
        by_perturbation: part(counts.ties),
    })
}

impl Row {
    /// A row that has its input and its method.
    pub fn new(input: &Input, method: Method) -> Row {
        Row {
            input: input.kind.name(),
            about: input.about,
            seed: input.seed,
            method: method.to_string(),
            ..Row::default()
        }
    }

    /// Whether the run succeeded.
    pub fn is_ok(&self) -> bool {
        self.outcome == outcome::OK
    }

    /// Whether two rows are of the same input.
    pub fn same_input(&self, other: &Row) -> bool {
        (self.input, self.about, self.seed) == (other.input, other.about, other.seed)
    }

    /// The input and the method, for messages.
    pub fn name(&self) -> String {
        format!(
            "{}:{} of about {}, {}",
            self.input, self.seed, self.about, self.method
        )
    }
}

/// What the rows must say. Of times nothing is asserted: the targets are reported as reached or missed
/// ([`super::summary`]).
pub fn expectations(rows: &[Row]) -> Vec<Expectation> {
    let safe = methods().into_iter().filter(|m| m.always_succeeds());
    let safe: Vec<String> = safe.map(|m| m.to_string()).collect();
    check_rows(
        rows,
        Row::name,
        &[
            ("all but rounded flips always succeed", &|r| {
                r.is_ok() || !safe.contains(&r.method)
            }),
            ("every result is verified to be the CDT", &|r| {
                !r.is_ok() || r.verified == Some(true)
            }),
            ("all results of one input are equal", &|r| {
                !r.is_ok() || r.agrees == Some(true)
            }),
            ("exact flips need none of the paper's patches", &|r| {
                !safe.contains(&r.method) || r.patches == 0
            }),
            (
                "no Steiner point, and nothing left to another method",
                &|r| (r.steiner_points, r.fallbacks) == (0, 0),
            ),
            ("repetitions repeat counts and outcome", &|r| r.repeatable),
        ],
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::expectation::assert_each_can_fail;
    use tetflip::recover::polygons::NumberType;

    #[test]
    fn parts_of_comparisons() {
        let counts = FlipCounts {
            comparisons: 1000,
            compared_exactly: 100,
            ties: 30,
            ..FlipCounts::default()
        };
        let of = |times, counts| decided(Method(Insertion::Flip(times)), counts);
        let parts = |d: Decided| [d.by_floats, d.by_exact_quotients, d.by_perturbation];
        assert_eq!(
            of(FlipOrder::FILTERED, &counts).map(parts),
            Some([0.9, 0.07, 0.03])
        );
        assert_eq!(
            of(FlipOrder::EXACT, &counts).map(parts),
            Some([0.0, 0.97, 0.03])
        );
        assert_eq!(of(FlipOrder::new(NumberType::F64Plain), &counts), None);
        assert_eq!(of(FlipOrder::EXACT, &FlipCounts::default()), None);
        assert_eq!(decided(Method(Insertion::Cavity), &counts), None);
    }

    #[test]
    fn each_can_fail() {
        let input = Input {
            kind: super::super::input::Kind::Slab,
            about: 100,
            seed: 1,
        };
        let good = |method: usize| Row {
            outcome: "ok",
            repeatable: true,
            agrees: Some(true),
            verified: Some(true),
            ..Row::new(&input, methods()[method])
        };
        let stuck = |r: &mut Row| (r.outcome, r.agrees, r.verified) = ("stuck", None, None);
        assert_each_can_fail(
            expectations,
            &[good(0), good(2)],
            &[
                (&stuck, &[0]),
                (&|r| r.verified = Some(false), &[1]),
                (&|r| r.agrees = Some(false), &[2]),
                (&|r| r.patches = 3, &[3]),
                (&|r| r.steiner_points = 1, &[4]),
                (&|r| r.repeatable = false, &[5]),
            ],
        );
        let rounded = Row {
            outcome: "stuck",
            patches: 3,
            ..good(0)
        };
        assert!(
            expectations(&[rounded]).iter().all(Expectation::holds),
            "rounded times may fail"
        );
    }
}
