//! The broad phase: pairs of simplices (vertices, edges, triangles) that may touch, found by dividing space.
//!
//! A k-d tree of cells, built and left in one traversal: a cell with many simplices is cut in two at the median of
//! their centres, and a simplex goes to both halves only if it reaches into both. Of long simplices, which a bounding
//! box describes badly, that is decided by separating axes (Akenine-Möller, *Fast 3D triangle-box overlap testing*,
//! 2001) in doubles with a margin for their rounding, so that no simplex is lost. Where no cut across a coordinate axis
//! helps, because long simplices run side by side in another direction, a cut along that direction is tried.
//!
//! Only pairs without a common vertex are wanted. Where all simplices of a cell share a vertex there are none, so that
//! a fan of any number of triangles costs nothing at its apex. Where many triangles share an edge, the pages of a book,
//! they are parted by planes through its spine, exactly.
//!
//! O(n log n) for n simplices of bounded overlap, for fans and for books. Where cutting does not help, all pairs of the
//! cell are tried, except those within the simplices that share the commonest vertex.

use super::reach::{range_in_cell, separated};
use crate::mesh::VertexId;
use crate::number::Sign;
use crate::number::vector::cross;
use crate::plc::orient3d;
use arrayvec::ArrayVec;
use rustc_hash::FxHashMap;
use std::cmp::Ordering;
use std::ops::ControlFlow;

type Point = [f64; 3];

/// Cells with no more simplices are not cut.
const SMALL: usize = 24;
/// An upper bound on the depth, which is about log2 of the number of simplices.
pub(super) const DEEPEST: usize = 64;
/// A cut must leave at most this part of the pairs.
const PROGRESS: f64 = 0.85;

/// The corners of a simplex; of an edge or a vertex the last is repeated.
pub(super) type Corners = [VertexId; 3];

/// Simplices in space.
pub(super) struct Simplices<'a> {
    points: &'a [Point],
    pub(super) corners: &'a [Corners],
    boxes: Vec<Bounds>,
    /// The first edge and the first triangle; vertices come before, so that dimensions are in order.
    starts: [usize; 2],
    /// Which simplices belong to one triangulation of space, so that pairs of them are not wanted; empty if none is
    /// known to.
    known: &'a [bool],
}

/// An axis-parallel box.
#[derive(Clone, Copy)]
pub(super) struct Bounds {
    pub low: Point,
    pub high: Point,
}

/// All of space.
pub(super) const EVERYTHING: Bounds = Bounds {
    low: [f64::NEG_INFINITY; 3],
    high: [f64::INFINITY; 3],
};

/// A cell that is still to be divided, with its simplices.
#[derive(Clone)]
pub(super) struct Cell {
    pub bounds: Bounds,
    pub list: Vec<u32>,
    pub depth: usize,
}

/// What becomes of the simplices of a cell.
pub(super) enum Step {
    /// No pair of them is wanted.
    Nothing,
    /// All pairs are visited.
    Compare(Vec<u32>),
    /// They are divided.
    Halves([(Bounds, Vec<u32>); 2]),
}

impl Bounds {
    fn overlaps(&self, other: &Bounds) -> bool {
        (0..3).all(|k| self.low[k] <= other.high[k] && other.low[k] <= self.high[k])
    }

    fn contains(&self, p: &Point) -> bool {
        (0..3).all(|k| self.low[k] <= p[k] && p[k] <= self.high[k])
    }

    fn intersection(&self, other: &Bounds) -> Bounds {
        Bounds {
            low: [0, 1, 2].map(|k| self.low[k].max(other.low[k])),
            high: [0, 1, 2].map(|k| self.high[k].min(other.high[k])),
        }
    }
}

/// A pair of simplices by their indices, the one of lower dimension first.
pub(super) type Visit<'v> = &'v mut dyn FnMut(usize, usize) -> ControlFlow<()>;

impl<'a> Simplices<'a> {
    /// `corners` holds vertices, then edges, then triangles, which begin at `starts`. Those that are `known`, if that
    /// is not empty, belong to one triangulation of space: they touch in common vertices and edges only.
    pub fn new(
        points: &'a [Point],
        corners: &'a [Corners],
        starts: [usize; 2],
        known: &'a [bool],
    ) -> Self {
        let bounds = |corners: &Corners| {
            let [a, b, c] = corners.map(|v| points[v.index()]);
            Bounds {
                low: [0, 1, 2].map(|k| a[k].min(b[k]).min(c[k])),
                high: [0, 1, 2].map(|k| a[k].max(b[k]).max(c[k])),
            }
        };
        Simplices {
            points,
            corners,
            boxes: corners.iter().map(bounds).collect(),
            starts,
            known,
        }
    }

    fn is_known(&self, i: usize) -> bool {
        self.known.get(i) == Some(&true)
    }

    /// Visits all pairs that have no common vertex and may have a common point: vertices with edges and triangles,
    /// edges with edges and triangles. Some pairs are visited more than once.
    pub fn pairs(&self, visit: Visit) -> ControlFlow<()> {
        let Cell {
            bounds,
            list,
            depth,
        } = self.everything();
        self.divide(&bounds, list, depth, visit)
    }

    /// All simplices.
    pub fn everything(&self) -> Cell {
        Cell {
            bounds: EVERYTHING,
            list: (0..self.corners.len()).map(|i| i as u32).collect(),
            depth: DEEPEST,
        }
    }

    /// A part of the work of [`Simplices::pairs`] on the last of some cells: visits its pairs, or puts its halves into
    /// its place. Until no cell is left, it visits the same pairs in the same order.
    pub fn advance(&self, cells: &mut Vec<Cell>, visit: Visit) -> ControlFlow<()> {
        let Some(cell) = cells.pop() else {
            return ControlFlow::Continue(());
        };
        match self.step(&cell.bounds, cell.list, cell.depth) {
            Step::Nothing => ControlFlow::Continue(()),
            Step::Compare(list) => self.compare(&list, visit),
            Step::Halves(halves) => {
                let halves = halves.map(|(bounds, list)| Cell {
                    bounds,
                    list,
                    depth: cell.depth - 1,
                });
                cells.extend(halves.into_iter().rev());
                ControlFlow::Continue(())
            }
        }
    }

    pub(super) fn divide(
        &self,
        cell: &Bounds,
        list: Vec<u32>,
        depth: usize,
        visit: Visit,
    ) -> ControlFlow<()> {
        match self.step(cell, list, depth) {
            Step::Nothing => ControlFlow::Continue(()),
            Step::Compare(list) => self.compare(&list, visit),
            Step::Halves([(left_cell, left), (right_cell, right)]) => {
                self.divide(&left_cell, left, depth - 1, visit)?;
                self.divide(&right_cell, right, depth - 1, visit)
            }
        }
    }

    /// What to do with the simplices of a cell.
    pub(super) fn step(&self, cell: &Bounds, list: Vec<u32>, depth: usize) -> Step {
        if list.iter().all(|&i| self.is_known(i as usize)) {
            return Step::Nothing;
        }
        if list.len() <= SMALL || depth == 0 {
            return Step::Compare(list);
        }
        if self.is_fan(&list) {
            return Step::Nothing;
        }
        let tight = self.tight(cell, &list);
        let size = |k: usize| 0.5 * tight.high[k] - 0.5 * tight.low[k];
        let mut axes = [0, 1, 2];
        axes.sort_by(|&j, &k| size(k).total_cmp(&size(j)));
        for axis in axes {
            if let Some(([low, high], [left, right])) = self.cut(&tight, &list, axis) {
                return Step::Halves([(low, left), (high, right)]);
            }
        }
        if let Some(halves) = self.cut_book(&list) {
            return Step::Halves(halves.map(|half| (tight, half)));
        }
        for direction in self.across_longest(&list) {
            if let Some(halves) = self.cut_across(&tight, &list, direction) {
                return Step::Halves(halves.map(|half| (tight, half)));
            }
        }
        Step::Compare(list)
    }

    /// Whether all simplices have one vertex in common.
    fn is_fan(&self, list: &[u32]) -> bool {
        let corners = |i: &u32| self.corners[*i as usize];
        let common = |v: VertexId| list.iter().all(|i| corners(i).contains(&v));
        corners(&list[0]).into_iter().any(common)
    }

    /// The part of a cell that its simplices can reach.
    fn tight(&self, cell: &Bounds, list: &[u32]) -> Bounds {
        let mut union = self.boxes[list[0] as usize];
        for &i in list {
            let b = &self.boxes[i as usize];
            for k in 0..3 {
                union.low[k] = union.low[k].min(b.low[k]);
                union.high[k] = union.high[k].max(b.high[k]);
            }
        }
        cell.intersection(&union)
    }

    /// Cuts a cell across an axis; `None` if that would not help.
    fn cut(
        &self,
        cell: &Bounds,
        list: &[u32],
        axis: usize,
    ) -> Option<([Bounds; 2], [Vec<u32>; 2])> {
        /// More do not make the median much better.
        const SAMPLE: usize = 256;
        let centre = |&i: &u32| {
            let b = self.boxes[i as usize].intersection(cell);
            0.5 * b.low[axis] + 0.5 * b.high[axis]
        };
        let step = list.len().div_ceil(SAMPLE);
        let mut sample: Vec<f64> = list.iter().step_by(step).map(centre).collect();
        let middle = sample.len() / 2;
        let at = *sample.select_nth_unstable_by(middle, f64::total_cmp).1;
        let (mut low, mut high) = (*cell, *cell);
        low.high[axis] = at;
        high.low[axis] = at;
        let mut halves = [Vec::new(), Vec::new()];
        for &i in list {
            let b = &self.boxes[i as usize];
            let both = b.low[axis] <= at && at <= b.high[axis];
            if b.low[axis] <= at && (!both || self.reaches(i, &low)) {
                halves[0].push(i);
            }
            if at <= b.high[axis] && (!both || self.reaches(i, &high)) {
                halves[1].push(i);
            }
        }
        self.helps(list, &halves).then_some(([low, high], halves))
    }

    /// Two directions at right angles to the longest edge in a list, approximately.
    fn across_longest(&self, list: &[u32]) -> Vec<Point> {
        let mut longest = (0.0, [0.0; 3]);
        for &i in list {
            let [a, b, c] = self.corners[i as usize].map(|v| self.points[v.index()]);
            for (p, q) in [(a, b), (b, c), (c, a)] {
                let edge = [0, 1, 2].map(|k| 0.5 * q[k] - 0.5 * p[k]);
                let length = edge.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
                if length > longest.0 {
                    longest = (length, edge);
                }
            }
        }
        let (length, edge) = longest;
        if length == 0.0 {
            return Vec::new();
        }
        let e = edge.map(|x| x / length);
        let least = (0..3).min_by(|&j, &k| e[j].abs().total_cmp(&e[k].abs()));
        let mut axis = [0.0; 3];
        axis[least.expect("three axes")] = 1.0;
        let first = cross(e, axis);
        vec![first, cross(e, first)]
    }

    /// Cuts a list across any direction; `None` if that would not help. The length of the direction is about 1.
    fn cut_across(&self, cell: &Bounds, list: &[u32], direction: Point) -> Option<[Vec<u32>; 2]> {
        let range = |&i: &u32| {
            let corners = self.corners[i as usize].map(|v| self.points[v.index()]);
            range_in_cell(corners, cell, direction)
        };
        let ranges: Vec<(f64, f64)> = list.iter().map(range).collect();
        let mut centres: Vec<f64> = ranges.iter().map(|r| 0.5 * r.0 + 0.5 * r.1).collect();
        let middle = centres.len() / 2;
        let at = *centres.select_nth_unstable_by(middle, f64::total_cmp).1;
        let side = |keep: &dyn Fn(&(f64, f64)) -> bool| -> Vec<u32> {
            let kept = list.iter().zip(&ranges).filter(|(_, r)| keep(r));
            kept.map(|(&i, _)| i).collect()
        };
        let halves = [side(&|r| r.0 <= at), side(&|r| r.1 >= at)];
        self.helps(list, &halves).then_some(halves)
    }

    /// Cuts a list in which many simplices share an edge ab, the spine of a book, by a plane through a, b and the
    /// vertex of a page in the middle; `None` if that would not help.
    ///
    /// A simplex on one side, apart from a and b, and one on the other side have nothing in common, if they have no
    /// common vertex: it would be in the plane, where each has a face of ab, and these are different ends or nothing.
    /// So what goes to one half only is decided by exact signs, but no simplex has to be clear of the spine.
    fn cut_book(&self, list: &[u32]) -> Option<[Vec<u32>; 2]> {
        /// Fewer pages are compared soon.
        const PAGES: usize = 2 * SMALL;
        const SAMPLE: usize = 256;
        let a = self.commonest_vertex(list);
        let at_a = |i: &&u32| self.corners[**i as usize].contains(&a);
        let fan: Vec<u32> = list.iter().filter(at_a).copied().collect();
        let mut counts: FxHashMap<VertexId, usize> = FxHashMap::default();
        let [_, triangles] = self.starts;
        let pages = fan.iter().filter(|&&i| i as usize >= triangles);
        for v in pages.clone().flat_map(|&i| self.corners[i as usize]) {
            if v != a {
                *counts.entry(v).or_default() += 1;
            }
        }
        let best = counts
            .into_iter()
            .max_by_key(|&(v, n)| (n, std::cmp::Reverse(v)));
        let (b, _) = best.filter(|&(_, n)| n >= PAGES)?;
        let apexes: Vec<VertexId> = pages
            .map(|&i| self.corners[i as usize])
            .filter(|corners| corners.contains(&b))
            .map(|corners| {
                let mut others = corners.into_iter().filter(|&v| v != a && v != b);
                others.next().expect("a triangle has three corners")
            })
            .collect();
        let at = |v: VertexId| self.points[v.index()];
        let side = |x: VertexId, y: VertexId| orient3d([at(a), at(b), at(x), at(y)]);
        let step = apexes.len().div_ceil(SAMPLE);
        let sample: Vec<VertexId> = apexes.iter().step_by(step).copied().collect();
        // Pages on one side of a plane through the spine are in order.
        let first = sample[0];
        let (left, right): (Vec<VertexId>, Vec<VertexId>) = sample
            .into_iter()
            .filter(|&x| !side(first, x).is_zero())
            .partition(|&x| side(first, x).is_positive());
        let mut half = if left.len() < right.len() {
            right
        } else {
            left
        };
        half.sort_by(|&x, &y| match side(x, y) {
            Sign::Positive => Ordering::Less,
            Sign::Zero => Ordering::Equal,
            Sign::Negative => Ordering::Greater,
        });
        let middle = half.get(half.len() / 2).copied().unwrap_or(first);
        let mut halves = [Vec::new(), Vec::new()];
        for &i in list {
            let corners = self.corners[i as usize].into_iter();
            let off = corners.filter(|&v| v != a && v != b);
            let signs: ArrayVec<Sign, 3> = off.map(|v| side(middle, v)).collect();
            if !signs.iter().all(|s| s.is_negative()) || signs.is_empty() {
                halves[0].push(i);
            }
            if !signs.iter().all(|s| s.is_positive()) || signs.is_empty() {
                halves[1].push(i);
            }
        }
        let square = |list: &[u32]| (list.len() as f64).powi(2);
        let fewer = square(&halves[0]) + square(&halves[1]) <= PROGRESS * square(list);
        fewer.then_some(halves)
    }

    /// Whether a cut leaves clearly fewer pairs. Pairs that share the commonest vertex count only where that matters:
    /// about the apex of a fan, which one of the halves has to hold, the simplices of the fan cannot be parted.
    fn helps(&self, list: &[u32], halves: &[Vec<u32>; 2]) -> bool {
        /// Shorter lists are compared soon anyway.
        const LONG: usize = 200;
        let square = |list: &[u32]| (list.len() as f64).powi(2);
        let fewer = |count: &dyn Fn(&[u32]) -> f64| {
            count(&halves[0]) + count(&halves[1]) <= PROGRESS * count(list)
        };
        if fewer(&square) || list.len() < LONG {
            return fewer(&square);
        }
        let hub = self.commonest_vertex(list);
        fewer(&|list: &[u32]| {
            let at_hub = |i: &&u32| self.corners[**i as usize].contains(&hub);
            let fan = list.iter().filter(at_hub).count() as f64;
            let others = list.len() as f64 - fan;
            others * (others + 2.0 * fan)
        })
    }

    /// Whether a simplex may have a point in a cell. Never wrongly no.
    fn reaches(&self, i: u32, cell: &Bounds) -> bool {
        let corners = self.corners[i as usize].map(|v| self.points[v.index()]);
        // Mostly a corner is there, which needs no arithmetic.
        corners.iter().any(|p| cell.contains(p))
            || self.boxes[i as usize].overlaps(cell) && !separated(corners, cell)
    }

    /// Visits the pairs of a list.
    pub(super) fn compare(&self, list: &[u32], visit: Visit) -> ControlFlow<()> {
        if list.len() <= SMALL {
            return self.compare_lists(list, list, true, visit);
        }
        let hub = self.commonest_vertex(list);
        let at_hub = |i: &&u32| self.corners[**i as usize].contains(&hub);
        let fan: Vec<u32> = list.iter().filter(at_hub).copied().collect();
        let others: Vec<u32> = list.iter().filter(|i| !at_hub(i)).copied().collect();
        self.compare_lists(&others, &others, true, visit)?;
        self.compare_lists(&others, &fan, false, visit)
    }

    fn compare_lists(
        &self,
        first: &[u32],
        second: &[u32],
        same: bool,
        visit: Visit,
    ) -> ControlFlow<()> {
        let [edges, triangles] = self.starts;
        for (k, &i) in first.iter().enumerate() {
            let rest = if same { &second[k + 1..] } else { second };
            for &j in rest {
                // The order of dimensions is that of the indices.
                let (i, j) = (i.min(j) as usize, i.max(j) as usize);
                if i >= triangles || j < edges || !self.boxes[i].overlaps(&self.boxes[j]) {
                    continue;
                }
                if self.is_known(i) && self.is_known(j) {
                    continue;
                }
                let [p, q] = [self.corners[i], self.corners[j]];
                if !p.iter().any(|v| q.contains(v)) {
                    visit(i, j)?;
                }
            }
        }
        ControlFlow::Continue(())
    }

    /// The vertex that most simplices have; the lowest of several.
    fn commonest_vertex(&self, list: &[u32]) -> VertexId {
        let mut counts: FxHashMap<VertexId, usize> = FxHashMap::default();
        for &i in list {
            for v in self.corners[i as usize] {
                *counts.entry(v).or_default() += 1;
            }
        }
        let best = counts
            .into_iter()
            .max_by_key(|&(v, n)| (n, std::cmp::Reverse(v)));
        best.expect("a simplex has vertices").0
    }
}
