//! Regions, caps on lists, voids, extreme coordinates, odd tolerances.

use super::*;

#[test]
fn regions() {
    let (mut plc, mut mesh) = two_cubes(&[0, 1]);
    for (x, attribute) in [(0.5, 3.0), (1.5, 4.0)] {
        let point = [x, 0.25, 0.625];
        plc.regions.push(Region {
            point,
            attribute,
            max_volume: None,
        });
    }
    mesh.regions = [[3.0; 6], [4.0; 6]].concat();
    let verdict = run(&plc, &mesh);
    assert_kinds(&verdict, &[]);
    assert_eq!(verdict.counts.regions, 2);
    mesh.regions[0] = 4.0;
    assert_kinds(&run(&plc, &mesh), &["region leaks"]);
    mesh.regions = vec![4.0; 12];
    assert_kinds(&run(&plc, &mesh), &["wrong region"]);
}

#[test]
fn lists_are_capped_and_totals_are_not() {
    let (plc, mut mesh) = cube();
    mesh.tets.iter_mut().take(3).for_each(|t| t.swap(0, 1));
    let options = VerifyOptions {
        cap: 1,
        ..VerifyOptions::default()
    };
    let verdict = verify(&plc, &mesh, options);
    assert_eq!(verdict.totals["orientation"], 3);
    let listed = verdict
        .violations
        .iter()
        .filter(|v| v.kind() == "orientation")
        .count();
    assert_eq!(listed, 1);
    let text = verdict.to_string();
    assert!(text.contains("VIOLATED orientation: 3") && text.ends_with("refused"));
}

/// A spike pierces four tetrahedra, and the void below them is as large as the spike: the shell of the two encloses as
/// much as it leaves out, and the hull is filled as far as volumes tell.
#[test]
fn a_void_does_not_pay_for_a_spike() {
    let vertices = [
        [8.0, 0.0, 0.0],
        [0.0, 8.0, 0.0],
        [-8.0, 0.0, 0.0],
        [0.0, -8.0, 0.0],
        [0.0, 0.0, 8.0],
        [0.0, 0.0, -8.0],
        [3.0, 0.0, 0.0],
        [-1.0, 2.0, 0.0],
        [-1.0, -2.0, 0.0],
        [0.5, 0.25, 4.0],
        [0.0, 0.0, 0.25],
    ];
    let tets = [
        [0, 1, 6, 5],
        [6, 0, 3, 5],
        [2, 1, 7, 5],
        [7, 1, 6, 5],
        [3, 2, 8, 5],
        [8, 2, 7, 5],
        [6, 3, 8, 5],
        [7, 6, 8, 5],
        [6, 7, 8, 9],
        [0, 1, 10, 4],
        [1, 2, 10, 4],
        [2, 3, 10, 4],
        [3, 0, 10, 4],
    ];
    let points = plc(&vertices, &[]);
    for domain in [Domain::Auto, Domain::Hull] {
        let verdict = run_as(domain, &points, &mesh(&vertices, &tets));
        assert!(
            verdict.totals.contains_key("boundary without volume"),
            "{verdict}"
        );
    }
}

/// Neither an ulp beyond the largest double nor a normal that underflows stops the verifier.
#[test]
fn extreme_coordinates_have_a_verdict() {
    let m = f64::MAX;
    let corners = [[0.0; 3], [m, 0.0, 0.0], [0.0, m, 0.0], [0.0, 0.0, m]];
    let mut one = mesh(&corners, &[]);
    one.tets.push(ids([0, 1, 2, 3]));
    assert_kinds(&run(&plc(&corners, &[]), &one), &[]);
    for scale in [1e-85, 1e-90, 1e-100, 1.0] {
        let scaled = |p: [f64; 3]| p.map(|x| x * scale);
        let vertices = [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [1.0, 1.0, 0.125],
            [0.0, 1.0, 0.0],
            [0.5, 0.5, 1.0],
            [0.5, 0.5, 0.03125],
        ]
        .map(scaled);
        let square = plc(&vertices[..5], &[&[0, 1, 2, 3]]);
        let tets = [[0, 1, 5, 4], [1, 2, 5, 4], [2, 3, 5, 4], [3, 0, 5, 4]];
        let mut cone = mesh(&vertices, &[]);
        cone.tets.extend(tets.map(ids));
        // Whatever it is, there is one.
        let verdict = run_as(Domain::Hull, &square, &cone);
        assert_eq!(verdict.counts.tets, 4);
    }
}

/// A facet with an edge at right angles to the rest of it, the mesh of which has all edges: what of it is covered
/// cannot be told.
#[test]
fn an_upright_edge_in_a_facet() {
    let (mut plc, mesh) = cube();
    let corners = plc.facets[0].polygons[0].clone();
    let at = |v: VertexId| plc.vertices[v.index()];
    let differences = |v: VertexId, w: VertexId| (0..3).filter(|&k| at(v)[k] != at(w)[k]).count();
    let mut others = (0..8).map(VertexId).filter(|v| !corners.contains(v));
    let above = others.find(|&w| differences(corners[0], w) == 1);
    let above = above.expect("a cube");
    plc.facets[0].polygons.push(vec![corners[0], above]);
    assert_kinds(&run(&plc, &mesh), &["facet upright"]);
}

/// A tolerance that is no number, or below zero, forgives nothing.
#[test]
fn odd_tolerances() {
    let (plc, mut mesh) = cube();
    let with = |mesh: &ExportedMesh, tolerance| {
        let options = VerifyOptions {
            tolerance,
            ..VerifyOptions::default()
        };
        verify(&plc, mesh, options).is_ok()
    };
    assert!(with(&mesh, f64::NAN) && with(&mesh, -1.0));
    mesh.vertices[0][0] += 1e-15;
    assert!(!with(&mesh, f64::NAN) && !with(&mesh, -1e300));
}
