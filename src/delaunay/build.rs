//! From a vertex set to its Delaunay tetrahedralization.

use super::{Delaunay, insertion_order};
use crate::mesh::VertexId;
use crate::predicate::PointStore;

/// Why a vertex set has no Delaunay tetrahedralization.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
pub enum DelaunayError {
    /// Fewer than four distinct vertices.
    #[error("{0} distinct vertices; a tetrahedralization needs four")]
    TooFew(usize),
    /// All vertices lie on one line.
    #[error("all {0} vertices lie on one line")]
    Collinear(usize),
    /// All vertices lie on one plane.
    #[error("all {0} vertices lie on one plane")]
    Coplanar(usize),
}

/// The Delaunay tetrahedralization of distinct vertices, under the symbolic perturbation of their weights: the same
/// tetrahedra for every order of `vertices`. Expected O(n log n).
///
/// # Errors
/// If the vertices do not span space.
pub fn delaunay<P: PointStore>(
    points: &P,
    vertices: &[VertexId],
) -> Result<Delaunay, DelaunayError> {
    assert!(points.len() < 1 << 30, "fewer than 2^30 vertices");
    let order = insertion_order(points, vertices);
    // Work on a copy of the points in the order of insertion: neighbours in space are then neighbours in memory.
    let sorted = points.reordered(&order);
    let local: Vec<VertexId> = (0..order.len()).map(VertexId::new).collect();
    let seed = first_tetrahedron(&sorted, &local)?;
    let mut result = Delaunay::from_tetrahedron(seed);
    // About 6.7 tetrahedra per vertex for uniform points, and what an insertion holds at the same time.
    result.mesh.reserve(7 * order.len() + 64);
    for &v in local.iter().filter(|v| !seed.contains(v)) {
        result.insert(&sorted, v);
    }
    result.mesh.rename_vertices(|v| order[v.index()]);
    Ok(result)
}

/// The first vertices of the order that span space, as a positive tetrahedron.
fn first_tetrahedron<P: PointStore>(
    points: &P,
    order: &[VertexId],
) -> Result<[VertexId; 4], DelaunayError> {
    let n = order.len();
    let &[a, b, ..] = order else {
        return Err(DelaunayError::TooFew(n));
    };
    let mut rest = order[2..].iter().copied();
    let c = rest
        .by_ref()
        .find(|&c| !points.collinear([a, b, c]))
        .ok_or(if n < 4 {
            DelaunayError::TooFew(n)
        } else {
            DelaunayError::Collinear(n)
        })?;
    let d = rest
        .find(|&d| !points.orient3d([a, b, c, d]).is_zero())
        .ok_or(if n < 4 {
            DelaunayError::TooFew(n)
        } else {
            DelaunayError::Coplanar(n)
        })?;
    Ok(if points.orient3d([a, b, c, d]).is_positive() {
        [a, b, c, d]
    } else {
        [b, a, c, d]
    })
}
