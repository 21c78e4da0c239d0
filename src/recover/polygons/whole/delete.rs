//! The deletion of a polygon that is flat only to rounding, by flips of faces that are not locally Delaunay.

use super::PolygonInsertion;
use super::changed::Changed;
use crate::mesh::{Corner, TetId};
use crate::predicate::PointStore;
use crate::recover::method::{FlipOrder, Insertion};
use crate::recover::polygons::RepairCounts;
use crate::recover::subpolygons::{Face, face};
use crate::recover::workspace::{ConstrainedMesh, EdgeProtectedPlc};

/// Makes the triangles of one polygon faces like others: those at `corners`. Where they are not locally Delaunay, flips
/// repair it. Returns the flips, and how many tetrahedra are gone and new; `None` if some face cannot be repaired, and
/// then nothing is changed.
pub(crate) fn delete_whole<P: PointStore>(
    plc: &EdgeProtectedPlc<P>,
    cdt: &mut ConstrainedMesh,
    corners: &[Corner],
) -> Option<(RepairCounts, [u64; 2])> {
    let faces: Vec<Face> = corners.iter().map(|&c| face(cdt.mesh.facet(c))).collect();
    let tets: Vec<TetId> = corners.iter().map(|c| c.tet()).collect();
    let of_faces = faces.iter().map(|t| cdt.subpolygons.remove(t));
    let numbers: Vec<Option<u32>> = of_faces.collect();
    let exact = Insertion::Flip(FlipOrder::FILTERED);
    let mut polygons = PolygonInsertion::new(plc, cdt, exact);
    let mut changed = Changed::default();
    polygons.repair(tets.iter().copied(), &mut changed);
    let untouched = faces
        .iter()
        .all(|&t| polygons.is_gone_or_locally_delaunay(t));
    if untouched && polygons.not_locally_delaunay(&changed).is_empty() {
        return Some((polygons.counts.repairs, changed.counts()));
    }
    changed.undo(cdt);
    for (t, number) in faces.into_iter().zip(numbers) {
        cdt.subpolygons.extend(number.map(|f| (t, f)));
    }
    None
}
