//! The attributes and markers of all vertices: those of the input keep theirs, Steiner points get what their segment or
//! polygon says.
//!
//! Attributes are interpolated linearly between the ends of a segment. On a polygon they are the mean value
//! coordinates of the point (Hormann & Floater, *Mean value coordinates for arbitrary planar polygons*, ACM Trans.
//! Graph. 25 (2006)): on a triangle they are linear, and for any polygon they give back what is linear. A Steiner
//! point has the marker of its segment or of its polygon's facets. Nothing is decided by these numbers, so they are
//! rounded.

use crate::exchange::{Attributes, Plc};
use crate::mesh::VertexId;
use crate::plc::{Complex, Polygon};
use crate::predicate::{DoublePoints, PointStore};
use crate::recover::flatten::Pieces;
use crate::recover::segments::Subsegments;

/// What Steiner points lie on.
pub(super) struct Interpolation<'a> {
    pub plc: &'a Plc,
    pub points: &'a DoublePoints,
    pub complex: &'a Complex,
    pub subsegments: &'a Subsegments,
    pub pieces: &'a Pieces,
}

impl Interpolation<'_> {
    /// The attributes of all vertices, if those of the input have any.
    pub fn attributes(&self) -> Attributes {
        let given = &self.plc.attributes;
        if given.per_vertex == 0 {
            return Attributes::default();
        }
        let mut all = given.clone();
        all.values.resize(self.points.len() * given.per_vertex, 0.0);
        let place = |v: VertexId, i: usize| v.index() * given.per_vertex + i;
        for v in self.steiner() {
            if let Some(([a, b], t)) = self.subsegments.place_of_steiner(v) {
                let ends = given.of(a).iter().zip(given.of(b));
                for (i, (&x, &y)) in ends.enumerate() {
                    // Exact where both are equal.
                    all.values[place(v, i)] = x + t.value * (y - x);
                }
            }
        }
        for (polygon, v) in self.on_polygons() {
            let weights = self.mean_value_coordinates(polygon, v);
            for i in 0..given.per_vertex {
                let sum = weights
                    .iter()
                    .map(|&(w, weight)| weight * given.of(w)[i])
                    .sum();
                all.values[place(v, i)] = sum;
            }
        }
        all
    }

    /// The markers of all vertices, if those of the input have any.
    pub fn markers(&self) -> Vec<i64> {
        let mut all = self.plc.vertex_markers.clone();
        if all.is_empty() {
            return all;
        }
        all.resize(self.points.len(), 0);
        for v in self.steiner() {
            if let Some(s) = self.subsegments.segment_of_steiner(v) {
                all[v.index()] = self.complex.segments[s as usize].marker;
            }
        }
        for (polygon, v) in self.on_polygons() {
            all[v.index()] = polygon.marker;
        }
        all
    }

    fn steiner(&self) -> impl Iterator<Item = VertexId> {
        (self.plc.vertices.len()..self.points.len()).map(VertexId::new)
    }

    /// The Steiner points inside polygons.
    fn on_polygons(&self) -> impl Iterator<Item = (&Polygon, VertexId)> {
        let polygons = self.complex.polygons.iter().enumerate();
        polygons.flat_map(|(f, polygon)| {
            self.pieces
                .inner_points(f)
                .iter()
                .map(move |&v| (polygon, v))
        })
    }

    /// Weights of the vertices of a polygon whose mean is the point v in it.
    fn mean_value_coordinates(&self, polygon: &Polygon, v: VertexId) -> Vec<(VertexId, f64)> {
        let at = |v: VertexId| self.points.rounded(v);
        let p = at(v);
        let from_p = |v: VertexId| minus(at(v), p);
        let [a, b, c] = polygon.frame.map(at);
        let normal = cross(minus(b, a), minus(c, a));
        let mut weights: Vec<(VertexId, f64)> = Vec::with_capacity(2 * polygon.edges.len());
        for &[a, b] in &polygon.edges {
            let (x, y) = (from_p(a), from_p(b));
            let (xx, yy) = (length(x), length(y));
            let turn = cross(x, y);
            let angle = length(turn).atan2(dot(x, y)) * dot(turn, normal).signum();
            let half = (angle / 2.0).tan();
            weights.push((a, half / xx));
            weights.push((b, half / yy));
        }
        let sum: f64 = weights.iter().map(|w| w.1).sum();
        for (_, weight) in &mut weights {
            *weight /= sum;
        }
        if weights.iter().all(|w| w.1.is_finite()) {
            return weights;
        }
        // Coordinates beyond what doubles can be multiplied to: the nearest vertex.
        let nearest = polygon.vertices.iter().copied().min_by(|&a, &b| {
            let [a, b] = [a, b].map(|v| length(from_p(v)));
            a.total_cmp(&b)
        });
        nearest.map(|v| (v, 1.0)).into_iter().collect()
    }
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn length(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}
