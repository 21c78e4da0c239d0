//! Tetrahedra apart from the others where the convex hull is kept: in a cavity they may be, elsewhere not.

use crate::meshes::*;
use tetflip::delaunay::delaunay;
use tetflip::exchange::ExportedMesh;
use tetflip::mesh::VertexId;
use tetflip::predicate::DoublePoints;
use tetflip::verify::Domain;

/// A tetrahedron in a cavity is no part of a convex hull, wherever it is in the list; what is in a cavity ends at
/// facets.
#[test]
fn an_island_in_a_cavity() {
    let (mut plc, mut hollow) = nested(false);
    plc.holes.push([1.5, 1.25, 1.5]);
    let n = hollow.vertices.len() as u32;
    let corners = [
        [1.1, 1.5, 1.1],
        [1.3, 1.5, 1.1],
        [1.1, 1.7, 1.1],
        [1.1, 1.5, 1.3],
    ];
    hollow.vertices.extend(corners);
    let island = ids([n, n + 1, n + 2, n + 3]);
    hollow.tets.insert(0, island);
    for _ in 0..2 {
        for domain in [Domain::Auto, Domain::Hull, Domain::Inside] {
            assert_kinds(&run_as(domain, &plc, &hollow), &["boundary not on facet"]);
        }
        hollow.tets.reverse();
    }
    // With its faces among the facets it is accepted.
    let first = plc.vertices.len() as u32;
    plc.vertices.extend(corners);
    for face in [[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]] {
        plc.facets.push(facet(&face.map(|v| first + v)));
    }
    for domain in [Domain::Auto, Domain::Hull, Domain::Inside] {
        assert_kinds(&run_as(domain, &plc, &hollow), &[]);
    }
}

/// The hull of the first vertices without any facet, and a tetrahedron all of whose faces are facets; it comes last or
/// first.
fn assert_refused(hull: &[[f64; 3]], others: &[[f64; 3]], apart: [u32; 4]) {
    let points = DoublePoints::new(hull.to_vec());
    let all: Vec<VertexId> = (0..hull.len()).map(VertexId::new).collect();
    let tetrahedra = delaunay(&points, &all).expect("they span space").mesh;
    let mut wrong = ExportedMesh::of_hull(0, hull.to_vec(), tetrahedra);
    wrong.faces.clear();
    wrong.vertices.extend(others);
    wrong.tets.push(ids(apart));
    let [a, b, c, d] = apart;
    let faces = [[a, b, c], [a, b, d], [a, c, d], [b, c, d]];
    let plc = plc(&wrong.vertices, &faces.each_ref().map(|face| &face[..]));
    for _ in 0..2 {
        for domain in [Domain::Auto, Domain::Hull, Domain::Inside] {
            let verdict = run_as(domain, &plc, &wrong);
            assert!(!verdict.is_ok(), "{domain:?} {hull:?} {others:?}");
        }
        wrong.tets.reverse();
    }
}

/// A tetrahedron that begins inside the hull and ends outside, through the surface, where no facet is.
#[test]
fn what_sticks_out_of_the_hull() {
    let others = [
        [0.9, 0.5, 0.5],
        [4.0, 0.4, 0.4],
        [4.0, 0.6, 0.4],
        [4.0, 0.5, 0.6],
    ];
    assert_refused(&cube_vertices(), &others, [8, 9, 10, 11]);
}

/// A tetrahedron outside that touches the hull in one vertex, in the middle of a side.
#[test]
fn what_touches_the_hull_from_outside() {
    for axis in 0..3 {
        for side in [0.0, 1.0] {
            let middle = [0, 1, 2].map(|i| if i == axis { side } else { 0.5 });
            let hull = [&cube_vertices()[..], &[middle]].concat();
            let far = |p: f64, q: f64| {
                let mut at = [3.0 * side - 1.0, p, q];
                at.rotate_right(axis);
                at
            };
            let others = [far(0.4, 0.4), far(0.6, 0.4), far(0.5, 0.6)];
            let inwards = if side == 0.0 {
                [8, 9, 11, 10]
            } else {
                [8, 9, 10, 11]
            };
            assert_refused(&hull, &others, inwards);
        }
    }
}
