//! A maze on a wheel: corridors between walls on a plate, with a bore in its middle.
//!
//! The plan is a grid in polar coordinates, whose blocks are corridor or wall. The corridors of a perfect maze are a
//! tree, and so are its walls: the floor and the top of the walls are polygons with very many corners, of which the
//! latter goes round the former. A few doors more make islands of walls, so that the floor has holes.
//!
//! Walls are upright and floors level, so that everything is exactly planar. At each point of the grid a block of
//! corridor faces a post of the wall, so that no region touches itself there, and every outline is a simple polygon.

use super::draft::{Draft, Sets, sides};
use super::draw::{Draw, turn};
use crate::exchange::Plc;
use std::collections::BTreeMap;

/// The heights of the base, the floor and the top.
const HEIGHTS: [f64; 3] = [-0.5, 0.0, 1.0];

/// Rings and sectors of cells, so that cells are about as long as wide.
pub(super) fn maze(draw: &mut Draw, size: usize) -> Plc {
    let rings = ((size as f64 / 24.0).sqrt().round() as usize).max(1);
    let sectors = ((size as f64 / (4 * rings + 4) as f64).round() as usize).max(3);
    let plan = Plan::new(draw, rings, sectors);
    let mut draft = Draft::default();
    let (number, regions) = plan.regions();
    for blocks in &regions {
        plan.draw_region(&mut draft, &number, blocks);
    }
    for u in [0, plan.rows()] {
        let rim: Vec<[f64; 2]> = (0..plan.columns()).map(|v| plan.point(u, v)).collect();
        draft.walls(2, &rim, [HEIGHTS[0], HEIGHTS[2]]);
    }
    let circles = [plan.rows(), 0].map(|u| (0..plan.columns()).map(|v| plan.point(u, v)).collect());
    draft.plane(2, HEIGHTS[0], &circles, &[[0.0; 2]]);
    draft.finish()
}

/// Rows of blocks from the inside to the outside, columns around. Odd row and odd column: a cell; both even: a post;
/// otherwise a door or a wall.
struct Plan {
    rings: usize,
    sectors: usize,
    /// By row, then column.
    open: Vec<bool>,
}

impl Plan {
    /// Cells, doors that make them a tree, and a few more.
    fn new(draw: &mut Draw, rings: usize, sectors: usize) -> Plan {
        let (rows, columns) = (2 * rings + 1, 2 * sectors);
        let mut open = vec![false; rows * columns];
        let cell = |r: usize, s: usize| (2 * r + 1) * columns + 2 * s + 1;
        let mut doors = Vec::new();
        for (r, s) in (0..rings).flat_map(|r| (0..sectors).map(move |s| (r, s))) {
            open[cell(r, s)] = true;
            let next = (s + 1) % sectors;
            doors.push((cell(r, s), cell(r, next), (2 * r + 1) * columns + 2 * next));
            if r + 1 < rings {
                doors.push((
                    cell(r, s),
                    cell(r + 1, s),
                    (2 * r + 2) * columns + 2 * s + 1,
                ));
            }
        }
        draw.shuffle(&mut doors);
        let mut joined = Sets::new(open.len());
        for (a, b, door) in doors {
            open[door] = joined.join(a, b) || draw.chance(0.02);
        }
        Plan {
            rings,
            sectors,
            open,
        }
    }

    fn rows(&self) -> usize {
        2 * self.rings + 1
    }

    fn columns(&self) -> usize {
        2 * self.sectors
    }

    /// A point of the grid, by the row and column of which it is the first corner.
    fn point(&self, u: usize, v: usize) -> [f64; 2] {
        // A wall is 1/4 wide, a cell 1.
        let radius = 0.625 * self.rings as f64 + 1.25 * (u / 2) as f64 + 0.25 * (u % 2) as f64;
        let v = v % self.columns();
        let [c, s] = turn((5 * (v / 2) + v % 2) as u64, 5 * self.sectors as u64);
        [radius * c, radius * s]
    }

    /// The blocks beside one, each with the two points of the side between them, so that the block is on its left.
    fn beside(&self, block: usize) -> [(Option<usize>, [[usize; 2]; 2]); 4] {
        let columns = self.columns();
        let (u, v) = (block / columns, block % columns);
        let (next, last) = ((v + 1) % columns, (v + columns - 1) % columns);
        let at = |u: usize, v: usize| u * columns + v;
        // Around the block counterclockwise: outwards on its first side, around outside, inwards, and back.
        [
            (Some(at(u, last)), [[u, v], [u + 1, v]]),
            (
                (u + 1 < self.rows()).then(|| at(u + 1, v)),
                [[u + 1, v], [u + 1, next]],
            ),
            (Some(at(u, next)), [[u + 1, next], [u, next]]),
            (u.checked_sub(1).map(|u| at(u, v)), [[u, next], [u, v]]),
        ]
    }

    /// The region of every block, and the blocks of every region: connected ones of one height.
    fn regions(&self) -> (Vec<u32>, Vec<Vec<usize>>) {
        let mut number = vec![u32::MAX; self.open.len()];
        let mut lists: Vec<Vec<usize>> = Vec::new();
        for start in 0..self.open.len() {
            if number[start] != u32::MAX {
                continue;
            }
            number[start] = lists.len() as u32;
            let mut blocks = vec![start];
            let mut done = 0;
            while done < blocks.len() {
                for (other, _) in self.beside(blocks[done]) {
                    let same =
                        |&o: &usize| self.open[o] == self.open[start] && number[o] == u32::MAX;
                    if let Some(other) = other.filter(same) {
                        number[other] = lists.len() as u32;
                        blocks.push(other);
                    }
                }
                done += 1;
            }
            lists.push(blocks);
        }
        (number, lists)
    }

    /// The floor or the top of a region, and, of a corridor, the walls around it.
    fn draw_region(&self, draft: &mut Draft, number: &[u32], blocks: &[usize]) {
        let open = self.open[blocks[0]];
        let columns = self.columns();
        let id = |[u, v]: [usize; 2]| u * columns + v;
        let [_, floor, top] = HEIGHTS;
        // The sides of the boundary by their first point, each with the block beyond it.
        let mut next = BTreeMap::new();
        for &block in blocks {
            for (other, [from, to]) in self.beside(block) {
                if other.is_none_or(|o| number[o] != number[block]) {
                    next.insert(id(from), (to, other));
                    if open {
                        let ends = [from, to].map(|[u, v]| self.point(u, v));
                        draft.wall(2, ends, [floor, top]);
                    }
                }
            }
        }
        let mut outlines = Vec::new();
        let mut holes = Vec::new();
        while let Some((&start, _)) = next.first_key_value() {
            let (mut at, mut outline, mut beyond) = (start, Vec::new(), None);
            while let Some((to, other)) = next.remove(&at) {
                outline.push(self.point(at / columns, at % columns));
                beyond = other;
                at = id(to);
            }
            // With the region on the left of its sides, the outline of a hole is clockwise.
            if twice_area(&outline) < 0.0 {
                holes.push(beyond.map_or([0.0; 2], |block| self.middle(block)));
            }
            outlines.push(outline);
        }
        draft.plane(2, if open { floor } else { top }, &outlines, &holes);
    }

    /// The mean of a block's corners, which is inside it: blocks are trapezoids.
    fn middle(&self, block: usize) -> [f64; 2] {
        let (u, v) = (block / self.columns(), block % self.columns());
        let corners = [[u, v], [u + 1, v], [u + 1, v + 1], [u, v + 1]];
        let corners = corners.map(|[u, v]| self.point(u, v));
        [0, 1].map(|i| corners.iter().map(|p| p[i]).sum::<f64>() / 4.0)
    }
}

/// Twice the signed area, rounded: of outlines that are not small.
fn twice_area(outline: &[[f64; 2]]) -> f64 {
    sides(outline).map(|[p, q]| p[0] * q[1] - p[1] * q[0]).sum()
}
