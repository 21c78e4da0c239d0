//! Exact Steiner points as doubles, for output, without inverted or flat tetrahedra where that is possible.
//!
//! Every coordinate is rounded to nearest first, and ends at most one double from there. Where a tetrahedron is not
//! positive then, its vertices that have been rounded are tried at the neighbouring doubles, and the place is taken
//! that leaves the fewest tetrahedra around the vertex that are not positive, if those are fewer than before. The
//! number of such tetrahedra falls with every move, so this ends. What remains is reported: it is positive with the
//! exact positions, which are part of the output ([`ExactPosition`](crate::exchange::ExactPosition)).
//!
//! Linear time, apart from the vertices that are tried.

use crate::mesh::VertexId;
use crate::predicate::coordinates::orient3d;
use crate::predicate::{DoublePoints, PointStore};
use rustc_hash::FxHashMap;

/// Rounded coordinates.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rounding {
    /// Of all points.
    pub coordinates: Vec<[f64; 3]>,
    /// How many points are not at the nearest doubles, so that tetrahedra are positive.
    pub moved: usize,
    /// The tetrahedra that are not positive, by index, ascending.
    pub spoilt: Vec<usize>,
}

/// Rounds all points. `tets` are positive.
pub fn round(points: &DoublePoints, tets: &[[VertexId; 4]]) -> Rounding {
    let coordinates: Vec<[f64; 3]> = (0..points.len())
        .map(|v| points.rounded(VertexId::new(v)))
        .collect();
    if points.count_not_double() == 0 {
        return Rounding {
            coordinates,
            ..Rounding::default()
        };
    }
    let is_rounded = |v: &VertexId| !points.is_double(*v);
    let rounded: Vec<usize> = (0..tets.len())
        .filter(|&t| tets[t].iter().any(is_rounded))
        .collect();
    let mut trial = Trial {
        coordinates: coordinates.clone(),
        nearest: &coordinates,
        tets,
        moved: FxHashMap::default(),
        time: 1,
    };
    let mut spoilt: Vec<usize> = rounded
        .iter()
        .copied()
        .filter(|&t| !trial.is_positive(t))
        .collect();
    if !spoilt.is_empty() {
        let mut stars: FxHashMap<VertexId, Vec<usize>> = FxHashMap::default();
        for v in spoilt.iter().flat_map(|&t| tets[t]).filter(is_rounded) {
            stars.insert(v, Vec::new());
        }
        for &t in &rounded {
            for v in tets[t] {
                if let Some(star) = stars.get_mut(&v) {
                    star.push(t);
                }
            }
        }
        // When each tetrahedron has been tried; it is not tried again until something around it has moved.
        let mut tried = vec![0; spoilt.len()];
        let mut improved = true;
        while improved {
            improved = false;
            for (&t, tried) in spoilt.iter().zip(&mut tried) {
                let vertices = || tets[t].into_iter().filter(is_rounded);
                let around = vertices().flat_map(|v| &stars[&v]);
                let mut corners = around.flat_map(|&t| tets[t]);
                let is_new = *tried == 0 || corners.any(|v| trial.moved.get(&v) > Some(&*tried));
                if is_new && !trial.is_positive(t) {
                    *tried = trial.time;
                    improved |= trial.repair(vertices(), &stars);
                }
            }
        }
        let mut touched: Vec<usize> = stars.into_values().flatten().collect();
        touched.sort_unstable();
        touched.dedup();
        spoilt = touched;
        spoilt.retain(|&t| !trial.is_positive(t));
    }
    Rounding {
        moved: (0..points.len())
            .filter(|&v| trial.coordinates[v] != coordinates[v])
            .count(),
        coordinates: trial.coordinates,
        spoilt,
    }
}

struct Trial<'a> {
    coordinates: Vec<[f64; 3]>,
    nearest: &'a [[f64; 3]],
    tets: &'a [[VertexId; 4]],
    /// When vertices have been moved last.
    moved: FxHashMap<VertexId, u64>,
    /// The number of moves, and one.
    time: u64,
}

impl Trial<'_> {
    fn is_positive(&self, t: usize) -> bool {
        let corners = self.tets[t].map(|v| self.coordinates[v.index()]);
        orient3d(corners).is_positive()
    }

    fn bad(&self, star: &[usize]) -> usize {
        star.iter().filter(|&&t| !self.is_positive(t)).count()
    }

    /// Moves one of the vertices to the neighbouring place that leaves the fewest bad tetrahedra, if it helps.
    fn repair(
        &mut self,
        vertices: impl Iterator<Item = VertexId>,
        stars: &FxHashMap<VertexId, Vec<usize>>,
    ) -> bool {
        let mut best: Option<(usize, VertexId, [f64; 3])> = None;
        for v in vertices {
            let star = &stars[&v];
            let now = self.bad(star);
            let home = self.coordinates[v.index()];
            for place in neighbours(self.nearest[v.index()]) {
                self.coordinates[v.index()] = place;
                let saved = now.saturating_sub(self.bad(star));
                if saved > best.map_or(0, |b| b.0) {
                    best = Some((saved, v, place));
                }
            }
            self.coordinates[v.index()] = home;
        }
        if let Some((_, v, place)) = best {
            self.coordinates[v.index()] = place;
            self.time += 1;
            self.moved.insert(v, self.time);
        }
        best.is_some()
    }
}

/// The places at most one step away in some coordinates, those that change fewer of them first.
fn neighbours(p: [f64; 3]) -> Vec<[f64; 3]> {
    let step = |x: f64, k: usize| match k {
        0 => x,
        1 => x.next_down(),
        _ => x.next_up(),
    };
    let mut steps: Vec<[usize; 3]> = (0..27).map(|k| [k / 9, k / 3 % 3, k % 3]).collect();
    steps.sort_by_key(|k| k.iter().filter(|&&k| k > 0).count());
    let places = steps.iter().map(|k| [0, 1, 2].map(|i| step(p[i], k[i])));
    places.filter(|p| p.iter().all(|x| x.is_finite())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::predicate::{GrowingStore, Steiner};

    /// A flat tetrahedron, one vertex of which is a third of the way along an edge that rises by a few ulps.
    #[test]
    fn moves_a_vertex_or_says_so() {
        let up = 1.0 + 4.0 * f64::EPSILON;
        let vertices = vec![
            [0.0, 0.0, 1.0],
            [1.0, 0.0, 1.0],
            [0.0, 1.0, 1.0],
            [0.25, 0.25, 1.0],
            [0.5, 0.25, up],
        ];
        let mut points = DoublePoints::new(vertices).with_steiner(Steiner::Exact);
        let [a, b, c, p, q] = [0, 1, 2, 3, 4].map(VertexId);
        // Above the plane z = 1 by less than half an ulp.
        let v = points.push_on_segment(p, q, 0.1.into());
        assert!(!points.is_double(v));
        assert!(points.orient3d([a, b, c, v]).is_positive());
        let rounding = round(&points, &[[a, b, c, v]]);
        assert_eq!((rounding.moved, &rounding.spoilt[..]), (1, &[][..]));
        assert!(rounding.coordinates[v.index()][2] > 1.0);
        // With another vertex less than an ulp above it, one of the two tetrahedra cannot be saved by one move of v.
        let w = points.push_on_segment(p, q, 0.11.into());
        let tets = [[a, b, c, v], [a, b, v, w]];
        assert!(tets.iter().all(|&t| points.orient3d(t).is_positive()));
        let rounding = round(&points, &tets);
        for (t, tet) in tets.iter().enumerate() {
            let store = DoublePoints::new(rounding.coordinates.clone());
            assert_eq!(
                rounding.spoilt.contains(&t),
                !store.orient3d(*tet).is_positive()
            );
        }
    }
}
