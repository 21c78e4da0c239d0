//! Which vertices obstruct an edge: a few of them because of which no sphere through a and b is empty.
//!
//! The centres of the spheres through a and b form a plane, and each vertex p allows a half-plane of it: |p − c| ≥ |a −
//! c| is linear in c. Whether these have a point in common is a linear program in two variables; if not, three of them
//! have none (Helly), and then the edge is missing in the Delaunay tetrahedralization of a, b and those three vertices
//! already. The program is solved in floats, incrementally (Seidel 1991), with the point nearest to the middle of ab as
//! the optimum; what it finds is proved by exact predicates on the five vertices. So an obstruction is certain, its
//! absence is not.
//!
//! Linear time if few constraints are violated in turn, quadratic at worst.

use crate::mesh::VertexId;
use crate::number::Sign;
use crate::number::vector::{cross, dot, minus};
use crate::predicate::PointStore;

/// Whether three of the vertices certainly obstruct the edge ab. If not, it may be obstructed or not.
pub(super) fn is_obstructed<P: PointStore>(
    points: &P,
    [a, b]: [VertexId; 2],
    others: &[VertexId],
) -> bool {
    let places = others.iter().map(|&v| points.rounded(v));
    let planes = half_planes([a, b].map(|v| points.rounded(v)), places);
    no_common_point(&planes).is_some_and(|w| proves(points, [a, b], w.map(|i| others[i])))
}

/// Whether the edge ab is missing in the Delaunay tetrahedralization of a, b and three vertices: it passes through
/// their triangle, and b is outside the sphere through them and a. No if in doubt.
fn proves<P: PointStore>(points: &P, [a, b]: [VertexId; 2], [p, q, r]: [VertexId; 3]) -> bool {
    let below = points.orient3d([a, p, q, r]);
    if below.is_zero() || points.orient3d([b, p, q, r]) != -below {
        return false;
    }
    let turn = points.orient3d([a, b, p, q]);
    !turn.is_zero()
        && points.orient3d([a, b, q, r]) == turn
        && points.orient3d([a, b, r, p]) == turn
        && points.insphere([a, p, q, r, b]) * below == Sign::Negative
}

/// The points x with normal·x ≤ offset.
type HalfPlane = ([f64; 2], f64);

/// The half-planes in which the vertices allow centres, relative to the middle of ab.
fn half_planes([a, b]: [[f64; 3]; 2], others: impl Iterator<Item = [f64; 3]>) -> Vec<HalfPlane> {
    let along = minus(b, a);
    let [u, v] = across(along);
    let half_plane = |p: [f64; 3]| {
        let (pa, pb) = (minus(p, a), minus(p, b));
        ([2.0 * dot(pa, u), 2.0 * dot(pa, v)], dot(pa, pb))
    };
    others.map(half_plane).collect()
}

/// Two orthogonal unit vectors orthogonal to a third one.
fn across(d: [f64; 3]) -> [[f64; 3]; 2] {
    let smallest = (0..3).min_by(|&i, &j| d[i].abs().total_cmp(&d[j].abs()));
    let mut axis = [0.0; 3];
    axis[smallest.expect("there are three")] = 1.0;
    let u = unit(cross(d, axis));
    [u, unit(cross(d, u))]
}

fn unit(u: [f64; 3]) -> [f64; 3] {
    let length = dot(u, u).sqrt();
    u.map(|x| x / length)
}

/// Three of the half-planes without a common point (one may be named twice), if there is no point in all.
fn no_common_point(planes: &[HalfPlane]) -> Option<[usize; 3]> {
    let mut x = [0.0; 2];
    for (i, &(normal, offset)) in planes.iter().enumerate() {
        if normal[0] * x[0] + normal[1] * x[1] <= offset {
            continue;
        }
        // The optimum is on the border of this half-plane now.
        let square = normal[0] * normal[0] + normal[1] * normal[1];
        let foot = normal.map(|n| n * offset / square);
        let direction = [-normal[1], normal[0]];
        let mut low = (f64::NEG_INFINITY, i);
        let mut high = (f64::INFINITY, i);
        for (j, &(other, bound)) in planes[..i].iter().enumerate() {
            let slope = other[0] * direction[0] + other[1] * direction[1];
            let rest = bound - (other[0] * foot[0] + other[1] * foot[1]);
            let at = rest / slope;
            if slope > 0.0 {
                if at < high.0 {
                    high = (at, j);
                }
            } else if slope < 0.0 {
                if at > low.0 {
                    low = (at, j);
                }
            } else if rest < 0.0 {
                return Some([i, j, j]);
            }
            if low.0 > high.0 {
                return Some([i, low.1, high.1]);
            }
        }
        let along = 0f64.max(low.0).min(high.0);
        x = [0, 1].map(|k| foot[k] + along * direction[k]);
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::delaunay::delaunay;
    use crate::predicate::DoublePoints;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(500))]

        /// Obstructed edges are no Delaunay edges; and of those that are none, most are found out.
        #[test]
        fn obstructed_edges_are_missing(
            places in prop::collection::btree_set([0i32..5, 0..5, 0..5], 8..20),
            jitter in 0u32..2,
        ) {
            let moved = |x: i32, i: usize| f64::from(x) + f64::from(jitter) * 1e-3 * ((i * 7919 % 13) as f64);
            let vertices: Vec<[f64; 3]> = places
                .into_iter()
                .enumerate()
                .map(|(i, p)| [moved(p[0], i), moved(p[1], i + 3), moved(p[2], 2 * i + 1)])
                .collect();
            let points = DoublePoints::new(vertices);
            let all: Vec<VertexId> = (0..points.len()).map(VertexId::new).collect();
            let Ok(whole) = delaunay(&points, &all) else { return Ok(()) };
            let (mut missing, mut found) = (0, 0);
            for a in &all {
                for b in all.iter().filter(|b| a < b) {
                    let others: Vec<VertexId> = all.iter().copied().filter(|v| v != a && v != b).collect();
                    let is_edge = whole.mesh.finite().any(|t| whole.mesh.has_vertices(t, &[*a, *b]));
                    let obstructed = is_obstructed(&points, [*a, *b], &others);
                    prop_assert!(!(is_edge && obstructed));
                    missing += usize::from(!is_edge);
                    found += usize::from(obstructed);
                }
            }
            // Where no five points are cospherical, floats that are less exact than the predicates miss next to
            // nothing.
            if jitter == 1 && missing >= 20 {
                prop_assert!(4 * found >= 3 * missing, "{} of {}", found, missing);
            }
        }
    }
}
