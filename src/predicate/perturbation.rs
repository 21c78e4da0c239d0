//! Symbolic perturbation of the vertex weights (Edelsbrunner & Mücke 1990; Shewchuk 2003; paper §3.3).
//!
//! Every vertex v has the weight ε_v, an infinitesimal, ε_0 ≫ ε_1 ≫ … in order of identity. Positions are never
//! perturbed. insphere is affine in the weights, with the circuit's coefficients c_v as derivatives
//! ([`super::formula`]), so where it is zero its sign is that of the first non-zero c_v.
//!
//! Consequences: there is one Delaunay tetrahedralization of a vertex set and at most one CDT of a PLC, whatever the
//! order of insertion and whatever the algorithm.

use super::PointStore;
use crate::mesh::VertexId;
use crate::number::Sign;

/// The sign of insphere(a,b,c,d,e) for five cospherical points under the perturbation; zero only if all five are
/// coplanar.
#[cold]
pub(super) fn perturbed_sign<P: PointStore + ?Sized>(points: &P, v: [VertexId; 5]) -> Sign {
    let mut order = [0, 1, 2, 3, 4];
    order.sort_unstable_by_key(|&i: &usize| points.identity(v[i]));
    order
        .into_iter()
        .map(|i| circuit_sign(points, v, i))
        .find(|sign| !sign.is_zero())
        .unwrap_or(Sign::Zero)
}

/// The sign of the circuit's coefficient c_i: ± the orientation of the other four points.
pub(crate) fn circuit_sign<P: PointStore + ?Sized>(
    points: &P,
    [a, b, c, d, e]: [VertexId; 5],
    i: usize,
) -> Sign {
    match i {
        0 => -points.orient3d([e, b, c, d]),
        1 => points.orient3d([e, a, c, d]),
        2 => -points.orient3d([e, a, b, d]),
        3 => points.orient3d([e, a, b, c]),
        _ => points.orient3d([a, b, c, d]),
    }
}
