//! The rows of the tables. The README of this package explains the columns.

use super::measure::{Measured, Run};
use super::plan::{Plan, precision};
use crate::families::FAMILIES;
use crate::flips::schoenhardt::Class;
use crate::measure::wilson;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use tetflip::recover::flips::{QueueRule, TieRule};
use tetflip::recover::polygons::FlipOrder;

/// `flip_order.csv`: one arm on one subfamily.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
pub struct Summary {
    /// The family.
    pub family: String,
    /// The subfamily; `all` of the family together.
    pub subfamily: String,
    /// The arm: number type and rules.
    pub times: String,
    /// The number type alone.
    pub numbers: String,
    /// The rule for equal times; none of exact and naive numbers.
    pub ties: String,
    /// Which events are queued.
    pub queue: String,
    /// The bits of a rounded number's significand.
    pub precision: Option<u32>,
    /// Inputs run.
    pub inputs: u64,
    /// Inputs with an event at all.
    pub with_events: u64,
    /// Vertices of all inputs.
    pub vertices: u64,
    /// Steiner points on segments, of all inputs.
    pub steiner_points: u64,
    /// Regions into which a polygon was inserted.
    pub regions: u64,
    /// Events that came off the queue alive, in all runs.
    pub events: u64,
    /// Events that exact numbers would never have queued.
    pub unfounded: u64,
    /// Consecutive events in the wrong order.
    pub adjacent_inversions: u64,
    /// Pairs of events in the wrong order.
    pub kendall: u64,
    /// Runs with such a pair.
    pub inverted_runs: u64,
    /// Events that the perturbation alone tells from another, and runs with such events.
    pub exact_ties: u64,
    pub exact_ties_runs: u64,
    /// Triangles whose event is one with that of another triangle, so that they need no perturbation, and runs with
    /// such triangles.
    pub circuit_ties: u64,
    pub circuit_ties_runs: u64,
    /// Events tied with another in the rounded numbers.
    pub rounded_ties: Option<u64>,
    /// First patch of §3.3: events discarded, and runs with such events.
    pub discarded_outside: u64,
    pub discarded_outside_runs: u64,
    /// Second patch: flips, and runs with such flips.
    pub non_crossing: u64,
    pub non_crossing_runs: u64,
    /// Third patch: events put into L, runs with such events, flips from L.
    pub postponed: u64,
    pub postponed_runs: u64,
    pub performed_from_list: u64,
    /// The longest list L.
    pub longest_list: u64,
    /// Events in L at the end.
    pub list_left: u64,
    /// Times that were not finite.
    pub overflows: u64,
    /// Runs that ended in the CDT.
    pub ok: u64,
    /// Runs that ended in the CDT without any patch.
    pub ok_without_patch: u64,
    /// Runs that ended with faces that are not locally Delaunay.
    pub not_delaunay: u64,
    /// Runs that got stuck, and the worst class of what they left.
    pub stuck: u64,
    pub stuck_schoenhardt: u64,
    pub stuck_no_tetrahedralization: u64,
    pub stuck_tetrahedralizable: u64,
    pub stuck_undecided: u64,
    /// Runs that ended in other tetrahedra than the CDT's, unnoticed.
    pub different: u64,
    /// Naive runs that ended with inverted tetrahedra.
    pub inverted: u64,
    /// Runs that tore triangles of other polygons out of the mesh.
    pub displaced: u64,
    /// Runs that were broken off, because their flips went around in circles.
    pub endless: u64,
    /// Runs that ended otherwise.
    pub other: u64,
    /// Failed runs of inputs whose exact order has ties that the perturbation decides.
    pub failed_with_exact_ties: u64,
    /// The part of the runs that did not end in the CDT, and its Wilson interval (95 %).
    pub failure_rate: f64,
    pub failure_low: f64,
    pub failure_high: f64,
}

impl Summary {
    /// Of one run.
    fn of_run(input: &Measured, run: &Run) -> Summary {
        let (d, c) = (&run.disorder, &run.counts);
        let one = |yes: bool| u64::from(yes);
        let is = |word: &str| u64::from(run.outcome == word);
        let class = |class: Class| u64::from(run.class() == Some(class));
        let patched = c.discarded_outside + c.non_crossing + c.postponed > 0;
        let mut row = Summary {
            inputs: 1,
            with_events: one(d.events > 0),
            vertices: input.vertices as u64,
            steiner_points: input.steiner_points as u64,
            regions: input.counts.regions,
            events: d.events,
            unfounded: d.unfounded,
            adjacent_inversions: d.adjacent,
            kendall: d.kendall,
            inverted_runs: one(d.kendall > 0),
            exact_ties: d.exact_ties,
            exact_ties_runs: one(d.exact_ties > 0),
            circuit_ties: d.circuit_ties,
            circuit_ties_runs: one(d.circuit_ties > 0),
            rounded_ties: d.rounded_ties,
            discarded_outside: c.discarded_outside,
            discarded_outside_runs: one(c.discarded_outside > 0),
            non_crossing: c.non_crossing,
            non_crossing_runs: one(c.non_crossing > 0),
            postponed: c.postponed,
            postponed_runs: one(c.postponed > 0),
            performed_from_list: c.performed_from_list,
            longest_list: d.longest_list,
            list_left: d.list_left,
            overflows: c.overflows,
            ok: one(run.is_ok()),
            ok_without_patch: one(run.is_ok() && !patched),
            not_delaunay: is("not-delaunay"),
            stuck: is("stuck"),
            stuck_schoenhardt: class(Class::Schoenhardt),
            stuck_no_tetrahedralization: class(Class::NoTetrahedralization),
            stuck_tetrahedralizable: class(Class::Tetrahedralizable),
            stuck_undecided: class(Class::Undecided),
            different: is("different"),
            inverted: is("inverted"),
            displaced: is("displaced"),
            endless: is("endless"),
            failed_with_exact_ties: one(!run.is_ok() && input.has_exact_ties()),
            ..Summary::default()
        };
        let named = [
            row.ok,
            row.not_delaunay,
            row.stuck,
            row.different,
            row.inverted,
        ];
        let named = named.iter().sum::<u64>() + row.displaced + row.endless;
        row.other = 1 - named;
        row
    }

    /// Adds the counts of other inputs of the same arm: sums, but the maximum of the longest lists. The rates are left
    /// alone.
    fn add(&mut self, other: &Summary) {
        let counts = other.counts();
        for (mine, theirs) in self.counts_mut().into_iter().zip(counts) {
            *mine += theirs;
        }
        self.longest_list = self.longest_list.max(other.longest_list);
        self.rounded_ties = self
            .rounded_ties
            .zip(other.rounded_ties)
            .map(|(a, b)| a + b);
    }

    /// The counts that add up.
    fn counts(&self) -> [u64; COUNTS] {
        let mut copy = self.clone();
        copy.counts_mut().map(|count| *count)
    }

    fn counts_mut(&mut self) -> [&mut u64; COUNTS] {
        [
            &mut self.inputs,
            &mut self.with_events,
            &mut self.vertices,
            &mut self.steiner_points,
            &mut self.regions,
            &mut self.events,
            &mut self.unfounded,
            &mut self.adjacent_inversions,
            &mut self.kendall,
            &mut self.inverted_runs,
            &mut self.exact_ties,
            &mut self.exact_ties_runs,
            &mut self.circuit_ties,
            &mut self.circuit_ties_runs,
            &mut self.discarded_outside,
            &mut self.discarded_outside_runs,
            &mut self.non_crossing,
            &mut self.non_crossing_runs,
            &mut self.postponed,
            &mut self.postponed_runs,
            &mut self.performed_from_list,
            &mut self.list_left,
            &mut self.overflows,
            &mut self.ok,
            &mut self.ok_without_patch,
            &mut self.not_delaunay,
            &mut self.stuck,
            &mut self.stuck_schoenhardt,
            &mut self.stuck_no_tetrahedralization,
            &mut self.stuck_tetrahedralizable,
            &mut self.stuck_undecided,
            &mut self.different,
            &mut self.inverted,
            &mut self.displaced,
            &mut self.endless,
            &mut self.other,
            &mut self.failed_with_exact_ties,
        ]
    }

    /// Runs that did not end in the CDT.
    pub fn failures(&self) -> u64 {
        self.inputs - self.ok
    }

    fn set_rates(&mut self) {
        let [low, high] = wilson::interval(self.failures(), self.inputs);
        let rate = self.failures() as f64 / self.inputs.max(1) as f64;
        [self.failure_rate, self.failure_low, self.failure_high] =
            [rate, low, high].map(|x| (x * 1e6).round() / 1e6);
    }
}

/// How many counts add up.
const COUNTS: usize = 37;

/// The name of all subfamilies together.
pub const ALL: &str = "all";

/// All rows: for each family first `all`, then its subfamilies; for each of them the arms in the order of the plan.
pub fn summaries(inputs: &[Measured], plan: &Plan) -> Vec<Summary> {
    let mut rows = Vec::new();
    for input in inputs {
        for run in &input.runs {
            let rules = run.times.rules();
            let is_rounded = precision(run.times).is_some();
            let ties = match rules.ties {
                TieRule::Arrival => "arrival",
                TieRule::Perturbed => "perturbed",
                TieRule::Circuit => "circuit",
            };
            let queue = match rules.queue {
                QueueRule::All => "all",
                QueueRule::Possible => "possible",
            };
            let of_rounded = |word: &str| match is_rounded {
                true => word.to_string(),
                false => String::new(),
            };
            rows.push(Summary {
                family: input.member.family().to_string(),
                subfamily: input.member.subfamily().to_string(),
                times: run.times.to_string(),
                numbers: run.times.numbers.to_string(),
                ties: of_rounded(ties),
                queue: of_rounded(queue),
                precision: precision(run.times),
                ..Summary::of_run(input, run)
            });
        }
    }
    joined(rows, plan)
}

/// Adds up rows of the same family, subfamily and arm, and makes those of whole families. So the rows of inputs, and of
/// shards, become those of the whole.
pub fn joined(rows: impl IntoIterator<Item = Summary>, plan: &Plan) -> Vec<Summary> {
    let mut by_key: BTreeMap<(usize, usize, usize, String), Summary> = BTreeMap::new();
    for row in rows.into_iter().filter(|row| row.subfamily != ALL) {
        let family = FAMILIES.iter().position(|f| f.name == row.family);
        let family = family.expect("rows are of families that there are");
        let mut subfamilies = FAMILIES[family].subfamilies.iter();
        let subfamily = subfamilies.position(|&s| s == row.subfamily);
        let subfamily = subfamily.expect("rows are of subfamilies that there are");
        let order: FlipOrder = row.times.parse().expect("rows are of arms that there are");
        let place = plan.place(order);
        let mut add = |subfamily: usize, row: Summary| {
            let key = (family, subfamily, place, row.times.clone());
            by_key
                .entry(key)
                .and_modify(|sum| sum.add(&row))
                .or_insert(row);
        };
        let of_family = Summary {
            subfamily: ALL.to_string(),
            ..row.clone()
        };
        add(0, of_family);
        add(1 + subfamily, row);
    }
    let mut rows: Vec<Summary> = by_key.into_values().collect();
    rows.iter_mut().for_each(Summary::set_rates);
    rows
}

/// `flip_order-failures.csv`: one run that did not end in the CDT.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FailureRow {
    /// The name of the input for `replay`.
    pub input: String,
    /// The arm.
    pub times: String,
    /// Vertices of the PLC, Steiner points not counted.
    pub vertices: usize,
    /// Polygons.
    pub polygons: usize,
    /// Crossing tetrahedra of all regions, by exact flips.
    pub crossing_tets: u64,
    /// The kind of failure.
    pub outcome: String,
    /// How much is wrong then: crossing tetrahedra, faces that are not locally Delaunay, inverted tetrahedra, or
    /// displaced triangles.
    pub left: usize,
    /// The worst class of what a stuck run left.
    pub class: String,
    /// The tetrahedra and vertices of the polyhedron of that class.
    pub class_tets: usize,
    pub class_vertices: usize,
    /// Pairs of events in the wrong order.
    pub kendall: u64,
    /// The longest list L.
    pub longest_list: u64,
    /// Events of the exact order that the perturbation alone tells from another.
    pub exact_ties: u64,
}

/// All failures, in the order of inputs.
pub fn failures(inputs: &[Measured]) -> Vec<FailureRow> {
    let runs = inputs
        .iter()
        .flat_map(|m| m.runs.iter().map(move |r| (m, r)));
    let failed = runs.filter(|(_, r)| !r.is_ok()).map(|(m, r)| {
        let worst = r.pieces.first();
        FailureRow {
            input: m.member.to_string(),
            times: r.times.to_string(),
            vertices: m.vertices,
            polygons: m.polygons,
            crossing_tets: m.counts.crossing_tets,
            outcome: r.outcome.to_string(),
            left: r.left,
            class: worst.map_or("", |p| p.class.name()).to_string(),
            class_tets: worst.map_or(0, |p| p.tets.len()),
            class_vertices: worst.map_or(0, |p| p.vertices),
            kendall: r.disorder.kendall,
            longest_list: r.disorder.longest_list,
            exact_ties: m.exact_ties(),
        }
    });
    failed.collect()
}

/// The failure rates by family as a table for people, a column per arm that is run on all inputs.
pub fn table(rows: &[Summary], plan: &Plan) -> String {
    let everywhere = plan.arms.iter().filter(|a| a.per_family == plan.per_family);
    let names: Vec<String> = everywhere.map(|a| a.order.to_string()).collect();
    let mut text = format!("{:<30}", "failures / inputs");
    let width = |name: &str| name.len().max(13);
    text.extend(names.iter().map(|n| format!(" {n:>0$}", width(n))));
    let mut kind = ("", "");
    for row in rows.iter().filter(|row| names.contains(&row.times)) {
        if kind != (row.family.as_str(), row.subfamily.as_str()) {
            kind = (&row.family, &row.subfamily);
            let name = if row.subfamily == ALL {
                row.family.clone()
            } else {
                format!("  {}", row.subfamily)
            };
            text += &format!("\n{name:<30}");
        }
        let cell = format!("{}/{}", row.failures(), row.inputs);
        text += &format!(" {cell:>0$}", width(&row.times));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::questions::flip_order::measure::measure;

    #[test]
    fn rows_add_up() {
        let mut plan = Plan::quick().uncut();
        plan.per_family = u64::MAX;
        let names = ["prism/end:0", "prism/end:78", "prism/right:1"];
        let inputs: Vec<Measured> = names
            .iter()
            .map(|n| measure(n.parse().expect("a name"), &plan))
            .collect();
        let rows = summaries(&inputs, &plan);
        let of = |subfamily: &str, times: &str| {
            let is = |r: &&Summary| {
                (r.family.as_str(), r.subfamily.as_str(), r.times.as_str())
                    == ("prism", subfamily, times)
            };
            rows.iter().find(is).expect("a row")
        };
        let plain = of("all", "f64:plain");
        assert_eq!(
            (plain.inputs, plain.ok, plain.not_delaunay, plain.stuck),
            (3, 2, 0, 1)
        );
        assert_eq!((plain.stuck_schoenhardt, plain.failure_rate), (1, 0.333333));
        assert!(plain.failure_low < 0.1 && plain.failure_high > 0.7);
        assert_eq!(
            plain.kendall,
            of("end", "f64:plain").kendall + of("right", "f64:plain").kendall
        );
        let crossed = of("all", "f64:once,ties=perturbed,queue=possible");
        let parts = (&*crossed.numbers, &*crossed.ties, &*crossed.queue);
        assert_eq!(parts, ("f64:once", "perturbed", "possible"));
        assert_eq!((of("all", "exact").ok, of("all", "exact").kendall), (3, 0));
        assert!(rows.iter().all(|r| r.family == "prism" && r.other == 0));
        let failures = failures(&inputs);
        let plain: Vec<_> = failures.iter().filter(|f| f.times == "f64:plain").collect();
        assert_eq!(
            (plain[0].input.as_str(), plain[0].class.as_str()),
            ("prism/end:78", "schoenhardt")
        );
        assert!(table(&rows, &plan).contains("1/3"));
        // Shards: the same rows, in whatever parts the inputs are summed up.
        let parts = inputs
            .iter()
            .map(|m| summaries(std::slice::from_ref(m), &plan));
        let parts: Vec<Summary> = parts.flatten().collect();
        assert_eq!(joined(parts, &plan), rows);
    }
}
