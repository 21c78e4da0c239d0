//! Merging coplanar facets: what is merged, what prevents it, and what remains.

use crate::fixtures::{check_frame, edges, facet, nested, square, tilted, walks};
use proptest::prelude::*;
use tetflip::exchange::{Plc, Segment};
use tetflip::mesh::VertexId;
use tetflip::plc::{Complex, PlcError};

/// A cube of twelve triangles.
fn cube() -> Plc {
    let vertices = (0..8)
        .map(|i| [i & 1, i >> 1 & 1, i >> 2].map(f64::from))
        .collect();
    let quads = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let halves = |&[a, b, c, d]: &[u32; 4]| [facet(&[&[a, b, c]]), facet(&[&[c, d, a]])];
    Plc {
        vertices,
        facets: quads.iter().flat_map(halves).collect(),
        ..Plc::default()
    }
}

#[test]
fn a_triangulated_cube_has_six_squares() {
    let complex = Complex::new(&cube(), true).unwrap();
    assert_eq!(complex.polygons.len(), 6);
    assert_eq!(complex.segments.len(), 12);
    for (i, polygon) in complex.polygons.iter().enumerate() {
        assert_eq!((polygon.edges.len(), polygon.vertices.len()), (4, 4));
        assert_eq!(polygon.facets, [2 * i, 2 * i + 1]);
        assert!(polygon.flat);
    }
    assert_eq!(complex.polygons[0].edges, walks(&[&[0, 2, 3, 1]]));
    assert_eq!(Complex::new(&cube(), false).unwrap().polygons.len(), 12);
}

#[test]
fn merging_respects_orientation_of_the_first_facet() {
    let mut plc = cube();
    plc.facets[0].polygons[0].reverse();
    let complex = Complex::new(&plc, true).unwrap();
    assert_eq!(complex.polygons[0].edges, walks(&[&[1, 3, 2, 0]]));
    let mut plc = cube();
    plc.facets[1].polygons[0].reverse();
    assert_eq!(
        Complex::new(&plc, true).unwrap().polygons,
        Complex::new(&cube(), true).unwrap().polygons
    );
}

#[test]
fn what_prevents_merging() {
    let count = |edit: fn(&mut Plc)| {
        let mut plc = cube();
        edit(&mut plc);
        let complex = Complex::new(&plc, true).unwrap();
        (complex.polygons.len(), complex.segments.len())
    };
    assert_eq!(count(|_| ()), (6, 12));
    // Another marker.
    assert_eq!(count(|plc| plc.facets[0].marker = 1), (7, 13));
    // The edge was given as a segment, in whatever direction and with whatever marker.
    assert_eq!(
        count(|plc| plc.segments.push(Segment {
            ends: [VertexId(3), VertexId(0)],
            marker: 0
        })),
        (7, 13)
    );
    // … or as a facet without area.
    assert_eq!(count(|plc| plc.facets.push(facet(&[&[0, 3]]))), (7, 13));
    // A third facet ends there.
    assert_eq!(count(|plc| plc.facets.push(facet(&[&[0, 3, 4]]))), (8, 14));
    // Not quite in one plane.
    assert_eq!(count(|plc| plc.vertices[0][2] = 1e-300), (7, 13));
}

#[test]
fn an_explicit_segment_stays_inside_a_merged_polygon() {
    // Four triangles about the center of a square; one of the inner edges is explicit.
    let points = [&square(-1.0, 1.0)[..], &[[0.0, 0.0]]].concat();
    let fan = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]].map(|t| facet(&[&t]));
    let mut plc = tilted(&points, fan.to_vec());
    plc.segments = vec![Segment {
        ends: [VertexId(4), VertexId(1)],
        marker: 5,
    }];
    let complex = Complex::new(&plc, true).unwrap();
    assert_eq!(complex.polygons.len(), 1);
    assert_eq!(complex.polygons[0].edges, walks(&[&[0, 1, 2, 3], &[1, 4]]));
    assert_eq!(complex.segments.len(), 5);
    assert_eq!(complex.segments.iter().map(|s| s.marker).max(), Some(5));
}

#[test]
fn an_edge_between_two_holes_stays() {
    // The frame of a window of two triangular panes, and the panes.
    let mut frame = facet(&[&[0, 1, 2, 3], &[4, 5, 6], &[4, 6, 7]]);
    frame.holes = vec![[7.0, 2.0, 9.0], [2.0, 7.0, 9.0]];
    let mut plc = nested(frame);
    plc.facets
        .extend([facet(&[&[4, 5, 6]]), facet(&[&[7, 6, 4]])]);
    let complex = Complex::new(&plc, true).unwrap();
    assert_eq!(complex.polygons.len(), 1);
    assert_eq!(complex.polygons[0].edges, walks(&[&[0, 1, 2, 3], &[4, 6]]));
    assert_eq!(complex.segments.len(), 5);
}

#[test]
fn folded_facets_overlap() {
    let plc = nested(facet(&[&[0, 1, 2]]));
    let mut folded = plc.clone();
    folded.facets.push(facet(&[&[0, 1, 6]]));
    assert_eq!(Complex::new(&folded, false).unwrap().polygons.len(), 2);
    let error = Complex::new(&folded, true).unwrap_err();
    assert!(matches!(error, PlcError::FacetsOverlap { .. }), "{error}");
    // Whatever their markers.
    folded.facets[0].marker = 1;
    assert_eq!(Complex::new(&folded, true), Err(error));
}

#[test]
fn two_triangulations_of_a_square_are_the_same_facet() {
    // The walls of a pyramid make every outer edge one of three facets.
    let mut plc = tilted(&square(0.0, 1.0), Vec::new());
    plc.vertices.push([0.5, 0.5, 9.0]);
    let floor = [[0, 1, 2], [0, 2, 3], [0, 1, 3], [1, 2, 3]];
    let walls = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]];
    plc.facets.extend(floor.map(|t| facet(&[&t])));
    plc.facets.extend(walls.map(|t| facet(&[&t])));
    assert!(Complex::new(&plc, false).is_ok());
    let error = Complex::new(&plc, true).unwrap_err();
    assert!(matches!(error, PlcError::SameFacet { .. }), "{error}");
}

/// Side of the grid of the test below, in cells.
const N: usize = 5;

proptest! {
    /// Some cells of a grid, each split into two triangles in some order, in some lattice plane of space: the merged
    /// polygons are the components of the cells, their edges the outlines with the cells on their left.
    #[test]
    fn triangulated_regions_merge_to_their_outlines(
        cells in prop::collection::vec((any::<bool>(), any::<bool>(), any::<bool>(), any::<bool>()), N * N),
        first in any::<bool>(),
        u in [-9i32..9, -9..9, 1..9],
        v in [-9i32..9, 1..9, -9..0],
    ) {
        let normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        prop_assume!(normal != [0; 3]);
        let lattice = |i: usize, j: usize| (j * (N + 1) + i) as u32;
        let place = |n: usize| {
            let (i, j) = ((n % (N + 1)) as i32, (n / (N + 1)) as i32);
            [0, 1, 2].map(|k| f64::from(i * u[k] + j * v[k]) / 8.0)
        };
        let used: Vec<bool> = cells.iter().enumerate().map(|(n, c)| c.0 || first && n == 0).collect();
        let mut plc = Plc { vertices: (0..(N + 1) * (N + 1)).map(place).collect(), ..Plc::default() };
        let mut cell_of = Vec::new();
        for (n, &(_, diagonal, flip_first, flip_second)) in cells.iter().enumerate().filter(|(n, _)| used[*n]) {
            let (i, j) = (n % N, n / N);
            let [a, b, c, d] = [lattice(i, j), lattice(i + 1, j), lattice(i + 1, j + 1), lattice(i, j + 1)];
            let mut halves = if diagonal { [[a, b, c], [c, d, a]] } else { [[a, b, d], [b, c, d]] };
            for (half, flip) in halves.iter_mut().zip([flip_first, flip_second]) {
                if flip {
                    half.reverse();
                }
                plc.facets.push(facet(&[half]));
                cell_of.push((n, !flip));
            }
        }
        // Components of cells that share an edge, by the lowest cell.
        let mut component: Vec<usize> = (0..N * N).collect();
        for _ in 0..N * N {
            for n in 0..N * N {
                for m in [(n % N + 1 < N).then_some(n + 1), (n + N < N * N).then_some(n + N)].into_iter().flatten() {
                    if used[n] && used[m] {
                        let lowest = component[n].min(component[m]);
                        (component[n], component[m]) = (lowest, lowest);
                    }
                }
            }
        }
        let is_used = |i: isize, j: isize| {
            let range = 0..N as isize;
            range.contains(&i) && range.contains(&j) && used[j as usize * N + i as usize]
        };
        let complex = Complex::new(&plc, true).unwrap();
        let components = (0..N * N).filter(|&n| used[n] && component[n] == n).count();
        prop_assert_eq!(complex.polygons.len(), components);
        for polygon in &complex.polygons {
            let (root, counterclockwise) = cell_of[polygon.facets[0]];
            let mut expected = Vec::new();
            let members: Vec<usize> = (0..N * N).filter(|&n| used[n] && component[n] == component[root]).collect();
            for &n in &members {
                let (i, j) = (n % N, n / N);
                let [a, b, c, d] = [lattice(i, j), lattice(i + 1, j), lattice(i + 1, j + 1), lattice(i, j + 1)];
                let (x, y) = (i as isize, j as isize);
                let sides = [
                    ([a, b], (x, y - 1)),
                    ([b, c], (x + 1, y)),
                    ([c, d], (x, y + 1)),
                    ([d, a], (x - 1, y)),
                ];
                for (edge, neighbor) in sides {
                    if !is_used(neighbor.0, neighbor.1) {
                        let [a, b] = edge;
                        expected.push(if counterclockwise { [a, b] } else { [b, a] });
                    }
                }
            }
            prop_assert_eq!(&polygon.edges, &edges(&expected));
            prop_assert_eq!(polygon.facets.len(), 2 * members.len());
            check_frame(polygon);
            // The frame turns as the lowest facet does.
            let grid = polygon.frame.map(|v| [(v.index() % (N + 1)) as i32, (v.index() / (N + 1)) as i32]);
            let [a, b, c] = grid;
            let turn = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
            prop_assert_eq!(turn > 0, counterclockwise);
            prop_assert!(turn != 0 && polygon.flat);
        }
        let outline: usize = complex.polygons.iter().map(|p| p.edges.len()).sum();
        prop_assert_eq!(complex.segments.len(), outline);
    }
}
