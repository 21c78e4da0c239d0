//! A PLC being drawn: facets are given by coordinates, and equal coordinates are one vertex.
//!
//! Prisms and plane facets are drawn along a coordinate axis: their points are [`lift`]ed from a plane. All points of a
//! plane facet then share a coordinate, and a wall has two edges parallel to the axis, so that both are exactly planar
//! whatever the other coordinates are.

use crate::exchange::{Facet, Plc, Region, Segment};
use crate::mesh::VertexId;
use rustc_hash::FxHashMap;

/// A closed curve in a plane: the corners of a polygon, in order.
pub(super) type Loop = Vec<[f64; 2]>;

/// Puts the point (u, v) of a plane at the height w on an axis; (u, v, axis) is right-handed.
pub(super) fn lift(axis: usize, [u, v]: [f64; 2], w: f64) -> [f64; 3] {
    let mut p = [0.0; 3];
    p[(axis + 1) % 3] = u;
    p[(axis + 2) % 3] = v;
    p[axis] = w;
    p
}

/// The corners of a rectangle, counterclockwise.
pub(super) fn rectangle(low: [f64; 2], high: [f64; 2]) -> Loop {
    vec![low, [high[0], low[1]], high, [low[0], high[1]]]
}

/// A curve times a radius, plus a centre.
pub(super) fn placed(curve: &[[f64; 2]], centre: [f64; 2], radius: f64) -> Loop {
    let place = |[u, v]: &[f64; 2]| [centre[0] + radius * u, centre[1] + radius * v];
    curve.iter().map(place).collect()
}

/// The pairs of consecutive points of a closed curve.
pub(super) fn sides<T: Copy>(curve: &[T]) -> impl Iterator<Item = [T; 2]> + '_ {
    (0..curve.len()).map(|i| [curve[i], curve[(i + 1) % curve.len()]])
}

/// The PLC so far.
#[derive(Default)]
pub(super) struct Draft {
    plc: Plc,
    ids: FxHashMap<[u64; 3], VertexId>,
}

impl Draft {
    /// The vertex with these coordinates, where −0 = 0.
    pub fn vertex(&mut self, point: [f64; 3]) -> VertexId {
        let point = point.map(|x| x + 0.0);
        let vertices = &mut self.plc.vertices;
        *self.ids.entry(point.map(f64::to_bits)).or_insert_with(|| {
            vertices.push(point);
            VertexId::new(vertices.len() - 1)
        })
    }

    /// A facet with polygons, and points where it is left open.
    pub fn facet(&mut self, polygons: &[Vec<[f64; 3]>], holes: &[[f64; 3]]) {
        let polygons = polygons.iter().map(|polygon| {
            let corners = polygon.iter().map(|&p| self.vertex(p));
            corners.collect()
        });
        let facet = Facet {
            polygons: polygons.collect(),
            holes: holes.to_vec(),
            marker: 0,
        };
        self.plc.facets.push(facet);
    }

    /// A facet with one polygon.
    pub fn polygon(&mut self, corners: &[[f64; 3]]) {
        self.facet(&[corners.to_vec()], &[]);
    }

    /// Two triangles, on both sides of the diagonal from `a` to `c`.
    pub fn halves(&mut self, [a, b, c, d]: [[f64; 3]; 4]) {
        self.polygon(&[a, b, c]);
        self.polygon(&[a, c, d]);
    }

    /// A facet across an axis.
    pub fn plane(&mut self, axis: usize, w: f64, curves: &[Loop], holes: &[[f64; 2]]) {
        let up = |curve: &Loop| curve.iter().map(|&p| lift(axis, p, w)).collect();
        let polygons: Vec<Vec<[f64; 3]>> = curves.iter().map(up).collect();
        let holes: Vec<[f64; 3]> = holes.iter().map(|&p| lift(axis, p, w)).collect();
        self.facet(&polygons, &holes);
    }

    /// The walls of a prism along an axis.
    pub fn walls(&mut self, axis: usize, curve: &[[f64; 2]], heights: [f64; 2]) {
        for side in sides(curve) {
            self.wall(axis, side, heights);
        }
    }

    /// One wall, between two heights over a line.
    pub fn wall(&mut self, axis: usize, [p, q]: [[f64; 2]; 2], [from, to]: [f64; 2]) {
        let corners = [(p, from), (q, from), (q, to), (p, to)];
        self.polygon(&corners.map(|(p, w)| lift(axis, p, w)));
    }

    /// The six faces of a box.
    pub fn block(&mut self, low: [f64; 3], high: [f64; 3]) {
        for axis in 0..3 {
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            let curve = rectangle([low[u], low[v]], [high[u], high[v]]);
            for w in [low[axis], high[axis]] {
                self.plane(axis, w, std::slice::from_ref(&curve), &[]);
            }
        }
    }

    /// A floating segment.
    pub fn segment(&mut self, ends: [[f64; 3]; 2]) {
        let ends = ends.map(|p| self.vertex(p));
        self.plc.segments.push(Segment { ends, marker: 0 });
    }

    /// A point in a part that is no part of the domain.
    pub fn hole(&mut self, point: [f64; 3]) {
        self.plc.holes.push(point);
    }

    /// A point in a region, and its attribute.
    pub fn region(&mut self, point: [f64; 3], attribute: usize) {
        self.plc.regions.push(Region {
            point,
            attribute: attribute as f64,
            max_volume: None,
        });
    }

    /// The number of facets so far.
    pub fn facets(&self) -> usize {
        self.plc.facets.len()
    }

    /// Moves all points.
    pub fn map(&mut self, place: impl Fn([f64; 3]) -> [f64; 3]) {
        let plc = &mut self.plc;
        let facet_holes = plc.facets.iter_mut().flat_map(|f| &mut f.holes);
        let points = plc.vertices.iter_mut().chain(&mut plc.holes);
        let points = points.chain(facet_holes);
        for p in points.chain(plc.regions.iter_mut().map(|r| &mut r.point)) {
            *p = place(*p);
        }
    }

    /// The PLC.
    pub fn finish(self) -> Plc {
        self.plc
    }
}

/// The point with coordinates along three axes.
pub(super) fn along(axes: &[[f64; 3]; 3], p: [f64; 3]) -> [f64; 3] {
    axes.map(|axis| axis[0] * p[0] + axis[1] * p[1] + axis[2] * p[2])
}

/// Sets with union and find, for the parts of a model that are joined.
pub(super) struct Sets(Vec<u32>);

impl Sets {
    /// `n` sets of one element each.
    pub fn new(n: usize) -> Sets {
        Sets((0..u32::try_from(n).expect("fewer than 2^32 elements")).collect())
    }

    /// The element that stands for the set of `i`.
    pub fn find(&mut self, mut i: usize) -> usize {
        while self.0[i] as usize != i {
            self.0[i] = self.0[self.0[i] as usize];
            i = self.0[i] as usize;
        }
        i
    }

    /// Joins two sets; whether they were two. The smaller element stands for both.
    pub fn join(&mut self, i: usize, j: usize) -> bool {
        let (i, j) = (self.find(i), self.find(j));
        self.0[i.max(j)] = i.min(j) as u32;
        i != j
    }
}
