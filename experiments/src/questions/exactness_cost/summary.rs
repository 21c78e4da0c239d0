//! `exactness_cost-summary.csv`: times relative to `f64` and to cavities by input and size; and the project's targets.

use super::input::{KINDS, Kind};
use super::plan::in_same_queue;
use super::row::Row;
use crate::frame::text::number;
use crate::measure::method::Method;
use crate::measure::sample::{median, rounded};
use serde::Serialize;
use tetflip::recover::polygons::Insertion;

/// One method on the inputs of one kind and size. Ratios are medians, over the seeds, of ratios of median times.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Summary {
    pub input: &'static str,
    pub about: u64,
    pub method: String,
    pub inputs: usize,
    pub succeeded: usize,
    pub median_milliseconds: Option<f64>,
    pub median_microseconds_per_tet: Option<f64>,
    pub ratio_to_f64: Option<f64>,
    /// To rounded times in the same queue, and the least and the greatest of these ratios.
    pub ratio_to_same_queue: Option<f64>,
    pub least_to_same_queue: Option<f64>,
    pub most_to_same_queue: Option<f64>,
    pub ratio_to_cavity: Option<f64>,
    pub by_floats: Option<f64>,
    pub by_exact_quotients: Option<f64>,
    pub by_perturbation: Option<f64>,
}

/// By input, size and method, in the order of the plan.
pub fn summaries(rows: &[Row], methods: &[Method]) -> Vec<Summary> {
    let classes = rows.chunk_by(|a, b| (a.input, a.about) == (b.input, b.about));
    let of_class = |class| methods.iter().filter_map(move |m| summary(class, *m));
    classes.flat_map(of_class).collect()
}

fn summary(class: &[Row], method: Method) -> Option<Summary> {
    let method = method.to_string();
    let of_method: Vec<&Row> = class.iter().filter(|r| r.method == method).collect();
    let first = of_method.first()?;
    let median_of = |f: &dyn Fn(&Row) -> Option<f64>| {
        let sample: Vec<f64> = of_method.iter().filter_map(|r| f(r)).collect();
        median(&sample).map(rounded)
    };
    let ratio = |row: &Row, other: &str| {
        let mut others = class.iter().filter(|r| r.same_input(row));
        let other = others.find(|r| r.method == other)?;
        Some(row.median_seconds? / other.median_seconds?)
    };
    let ratio_to = |other: &str| median_of(&|row| ratio(row, other));
    let same_queue = Method(Insertion::Flip(in_same_queue())).to_string();
    let to_same_queue = of_method.iter().filter_map(|row| ratio(row, &same_queue));
    Some(Summary {
        input: first.input,
        about: first.about,
        inputs: of_method.len(),
        succeeded: of_method.iter().filter(|r| r.is_ok()).count(),
        median_milliseconds: median_of(&|r| Some(r.median_seconds? * 1e3)),
        median_microseconds_per_tet: median_of(&|r| {
            Some(r.median_seconds? * 1e6 / r.crossing_tets as f64)
        }),
        ratio_to_f64: ratio_to("flip f64:plain"),
        ratio_to_same_queue: ratio_to(&same_queue),
        least_to_same_queue: to_same_queue.clone().reduce(f64::min).map(rounded),
        most_to_same_queue: to_same_queue.reduce(f64::max).map(rounded),
        ratio_to_cavity: ratio_to("cavity"),
        by_floats: median_of(&|r| r.by_floats),
        by_exact_quotients: median_of(&|r| r.by_exact_quotients),
        by_perturbation: median_of(&|r| r.by_perturbation),
        method,
    })
}

/// `exactness_cost-targets.csv`: a bound that filtered flips are to keep, and whether they do.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Target {
    pub target: &'static str,
    pub input: &'static str,
    pub about: u64,
    pub bound: f64,
    pub measured: f64,
    pub reached: bool,
}

/// A target: its name, its bound, where it holds, and the ratio that it bounds.
type Bound = (
    &'static str,
    f64,
    fn(Kind, u64) -> bool,
    fn(&Summary) -> Option<f64>,
);

const BOUNDS: [Bound; 3] = [
    (
        "filtered/f64 on the slab",
        1.10,
        |kind, about| kind == Kind::Slab && about >= 1000,
        |s| s.ratio_to_f64,
    ),
    (
        "filtered/f64 on lattices",
        2.0,
        |kind, _| kind.is_lattice(),
        |s| s.ratio_to_f64,
    ),
    (
        "filtered/cavity on the slab",
        1.0,
        |kind, about| kind == Kind::Slab && (100..=100_000).contains(&about),
        |s| s.ratio_to_cavity,
    ),
];

/// All targets.
pub fn targets(summaries: &[Summary]) -> Vec<Target> {
    let mut targets = Vec::new();
    for (target, bound, applies, ratio) in BOUNDS {
        for summary in summaries.iter().filter(|s| s.method == "flip filtered") {
            let mut kinds = KINDS.iter().filter(|k| k.name() == summary.input);
            let measured = ratio(summary).filter(|_| kinds.any(|&k| applies(k, summary.about)));
            targets.extend(measured.map(|measured| Target {
                target,
                input: summary.input,
                about: summary.about,
                bound,
                measured,
                reached: measured <= bound,
            }));
        }
    }
    targets
}

/// The ratios to `f64` as a table for people: a line per input and size, a column per method; and what decided the
/// comparisons of filtered times.
pub fn table(summaries: &[Summary], methods: &[Method]) -> String {
    let mut text = format!("{:<16} {:>7} {:>10}", "input", "tets", "f64 ms");
    for method in methods {
        text += &format!(" {:>10}", short(&method.to_string()));
    }
    text += &format!(
        " {:>10} {:>8} {:>8} {:>8}\n",
        "filt/cav", "floats", "exact", "perturb"
    );
    for class in summaries.chunk_by(|a, b| (a.input, a.about) == (b.input, b.about)) {
        let of = |method: &str| class.iter().find(|s| s.method == method);
        let milliseconds = of("flip f64:plain").and_then(|s| s.median_milliseconds);
        text += &format!(
            "{:<16} {:>7} {:>10}",
            class[0].input,
            class[0].about,
            number(milliseconds)
        );
        for method in methods {
            let summary = of(&method.to_string());
            let mark = match summary {
                Some(s) if s.succeeded < s.inputs => "*",
                _ => "",
            };
            let ratio = number(summary.and_then(|s| s.ratio_to_f64));
            text += &format!(" {:>10}", format!("{ratio}{mark}"));
        }
        let filtered = of("flip filtered");
        let columns: [fn(&Summary) -> Option<f64>; 4] = [
            |s| s.ratio_to_cavity,
            |s| s.by_floats,
            |s| s.by_exact_quotients,
            |s| s.by_perturbation,
        ];
        let [ratio, floats, exact, perturbation] = columns.map(|f| number(filtered.and_then(f)));
        text += &format!(" {ratio:>10} {floats:>8} {exact:>8} {perturbation:>8}\n");
    }
    text + "(* some runs failed; the time is that of the failed run, its undoing included)\n"
}

fn short(method: &str) -> &str {
    match method.strip_prefix("flip ") {
        Some(times) if times.contains("queue=possible") => "same queue",
        Some(times) => times,
        None => method,
    }
}

#[cfg(test)]
mod tests {
    use super::super::input::{Cut, Input};
    use super::super::plan::methods;
    use super::*;

    /// Rows of one input, with the seconds of f64, filtered and cavity; in the same queue f64 takes half as long.
    fn rows(kind: Kind, about: u64, seed: u64, [f64, filtered, cavity]: [f64; 3]) -> Vec<Row> {
        let input = Input { kind, about, seed };
        let of_method = |(method, seconds): (usize, f64)| Row {
            median_seconds: Some(seconds),
            outcome: if method == 0 && kind.is_lattice() {
                "stuck"
            } else {
                "ok"
            },
            by_floats: (method == 2).then_some(0.75),
            ..Row::new(&input, methods()[method])
        };
        [
            (0, f64),
            (2, filtered),
            (4, f64 / 2.0),
            (methods().len() - 2, cavity),
        ]
        .map(of_method)
        .to_vec()
    }

    #[test]
    fn ratios_are_paired_and_targets_judged() {
        let mut all = rows(Kind::Slab, 1000, 1, [1.0, 1.2, 1.0]);
        all.extend(rows(Kind::Slab, 1000, 2, [10.0, 10.0, 5.0]));
        all.extend(rows(Kind::Slab, 1000, 3, [10.0, 9.0, 12.0]));
        all.extend(rows(Kind::Lattice(Cut::Tilted), 500, 1, [1.0, 3.0, 1.0]));
        all.extend(rows(Kind::Sphere, 500, 1, [1.0, 3.0, 1.0]));
        let summaries = summaries(&all, &methods());
        assert_eq!(summaries.len(), 12);
        let filtered = &summaries[1];
        assert_eq!((filtered.inputs, filtered.succeeded), (3, 3));
        assert_eq!(
            (filtered.ratio_to_f64, filtered.ratio_to_cavity),
            (Some(1.0), Some(1.2))
        );
        let to_same_queue = [
            filtered.least_to_same_queue,
            filtered.ratio_to_same_queue,
            filtered.most_to_same_queue,
        ];
        assert_eq!(to_same_queue, [Some(1.8), Some(2.0), Some(2.4)]);
        assert_eq!(filtered.by_floats, Some(0.75));
        assert_eq!(summaries[4].succeeded, 0);
        let targets = targets(&summaries);
        let reached: Vec<_> = targets.iter().map(|t| (t.bound, t.reached)).collect();
        assert_eq!(reached, [(1.1, true), (2.0, false), (1.0, false)]);
        let table = table(&summaries, &methods());
        assert!(table.lines().nth(2).unwrap().contains(" 1* "), "{table}");
    }
}
