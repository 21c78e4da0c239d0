//! Small inputs with every kind of defect, and random boxes on a lattice, whose unit squares must be covered once.

use super::*;
use crate::check::check;
use crate::check::{Part, simplices_of_parts};
use crate::delaunay::delaunay;
use crate::exchange::{Facet, NoteCode};
use crate::mesh::VertexId;
use crate::plc::Complex;
use crate::predicate::DoublePoints;
use proptest::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

fn ids(corners: &[u32]) -> Vec<VertexId> {
    corners.iter().map(|&v| VertexId(v)).collect()
}

/// A PLC with facets of any number of polygons.
fn plc(points: &[[f64; 3]], facets: &[&[&[u32]]]) -> Plc {
    let facet = |polygons: &&[&[u32]]| Facet {
        polygons: polygons.iter().map(|p| ids(p)).collect(),
        ..Facet::default()
    };
    Plc {
        vertices: points.to_vec(),
        facets: facets.iter().map(facet).collect(),
        ..Plc::default()
    }
}

/// Repairs, and checks that what comes out is valid and is not repaired again.
fn repaired(plc: &Plc) -> Repaired<'_> {
    let found = repair(plc, RepairOptions::default()).unwrap();
    assert!(check(&found.plc, None).is_valid());
    let again = repair(&found.plc, RepairOptions::default()).unwrap();
    assert_eq!(repaired_beside(plc).unwrap(), found);
    assert!(again.notes.is_empty() && matches!(again.plc, Cow::Borrowed(_)));
    let strict = RepairOptions {
        strict: true,
        ..RepairOptions::default()
    };
    assert_eq!(repair(plc, strict).is_ok(), found.notes.is_empty());
    assert!(check(plc, None).is_repairable());
    found
}

/// The same with the Delaunay tetrahedralization, if the vertices span space.
fn repaired_beside(plc: &Plc) -> Result<Repaired<'_>, Box<Findings>> {
    let points = DoublePoints::new(plc.vertices.clone());
    let representative = crate::plc::representatives(&plc.vertices);
    let own = (0..plc.vertices.len()).map(VertexId::new);
    let own: Vec<VertexId> = own.filter(|v| representative[v.index()] == *v).collect();
    let delaunay = delaunay(&points, &own).ok();
    let mesh = delaunay.as_ref().map(|delaunay| &delaunay.mesh);
    repair_beside(plc, RepairOptions::default(), mesh)
}

fn codes(notes: &[Note]) -> Vec<(NoteCode, usize)> {
    notes.iter().map(|note| (note.code, note.count)).collect()
}

/// A box with vertices of its own, as quadrilaterals or triangles.
fn add_box(plc: &mut Plc, low: [i32; 3], high: [i32; 3], triangles: bool, marker: i64) {
    let first = plc.vertices.len() as u32;
    for i in 0..8 {
        let corner = |k: usize| f64::from(if i >> k & 1 == 0 { low[k] } else { high[k] });
        plc.vertices.push([0, 1, 2].map(corner));
    }
    let quads = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    for quad in quads {
        let [a, b, c, d] = quad.map(|v: u32| VertexId(first + v));
        let pieces = match triangles {
            true => vec![vec![a, b, c], vec![a, c, d]],
            false => vec![vec![a, b, c, d]],
        };
        for corners in pieces {
            plc.facets.push(Facet {
                polygons: vec![corners],
                marker,
                ..Facet::default()
            });
        }
    }
}

/// The facets that cover each unit square of the lattice: axis, lowest corner.
fn squares(plc: &Plc) -> BTreeMap<(usize, [i32; 3]), Vec<usize>> {
    let mut found: BTreeMap<_, BTreeSet<usize>> = BTreeMap::new();
    for (part, simplices) in simplices_of_parts(plc) {
        let Part::Facet(facet) = part else { continue };
        for triangle in simplices.iter().filter(|s| s.len() == 3) {
            let at: Vec<[f64; 3]> = triangle.iter().map(|v| plc.vertices[v.index()]).collect();
            let axis = (0..3)
                .find(|&k| at.iter().all(|p| p[k] == at[0][k]))
                .unwrap();
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            let turn = |p: [f64; 2], q: [f64; 3], r: [f64; 3]| {
                (r[u] - q[u]) * (p[1] - q[v]) - (r[v] - q[v]) * (p[0] - q[u])
            };
            for (i, j) in (-1..9).flat_map(|i| (-1..9).map(move |j| (i, j))) {
                // On no diagonal.
                let p = [f64::from(i) + 0.5137, f64::from(j) + 0.4519];
                let signs = [0, 1, 2].map(|k| turn(p, at[k], at[(k + 1) % 3]));
                if signs.iter().all(|&s| s >= 0.0) || signs.iter().all(|&s| s <= 0.0) {
                    let mut low = [at[0][axis] as i32; 3];
                    (low[u], low[v]) = (i, j);
                    found.entry((axis, low)).or_default().insert(facet);
                }
            }
        }
    }
    found
        .into_iter()
        .map(|(square, of)| (square, of.into_iter().collect()))
        .collect()
}

/// Every unit square is covered once by the repaired facets, if it was covered at all, and these know by what.
fn assert_covered_once(plc: &Plc, repaired: &Repaired) {
    let (before, after) = (squares(plc), squares(&repaired.plc));
    assert_eq!(
        before.keys().collect::<Vec<_>>(),
        after.keys().collect::<Vec<_>>()
    );
    for (square, facets) in &after {
        let &[facet] = &facets[..] else {
            panic!("{square:?} is covered by {facets:?}")
        };
        let origins = match &repaired.plc.origins[..] {
            [] => &vec![facet],
            origins => &origins[facet],
        };
        // Facets that have been merged have more origins.
        assert!(before[square].iter().all(|f| origins.contains(f)));
    }
}

const FLOOR: [[f64; 3]; 4] = [
    [0.0, 0.0, 0.0],
    [4.0, 0.0, 0.0],
    [4.0, 4.0, 0.0],
    [0.0, 4.0, 0.0],
];

fn on_floor(more: &[[f64; 3]], facets: &[&[&[u32]]]) -> Plc {
    plc(&[&FLOOR[..], more].concat(), facets)
}

#[test]
fn what_is_valid_is_borrowed() {
    let mut two = Plc::default();
    add_box(&mut two, [0, 0, 0], [2, 2, 2], true, 0);
    add_box(&mut two, [0, 0, 3], [2, 2, 4], false, 7);
    let found = repaired(&two);
    assert!(found.notes.is_empty() && matches!(found.plc, Cow::Borrowed(_)));
}

#[test]
fn a_vertex_on_an_edge() {
    // Another triangle stands on the edge 0-1 of the floor with the vertices 4 and 5.
    let points = [[3.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 2.0]];
    let input = on_floor(&points, &[&[&[0, 1, 2, 3]], &[&[4, 5, 6]]]);
    let found = repaired(&input);
    assert_eq!(codes(&found.notes), [(NoteCode::VertexOnEdge, 2)]);
    assert_eq!(found.plc.facets[0].polygons, [ids(&[0, 5, 4, 1, 2, 3])]);
    assert_eq!(found.notes[0].vertices, [4, 5]);
}

#[test]
fn a_vertex_and_a_wall_on_a_floor() {
    let points = [
        [1.0, 2.0, 0.0],
        [3.0, 1.0, 0.0],
        [2.0, 2.0, 2.0],
        [3.0, 3.0, 0.0],
    ];
    // The foot of the wall crosses the diagonal of the floor; vertex 7 is isolated and on the diagonal.
    let triangles = on_floor(&points, &[&[&[0, 1, 2]], &[&[0, 2, 3]], &[&[4, 5, 6]]]);
    let found = repaired(&triangles);
    let wanted = [(NoteCode::VertexOnFacet, 3), (NoteCode::EdgeInFacet, 1)];
    assert_eq!(codes(&found.notes), wanted);
    assert_eq!(found.plc.origins, [vec![0, 1], vec![2]]);
    let complex = Complex::new(&found.plc, true).unwrap();
    assert!(
        complex.polygons[0]
            .edges
            .contains(&[VertexId(4), VertexId(5)])
    );
    assert!(
        complex.polygons[0]
            .edges
            .contains(&[VertexId(5), VertexId(4)])
    );
    assert!(complex.polygons[0].vertices.contains(&VertexId(7)));
    // If the diagonal counts, a vertex is missing.
    let apart = RepairOptions {
        merge_coplanar: false,
        ..RepairOptions::default()
    };
    assert!(!repair(&triangles, apart).unwrap_err().is_repairable());
}

#[test]
fn equal_facets_with_different_markers() {
    let mut input = on_floor(&[], &[&[&[0, 1, 2, 3]], &[&[2, 1, 0, 3]], &[&[1, 2, 3, 0]]]);
    for (facet, marker) in input.facets.iter_mut().zip([5, 0, 3]) {
        facet.marker = marker;
    }
    let found = repaired(&input);
    assert_eq!(codes(&found.notes), [(NoteCode::RepeatedFacets, 1)]);
    assert_eq!(found.plc.origins, [vec![0, 1, 2]]);
    assert_eq!(found.plc.facets[0].marker, 3);
    assert_eq!(found.notes[0].facets, [0, 1, 2]);
}

#[test]
fn a_smaller_floor_inside_keeps_its_marker() {
    let points = [
        [1.0, 1.0, 0.0],
        [3.0, 1.0, 0.0],
        [3.0, 3.0, 0.0],
        [1.0, 3.0, 0.0],
    ];
    let mut input = on_floor(&points, &[&[&[0, 1, 2, 3]], &[&[7, 6, 5, 4]]]);
    input.facets[0].marker = 1;
    input.facets[1].marker = 2;
    let found = repaired(&input);
    assert_covered_once(&input, &found);
    assert_eq!(found.plc.origins, [vec![0], vec![0, 1]]);
    let markers: Vec<i64> = found.plc.facets.iter().map(|f| f.marker).collect();
    // The edges of the second are segments, so that the two are not merged.
    assert_eq!((markers, found.plc.segments.len()), (vec![1, 1], 4));
    assert_eq!(Complex::new(&found.plc, true).unwrap().polygons.len(), 2);
}

#[test]
fn what_is_wrong_for_itself() {
    let points = [[2.0, 0.0, 0.0], [4.0, 4.0, 0.0]];
    let facets: [&[&[u32]]; 6] = [
        // Closed with the first corner, by a vertex of the same coordinates, and corner 4 on the edge to corner 1.
        &[&[0, 1, 5, 2, 3, 0]],
        &[&[0, 0, 1]],
        &[&[0, 1, 0]],
        &[&[0, 4, 1]],
        &[&[0, 2, 2], &[1, 3]],
        &[&[0, 1, 1], &[0, 3, 3, 1]],
    ];
    let input = on_floor(&points, &facets);
    let found = repair(&input, RepairOptions::default()).unwrap();
    assert!(check(&found.plc, None).is_valid());
    let of = |code: NoteCode| {
        found
            .notes
            .iter()
            .find(|n| n.code == code)
            .map_or(0, |n| n.count)
    };
    // Three facets, and a polygon of each of two.
    assert_eq!(of(NoteCode::DegenerateFacets), 5);
    assert!(of(NoteCode::RepeatedCorner) >= 4);
}

#[test]
fn a_corner_on_an_edge_of_its_own_facet() {
    let points = [[2.0, 0.0, 0.0], [2.0, 2.0, 0.0]];
    // The outline touches itself: from 5 to 4, which is on 0-1, and back.
    let input = on_floor(&points, &[&[&[0, 1, 2, 3]], &[&[0, 1, 2, 3], &[4, 5]]]);
    let found = repair(&input, RepairOptions::default()).unwrap();
    assert!(check(&found.plc, None).is_valid());
    assert_eq!(found.plc.origins, [vec![0, 1]]);
}

#[test]
fn crossings_are_refused() {
    // A triangle through the floor, and a floor beside whose edges cross those of the first.
    let points = [[1.0, 1.0, -1.0], [2.0, 1.0, 1.0], [1.0, 2.0, 1.0]];
    let through = on_floor(&points, &[&[&[0, 1, 2, 3]], &[&[4, 5, 6]]]);
    let points = [
        [2.0, 2.0, 0.0],
        [6.0, 2.0, 0.0],
        [6.0, 6.0, 0.0],
        [2.0, 6.0, 0.0],
    ];
    let beside = on_floor(&points, &[&[&[0, 1, 2, 3]], &[&[4, 5, 6, 7]]]);
    for input in [through, beside] {
        let found = repair(&input, RepairOptions::default()).unwrap_err();
        assert!(!found.conflicts.is_empty() && !found.is_repairable());
        assert!(!check(&input, None).is_repairable());
    }
}

#[test]
fn edges_may_cross_where_there_is_a_vertex() {
    // Two coplanar squares whose edges cross at 8 and 9, where a third facet has corners.
    let points = [
        [2.0, 2.0, 0.0],
        [6.0, 2.0, 0.0],
        [6.0, 6.0, 0.0],
        [2.0, 6.0, 0.0],
        [4.0, 2.0, 0.0],
        [2.0, 4.0, 0.0],
        [3.0, 3.0, 3.0],
    ];
    let input = on_floor(
        &points,
        &[&[&[0, 1, 2, 3]], &[&[4, 5, 6, 7]], &[&[8, 9, 10]]],
    );
    let found = repaired(&input);
    assert_eq!(found.plc.facets.len(), 5);
}

/// Polygons and segments without their order and their numbers.
fn shape(plc: &Plc) -> (BTreeSet<Vec<[VertexId; 2]>>, BTreeSet<[VertexId; 2]>) {
    let complex = Complex::new(plc, true).unwrap();
    let ends = |[a, b]: [VertexId; 2]| [a.min(b), a.max(b)];
    let polygon = |p: &crate::plc::Polygon| {
        let mut edges: Vec<_> = p.edges.iter().copied().map(ends).collect();
        edges.sort_unstable();
        edges
    };
    let polygons = complex.polygons.iter().map(polygon).collect();
    (
        polygons,
        complex.segments.iter().map(|s| ends(s.ends)).collect(),
    )
}

/// Whether an edge of the one rectangle crosses an edge of the other: x and y ranges.
fn rectangles_cross(p: [[i32; 2]; 2], q: [[i32; 2]; 2]) -> bool {
    let inside = |x: i32, [low, high]: [i32; 2]| low < x && x < high;
    let cross = |p: [[i32; 2]; 2], q: [[i32; 2]; 2]| {
        let sides = p[0].into_iter().flat_map(|x| q[1].map(|y| (x, y)));
        sides
            .into_iter()
            .any(|(x, y)| inside(x, q[0]) && inside(y, p[1]))
    };
    cross(p, q) || cross(q, p)
}

fn range() -> impl Strategy<Value = [i32; 2]> {
    (0..6i32, 1..5i32).prop_map(|(low, size)| [low, low + size])
}

proptest! {
    /// A box on a box, whose faces share a part: repaired unless edges cross where there is no vertex.
    #[test]
    fn boxes_on_boxes(
        sides in [[range(), range()], [range(), range()]],
        triangles in any::<[bool; 2]>(),
        markers in prop::array::uniform2(0..3i64),
        order in any::<u64>(),
    ) {
        let mut input = Plc::default();
        for (i, [[x0, x1], [y0, y1]]) in sides.into_iter().enumerate() {
            let z = 2 * i as i32;
            add_box(&mut input, [x0, y0, z], [x1, y1, z + 2], triangles[i], markers[i]);
        }
        let found = repair(&input, RepairOptions::default());
        prop_assert_eq!(check(&input, None).is_repairable(), found.is_ok());
        prop_assert_eq!(found.is_ok(), !rectangles_cross(sides[0], sides[1]));
        prop_assert_eq!(&found, &repaired_beside(&input));
        let Ok(found) = found else { return Ok(()) };
        prop_assert!(check(&found.plc, None).is_valid());
        assert_covered_once(&input, &found);
        // Facets in another order.
        let mut shuffled = input.clone();
        let key = |i: usize| (i as u64 + 1).wrapping_mul(order | 1).rotate_left(29);
        let mut places: Vec<usize> = (0..input.facets.len()).collect();
        places.sort_by_key(|&i| key(i));
        shuffled.facets = places.iter().map(|&i| input.facets[i].clone()).collect();
        let again = repair(&shuffled, RepairOptions::default()).unwrap();
        prop_assert_eq!(shape(&found.plc), shape(&again.plc));
    }

    /// The faces of a cube, each divided into strips of its own: vertices on edges everywhere.
    #[test]
    fn cubes_with_t_junctions(
        strips in prop::array::uniform6((any::<bool>(), prop::collection::btree_set(1..6i32, 0..4))),
    ) {
        let mut input = Plc::default();
        for (face, (along, cuts)) in strips.iter().enumerate() {
            let (axis, at) = (face / 2, if face % 2 == 0 { 0.0 } else { 6.0 });
            let cuts: Vec<f64> = [0].iter().chain(cuts).chain(&[6]).map(|&x| f64::from(x)).collect();
            for pair in cuts.windows(2) {
                let first = input.vertices.len() as u32;
                for (s, t) in [(0.0, pair[0]), (6.0, pair[0]), (6.0, pair[1]), (0.0, pair[1])] {
                    let (s, t) = if *along { (s, t) } else { (t, s) };
                    let mut p = [at; 3];
                    (p[(axis + 1) % 3], p[(axis + 2) % 3]) = (s, t);
                    input.vertices.push(p);
                }
                let corners = ids(&[first, first + 1, first + 2, first + 3]);
                input.facets.push(Facet { polygons: vec![corners], ..Facet::default() });
            }
        }
        let found = repair(&input, RepairOptions::default()).unwrap();
        prop_assert!(check(&found.plc, None).is_valid());
        assert_covered_once(&input, &found);
        let complex = Complex::new(&found.plc, true).unwrap();
        prop_assert!(complex.open_boundaries().is_empty());
        prop_assert_eq!(complex.polygons.len(), 6);
    }
}
