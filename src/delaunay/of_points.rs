//! The Delaunay tetrahedralization of points as they come: with coordinates of any kind, and several at one place.

use super::{DelaunayError, delaunay};
use crate::mesh::{TetMesh, VertexId};
use crate::predicate::DoublePoints;
use rustc_hash::FxHashMap;

/// The Delaunay tetrahedralization of some points.
#[derive(Clone, Debug)]
pub struct PointsDelaunay {
    /// The tetrahedra, ghosts included. A vertex is the index of its point.
    pub mesh: TetMesh,
    /// For each point the first one at the same place, which stands for all of them in the mesh.
    pub representative: Vec<VertexId>,
}

impl PointsDelaunay {
    /// How many points are not in the mesh, because an earlier one is at the same place.
    pub fn duplicates(&self) -> usize {
        let all = self.representative.iter().zip(0..);
        all.filter(|&(&VertexId(first), i)| first != i).count()
    }
}

/// The Delaunay tetrahedralization of any points, under the symbolic perturbation of their weights. Points with equal
/// coordinates are one vertex (0 and −0 are equal). Expected O(n log n); several threads share many points.
///
/// # Errors
/// [`DelaunayError::NotFinite`] names the first point with a coordinate that is infinite or not a number. If fewer than
/// four points are distinct, or all lie on one line or plane, there is no tetrahedralization.
pub fn delaunay_of_points(points: &[[f64; 3]]) -> Result<PointsDelaunay, DelaunayError> {
    if points.len() >= 1 << 30 {
        return Err(DelaunayError::TooMany(points.len()));
    }
    let finite = |p: &[f64; 3]| p.iter().all(|x| x.is_finite());
    if let Some(index) = points.iter().position(|p| !finite(p)) {
        return Err(DelaunayError::NotFinite(VertexId::new(index)));
    }
    let mut first: FxHashMap<[u64; 3], VertexId> = FxHashMap::default();
    let mut representative = Vec::with_capacity(points.len());
    let mut distinct = Vec::new();
    for (v, p) in points.iter().enumerate() {
        let v = VertexId::new(v);
        // −0 + 0 is 0.
        let found = *first.entry(p.map(|x| (x + 0.0).to_bits())).or_insert(v);
        representative.push(found);
        if found == v {
            distinct.push(v);
        }
    }
    drop(first);
    let mesh = delaunay(&DoublePoints::new(points.to_vec()), &distinct)?.mesh;
    Ok(PointsDelaunay {
        mesh,
        representative,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Points of a small lattice, some with a coordinate that is no number.
    fn points() -> impl Strategy<Value = Vec<[f64; 3]>> {
        let lattice = (-2i32..2).prop_map(f64::from);
        let coordinate = prop_oneof![
            200 => lattice,
            5 => Just(-0.0),
            1 => prop::sample::select(vec![f64::NAN, f64::INFINITY, f64::NEG_INFINITY]),
        ];
        let point = [coordinate.clone(), coordinate.clone(), coordinate];
        prop::collection::vec(point, 0..40)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(500))]

        /// Every list of points has a tetrahedralization of its distinct points or a reason why not.
        #[test]
        fn any_points_are_answered(points in points()) {
            let is_bad = |p: &[f64; 3]| p.iter().any(|x| !x.is_finite());
            let bad = points.iter().position(is_bad).map(VertexId::new);
            let distinct = |points: &[[f64; 3]]| {
                let mut all: Vec<[i64; 3]> = points.iter().map(|p| p.map(|x| x as i64)).collect();
                all.sort_unstable();
                all.dedup();
                all.len()
            };
            match delaunay_of_points(&points) {
                Err(DelaunayError::NotFinite(v)) => prop_assert_eq!(Some(v), bad),
                Err(DelaunayError::TooFew(n)) => {
                    prop_assert_eq!(n, distinct(&points));
                    prop_assert!(n < 4 && bad.is_none());
                }
                Err(DelaunayError::Collinear(n) | DelaunayError::Coplanar(n)) => {
                    prop_assert_eq!(n, distinct(&points));
                    prop_assert!(n >= 4 && bad.is_none());
                }
                Err(other) => prop_assert!(false, "{other}"),
                Ok(result) => {
                    prop_assert_eq!(bad, None);
                    prop_assert_eq!(result.mesh.check(), Ok(()));
                    let n = distinct(&points);
                    prop_assert_eq!(result.duplicates(), points.len() - n);
                    let finite = result.mesh.finite().flat_map(|t| result.mesh.vertices(t));
                    let mut seen: Vec<VertexId> = finite.collect();
                    seen.sort_unstable();
                    seen.dedup();
                    prop_assert_eq!(seen.len(), n);
                    for (i, v) in result.representative.iter().enumerate() {
                        prop_assert_eq!(points[i], points[v.index()]);
                        prop_assert!(seen.contains(v));
                    }
                }
            }
        }

        /// The inner one refuses ids that are repeated or unknown, and vertices at one place.
        #[test]
        fn ids_are_checked(
            places in prop::collection::vec([0i32..3, 0..3, 0..3], 4..30),
            ids in prop::collection::vec(0u32..32, 4..40),
        ) {
            let n = places.len();
            let points = DoublePoints::new(places.iter().map(|p| p.map(f64::from)).collect());
            let ids: Vec<VertexId> = ids.into_iter().map(VertexId).collect();
            let unknown = ids.iter().any(|v| v.index() >= n);
            let mut unique = ids.clone();
            unique.sort_unstable();
            unique.dedup();
            let mut at: Vec<_> = unique.iter().filter_map(|v| places.get(v.index())).collect();
            at.sort_unstable();
            at.dedup();
            let is_wrong = unknown || unique.len() < ids.len() || at.len() < ids.len();
            match delaunay(&points, &ids) {
                Ok(result) => {
                    prop_assert!(!is_wrong);
                    prop_assert_eq!(result.mesh.check(), Ok(()));
                }
                Err(DelaunayError::Unknown(v)) => prop_assert!(v.index() >= n),
                Err(DelaunayError::Repeated(v)) => {
                    prop_assert!(ids.iter().filter(|&&w| w == v).count() > 1);
                }
                Err(DelaunayError::Coincident([v, w])) => {
                    prop_assert!(v != w && places[v.index()] == places[w.index()]);
                }
                Err(_) => prop_assert!(!unknown && unique.len() == ids.len()),
            }
        }
    }
}
