//! Polygons that are flat only to rounding (paper, end of §3.1 and of §3.2), dealt with before any polygon is inserted.
//!
//! Polygons of four or more vertices in floating point, and polygons with rounded Steiner points on their boundaries, are
//! not exactly flat. Each is cut into exactly flat pieces along edges that the Delaunay tetrahedralization has ([`cut`]).
//! Where edges are missing the polygon gets a Steiner point ([`steiner`]), and is cut again, until all pieces of all
//! polygons are flat. As this happens in the Delaunay tetrahedralization, no mesh of a polygon is ever taken back.
//!
//! Then every insertion is one of an exactly flat polygon into an edge-protected PLC, and what is proved of those holds:
//! there is one CDT, and cavities, gift wrapping and exactly ordered flips all find it.
//!
//! # End
//! Refinement of nearly flat polygons ends in practice for the same reasons as that of segments; it is bounded by
//! [`MOST_ROUNDS`] and [`MOST_POINTS`] per polygon, and then the polygon is named.

mod cut;
mod plane;
mod steiner;

use super::polygons::boundary_subsegments;
use super::segments::{SegmentIndex, Steiner, Subsegments, add_steiner_points};
use crate::delaunay::Delaunay;
use crate::error::{Failure, GaveUp, NotFlatReason};
use crate::mesh::{Incidence, VertexId};
use crate::plc::{Complex, Polygon};
use crate::predicate::PointStore;
use cut::Cut;
use plane::Plane;
use rustc_hash::FxHashSet;
use serde::Serialize;
use std::ops::Range;

/// How often Steiner points are inserted and polygons are cut again.
pub const MOST_ROUNDS: usize = 500;

/// How many Steiner points one polygon may get.
pub const MOST_POINTS: usize = 1 << 12;

/// What it took to make all polygons exactly flat.
#[derive(Clone, Copy, Default, PartialEq, Eq, Debug, Serialize)]
pub struct FlatteningCounts {
    /// Polygons with vertices that are not exactly on one plane.
    pub not_flat: u64,
    /// The exactly flat pieces into which those were cut.
    pub pieces: u64,
    /// Pairs of crossing edges, opposite edges of shims, of which one was chosen.
    pub choices: u64,
    /// Steiner points inserted in the interiors of polygons.
    pub points_on_polygons: u64,
    /// Steiner points inserted on segments instead.
    pub points_on_segments: u64,
    /// How often Steiner points were inserted.
    pub rounds: u64,
}

/// The polygons of a complex in exactly flat pieces.
#[derive(Clone, Debug, Default)]
pub struct Pieces {
    /// The segments of the complex, and all pieces: polygons that were flat as they are, and the pieces of the others, whose
    /// edges are edges of the mesh.
    pub complex: Complex,
    /// The first piece of each polygon, and the number of pieces at the end.
    first: Vec<usize>,
    /// Which polygons are not flat.
    was_cut: Vec<bool>,
    /// Steiner points inside each polygon.
    inner: Vec<Vec<VertexId>>,
}

impl Pieces {
    /// The pieces of polygon f.
    pub fn of(&self, f: usize) -> Range<usize> {
        self.first[f]..self.first[f + 1]
    }

    /// The first piece of each polygon, and the number of pieces.
    pub(crate) fn clone_firsts(&self) -> Vec<usize> {
        self.first.clone()
    }

    /// The polygon that piece `p` belongs to.
    pub fn polygon_of(&self, p: usize) -> usize {
        self.first.partition_point(|&first| first <= p) - 1
    }

    /// Whether polygon f had to be cut.
    pub fn is_cut(&self, f: usize) -> bool {
        self.was_cut[f]
    }

    /// Steiner points inside polygon f.
    pub fn inner_points(&self, f: usize) -> &[VertexId] {
        &self.inner[f]
    }
}

/// What the polygons of a complex are made of at the moment.
struct State {
    /// The pieces of polygons that are not flat.
    cuts: Vec<Option<Cut>>,
    inner: Vec<Vec<VertexId>>,
}

/// Cuts all polygons that are not flat, inserting Steiner points where that is impossible.
///
/// # Errors
/// [`GaveUp::NotFlat`]; those of [`add_steiner_points`].
pub fn flatten<P: PointStore>(
    complex: &Complex,
    index: &SegmentIndex,
    points: &mut P,
    delaunay: &mut Delaunay,
    subsegments: &mut Subsegments,
    incidence: &mut Incidence,
    counts: &mut FlatteningCounts,
) -> Result<Pieces, Failure> {
    let n = complex.polygons.len();
    let mut state = State {
        cuts: vec![None; n],
        inner: vec![Vec::new(); n],
    };
    let mut touched: Option<FxHashSet<VertexId>> = None;
    for round in 0.. {
        let mut requests: Vec<(usize, Steiner)> = Vec::new();
        let mut unsettled = None;
        for (f, polygon) in complex.polygons.iter().enumerate() {
            let boundary = boundary_subsegments(subsegments, index, polygon);
            let vertices = vertices(polygon, &boundary, &state.inner[f]);
            let is_touched = |t: &FxHashSet<VertexId>| vertices.iter().any(|v| t.contains(v));
            let is_settled = |cut: &Option<Cut>| cut.as_ref().is_none_or(|cut| cut.bad.is_empty());
            if !touched.as_ref().is_none_or(is_touched) && is_settled(&state.cuts[f]) {
                continue;
            }
            state.cuts[f] = None;
            if is_flat(points, polygon, &vertices) {
                continue;
            }
            let cut = cut::cut(
                points,
                &delaunay.mesh,
                incidence,
                (subsegments, index),
                polygon,
                (&boundary, &vertices),
            );
            if !cut.bad.is_empty() {
                unsettled = unsettled.or(Some(f));
                if state.inner[f].len() >= MOST_POINTS {
                    return Err(not_flat(polygon, NotFlatReason::TooManyPoints));
                }
                let wanted = wanted(points, polygon, &cut, &boundary);
                requests.extend(wanted.into_iter().map(|request| (f, request)));
            }
            state.cuts[f] = Some(cut);
        }
        let Some(unsettled) = unsettled else { break };
        if std::env::var_os("DBG").is_some() { eprintln!("round {round} n={} requests {:?}", points.len(), requests); }
        let polygon = &complex.polygons[unsettled];
        if round == MOST_ROUNDS {
            return Err(not_flat(polygon, NotFlatReason::TooManyPoints));
        }
        let positions: Vec<Steiner> = requests.iter().map(|r| r.1).collect();
        let added = add_steiner_points(&positions, points, delaunay, subsegments, incidence)?;
        let mut progress = false;
        for ((f, request), vertex) in requests.into_iter().zip(added.vertices) {
            let Some(v) = vertex else { continue };
            progress = true;
            match request {
                Steiner::Point(_) => {
                    state.inner[f].push(v);
                    counts.points_on_polygons += 1;
                }
                Steiner::Split(_) => counts.points_on_segments += 1,
            }
        }
        if !progress {
            return Err(not_flat(polygon, NotFlatReason::Incompatible));
        }
        counts.rounds += 1;
        touched = Some(added.touched);
    }
    Ok(collect(complex, state, counts))
}

fn collect(complex: &Complex, state: State, counts: &mut FlatteningCounts) -> Pieces {
    let mut polygons = Vec::with_capacity(complex.polygons.len());
    let mut first = Vec::with_capacity(complex.polygons.len() + 1);
    let was_cut = state.cuts.iter().map(Option::is_some).collect();
    for (polygon, cut) in complex.polygons.iter().zip(state.cuts) {
        first.push(polygons.len());
        match cut {
            None => polygons.push(polygon.clone()),
            Some(cut) => {
                counts.not_flat += 1;
                counts.pieces += cut.pieces.len() as u64;
                counts.choices += cut.choices as u64;
                polygons.extend(cut.pieces);
            }
        }
    }
    first.push(polygons.len());
    Pieces {
        complex: Complex {
            representative: Vec::new(),
            segments: complex.segments.clone(),
            polygons,
        },
        first,
        was_cut,
        inner: state.inner,
    }
}

/// All vertices of a polygon, sorted.
fn vertices(polygon: &Polygon, boundary: &[[VertexId; 2]], inner: &[VertexId]) -> Vec<VertexId> {
    let ends = boundary.iter().flatten();
    let mut vertices: Vec<VertexId> = polygon
        .vertices
        .iter()
        .chain(ends)
        .chain(inner)
        .copied()
        .collect();
    vertices.sort_unstable();
    vertices.dedup();
    vertices
}

fn is_flat<P: PointStore>(points: &P, polygon: &Polygon, vertices: &[VertexId]) -> bool {
    let [a, b, c] = polygon.frame;
    let mut others = vertices.iter().filter(|v| !polygon.frame.contains(v));
    others.all(|&v| points.orient3d([a, b, c, v]).is_zero())
}

/// The Steiner points that the cells of a polygon want, without those that come close to others.
fn wanted<P: PointStore>(
    points: &P,
    polygon: &Polygon,
    cut: &Cut,
    boundary: &[[VertexId; 2]],
) -> Vec<Steiner> {
    let plane = Plane::new(points, polygon.frame);
    let mut taken: Vec<(Steiner, f64)> = Vec::new();
    for cell in &cut.bad {
        let Some((request, radius)) = steiner::for_cell(points, &plane, cell, boundary) else {
            continue;
        };
        let is_close = taken.iter().any(|&(other, r)| match (request, other) {
            (Steiner::Point(p), Steiner::Point(q)) => {
                let squares = (0..3).map(|k| (p[k] - q[k]) * (p[k] - q[k]));
                squares.sum::<f64>().sqrt() < r.min(radius)
            }
            _ => request == other,
        });
        if !is_close {
            taken.push((request, radius));
        }
    }
    taken.into_iter().map(|(request, _)| request).collect()
}

fn not_flat(polygon: &Polygon, reason: NotFlatReason) -> Failure {
    let facets = polygon.facets.clone();
    GaveUp::NotFlat { facets, reason }.into()
}
