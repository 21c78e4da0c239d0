//! From a vertex set to its Delaunay tetrahedralization.

use super::Delaunay;
use super::order::Rounds;
use super::parallel::Plan;
use crate::mesh::VertexId;
use crate::predicate::PointStore;

/// Why some vertices have no Delaunay tetrahedralization.
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
    /// More than ids can name.
    #[error("{0} vertices; at most 2^30 - 1 can be tetrahedralized")]
    TooMany(usize),
    /// A coordinate is infinite or not a number.
    #[error("vertex {0} has a coordinate that is infinite or not a number")]
    NotFinite(VertexId),
    /// A vertex is none of the points.
    #[error("there is no vertex {0}")]
    Unknown(VertexId),
    /// A vertex is given twice.
    #[error("vertex {0} is given more than once")]
    Repeated(VertexId),
    /// Two vertices are at one place.
    #[error("vertices {} and {} are at the same place", .0[0], .0[1])]
    Coincident([VertexId; 2]),
}

/// A thread is only worth starting for so many vertices.
const FOR_ONE: usize = 25_000;

/// The Delaunay tetrahedralization of distinct vertices, under the symbolic perturbation of their weights: the same
/// tetrahedra for every order of `vertices`. Expected O(n log n).
///
/// Many vertices are inserted by all threads of the current [`rayon`] pool: the tetrahedra are the same, but their ids
/// depend on the number of threads.
///
/// # Errors
/// If the vertices do not span space, are not distinct, or are not all in the store.
pub fn delaunay<P: PointStore>(
    points: &P,
    vertices: &[VertexId],
) -> Result<Delaunay, DelaunayError> {
    // The pool is not even started for a few vertices.
    let pieces = match vertices.len() / FOR_ONE {
        0 | 1 => 1,
        useful => useful.min(rayon::current_num_threads()),
    };
    delaunay_by(points, vertices, u16::try_from(pieces).unwrap_or(u16::MAX))
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
    check_ids(points.len(), vertices)?;
    let rounds = Rounds::new(points, vertices);
    let order = rounds.order();
    let plan = (pieces > 1).then(|| Plan::new(&rounds, pieces));
    drop(rounds);
    // Work on a copy of the points in the order of insertion: neighbours in space are then neighbours in memory.
    let sorted = points.reordered(&order);
    let local: Vec<VertexId> = (0..order.len()).map(VertexId::new).collect();
    let coincident = |pair: [VertexId; 2]| {
        let mut pair = pair.map(|v| order[v.index()]);
        pair.sort_unstable();
        DelaunayError::Coincident(pair)
    };
    if let &[a, b, ..] = &local[..]
        && sorted.coincide(a, b)
    {
        return Err(coincident([a, b]));
    }
    let seed = first_tetrahedron(&sorted, &local)?;
    let mut result = Delaunay::from_tetrahedron(seed);
    let first = plan.as_ref().map_or(local.len(), Plan::prefix);
    // About 6.7 tetrahedra per vertex for uniform points, and what an insertion holds at the same time.
    result.mesh.reserve(7 * first + 64);
    for &v in local[..first].iter().filter(|v| !seed.contains(v)) {
        result.insert_new(&sorted, v).map_err(coincident)?;
    }
    if let Some(plan) = plan {
        result = plan
            .insert_rest(result, &sorted, seed)
            .map_err(coincident)?;
    }
    result.mesh.rename_vertices(|v| order[v.index()]);
    Ok(result)
}

/// Each vertex is one of `n` points, and none is given twice. Linear time, or O(k log k) for few vertices of many
/// points.
fn check_ids(n: usize, vertices: &[VertexId]) -> Result<(), DelaunayError> {
    // Two bits of an id are free for marks.
    if n >= 1 << 30 {
        return Err(DelaunayError::TooMany(n));
    }
    let known = |&v: &VertexId| v.index() < n;
    if let Some(&v) = vertices.iter().find(|v| !known(v)) {
        return Err(DelaunayError::Unknown(v));
    }
    let repeated = match vertices.len() < n / 64 {
        true => {
            let mut sorted = vertices.to_vec();
            sorted.sort_unstable();
            sorted.windows(2).find(|w| w[0] == w[1]).map(|w| w[0])
        }
        false => {
            let mut seen = vec![false; n];
            let mut is_seen = |v: VertexId| std::mem::replace(&mut seen[v.index()], true);
            vertices.iter().copied().find(|&v| is_seen(v))
        }
    };
    repeated.map_or(Ok(()), |v| Err(DelaunayError::Repeated(v)))
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
