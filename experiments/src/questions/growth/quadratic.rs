//! Flips where there are quadratically many: n points whose Delaunay tetrahedralization has Θ(n²) tetrahedra, all of
//! which, or a constant part of them, a polygon crosses. The bound of Shewchuk (2003) on constructing a CDT by
//! inserting polygons, O(n² log n) in three dimensions, is met there but for the logarithm.
//!
//! - `moment-curve`: points (t, t², t³). One rectangle parts them in halves; `moment-curve/7` has seven parallel ones,
//!   which part them in eighths, the middle one first.
//! - `skew-lines`: points on two lines that do not meet, and a rectangle between them.

use super::fit::power_law;
use crate::families::Draw;
use crate::measure::method::Method;
use crate::measure::outcome;
use crate::measure::rounds::{Effort, Scene};
use crate::measure::sample::{median, rounded};
use serde::Serialize;
use tetflip::exchange::{Facet, Plc};
use tetflip::mesh::VertexId;
use tetflip::recover::polygons::{FlipOrder, Insertion};

/// The names.
pub const KINDS: [&str; 3] = ["moment-curve", "moment-curve/7", "skew-lines"];

const METHODS: [Method; 2] = [
    Method(Insertion::Flip(FlipOrder::FILTERED)),
    Method(Insertion::Cavity),
];

/// `growth-quadratic.csv`: the insertion of all rectangles by flips.
#[allow(missing_docs)]
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Row {
    pub input: &'static str,
    pub points: usize,
    pub polygons: usize,
    pub steiner_points: usize,
    pub crossing_tets: u64,
    pub flips: u64,
    pub queued: u64,
    pub comparisons: u64,
    pub compared_exactly: u64,
    pub median_seconds: Option<f64>,
    pub outcome: &'static str,
    pub agrees: Option<bool>,
}

/// `growth-quadratic-summary.csv`: how they grow with the number of points.
#[allow(missing_docs)]
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Summary {
    pub input: &'static str,
    pub from_points: usize,
    pub to_points: usize,
    pub flips_exponent: f64,
    pub least_flips_over_square: f64,
    pub most_flips_over_square: f64,
    pub seconds_exponent: f64,
}

/// The PLC of a kind with so many points, an even number.
fn plc(kind: &str, n: usize) -> Plc {
    let mut draw = Draw::new(n as u64, 7);
    // In (−1, 1), ascending, half of them negative.
    let mut place =
        |i: usize, n: usize| (2.0 * i as f64 + 1.0 + 0.5 * draw.fraction()) / n as f64 - 1.0;
    let mut vertices: Vec<[f64; 3]> = match kind {
        "skew-lines" => {
            let first = (0..n / 2)
                .map(|i| [place(i, n / 2), 0.0, 1.0])
                .collect::<Vec<_>>();
            let second = (0..n / 2).map(|i| [0.0, place(i, n / 2), -1.0]);
            first.into_iter().chain(second).collect()
        }
        _ => {
            let on_curve = |t: f64| [t, t * t, t * t * t];
            (0..n).map(|i| on_curve(place(i, n))).collect()
        }
    };
    // x is constant, or z.
    let heights: &[f64] = match kind {
        "moment-curve/7" => &[0.0, -0.5, 0.5, -0.75, -0.25, 0.25, 0.75],
        _ => &[0.0],
    };
    let mut facets = Vec::new();
    for &h in heights {
        let first = vertices.len();
        let corner = |[u, v]: [f64; 2]| match kind {
            "skew-lines" => [u, v, h],
            _ => [h, u, v],
        };
        vertices.extend([[-3.0, -2.5], [3.0, -2.5], [3.0, 2.5], [-3.0, 2.5]].map(corner));
        facets.push(Facet {
            polygons: vec![(first..first + 4).map(VertexId::new).collect()],
            ..Facet::default()
        });
    }
    Plc {
        vertices,
        facets,
        ..Plc::default()
    }
}

/// One size of one kind.
pub fn measure(kind: &'static str, n: usize, effort: &Effort) -> Row {
    let plc = plc(kind, n);
    let mut row = Row {
        input: kind,
        points: n,
        polygons: plc.facets.len(),
        ..Row::default()
    };
    match Scene::measure(&plc, &METHODS, effort, |_| false) {
        Ok(scene) => {
            let (runs, flips) = (&scene.runs[0], &scene.runs[0].counts.flips);
            row.steiner_points = scene.steiner_points;
            row.crossing_tets = runs.counts.crossing_tets;
            row.flips = flips.flips();
            row.queued = flips.queued;
            row.comparisons = flips.comparisons;
            row.compared_exactly = flips.compared_exactly;
            row.median_seconds = median(&runs.seconds).map(rounded);
            row.outcome = outcome::word(&runs.result);
            row.agrees = Some(scene.agrees() && scene.runs[1].result.is_ok());
        }
        Err(failure) => row.outcome = outcome::word::<()>(&Err(failure)),
    }
    row
}

/// The fits of each kind.
pub fn summaries(rows: &[Row]) -> Vec<Summary> {
    let of_kind = |kind: &&'static str| {
        let good: Vec<&Row> = rows
            .iter()
            .filter(|r| r.input == *kind && r.outcome == outcome::OK)
            .collect();
        let points = |of: &dyn Fn(&Row) -> f64| -> Vec<(f64, f64)> {
            good.iter().map(|r| (r.points as f64, of(r))).collect()
        };
        let over_square = points(&|r| r.flips as f64 / (r.points * r.points) as f64);
        let extreme = |pick: fn(f64, f64) -> f64| over_square.iter().map(|p| p.1).reduce(pick);
        Some(Summary {
            input: kind,
            from_points: good.first()?.points,
            to_points: good.last()?.points,
            flips_exponent: rounded(power_law(&points(&|r| r.flips as f64))?.exponent),
            least_flips_over_square: rounded(extreme(f64::min)?),
            most_flips_over_square: rounded(extreme(f64::max)?),
            seconds_exponent: rounded(
                power_law(&points(&|r| r.median_seconds.unwrap_or(f64::NAN)))?.exponent,
            ),
        })
    };
    KINDS.iter().filter_map(of_kind).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flips_are_quadratically_many() {
        let effort = Effort {
            seconds: 0.0,
            least: 1,
            most: 1,
            of_slow: 1,
        };
        let sizes = [32, 64, 128];
        let rows: Vec<Row> = KINDS
            .iter()
            .flat_map(|kind| sizes.map(|n| measure(kind, n, &effort)))
            .collect();
        for row in &rows {
            assert_eq!(
                (row.outcome, row.agrees),
                (outcome::OK, Some(true)),
                "{row:?}"
            );
            assert!(
                row.crossing_tets as usize >= row.points * row.points / 8,
                "{row:?}"
            );
        }
        for summary in summaries(&rows) {
            assert!((1.4..2.3).contains(&summary.flips_exponent), "{summary:?}");
        }
    }
}
