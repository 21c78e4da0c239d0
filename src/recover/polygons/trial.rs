//! Which polygons that are flat only to rounding can be inserted whole: a trial, on a copy of the mesh.
//!
//! Where the domain is on one side of a polygon only, it is enough if it fits there. That is known when all polygons
//! are in the mesh: then what is beside it is outside, or is not.

use super::{FlipOrder, Insertion, PolygonInsertion};
use crate::error::{Failure, GaveUp, NotFlatReason};
use crate::mesh::{Corner, Incidence, SimplexIndex, TetId, TetMesh, VertexId};
use crate::predicate::PointStore;
use crate::recover::domain::Components;
use crate::recover::flatten::{Fit, Refusal, Tried};
use crate::recover::subpolygons::face;
use crate::recover::workspace::{ConstrainedMesh, EdgeProtectedPlc};

/// Pieces that cannot be inserted whole, and why.
type Refused = Vec<(usize, Refusal)>;

/// How all pieces fit into a tetrahedralization, or which of those that are flat only to rounding cannot be inserted.
/// If a flat one is refused after them, all of them are to blame. `has_outside` says whether the mesh outside of what
/// polygons enclose does not count.
///
/// The pieces are inserted up to three times. No one but the caller's copy of the mesh is changed.
pub(crate) fn try_whole<P: PointStore>(
    mut plc: EdgeProtectedPlc<P>,
    mesh: &TetMesh,
    incidence: &Incidence,
    has_outside: bool,
) -> Tried {
    let n = plc.pieces.complex.polygons.len();
    plc.pieces.fits = vec![Fit::Both; n];
    let copy = || ConstrainedMesh::new(mesh.clone(), incidence.clone(), n);
    let bad = insert_all(&plc, &mut copy(), has_outside)?;
    for (f, found) in bad {
        plc.pieces.fits[f] = found;
    }
    if plc.pieces.fits.iter().all(|&fit| fit == Fit::Both) {
        return Ok(plc.pieces.fits);
    }
    // Now that it is known on which side.
    let bad = insert_all(&plc, &mut copy(), false)?;
    let refused = bad
        .into_iter()
        .filter(|&(f, fit)| plc.pieces.fits[f] != fit);
    let refused: Vec<(usize, Refusal)> = refused.map(|(f, _)| (f, Refusal::Incompatible)).collect();
    if refused.is_empty() {
        Ok(plc.pieces.fits)
    } else {
        Err(refused)
    }
}

/// Inserts all pieces, those first that are not flat. Returns those that do not fit on both sides, and where they are
/// inside.
fn insert_all<P: PointStore>(
    plc: &EdgeProtectedPlc<P>,
    cdt: &mut ConstrainedMesh,
    may_fit_on_one_side: bool,
) -> Result<Vec<(usize, Fit)>, Refused> {
    let exact = Insertion::Flip(FlipOrder::FILTERED);
    let mut polygons = PolygonInsertion::new(plc, cdt, exact);
    polygons.may_fit_on_one_side = may_fit_on_one_side;
    let all = &plc.pieces.complex.polygons;
    let (flat, not_flat): (Vec<usize>, Vec<usize>) = (0..all.len()).partition(|&f| all[f].flat);
    let mut refused = Refused::new();
    for &f in &not_flat {
        if let Err(failure) = polygons.insert(f) {
            refused.push((f, refusal(&failure)));
        }
    }
    if !refused.is_empty() {
        return Err(refused);
    }
    if !flat.iter().all(|&f| polygons.insert(f).is_ok()) {
        return Err(not_flat.into_iter().map(|f| (f, Refusal::Blamed)).collect());
    }
    if polygons.tolerated.is_empty() {
        return Ok(Vec::new());
    }
    let mut tolerated: Vec<u32> = polygons.tolerated.values().copied().collect();
    tolerated.sort_unstable();
    tolerated.dedup();
    let walls = SimplexIndex::of_triangles(plc.points.len(), cdt.subpolygons.iter());
    let components = Components::new(&cdt.mesh, &walls);
    let inside = Inside {
        plc,
        cdt,
        components: &components,
    };
    let mut fits = Vec::new();
    for f in tolerated {
        match inside.of(f as usize) {
            Some(fit) => fits.push((f as usize, fit)),
            None => refused.push((f as usize, Refusal::Incompatible)),
        }
    }
    if refused.is_empty() {
        Ok(fits)
    } else {
        Err(refused)
    }
}

/// Why a polygon that is not flat was refused.
fn refusal(failure: &Failure) -> Refusal {
    match failure {
        Failure::GaveUp(GaveUp::NotFlat { reason, .. }) => match reason {
            NotFlatReason::AmbiguousSide => Refusal::Ambiguous,
            NotFlatReason::Incompatible => Refusal::Incompatible,
            NotFlatReason::CrossedBySegment { .. } | NotFlatReason::CrossedByPolygon { .. } => {
                Refusal::Crossed
            }
        },
        _ => Refusal::Crossed,
    }
}

/// Where the domain is.
struct Inside<'a, P> {
    plc: &'a EdgeProtectedPlc<P>,
    cdt: &'a ConstrainedMesh,
    components: &'a Components,
}

impl<P: PointStore> Inside<'_, P> {
    /// On which side of polygon f the inside is; `None` if it is on both.
    fn of(&self, f: usize) -> Option<Fit> {
        let boundary = self
            .plc
            .subsegments
            .boundary(&self.plc.pieces.complex.polygons[f]);
        let is_outer = |&[a, b]: &[VertexId; 2]| !boundary.contains(&[b, a]);
        let [a, b] = boundary.iter().copied().find(is_outer)?;
        let mesh = &self.cdt.mesh;
        let start = self.cdt.incidence.tet_at_edge(mesh, a, b)?;
        // In positive sense, around ab, f comes after what is right of it.
        let mut facets = mesh.around(start, a, b).map(|t| mesh.exit_around(t, a, b));
        let of_f = |c: Corner| self.cdt.subpolygons.get(&face(mesh.facet(c)));
        let c = facets.find(|&c| of_f(c) == Some(&(f as u32)))?;
        let is_outside = |t: TetId| self.components.of(t) == Some(Components::OUTSIDE);
        match [c.tet(), mesh.neighbor(c)].map(is_outside) {
            [_, true] => Some(Fit::Right),
            [true, false] => Some(Fit::Left),
            [false, false] => None,
        }
    }
}
