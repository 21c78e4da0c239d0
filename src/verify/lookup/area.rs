//! The area of a facet, exactly: the cells into which its edges divide its plane.
//!
//! The facet is projected along a coordinate axis that its plane does not contain, and its edges (which meet in
//! common vertices only) are taken as a planar map. Each half-edge has a face cycle to its left; a cycle of positive
//! area is the boundary of a bounded face of its connected component. A point is in a *cell*, which is named by the
//! positive cycle of every component around the point, if any: two points that no component separates are not
//! separated by all together (Janiszewski), so that this names the parts of the plane rightly. The unbounded cell is
//! in no cycle. The area of the facet is all bounded cells without those that hold a hole point.
//!
//! O(m log m) to build for m edges. A point is looked for in the slab of the edges at its height ([`Slabs`]): O(k)
//! for k edges there; of the two directions, the one with fewer edges in a slab is taken.

use crate::mesh::VertexId;
use crate::number::{Dyadic, Sign};
use crate::verify::lookup::directions::next_around_faces;
use crate::verify::lookup::slabs::{self, Slabs};
use crate::verify::lookup::tables::sorted2;
use crate::verify::signs::points::Points;
use crate::verify::signs::ray::Probe;
use crate::verify::signs::sums::Areas;
use std::collections::BTreeMap;

/// From how many edges on they are sorted by slabs.
const MANY: usize = 24;

/// The cells of a facet and which of them belong to it.
pub(crate) struct Area<'a> {
    points: &'a Points,
    /// The two axes of the projection, such that (axes, dropped axis) is a right-handed frame.
    axes: [usize; 2],
    /// From, to. The twin of half-edge h is h ^ 1.
    half_edges: Vec<[VertexId; 2]>,
    /// The cycle to the left of each half-edge.
    cycle_of: Vec<usize>,
    /// The half-edges of each cycle.
    cycles: Vec<Vec<usize>>,
    /// The connected component of each cycle.
    component_of: Vec<usize>,
    /// Whether a cycle has a positive area.
    is_positive: Vec<bool>,
    /// The cells by name, that is the positive cycles, by their components; not used with one component.
    cells: BTreeMap<Vec<usize>, usize>,
    components: usize,
    /// The rays' axes: [`Area::axes`], or the other way round.
    ray: [usize; 2],
    /// The edges by slabs across the ray, if there are many.
    slabs: Option<Slabs>,
    /// The cell to the left of each cycle.
    cell_of: Vec<usize>,
    /// Whether a cell belongs to the area.
    kept: Vec<bool>,
    /// An edge because of which the cells are not known: a point in the plane, with two others at one of its ends. Only
    /// facets that are not flat can have one.
    pub(crate) upright: Option<[VertexId; 2]>,
}

impl<'a> Area<'a> {
    /// The area inside the edges (each once, in any direction), without the cells that hold one of the holes.
    pub(crate) fn new(
        points: &'a Points,
        axes: [usize; 2],
        edges: &[[VertexId; 2]],
        holes: &[VertexId],
    ) -> Area<'a> {
        let half_edges: Vec<[VertexId; 2]> =
            edges.iter().flat_map(|&[a, b]| [[a, b], [b, a]]).collect();
        let (next, upright) = next_around_faces(points, axes, &half_edges);
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
            component_of: Vec::new(),
            is_positive: Vec::new(),
            cells: BTreeMap::new(),
            components: 0,
            ray: axes,
            slabs: None,
            cell_of: Vec::new(),
            kept: Vec::new(),
            upright,
        };
        area.sort_edges();
        area.name_cells();
        for &hole in holes {
            let cell = area.cell_at(&[hole]);
            area.drop_cell(cell);
        }
        area
    }

    /// Chooses the rays and sorts the edges by slabs.
    fn sort_edges(&mut self) {
        if self.half_edges.len() / 2 < MANY {
            return;
        }
        let intervals = |axis: usize| -> Vec<[f64; 2]> {
            let edges = self.half_edges.iter().step_by(2);
            let interval = |edge: &[VertexId; 2]| {
                let wobble = self.points.wobble(edge);
                let [a, b] = edge.map(|v| self.points.at(v)[axis]);
                [a.min(b) - wobble, a.max(b) + wobble]
            };
            edges.map(interval).collect()
        };
        let [across, along] = [intervals(self.axes[1]), intervals(self.axes[0])];
        self.slabs = Some(if 2.0 * slabs::depth(&along) < slabs::depth(&across) {
            self.ray = [self.axes[1], self.axes[0]];
            Slabs::new(&along)
        } else {
            Slabs::new(&across)
        });
    }

    fn name_cells(&mut self) {
        self.component_of = self.components();
        self.components = self.component_of.iter().max().map_or(0, |k| k + 1);
        self.is_positive = self
            .cycles
            .iter()
            .map(|c| self.cycle_sign(c).is_positive())
            .collect();
        // The unbounded cell comes first.
        let mut cells = 1;
        if self.components != 1 {
            self.cells.insert(Vec::new(), 0);
        }
        for c in 0..self.cycles.len() {
            if self.components == 1 {
                self.cell_of
                    .push(if self.is_positive[c] { cells } else { 0 });
                cells += usize::from(self.is_positive[c]);
                continue;
            }
            let anchor = self.half_edges[self.cycles[c][0]][0];
            let mut name = self.cycles_around(&[anchor]);
            name.retain(|&other| self.component_of[other] != self.component_of[c]);
            name.extend(self.is_positive[c].then_some(c));
            name.sort_unstable_by_key(|&c| self.component_of[c]);
            self.cell_of.push(*self.cells.entry(name).or_insert(cells));
            cells = self.cells.len();
        }
        self.kept = vec![true; cells];
        self.kept[0] = false;
    }

    /// For each cycle its component. Cycles that share an edge (its two sides) or a vertex are in one.
    fn components(&self) -> Vec<usize> {
        let mut vertices: Vec<VertexId> = self.half_edges.iter().map(|e| e[0]).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let place = |v: VertexId| vertices.binary_search(&v).expect("the vertex of an edge");
        let mut leader: Vec<usize> = (0..vertices.len()).collect();
        fn find(leader: &mut [usize], mut v: usize) -> usize {
            while leader[v] != v {
                leader[v] = leader[leader[v]];
                v = leader[v];
            }
            v
        }
        for &[a, b] in self.half_edges.iter().step_by(2) {
            let (a, b) = (find(&mut leader, place(a)), find(&mut leader, place(b)));
            leader[a.max(b)] = a.min(b);
        }
        // In the order of their smallest vertices, which lead them.
        let mut number = vec![0; vertices.len()];
        let mut count = 0;
        for v in 0..vertices.len() {
            if leader[v] == v {
                number[v] = count;
                count += 1;
            }
        }
        let cycles = self.cycles.iter();
        cycles
            .map(|c| number[find(&mut leader, place(self.half_edges[c[0]][0]))])
            .collect()
    }

    /// The sign of the area to the left of a cycle.
    fn cycle_sign(&self, cycle: &[usize]) -> Sign {
        let from = |h: &usize| self.half_edges[*h][0];
        if let [a, b, c] = cycle {
            return self.points.orient2d(self.axes, [from(a), from(b), from(c)]);
        }
        let Some((&first, rest)) = cycle.split_first() else {
            return Sign::Zero;
        };
        let origin = from(&first);
        let corners = rest.iter().map(|&h| self.half_edges[h]);
        self.points
            .quick_area(self.axes, origin, corners)
            .unwrap_or_else(|| {
                let mut sum = Areas::new(self.axes);
                self.add_areas(cycle.iter().copied(), &mut sum);
                sum.sign()
            })
    }

    /// Adds the areas of the triangles between half-edges and one vertex.
    fn add_areas(&self, half_edges: impl Iterator<Item = usize>, sum: &mut Areas) {
        if let Some(&[origin, _]) = self.half_edges.first() {
            for h in half_edges {
                let [a, b] = self.half_edges[h];
                if a != origin && b != origin {
                    sum.add(self.points, [origin, a, b]);
                }
            }
        }
    }

    /// The positive cycles that contain the centroid of q, one of each component at most, in order of components.
    fn cycles_around(&self, q: &[VertexId]) -> Vec<usize> {
        let probe = Probe::new(self.points, self.ray, q);
        let mut turns: Vec<(usize, usize, i32)> = Vec::new();
        let mut visit = |e: usize| {
            let turn = probe.crossing(self.half_edges[2 * e]);
            for (h, turn) in [(2 * e, turn), (2 * e + 1, -turn)] {
                let c = self.cycle_of[h];
                if turn != 0 && self.is_positive[c] {
                    turns.push((self.component_of[c], c, turn));
                }
            }
        };
        match &self.slabs {
            None => (0..self.half_edges.len() / 2).for_each(&mut visit),
            Some(slabs) => {
                let mut found = Vec::new();
                let [low, high] = probe.height();
                slabs.around(low, high, &mut found);
                found.into_iter().for_each(|e| visit(e as usize));
            }
        }
        turns.sort_unstable();
        let mut around: Vec<usize> = turns
            .chunk_by(|x, y| x.1 == y.1)
            .filter(|turns| turns.iter().map(|t| t.2).sum::<i32>() != 0)
            .map(|turns| turns[0].1)
            .collect();
        around.dedup_by_key(|&mut c| self.component_of[c]);
        around
    }

    /// The cell that contains the centroid of q; the unbounded one is 0.
    pub(crate) fn cell_at(&self, q: &[VertexId]) -> usize {
        let name = self.cycles_around(q);
        if self.components == 1 {
            return name.first().map_or(0, |&c| self.cell_of[c]);
        }
        // A name that no cycle has is possible only if edges cross: no cell.
        self.cells.get(&name).copied().unwrap_or(0)
    }

    /// Whether a cell belongs to the area.
    pub(crate) fn is_kept(&self, cell: usize) -> bool {
        self.kept[cell]
    }

    /// All cells of the area.
    pub(crate) fn kept_cells(&self) -> Vec<usize> {
        (0..self.kept.len()).filter(|&c| self.kept[c]).collect()
    }

    /// Takes a cell out of the area.
    pub(crate) fn drop_cell(&mut self, cell: usize) {
        self.kept[cell] = false;
    }

    fn left(&self, h: usize) -> usize {
        self.cell_of[self.cycle_of[h]]
    }

    /// Whether the area lies to the left and to the right of the edge a→b.
    pub(crate) fn sides(&self, edge: [VertexId; 2]) -> Option<[bool; 2]> {
        let h = self.half_edges.iter().position(|&e| e == edge)?;
        Some([h, h ^ 1].map(|h| self.kept[self.left(h)]))
    }

    /// The directed edges that have the area to their left only.
    pub(crate) fn boundary(&self) -> Vec<[VertexId; 2]> {
        self.boundary_half_edges()
            .map(|h| self.half_edges[h])
            .collect()
    }

    fn boundary_half_edges(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.half_edges.len())
            .filter(|&h| self.kept[self.left(h)] && !self.kept[self.left(h ^ 1)])
    }

    /// Twice the area, exactly.
    pub(crate) fn twice_area(&self) -> Dyadic {
        let mut sum = Areas::new(self.axes);
        self.add_areas(self.boundary_half_edges(), &mut sum);
        sum.take_twice()
    }

    /// Adds the area with the other sign.
    pub(crate) fn subtract_from(&self, sum: &mut Areas) {
        self.add_areas(self.boundary_half_edges().map(|h| h ^ 1), sum);
    }

    /// The directed edges with a bounded cell to their left, dangling ones included.
    pub(crate) fn edges_around(&self, cell: usize) -> Vec<[VertexId; 2]> {
        (0..self.half_edges.len())
            .filter(|&h| self.left(h) == cell)
            .map(|h| self.half_edges[h])
            .collect()
    }

    /// A convex corner (before, vertex, after) of a bounded cell: at the lexicographically smallest vertex of the cycle
    /// around it all edges leave into a half-plane, and the corner below 180 degrees is the one inside.
    pub(crate) fn corner(&self, cell: usize) -> Option<[VertexId; 3]> {
        let cycle = (0..self.cycles.len())
            .filter(|&c| self.cell_of[c] == cell)
            .find(|&c| self.is_positive[c])?;
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

/// The edges without repetition.
pub(crate) fn distinct(edges: impl Iterator<Item = [VertexId; 2]>) -> Vec<[VertexId; 2]> {
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
