//! The cells into which its boundary and diagonals divide a polygon, and whether they are flat.

use super::figure::Figure;
use super::plane::Plane;
use crate::mesh::{Groups, VertexId};
use crate::number::vector::{cross, minus, square};
use crate::plc::Polygon;
use crate::predicate::PointStore;

/// A part of f that edges enclose.
#[derive(Clone, Debug)]
pub(super) struct Cell {
    /// The directed edges with the cell on the left, the outer cycle first.
    pub(super) edges: Vec<[VertexId; 2]>,
    /// How many of them are the outer cycle.
    pub(super) outer: usize,
    /// Vertices that float in it.
    pub(super) isolated: Vec<VertexId>,
}

impl Cell {
    /// All vertices, sorted.
    pub(super) fn vertices(&self) -> Vec<VertexId> {
        let mut vertices = Vec::with_capacity(2 * self.edges.len() + self.isolated.len());
        vertices.extend(self.edges.iter().flatten().chain(&self.isolated));
        vertices.sort_unstable();
        vertices.dedup();
        vertices
    }

    /// The cell as a polygon, a part of f that is flat only to rounding; `None` if all its vertices are collinear in
    /// projection.
    pub(super) fn whole<P: PointStore>(
        &self,
        points: &P,
        plane: &Plane<P>,
        f: &Polygon,
    ) -> Option<Polygon> {
        let vertices = self.vertices();
        let frame = frame(points, plane, &vertices)?;
        let mut edges = self.edges.clone();
        edges.sort_unstable();
        Some(Polygon {
            edges,
            vertices,
            frame,
            flat: false,
            facets: f.facets.clone(),
            marker: f.marker,
        })
    }

    /// The cell as a polygon, a part of f, if it is exactly flat.
    pub(super) fn piece<P: PointStore>(
        mut self,
        points: &P,
        plane: &Plane<P>,
        f: &Polygon,
    ) -> Result<Polygon, Cell> {
        let vertices = self.vertices();
        let Some(frame) = frame(points, plane, &vertices) else {
            return Err(self);
        };
        let [a, b, c] = frame;
        let on_plane =
            |&v: &VertexId| frame.contains(&v) || points.orient3d([a, b, c, v]).is_zero();
        if !vertices.iter().all(on_plane) {
            return Err(self);
        }
        self.edges.sort_unstable();
        Ok(Polygon {
            edges: self.edges,
            vertices,
            frame,
            flat: true,
            facets: f.facets.clone(),
            marker: f.marker,
        })
    }
}

/// The cells of a figure with some diagonals.
pub(super) fn cells<P: PointStore>(figure: &Figure<P>, diagonals: &[[VertexId; 2]]) -> Vec<Cell> {
    let plane = &figure.plane;
    let mut edges = Vec::with_capacity(figure.boundary.len() + 2 * diagonals.len());
    edges.extend_from_slice(figure.boundary);
    edges.extend(diagonals.iter().flat_map(|&[a, b]| [[a, b], [b, a]]));
    // The edges from each vertex, by number: their heads, and which they are.
    let numbers: Vec<[usize; 2]> = edges.iter().map(|e| e.map(|v| figure.number(v))).collect();
    let starts = numbers.iter().map(|&[tail, _]| VertexId::new(tail));
    let heads = edges.iter().map(|e| e[1]);
    let out = Groups::new(figure.vertices.len(), starts.zip(heads.zip(0usize..)));
    let next = |i: usize| {
        // The first edge clockwise from the way back.
        let ([a, v], [_, head]) = (edges[i], numbers[i]);
        let targets = out.of(VertexId::new(head)).iter().copied();
        plane.last_around(v, a, targets).map(|(_, i)| i)
    };
    let mut seen = vec![false; edges.len()];
    let (mut cells, mut islands) = (Vec::new(), Vec::new());
    for start in 0..edges.len() {
        let mut cycle = Vec::new();
        let mut at = Some(start);
        while let Some(i) = at.filter(|&i| !std::mem::replace(&mut seen[i], true)) {
            cycle.push(edges[i]);
            at = next(i);
        }
        if cycle.is_empty() {
            continue;
        }
        if plane.area(&cycle).is_positive() {
            let outer = cycle.len();
            cells.push(Cell {
                edges: cycle,
                outer,
                isolated: Vec::new(),
            });
        } else {
            islands.push(cycle);
        }
    }
    let holder = |cells: &[Cell], v: VertexId| {
        let mut found = (0..cells.len()).filter(|&i| {
            let outer = &cells[i].edges[..cells[i].outer];
            outer.iter().all(|e| !e.contains(&v)) && plane.is_inside(outer, v)
        });
        found.next()
    };
    for island in islands {
        if let Some(i) = holder(&cells, island[0][0]) {
            cells[i].edges.extend(island);
        }
    }
    let mut has_edges = vec![false; figure.vertices.len()];
    for i in numbers.into_iter().flatten() {
        has_edges[i] = true;
    }
    for (&v, has_edges) in figure.vertices.iter().zip(has_edges) {
        if !has_edges && let Some(i) = holder(&cells, v) {
            cells[i].isolated.push(v);
        }
    }
    cells
}

/// Three vertices that turn counterclockwise; far apart, if possible.
fn frame<P: PointStore>(
    points: &P,
    plane: &Plane<P>,
    vertices: &[VertexId],
) -> Option<[VertexId; 3]> {
    let at = |v: VertexId| points.rounded(v);
    let first = *vertices.first()?;
    let a = farthest(vertices, |v| square(minus(at(v), at(first))))?;
    let b = farthest(vertices, |v| square(minus(at(v), at(a))))?;
    let line = minus(at(b), at(a));
    let c = farthest(vertices, |v| square(cross(line, minus(at(v), at(a)))))?;
    let oriented = |[a, b, c]: [VertexId; 3]| {
        let sign = plane.turn(a, b, c);
        (!sign.is_zero()).then(|| {
            if sign.is_positive() {
                [a, b, c]
            } else {
                [a, c, b]
            }
        })
    };
    oriented([a, b, c]).or_else(|| {
        let &b = vertices.get(1)?;
        vertices.iter().find_map(|&c| oriented([first, b, c]))
    })
}

/// The first of the vertices for which the key is largest.
fn farthest(vertices: &[VertexId], key: impl Fn(VertexId) -> f64) -> Option<VertexId> {
    let mut best: Option<(f64, VertexId)> = None;
    for &v in vertices {
        let found = key(v);
        if best.is_none_or(|(most, _)| found.total_cmp(&most).is_gt()) {
            best = Some((found, v));
        }
    }
    best.map(|(_, v)| v)
}
