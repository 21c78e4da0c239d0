//! `fig9-summary.csv`: times and their ratios by size class.

use super::Row;
use crate::frame::text::number;
use crate::measure::method::Method;
use crate::measure::sample::{median, rounded};
use serde::Serialize;

/// Lower bounds of the size classes, in crossing tetrahedra. The last class has no upper bound.
const CLASSES: [u64; 9] = [0, 30, 100, 300, 1000, 3000, 10_000, 30_000, 100_000];

/// One method in one size class. A ratio is the median, over the scenes in which both methods succeeded, of the ratio
/// of their median times.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Summary {
    /// The least number of crossing tetrahedra in the class.
    pub crossing_from: u64,
    /// The first number above the class; none for the last one.
    pub crossing_below: Option<u64>,
    /// The algorithm.
    pub insertion: &'static str,
    /// The number type of flip times.
    pub times: String,
    /// Scenes in the class.
    pub scenes: usize,
    /// Runs among them that succeeded.
    pub succeeded: usize,
    /// The median of the successful runs' times, in milliseconds.
    pub median_milliseconds: Option<f64>,
    /// The median of the successful runs' microseconds per crossing tetrahedron.
    pub median_microseconds_per_tet: Option<f64>,
    /// Time relative to cavity retriangulation.
    pub ratio_to_cavity: Option<f64>,
    /// Time relative to flips with `f64` times, the paper's.
    pub ratio_to_f64: Option<f64>,
    /// Time relative to flips with exact times.
    pub ratio_to_exact: Option<f64>,
}

/// All classes that have rows, in ascending order, with the methods in the order given.
pub fn summaries(rows: &[Row], methods: &[Method]) -> Vec<Summary> {
    let mut summaries = Vec::new();
    for (i, &from) in CLASSES.iter().enumerate() {
        let below = CLASSES.get(i + 1).copied();
        let in_class = |r: &&Row| {
            r.scene.crossing_tets >= from && below.is_none_or(|b| r.scene.crossing_tets < b)
        };
        let class: Vec<&Row> = rows.iter().filter(in_class).collect();
        if !class.is_empty() {
            let of_method = |&method| summary(&class, method, from, below);
            summaries.extend(methods.iter().map(of_method));
        }
    }
    summaries
}

fn summary(class: &[&Row], method: Method, from: u64, below: Option<u64>) -> Summary {
    let of_method = class.iter().copied().filter(|r| r.is_of(method));
    let ok: Vec<(&Row, f64)> = of_method
        .clone()
        .filter_map(|r| Some((r, r.seconds()?)))
        .collect();
    let median_of = |f: &dyn Fn(&(&Row, f64)) -> Option<f64>| {
        let sample: Vec<f64> = ok.iter().filter_map(f).collect();
        median(&sample).map(rounded)
    };
    let ratio_to = |insertion: &str, times: &str| {
        median_of(&|(row, seconds)| {
            let other = class.iter().find(|r| {
                r.scene == row.scene && (r.method.insertion, &*r.method.times) == (insertion, times)
            });
            Some(seconds / other?.seconds()?)
        })
    };
    Summary {
        crossing_from: from,
        crossing_below: below,
        insertion: method.insertion(),
        times: method.times(),
        scenes: of_method.count(),
        succeeded: ok.len(),
        median_milliseconds: median_of(&|(_, s)| Some(s * 1e3)),
        median_microseconds_per_tet: median_of(&|(r, s)| {
            Some(s * 1e6 / r.scene.crossing_tets as f64)
        }),
        ratio_to_cavity: ratio_to("cavity", ""),
        ratio_to_f64: ratio_to("flip", "f64:plain"),
        ratio_to_exact: ratio_to("flip", "exact"),
    }
}

/// The median milliseconds as a table for people: a line per size class, a column per method.
pub fn table(summaries: &[Summary], methods: &[Method]) -> String {
    let mut text = format!("{:>18} {:>7}", "crossing tets", "scenes");
    for method in methods {
        text += &format!(" {method:>13}");
    }
    text += "  exact/cavity  filtered/f64\n";
    for class in summaries.chunk_by(|a, b| a.crossing_from == b.crossing_from) {
        let first = &class[0];
        let below = first
            .crossing_below
            .map_or(String::new(), |b| (b - 1).to_string());
        let range = format!("{} – {below}", first.crossing_from);
        text += &format!("{range:>18} {:>7}", first.scenes);
        for summary in class {
            text += &format!(" {:>13}", number(summary.median_milliseconds));
        }
        let of = |times| class.iter().find(|s| s.times == times);
        let exact = of("exact").and_then(|s| s.ratio_to_cavity);
        let filtered = of("filtered").and_then(|s| s.ratio_to_f64);
        text += &format!(" {:>13} {:>13}\n", number(exact), number(filtered));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::inputs::slab::Slab;

    /// A scene with the given times of the methods; a missing time is a failed run.
    fn rows(seed: u64, crossing_tets: u64, seconds: [Option<f64>; 4]) -> Vec<Row> {
        let slab = Slab {
            vertices: 10,
            half_height: 1.0,
            seed,
        };
        let rows = Method::all()
            .into_iter()
            .zip(seconds)
            .map(|(method, seconds)| {
                let mut row = Row::new(slab, method);
                row.scene.crossing_tets = crossing_tets;
                row.timed.median_seconds = seconds.or(Some(1e9));
                row.end.outcome = if seconds.is_some() { "ok" } else { "stuck" };
                row
            });
        rows.collect()
    }

    #[test]
    fn ratios_are_taken_scene_by_scene() {
        let mut all = rows(1, 100, [Some(1.0), Some(1.5), Some(2.0), Some(4.0)]);
        all.extend(rows(2, 299, [Some(10.0), None, Some(20.0), Some(80.0)]));
        all.extend(rows(3, 300, [Some(0.1), None, None, Some(0.1)]));
        let summaries = summaries(&all, &Method::all()[..4]);
        assert_eq!(summaries.len(), 8);
        let (f32, exact) = (&summaries[1], &summaries[3]);
        assert_eq!(
            (exact.crossing_from, exact.crossing_below),
            (100, Some(300))
        );
        assert_eq!((exact.scenes, exact.succeeded), (2, 2));
        assert_eq!(
            (exact.ratio_to_cavity, exact.median_milliseconds),
            (Some(6.0), Some(42_000.0))
        );
        assert_eq!((f32.scenes, f32.succeeded), (2, 1));
        assert_eq!(
            (f32.ratio_to_cavity, f32.ratio_to_exact),
            (Some(1.5), Some(0.375))
        );
        assert_eq!(f32.median_microseconds_per_tet, Some(15_000.0));
        assert_eq!(summaries[6].ratio_to_exact, None);
        let table = table(&summaries, &Method::all()[..4]);
        let lines: Vec<&str> = table.lines().collect();
        assert!(
            lines.len() == 3 && lines[1].contains("100 – 299"),
            "{table}"
        );
    }
}
