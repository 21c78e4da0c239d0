//! The verifier reads the input that was given, whether or not it needed a repair: vertices on edges and facets, facets
//! that overlap or are equal, degenerate ones.

use crate::meshes::*;
use tetflip::exchange::{ExportedFace, NoteCode};
use tetflip::verify::{VerifyOptions, verify};

/// Two cubes side by side, each with all six facets: the wall is there twice.
#[test]
fn equal_facets_are_one() {
    let (mut plc, mut mesh) = two_cubes(&[0, 1]);
    let wall = plc
        .facets
        .iter()
        .position(|f| f.polygons[0].iter().all(|v| v.0 % 3 == 1))
        .expect("a wall");
    let mut again = plc.facets[wall].clone();
    again.polygons[0].reverse();
    again.polygons[0].rotate_left(1);
    again.marker = 8;
    plc.facets[wall].marker = 7;
    plc.facets.push(again);
    let verdict = run(&plc, &mesh);
    assert_kinds(&verdict, &[]);
    assert_eq!(verdict.counts.facets_repeated, 1);
    assert!(
        verdict
            .notes
            .iter()
            .any(|n| n.code == NoteCode::RepeatedFacets)
    );
    // A face has one of the two markers.
    for tet in &mesh.tets {
        let [a, b, c, d] = *tet;
        for t in [[a, b, c], [a, b, d], [a, c, d], [b, c, d]] {
            let on = plc
                .facets
                .iter()
                .any(|f| t.iter().all(|v| f.polygons[0].contains(v)));
            let same = |f: &ExportedFace| t.iter().all(|v| f.vertices.contains(v));
            if on && !mesh.faces.iter().any(same) {
                mesh.faces.push(ExportedFace {
                    vertices: t,
                    marker: 0,
                });
            }
        }
    }
    for (marker, kinds) in [
        (7, &[][..]),
        (8, &[]),
        (9, &["wrong marker"]),
        (0, &["wrong marker"]),
    ] {
        let on_wall = |f: &&mut ExportedFace| f.vertices.iter().all(|v| v.0 % 3 == 1);
        mesh.faces
            .iter_mut()
            .filter(on_wall)
            .for_each(|f| f.marker = marker);
        assert_kinds(&run(&plc, &mesh), kinds);
    }
}

/// The top of the cube has a diagonal twice, in two pairs of equal triangles: merged or not.
#[test]
fn equal_facets_are_merged_together() {
    let mut plc = split_top([4, 7]);
    let n = plc.facets.len();
    plc.facets
        .extend([plc.facets[1].clone(), plc.facets[n - 1].clone()]);
    // The diagonal of these five tetrahedra is the other one.
    let five = mesh(&cube_vertices(), &FIVE);
    let verdict = run(&plc, &five);
    assert_kinds(&verdict, &[]);
    assert_eq!(
        (
            verdict.counts.segments_merged,
            verdict.counts.facets_repeated
        ),
        (1, 2)
    );
    // Not if only one side has another marker.
    plc.facets[n + 1].marker = 5;
    assert!(!run(&plc, &five).is_ok());
}

/// A wall on the floor of a box: the foot of the wall divides the floor, which does not have it.
#[test]
fn an_edge_inside_a_facet() {
    let (mut plc, mesh) = two_cubes(&[0, 1]);
    // Floor and ceiling in one piece each; the wall and two sides end at T-junctions.
    let flat =
        |z: u32| move |f: &tetflip::exchange::Facet| f.polygons[0].iter().all(|v| v.0 / 6 == z);
    for (z, whole) in [(0, [0, 2, 5, 3]), (1, [6, 8, 11, 9])] {
        plc.facets.retain(|f| !flat(z)(f));
        plc.facets.push(facet(&whole));
    }
    let verdict = run(&plc, &mesh);
    assert_kinds(&verdict, &[]);
    assert_eq!(verdict.counts.constrained_faces, 22);
    // Floor and ceiling in one piece and in two, at the same place.
    plc.facets
        .extend([facet(&[0, 1, 4, 3]), facet(&[1, 2, 5, 4])]);
    assert_kinds(&run(&plc, &mesh), &[]);
    // A vertex in the middle of the floor that the mesh does not have.
    plc.vertices.push([0.5, 0.5, 0.0]);
    assert_kinds(&run(&plc, &mesh), &["missing vertex"]);
}

/// Coplanar facets with one marker meet in a line that one of them has as one edge, the others as two: merged away.
#[test]
fn a_merged_edge_with_a_vertex_on_it() {
    // A box of 2×1×1, whose top is one rectangle in front and two squares behind; y = 0, 1, 2.
    let vertices = [
        [0., 0., 0.],
        [2., 0., 0.],
        [2., 2., 0.],
        [0., 2., 0.],
        [0., 0., 1.],
        [2., 0., 1.],
        [2., 2., 1.],
        [0., 2., 1.],
        [0., 1., 1.],
        [2., 1., 1.],
        [1., 1., 1.],
        [1., 2., 1.],
    ];
    let box_of = |top: &[&[u32]]| {
        let sides: [&[u32]; 5] = [
            &[0, 1, 2, 3],
            &[0, 1, 5, 4],
            &[1, 2, 6, 9, 5],
            &[2, 3, 7, 11, 6],
            &[3, 0, 4, 8, 7],
        ];
        plc(&vertices, &[&sides[..], top].concat())
    };
    let top: [&[u32]; 3] = [&[4, 5, 9, 8], &[8, 10, 11, 7], &[10, 9, 6, 11]];
    let plc = box_of(&top);
    // From vertex 0, over the faces that do not have it.
    let fan = |triangles: &[[u32; 3]]| {
        let tets: Vec<[u32; 4]> = triangles.iter().map(|&[a, b, c]| [0, a, b, c]).collect();
        mesh(&vertices, &tets)
    };
    let sides = [
        [1, 2, 5],
        [2, 9, 5],
        [2, 6, 9],
        [2, 3, 7],
        [2, 7, 11],
        [2, 11, 6],
    ];
    let with_edge = [
        [4, 5, 8],
        [5, 10, 8],
        [5, 9, 10],
        [8, 10, 11],
        [8, 11, 7],
        [10, 9, 11],
        [9, 6, 11],
    ];
    let any = VerifyOptions {
        any_triangulation: true,
        ..VerifyOptions::default()
    };
    let kept = verify(&plc, &fan(&[&sides[..], &with_edge].concat()), any);
    assert_kinds(&kept, &[]);
    let without_edge = [
        [4, 11, 8],
        [8, 11, 7],
        [4, 5, 10],
        [4, 10, 11],
        [5, 11, 10],
        [5, 9, 11],
        [9, 6, 11],
    ];
    let merged = verify(&plc, &fan(&[&sides[..], &without_edge].concat()), any);
    assert_kinds(&merged, &[]);
    assert!(merged.counts.segments_merged > 0, "{merged}");
}

#[test]
fn degenerate_facets_claim_nothing() {
    let (mut plc, mesh) = cube();
    plc.vertices.push([0.5, 0.5, 0.5]);
    plc.facets.push(facet(&[0, 7, 8]));
    plc.facets.push(facet(&[0, 1, 1]));
    let six = run(&plc, &mesh);
    // The vertex is in the domain, the facet is nothing.
    assert_kinds(&six, &["missing vertex"]);
    assert_eq!(six.counts.facets_degenerate, 2);
    plc.vertices.pop();
    plc.facets.remove(6);
    // A diagonal that the mesh does not have, as a facet without an area; and a corner twice.
    plc.facets.push(facet(&[1, 6, 1]));
    let first = plc.facets[0].polygons[0][0];
    plc.facets[0].polygons[0].insert(0, first);
    let verdict = run(&plc, &mesh);
    assert_kinds(&verdict, &[]);
    assert!(
        verdict
            .notes
            .iter()
            .any(|n| n.code == NoteCode::DegenerateFacets)
    );
}

#[test]
fn any_triangulation_is_all_but_delaunay() {
    let vertices = bipyramid(1.0);
    let plc = plc(&vertices, &BIPYRAMID);
    let two = mesh(&vertices, &TWO);
    assert_kinds(&run(&plc, &two), &["not locally Delaunay"]);
    let any = VerifyOptions {
        any_triangulation: true,
        ..VerifyOptions::default()
    };
    let verdict = verify(&plc, &two, any);
    assert_kinds(&verdict, &[]);
    assert_eq!(verdict.notes[0].code, NoteCode::AnyTriangulation);
    let half = mesh(&vertices, &TWO[..1]);
    assert!(!verify(&plc, &half, any).is_ok());
}

/// A patch on the floor of a box, with the same marker or another one: only in the first case its edges may be gone.
#[test]
fn a_facet_inside_another_one() {
    let (mut plc, _) = cube();
    let corners = [[0.25, 0.25, 0.0], [0.75, 0.25, 0.0], [0.5, 0.75, 0.0]];
    plc.vertices.extend(corners);
    plc.facets.push(facet(&[8, 9, 10]));
    // From vertex 7 over the floor with the patch, and over the two sides that do not have 7.
    let floor = [
        [8, 9, 10],
        [0, 1, 8],
        [1, 9, 8],
        [1, 3, 9],
        [3, 10, 9],
        [3, 2, 10],
        [2, 8, 10],
        [2, 0, 8],
    ];
    let without_patch = [
        [0, 1, 9],
        [0, 9, 8],
        [1, 3, 9],
        [8, 9, 10],
        [3, 10, 9],
        [3, 2, 10],
        [2, 8, 10],
        [2, 0, 8],
    ];
    let flipped = [
        [0, 1, 9],
        [0, 9, 2],
        [2, 9, 10],
        [1, 3, 9],
        [3, 10, 9],
        [3, 2, 10],
    ];
    let sides = [[0, 1, 5], [0, 5, 4], [0, 2, 6], [0, 6, 4]];
    let fan = |floor: &[[u32; 3]], vertices: usize| {
        let triangles = floor.iter().chain(&sides);
        let tets: Vec<[u32; 4]> = triangles.map(|&[a, b, c]| [7, a, b, c]).collect();
        mesh(&plc.vertices[..vertices], &tets)
    };
    let any = VerifyOptions {
        any_triangulation: true,
        ..VerifyOptions::default()
    };
    for floor in [floor, without_patch] {
        assert_kinds(&verify(&plc, &fan(&floor, 11), any), &[]);
    }
    // A mesh without vertex 8 and so without two of the edges of the patch.
    let mut patched = plc.clone();
    patched.vertices[8] = plc.vertices[9];
    patched.facets.pop();
    patched.facets.push(facet(&[9, 10, 2]));
    let kept = verify(&patched, &fan(&flipped, 11), any);
    assert_kinds(&kept, &[]);
    // The patch 1, 10, 2 is cut by the edges of this mesh.
    let mut crossed = patched.clone();
    crossed.facets.pop();
    crossed.facets.push(facet(&[1, 10, 2]));
    let same = verify(&crossed, &fan(&flipped, 11), any);
    assert_kinds(&same, &[]);
    assert!(same.counts.segments_merged > 0, "{same}");
    let last = crossed.facets.len() - 1;
    crossed.facets[last].marker = 6;
    let other = verify(&crossed, &fan(&flipped, 11), any);
    assert!(other.totals.contains_key("missing segment"), "{other}");
}
