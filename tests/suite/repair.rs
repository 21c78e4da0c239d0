//! What is repaired in an input becomes a mesh of the right volume.

use crate::common::quiet;
use proptest::prelude::*;
use tetflip::cdt::{Options, tetrahedralize};
use tetflip::exchange::{ExportedMesh, Facet, NoteCode, Plc};
use tetflip::mesh::VertexId;
use tetflip::repair::{RepairOptions, repair};
use tetflip::report::Report;
use tetflip::verify::{Domain, VerifyOptions, verify};

/// A box with vertices of its own, made of triangles.
fn add_box(plc: &mut Plc, low: [i32; 3], high: [i32; 3]) {
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
        for corners in [vec![a, b, c], vec![a, c, d]] {
            plc.facets.push(Facet {
                polygons: vec![corners],
                ..Facet::default()
            });
        }
    }
}

fn volume(mesh: &ExportedMesh) -> f64 {
    let of = |tet: &[VertexId; 4]| {
        let [a, b, c, d] = tet.map(|v| mesh.vertices[v.index()]);
        let [u, v, w] = [b, c, d].map(|p| [0, 1, 2].map(|k| p[k] - a[k]));
        let cross = [
            v[1] * w[2] - v[2] * w[1],
            v[2] * w[0] - v[0] * w[2],
            v[0] * w[1] - v[1] * w[0],
        ];
        (u[0] * cross[0] + u[1] * cross[1] + u[2] * cross[2]) / 6.0
    };
    mesh.tets.iter().map(of).sum()
}

/// The mesh of the repaired input, which is verified against that.
fn meshed(plc: &Plc) -> (ExportedMesh, Vec<NoteCode>) {
    let repaired = repair(plc, RepairOptions::default()).unwrap();
    let mut report = Report::default();
    let mesh = tetrahedralize(&repaired.plc, &Options::default(), &mut report, &mut quiet).unwrap();
    let options = VerifyOptions {
        domain: Domain::Inside,
        ..VerifyOptions::default()
    };
    let verdict = verify(&repaired.plc, &mesh, options);
    assert!(verdict.is_ok(), "{verdict}");
    (mesh, repaired.notes.iter().map(|note| note.code).collect())
}

#[test]
fn two_solids_with_a_wall_each() {
    let mut plc = Plc::default();
    add_box(&mut plc, [0, 0, 0], [2, 2, 2]);
    add_box(&mut plc, [2, 0, 0], [4, 2, 2]);
    let (mesh, notes) = meshed(&plc);
    assert!((volume(&mesh) - 16.0).abs() < 1e-12);
    assert_eq!(notes, [NoteCode::RepeatedFacets]);
}

#[test]
fn a_smaller_box_on_a_box() {
    let mut plc = Plc::default();
    add_box(&mut plc, [0, 0, 0], [6, 6, 2]);
    add_box(&mut plc, [1, 2, 2], [4, 4, 7]);
    let (mesh, notes) = meshed(&plc);
    assert!((volume(&mesh) - 102.0).abs() < 1e-12);
    assert!(notes.contains(&NoteCode::FacetsOverlap));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    /// Boxes side by side, each as wide and as deep as it likes, with a common corner line.
    #[test]
    fn rows_of_boxes(sizes in prop::collection::vec(prop::array::uniform3(1..5i32), 2..5)) {
        let (mut plc, mut x, mut wanted) = (Plc::default(), 0, 0);
        for &[a, b, c] in &sizes {
            add_box(&mut plc, [x, 0, 0], [x + a, b, c]);
            x += a;
            wanted += a * b * c;
        }
        // Where the one is wider and the other deeper, their walls cross.
        let crosses = sizes.windows(2).any(|p| (p[0][1] - p[1][1]) * (p[0][2] - p[1][2]) < 0);
        if crosses {
            prop_assert!(repair(&plc, RepairOptions::default()).is_err());
        } else {
            let (mesh, _) = meshed(&plc);
            prop_assert!((volume(&mesh) - f64::from(wanted)).abs() < 1e-9);
        }
    }
}
