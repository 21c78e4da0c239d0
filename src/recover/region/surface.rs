//! The surface of a polygon f that is flat only to rounding: of all triangles of the mesh with their vertices on f,
//! those that a tetrahedron with a right vertex is behind, so that f runs as far to the right as it can.
//!
//! Between the tetrahedra with right vertices and those with left ones there may be *shims*, with all vertices on f, or
//! piles of them. They are left of this surface.

use super::missing::{Covering, Inward, Obstacle, walk};
use super::{Side, Sides};
use crate::mesh::{Incidence, TetId, TetMesh, VertexId};
use crate::predicate::PointStore;

/// The surface of f, whose directed boundary is given, and a crossing tetrahedron wherever it is missing. Every
/// triangle of it turns left in projection. Linear in the stars of its edges.
///
/// # Errors
/// Where nothing of f begins at an edge, or it is not clear what does.
pub fn rightmost<P: PointStore>(
    mesh: &TetMesh,
    incidence: &Incidence,
    sides: &Sides<P>,
    boundary: &[[VertexId; 2]],
) -> Result<Covering, Obstacle> {
    walk(mesh, incidence, boundary, |start, a, b| {
        inward(mesh, sides, start, a, b)
    })
}

/// What lies to the left of a→b on f: going around ab in positive sense, where the last tetrahedron with a right vertex
/// is left on that side. Where f is on the convex hull there may be none; then the hull is.
fn inward<P: PointStore>(
    mesh: &TetMesh,
    sides: &Sides<P>,
    start: TetId,
    a: VertexId,
    b: VertexId,
) -> Result<Inward, Obstacle> {
    let around = mesh.around(start, a, b);
    let link: Vec<(TetId, VertexId, Side)> = around
        .map(|t| {
            let x = mesh.vertex(mesh.exit_around(t, a, b));
            (t, x, sides.of(x))
        })
        .collect();
    let n = link.len();
    let [side, next] = [0, 1].map(|by| move |i: usize| (i + by) % n);
    let side = |i: usize| link[side(i)].2;
    let on_f = |i: usize| side(i) == Side::On && sides.turns_left(a, b, link[i].1);
    // Tetrahedron i has vertices i and i + 1.
    let has = |i: usize, wanted: Side| side(i) == wanted || side(i + 1) == wanted;
    let leaves = |behind: Side| {
        let mut found =
            (0..n).filter(move |&i| has(i + n - 1, behind) && !has(i, behind) && on_f(i));
        (found.next(), found.next())
    };
    let face = |i: usize| Inward::Face(mesh.corner_of(link[i].0, link[next(i)].1), link[i].1);
    match leaves(Side::Right) {
        (Some(i), None) => return Ok(face(i)),
        (Some(_), Some(_)) => return Err(Obstacle::Nothing([a, b])),
        (None, _) => {}
    }
    let crossing = (0..n).find(|&i| side(i) == Side::Right && side(i + 1) == Side::Left);
    if let Some(i) = crossing {
        return Ok(Inward::Crossing(link[i].0));
    }
    match leaves(Side::Infinite) {
        (Some(i), None) if !has(i, Side::Right) => Ok(face(i)),
        _ => Err(Obstacle::Nothing([a, b])),
    }
}
