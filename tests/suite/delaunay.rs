//! The Delaunay tetrahedralization is canonical, complete and Delaunay, on the families that break floats.

use crate::common::{all_vertices, sorted_tets};
use proptest::prelude::*;
use tetflip::delaunay::{DelaunayError, delaunay, delaunay_by};
use tetflip::mesh::{TetMesh, VertexId};
use tetflip::predicate::{DoublePoints, PointStore};

/// No facet fails the perturbed insphere test, all tetrahedra are positive, and the hull is convex.
fn assert_delaunay(points: &DoublePoints, mesh: &TetMesh) {
    assert_eq!(mesh.check(), Ok(()));
    for t in mesh.all() {
        let v = mesh.vertices(t);
        if mesh.is_ghost(t) {
            continue;
        }
        assert!(points.orient3d(v).is_positive());
        for slot in 0..4 {
            let apex = mesh.apex_across(t.corner(slot));
            if !apex.is_infinite() {
                let [a, b, c, d] = v;
                assert!(points.insphere([a, b, c, d, apex]).is_negative());
            }
        }
    }
    // Every hull facet has every vertex on its inner side or on it.
    for t in mesh.all().filter(|&t| mesh.is_ghost(t)) {
        let slot = mesh.slot_of(t, VertexId::INFINITE).expect("a ghost");
        for p in (0..points.len()).map(VertexId::new) {
            let mut moved = mesh.vertices(t);
            moved[slot] = p;
            assert!(!points.orient3d(moved).is_positive());
        }
    }
}

/// Distinct points of nasty families.
fn family() -> impl Strategy<Value = Vec<[f64; 3]>> {
    let lattice = prop::collection::btree_set([0i32..4, 0..4, 0..3], 4..40)
        .prop_map(|s| s.into_iter().map(|p| p.map(f64::from)).collect::<Vec<_>>());
    let jittered =
        prop::collection::btree_map([0i32..3, 0..3, 0..3], [-1i32..2, -1..2, -1..2], 4..27)
            .prop_map(|m| {
                let jitter =
                    |(x, j): (i32, i32)| f64::from(x + 1) * (1.0 + f64::from(j) * f64::EPSILON);
                m.into_iter()
                    .map(|(p, j)| [0, 1, 2].map(|i| jitter((p[i], j[i]))))
                    .collect::<Vec<_>>()
            });
    // Integer points on the sphere of radius 3: (±3,0,0), (±1,±2,±2) and permutations.
    let sphere = prop::collection::btree_set((0usize..3, -1i32..2, [-1i32..2, -1..2]), 4..30)
        .prop_map(|s| {
            let mut points: Vec<[f64; 3]> = Vec::new();
            for (axis, a, [b, c]) in s {
                let mut p = if b == 0 || c == 0 || a == 0 {
                    [3 * a, 0, 0]
                } else {
                    [a, 2 * b, 2 * c]
                };
                p.rotate_right(axis);
                let p = p.map(f64::from);
                if p != [0.0; 3] && !points.contains(&p) {
                    points.push(p);
                }
            }
            points
        });
    let scaled = (lattice.clone(), -990i32..1000).prop_map(|(p, e)| {
        p.into_iter()
            .map(|q| q.map(|x| x * 2f64.powi(e)))
            .collect::<Vec<_>>()
    });
    let uniform = prop::collection::vec([0.0..1.0, 0.0..1.0, 0.0..1.0f64], 4..60);
    prop_oneof![lattice, jittered, sphere, scaled, uniform]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn delaunay_in_every_order(p in family(), swaps in prop::collection::vec((0usize..60, 0usize..60), 60)) {
        let points = DoublePoints::new(p);
        let all = all_vertices(&points);
        let Ok(first) = delaunay(&points, &all) else { return Ok(()) };
        assert_delaunay(&points, &first.mesh);
        prop_assert_eq!(crate::common::used_vertices(&first.mesh), all.clone());
        // The same vertices inserted one by one in another order, from another first tetrahedron.
        let mut order = all;
        let n = order.len();
        for (i, j) in swaps {
            order.swap(i % n, j % n);
        }
        let second = crate::common::delaunay_in_order(&points, &order);
        prop_assert_eq!(sorted_tets(&first.mesh), sorted_tets(&second.mesh));
    }
}

/// Some hundreds of distinct points of a nasty family.
fn many() -> impl Strategy<Value = Vec<[f64; 3]>> {
    let cloud = prop::collection::vec([0.0..1.0, 0.0..1.0, 0.0..1.0f64], 300..900);
    let kind = 0..7;
    (cloud, kind).prop_map(|(cloud, kind)| {
        let nasty = |(i, p): (usize, [f64; 3])| match kind {
            0 => p,
            // A lattice, part of which is missing.
            1 => p.map(|x| (9.0 * x).floor()),
            // On a sphere, up to rounding.
            2 => {
                let r = p.iter().map(|x| (x - 0.5) * (x - 0.5)).sum::<f64>().sqrt();
                p.map(|x| (x - 0.5) / r)
            }
            // On a plane, but a few.
            3 => [
                p[0],
                (5.0 * p[1]).floor(),
                if i % 50 == 0 { p[2] } else { 0.0 },
            ],
            // On a line, and a few elsewhere.
            4 if i % 9 > 0 => [i as f64, i as f64, 0.0],
            // One point far from the others: they are in one cell of the grid.
            6 => p.map(|x| 1e-9 * x + if i == 0 { 1.0 } else { 0.0 }),
            // Two clusters far from each other.
            5 => p.map(|x| 1e-6 * x + (i % 2) as f64),
            _ => p,
        };
        let points: std::collections::BTreeSet<[u64; 3]> = cloud
            .into_iter()
            .enumerate()
            .map(|i| nasty(i).map(|x| (x + 0.0).to_bits()))
            .collect();
        points.into_iter().map(|p| p.map(f64::from_bits)).collect()
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn any_number_of_threads_inserts_the_same(p in many(), pieces in 2u16..9) {
        let points = DoublePoints::new(p);
        let all = all_vertices(&points);
        let Ok(alone) = delaunay_by(&points, &all, 1) else { return Ok(()) };
        let together = delaunay_by(&points, &all, pieces).expect("they span space");
        prop_assert_eq!(together.mesh.check(), Ok(()));
        prop_assert_eq!(sorted_tets(&alone.mesh), sorted_tets(&together.mesh));
    }
}

/// So many points that threads do not get into each other's way everywhere.
#[test]
fn threads_share_most_of_the_work() {
    let n = 60_000u64;
    let unit = |x: u64| (x.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 20) as f64 / (1u64 << 44) as f64;
    let points = (0..n).map(|i| [unit(3 * i + 1), unit(7 * i + 2), unit(11 * i + 5)]);
    let points = DoublePoints::new(points.collect());
    let all = all_vertices(&points);
    let alone = delaunay_by(&points, &all, 1).expect("they span space");
    for pieces in [2, 5] {
        let together = delaunay_by(&points, &all, pieces).expect("they span space");
        assert_eq!(together.mesh.check(), Ok(()));
        assert_eq!(sorted_tets(&alone.mesh), sorted_tets(&together.mesh));
    }
}

#[test]
fn flat_sets_are_typed_errors() {
    let flat = |p: Vec<[f64; 3]>| {
        let points = DoublePoints::new(p);
        delaunay(&points, &all_vertices(&points))
            .map(|_| ())
            .unwrap_err()
    };
    let line = (0..9)
        .map(|i| [f64::from(i) * 0.1, f64::from(i) * 0.1, 1.0])
        .collect();
    assert_eq!(flat(line), DelaunayError::Collinear(9));
    let plane = (0..9)
        .map(|i| [f64::from(i), f64::from(i * i), 1.0])
        .collect();
    assert_eq!(flat(plane), DelaunayError::Coplanar(9));
    assert_eq!(flat(vec![[0.0; 3], [1.0; 3]]), DelaunayError::TooFew(2));
    assert_eq!(flat(vec![]), DelaunayError::TooFew(0));
}
