//! The Delaunay property of one facet.

use crate::mesh::{Corner, TetMesh};
use crate::predicate::PointStore;

/// Whether the facet opposite corner `c` of a finite tetrahedron is locally Delaunay: whether it is on the convex hull,
/// or the vertex behind it is not inside the circumsphere.
pub(crate) fn is_locally_delaunay<P: PointStore>(points: &P, mesh: &TetMesh, c: Corner) -> bool {
    let behind = mesh.apex_across(c);
    let [v, x, y, z] = mesh.vertices(c.tet());
    behind.is_infinite() || !points.insphere([v, x, y, z, behind]).is_positive()
}
