//! What of a polygon f is already in the mesh, and where the missing regions are (paper §3.3).
//!
//! A depth-first search over f from its boundary edges. At each directed edge a→b with f to its left, the tetrahedra
//! around ab are searched for what lies on the side of f: a face abv with v on f, which is a subpolygon, or a crossing
//! tetrahedron, which is in a missing region. The search crosses the other two edges of a subpolygon, unless they bound
//! f. No two-dimensional triangulation of f is made beforehand.

use super::{Side, Sides};
use crate::mesh::{Corner, Incidence, TetId, TetMesh, VertexId};
use crate::predicate::PointStore;
use crate::recover::subpolygons::{Face, face};
use rustc_hash::FxHashSet;

/// The result of the search.
#[derive(Clone, Debug, Default)]
pub struct Covering {
    /// The faces of the mesh that lie in f, each as the corner on its left side.
    pub faces: Vec<Corner>,
    /// A crossing tetrahedron next to each edge at which f is missing.
    pub seeds: Vec<TetId>,
}

/// Why the search cannot tell what f looks like at an edge.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Obstacle {
    /// This vertex lies in the interior of f, exactly, but is not a vertex of f.
    Stray(VertexId),
    /// Neither a face of f nor a crossing tetrahedron is at the edge: f is not flat, or its edge is not in the mesh.
    Nothing([VertexId; 2]),
}

/// Searches f, whose boundary consists of the directed subsegments `boundary`. `is_subpolygon` tells the triangles that
/// are already known to be f's; where shim tetrahedra leave a choice of faces, those are taken.
pub fn search<P: PointStore>(
    mesh: &TetMesh,
    incidence: &Incidence,
    sides: &Sides<P>,
    boundary: &[[VertexId; 2]],
    is_subpolygon: &dyn Fn(Face) -> bool,
) -> Result<Covering, Obstacle> {
    walk(mesh, incidence, boundary, |start, a, b| {
        inward(mesh, sides, start, a, b, is_subpolygon)
    })
}

/// The search, by what lies inward at a directed edge, around which a tetrahedron is given.
pub(super) fn walk(
    mesh: &TetMesh,
    incidence: &Incidence,
    boundary: &[[VertexId; 2]],
    inward: impl Fn(TetId, VertexId, VertexId) -> Result<Inward, Obstacle>,
) -> Result<Covering, Obstacle> {
    let border: FxHashSet<[VertexId; 2]> = boundary.iter().copied().collect();
    let mut covering = Covering::default();
    // Directed edges to look at, each with a tetrahedron at it, and those already closed by a face or a seed.
    let mut open: Vec<([VertexId; 2], Option<TetId>)> =
        boundary.iter().rev().map(|&e| (e, None)).collect();
    let mut closed: FxHashSet<[VertexId; 2]> = FxHashSet::default();
    while let Some(([a, b], near)) = open.pop() {
        if !closed.insert([a, b]) {
            continue;
        }
        let start = near
            .or_else(|| incidence.tet_at_edge(mesh, a, b))
            .ok_or(Obstacle::Nothing([a, b]))?;
        match inward(start, a, b)? {
            Inward::Crossing(t) => covering.seeds.push(t),
            Inward::Face(c, v) => {
                covering.faces.push(c);
                for [p, q] in [[b, v], [v, a]] {
                    closed.insert([p, q]);
                    if !border.contains(&[p, q]) {
                        open.push(([q, p], Some(c.tet())));
                    }
                }
            }
        }
    }
    Ok(covering)
}

/// What the search meets at an edge.
pub(super) enum Inward {
    /// The face abv of f, by the corner of the tetrahedron on its left side.
    Face(Corner, VertexId),
    /// A tetrahedron that f cuts.
    Crossing(TetId),
}

/// What lies to the left of a→b on f. Going around ab in positive sense, the other vertices of the tetrahedra pass from
/// right to left there, and from left to right on the far side of ab; in between there may be vertices on f, one if f
/// is flat, several if shim tetrahedra lie between.
fn inward<P: PointStore>(
    mesh: &TetMesh,
    sides: &Sides<P>,
    start: TetId,
    a: VertexId,
    b: VertexId,
    is_subpolygon: &dyn Fn(Face) -> bool,
) -> Result<Inward, Obstacle> {
    // The tetrahedra abxy around ab, in order, each with its x and the side of x.
    let link: Vec<(TetId, VertexId, Side)> = mesh
        .around(start, a, b)
        .map(|t| {
            let x = mesh.vertex(mesh.exit_around(t, a, b));
            (t, x, sides.of(x))
        })
        .collect();
    let n = link.len();
    let side = |i: usize| link[i % n].2;
    let vertex = |i: usize| link[i % n].1;
    // A face with vertices on h alone is on the side of f if it turns left from ab in projection. If f is flat the
    // order of the sides says the same.
    let on_left = |i: usize| sides.flat || sides.turns_left(a, b, vertex(i));
    let on_f = |i: usize| side(i) == Side::On && on_left(i);
    let result = |i: usize| Inward::Face(mesh.corner_of(link[i % n].0, vertex(i + 1)), vertex(i));
    if let Some(i) =
        (0..n).find(|&i| on_f(i) && !sides.flat && is_subpolygon(face([a, b, vertex(i)])))
    {
        return Ok(result(i));
    }
    let crossing = (0..n).find(|&i| side(i) == Side::Right && side(i + 1) == Side::Left);
    let crossing = crossing.map(|i| Inward::Crossing(link[i].0));
    // Runs of vertices on h, as ranges of `link`. A flat f follows a right vertex and precedes a left one, and on the
    // far side it is the other way round. A vertex that is on the wrong side because f is not flat spoils one of the
    // two.
    let on = |i: usize| on_f(i) || (side(i) == Side::Stray && on_left(i));
    let rank = |side, near: Side, far: Side| i32::from(side == near) - i32::from(side == far);
    let runs = (0..n).filter(|&i| on(i) && !on(i + n - 1)).map(|first| {
        let last = (first..first + n)
            .find(|&i| !on(i + 1))
            .expect("ab has vertices off the plane");
        let before = rank(side(first + n - 1), Side::Right, Side::Left);
        let after = rank(side(last + 1), Side::Left, Side::Right);
        (before + after, first, last)
    });
    // If f is flat there is either such a run or a crossing tetrahedron. If it is not, slivers beyond a face of f can
    // look like crossing ones.
    let best = runs.filter(|run| run.0 >= 0).max_by_key(|run| run.0);
    let Some((_, first, last)) = best else {
        return crossing.ok_or(Obstacle::Nothing([a, b]));
    };
    // Vertices of f first: if f is not flat, a shim may also have a stray vertex beyond another edge of f.
    let mut run = first..=last;
    let chosen = if side(last + 1) == Side::Left {
        run.rfind(|&i| on_f(i))
    } else {
        run.find(|&i| on_f(i))
    };
    chosen
        .map(result)
        .or(crossing)
        .ok_or_else(|| Obstacle::Stray(vertex(first)))
}
