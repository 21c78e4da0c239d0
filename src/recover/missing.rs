//! What of a polygon f is already in the mesh, and where the missing regions are (paper §3.3).
//!
//! A depth-first search over f from its boundary edges. At each directed edge a→b with f to its left, the tetrahedra
//! around ab are searched for what lies on the side of f: a face abv with v on f, which is a subpolygon, or a crossing
//! tetrahedron, which is in a missing region. The search crosses the other two edges of a subpolygon, unless they bound
//! f. No two-dimensional triangulation of f is made beforehand.

use super::cavity::{Face, face};
use super::side::{Side, Sides};
use crate::mesh::{Corner, Incidence, TetId, TetMesh, VertexId};
use crate::predicate::PointStore;
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
        match inward(mesh, sides, start, a, b, is_subpolygon)? {
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

enum Inward {
    /// The face abv of f, by the corner of the tetrahedron on its left.
    Face(Corner, VertexId),
    /// A tetrahedron that f cuts.
    Crossing(TetId),
}

/// What lies to the left of a→b on f. Going around ab in positive sense, the tetrahedra's other vertices pass from right
/// to left there (and from left to right on the far side of ab).
fn inward<P: PointStore>(
    mesh: &TetMesh,
    sides: &Sides<P>,
    start: TetId,
    a: VertexId,
    b: VertexId,
    is_subpolygon: &dyn Fn(Face) -> bool,
) -> Result<Inward, Obstacle> {
    let mut stray = None;
    let mut crossing = None;
    // Faces abv with v on f: below a left vertex; above a right vertex; between shims.
    let (mut under_left, mut over_right) = (None, None);
    for t in mesh.around(start, a, b) {
        // t = abxy, positive; x comes before y around ab.
        let x = mesh.vertex(mesh.exit_around(t, a, b));
        let y = third(mesh.vertices(t), [a, b, x]);
        let (side_x, side_y) = (sides.of(x), sides.of(y));
        if side_x == Side::On && is_subpolygon(face([a, b, x])) && side_y != Side::Right {
            return Ok(Inward::Face(mesh.corner_of(t, y), x));
        }
        match (side_x, side_y) {
            (Side::Right, Side::Left) => crossing = Some(t),
            (Side::On, Side::Left) => under_left = Some((mesh.corner_of(t, y), x)),
            (Side::Right, Side::On) => over_right = Some((mesh.twin(mesh.corner_of(t, x)), y)),
            (Side::Stray, Side::Left) => stray = Some(x),
            (Side::Right, Side::Stray) => stray = Some(y),
            _ => {}
        }
    }
    match (crossing, under_left.or(over_right), stray) {
        (Some(t), _, _) => Ok(Inward::Crossing(t)),
        (None, Some((c, v)), _) => Ok(Inward::Face(c, v)),
        (None, None, Some(v)) => Err(Obstacle::Stray(v)),
        (None, None, None) => Err(Obstacle::Nothing([a, b])),
    }
}

fn third(t: [VertexId; 4], [a, b, x]: [VertexId; 3]) -> VertexId {
    t.into_iter()
        .find(|&v| v != a && v != b && v != x)
        .expect("a tetrahedron has four vertices")
}
