//! Polygons that are flat only to rounding (paper, end of §3.1 and of §3.2), dealt with before any polygon is inserted.
//!
//! Polygons of four or more vertices in floating point, and polygons with rounded Steiner points on their boundaries, are
//! not exactly flat. Each is cut into exactly flat pieces along edges that the Delaunay tetrahedralization has (`cut.rs`).
//! Where edges are missing the polygon gets a Steiner point (`steiner.rs`), and is cut again, until all pieces of all
//! polygons are flat. As this happens in the Delaunay tetrahedralization, no mesh of a polygon is ever taken back.
//!
//! Then every insertion is one of an exactly flat polygon into an edge-protected PLC, and what is proved of those holds:
//! there is one CDT, and cavities, gift wrapping and exactly ordered flips all find it. It may have shims, which are
//! repaired on output (`shims.rs`).
//!
//! # End
//! Refinement of nearly flat polygons ends in practice for the same reasons as that of segments; it is bounded by
//! [`MOST_ROUNDS`] and [`MOST_POINTS`]. Beyond those nothing is inserted, and polygons that cannot be cut are left to the
//! insertion of polygons as they are, which treats their vertices as if they were on one plane, and may refuse them.

mod cut;
mod plane;
pub mod shims;
mod steiner;

use super::polygons::boundary_subsegments;
use super::segments::{Request, SegmentIndex, Subsegments, add_steiner_points};
use crate::delaunay::Delaunay;
use crate::mesh::{Incidence, TetMesh, VertexId};
use crate::plc::{Complex, Polygon};
use crate::predicate::PointStore;
use cut::Cut;
use plane::Plane;
use rustc_hash::FxHashSet;
use serde::Serialize;
use shims::ShimCounts;
use std::ops::Range;

/// How often Steiner points are inserted and polygons are cut again.
pub const MOST_ROUNDS: usize = 200;

/// How many Steiner points may be inserted, besides a quarter of the number of vertices.
pub const MOST_POINTS: usize = 1000;

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
    pub rounds: usize,
    /// Polygons left as they are, because too many Steiner points would have been necessary.
    pub left_whole: u64,
    /// Shims of the domain: repaired ([`shims`]), and left in the output.
    pub shims: ShimCounts,
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
struct State<'a> {
    complex: &'a Complex,
    index: &'a SegmentIndex,
    /// The pieces of polygons that are not flat.
    cuts: Vec<Option<Cut>>,
    inner: Vec<Vec<VertexId>>,
    /// All vertices of each polygon when it was last looked at. A Steiner point on its boundary touches those beside it, so
    /// that a polygon with none that is touched is as it was.
    vertices: Vec<Vec<VertexId>>,
}

/// Cuts all polygons that are not flat, inserting Steiner points where that is impossible. If it would take too many of
/// those, none is inserted, and the polygons in question are left whole ([`FlatteningCounts::left_whole`]).
pub fn flatten<P: PointStore>(
    complex: &Complex,
    index: &SegmentIndex,
    points: &mut P,
    delaunay: &mut Delaunay,
    subsegments: &mut Subsegments,
    incidence: &mut Incidence,
    counts: &mut FlatteningCounts,
) -> Pieces {
    let n = complex.polygons.len();
    let mut state = State {
        complex,
        index,
        cuts: vec![None; n],
        inner: vec![Vec::new(); n],
        vertices: vec![Vec::new(); n],
    };
    let mut requests = state.cut_all(points, &delaunay.mesh, (subsegments, incidence), None);
    if requests.is_empty() && !state.has_bad() {
        return state.collect(counts);
    }
    let before = points.len();
    let most = before + MOST_POINTS + before / 4;
    let saved = (delaunay.clone(), subsegments.clone(), incidence.clone());
    let mut refined = FlatteningCounts::default();
    while state.has_bad() {
        let positions: Vec<Request> = requests.iter().map(|r| r.1).collect();
        let added = add_steiner_points(&positions, points, delaunay, subsegments, incidence);
        let added = added.ok().filter(|added| {
            let progress = added.vertices.iter().any(Option::is_some);
            progress && points.len() <= most && refined.rounds < MOST_ROUNDS
        });
        let Some(added) = added else {
            (*delaunay, *subsegments, *incidence) = saved;
            points.truncate(before);
            state.inner = vec![Vec::new(); n];
            state.cut_all(points, &delaunay.mesh, (subsegments, incidence), None);
            return state.collect(counts);
        };
        refined.rounds += 1;
        for ((f, request), vertex) in requests.into_iter().zip(added.vertices) {
            let Some(v) = vertex else { continue };
            match request {
                Request::Point(_) => {
                    state.inner[f].push(v);
                    refined.points_on_polygons += 1;
                }
                Request::Split(_) => refined.points_on_segments += 1,
            }
        }
        let touched = Some(&added.touched);
        requests = state.cut_all(points, &delaunay.mesh, (subsegments, incidence), touched);
    }
    *counts = refined;
    state.collect(counts)
}

impl State<'_> {
    /// Cuts all polygons that are not flat, or those with touched vertices only, and returns the Steiner points that they
    /// want.
    fn cut_all<P: PointStore>(
        &mut self,
        points: &P,
        mesh: &TetMesh,
        (subsegments, incidence): (&Subsegments, &Incidence),
        touched: Option<&FxHashSet<VertexId>>,
    ) -> Vec<(usize, Request)> {
        let mut requests = Vec::new();
        for (f, polygon) in self.complex.polygons.iter().enumerate() {
            let is_touched =
                |t: &FxHashSet<VertexId>| self.vertices[f].iter().any(|v| t.contains(v));
            let is_bad = self.cuts[f].as_ref().is_some_and(|cut| !cut.bad.is_empty());
            if !is_bad && !touched.is_none_or(is_touched) {
                continue;
            }
            let boundary = boundary_subsegments(subsegments, self.index, polygon);
            self.vertices[f] = vertices(polygon, &boundary, &self.inner[f]);
            self.cuts[f] = None;
            if is_flat(points, polygon, &self.vertices[f]) {
                continue;
            }
            let of_f = (&boundary[..], &self.vertices[f][..]);
            let constraints = (subsegments, self.index);
            let cut = cut::cut(points, mesh, incidence, constraints, polygon, of_f);
            let wanted = wanted(points, polygon, &cut, &boundary);
            requests.extend(wanted.into_iter().map(|request| (f, request)));
            self.cuts[f] = Some(cut);
        }
        requests
    }

    fn has_bad(&self) -> bool {
        self.cuts.iter().flatten().any(|cut| !cut.bad.is_empty())
    }

    fn collect(self, counts: &mut FlatteningCounts) -> Pieces {
        let n = self.cuts.len();
        let mut polygons = Vec::with_capacity(n);
        let mut first = Vec::with_capacity(n + 1);
        let was_cut = self.cuts.iter().map(Option::is_some).collect();
        for (polygon, cut) in self.complex.polygons.iter().zip(self.cuts) {
            first.push(polygons.len());
            counts.not_flat += u64::from(cut.is_some());
            match cut {
                None => polygons.push(polygon.clone()),
                Some(cut) if !cut.bad.is_empty() => {
                    counts.left_whole += 1;
                    polygons.push(polygon.clone());
                }
                Some(cut) => {
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
                segments: self.complex.segments.clone(),
                diagonals: self.complex.diagonals,
                polygons,
            },
            first,
            was_cut,
            inner: self.inner,
        }
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
) -> Vec<Request> {
    let plane = Plane::new(points, polygon.frame);
    let mut taken: Vec<(Request, f64)> = Vec::new();
    for cell in &cut.bad {
        let Some((request, radius)) =
            steiner::for_cell(points, &plane, cell, boundary, polygon.frame)
        else {
            continue;
        };
        let is_close = taken.iter().any(|&(other, r)| match (request, other) {
            (Request::Point(p), Request::Point(q)) => {
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
