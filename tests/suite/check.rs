//! The check of the input: every kind of conflict by a small example, and agreement with all pairs tested in rationals.

mod brute_force;

use crate::common::plc_of_points;
use brute_force::{Number, Point, Shape, contains, cross, in_conflict, is_zero, minus};
use num_rational::Ratio;
use num_traits::Zero;
use proptest::prelude::*;
use std::collections::BTreeSet;
use tetflip::check::{Conflict, Kind, Part, check};
use tetflip::exchange::{Facet, Plc, Segment};
use tetflip::mesh::VertexId;
use tetflip::plc::PlcError;

fn ids(corners: &[u32]) -> Vec<VertexId> {
    corners.iter().map(|&v| VertexId(v)).collect()
}

fn edge(a: u32, b: u32) -> [VertexId; 2] {
    [VertexId(a), VertexId(b)]
}

/// A PLC with facets of any number of polygons.
fn plc(points: &[[f64; 3]], facets: &[&[&[u32]]]) -> Plc {
    let mut plc = plc_of_points(points.to_vec());
    for polygons in facets {
        plc.facets.push(Facet {
            polygons: polygons.iter().map(|p| ids(p)).collect(),
            ..Facet::default()
        });
    }
    plc
}

/// The one conflict.
fn only(plc: &Plc) -> Conflict {
    let findings = check(plc, None);
    assert_eq!(findings.errors, []);
    let [conflict] = findings.conflicts[..] else {
        panic!("{:?}", findings.conflicts)
    };
    assert!(!conflict.describe(plc).is_empty());
    conflict
}

const FLOOR: [[f64; 3]; 4] = [
    [0.0, 0.0, 0.0],
    [4.0, 0.0, 0.0],
    [4.0, 4.0, 0.0],
    [0.0, 4.0, 0.0],
];

/// The floor and a triangle.
fn with_triangle(triangle: [[f64; 3]; 3]) -> Plc {
    let points = [&FLOOR[..], &triangle].concat();
    plc(&points, &[&[&[0, 1, 2, 3]], &[&[4, 5, 6]]])
}

#[test]
fn two_facets_in_every_conflict() {
    let kind = |triangle| {
        let conflict = only(&with_triangle(triangle));
        (
            conflict.kind,
            conflict.parts[0] == Part::Facet(1),
            conflict.point,
        )
    };
    let cross = kind([[1.0, 1.0, -1.0], [1.0, 3.0, -1.0], [1.0, 2.0, 1.0]]);
    assert_eq!(cross, (Kind::FacetsCross, false, [1.0, 2.0, 0.0]));
    let foot = kind([[1.0, 1.0, 0.0], [3.0, 1.0, 0.0], [1.0, 2.0, 1.0]]);
    let in_facet = Kind::EdgeInFacet { edge: edge(4, 5) };
    assert_eq!((foot.0, foot.1), (in_facet, true));
    let vertex = VertexId(6);
    let stands = kind([[1.0, 1.0, 1.0], [3.0, 1.0, 1.0], [1.5, 2.0, 0.0]]);
    assert_eq!(
        stands,
        (Kind::VertexInFacet { vertex }, true, [1.5, 2.0, 0.0])
    );
    let leans = kind([[1.0, -1.0, 1.0], [3.0, -1.0, 1.0], [1.5, 0.0, 0.0]]);
    let on_edge = Kind::VertexOnEdge {
        vertex,
        edge: edge(0, 1),
    };
    assert_eq!(leans, (on_edge, true, [1.5, 0.0, 0.0]));
    let touches = kind([[2.0, 0.0, 1.0], [2.0, 0.0, -1.0], [2.0, -1.0, 0.0]]);
    let edges = [edge(0, 1), edge(4, 5)];
    assert_eq!(
        touches,
        (Kind::EdgesCross { edges }, false, [2.0, 0.0, 0.0])
    );
    let beside = kind([[1.0, 0.0, 0.0], [6.0, 0.0, 0.0], [2.0, -1.0, 1.0]]);
    assert_eq!(
        beside,
        (Kind::EdgesOverlap { edges }, false, [2.5, 0.0, 0.0])
    );
    let overlap = kind([[1.0, 1.0, 0.0], [6.0, 1.0, 0.0], [2.0, 2.0, 0.0]]);
    assert_eq!(overlap.0, Kind::FacetsOverlap);
    let apart = with_triangle([[1.0, 1.0, 1e-300], [6.0, 1.0, 1.0], [2.0, 2.0, 1.0]]);
    assert!(check(&apart, None).is_valid());
}

#[test]
fn the_same_facet_twice() {
    let turned = plc(&FLOOR, &[&[&[0, 1, 2, 3]], &[&[2, 1, 0, 3]]]);
    assert_eq!(only(&turned).kind, Kind::SameFacet);
    // By coincident vertices.
    let points = [FLOOR, FLOOR].concat();
    let copied = plc(&points, &[&[&[0, 1, 2, 3]], &[&[4, 5, 6, 7]]]);
    assert_eq!(only(&copied).kind, Kind::SameFacet);
    assert_eq!(check(&copied, None).notes.duplicate_vertices.len(), 4);
}

#[test]
fn common_diagonals_must_be_declared() {
    let points = [
        &FLOOR[..],
        &[[2.0, 2.0, 3.0], [0.0, 0.0, 3.0], [4.0, 4.0, 3.0]],
    ]
    .concat();
    let wall = |floor: &[&[u32]], wall: &[u32]| plc(&points, &[floor, &[wall]]);
    let edge_in_facet = Kind::EdgeInFacet { edge: edge(0, 2) };
    assert_eq!(
        only(&wall(&[&[0, 1, 2, 3]], &[0, 2, 4])).kind,
        edge_in_facet
    );
    assert!(check(&wall(&[&[0, 1, 2, 3], &[0, 2]], &[0, 2, 4]), None).is_valid());
    // Two squares through one line between common corners.
    let points = [&FLOOR[..], &[[2.0, 2.0, 3.0], [2.0, 2.0, -3.0]]].concat();
    let crossing = plc(&points, &[&[&[0, 1, 2, 3]], &[&[0, 4, 2, 5]]]);
    assert_eq!(only(&crossing).kind, Kind::FacetsCross);
}

#[test]
fn segments_and_isolated_vertices() {
    let segment = |a, b| Segment {
        ends: edge(a, b),
        marker: 0,
    };
    let extra = [
        [1.0, 2.0, -1.0],
        [1.0, 2.0, 3.0],
        [3.0, 1.0, 0.0],
        [1.0, 2.0, 5.0],
    ];
    let points = [&FLOOR[..], &extra].concat();
    let mut plc = plc(&points, &[&[&[0, 1, 2, 3]]]);
    plc.segments = vec![segment(4, 5), segment(5, 7), segment(0, 1)];
    let findings = check(&plc, None);
    let kinds: Vec<Kind> = findings.conflicts.iter().map(|c| c.kind).collect();
    let (edge, vertex) = (edge(4, 5), VertexId(6));
    let expected = [
        Kind::EdgeThroughFacet { edge },
        Kind::VertexInFacet { vertex },
    ];
    assert_eq!(kinds, expected);
    assert_eq!(
        findings.conflicts[0].parts,
        [Part::Segment(0), Part::Facet(0)]
    );
    assert_eq!(findings.conflicts[0].point, [1.0, 2.0, 0.0]);
    assert_eq!(findings.notes.unused_vertices, [vertex]);
    assert_eq!(findings.notes.open_edges.len(), 4);
    assert!(check(&plc, Some(1)).stopped);
    assert_eq!(check(&plc, Some(1)).conflicts.len(), 1);
}

#[test]
fn wrong_facets_do_not_hide_the_others() {
    let mut plc = with_triangle([[1.0, 1.0, -1.0], [1.0, 3.0, -1.0], [1.0, 2.0, 1.0]]);
    let mut add = |corners: &[u32]| {
        plc.facets.push(Facet {
            polygons: vec![ids(corners)],
            ..Facet::default()
        });
    };
    add(&[0, 2, 1, 3]);
    add(&[0, 1, 1]);
    add(&[0, 99, 1]);
    let findings = check(&plc, None);
    assert_eq!(findings.conflicts.len(), 1);
    let [
        PlcError::EdgesCross { .. },
        PlcError::RepeatedVertex { .. },
        PlcError::NoSuchVertex { .. },
    ] = &findings.errors[..]
    else {
        panic!("{:?}", findings.errors)
    };
}

/// A fan around one vertex and a book around one edge, where all boxes overlap.
#[test]
fn fans_and_books_end_soon() {
    let n = 20_000;
    let turn = |i: u32| f64::from(i) * std::f64::consts::TAU / f64::from(n);
    let mut points = vec![[0.3, 0.2, 1.0], [0.1, -0.3, 3.0]];
    points.extend((0..n).map(|i| [turn(i).cos(), turn(i).sin(), 0.01 * f64::from(i).sin()]));
    let mut fan = plc_of_points(points);
    let mut book = fan.clone();
    let triangle = |corners: &[u32]| Facet {
        polygons: vec![ids(corners)],
        ..Facet::default()
    };
    fan.facets = (0..n)
        .map(|i| triangle(&[0, 2 + i, 2 + (i + 1) % n]))
        .collect();
    book.facets = (0..n).map(|i| triangle(&[0, 1, 2 + i])).collect();
    assert_eq!(check(&fan, None).conflicts, []);
    let conflicts = check(&book, None).conflicts;
    assert!(conflicts.is_empty(), "{:?}", conflicts[0]);
}

/// Points of the lattice along each axis.
const N: u32 = 4;

fn lattice(v: u32) -> [i32; 3] {
    [v % N, v / N % N, v / N / N].map(|x| x as i32)
}

fn at(v: u32) -> Point {
    lattice(v).map(|x| Number::from_integer(i128::from(x)))
}

/// The vertex at a lattice point, if there is one.
fn vertex(p: [i32; 3]) -> Option<u32> {
    let inside = p.iter().all(|&x| (0..N as i32).contains(&x));
    inside.then(|| (p[0] + N as i32 * (p[1] + N as i32 * p[2])) as u32)
}

/// What to make of three lattice points.
#[derive(Clone, Debug)]
enum Piece {
    Triangle,
    /// A parallelogram, with its diagonal declared or not, and with the lattice points inside declared or not.
    Parallelogram(bool, bool),
    Segment,
}

fn pieces() -> impl Strategy<Value = Vec<(Piece, [u32; 3])>> {
    let piece = prop_oneof![
        3 => Just(Piece::Triangle),
        3 => (any::<bool>(), any::<bool>()).prop_map(|(d, f)| Piece::Parallelogram(d, f)),
        1 => Just(Piece::Segment),
    ];
    let v = 0..N * N * N;
    prop::collection::vec((piece, [v.clone(), v.clone(), v]), 1..8)
}

/// The PLC of some pieces, and its parts. All lattice points are vertices.
fn build(pieces: &[(Piece, [u32; 3])]) -> (Plc, Vec<Shape>) {
    let points = (0..N * N * N).map(|v| lattice(v).map(f64::from)).collect();
    let mut plc = plc_of_points(points);
    let mut shapes = Vec::new();
    let undirected = |a: u32, b: u32| [a.min(b), a.max(b)];
    for (piece, [a, b, c]) in pieces {
        let (a, b, c) = (*a, *b, *c);
        if a == b || is_zero(&cross(&minus(&at(b), &at(a)), &minus(&at(c), &at(a)))) {
            continue;
        }
        let part = Part::Facet(plc.facets.len());
        let fourth = [0, 1, 2].map(|k| lattice(a)[k] + lattice(c)[k] - lattice(b)[k]);
        match (piece, vertex(fourth)) {
            (Piece::Segment, _) => {
                let ends = edge(a, b);
                plc.segments.push(Segment { ends, marker: 0 });
            }
            (Piece::Parallelogram(diagonal, floating), Some(d)) => {
                let mut polygons = vec![ids(&[a, b, c, d])];
                let mut edges = vec![(a, b), (b, c), (c, d), (d, a)];
                let mut vertices = vec![a, b, c, d];
                let simplices = vec![vec![a, b, c], vec![c, d, a]];
                let corners: Vec<Vec<Point>> = simplices
                    .iter()
                    .map(|s| s.iter().map(|&v| at(v)).collect())
                    .collect();
                let on = |v: u32, p: u32, q: u32| contains(&[at(p), at(q)], &at(v));
                if *diagonal && !(0..N * N * N).any(|v| v != a && v != c && on(v, a, c)) {
                    polygons.push(ids(&[a, c]));
                    edges.push((a, c));
                }
                for v in 0..N * N * N {
                    let inside = corners.iter().any(|s| contains(s, &at(v)));
                    if *floating && inside && !edges.iter().any(|&(p, q)| on(v, p, q)) {
                        polygons.push(ids(&[v]));
                        vertices.push(v);
                    }
                }
                plc.facets.push(Facet {
                    polygons,
                    ..Facet::default()
                });
                shapes.push(Shape {
                    part,
                    simplices,
                    edges: edges.into_iter().map(|(p, q)| undirected(p, q)).collect(),
                    vertices,
                });
            }
            _ => {
                plc.facets.push(Facet {
                    polygons: vec![ids(&[a, b, c])],
                    ..Facet::default()
                });
                shapes.push(Shape {
                    part,
                    simplices: vec![vec![a, b, c]],
                    edges: vec![undirected(a, b), undirected(b, c), undirected(a, c)],
                    vertices: vec![a, b, c],
                });
            }
        }
    }
    // Segments that are not edges, each once; then the vertices of no part.
    for (index, segment) in plc.segments.iter().enumerate() {
        let ends = undirected(segment.ends[0].0, segment.ends[1].0);
        if !shapes.iter().any(|s| s.edges.contains(&ends)) {
            shapes.push(Shape {
                part: Part::Segment(index),
                simplices: vec![ends.to_vec()],
                edges: vec![ends],
                vertices: ends.to_vec(),
            });
        }
    }
    for v in 0..N * N * N {
        let is_end = plc.segments.iter().any(|s| s.ends.contains(&VertexId(v)));
        if !is_end && !shapes.iter().any(|s| s.vertices.contains(&v)) {
            shapes.push(Shape {
                part: Part::Vertex(VertexId(v)),
                simplices: vec![vec![v]],
                edges: vec![],
                vertices: vec![v],
            });
        }
    }
    (plc, shapes)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    /// The check finds the pairs that all pairs, in rationals, have, and a point in both parts.
    #[test]
    fn agrees_with_all_pairs(pieces in pieces()) {
        let (plc, shapes) = build(&pieces);
        let findings = check(&plc, None);
        prop_assert_eq!(&findings.errors, &[]);
        let mut expected = BTreeSet::new();
        for (i, f) in shapes.iter().enumerate() {
            for g in &shapes[..i] {
                // Two lattice points are different.
                let isolated = f.simplices[0].len() + g.simplices[0].len() == 2;
                if !isolated && in_conflict(&at, f, g) {
                    expected.insert([f.part.min(g.part), f.part.max(g.part)]);
                }
            }
        }
        let pair = |c: &Conflict| [c.parts[0].min(c.parts[1]), c.parts[0].max(c.parts[1])];
        let found: BTreeSet<_> = findings.conflicts.iter().map(pair).collect();
        prop_assert_eq!(found.len(), findings.conflicts.len());
        prop_assert_eq!(found, expected);
        for conflict in &findings.conflicts {
            // Rounded, so near both parts.
            for part in conflict.parts {
                let shape = shapes.iter().find(|s| s.part == part).expect("a part");
                let corners = shape.vertices.iter().map(|&v| lattice(v));
                for k in 0..3 {
                    let range: Vec<i32> = corners.clone().map(|p| p[k]).collect();
                    let low = f64::from(*range.iter().min().expect("a vertex")) - 1e-12;
                    let high = f64::from(*range.iter().max().expect("a vertex")) + 1e-12;
                    prop_assert!((low..=high).contains(&conflict.point[k]), "{:?}", conflict);
                }
            }
        }
    }
}

/// One thread and three find the same, in the same order: where there is nothing, and where there is a lot. With a
/// limit, the first conflicts are found.
#[test]
fn threads_find_the_same() {
    let mut plc = tetflip::generate::generate(tetflip::generate::Kind::Terrain, 2, 6000);
    let found = |plc: &Plc, most| {
        let [alone, together] = [1, 3].map(|threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
            pool.build().expect("a pool").install(|| check(plc, most))
        });
        assert_eq!(alone, together);
        alone
    };
    assert!(found(&plc, None).is_valid());
    let n = plc.vertices.len();
    for i in (0..n).step_by(n / 40) {
        plc.vertices[i] = plc.vertices[(i + n / 3) % n].map(|x| x + 0.3);
    }
    let all = found(&plc, None).conflicts.len();
    assert!(all > 1000, "{all}");
    assert_eq!(found(&plc, Some(5)).conflicts.len(), 5);
}
