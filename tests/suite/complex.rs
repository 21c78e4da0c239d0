//! From a PLC to a complex: what is refused, on which side of its edges a facet lies.

use crate::fixtures::{check_frame, facet, ids, nested, square, tilted, walks};
use proptest::prelude::*;
use tetflip::exchange::{Facet, Plc, Segment};
use tetflip::mesh::VertexId;
use tetflip::plc::{Complex, PlcError, Polygon};

/// The only polygon of a PLC.
fn only(plc: &Plc) -> Polygon {
    let complex = Complex::new(plc, false).unwrap();
    assert_eq!(complex.polygons.len(), 1);
    let polygon = complex.polygons.into_iter().next().unwrap();
    check_frame(&polygon);
    polygon
}

/// Whether the frame turns counterclockwise in x and y.
fn turns_left(plc: &Plc, polygon: &Polygon) -> bool {
    let [a, b, c] = polygon.frame.map(|v| plc.vertices[v.index()]);
    (b[0] - a[0]) * (c[1] - a[1]) > (b[1] - a[1]) * (c[0] - a[0])
}

fn refusal(plc: &Plc) -> PlcError {
    let error = Complex::new(plc, false).unwrap_err();
    assert_eq!(Complex::new(plc, true).unwrap_err(), error);
    error
}

#[test]
fn a_polygon_keeps_its_order() {
    for (corners, left) in [([0, 1, 2, 3], true), ([3, 2, 1, 0], false)] {
        let plc = nested(facet(&[&corners]));
        let polygon = only(&plc);
        assert_eq!(polygon.edges, walks(&[&corners]));
        assert_eq!(turns_left(&plc, &polygon), left);
        assert!(polygon.flat);
    }
}

#[test]
fn a_concave_polygon_keeps_its_order() {
    let points = [[0.0, 0.0], [9.0, 0.0], [9.0, 9.0], [8.0, 1.0]];
    for (corners, left) in [([0, 1, 2, 3], true), ([3, 2, 1, 0], false)] {
        let plc = tilted(&points, vec![facet(&[&corners])]);
        assert_eq!(turns_left(&plc, &only(&plc)), left);
    }
}

#[test]
fn a_hole_with_an_island() {
    // The order of the inner polygons says nothing.
    let mut window = facet(&[&[0, 1, 2, 3], &[4, 5, 6, 7], &[11, 10, 9, 8]]);
    window.holes = vec![[1.5, 1.5, 3.0]];
    let plc = nested(window.clone());
    let polygon = only(&plc);
    assert_eq!(
        polygon.edges,
        walks(&[&[0, 1, 2, 3], &[7, 6, 5, 4], &[8, 9, 10, 11]])
    );
    assert!(turns_left(&plc, &polygon));
    assert_eq!(polygon.vertices.len(), 12);

    window.polygons[0].reverse();
    let plc = nested(window);
    let polygon = only(&plc);
    assert_eq!(
        polygon.edges,
        walks(&[&[3, 2, 1, 0], &[4, 5, 6, 7], &[11, 10, 9, 8]])
    );
    assert!(!turns_left(&plc, &polygon));
}

#[test]
fn polygons_without_a_hole_point_float() {
    let polygon = only(&nested(facet(&[&[0, 1, 2, 3], &[4, 5, 6, 7]])));
    let both: &[&[u32]] = &[&[0, 1, 2, 3], &[4, 5, 6, 7], &[7, 6, 5, 4]];
    assert_eq!(polygon.edges, walks(both));
}

#[test]
fn segments_and_vertices_float_in_both_directions() {
    let polygon = only(&nested(facet(&[&[0, 1, 2, 3], &[4, 6], &[9]])));
    let mut expected = walks(&[&[0, 1, 2, 3], &[4, 6]]);
    expected.sort_unstable();
    assert_eq!(polygon.edges, expected);
    assert_eq!(polygon.vertices, ids(&[0, 1, 2, 3, 4, 6, 9]));
}

#[test]
fn what_lies_outside_is_no_part_of_the_polygon() {
    // A segment and a vertex outside, far enough to attract the frame.
    let points = [
        &square(0.0, 1.0)[..],
        &[[90.0, 5.0], [5.0, 90.0], [-90.0, 0.0]],
    ]
    .concat();
    let plc = tilted(&points, vec![facet(&[&[0, 1, 2, 3], &[2, 4], &[5], &[6]])]);
    let polygon = only(&plc);
    assert_eq!(polygon.edges, walks(&[&[0, 1, 2, 3]]));
    assert_eq!(polygon.vertices, ids(&[0, 1, 2, 3]));
    assert!(turns_left(&plc, &polygon));
    let segments = Complex::new(&plc, true).unwrap().segments;
    assert_eq!(segments.len(), 5);
    assert_eq!(segments[4].ends.to_vec(), ids(&[2, 4]));
}

#[test]
fn slits_are_passed_twice() {
    // From the corner to an inner vertex and back; and to a hole and around it, with no hole point at all.
    let slit = only(&nested(facet(&[&[0, 1, 2, 3, 0, 4]])));
    assert_eq!(slit.edges, walks(&[&[0, 1, 2, 3, 0, 4]]));
    let keyhole = nested(facet(&[&[0, 1, 2, 3, 0, 4, 7, 6, 5, 4]]));
    let expected = walks(&[&[0, 1, 2, 3], &[0, 4], &[4, 5, 6, 7], &[7, 6, 5, 4]]);
    assert_eq!(only(&keyhole).edges, expected);
    let mut open = keyhole.clone();
    open.facets[0].holes = vec![[5.0, 5.0, 10.0]];
    assert_eq!(only(&open).edges, walks(&[&[0, 1, 2, 3, 0, 4, 7, 6, 5, 4]]));
}

#[test]
fn duplicate_vertices_become_the_first() {
    let mut plc = nested(facet(&[&[0, 1, 2, 13]]));
    plc.vertices[0] = [-0.0, 0.0, -0.0];
    plc.vertices.extend([[0.0; 3], plc.vertices[3]]);
    plc.facets[0].polygons[0][0] = VertexId(12);
    let complex = Complex::new(&plc, false).unwrap();
    assert_eq!(complex.representative[12..], ids(&[0, 3]));
    assert_eq!(complex.polygons[0].edges, walks(&[&[0, 1, 2, 3]]));
}

#[test]
fn crossings_inside_a_facet() {
    let bow_tie = refusal(&nested(facet(&[&[0, 2, 1, 3]])));
    assert_eq!(
        bow_tie.to_string(),
        "edges 1-3 and 2-4 of facet 1 (1 3 2 4) cross"
    );
    let wires = refusal(&nested(facet(&[&[0, 1, 2, 3], &[0, 6], &[5, 7]])));
    assert!(matches!(wires, PlcError::EdgesCross { .. }), "{wires}");
    let mut points = square(0.0, 2.0).to_vec();
    points.push([1.0, 0.0]);
    for polygons in [
        &[&[0, 1, 2, 3][..], &[4]][..],
        &[&[0, 1, 2, 3], &[2, 4]],
        &[&[0, 1, 2, 4, 3]],
        &[&[0, 1, 2, 3], &[0, 4]],
    ] {
        let error = refusal(&tilted(&points, vec![facet(polygons)]));
        assert!(
            error
                .to_string()
                .starts_with("vertex 5 lies on edge 1-2 of facet 1"),
            "{error}"
        );
    }
}

#[test]
fn malformed_polygons() {
    let message = |f: Facet| refusal(&nested(f)).to_string();
    assert_eq!(
        message(facet(&[&[0, 1, 1, 2]])),
        "facet 1 (1 2 2 3) has vertex 2 twice in a row"
    );
    assert_eq!(
        message(facet(&[&[0, 1, 2, 0]])),
        "facet 1 (1 2 3 1) has vertex 1 twice in a row"
    );
    assert_eq!(
        message(facet(&[&[0, 1, 0, 1]])),
        "facet 1 (1 2 1 2) has a polygon of fewer than three different vertices"
    );
    assert_eq!(message(facet(&[&[0, 4, 8]])), "facet 1 (1 5 9) has no area");
    assert_eq!(
        message(facet(&[&[0, 4, 8, 2]])),
        "facet 1 (1 5 9 3) has no area"
    );
    assert_eq!(
        message(facet(&[&[0, 1, 2, 1]])),
        "facet 1 (1 2 3 2) has no area"
    );
    assert_eq!(
        message(facet(&[&[0, 1, 99]])),
        "facet 1 (1 2 100) refers to vertex 100, which does not exist"
    );
    assert_eq!(message(facet(&[])), "facet 1 () has no vertices");
    assert_eq!(
        message(facet(&[&[0, 1, 2], &[]])),
        "facet 1 (1 2 3) has no vertices"
    );
    let holed = |hole: [f64; 3]| Facet {
        holes: vec![hole],
        ..facet(&[&[0, 1, 2, 3], &[4, 6]])
    };
    assert_eq!(
        message(holed([1.0, 2.0, 3.0])),
        "the hole points of facet 1 (1 2 3 4) leave nothing of it"
    );
    assert_eq!(
        message(holed([4.0, 4.0, 8.0])),
        "hole point 0 of facet 1 (1 2 3 4) lies on edge 5-7"
    );
    assert_eq!(
        message(holed([f64::NAN; 3])),
        "facet hole point 0 has a coordinate that is not finite"
    );

    let mut plc = nested(facet(&[&[0, 1, 2]]));
    plc.segments = vec![Segment {
        ends: [VertexId(4); 2],
        marker: 0,
    }];
    assert!(matches!(refusal(&plc), PlcError::DegenerateSegment { .. }));
    plc.segments[0].ends[1] = VertexId(12);
    assert!(matches!(refusal(&plc), PlcError::NoSuchSegmentEnd { .. }));
    plc.vertices[11][2] = f64::INFINITY;
    assert_eq!(
        refusal(&plc).to_string(),
        "vertex 12 has a coordinate that is not finite"
    );
}

#[test]
fn planar_up_to_a_billionth() {
    let mut plc = nested(facet(&[&[0, 1, 2, 3]]));
    plc.vertices[2][2] += 1e-9;
    let polygon = only(&plc);
    assert!(!polygon.flat);
    assert_eq!(polygon.edges, walks(&[&[0, 1, 2, 3]]));
    plc.vertices[2][2] += 1e-7;
    match refusal(&plc) {
        PlcError::NotPlanar { distance, .. } => assert!((1e-8..1e-7).contains(&distance)),
        other => panic!("{other}"),
    }
}

#[test]
fn the_same_facet_twice() {
    for again in [&[0, 1, 2, 3][..], &[2, 1, 0, 3]] {
        let mut plc = nested(facet(&[&[0, 1, 2, 3]]));
        plc.facets.push(facet(&[&[0, 1, 4]]));
        plc.facets.push(facet(&[again]));
        let error = refusal(&plc);
        let PlcError::SameFacet { first, second } = error else {
            panic!("{error}")
        };
        assert_eq!((first.index, second.index), (0, 2));
    }
    // Complementary parts of one square are different.
    let mut ring = facet(&[&[0, 1, 2, 3], &[4, 5, 6, 7]]);
    ring.holes = vec![[5.0, 5.0, 10.0]];
    let mut plc = nested(ring);
    plc.facets.push(facet(&[&[4, 5, 6, 7]]));
    assert_eq!(Complex::new(&plc, false).unwrap().polygons.len(), 2);
    // They are one polygon after merging.
    let merged = Complex::new(&plc, true).unwrap();
    assert_eq!(merged.polygons.len(), 1);
    assert_eq!(merged.polygons[0].edges, walks(&[&[0, 1, 2, 3]]));
    assert_eq!(merged.polygons[0].vertices, ids(&[0, 1, 2, 3, 4, 5, 6, 7]));
}

#[test]
fn segments_are_there_once_with_the_first_marker() {
    let mut plc = nested(facet(&[&[0, 1, 2], &[5, 9]]));
    let segment = |a, b, marker| Segment {
        ends: [VertexId(a), VertexId(b)],
        marker,
    };
    plc.segments = vec![
        segment(2, 0, 0),
        segment(0, 2, 7),
        segment(9, 10, 3),
        segment(2, 0, 8),
    ];
    let segments = Complex::new(&plc, true).unwrap().segments;
    let expected = [
        segment(0, 1, 0),
        segment(1, 2, 0),
        segment(2, 0, 7),
        segment(5, 9, 0),
        segment(9, 10, 3),
    ];
    assert_eq!(segments, expected);
}

proptest! {
    /// No PLC makes the construction panic, and what comes out is a complex.
    #[test]
    fn nonsense_does_not_panic(
        points in prop::collection::vec([-2i32..3, -2..3, -20..2], 9),
        plane in [-1i32..2, -1..2],
        scale in prop::sample::select(vec![1.0, 0.1, 1e300, 1e-300, 4.4e307, 5e-324]),
        polygons in prop::collection::vec(prop::collection::vec(prop::collection::vec(0u32..9, 1..7), 1..4), 1..4),
        holes in prop::collection::vec([-2i32..3, -2..3, -1..2], 0..2),
        merge in any::<bool>(),
    ) {
        // Most points lie on a plane, but where they are scaled by 0.1 only nearly.
        let point = |&[x, y, z]: &[i32; 3]| {
            [x, y, if z > 0 { z } else { plane[0] * x + plane[1] * y }].map(|x| f64::from(x) * scale)
        };
        let facets = polygons.iter().map(|polygons| Facet {
            polygons: polygons.iter().map(|p| ids(p)).collect(),
            holes: holes.iter().map(point).collect(),
            marker: 0,
        });
        let plc = Plc { vertices: points.iter().map(point).collect(), facets: facets.collect(), ..Plc::default() };
        if let Ok(complex) = Complex::new(&plc, merge) {
            for polygon in &complex.polygons {
                check_frame(polygon);
                prop_assert!(polygon.edges.is_sorted() && polygon.vertices.is_sorted());
                // Edges close: as many leave a vertex as arrive there.
                for v in &polygon.vertices {
                    let count = |end: usize| polygon.edges.iter().filter(|e| e[end] == *v).count();
                    prop_assert_eq!(count(0), count(1));
                }
                for ends in &polygon.edges {
                    prop_assert!(complex.segments.iter().any(|s| s.ends == *ends || s.ends == [ends[1], ends[0]]));
                    prop_assert!(ends.iter().all(|v| polygon.vertices.binary_search(v).is_ok()));
                }
            }
        }
    }
}
