//! A polygon that is not exactly flat, cut along edges of the Delaunay tetrahedralization into pieces that are.
//!
//! # Why
//! A CDT exists if all segments are edges of the (perturbed) Delaunay tetrahedralization and all polygons are flat. An
//! edge ab of it between two vertices of a polygon f can be declared a segment at no cost. If enough of them divide f
//! into exactly flat pieces, triangles above all, then the pieces are polygons of a PLC that has a CDT in exact
//! arithmetic, and no insertion of theirs meets the troubles of the paper's §3.1 and §3.2. What remains of those is
//! here, where nothing of the mesh has been touched:
//!
//! - Two edges that cross in projection are opposite edges of a shim, or of a pile of shims (tetrahedra with all vertices
//!   on f). Any choice will do that divides f into flat cells: the lower one always, so that f runs below all shims; the
//!   upper one always; or the shorter one first. On the convex hull one of the first two can be a bad choice: from
//!   outside, every edge of the hull is Delaunay, however long, and hides shims across segments.
//! - Where neither diagonal of a quadrilateral is an edge (paper, Fig. 4) a cell remains that is not flat: [`Cut::bad`].
//!
//! Linear in the stars of f's vertices, but for the sweep over its edges.

use super::plane::Plane;
use crate::mesh::{Incidence, TetMesh, VertexId};
use crate::plc::Polygon;
use crate::predicate::PointStore;
use crate::recover::segments::{SegmentIndex, Subsegments};
use rustc_hash::{FxHashMap, FxHashSet};

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
        let ends = self.edges.iter().flatten().copied();
        let mut vertices: Vec<VertexId> = ends.chain(self.isolated.iter().copied()).collect();
        vertices.sort_unstable();
        vertices.dedup();
        vertices
    }
}

/// A polygon in pieces.
#[derive(Clone, Debug, Default)]
pub(super) struct Cut {
    /// The exactly flat pieces.
    pub(super) pieces: Vec<Polygon>,
    /// The cells that are not flat.
    pub(super) bad: Vec<Cell>,
    /// How often a choice between crossing edges was made.
    pub(super) choices: usize,
}

/// Cuts polygon f with the directed boundary subsegments `boundary` and the vertices `vertices`, Steiner points included,
/// sorted.
pub(super) fn cut<P: PointStore>(
    points: &P,
    mesh: &TetMesh,
    incidence: &Incidence,
    (subsegments, index): (&Subsegments, &SegmentIndex),
    f: &Polygon,
    (boundary, vertices): (&[[VertexId; 2]], &[VertexId]),
) -> Cut {
    let plane = Plane::new(points, f.frame);
    let directed: FxHashSet<[VertexId; 2]> = boundary.iter().copied().collect();
    let mut neighbours: FxHashMap<VertexId, Vec<VertexId>> = FxHashMap::default();
    for &[a, b] in boundary {
        neighbours.entry(a).or_default().push(b);
        neighbours.entry(b).or_default().push(a);
    }
    let leads_inside = |v: VertexId, w: VertexId| {
        let Some(around) = neighbours.get(&v) else {
            return true;
        };
        // The last one counterclockwise from w is the first one clockwise.
        let last = around.iter().max_by(|&&p, &&q| plane.around(v, w, p, q));
        let last = *last.expect("a vertex of the boundary has edges");
        let overlaps = |p: VertexId| plane.turn(v, w, p).is_zero() && plane.ahead(v, w, p);
        directed.contains(&[v, last]) && !around.iter().any(|&p| overlaps(p))
    };
    let mut candidates: Vec<[VertexId; 2]> = Vec::new();
    for &v in vertices {
        let star = incidence.star(mesh, v);
        let mut others: Vec<VertexId> = star
            .iter()
            .flat_map(|&t| mesh.vertices(t))
            .filter(|&w| w > v && !w.is_infinite() && vertices.binary_search(&w).is_ok())
            .collect();
        others.sort_unstable();
        others.dedup();
        others.retain(|&w| {
            !directed.contains(&[v, w])
                && !directed.contains(&[w, v])
                && !subsegments.share_segment(index, v, w)
                && leads_inside(v, w)
                && leads_inside(w, v)
        });
        candidates.extend(others.into_iter().map(|w| [v, w]));
    }
    let crossings = crossings(points, &plane, boundary, vertices, candidates);
    let preferences = [Preference::Lower, Preference::Upper, Preference::Shorter];
    let mut best: Option<Cut> = None;
    for preference in preferences {
        let accepted = crossings.without(points, preference);
        let mut result = Cut {
            choices: crossings.pairs.len(),
            ..Cut::default()
        };
        for cell in cells(&plane, boundary, vertices, &accepted) {
            match piece(points, &plane, f, &cell) {
                Some(piece) => result.pieces.push(piece),
                None => result.bad.push(cell),
            }
        }
        let done = result.bad.is_empty() || result.choices == 0;
        if best.as_ref().is_none_or(|b| result.bad.len() < b.bad.len()) {
            best = Some(result);
        }
        if done {
            break;
        }
    }
    best.expect("there is a first one")
}

/// Which of two crossing edges is chosen.
#[derive(Clone, Copy, PartialEq, Debug)]
enum Preference {
    /// The lower one, so that f runs below all shims.
    Lower,
    /// The upper one.
    Upper,
    /// The shorter one: where f is on the convex hull, an edge on the wrong side may be any, and cross many good ones.
    Shorter,
}

/// Edges between vertices of f that cross no edge of its boundary.
struct Crossings {
    edges: Vec<[VertexId; 2]>,
    /// Pairs of edges that cross, by index, the lower one first. Sorted.
    pairs: Vec<[usize; 2]>,
}

impl Crossings {
    /// As many edges as possible of which no two cross.
    fn without<P: PointStore>(&self, points: &P, preference: Preference) -> Vec<[VertexId; 2]> {
        let n = self.edges.len();
        let mut opponents: FxHashMap<usize, Vec<usize>> = FxHashMap::default();
        for &[i, j] in &self.pairs {
            opponents.entry(i).or_default().push(j);
            opponents.entry(j).or_default().push(i);
        }
        let mut accepted = vec![preference != Preference::Shorter; n];
        for &[lower, upper] in &self.pairs {
            match preference {
                Preference::Lower => accepted[upper] = false,
                Preference::Upper => accepted[lower] = false,
                Preference::Shorter => {}
            }
        }
        let mut order: Vec<usize> = (0..n).collect();
        if preference == Preference::Shorter {
            let length = |i: usize| {
                let [a, b] = self.edges[i].map(|v| points.rounded(v));
                (0..3).map(|k| (a[k] - b[k]) * (a[k] - b[k])).sum::<f64>()
            };
            order.sort_by(|&i, &j| length(i).total_cmp(&length(j)).then(i.cmp(&j)));
        }
        // Those that give way to none of the accepted ones after all.
        for i in order {
            if !accepted[i] {
                let mut against = opponents.get(&i).into_iter().flatten();
                accepted[i] = against.all(|&j| !accepted[j]);
            }
        }
        let chosen = self.edges.iter().zip(accepted);
        chosen
            .filter(|(_, accepted)| *accepted)
            .map(|(&e, _)| e)
            .collect()
    }
}

/// The candidates that do not cross the boundary, and how they cross each other.
fn crossings<P: PointStore>(
    points: &P,
    plane: &Plane<P>,
    boundary: &[[VertexId; 2]],
    vertices: &[VertexId],
    candidates: Vec<[VertexId; 2]>,
) -> Crossings {
    #[derive(Clone, Copy, PartialEq)]
    enum Kind {
        Fixed,
        Candidate(usize),
    }
    // A vertex is an edge from itself to itself: none may pass through it.
    let fixed = boundary
        .iter()
        .copied()
        .chain(vertices.iter().map(|&v| [v, v]));
    let named = candidates
        .iter()
        .enumerate()
        .map(|(i, &e)| (e, Kind::Candidate(i)));
    let range = |e: [VertexId; 2], k: usize| {
        let [a, b] = e.map(|v| points.rounded(v)[k]);
        let slack = 4.0 * f64::EPSILON * a.abs().max(b.abs());
        [a.min(b) - slack, a.max(b) + slack]
    };
    // Sweep along the coordinate with the widest spread.
    let spread = |k: usize| {
        let all = vertices.iter().map(|&v| points.rounded(v)[k]);
        let (low, high) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| {
            (l.min(x), h.max(x))
        });
        high - low
    };
    let axis = (0..3)
        .max_by(|&j, &k| spread(j).total_cmp(&spread(k)))
        .expect("three axes");
    let mut all: Vec<([f64; 2], [VertexId; 2], Kind)> = fixed
        .map(|e| (e, Kind::Fixed))
        .chain(named)
        .map(|(e, kind)| (range(e, axis), e, kind))
        .collect();
    all.sort_by(|x, y| x.0[0].total_cmp(&y.0[0]));
    let mut blocked = vec![false; candidates.len()];
    // Pairs of crossing candidates, the lower one first.
    let mut pairs: Vec<[usize; 2]> = Vec::new();
    for (i, &(r, e, kind)) in all.iter().enumerate() {
        for &(_, g, other) in all[i + 1..].iter().take_while(|x| x.0[0] <= r[1]) {
            if kind == Kind::Fixed && other == Kind::Fixed {
                continue;
            }
            let apart = (0..3).filter(|&k| k != axis).any(|k| {
                let ([a, b], [c, d]) = (range(e, k), range(g, k));
                b < c || d < a
            });
            let share = e.iter().any(|v| g.contains(v));
            if apart || e == g {
                continue;
            }
            let mut block = |kind: Kind| {
                if let Kind::Candidate(i) = kind {
                    blocked[i] = true;
                }
            };
            if g.iter().any(|&v| plane.is_between(e[0], e[1], v)) {
                block(kind);
            } else if e.iter().any(|&v| plane.is_between(g[0], g[1], v)) {
                block(other);
            } else if !share && plane.cross(e, g) {
                match (kind, other) {
                    (Kind::Candidate(i), Kind::Candidate(j)) => {
                        pairs.push(if plane.passes_above(e, g) {
                            [j, i]
                        } else {
                            [i, j]
                        });
                    }
                    (Kind::Fixed, kind) | (kind, Kind::Fixed) => block(kind),
                }
            }
        }
    }
    let mut new_index = vec![usize::MAX; candidates.len()];
    let mut edges = Vec::with_capacity(candidates.len());
    for (i, e) in candidates.into_iter().enumerate() {
        if !blocked[i] {
            new_index[i] = edges.len();
            edges.push(e);
        }
    }
    pairs.retain(|pair| pair.iter().all(|&i| !blocked[i]));
    for pair in &mut pairs {
        *pair = pair.map(|i| new_index[i]);
    }
    pairs.sort_unstable();
    Crossings { edges, pairs }
}

/// The cells into which boundary and diagonals divide f.
fn cells<P: PointStore>(
    plane: &Plane<P>,
    boundary: &[[VertexId; 2]],
    vertices: &[VertexId],
    diagonals: &[[VertexId; 2]],
) -> Vec<Cell> {
    let both = diagonals.iter().flat_map(|&[a, b]| [[a, b], [b, a]]);
    let edges: Vec<[VertexId; 2]> = boundary.iter().copied().chain(both).collect();
    let mut out: FxHashMap<VertexId, Vec<VertexId>> = FxHashMap::default();
    for &[a, b] in &edges {
        out.entry(a).or_default().push(b);
    }
    let next = |[a, v]: [VertexId; 2]| {
        // The first edge clockwise from the way back.
        let targets = out.get(&v)?;
        let w = targets.iter().max_by(|&&p, &&q| plane.around(v, a, p, q))?;
        Some([v, *w])
    };
    let mut seen: FxHashSet<[VertexId; 2]> = FxHashSet::default();
    let (mut cells, mut islands) = (Vec::new(), Vec::new());
    for &start in &edges {
        let mut cycle = Vec::new();
        let mut at = Some(start);
        while let Some(edge) = at.filter(|&e| seen.insert(e)) {
            cycle.push(edge);
            at = next(edge);
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
    let with_edges: FxHashSet<VertexId> = edges.iter().flatten().copied().collect();
    for &v in vertices.iter().filter(|v| !with_edges.contains(v)) {
        if let Some(i) = holder(&cells, v) {
            cells[i].isolated.push(v);
        }
    }
    cells
}

/// A cell as a polygon, if it is exactly flat.
fn piece<P: PointStore>(points: &P, plane: &Plane<P>, f: &Polygon, cell: &Cell) -> Option<Polygon> {
    let vertices = cell.vertices();
    let frame = frame(points, plane, &vertices)?;
    let [a, b, c] = frame;
    let flat = vertices
        .iter()
        .all(|&v| frame.contains(&v) || points.orient3d([a, b, c, v]).is_zero());
    let mut edges = cell.edges.clone();
    edges.sort_unstable();
    flat.then(|| Polygon {
        edges,
        vertices,
        frame,
        flat: true,
        facets: f.facets.clone(),
        marker: f.marker,
    })
}

/// Three vertices that turn counterclockwise; far apart, if possible.
fn frame<P: PointStore>(
    points: &P,
    plane: &Plane<P>,
    vertices: &[VertexId],
) -> Option<[VertexId; 3]> {
    let at = |v: VertexId| points.rounded(v);
    let minus = |p: [f64; 3], q: [f64; 3]| [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
    let square = |p: [f64; 3]| p.iter().map(|x| x * x).sum::<f64>();
    let farthest = |key: &dyn Fn(VertexId) -> f64| {
        vertices
            .iter()
            .copied()
            .max_by(|&v, &w| key(v).total_cmp(&key(w)).then(w.cmp(&v)))
    };
    let first = *vertices.first()?;
    let a = farthest(&|v| square(minus(at(v), at(first))))?;
    let b = farthest(&|v| square(minus(at(v), at(a))))?;
    let c = farthest(&|v| {
        let (p, q) = (minus(at(b), at(a)), minus(at(v), at(a)));
        square([
            p[1] * q[2] - p[2] * q[1],
            p[2] * q[0] - p[0] * q[2],
            p[0] * q[1] - p[1] * q[0],
        ])
    })?;
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
