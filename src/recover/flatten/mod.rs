//! Polygons that are flat only to rounding (paper, end of §3.1 and of §3.2), dealt with before any polygon is inserted.
//!
//! Polygons of four or more vertices in floating point, and polygons with rounded Steiner points on their boundaries,
//! are not exactly flat. Each is cut along edges that the Delaunay tetrahedralization has (`cut.rs`). Cells that are
//! exactly flat are pieces. Where edges are missing, cells remain that are not: they are to be inserted as they are,
//! whole, as in the paper. Whether they can be is found out by a trial, the insertion of all pieces into a copy. Cells
//! that are refused get a Steiner point (`steiner.rs`), their polygons are cut again, and tried again, until all pieces
//! fit. As this happens in the Delaunay tetrahedralization, no mesh of a polygon is ever taken back.
//!
//! Insertions of exactly flat pieces into an edge-protected PLC are as proved: there is one CDT, and cavities, gift
//! wrapping and exactly ordered flips all find it. Pieces that are not flat are inserted before them, by flips and a
//! look at the result (`recover::polygons`). The CDT may have shims, which are repaired on output (`shims`).
//!
//! After each round of Steiner points only polygons with both ends of an edge that has vanished are looked at, and
//! those that could not be cut.
//!
//! # End
//! Refinement of nearly flat polygons ends in practice for the same reasons as that of segments; it is bounded by
//! [`MOST_ROUNDS`] and [`MOST_POINTS`]. Beyond those nothing is inserted, and cells that are not flat are left to the
//! insertion of polygons, which may refuse them. Trials are bounded by [`MOST_TRIALS`] and [`MOST_TRIED`], and end
//! where one refuses more than half as many pieces as the one before: then Steiner points are better.

mod cells;
mod counts;
mod crossings;
mod cut;
mod figure;
mod neighbours;
mod pieces;
mod plane;
mod steiner;

pub(crate) use counts::Refusal;
pub use counts::{FlatteningCounts, RefusedCounts, ShimCounts};
pub(crate) use pieces::Fit;
pub use pieces::Pieces;
pub(crate) use plane::Plane;

use crate::delaunay::Delaunay;
use crate::error::Failure;
use crate::mesh::{Groups, Incidence, TetMesh, VertexId};
use crate::plc::{Complex, Polygon};
use crate::predicate::{GrowingStore, PointStore};
use crate::recover::segments::{GoOn, Request, Subsegments, add_steiner_points};
use cells::Cell;
use cut::Cut;
use figure::Figure;
use neighbours::Neighbours;
use rustc_hash::FxHashMap;
use std::sync::Arc;

/// How often Steiner points are inserted and polygons are cut again.
pub const MOST_ROUNDS: usize = 200;

/// How often pieces are tried whole, at most, before Steiner points are inserted into all that are not flat.
pub const MOST_TRIALS: usize = 30;

/// How many pieces are inserted in all those trials together, unless one trial has more.
pub const MOST_TRIED: usize = 50_000;

/// How many Steiner points may be inserted, besides a quarter of the number of vertices.
pub const MOST_POINTS: usize = 1000;

/// What the polygons of a complex are made of at the moment.
struct State<'a> {
    complex: &'a Arc<Complex>,
    /// The pieces of polygons that are not flat.
    cuts: Vec<Option<Box<Cut>>>,
    /// The polygons with cells that are not flat, ascending.
    bad: Vec<usize>,
    /// Why polygons got Steiner points: a piece could not be inserted whole.
    refused: Vec<Option<Refusal>>,
    /// How the pieces fit, if all have been inserted into a copy.
    fits: Vec<Fit>,
    inner: Vec<Vec<VertexId>>,
    neighbours: Neighbours,
    /// The polygons of each vertex, once that is of interest.
    polygons_at: Option<PolygonsAt>,
    /// Memory used again.
    boundary: Vec<[VertexId; 2]>,
    vertices: Vec<VertexId>,
}

/// On which polygons each vertex is. The pieces of a polygon depend on its vertices and on the edges between them.
/// Edges that appear have a new vertex, and if that is on a segment, it divides an edge of all polygons that it is on,
/// of which it is the first new vertex, or which have been found by an earlier one. So a polygon with at most one end
/// of each edge that vanishes is as it was, unless it gets an inner point.
struct PolygonsAt {
    /// Those of the vertices when the first Steiner point was inserted; polygons keep all vertices that they have.
    before: Groups<u32>,
    first_new: usize,
    /// Those of later Steiner points.
    new: FxHashMap<VertexId, Vec<u32>>,
}

impl PolygonsAt {
    /// Those of v; of a Steiner point those that have been looked at since it came.
    fn of(&self, v: VertexId) -> impl Iterator<Item = u32> + '_ {
        let before = if v.index() < self.first_new {
            self.before.of(v)
        } else {
            &[]
        };
        let new = self.new.get(&v).into_iter().flatten();
        before.iter().chain(new).copied()
    }

    /// Whether f is among those of v.
    fn has(&self, v: VertexId, f: u32) -> bool {
        if v.index() < self.first_new {
            return self.before.of(v).binary_search(&f).is_ok();
        }
        self.new.get(&v).is_some_and(|of| of.contains(&f))
    }
}

/// How pieces fit into the mesh, or which of them, of those that are not flat, cannot be inserted whole, and why.
pub(crate) type Tried = Result<Vec<Fit>, Vec<(usize, Refusal)>>;

/// Who tries, given the Delaunay tetrahedralization of some points with the given subsegments.
pub(crate) type Trial<'a, P> =
    &'a dyn Fn(&P, &Delaunay, (&Subsegments, &Incidence), Pieces) -> Tried;

/// Cuts all polygons that are not flat as far as the edges of the mesh do; the pieces are flat, or can be inserted
/// whole, as `trial` finds out if it is given, or Steiner points are inserted where that is impossible. If it would
/// take too many of those, none is inserted, and the polygons in question are left whole
/// ([`FlatteningCounts::left_whole`]). `go_on` is told in each round how many Steiner points there are.
///
/// # Errors
/// [`Failure::Stopped`] if `go_on` says so.
pub(crate) fn flatten<P: GrowingStore>(
    complex: &Arc<Complex>,
    points: &mut P,
    delaunay: &mut Delaunay,
    subsegments: &mut Subsegments,
    incidence: &mut Incidence,
    (trial, counts): (Option<Trial<P>>, &mut FlatteningCounts),
    go_on: &GoOn<'_>,
) -> Result<Pieces, Failure> {
    let n = complex.polygons.len();
    let mut state = State {
        complex,
        cuts: vec![None; n],
        bad: Vec::new(),
        refused: vec![None; n],
        fits: Vec::new(),
        inner: vec![Vec::new(); n],
        neighbours: Neighbours::default(),
        polygons_at: None,
        boundary: Vec::new(),
        vertices: Vec::new(),
    };
    state.cut_all(points, &delaunay.mesh, (subsegments, incidence), 0..n);
    if state.bad.is_empty() {
        return Ok(state.collect(counts));
    }
    let before = points.len();
    let most = before + MOST_POINTS + before / 4;
    let saved = (delaunay.clone(), subsegments.clone(), incidence.clone());
    state.polygons_at = Some(state.polygons_at(subsegments, before));
    let mut refined = FlatteningCounts::default();
    // How many pieces the last trial refused, and whether that was at most half as many as the one before. A trial
    // takes as long as the insertion of all polygons.
    let (mut last, mut worthwhile) = (usize::MAX, true);
    while !state.bad.is_empty() {
        if !go_on(points.len() - subsegments.first_steiner()) {
            return Err(Failure::Stopped);
        }
        let most_trials = (MOST_TRIED / state.count_pieces()).clamp(1, MOST_TRIALS);
        let refused = match trial.filter(|_| worthwhile && refined.trials < most_trials) {
            Some(trial) => {
                refined.trials += 1;
                let refused = state
                    .try_whole(|pieces| trial(points, delaunay, (subsegments, incidence), pieces));
                worthwhile = 2 * refused.len() <= last;
                last = refused.len();
                refused
            }
            None => state.all_bad(),
        };
        if refused.is_empty() {
            break;
        }
        let requests = state.requests(points, subsegments, &refused);
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
            state.neighbours = Neighbours::default();
            state.polygons_at = None;
            state.cut_all(points, &delaunay.mesh, (subsegments, incidence), 0..n);
            return Ok(state.collect(counts));
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
        state.neighbours.forget(&added.changes.touched);
        let again = state.bad_or_at(&added.changes.vanished).into_iter();
        state.cut_all(points, &delaunay.mesh, (subsegments, incidence), again);
    }
    *counts = refined;
    Ok(state.collect(counts))
}

impl State<'_> {
    /// Cuts those of the given polygons, in ascending order, that are not flat. All polygons that have cells that are
    /// not flat must be among them.
    fn cut_all<P: PointStore>(
        &mut self,
        points: &P,
        mesh: &TetMesh,
        (subsegments, incidence): (&Subsegments, &Incidence),
        polygons: impl Iterator<Item = usize>,
    ) {
        self.bad.clear();
        for f in polygons {
            let polygon = &self.complex.polygons[f];
            self.look_at(f, subsegments);
            self.cuts[f] = None;
            if is_flat(points, polygon, &self.vertices) {
                continue;
            }
            let figure = Figure::new(points, polygon, (&self.boundary, &self.vertices));
            let around = (mesh, incidence, &mut self.neighbours);
            let cut = cut::cut(&figure, polygon, around, subsegments);
            if !cut.bad.is_empty() {
                self.bad.push(f);
            }
            self.cuts[f] = Some(Box::new(cut));
        }
    }

    /// The Steiner points that cells of polygons want, the polygons in ascending order.
    fn requests<P: PointStore>(
        &mut self,
        points: &P,
        subsegments: &Subsegments,
        refused: &[(usize, usize)],
    ) -> Vec<(usize, Request)> {
        let mut requests = Vec::new();
        for of_polygon in refused.chunk_by(|s, t| s.0 == t.0) {
            let f = of_polygon[0].0;
            self.look_at(f, subsegments);
            let polygon = &self.complex.polygons[f];
            let figure = Figure::new(points, polygon, (&self.boundary, &self.vertices));
            let cut = self.cuts[f].as_ref();
            let bad = &cut.expect("its cells have been refused").bad;
            let cells = of_polygon.iter().map(|&(_, cell)| &bad[cell]);
            let wanted = wanted(&figure, polygon, cells);
            requests.extend(wanted.into_iter().map(|request| (f, request)));
        }
        requests
    }

    /// All cells that are not flat, of all polygons.
    fn all_bad(&self) -> Vec<(usize, usize)> {
        let cells = |f: usize| self.cuts[f].as_ref().map_or(0, |cut| cut.bad.len());
        let bad = self.bad.iter();
        bad.flat_map(|&f| (0..cells(f)).map(move |cell| (f, cell)))
            .collect()
    }

    /// Finds the boundary of polygon f and all its vertices, sorted.
    fn look_at(&mut self, f: usize, subsegments: &Subsegments) {
        let polygon = &self.complex.polygons[f];
        self.boundary.clear();
        subsegments.append_boundary(polygon, &mut self.boundary);
        self.vertices.clear();
        self.vertices.extend(&polygon.vertices);
        if self.boundary.len() > polygon.edges.len() || !self.inner[f].is_empty() {
            let ends = self.boundary.iter().flatten();
            self.vertices.extend(ends.chain(&self.inner[f]));
            self.vertices.sort_unstable();
            self.vertices.dedup();
        }
        if let Some(at) = &mut self.polygons_at {
            let new = self.vertices.partition_point(|v| v.index() < at.first_new);
            for &v in &self.vertices[new..] {
                let polygons = at.new.entry(v).or_default();
                if !polygons.contains(&(f as u32)) {
                    polygons.push(f as u32);
                }
            }
        }
    }

    /// The polygons of each vertex, of which there are n.
    fn polygons_at(&mut self, subsegments: &Subsegments, n: usize) -> PolygonsAt {
        let mut pairs: Vec<(VertexId, u32)> = Vec::new();
        for f in 0..self.complex.polygons.len() {
            self.look_at(f, subsegments);
            pairs.extend(self.vertices.iter().map(|&v| (v, f as u32)));
        }
        PolygonsAt {
            before: Groups::new(n, pairs.iter().copied()),
            first_new: n,
            new: FxHashMap::default(),
        }
    }

    /// The polygons with cells that are not flat, and those with both ends of an edge that has vanished; ascending.
    fn bad_or_at(&self, vanished: &[[VertexId; 2]]) -> Vec<usize> {
        let at = self
            .polygons_at
            .as_ref()
            .expect("it is found before the first round");
        let mut again = self.bad.clone();
        for &[a, b] in vanished {
            again.extend(at.of(a).filter(|&f| at.has(b, f)).map(|f| f as usize));
        }
        again.sort_unstable();
        again.dedup();
        again
    }

    /// Tries to insert all pieces. The cells that are refused, with their polygons, ascending.
    fn try_whole(&mut self, trial: impl FnOnce(Pieces) -> Tried) -> Vec<(usize, usize)> {
        let pieces = self.pieces();
        let found = match trial(pieces.clone()) {
            Ok(fits) => {
                self.fits = fits;
                return Vec::new();
            }
            Err(found) => found,
        };
        let mut refused = Vec::with_capacity(found.len());
        for (piece, why) in found {
            let f = pieces.polygon_of(piece);
            self.refused[f].get_or_insert(why);
            let cut = self.cuts[f].as_ref();
            let cut = cut.expect("other polygons are flat");
            if cut.is_in_pieces() {
                refused.push((f, piece - pieces.of(f).start - cut.pieces.len()));
            } else {
                refused.extend((0..cut.bad.len()).map(|cell| (f, cell)));
            }
        }
        refused.sort_unstable();
        refused
    }

    fn collect(self, counts: &mut FlatteningCounts) -> Pieces {
        for (f, cut) in self.cuts.iter().enumerate() {
            let Some(cut) = cut else { continue };
            counts.not_flat += 1;
            if let Some(why) = self.refused[f] {
                counts.refused.add(why);
            }
            if !cut.is_in_pieces() || !cut.bad.is_empty() && self.fits.is_empty() {
                counts.left_whole += 1;
                continue;
            }
            counts.pieces += cut.pieces.len() as u64;
            counts.choices += cut.choices as u64;
            counts.whole += u64::from(!cut.whole.is_empty());
            counts.whole_pieces += cut.whole.len() as u64;
        }
        self.pieces()
    }

    /// How many pieces there are, at least.
    fn count_pieces(&self) -> usize {
        let cuts = self.cuts.iter().map(|cut| match cut {
            Some(cut) => cut.pieces.len() + cut.whole.len(),
            None => 1,
        });
        cuts.sum::<usize>().max(1)
    }

    /// All polygons in pieces; those are left as they are that have cells that can be no polygons.
    fn pieces(&self) -> Pieces {
        let n = self.cuts.len();
        let inner = self.inner.clone();
        if self.cuts.iter().all(Option::is_none) {
            return Pieces {
                inner,
                ..Pieces::whole(Arc::clone(self.complex))
            };
        }
        let mut polygons = Vec::with_capacity(n);
        let mut first = Vec::with_capacity(n + 1);
        let was_cut = self.cuts.iter().map(Option::is_some).collect();
        for (polygon, cut) in self.complex.polygons.iter().zip(&self.cuts) {
            first.push(polygons.len());
            match cut {
                Some(cut) if cut.is_in_pieces() => {
                    polygons.extend(cut.pieces.iter().chain(&cut.whole).cloned());
                }
                _ => polygons.push(polygon.clone()),
            }
        }
        first.push(polygons.len());
        Pieces {
            complex: Arc::new(Complex {
                representative: Vec::new(),
                segments: self.complex.segments.clone(),
                diagonals: self.complex.diagonals,
                polygons,
            }),
            first,
            was_cut,
            inner,
            fits: self.fits.clone(),
        }
    }
}

/// Whether all vertices of a polygon, sorted, those on its boundary and inside it included, are exactly on one plane.
fn is_flat<P: PointStore>(points: &P, polygon: &Polygon, vertices: &[VertexId]) -> bool {
    let [a, b, c] = polygon.frame;
    let on_plane = |v: &VertexId| points.orient3d([a, b, c, *v]).is_zero();
    // Its own vertices are no others.
    let own = &polygon.vertices;
    let mut added = vertices.iter().filter(|v| own.binary_search(v).is_err());
    polygon.flat && (vertices.len() == own.len() || added.all(on_plane))
}

/// The Steiner points that cells of a polygon want, without those that come close to others.
fn wanted<'a, P: PointStore>(
    figure: &Figure<P>,
    polygon: &Polygon,
    cells: impl Iterator<Item = &'a Cell>,
) -> Vec<Request> {
    let (points, plane, boundary) = (figure.points, &figure.plane, figure.boundary);
    let mut taken: Vec<(Request, f64)> = Vec::new();
    for cell in cells {
        let Some((request, radius)) =
            steiner::for_cell(points, plane, cell, boundary, polygon.frame)
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
