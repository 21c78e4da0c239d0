//! The verifier accepts right meshes and names what is wrong with wrong ones: each kind of violation, from a small mesh
//! that has it.

mod extremes;

use crate::meshes::*;
use tetflip::exchange::{ExportedEdge, ExportedFace, ExportedMesh};
use tetflip::exchange::{Region, Segment};
use tetflip::mesh::VertexId;
use tetflip::verify::{Domain, VerifyOptions, Violation, verify};

#[test]
fn cubes_are_accepted() {
    let (plc, six) = cube();
    for mesh in [six, mesh(&cube_vertices(), &FIVE)] {
        for domain in [Domain::Auto, Domain::Hull, Domain::Inside] {
            let verdict = run_as(domain, &plc, &mesh);
            assert_kinds(&verdict, &[]);
            assert_eq!(verdict.counts.volume, 1.0);
            assert_eq!((verdict.counts.segments, verdict.counts.facets), (12, 6));
            assert_eq!(verdict.counts.constrained_faces, 12);
            assert_eq!(
                verdict.counts.cospherical_faces,
                verdict.counts.unconstrained_faces
            );
        }
    }
}

/// Integers decide only what doubles do not: where coordinates are small integers, at most one sign for each facet,
/// that it is a line in one projection.
#[test]
fn exact_signs_are_counted() {
    let (mut plc, mut mesh) = cube();
    let few = run(&plc, &mesh).counts.exact_signs;
    assert!(few <= plc.facets.len());
    for p in plc.vertices.iter_mut().chain(&mut mesh.vertices) {
        *p = p.map(|x| 0.1 + x / 3.0);
    }
    let verdict = run(&plc, &mesh);
    assert_kinds(&verdict, &[]);
    // All inner faces are cospherical.
    assert!(verdict.counts.exact_signs >= few + verdict.counts.unconstrained_faces);
}

/// Where only points are given, faces that nobody asks for are counted, but not kept.
#[test]
fn points_only() {
    let vertices = bipyramid(1.0);
    let points = plc(&vertices, &[]);
    let mut right = mesh(&vertices, &THREE);
    let listed = |v| ExportedFace {
        vertices: ids(v),
        marker: 0,
    };
    right.faces.push(listed([0, 3, 4]));
    assert_kinds(&run(&points, &right), &["listed but not on a facet"]);
    right.faces[0] = listed([0, 1, 4]);
    let verdict = run(&points, &right);
    assert_kinds(&verdict, &[]);
    assert_eq!(
        (verdict.counts.faces, verdict.counts.boundary_faces),
        (9, 6)
    );
    assert_eq!(verdict.counts.unconstrained_faces, 3);
    assert_kinds(
        &run(&points, &mesh(&vertices, &TWO)),
        &["not locally Delaunay"],
    );
    right.faces[0].vertices = ids([0, 1, 2]);
    assert_kinds(&run(&points, &right), &["listed but not in mesh"]);
}

#[test]
fn the_other_orientation_is_accepted_and_said() {
    let (plc, mut mesh) = cube();
    for t in &mut mesh.tets {
        t.swap(0, 1);
    }
    let verdict = run(&plc, &mesh);
    assert_kinds(&verdict, &[]);
    assert!(verdict.counts.turned);
}

#[test]
fn an_inverted_tetrahedron() {
    let (mut plc, mut mesh) = cube();
    // Away from the origin, where the cones over all faces have a volume.
    for p in plc.vertices.iter_mut().chain(&mut mesh.vertices) {
        *p = [p[0] + 1.0, p[1] + 2.0, p[2] + 4.0];
    }
    mesh.tets[2].swap(0, 1);
    let verdict = run(&plc, &mesh);
    assert!(matches!(
        verdict.violations[0],
        Violation::Orientation {
            tet: 2,
            flat: false,
            ..
        }
    ));
    assert!(verdict.totals.contains_key("same side") && verdict.totals.contains_key("volume"));
}

#[test]
fn a_flat_tetrahedron() {
    let (plc, mut mesh) = cube();
    mesh.tets.push(ids([4, 5, 7, 6]));
    let verdict = run(&plc, &mesh);
    assert!(matches!(
        verdict.violations[0],
        Violation::Orientation {
            tet: 6,
            flat: true,
            ..
        }
    ));
}

#[test]
fn a_missing_tetrahedron() {
    let (plc, mut mesh) = cube();
    mesh.tets.remove(0);
    let verdict = run(&plc, &mesh);
    assert_kinds(&verdict, &["boundary not on facet", "facet not covered"]);
    let verdict = run_as(Domain::Hull, &plc, &mesh);
    assert_kinds(
        &verdict,
        &["facet not covered", "hull not convex", "missing segment"],
    );
}

#[test]
fn overlapping_tetrahedra() {
    let (plc, six) = cube();
    // One of its own inside the cube.
    let mut vertices = cube_vertices();
    vertices.extend([
        [0.3, 0.1, 0.1],
        [0.4, 0.1, 0.1],
        [0.3, 0.2, 0.1],
        [0.3, 0.1, 0.2],
    ]);
    let inner = mesh(&vertices, &[&SIX[..], &[[8, 9, 10, 11]]].concat());
    assert_kinds(&run(&plc, &inner), &["boundary not on facet", "overlap"]);
    // A second one on the inner side of a boundary face.
    let mut vertices = cube_vertices();
    vertices.push([0.6, 0.3, 0.1]);
    let on_face = mesh(&vertices, &[&SIX[..], &[[0, 1, 3, 8]]].concat());
    let verdict = run(&plc, &on_face);
    assert!(verdict.totals.contains_key("same side") && verdict.totals.contains_key("overlap"));
    // A third one on an interior face.
    let crowded = mesh(&vertices, &[&SIX[..], &[[0, 1, 7, 8]]].concat());
    assert!(run(&plc, &crowded).totals.contains_key("crowded face"));
    // The same one twice.
    let mut twice = six;
    twice.tets.push(twice.tets[0]);
    assert!(run(&plc, &twice).totals.contains_key("crowded face"));
}

#[test]
fn a_face_that_is_not_locally_delaunay() {
    for (h, right, wrong) in [(1.0, &THREE[..], &TWO[..]), (5.0, &TWO, &THREE)] {
        let vertices = bipyramid(h);
        let plc = plc(&vertices, &BIPYRAMID);
        assert_kinds(&run(&plc, &mesh(&vertices, right)), &[]);
        let verdict = run(&plc, &mesh(&vertices, wrong));
        assert_kinds(&verdict, &["not locally Delaunay"]);
        let Violation::NotLocallyDelaunay { face, apexes, .. } = &verdict.violations[0] else {
            panic!("{verdict}");
        };
        let mut five: Vec<u32> = face.iter().chain(apexes).map(|p| p.id.0).collect();
        five.sort_unstable();
        assert_eq!(five, [0, 1, 2, 3, 4]);
    }
}

#[test]
fn a_constraint_excuses_its_faces() {
    let vertices = bipyramid(1.0);
    let mut with_wall = plc(&vertices, &BIPYRAMID);
    with_wall.facets.push(facet(&[0, 1, 2]));
    let verdict = run(&with_wall, &mesh(&vertices, &TWO));
    assert_kinds(&verdict, &[]);
    assert_eq!(verdict.counts.unconstrained_faces, 0);
    // All its edges are there, the facet is not.
    assert_kinds(
        &run(&with_wall, &mesh(&vertices, &THREE)),
        &["facet not covered"],
    );
}

#[test]
fn a_missing_segment() {
    let vertices = bipyramid(5.0);
    let mut with_axis = plc(&vertices, &BIPYRAMID);
    with_axis.segments.push(Segment {
        ends: ids([3, 4]),
        marker: 0,
    });
    let verdict = run(&with_axis, &mesh(&vertices, &TWO));
    assert_kinds(&verdict, &["missing segment"]);
    let Violation::MissingSegment { ends, facets } = &verdict.violations[0] else {
        panic!("{verdict}")
    };
    assert_eq!(ends.map(|p| p.id.0), [3, 4]);
    assert!(facets.is_empty());
}

#[test]
fn an_edge_between_coplanar_facets_may_be_merged() {
    let five = mesh(&cube_vertices(), &FIVE);
    let verdict = run(&split_top([5, 6]), &five);
    assert_kinds(&verdict, &[]);
    assert_eq!(
        (verdict.counts.segments_merged, verdict.counts.facet_groups),
        (0, 7)
    );
    let mut other = split_top([4, 7]);
    let verdict = run(&other, &five);
    assert_kinds(&verdict, &[]);
    assert_eq!(
        (verdict.counts.segments_merged, verdict.counts.facet_groups),
        (1, 6)
    );
    // But not if it is listed as a segment, or the facets have different markers.
    other.segments.push(Segment {
        ends: ids([4, 7]),
        marker: 0,
    });
    assert!(run(&other, &five).totals.contains_key("missing segment"));
    other.segments.clear();
    other.facets[6].marker = 3;
    assert!(run(&other, &five).totals.contains_key("missing segment"));
}

#[test]
fn nearly_coplanar_facets_merge_only_by_permission() {
    let mut vertices = cube_vertices();
    vertices[7][2] += 1e-6;
    let mut plc = split_top([4, 7]);
    plc.vertices = vertices.clone();
    // The three facets at vertex 7 stay flat; the top bends along 4–7, and the mesh along 5–6.
    let five = mesh(&vertices, &FIVE);
    let strict = run(&plc, &five);
    assert!(
        strict.totals.contains_key("boundary not on facet"),
        "{strict}"
    );
    let options = VerifyOptions {
        merge_angle: Some(179.9),
        ..VerifyOptions::default()
    };
    let verdict = verify(&plc, &five, options);
    assert!(
        !verdict.totals.contains_key("boundary not on facet"),
        "{verdict}"
    );
    assert!(
        !verdict.totals.contains_key("facet not covered"),
        "{verdict}"
    );
    assert_eq!(verdict.counts.segments_merged, 1);
}

#[test]
fn steiner_points_on_segments() {
    // A long segment that no point halves exactly in doubles: 0.1·k. The mesh: a tetrahedron cut in two at its edge ab.
    let (a, b) = ([0.1, 0.1, 0.1], [0.7, 0.3, 0.2]);
    let split = |s: [f64; 3]| {
        let vertices = vec![a, b, [0., 1., 0.], [0., 0., 1.], s];
        let plc = plc(
            &vertices[..4],
            &[&[0, 1, 2], &[0, 1, 3], &[0, 2, 3], &[1, 2, 3]],
        );
        (plc, mesh(&vertices, &[[0, 4, 2, 3], [4, 1, 2, 3]]))
    };
    let third = [0, 1, 2].map(|i| a[i] + (b[i] - a[i]) / 3.0);
    let (plc, mesh) = split(third);
    let verdict = run(&plc, &mesh);
    assert_kinds(&verdict, &[]);
    assert_eq!(
        (
            verdict.counts.segment_vertices_rounded,
            verdict.counts.steiner_vertices
        ),
        (1, 1)
    );
    let strict = VerifyOptions {
        tolerance: 0.0,
        ..VerifyOptions::default()
    };
    assert!(!verify(&plc, &mesh, strict).is_ok());
    let (plc, mesh) = split([third[0], third[1], third[2] + 1e-12]);
    assert!(!run(&plc, &mesh).is_ok());
}

#[test]
fn a_closed_chamber_must_be_meshed() {
    let (plc, both) = two_cubes(&[0, 1]);
    assert_kinds(&run(&plc, &both), &[]);
    let (mut plc, one) = two_cubes(&[0]);
    let verdict = run(&plc, &one);
    assert_kinds(&verdict, &["missing part"]);
    assert_eq!(verdict.counts.facet_parts_outside, 5);
    let Violation::MissingPart { volume, .. } = verdict.violations[0] else {
        panic!("{verdict}")
    };
    assert_eq!(volume, 1.0);
    // A hole point there makes it right, and a hole point that is meshed does not.
    plc.holes.push([1.5, 0.25, 0.5]);
    assert_kinds(&run(&plc, &one), &[]);
    assert_kinds(&run_as(Domain::Inside, &plc, &both), &["hole meshed"]);
    assert_kinds(&run(&plc, &both), &["hole meshed"]);
    assert_eq!(run_as(Domain::Hull, &plc, &both).counts.holes_meshed, 1);
    // An open chamber needs no tetrahedra.
    plc.holes.clear();
    plc.facets.pop();
    let verdict = run(&plc, &one);
    assert_kinds(&verdict, &[]);
    assert_eq!(verdict.counts.facet_parts_outside, 4);
    // But all of the input is in a mesh of the convex hull.
    let verdict = run_as(Domain::Hull, &plc, &one);
    assert_kinds(
        &verdict,
        &["facet not covered", "missing segment", "missing vertex"],
    );
}

#[test]
fn cavities_need_hole_points() {
    let (mut plc, full) = nested(true);
    let verdict = run(&plc, &full);
    assert_kinds(&verdict, &[]);
    assert_eq!(verdict.counts.segments, 24);
    let (_, hollow) = nested(false);
    assert_kinds(&run(&plc, &hollow), &["missing part"]);
    plc.holes.push([1.5, 1.25, 1.5]);
    let verdict = run(&plc, &hollow);
    assert_kinds(&verdict, &[]);
    assert_eq!((verdict.counts.voids, verdict.counts.volume), (1, 26.0));
    assert_kinds(&run_as(Domain::Inside, &plc, &full), &["hole meshed"]);
    // The hole point outside does not open the cavity.
    plc.holes[0] = [9., 9., 9.];
    assert_kinds(&run(&plc, &hollow), &["missing part"]);
}

#[test]
fn vertices_must_be_there() {
    let (mut plc, mut mesh) = cube();
    plc.vertices.push([0.5, 0.25, 0.25]);
    plc.vertices.push([0.0, 0.0, 1.0]);
    let verdict = run(&plc, &mesh);
    assert_kinds(&verdict, &["missing vertex"]);
    assert!(
        matches!(verdict.violations[0], Violation::MissingVertex { vertex, tet: Some(_) } if vertex.id.0 == 8)
    );
    plc.vertices[8] = [3., 3., 3.];
    let verdict = run(&plc, &mesh);
    assert_kinds(&verdict, &[]);
    assert_eq!(
        (
            verdict.counts.input_vertices,
            verdict.counts.input_vertices_outside
        ),
        (9, 1)
    );
    // The order of vertices is free, but their coordinates are not.
    plc.vertices.truncate(8);
    mesh.vertices.reverse();
    mesh.tets
        .iter_mut()
        .for_each(|t| *t = t.map(|v| VertexId(7 - v.0)));
    assert_kinds(&run(&plc, &mesh), &[]);
    mesh.vertices[0][1] -= 1e-15;
    assert!(!run(&plc, &mesh).is_ok());
}

#[test]
fn vertices_must_be_distinct() {
    let (plc, mesh) = cube();
    let mut apart = mesh.clone();
    apart.vertices.push(mesh.vertices[7]);
    apart.tets[0] = apart.tets[0].map(|v| VertexId(if v.0 == 7 { 8 } else { v.0 }));
    assert!(run(&plc, &apart).totals.contains_key("coincident vertices"));
}

#[test]
fn a_mesh_that_cannot_be_read() {
    let (plc, mesh) = cube();
    let mut bad = mesh.clone();
    bad.tets[1][2] = VertexId(8);
    bad.faces.push(ExportedFace {
        vertices: ids([0, 1, 99]),
        marker: 0,
    });
    assert_kinds(&run(&plc, &bad), &["index out of range"]);
    let mut bad = mesh.clone();
    bad.vertices[3][1] = f64::NAN;
    assert_kinds(&run(&plc, &bad), &["coordinate not finite"]);
    let mut bad = mesh.clone();
    bad.tets[1][2] = bad.tets[1][0];
    bad.regions = vec![1.0];
    assert_kinds(&run(&plc, &bad), &["region count", "repeated vertex"]);
    assert_kinds(&run(&plc, &ExportedMesh::default()), &["empty mesh"]);
    let mut bad = plc.clone();
    bad.facets[0].polygons[0][0] = VertexId(8);
    assert_kinds(&run(&bad, &mesh), &["index out of range"]);
}

#[test]
fn listed_elements_must_exist() {
    let (plc, mut mesh) = cube();
    mesh.faces.push(ExportedFace {
        vertices: ids([0, 1, 6]),
        marker: 0,
    });
    mesh.edges.push(ExportedEdge {
        vertices: ids([1, 6]),
        marker: 0,
    });
    mesh.edges.push(ExportedEdge {
        vertices: ids([7, 0]),
        marker: 0,
    });
    let verdict = run(&plc, &mesh);
    assert_kinds(&verdict, &["face not listed", "listed but not in mesh"]);
    assert_eq!(verdict.totals["listed but not in mesh"], 2);
}

#[test]
fn boundaries_that_contradict_each_other() {
    // Two tetrahedra around one edge, one in the wedge of the other.
    let vertices = [
        [0., 0., 0.],
        [0., 0., 1.],
        [1., 0., 0.],
        [0., 1., 0.],
        [4., 1., 0.],
        [4., 3., 0.],
    ];
    let plc = plc(&vertices, &[]);
    let verdict = run(&plc, &mesh(&vertices, &[[0, 1, 2, 3], [0, 1, 4, 5]]));
    assert!(
        verdict.totals.contains_key("boundary not embedded"),
        "{verdict}"
    );
    // Two that meet in an edge only are no convex body.
    let vertices = [
        [0., 0., 0.],
        [0., 0., 1.],
        [1., 0., 0.],
        [1., 1., 0.],
        [-1., 0., 0.],
        [-1., -1., 0.],
    ];
    let apart = mesh(&vertices, &[[0, 1, 2, 3], [0, 1, 4, 5]]);
    let verdict = run_as(Domain::Hull, &plc, &apart);
    assert!(
        verdict.totals.contains_key("hull not manifold"),
        "{verdict}"
    );
    assert!(
        !verdict.totals.contains_key("boundary not embedded"),
        "{verdict}"
    );
}
