//! What is inside: open surfaces, holes that leak or leave nothing, regions, and what is said of them.

use crate::common::box_facets;
use tetflip::cdt::{MeshError, MeshOptions, Meshed};
use tetflip::error::{DomainError, Failure, PointKind};
use tetflip::exchange::{Facet, NoteCode, Plc, Region};
use tetflip::mesh::VertexId;

type Point = [f64; 3];

/// The corners of the faces of a box, seen from outside; those of the box are numbered by the bits of x, y, z.
const FACES: [[u32; 4]; 6] = [
    [0, 2, 3, 1],
    [4, 5, 7, 6],
    [0, 1, 5, 4],
    [2, 6, 7, 3],
    [0, 4, 6, 2],
    [1, 3, 7, 5],
];

fn add_facet(plc: &mut Plc, corners: &[u32]) {
    plc.facets.push(Facet {
        polygons: vec![corners.iter().map(|&v| VertexId(v)).collect()],
        ..Facet::default()
    });
}

/// Adds the first `faces` faces of a box.
fn add_box(plc: &mut Plc, low: Point, high: Point, faces: usize) {
    let first = plc.vertices.len() as u32;
    let ends = [low, high];
    let corner = |i: usize| std::array::from_fn(|axis| ends[i >> axis & 1][axis]);
    plc.vertices.extend((0..8).map(corner));
    for face in &FACES[..faces] {
        add_facet(plc, &face.map(|v| v + first));
    }
}

fn boxes(all: &[(Point, Point, usize)]) -> Plc {
    let mut plc = Plc {
        first_index: 1,
        ..Plc::default()
    };
    for &(low, high, faces) in all {
        add_box(&mut plc, low, high, faces);
    }
    plc
}

const CUBE: (Point, Point, usize) = ([0.0; 3], [8.0; 3], 6);
const VOID: (Point, Point, usize) = ([3.0; 3], [5.0; 3], 6);

fn mesh(plc: &Plc) -> Result<Meshed, MeshError> {
    tetflip::mesh(plc, &MeshOptions::default())
}

fn refused(plc: &Plc) -> (DomainError, String) {
    let error = mesh(plc).expect_err("nobody knows what is inside");
    assert!(error.is_of_input());
    match &*error.failure {
        Failure::Domain(domain) => (domain.clone(), error.to_string()),
        other => panic!("{other}"),
    }
}

fn volume(meshed: &Meshed) -> f64 {
    let at = |v: VertexId| meshed.mesh.vertices[v.index()];
    let tets = meshed.mesh.tets.iter();
    tets.map(|t| determinant(t.map(at))).sum::<f64>() / 6.0
}

fn determinant([a, b, c, d]: [Point; 4]) -> f64 {
    let from_a = |p: Point| [p[0] - a[0], p[1] - a[1], p[2] - a[2]];
    let [u, v, w] = [b, c, d].map(from_a);
    u[0] * (v[1] * w[2] - v[2] * w[1])
        + u[1] * (v[2] * w[0] - v[0] * w[2])
        + u[2] * (v[0] * w[1] - v[1] * w[0])
}

fn codes(meshed: &Meshed) -> Vec<NoteCode> {
    meshed.notes().iter().map(|note| note.code).collect()
}

#[test]
fn an_open_surface_is_refused_unless_the_hull_is_wanted() {
    let open = boxes(&[(CUBE.0, CUBE.1, 5)]);
    let (error, message) = refused(&open);
    // The missing face is 1 3 7 5.
    let edges = [[1, 3], [1, 5], [3, 7], [5, 7]].map(|e| e.map(VertexId));
    assert_eq!(
        error,
        DomainError::Open {
            edges: edges.into()
        }
    );
    assert!(message.contains("2-4, 2-6, 4-8, 6-8"), "{message}");
    let hull = MeshOptions {
        keep_hull: true,
        ..MeshOptions::default()
    };
    let meshed = tetflip::mesh(&open, &hull).expect("a hull");
    assert_eq!((volume(&meshed), codes(&meshed)), (512.0, Vec::new()));
}

#[test]
fn fins_are_legal_inside_and_refused_outside() {
    let with_triangle = |corners: [Point; 3]| {
        let mut plc = boxes(&[CUBE]);
        plc.vertices.extend(corners);
        add_facet(&mut plc, &[8, 9, 10]);
        plc
    };
    // A floating sheet, and a fin that stands on an edge of the cube.
    let floating = with_triangle([[3.0, 3.0, 3.0], [5.0, 3.0, 4.0], [3.0, 5.0, 4.0]]);
    let meshed = mesh(&floating).expect("legal");
    assert_eq!(codes(&meshed), [NoteCode::OpenEdges]);
    assert_eq!((meshed.report.open_edges, volume(&meshed)), (3, 512.0));
    assert_eq!(meshed.notes()[0].vertices, [9, 10, 11]);
    let mut fin = boxes(&[CUBE]);
    fin.vertices.push([4.0, 4.0, 4.0]);
    add_facet(&mut fin, &[0, 1, 8]);
    let meshed = mesh(&fin).expect("legal");
    assert_eq!((meshed.report.open_edges, volume(&meshed)), (2, 512.0));
    for outside in [
        with_triangle([[9.0, 3.0, 3.0], [9.0, 5.0, 4.0], [9.0, 3.0, 5.0]]),
        with_triangle([[9.0, 9.0, 9.0], [9.0, 8.5, 9.0], [8.5, 9.0, 9.0]]),
    ] {
        let (error, _) = refused(&outside);
        assert_eq!(error.open_edges().len(), 3);
    }
}

#[test]
fn a_hole_point_that_may_leak_is_refused_with_its_edges() {
    let closed = Plc {
        holes: vec![[4.0; 3]],
        ..boxes(&[CUBE, VOID])
    };
    let meshed = mesh(&closed).expect("a void");
    assert_eq!((volume(&meshed), codes(&meshed)), (504.0, Vec::new()));
    let leaking = Plc {
        holes: vec![[4.0; 3]],
        ..boxes(&[CUBE, (VOID.0, VOID.1, 5)])
    };
    let (error, message) = refused(&leaking);
    assert_eq!(error.open_edges().len(), 4);
    assert!(message.contains("hole point 1 (4, 4, 4)"), "{message}");
    assert!(message.contains("10-12, 10-14, 12-16, 14-16"), "{message}");
    let mut rooms = Plc::default();
    box_facets(&mut rooms, [2, 1, 1], 2.0, &[true; 36]);
    let meshed = mesh(&rooms).expect("two rooms");
    assert_eq!(meshed.report.output_regions, 2);
    rooms.holes.push([1.0; 3]);
    let meshed = mesh(&rooms).expect("one room");
    assert_eq!((volume(&meshed), meshed.report.output_regions), (8.0, 1));
}

#[test]
fn hole_points_that_leave_nothing_are_refused() {
    let all = Plc {
        holes: vec![[4.0; 3]],
        ..boxes(&[CUBE])
    };
    let holes = vec![0];
    assert_eq!(refused(&all).0, DomainError::HolesLeaveNothing { holes });
    let region = |point, attribute| Region {
        point,
        attribute,
        max_volume: None,
    };
    let named = Plc {
        holes: vec![[9.0; 3], [4.0; 3]],
        regions: vec![region([1.0; 3], 1.0), region([3.5; 3], 2.0)],
        ..boxes(&[CUBE, VOID])
    };
    let (error, message) = refused(&named);
    let (hole, region) = (1, 1);
    assert_eq!(error, DomainError::HoleInRegion { hole, region });
    assert!(message.contains("hole point 2 (4, 4, 4)"), "{message}");
    assert!(message.contains("region point 2 (3.5, 3.5, 3.5)"));
    let on_facet = Plc {
        holes: vec![[4.0, 4.0, 0.0]],
        ..boxes(&[CUBE])
    };
    let kind = PointKind::Hole;
    assert_eq!(
        refused(&on_facet).0,
        DomainError::PointOnFacet { kind, index: 0 }
    );
}

#[test]
fn what_is_said_in_vain_is_noted() {
    let plain = mesh(&boxes(&[CUBE])).expect("a cube");
    let plc = Plc {
        holes: vec![[9.0; 3], [8.5, 1.0, 1.0]],
        regions: vec![
            Region {
                point: [9.0, 0.5, 0.1],
                attribute: 3.0,
                max_volume: None,
            },
            Region {
                point: [1.0; 3],
                attribute: 2.0,
                max_volume: Some(0.25),
            },
        ],
        ..boxes(&[CUBE])
    };
    let meshed = mesh(&plc).expect("a cube");
    assert_eq!(meshed.mesh.tets, plain.mesh.tets);
    assert!(meshed.mesh.regions.iter().all(|&r| r == 2.0));
    use NoteCode::{HoleOutside, RegionOutside, RegionVolume};
    assert_eq!(codes(&meshed), [RegionVolume, HoleOutside, RegionOutside]);
    let texts: Vec<&str> = meshed.notes().iter().map(|note| &note.text[..]).collect();
    assert!(texts[0].contains("0.25"), "{}", texts[0]);
    assert!(texts[1].contains("(9, 9, 9), (8.5, 1, 1)"), "{}", texts[1]);
    assert!(texts[2].contains("(9, 0.5, 0.1)"), "{}", texts[2]);
    let hull = MeshOptions {
        keep_hull: true,
        ..MeshOptions::default()
    };
    let holes = Plc {
        holes: vec![[4.0; 3]],
        ..boxes(&[CUBE])
    };
    let meshed = tetflip::mesh(&holes, &hull).expect("a hull");
    assert_eq!(codes(&meshed), [NoteCode::HoleIgnored]);
}

/// A ring with a membrane across it: no edge is open, and the membrane has the outside on both sides.
#[test]
fn a_membrane_outside_is_left_out_and_noted() {
    let mut plc = boxes(&[
        ([0.0; 3], [3.0, 3.0, 1.0], 0),
        ([1.0, 1.0, 0.0], [2.0, 2.0, 1.0], 0),
    ]);
    for face in &FACES[2..] {
        add_facet(&mut plc, face);
        add_facet(&mut plc, &face.map(|v| v + 8));
    }
    for (face, z) in [(FACES[0], 0.0), (FACES[1], 1.0)] {
        plc.facets.push(Facet {
            polygons: [0, 8]
                .map(|first| face.map(|v| VertexId(v + first)).into())
                .into(),
            holes: vec![[1.5, 1.5, z]],
            marker: 0,
        });
    }
    let ring = mesh(&plc).expect("a ring");
    assert_eq!((volume(&ring), codes(&ring)), (8.0, Vec::new()));
    add_facet(&mut plc, &FACES[0].map(|v| v + 8));
    let meshed = mesh(&plc).expect("a ring");
    assert_eq!(codes(&meshed), [NoteCode::FacetsOutside]);
    assert_eq!(meshed.notes()[0].facets, [11]);
    assert_eq!(volume(&meshed), 8.0);
}

/// Every face is counterclockwise from the front, and the table of faces knows what is there.
#[test]
fn faces_are_oriented_and_know_their_sides() {
    let mut plc = Plc::default();
    box_facets(&mut plc, [3, 2, 1], 2.0, &[true; 36]);
    let fin = plc.vertices.len() as u32;
    plc.vertices
        .extend([[0.5, 0.5, 0.5], [1.5, 0.5, 1.0], [0.5, 1.5, 1.0]]);
    add_facet(&mut plc, &[fin, fin + 1, fin + 2]);
    let meshed = mesh(&plc).expect("six rooms");
    let mesh = &meshed.mesh;
    assert_eq!(meshed.report.output_regions, 6);
    let table = &mesh.face_table;
    assert_eq!(table.sides.len(), mesh.faces.len());
    let (mut boundary, mut between, mut within) = (0, 0, 0);
    for (f, face) in mesh.faces.iter().enumerate() {
        let [a, b, c] = face.vertices;
        assert!(a < b && a < c, "the least vertex comes first");
        let mut sides = [0, 0];
        for (t, tet) in mesh.tets.iter().enumerate() {
            let Some(apex) = apex(tet, face.vertices) else {
                continue;
            };
            let corners = [apex, a, b, c].map(|v| mesh.vertices[v.index()]);
            // Counterclockwise seen from the front: an apex behind makes it positive.
            sides[usize::from(determinant(corners) < 0.0)] = mesh.region_numbers[t];
        }
        assert_eq!(sides, table.sides[f], "face {f}");
        match sides {
            [_, 0] => boundary += 1,
            [behind, front] if behind < front => between += 1,
            [behind, front] => {
                assert!(behind == front && b < c);
                within += 1;
            }
        }
        let facets = &table.facets[table.polygons[f] as usize - 1];
        let on = |&facet: &usize| {
            let polygon = &plc.facets[facet].polygons[0];
            polygon.contains(&a) && polygon.contains(&b) && polygon.contains(&c)
        };
        assert!(facets.iter().any(on) || facets.len() > 1);
    }
    assert!(boundary > 20 && between > 10 && within == 1);
}

/// The vertex of a tetrahedron that a face of it does not have.
fn apex(tet: &[VertexId; 4], face: [VertexId; 3]) -> Option<VertexId> {
    let mut others = tet.iter().filter(|v| !face.contains(v));
    let apex = others.next().copied();
    apex.filter(|_| others.next().is_none())
}
