//! From a vertex set to its Delaunay tetrahedralization.

use super::Delaunay;
use super::order::Rounds;
use super::parallel::Plan;
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

/// How many vertices a thread is worth the while for.
const FOR_ONE: usize = 25_000;

/// The Delaunay tetrahedralization of distinct vertices, under the symbolic perturbation of their weights: the same
/// tetrahedra for every order of `vertices`. Expected O(n log n).
///
/// Many vertices are inserted by all threads of the current [`rayon`] pool: the tetrahedra are the same, but their ids depend
/// on the number of threads.
///
/// # Errors
/// If the vertices do not span space.
pub fn delaunay<P: PointStore>(
    points: &P,
    vertices: &[VertexId],
) -> Result<Delaunay, DelaunayError> {
    let useful = vertices.len() / FOR_ONE;
    let threads = useful.min(rayon::current_num_threads()).max(1);
    delaunay_by(points, vertices, u16::try_from(threads).unwrap_or(u16::MAX))
}

/// [`delaunay`] in so many pieces, each inserted by a thread; in one, by the thread that calls.
///
/// # Errors
/// The same.
pub fn delaunay_by<P: PointStore>(
    points: &P,
    vertices: &[VertexId],
    pieces: u16,
) -> Result<Delaunay, DelaunayError> {
    assert!(points.len() < 1 << 30, "fewer than 2^30 vertices");
    let rounds = Rounds::new(points, vertices);
    let order = rounds.order();
    let plan = (pieces > 1).then(|| Plan::new(&rounds, pieces));
    drop(rounds);
    // Work on a copy of the points in the order of insertion: neighbours in space are then neighbours in memory.
    let sorted = points.reordered(&order);
    let local: Vec<VertexId> = (0..order.len()).map(VertexId::new).collect();
    let seed = first_tetrahedron(&sorted, &local)?;
    let mut result = Delaunay::from_tetrahedron(seed);
    let first = plan.as_ref().map_or(local.len(), Plan::prefix);
    // About 6.7 tetrahedra per vertex for uniform points, and what an insertion holds at the same time.
    result.mesh.reserve(7 * first + 64);
    for &v in local[..first].iter().filter(|v| !seed.contains(v)) {
        result.insert(&sorted, v);
    }
    if let Some(plan) = plan {
        result = plan.insert_rest(result, &sorted, seed);
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
