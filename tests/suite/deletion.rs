//! Deleting a polygon undoes its insertion, whatever else is there; what cannot be deleted is refused, and nothing has
//! changed.

mod small;

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
