//! Small inputs: what random ones should try, each kind of flip, each reason why a polygon stays.

use super::*;

/// What the random tests are meant to try does happen.
#[test]
fn both_outcomes_are_tried() {
    use proptest::strategy::ValueTree;
    let mut runner = proptest::test_runner::TestRunner::deterministic();
    let mut tried = Tried::default();
    let mut blocked_by_triangle = 0;
    for seed in 0..100 {
        let plc = fins().new_tree(&mut runner).expect("a PLC").current();
        undo_rounded(&turned(plc), seed, &mut tried);
        let plc = lattice_with_rectangle().new_tree(&mut runner);
        keep_more(
            &plc.expect("a PLC").current(),
            seed,
            &mut blocked_by_triangle,
        );
    }
    assert!(tried.done > 100 && blocked_by_triangle > 10);
}

/// Two vertices come close to a rectangle that is not flat. It is inserted, deleted and inserted again in flat pieces.
#[test]
fn a_polygon_that_is_not_flat_is_deleted_in_pieces() {
    let points = [
        [-3, -3, -3],
        [3, 3, -3],
        [3, 3, 3],
        [-3, -3, 3],
        [-3, 1, 0],
        [-1, 3, -3],
        [1, 1, -2],
        [2, 2, -1],
        [3, -2, -3],
    ];
    let mut plc = plc_of_points(points.map(|p| p.map(f64::from)).to_vec());
    plc.facets.push(facet(&[0, 1, 2, 3]));
    let plc = turned(plc);
    let mut cdt = Cdt::with_segments(&plc, true, &mut Report::default()).expect("segments");
    let without = tets(&cdt);
    insert(&mut cdt, 0, FLIPS).expect("a valid PLC");
    let with = tets(&cdt);
    assert_ne!(with, without);
    cdt.delete_polygon(0).expect("flat pieces");
    assert!(!cdt.is_inserted(0));
    assert_eq!(tets(&cdt), without);
    insert(&mut cdt, 0, FLIPS).expect("a valid PLC");
    assert_eq!(tets(&cdt), with);
}

/// Seven points and a quadrilateral, inserted by a 4-4, a 2-3 and a 3-2 flip.
fn seven_points() -> Plc {
    let points = [
        [0, -1, 0],
        [0, 0, 1],
        [0, -1, -1],
        [1, -1, 1],
        [0, 1, -1],
        [1, 0, 0],
        [-1, 0, -1],
    ];
    let mut plc = plc_of_points(points.map(|p| p.map(f64::from)).to_vec());
    plc.facets.push(facet(&[1, 6, 2, 3]));
    plc
}

#[test]
fn three_kinds_of_flip_back() {
    let mut cdt = flat(&seven_points()).expect("a flat polygon");
    let without = tets(&cdt);
    let inserted = insert(&mut cdt, 0, FLIPS).expect("a valid PLC").flips;
    let [a, b, c] = [inserted.two_three, inserted.three_two, inserted.four_four];
    assert_eq!([a, b, c], [1, 1, 1]);
    let counts = delete(&mut cdt, 0);
    assert_inverse(&inserted, &counts.flips);
    assert_eq!((counts.removed, counts.created), (6, 6));
    assert_eq!(tets(&cdt), without);
}

/// The edge 5–6 is in the mesh only thanks to the polygon.
#[test]
fn a_segment_holds_a_polygon_in_place() {
    let mut cdt = flat(&seven_points()).expect("a flat polygon");
    insert(&mut cdt, 0, FLIPS).expect("a valid PLC");
    let with = tets(&cdt);
    let segment = [5, 6].map(VertexId);
    assert!(edges(cdt.mesh()).contains(&segment));
    let (deleted, mesh) = delete_around(&cdt, &[segment], &[]);
    assert_eq!(deleted.blocked, Some(Blocked::Edge(segment)));
    assert!(deleted.counts.flips() > 0);
    assert_eq!(tets_of(&mesh), with);
}

/// So does a triangle with that edge.
#[test]
fn a_triangle_holds_a_polygon_in_place() {
    let mut cdt = flat(&seven_points()).expect("a flat polygon");
    insert(&mut cdt, 0, FLIPS).expect("a valid PLC");
    let with = tets(&cdt);
    let segment = [5, 6].map(VertexId);
    let all = triangles(cdt.mesh());
    for t in all
        .into_iter()
        .filter(|t| segment.iter().all(|v| t.contains(v)))
    {
        let (deleted, mesh) = delete_around(&cdt, &[], &[t]);
        assert!(deleted.blocked.is_some());
        assert_eq!(tets_of(&mesh), with);
    }
}

/// Two rooms with a wall between them. Without an outer wall of one room the surface is open; without all of them the
/// other room is what is left.
#[test]
fn a_deleted_polygon_bounds_nothing() {
    let mut plc = Plc::default();
    box_facets(&mut plc, [2, 1, 1], 1.0, &[true; 36]);
    let at_2 = |v: &VertexId| plc.vertices[v.index()][0] == 2.0;
    let corners = |facet: usize| plc.facets[facet].polygons[0].iter();
    let (outer, mut of_room): (Vec<usize>, Vec<usize>) = (0..plc.facets.len())
        .filter(|&f| corners(f).any(at_2))
        .partition(|&f| corners(f).all(at_2));
    assert_eq!((outer.len(), of_room.len()), (1, 4));
    let mut report = Report::default();
    let mut cdt = Cdt::with_segments(&plc, true, &mut report).expect("a valid PLC");
    cdt.insert_polygons(FLIPS, &mut report, &mut quiet)
        .expect("a valid PLC");
    let closed = cdt.export(&plc, false, &mut report).expect("two rooms");
    let delete = |cdt: &mut Cdt, facet: usize| {
        let f = cdt.polygon_of_facet(facet).expect("the wall has an area");
        cdt.delete_polygon(f).expect("a flat polygon");
        f
    };
    let mut deleted = vec![delete(&mut cdt, outer[0])];
    let rest = plc_of_inserted(&plc, &cdt);
    match cdt.export(&rest, false, &mut report) {
        Err(Failure::Domain(DomainError::Open { edges })) => {
            assert_eq!(edges.len(), 4);
            assert!(edges.iter().flatten().all(at_2));
        }
        other => panic!("an open surface: {other:?}"),
    }
    deleted.extend(of_room.drain(..).map(|f| delete(&mut cdt, f)));
    let rest = plc_of_inserted(&plc, &cdt);
    let open = cdt.export(&rest, false, &mut report).expect("one room");
    let options = VerifyOptions {
        domain: Domain::Inside,
        ..VerifyOptions::default()
    };
    let verdict = verify(&rest, &open, options);
    assert!(verdict.is_ok(), "{verdict}");
    assert_eq!(verdict.counts.volume, 1.0);
    for f in deleted {
        insert(&mut cdt, f, FLIPS).expect("as before");
    }
    assert_eq!(cdt.export(&plc, false, &mut report), Ok(closed));
}

#[test]
fn what_is_not_there_is_refused() {
    let mut cdt = flat(&seven_points()).expect("a flat polygon");
    let facets = vec![0];
    assert_eq!(
        cdt.delete_polygon(0),
        Err(DeletionRefused::NotInserted { facets })
    );
    assert_eq!(
        cdt.delete_polygon(1),
        Err(DeletionRefused::NoSuchPolygon(1))
    );
    assert_eq!(insert(&mut cdt, 1, FLIPS), Err(Failure::NoSuchPolygon(1)));
    assert!(!cdt.is_inserted(0) && !cdt.is_inserted(1));
    insert(&mut cdt, 0, FLIPS).expect("a valid PLC");
    assert!(cdt.is_inserted(0));
    let again = insert(&mut cdt, 0, FLIPS);
    assert_eq!(again, Ok(PolygonCounts::default()));
}

/// Two coplanar triangles are one polygon, which is deleted as one.
#[test]
fn merged_facets_go_together() {
    let mut plc = seven_points();
    plc.facets = vec![facet(&[1, 6, 2]), facet(&[2, 3, 1])];
    let mut cdt = flat(&plc).expect("a flat polygon");
    assert_eq!(cdt.polygon_of_facet(1), Some(0));
    let without = tets(&cdt);
    insert(&mut cdt, 0, FLIPS).expect("a valid PLC");
    delete(&mut cdt, 0);
    assert_eq!(tets(&cdt), without);
    let facets = vec![0, 1];
    assert_eq!(
        cdt.delete_polygon(0),
        Err(DeletionRefused::NotInserted { facets })
    );
}
