//! The rows of the tables. The README of this package explains the columns.

use super::measure::{Measured, Run};
use super::plan::{Numbers, Plan, precision};
use crate::families::FAMILIES;
use crate::flips::schoenhardt::Class;
use serde::Serialize;

/// `flip_order.csv`: one number type on one subfamily.
#[derive(Clone, Debug, PartialEq, Default, Serialize)]
pub struct Summary {
    /// The family.
    pub family: &'static str,
    /// The subfamily; `all` of the family together.
    pub subfamily: &'static str,
    /// The number type.
    pub times: String,
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
    /// Events tied with another in exact numbers.
    pub exact_ties: u64,
    /// Events tied with another in the rounded ones.
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
    /// Runs that ended with faces that are not locally Delaunay.
    pub not_delaunay: u64,
    /// Runs that got stuck, and the worst class of what they left.
    pub stuck: u64,
    pub stuck_schoenhardt: u64,
    pub stuck_no_tetrahedralization: u64,
    pub stuck_tetrahedralizable: u64,
    pub stuck_undecided: u64,
    /// Naive runs that ended with inverted tetrahedra.
    pub inverted: u64,
    /// Runs that tore triangles of other polygons out of the mesh.
    pub displaced: u64,
    /// Naive runs that were broken off, because their flips went around in circles.
    pub endless: u64,
    /// Runs that ended otherwise.
    pub other: u64,
    /// The part of the runs that did not end in the CDT.
    pub failure_rate: f64,
}

impl Summary {
    fn add(&mut self, input: &Measured, run: &Run) {
        let (d, c) = (&run.disorder, &run.counts);
        self.inputs += 1;
        self.with_events += u64::from(d.events > 0);
        self.vertices += input.vertices as u64;
        self.steiner_points += input.steiner_points as u64;
        self.events += d.events;
        self.unfounded += d.unfounded;
        self.adjacent_inversions += d.adjacent;
        self.kendall += d.kendall;
        self.inverted_runs += u64::from(d.kendall > 0);
        self.exact_ties += d.exact_ties;
        self.rounded_ties = self.rounded_ties.zip(d.rounded_ties).map(|(a, b)| a + b);
        self.discarded_outside += c.discarded_outside;
        self.discarded_outside_runs += u64::from(c.discarded_outside > 0);
        self.non_crossing += c.non_crossing;
        self.non_crossing_runs += u64::from(c.non_crossing > 0);
        self.postponed += c.postponed;
        self.postponed_runs += u64::from(c.postponed > 0);
        self.performed_from_list += c.performed_from_list;
        self.longest_list = self.longest_list.max(d.longest_list);
        self.list_left += d.list_left;
        self.overflows += c.overflows;
        match run.outcome {
            "ok" => self.ok += 1,
            "not-delaunay" => self.not_delaunay += 1,
            "stuck" => self.stuck += 1,
            "inverted" => self.inverted += 1,
            "displaced" => self.displaced += 1,
            "endless" => self.endless += 1,
            _ => self.other += 1,
        }
        match run.class() {
            Some(Class::Schoenhardt) => self.stuck_schoenhardt += 1,
            Some(Class::NoTetrahedralization) => self.stuck_no_tetrahedralization += 1,
            Some(Class::Tetrahedralizable) => self.stuck_tetrahedralizable += 1,
            Some(Class::Undecided) => self.stuck_undecided += 1,
            None => {}
        }
    }

    /// Runs that did not end in the CDT.
    pub fn failures(&self) -> u64 {
        self.inputs - self.ok
    }
}

/// All rows: for each family first `all`, then its subfamilies; for each of them the number types in the order of the
/// plan.
pub fn summaries(inputs: &[Measured], plan: &Plan) -> Vec<Summary> {
    let mut rows = Vec::new();
    for family in &FAMILIES {
        let with_all = [ALL].into_iter().chain(family.subfamilies.iter().copied());
        for subfamily in with_all {
            for number in &plan.numbers {
                let row = summary(inputs, family.name, subfamily, number);
                rows.extend((row.inputs > 0).then_some(row));
            }
        }
    }
    rows
}

/// The name of all subfamilies together.
pub const ALL: &str = "all";

fn summary(
    inputs: &[Measured],
    family: &'static str,
    subfamily: &'static str,
    number: &Numbers,
) -> Summary {
    let mut row = Summary {
        family,
        subfamily,
        times: number.times.to_string(),
        precision: precision(number.times),
        rounded_ties: Some(0),
        ..Summary::default()
    };
    let is_in = |m: &&Measured| {
        m.member.family() == family && (subfamily == ALL || m.member.subfamily() == subfamily)
    };
    for input in inputs.iter().filter(is_in) {
        for run in input.runs.iter().filter(|r| r.times == number.times) {
            row.add(input, run);
        }
    }
    row.failure_rate = failure_rate(row.failures(), row.inputs);
    row
}

/// The part of the inputs that failed, in millionths.
pub fn failure_rate(failures: u64, inputs: u64) -> f64 {
    let rate = failures as f64 / inputs.max(1) as f64;
    (rate * 1e6).round() / 1e6
}

/// `flip_order-failures.csv`: one run that did not end in the CDT.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FailureRow {
    /// The name of the input for `--replay`.
    pub input: String,
    /// The number type.
    pub times: String,
    /// Vertices of the PLC, Steiner points not counted.
    pub vertices: usize,
    /// Polygons.
    pub polygons: usize,
    /// Crossing tetrahedra of all regions, by exact flips.
    pub crossing_tets: u64,
    /// The kind of failure.
    pub outcome: &'static str,
    /// How much is wrong then: crossing tetrahedra, faces that are not locally Delaunay, inverted tetrahedra, or
    /// displaced triangles.
    pub left: usize,
    /// The worst class of what a stuck run left.
    pub class: &'static str,
    /// The tetrahedra and vertices of the polyhedron of that class.
    pub class_tets: usize,
    pub class_vertices: usize,
    /// Pairs of events in the wrong order.
    pub kendall: u64,
    /// The longest list L.
    pub longest_list: u64,
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
            outcome: r.outcome,
            left: r.left,
            class: worst.map_or("", |p| p.class.name()),
            class_tets: worst.map_or(0, |p| p.tets.len()),
            class_vertices: worst.map_or(0, |p| p.vertices),
            kendall: r.disorder.kendall,
            longest_list: r.disorder.longest_list,
        }
    });
    failed.collect()
}

/// The failure rates by family as a table for people, a column per number type.
pub fn table(rows: &[Summary], plan: &Plan) -> String {
    let names: Vec<String> = plan.numbers.iter().map(|n| n.times.to_string()).collect();
    let mut text = format!("{:<30}", "failures / inputs");
    text.extend(names.iter().map(|n| format!(" {n:>13}")));
    let mut kind = ("", "");
    for row in rows {
        if kind != (row.family, row.subfamily) {
            kind = (row.family, row.subfamily);
            let name = if row.subfamily == ALL {
                row.family.to_string()
            } else {
                format!("  {}", row.subfamily)
            };
            text += &format!("\n{name:<30}");
        }
        text += &format!(" {:>13}", format!("{}/{}", row.failures(), row.inputs));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::questions::flip_order::measure::measure;

    #[test]
    fn rows_add_up() {
        let plan = Plan {
            seeds: 2,
            ..Plan::quick()
        };
        let names = ["prism/end:0", "prism/end:78", "prism/right:1"];
        let inputs: Vec<Measured> = names
            .iter()
            .map(|n| measure(n.parse().expect("a name"), &plan))
            .collect();
        let rows = summaries(&inputs, &plan);
        let of = |subfamily: &str, times: &str| {
            let is = |r: &&Summary| {
                (r.family, r.subfamily, r.times.as_str()) == ("prism", subfamily, times)
            };
            rows.iter().find(is).expect("a row")
        };
        let f64 = of("all", "f64");
        assert_eq!(
            (f64.inputs, f64.ok, f64.not_delaunay, f64.stuck),
            (3, 2, 0, 1)
        );
        assert_eq!((f64.stuck_schoenhardt, f64.failure_rate), (1, 0.333333));
        assert_eq!(
            f64.kendall,
            of("end", "f64").kendall + of("right", "f64").kendall
        );
        let naive = of("all", "naive");
        let kinds = [
            naive.ok,
            naive.not_delaunay,
            naive.stuck,
            naive.inverted,
            naive.displaced,
            naive.endless,
        ];
        assert_eq!(
            (kinds.iter().sum::<u64>(), naive.other),
            (3, 0),
            "{kinds:?}"
        );
        assert_eq!((of("all", "exact").ok, of("all", "exact").kendall), (3, 0));
        assert!(rows.iter().all(|r| r.family == "prism"));
        let failures = failures(&inputs);
        let f64: Vec<_> = failures.iter().filter(|f| f.times == "f64").collect();
        assert_eq!(
            (f64[0].input.as_str(), f64[0].class),
            ("prism/end:78", "schoenhardt")
        );
        assert!(table(&rows, &plan).contains("1/3"));
    }
}
