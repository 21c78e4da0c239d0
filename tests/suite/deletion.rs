//! Deleting a polygon undoes its insertion, whatever else is there; what cannot be deleted is refused, and nothing has
//! changed.

use crate::common::families::{
    crossing_planes, facet, fins, lattice_with_rectangle, sphere, walls,
};
use crate::common::{box_facets, plc_of_points, quiet, sorted_tets};
use proptest::prelude::*;
use tetflip::cdt::Cdt;
use tetflip::error::{DeletionRefused, DomainError, Failure};
use tetflip::exchange::{Plc, Segment};
use tetflip::mesh::{TetMesh, VertexId};
use tetflip::predicate::PointStore;
use tetflip::recover::flips::{
    Blocked, Deleted, FilteredTimes, FlipCounts, FlipDeletion, Kept, PolygonMotion,
};
use tetflip::recover::polygons::{FlipOrder, Insertion, NumberType, PolygonCounts};
use tetflip::recover::tables::Table;
use tetflip::report::Report;
use tetflip::update::DeletionCounts;
use tetflip::verify::{Counts, Domain, VerifyOptions, verify};

const FLIPS: Insertion = Insertion::Flip(FlipOrder::FILTERED);

/// The tetrahedra, after a check of the topology.
fn tets(cdt: &Cdt) -> Vec<[VertexId; 4]> {
    tets_of(cdt.mesh())
}

fn tets_of(mesh: &TetMesh) -> Vec<[VertexId; 4]> {
    mesh.check().expect("a triangulated sphere");
    sorted_tets(mesh)
}

fn insert(cdt: &mut Cdt, f: usize, insertion: Insertion) -> Result<PolygonCounts, Failure> {
    cdt.insert_polygon(f, insertion, &mut Report::default())
}

/// 0, …, n − 1 in an order that depends on the seed.
fn shuffled(n: usize, mut seed: u64) -> Vec<usize> {
    let mut order: Vec<usize> = (0..n).collect();
    for i in (1..n).rev() {
        // Knuth's MMIX generator.
        seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        order.swap(i, (seed >> 33) as usize % (i + 1));
    }
    order
}

/// The PLC without the facets of the polygons that are not inserted, but with all segments.
fn plc_of_inserted(plc: &Plc, cdt: &Cdt) -> Plc {
    let mut rest = plc.clone();
    let complex = cdt.complex();
    let left = |facet: &usize| {
        cdt.polygon_of_facet(*facet)
            .is_none_or(|f| cdt.is_inserted(f))
    };
    rest.facets = (0..plc.facets.len())
        .filter(left)
        .map(|i| plc.facets[i].clone())
        .collect();
    let kept = complex.segments.iter().map(|s| Segment {
        ends: s.ends,
        marker: 0,
    });
    rest.segments = kept.collect();
    rest
}

/// The verifier accepts the mesh as a CDT of what is inserted, and of all segments.
fn assert_verified(plc: &Plc, cdt: &Cdt) -> Counts {
    let rest = plc_of_inserted(plc, cdt);
    let mesh = cdt
        .clone()
        .export(&rest, true, &mut Report::default())
        .expect("the hull is not empty");
    let options = VerifyOptions {
        domain: Domain::Hull,
        ..VerifyOptions::default()
    };
    let verdict = verify(&rest, &mesh, options);
    assert!(verdict.is_ok(), "{verdict}");
    verdict.counts
}

/// The Delaunay tetrahedralization with all segments; `None` if there is none, or if not all polygons are flat with the
/// Steiner points on them.
fn flat(plc: &Plc) -> Option<Cdt> {
    let cdt = Cdt::with_segments(plc, true, &mut Report::default()).ok()?;
    let counts = assert_verified(plc, &cdt);
    let flat = cdt.complex().polygons.iter().all(|polygon| polygon.flat);
    (flat && counts.segment_vertices_rounded == 0).then_some(cdt)
}

/// The same flips backwards.
fn assert_inverse(inserted: &FlipCounts, deleted: &FlipCounts) {
    let forward = [inserted.two_three, inserted.three_two, inserted.four_four];
    let back = [deleted.three_two, deleted.two_three, deleted.four_four];
    assert_eq!(forward, back);
}

/// Deletes `f` in every number type. All exact ones do the same; rounded ones do that or nothing.
fn delete(cdt: &mut Cdt, f: usize) -> DeletionCounts {
    let before = tets(cdt);
    let mut exact = cdt.clone();
    let mut rounded = cdt.clone();
    let counts = cdt.delete_polygon(f).expect("a flat polygon");
    let exact_counts = exact.delete_polygon_by(f, FlipOrder::EXACT);
    let exact_counts = exact_counts.expect("a flat polygon");
    assert_eq!(tets(cdt), tets(&exact));
    let events = |c: &DeletionCounts| (c.flips.flips(), c.flips.queued, c.flips.stale);
    assert_eq!(events(&counts), events(&exact_counts));
    #[cfg(feature = "rug")]
    {
        let mut rug = rounded.clone();
        let rug_counts = rug.delete_polygon_by(f, FlipOrder::new(NumberType::Rug));
        assert_eq!(rug_counts, Ok(exact_counts));
        assert_eq!(tets(&rug), tets(&exact));
    }
    for times in [
        FlipOrder::new(NumberType::F64Plain),
        FlipOrder::new(NumberType::F32),
    ] {
        match rounded.delete_polygon_by(f, times) {
            Ok(_) => {
                assert_eq!(tets(&rounded), tets(cdt));
                break;
            }
            Err(refused) => {
                assert!(
                    matches!(refused, DeletionRefused::NoCdt { .. }),
                    "{refused}"
                );
                assert_eq!(tets(&rounded), before);
            }
        }
    }
    assert!(!cdt.is_inserted(f));
    let twice = cdt.delete_polygon(f);
    assert!(matches!(twice, Err(DeletionRefused::NotInserted { .. })));
    counts
}

/// Inserts one polygon after the other, each three times with a deletion after the first and the second; then deletes
/// them all in another order and puts some back. After every step the mesh is the one that belongs to the set of
/// polygons.
fn undo_and_redo(plc: &Plc, seed: u64) {
    let Some(start) = flat(plc) else { return };
    let n = start.complex().polygons.len();
    let mut cdt = start.clone();
    let mut steps = Vec::new();
    for f in shuffled(n, seed) {
        let without = tets(&cdt);
        let Ok(inserted) = insert(&mut cdt, f, FLIPS) else {
            // Random facets may intersect.
            return;
        };
        let with = tets(&cdt);
        let deleted = delete(&mut cdt, f);
        assert_eq!(tets(&cdt), without);
        assert_inverse(&inserted.flips, &deleted.flips);
        insert(&mut cdt, f, Insertion::Cavity).expect("as by flips");
        assert_eq!(tets(&cdt), with);
        delete(&mut cdt, f);
        assert_eq!(tets(&cdt), without);
        insert(&mut cdt, f, FLIPS).expect("as before");
        assert_eq!(tets(&cdt), with);
        steps.push(without);
    }
    let all = tets(&cdt);
    assert_verified(plc, &cdt);
    let order = shuffled(n, !seed);
    for (i, &f) in order.iter().enumerate() {
        delete(&mut cdt, f);
        let mut built = start.clone();
        for &g in order[i + 1..].iter().rev() {
            insert(&mut built, g, FLIPS).expect("as before");
        }
        assert_eq!(tets(&cdt), tets(&built));
        if i == n / 2 {
            assert_verified(plc, &cdt);
        }
    }
    assert_eq!(tets(&cdt), tets(&start));
    for f in order {
        insert(&mut cdt, f, FLIPS).expect("as before");
    }
    assert_eq!(tets(&cdt), all);
}

/// The PLC turned by the angle 0.7 twice, in doubles: hardly anything is exactly flat any more.
fn turned(mut plc: Plc) -> Plc {
    let (s, c) = (0.644217687237691, 0.7648421872844885);
    for [x, y, z] in &mut plc.vertices {
        (*x, *y) = (c * *x - s * *y, s * *x + c * *y);
        (*y, *z) = (c * *y - s * *z, s * *y + c * *z);
    }
    plc
}

/// How many deletions of polygons that are not flat were done, and how many refused.
#[derive(Default)]
struct Tried {
    done: usize,
    refused: usize,
}

/// Inserts and deletes polygons that are flat only to rounding. What is deleted at once leaves no trace, what is
/// deleted later leaves a CDT, and what is refused leaves everything as it was.
fn undo_rounded(plc: &Plc, seed: u64, tried: &mut Tried) {
    let Ok(mut cdt) = Cdt::with_segments(plc, true, &mut Report::default()) else {
        return;
    };
    let order = shuffled(cdt.complex().polygons.len(), seed);
    for &f in &order {
        let without = tets(&cdt);
        if insert(&mut cdt, f, FLIPS).is_err() {
            return;
        }
        let mut with = cdt.clone();
        if delete_rounded(&mut with, f, tried) {
            assert_eq!(tets(&with), without);
        }
    }
    for &f in order.iter().rev().step_by(2) {
        if delete_rounded(&mut cdt, f, tried) {
            assert_verified(plc, &cdt);
        }
    }
}

fn delete_rounded(cdt: &mut Cdt, f: usize, tried: &mut Tried) -> bool {
    let before = tets(cdt);
    match cdt.delete_polygon(f) {
        Ok(_) => {
            tried.done += 1;
            true
        }
        Err(refused) => {
            assert!(
                !matches!(refused, DeletionRefused::NotInserted { .. }),
                "{refused}"
            );
            assert_eq!(tets(cdt), before);
            assert!(cdt.is_inserted(f));
            tried.refused += 1;
            false
        }
    }
}

fn edges(mesh: &TetMesh) -> Vec<[VertexId; 2]> {
    let tets = sorted_tets(mesh).into_iter();
    let all = tets.flat_map(|[a, b, c, d]| [[a, b], [a, c], [a, d], [b, c], [b, d], [c, d]]);
    sorted(all)
}

fn triangles(mesh: &TetMesh) -> Vec<[VertexId; 3]> {
    let tets = sorted_tets(mesh).into_iter();
    sorted(tets.flat_map(|[a, b, c, d]| [[a, b, c], [a, b, d], [a, c, d], [b, c, d]]))
}

fn sorted<T: Ord>(all: impl Iterator<Item = T>) -> Vec<T> {
    let mut list: Vec<T> = all.collect();
    list.sort_unstable();
    list.dedup();
    list
}

/// Deletes the only polygon of a PLC from a copy of the mesh, which keeps its segments and the given edges and
/// triangles.
fn delete_around(
    cdt: &Cdt,
    edges: &[[VertexId; 2]],
    triangles: &[[VertexId; 3]],
) -> (Deleted, TetMesh) {
    let polygon = cdt.complex().polygons[0].clone();
    let bounds: Vec<[VertexId; 2]> =
        sorted(polygon.edges.iter().map(|&[a, b]| [a.min(b), a.max(b)]));
    let mesh = cdt.mesh().clone();
    let on_f = |[a, b, c]: [VertexId; 3]| {
        let in_plane = |v| {
            cdt.points()
                .orient3d([polygon.frame[0], polygon.frame[1], polygon.frame[2], v])
                .is_zero()
        };
        // The convex polygons of these tests are the hulls of their vertices.
        [a, b, c]
            .iter()
            .all(|v| in_plane(*v) && polygon.vertices.contains(v))
    };
    let corners = mesh
        .finite()
        .flat_map(|t| (0..4).map(move |slot| t.corner(slot)));
    let faces: Vec<_> = corners
        .filter(|&c| c < mesh.twin(c) && on_f(mesh.facet(c)))
        .collect();
    let [a, b, c] = polygon.frame;
    let is_left = |v| cdt.points().orient3d([a, b, c, v]).is_positive();
    let motion = PolygonMotion::new(cdt.points(), polygon.frame, &is_left);
    let kept = Kept {
        edge: &|e| bounds.contains(&e) || edges.contains(&e),
        triangle: &|t| triangles.contains(&t),
    };
    let times = FilteredTimes::new(&motion);
    let mut marks = Table::default();
    let mut mesh = mesh;
    let deletion = FlipDeletion::new(&mut mesh, cdt.points(), kept, times, &mut marks);
    let deleted = deletion.delete(&faces);
    (deleted, mesh)
}

/// Declares edges and triangles of the mesh with f to be constraints. An edge that is not there without f holds f in
/// place, one that is does not. A triangle may or may not; it does not if its edges are there without f, as then it can
/// be inserted after f is deleted.
fn keep_more(plc: &Plc, seed: u64, blocked_by_triangle: &mut usize) {
    let Some(start) = flat(plc) else { return };
    if start.points().len() != plc.vertices.len() {
        return;
    }
    let mut with = start.clone();
    if insert(&mut with, 0, FLIPS).is_err() {
        return;
    }
    let before = tets(&with);
    let (edges_with, edges_without) = (edges(with.mesh()), edges(start.mesh()));
    for i in shuffled(edges_with.len(), seed).into_iter().take(20) {
        let e = edges_with[i];
        let (deleted, mesh) = delete_around(&with, &[e], &[]);
        if edges_without.contains(&e) {
            assert_eq!(deleted.blocked, None);
            assert_eq!(tets_of(&mesh), tets(&start));
        } else {
            assert_eq!(deleted.blocked, Some(Blocked::Edge(e)));
            assert_eq!(tets_of(&mesh), before);
        }
    }
    let new = |t: &[VertexId; 3]| !triangles(start.mesh()).contains(t);
    let on_f = |t: &[VertexId; 3]| {
        let [a, b, c] = start.complex().polygons[0].frame;
        t.iter()
            .all(|&v| start.points().orient3d([a, b, c, v]).is_zero())
    };
    let new: Vec<_> = triangles(with.mesh())
        .into_iter()
        .filter(|t| new(t) && !on_f(t))
        .collect();
    for i in shuffled(new.len(), seed).into_iter().take(20) {
        let t @ [a, b, c] = new[i];
        let (deleted, mesh) = delete_around(&with, &[], &[t]);
        let insertable = [[a, b], [a, c], [b, c]]
            .iter()
            .all(|e| edges_without.contains(e));
        if insertable {
            assert_eq!(deleted.blocked, None);
        }
        if deleted.blocked.is_some() {
            *blocked_by_triangle += 1;
            assert_eq!(tets_of(&mesh), before);
            continue;
        }
        assert!(triangles(&mesh).contains(&t));
        if insertable {
            let mut other = plc.clone();
            other.facets = vec![facet(&t.map(|v| v.0))];
            other.segments = start.complex().segments.clone();
            let mut other = flat(&other).expect("its edges are there");
            insert(&mut other, 0, FLIPS).expect("a triangle that nothing crosses");
            assert_eq!(tets_of(&mesh), tets(&other));
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]

    #[test]
    fn lattices(plc in lattice_with_rectangle(), seed: u64) {
        undo_and_redo(&plc, seed);
    }

    #[test]
    fn planes_that_cross(plc in crossing_planes(), seed: u64) {
        undo_and_redo(&plc, seed);
    }

    #[test]
    fn grids_of_walls(plc in walls(), seed: u64) {
        undo_and_redo(&plc, seed);
    }

    #[test]
    fn floating_fins(plc in fins(), seed: u64) {
        undo_and_redo(&plc, seed);
    }

    #[test]
    fn spheres(plc in sphere(), seed: u64) {
        undo_and_redo(&plc, seed);
    }

    /// Of polygons that are not flat, too, some of which cannot be deleted.
    #[test]
    fn not_flat(
        plc in prop_oneof![lattice_with_rectangle(), crossing_planes(), fins(), walls()],
        seed: u64,
    ) {
        undo_rounded(&turned(plc), seed, &mut Tried::default());
    }

    #[test]
    fn more_constraints(plc in prop_oneof![lattice_with_rectangle(), sphere()], seed: u64) {
        keep_more(&plc, seed, &mut 0);
    }
}

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
