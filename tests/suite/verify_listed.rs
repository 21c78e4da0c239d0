//! The verifier compares the faces that a mesh lists, and their markers, with the facets of the input.

use crate::meshes::*;
use tetflip::exchange::{ExportedFace, ExportedMesh, NoteCode, Plc, Region};
use tetflip::mesh::VertexId;
use tetflip::verify::Domain;

/// Two cubes with markers 1 to 11, and all their faces, outward and from the left cube to the right one.
fn marked() -> (Plc, ExportedMesh) {
    let (mut plc, mut mesh) = two_cubes(&[0, 1]);
    for (i, facet) in plc.facets.iter_mut().enumerate() {
        facet.marker = i as i64 + 1;
    }
    for (x, attribute) in [(0.5, 3.0), (1.5, 4.0)] {
        plc.regions.push(Region {
            point: [x, 0.25, 0.625],
            attribute,
            max_volume: None,
        });
    }
    mesh.regions = [[3.0; 6], [4.0; 6]].concat();
    for (t, tet) in mesh.tets.clone().into_iter().enumerate() {
        for k in 0..4 {
            let [a, b, c] = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]][k].map(|i| tet[i]);
            let on =
                |f: &&tetflip::exchange::Facet| [a, b, c].iter().all(|v| f.polygons[0].contains(v));
            let wall = |v: VertexId| v.0 % 3 == 1;
            let Some(facet) = plc.facets.iter().find(on) else {
                continue;
            };
            if t >= 6 && [a, b, c].into_iter().all(wall) {
                continue;
            }
            mesh.faces.push(ExportedFace {
                vertices: [a, b, c],
                marker: facet.marker,
            });
        }
    }
    (plc, mesh)
}

#[test]
fn all_faces_with_their_markers_are_accepted() {
    let (plc, mesh) = marked();
    assert_eq!(mesh.faces.len(), 22);
    let verdict = run(&plc, &mesh);
    assert_kinds(&verdict, &[]);
    assert_eq!(
        (verdict.counts.markers, verdict.counts.faces_inward),
        (22, 0)
    );
    assert!(verdict.notes.is_empty(), "{:?}", verdict.notes);
}

#[test]
fn no_altered_marker_is_accepted() {
    let (plc, mesh) = marked();
    for f in 0..mesh.faces.len() {
        for marker in [0, 777, mesh.faces[f].marker % 11 + 1] {
            let mut altered = mesh.clone();
            altered.faces[f].marker = marker;
            assert_kinds(&run(&plc, &altered), &["wrong marker"]);
        }
    }
    let mut altered = mesh.clone();
    altered.faces.iter_mut().for_each(|f| f.marker = 777);
    assert_eq!(run(&plc, &altered).totals["wrong marker"], 22);
}

#[test]
fn no_face_may_be_missing_from_the_list_or_too_many() {
    let (plc, mesh) = marked();
    for f in 0..mesh.faces.len() {
        let mut dropped = mesh.clone();
        dropped.faces.remove(f);
        assert_kinds(&run(&plc, &dropped), &["face not listed"]);
    }
    // Without a list nothing is missing.
    let bare = ExportedMesh {
        faces: Vec::new(),
        ..mesh.clone()
    };
    assert_kinds(&run(&plc, &bare), &[]);
    // An inner face, in place of another one or beside them.
    let [a, b, c, d] = mesh.tets[0];
    let listed = |t: [VertexId; 3]| {
        mesh.faces
            .iter()
            .any(|f| t.iter().all(|v| f.vertices.contains(v)))
    };
    let inner = [[a, b, c], [a, b, d], [a, c, d], [b, c, d]]
        .into_iter()
        .find(|t| !listed(*t))
        .expect("an inner face");
    for f in 0..mesh.faces.len() {
        let mut swapped = mesh.clone();
        swapped.faces[f].vertices = inner;
        assert_kinds(
            &run(&plc, &swapped),
            &["face not listed", "listed but not on a facet"],
        );
    }
    for marker in [0, 1, 5] {
        let mut more = mesh.clone();
        more.faces.push(ExportedFace {
            vertices: inner,
            marker,
        });
        assert_kinds(&run(&plc, &more), &["listed but not on a facet"]);
    }
}

#[test]
fn faces_that_turn_the_other_way_are_said() {
    let (plc, mesh) = marked();
    for f in 0..mesh.faces.len() {
        let mut turned = mesh.clone();
        turned.faces[f].vertices.swap(0, 1);
        let verdict = run(&plc, &turned);
        assert_kinds(&verdict, &[]);
        let is_wall = mesh.faces[f].vertices.iter().all(|v| v.0 % 3 == 1);
        assert_eq!(verdict.counts.faces_turned, 20);
        assert_eq!(verdict.counts.faces_inward, usize::from(!is_wall));
    }
}

/// Other programs write 1 or −1 where the input has no marker; anything else is a marker that the input does not have.
#[test]
fn unmarked_facets_have_unmarked_faces() {
    let (mut plc, mesh) = marked();
    plc.facets.iter_mut().for_each(|f| f.marker = 0);
    for (marker, kinds) in [(0, &[][..]), (1, &[]), (-1, &[]), (2, &["wrong marker"])] {
        let mut marked = mesh.clone();
        marked.faces.iter_mut().for_each(|f| f.marker = marker);
        let verdict = run(&plc, &marked);
        assert_kinds(&verdict, kinds);
        let said = verdict
            .notes
            .iter()
            .any(|n| n.code == NoteCode::MissingMarkers);
        assert_eq!(said, marker.abs() == 1);
    }
}

/// The hull of an L of three cubes: what fills the notch is in no region of the input.
#[test]
fn the_hull_is_accepted_where_it_is_asked_for() {
    let (mut plc, both) = two_cubes(&[0, 1]);
    assert_kinds(&run(&plc, &both), &[]);
    // Without the right side the facets enclose the left cube only.
    let right = plc.facets.len() - 1;
    let open = |f: &tetflip::exchange::Facet| f.polygons[0].iter().all(|v| v.0 % 3 == 2);
    let right = plc.facets.iter().position(open).unwrap_or(right);
    plc.facets.remove(right);
    assert_kinds(&run(&plc, &both), &["boundary not on facet"]);
    assert_kinds(
        &run_as(Domain::Inside, &plc, &both),
        &["boundary not on facet"],
    );
    assert_kinds(&run_as(Domain::Hull, &plc, &both), &[]);
    // Where they enclose nothing, the hull is all that there is.
    plc.facets.truncate(3);
    let verdict = run(&plc, &both);
    assert_kinds(&verdict, &[]);
    assert_eq!(verdict.counts.domain, Domain::Hull);
    // A hole point in it is not meshed unless that is asked for.
    plc.holes.push([0.5, 0.25, 0.625]);
    assert_kinds(&run(&plc, &both), &["hole meshed"]);
    assert_kinds(&run_as(Domain::Hull, &plc, &both), &[]);
}
