//! The area of a facet, exactly: the cells into which its edges divide its plane.
//!
//! The facet is projected along a coordinate axis that its plane does not contain, and its edges (which meet in common
//! vertices only) are taken as a planar map. Each half-edge has a face cycle to its left; a cycle of positive area is
//! the boundary of a bounded face of its connected component. A point is in a *cell*, which is named by the positive
//! cycle of every component around the point, if any: two points that no component separates are not separated by all
//! together (Janiszewski), so that this names the parts of the plane rightly. The unbounded cell is in no cycle. The area
//! of the facet is all bounded cells without those that hold a hole point.
//!
//! O(m log m) to build for m edges, O(m) for each point.

use super::points::Points;
use super::tables::sorted2;
use crate::mesh::VertexId;
use crate::number::{Dyadic, Exact, Sign};
use std::cmp::Ordering;
use std::collections::BTreeMap;

/// The cells of a facet and which of them belong to it.
pub(super) struct Area<'a> {
    points: &'a Points,
    /// The two axes of the projection, such that (axes, dropped axis) is a right-handed frame.
    axes: [usize; 2],
    /// From, to. The twin of half-edge h is h ^ 1.
    half_edges: Vec<[VertexId; 2]>,
    /// The cycle to the left of each half-edge.
    cycle_of: Vec<usize>,
    /// The half-edges of each cycle.
    cycles: Vec<Vec<usize>>,
    /// The positive cycles of each connected component.
    positive: Vec<Vec<usize>>,
    /// The cells by name; a component's positive cycle, or none.
    cells: BTreeMap<Vec<Option<usize>>, usize>,
    /// The cell to the left of each cycle.
    cell_of: Vec<usize>,
    /// Whether a cell belongs to the area.
    kept: Vec<bool>,
}

/// How the ray from the centroid of q in the direction of the first axis crosses the edge ab: +1 upwards, −1 downwards,
/// 0 not at all. An end belongs to the upper edge at it; a point on an edge counts as right of it. So the sum over a
/// closed polygon is its winding number around the point, a point on the boundary being moved consistently.
pub(super) fn crossing(
    points: &Points,
    axes: [usize; 2],
    [a, b]: [VertexId; 2],
    q: &[VertexId],
) -> i32 {
    let above = |v| !points.compare(axes[1], q, v).is_negative();
    match (above(a), above(b)) {
        (true, false) if points.side2d(axes, [a, b], q).is_positive() => 1,
        (false, true) if points.side2d(axes, [a, b], q).is_negative() => -1,
        _ => 0,
    }
}

impl<'a> Area<'a> {
    /// The area inside the edges (each once, in any direction), without the cells that hold one of the holes.
    pub(super) fn new(
        points: &'a Points,
        axes: [usize; 2],
        edges: &[[VertexId; 2]],
        holes: &[VertexId],
    ) -> Area<'a> {
        let half_edges: Vec<[VertexId; 2]> =
            edges.iter().flat_map(|&[a, b]| [[a, b], [b, a]]).collect();
        let next = next_around_faces(points, axes, &half_edges);
        let mut cycle_of = vec![usize::MAX; half_edges.len()];
        let mut cycles = Vec::new();
        for start in 0..half_edges.len() {
            if cycle_of[start] == usize::MAX {
                let mut cycle = Vec::new();
                let mut h = start;
                while cycle_of[h] == usize::MAX {
                    cycle_of[h] = cycles.len();
                    cycle.push(h);
                    h = next[h];
                }
                cycles.push(cycle);
            }
        }
        let mut area = Area {
            points,
            axes,
            half_edges,
            cycle_of,
            cycles,
            positive: Vec::new(),
            cells: BTreeMap::new(),
            cell_of: Vec::new(),
            kept: Vec::new(),
        };
        area.name_cells();
        for &hole in holes {
            let cell = area.cell_at(&[hole]);
            area.drop_cell(cell);
        }
        area
    }

    fn name_cells(&mut self) {
        // Cycles that share an edge (its two sides) or a vertex are in one component.
        let mut component: BTreeMap<VertexId, usize> = BTreeMap::new();
        let mut stack = Vec::new();
        let mut neighbours: BTreeMap<VertexId, Vec<VertexId>> = BTreeMap::new();
        for &[a, b] in &self.half_edges {
            neighbours.entry(a).or_default().push(b);
        }
        let mut count = 0;
        for &v in neighbours.keys() {
            if component.contains_key(&v) {
                continue;
            }
            stack.push(v);
            while let Some(w) = stack.pop() {
                if component.insert(w, count).is_none() {
                    stack.extend(&neighbours[&w]);
                }
            }
            count += 1;
        }
        self.positive = vec![Vec::new(); count];
        let component_of: Vec<usize> = self
            .cycles
            .iter()
            .map(|c| component[&self.half_edges[c[0]][0]])
            .collect();
        let is_positive: Vec<bool> = self
            .cycles
            .iter()
            .map(|c| self.cycle_sign(c).is_positive())
            .collect();
        for (c, &k) in component_of.iter().enumerate() {
            if is_positive[c] {
                self.positive[k].push(c);
            }
        }
        // The unbounded cell comes first.
        self.cells.insert(vec![None; count], 0);
        for c in 0..self.cycles.len() {
            let anchor = self.half_edges[self.cycles[c][0]][0];
            let name = (0..count)
                .map(|k| match k == component_of[c] {
                    true => is_positive[c].then_some(c),
                    false => self.cycle_around(k, &[anchor]),
                })
                .collect();
            let new = self.cells.len();
            self.cell_of.push(*self.cells.entry(name).or_insert(new));
        }
        self.kept = vec![true; self.cells.len()];
        self.kept[0] = false;
    }

    /// The sign of the area to the left of a cycle.
    fn cycle_sign(&self, cycle: &[usize]) -> Sign {
        let from = |h: &usize| self.half_edges[*h][0];
        if let [a, b, c] = cycle {
            return self.points.orient2d(self.axes, [from(a), from(b), from(c)]);
        }
        self.twice_area_of(cycle.iter().copied()).exact_sign()
    }

    fn twice_area_of(&self, half_edges: impl Iterator<Item = usize>) -> Dyadic {
        let Some(&[origin, _]) = self.half_edges.first() else {
            return Dyadic::ZERO;
        };
        half_edges.fold(Dyadic::ZERO, |sum, h| {
            let [a, b] = self.half_edges[h];
            sum + &self.points.area(self.axes, [origin, a, b])
        })
    }

    /// The positive cycle of a component that contains the centroid of q.
    fn cycle_around(&self, component: usize, q: &[VertexId]) -> Option<usize> {
        self.positive[component].iter().copied().find(|&c| {
            let crossings = self.cycles[c]
                .iter()
                .map(|&h| crossing(self.points, self.axes, self.half_edges[h], q));
            crossings.sum::<i32>() != 0
        })
    }

    /// The cell that contains the centroid of q; the unbounded one is 0.
    pub(super) fn cell_at(&self, q: &[VertexId]) -> usize {
        let name: Vec<_> = (0..self.positive.len())
            .map(|k| self.cycle_around(k, q))
            .collect();
        // A name that no cycle has is possible only if edges cross: no cell.
        self.cells.get(&name).copied().unwrap_or(0)
    }

    /// Whether a cell belongs to the area.
    pub(super) fn is_kept(&self, cell: usize) -> bool {
        self.kept[cell]
    }

    /// All cells of the area.
    pub(super) fn kept_cells(&self) -> Vec<usize> {
        (0..self.kept.len()).filter(|&c| self.kept[c]).collect()
    }

    /// Takes a cell out of the area.
    pub(super) fn drop_cell(&mut self, cell: usize) {
        self.kept[cell] = false;
    }

    fn left(&self, h: usize) -> usize {
        self.cell_of[self.cycle_of[h]]
    }

    /// Whether the area lies to the left and to the right of the edge a→b.
    pub(super) fn sides(&self, edge: [VertexId; 2]) -> Option<[bool; 2]> {
        let h = self.half_edges.iter().position(|&e| e == edge)?;
        Some([h, h ^ 1].map(|h| self.kept[self.left(h)]))
    }

    /// The directed edges that have the area to their left only.
    pub(super) fn boundary(&self) -> Vec<[VertexId; 2]> {
        self.boundary_half_edges()
            .map(|h| self.half_edges[h])
            .collect()
    }

    fn boundary_half_edges(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.half_edges.len())
            .filter(|&h| self.kept[self.left(h)] && !self.kept[self.left(h ^ 1)])
    }

    /// Twice the area, exactly.
    pub(super) fn twice_area(&self) -> Dyadic {
        self.twice_area_of(self.boundary_half_edges())
    }

    /// The directed edges with a bounded cell to their left, dangling ones included.
    pub(super) fn edges_around(&self, cell: usize) -> Vec<[VertexId; 2]> {
        (0..self.half_edges.len())
            .filter(|&h| self.left(h) == cell)
            .map(|h| self.half_edges[h])
            .collect()
    }

    /// A convex corner (before, vertex, after) of a bounded cell: at the lexicographically smallest vertex of the cycle
    /// around it all edges leave into a half-plane, and the corner below 180 degrees is the one inside.
    pub(super) fn corner(&self, cell: usize) -> Option<[VertexId; 3]> {
        let cycle = (0..self.cycles.len())
            .filter(|&c| self.cell_of[c] == cell)
            .find(|&c| self.positive.iter().any(|p| p.contains(&c)))?;
        let cycle = &self.cycles[cycle];
        let order = |v: VertexId, w: VertexId| {
            let [x, y] = self.axes.map(|i| self.points.order(i, v, w));
            x.then(y)
        };
        let corners = (0..cycle.len()).map(|i| {
            let [a, b] = self.half_edges[cycle[i]];
            [a, b, self.half_edges[cycle[(i + 1) % cycle.len()]][1]]
        });
        corners
            .filter(|&c| self.points.orient2d(self.axes, c).is_positive())
            .min_by(|c, d| order(c[1], d[1]))
    }
}

/// For each half-edge the next one around the face to its left: at its head, the one just clockwise of its twin.
fn next_around_faces(
    points: &Points,
    axes: [usize; 2],
    half_edges: &[[VertexId; 2]],
) -> Vec<usize> {
    let mut out: Vec<usize> = (0..half_edges.len()).collect();
    out.sort_by(|&g, &h| {
        let ([a, p], [b, q]) = (half_edges[g], half_edges[h]);
        a.cmp(&b)
            .then_with(|| counterclockwise(points, axes, a, p, q))
    });
    let mut next = vec![0; half_edges.len()];
    for around in out.chunk_by(|&g, &h| half_edges[g][0] == half_edges[h][0]) {
        for (i, &h) in around.iter().enumerate() {
            // h leaves the vertex; its twin arrives.
            next[h ^ 1] = around[(i + around.len() - 1) % around.len()];
        }
    }
    next
}

/// The order of the directions from v to p and q, counterclockwise from the first axis.
fn counterclockwise(
    points: &Points,
    axes: [usize; 2],
    v: VertexId,
    p: VertexId,
    q: VertexId,
) -> Ordering {
    let is_lower = |w: VertexId| {
        let [x, y] = axes.map(|i| points.order(i, w, v));
        y.then(x).is_lt()
    };
    is_lower(p)
        .cmp(&is_lower(q))
        .then_with(|| match points.orient2d(axes, [v, p, q]) {
            Sign::Positive => Ordering::Less,
            Sign::Negative => Ordering::Greater,
            Sign::Zero => p.cmp(&q),
        })
}

/// The edges without repetition.
pub(super) fn distinct(edges: impl Iterator<Item = [VertexId; 2]>) -> Vec<[VertexId; 2]> {
    let mut edges: Vec<_> = edges.map(sorted2).collect();
    edges.sort_unstable();
    edges.dedup();
    edges
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Number;

    fn square(x: f64, y: f64, r: f64) -> Vec<[f64; 3]> {
        vec![
            [x - r, y - r, 0.],
            [x + r, y - r, 0.],
            [x + r, y + r, 0.],
            [x - r, y + r, 0.],
        ]
    }

    fn ring(first: usize) -> Vec<[VertexId; 2]> {
        (0..4)
            .map(|i| [first + i, first + (i + 1) % 4].map(VertexId::new))
            .collect()
    }

    /// A square with a square in it that holds another one, and two points: in the ring, in the middle.
    fn nested() -> (Points, Vec<[VertexId; 2]>) {
        let mut p = square(0., 0., 4.);
        p.extend(square(0., 0., 2.));
        p.extend(square(0.5, 0., 1.));
        p.extend([[-1.5, 0., 0.], [0.5, 0.5, 0.], [3., 0., 0.], [9., 0., 0.]]);
        (Points::new(p), [ring(0), ring(4), ring(8)].concat())
    }

    #[test]
    fn polygons_bound_everything_inside_them() {
        let (points, edges) = nested();
        let area = Area::new(&points, [0, 1], &edges, &[]);
        assert_eq!(area.twice_area().to_f64(), 2.0 * 64.0);
        assert_eq!(area.boundary().len(), 4);
        assert_eq!(area.kept_cells().len(), 3);
    }

    #[test]
    fn a_hole_point_opens_its_part_only() {
        let (points, edges) = nested();
        let area = Area::new(&points, [0, 1], &edges, &[VertexId(12)]);
        assert_eq!(area.twice_area().to_f64(), 2.0 * (64.0 - 16.0 + 4.0));
        assert_eq!(area.boundary().len(), 12);
        let inside = |v| area.is_kept(area.cell_at(&[VertexId(v)]));
        assert_eq!([12, 13, 14, 15].map(inside), [false, true, true, false]);
        // The centroid of a point in the ring and one outside is in the hole's part or not, as it falls.
        assert!(area.is_kept(area.cell_at(&[VertexId(12), VertexId(13), VertexId(13)])));
    }

    #[test]
    fn dangling_edges_do_not_divide() {
        let mut p = square(0., 0., 4.);
        p.push([0., 1., 0.]);
        let points = Points::new(p);
        let mut edges = ring(0);
        edges.push([VertexId(0), VertexId(4)]);
        let area = Area::new(&points, [0, 1], &edges, &[]);
        assert_eq!(area.kept_cells().len(), 1);
        assert_eq!(area.boundary().len(), 4);
        assert_eq!(area.sides([VertexId(0), VertexId(4)]), Some([true, true]));
        assert_eq!(area.sides([VertexId(1), VertexId(0)]), Some([false, true]));
        let corner = area
            .corner(area.kept_cells()[0])
            .expect("a bounded cell has a corner");
        assert!(points.orient2d([0, 1], corner).is_positive());
    }

    #[test]
    fn a_diagonal_makes_two_cells() {
        let points = Points::new(square(0., 0., 1.));
        let mut edges = ring(0);
        edges.push([VertexId(0), VertexId(2)]);
        let mut area = Area::new(&points, [0, 1], &edges, &[]);
        let cell = area.cell_at(&[VertexId(0), VertexId(1), VertexId(2)]);
        assert_ne!(cell, area.cell_at(&[VertexId(0), VertexId(2), VertexId(3)]));
        area.drop_cell(cell);
        assert_eq!(area.twice_area().to_f64(), 4.0);
        assert_eq!(area.sides([VertexId(0), VertexId(2)]), Some([true, false]));
    }
}
