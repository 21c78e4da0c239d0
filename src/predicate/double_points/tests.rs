//! Double points against the formulas over dyadic numbers.

use super::*;
use crate::predicate::GrowingStore;
use proptest::prelude::*;

/// Coordinates from families that defeat floats: small lattices, jittered lattices, mixed and extreme exponents.
fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![
        (-3i32..4).prop_map(f64::from),
        (-3i32..4).prop_map(|x| f64::from(x) * 0.1),
        ((-3i32..4), (-3i32..4))
            .prop_map(|(x, k)| f64::from(x) * (1.0 + f64::from(k) * f64::EPSILON)),
        (-2i32..3, -300i32..300).prop_map(|(x, e)| f64::from(x) * 10f64.powi(e)),
        (-3i32..4).prop_map(|x| f64::from(x) * 5e-324),
        (-2i32..3).prop_map(|x| f64::from(x) * 8.9e307),
    ]
}

fn family() -> impl Strategy<Value = Vec<[f64; 3]>> {
    let free = prop::collection::vec([coordinate(), coordinate(), coordinate()], 5);
    let lattice = prop::collection::vec([-2i32..3, -2..3, -2..3], 5);
    let lattice = (lattice, -1070i32..1000).prop_map(|(p, e)| {
        let scale = 2f64.powi(e);
        p.into_iter()
            .map(|q| q.map(|x| f64::from(x) * scale))
            .collect()
    });
    prop_oneof![free, lattice]
}

/// What is known of the coordinates, and with it the speed, comes back with the points.
#[test]
fn truncation_restores_the_range() {
    let mut store = DoublePoints::new(vec![[1.0, 2.0, 4.0]; 3]);
    for p in [[0.5, 0.0, 1.0], [8.0, 0.0, 1.0], [0.1, 0.2, 1e9]] {
        store.push(p);
    }
    store.truncate(5);
    assert_eq!((store.range.grid, store.range.largest), (-1, 8.0));
    store.truncate(3);
    assert_eq!((store.range.grid, store.range.largest), (0, 4.0));
    assert_eq!(store.push([0.25, 0.0, 0.0]), VertexId(3));
    assert_eq!(store.grid(), Some(-2));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    /// The staged predicates agree with the formula over dyadics for every finite double.
    #[test]
    fn stages_agree_with_dyadics(p in family()) {
        let store = DoublePoints::new(p);
        let v: [VertexId; 5] = std::array::from_fn(VertexId::new);
        let [a, b, c, d, _] = v;
        let exact = v.map(|v| store.at::<Dyadic>(v));
        let [ea, eb, ec, ed, _] = exact.each_ref();
        let o = formula::orient3d([ea, eb, ec, ed]).exact_sign();
        prop_assert_eq!(store.orient3d([a, b, c, d]), o);
        prop_assert_eq!(store.orient3d_exact([a, b, c, d]), o);
        let s = formula::insphere(exact.each_ref()).exact_sign();
        prop_assert_eq!(store.insphere_unperturbed(v), s);
        prop_assert_eq!(store.insphere_exact::<false>(v), s);
        let behind = |slot: usize| {
            let mut moved = [a, b, c, d];
            moved[slot] = v[4];
            store.orient3d(moved).is_negative()
        };
        match store.facet_towards([a, b, c, d], v[4]) {
            Some(slot) => prop_assert!(behind(slot)),
            None => prop_assert!(!(0..4).any(behind)),
        }
    }

    /// The same with exact points on segments, also for points of one line or plane.
    #[test]
    fn exact_steiner_points_agree_with_dyadics(
        p in family(),
        q in family(),
        t in prop::collection::vec(1u32..64, 5),
    ) {
        let mut store = DoublePoints::new([p, q].concat()).with_steiner(Steiner::Exact);
        let end = |i: u32| VertexId(i);
        let mut steiner: Vec<VertexId> = (0..5u32)
            .map(|i| store.push_on_segment(end(i), end(5 + i), (f64::from(t[i as usize]) / 64.0).into()))
            .collect();
        steiner.push(store.push_on_segment(end(0), end(5), 0.3.into()));
        steiner.extend((0..10).map(end));
        let exact: Vec<Vec3<Dyadic>> = (0..store.len()).map(|v| store.coordinates(VertexId::new(v))).collect();
        for start in 0..steiner.len() - 4 {
            let v: [VertexId; 5] = std::array::from_fn(|i| steiner[start + i]);
            let [a, b, c, d, e] = v.map(|v| &exact[v.index()]);
            prop_assert_eq!(store.orient3d([v[0], v[1], v[2], v[3]]), formula::orient3d([a, b, c, d]).exact_sign());
            prop_assert_eq!(store.insphere_unperturbed(v), formula::insphere([a, b, c, d, e]).exact_sign());
        }
        for v in [steiner[0], steiner[5]] {
            prop_assert!(store.collinear([end(0), end(5), v]));
            prop_assert!(store.orient3d([end(0), end(5), end(1), v]).is_zero());
        }
        let n = store.count_not_double();
        store.truncate(11);
        prop_assert_eq!(store.count_not_double(), n.min(usize::from(!store.is_double(VertexId(10)))));
    }

    /// Exchanging two of the five points changes the perturbed sign; it is zero only for five coplanar points.
    #[test]
    fn perturbed_insphere_is_alternating(p in family(), i in 0usize..5, step in 1usize..5) {
        let j = (i + step) % 5;
        let store = DoublePoints::new(p);
        let v: [VertexId; 5] = std::array::from_fn(VertexId::new);
        let mut w = v;
        w.swap(i, j);
        let sign = store.insphere(v);
        prop_assert_eq!(sign, -store.insphere(w));
        let coplanar = (0..5).all(|i| crate::predicate::perturbation::circuit_sign(&store, v, i).is_zero());
        prop_assert_eq!(sign.is_zero(), coplanar);
    }
}
