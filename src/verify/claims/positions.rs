//! Vertices that are exactly at a + t(b−a), between two others, and have the nearest doubles as coordinates.
//!
//! A mesh may say so of Steiner points on segments ([`ExportedMesh::exact`]). All other checks then use those
//! positions. What is checked here is that they are what the coordinates say, up to rounding, so that a mesh cannot
//! claim to be elsewhere.

use crate::exchange::{ExactPosition, ExportedMesh};
use crate::mesh::VertexId;
use crate::number::{Dyadic, Exact, Number, Parameter, Vec3};
use crate::verify::place::Place;
use crate::verify::signs::distance::ulp;
use crate::verify::verdict::Findings;
use crate::verify::violation::Violation;
use rustc_hash::FxHashMap;

/// How far the coordinates of a vertex may be from its exact ones, in units in the last place of the largest
/// coordinate: half a unit for rounding to nearest, one for having been moved to a neighbour so that tetrahedra stay
/// positive.
const ROUNDING: f64 = 1.5;

/// The positions, if they are right.
pub(crate) fn check(
    mesh: &ExportedMesh,
    findings: &mut Findings,
) -> FxHashMap<VertexId, Vec3<Dyadic>> {
    let mut exact = FxHashMap::default();
    let largest = mesh.vertices.iter().flatten();
    let largest = largest.fold(0.0f64, |m, x| m.max(x.abs()));
    let bound = Dyadic::from_f64(ROUNDING * ulp(largest));
    for &ExactPosition { vertex, .. } in &mesh.exact {
        exact.insert(vertex, Vec3::from_f64([0.0; 3]));
    }
    if exact.len() < mesh.exact.len() {
        let mut seen = FxHashMap::default();
        for position in &mesh.exact {
            if seen.insert(position.vertex, ()).is_some() {
                report(mesh, position, "is not its only position", findings);
            }
        }
    }
    for position in &mesh.exact {
        let &ExactPosition { vertex, ends, t } = position;
        if ends.iter().any(|v| exact.contains_key(v)) {
            report(mesh, position, "are no doubles themselves", findings);
            continue;
        }
        let (zero, one) = (Parameter::from(0.0), Parameter::from(1.0));
        if !(t.number::<Dyadic>() > zero.number() && t.number::<Dyadic>() < one.number()) {
            report(mesh, position, "is not between them", findings);
            continue;
        }
        let at = |v: VertexId| Vec3::<Dyadic>::from_f64(mesh.vertices[v.index()]);
        let (a, b, t) = (at(ends[0]), at(ends[1]), t.number::<Dyadic>());
        let along = b.sub(&a);
        let p = Vec3([0, 1, 2].map(|i| along.0[i].clone() * &t + &a.0[i]));
        let off = p.sub(&at(vertex));
        let near = |x: &Dyadic| {
            let square = x.clone() * x - &(bound.clone() * &bound);
            !square.exact_sign().is_positive()
        };
        if off.0.iter().all(near) {
            findings.counts.exact_vertices += 1;
            exact.insert(vertex, p);
        } else {
            report(mesh, position, "is not where its coordinates are", findings);
        }
    }
    exact
}

fn report(
    mesh: &ExportedMesh,
    position: &ExactPosition,
    reason: &'static str,
    findings: &mut Findings,
) {
    let place = |id: VertexId| Place {
        id,
        at: mesh.vertices[id.index()],
    };
    findings.report(Violation::WrongPosition {
        vertex: place(position.vertex),
        ends: position.ends.map(place),
        t: position.t.value,
        reason,
    });
}
