//! Which tetrahedra contain a point: a tree of bounding boxes in front of exact signs. O(n log n) to build, and a
//! handful of exact tests for each query in a mesh of reasonable shape.

use super::points::Points;
use super::tables::{INWARD, Tables};
use crate::mesh::VertexId;

const LEAF: usize = 8;

/// A box by its least and greatest coordinates.
type Bounds = [[f64; 3]; 2];

struct Node {
    bounds: Bounds,
    /// The range of `order` below this node.
    range: [usize; 2],
    /// The second child; the first one is the next node. 0 for a leaf.
    second: usize,
}

/// The tree.
pub(super) struct Locator<'a> {
    points: &'a Points,
    tables: &'a Tables,
    nodes: Vec<Node>,
    order: Vec<u32>,
    /// Those of the tetrahedra.
    bounds: Vec<Bounds>,
}

impl<'a> Locator<'a> {
    pub(super) fn new(points: &'a Points, tables: &'a Tables) -> Locator<'a> {
        let bounds: Vec<Bounds> = tables
            .tets
            .iter()
            .map(|t| {
                let p = t.map(|v| points.at(v));
                [
                    p.iter().fold([f64::INFINITY; 3], least),
                    p.iter().fold([f64::NEG_INFINITY; 3], greatest),
                ]
            })
            .collect();
        let mut locator = Locator {
            points,
            tables,
            nodes: Vec::new(),
            order: (0..tables.tets.len() as u32).collect(),
            bounds: Vec::new(),
        };
        locator.split(&bounds, 0, tables.tets.len());
        locator.bounds = bounds;
        locator
    }

    fn split(&mut self, bounds: &[Bounds], from: usize, to: usize) {
        let members = &mut self.order[from..to];
        let low = members
            .iter()
            .fold([f64::INFINITY; 3], |m, &t| least(m, &bounds[t as usize][0]));
        let high = members.iter().fold([f64::NEG_INFINITY; 3], |m, &t| {
            greatest(m, &bounds[t as usize][1])
        });
        let node = self.nodes.len();
        self.nodes.push(Node {
            bounds: [low, high],
            range: [from, to],
            second: 0,
        });
        if members.len() <= LEAF {
            return;
        }
        let axis = (0..3)
            .max_by(|&i, &j| (high[i] - low[i]).total_cmp(&(high[j] - low[j])))
            .expect("three axes");
        let middle = members.len() / 2;
        let centre =
            |t: &u32| bounds[*t as usize][0][axis] / 2.0 + bounds[*t as usize][1][axis] / 2.0;
        members.select_nth_unstable_by(middle, |s, t| {
            centre(s).total_cmp(&centre(t)).then(s.cmp(t))
        });
        self.split(bounds, from, from + middle);
        self.nodes[node].second = self.nodes.len();
        self.split(bounds, from + middle, to);
    }

    /// The tetrahedra whose closure contains the centroid of the points q, in increasing order.
    pub(super) fn containing(&self, q: &[VertexId]) -> Vec<usize> {
        let share = q.len() as f64;
        let centre =
            [0, 1, 2].map(|i| q.iter().map(|&v| self.points.at(v)[i] / share).sum::<f64>());
        // At most six roundings of relative size 2⁻⁵³ on the way to the centre of up to five points.
        let largest = q
            .iter()
            .flat_map(|&v| self.points.at(v))
            .fold(0.0f64, |m, x| m.max(x.abs()));
        let slack = 16.0 * f64::EPSILON * largest + f64::MIN_POSITIVE;
        let misses = |[low, high]: Bounds| {
            (0..3).any(|i| centre[i] < low[i] - slack || centre[i] > high[i] + slack)
        };
        let mut found = Vec::new();
        let mut stack = vec![0];
        while let Some(n) = stack.pop() {
            let node = &self.nodes[n];
            if misses(node.bounds) {
                continue;
            }
            if node.second > 0 {
                stack.extend([n + 1, node.second]);
                continue;
            }
            let members = &self.order[node.range[0]..node.range[1]];
            found.extend(
                members
                    .iter()
                    .map(|&t| t as usize)
                    .filter(|&t| !misses(self.bounds[t]) && self.contains(t, q)),
            );
        }
        found.sort_unstable();
        found
    }

    /// Whether the closed tetrahedron contains the centroid of q.
    pub(super) fn contains(&self, t: usize, q: &[VertexId]) -> bool {
        let tet = self.tables.tets[t];
        INWARD
            .iter()
            .all(|face| !self.points.side(face.map(|k| tet[k]), q).is_negative())
    }

    /// Whether a short step from the vertex v in the direction (u−v) + (w−v) stays in a tetrahedron (or its boundary).
    /// A face of the tetrahedron through v has v on its plane, so that orient(face, v + d) is the sum of orient(face, u)
    /// and orient(face, w).
    pub(super) fn enters(&self, v: VertexId, toward: &[VertexId]) -> bool {
        self.tables.star(v).iter().any(|&t| {
            let tet = self.tables.tets[t as usize];
            (0..4).filter(|&i| tet[i] != v).all(|i| {
                !self
                    .points
                    .side(INWARD[i].map(|k| tet[k]), toward)
                    .is_negative()
            })
        })
    }
}

fn least(m: [f64; 3], x: &[f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|i| m[i].min(x[i]))
}

fn greatest(m: [f64; 3], x: &[f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|i| m[i].max(x[i]))
}
