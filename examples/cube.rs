//! Meshes a cube and verifies the mesh.

use tetflip::cdt::{MeshError, MeshOptions, Meshed};
use tetflip::exchange::{Facet, Plc};
use tetflip::mesh::VertexId;
use tetflip::verify::{VerifyOptions, verify};

fn main() -> Result<(), MeshError> {
    // The corners of the unit cube, numbered by the bits x, y, z, and its six faces.
    let vertices = (0..8u8)
        .map(|i| [i & 1, i >> 1 & 1, i >> 2].map(f64::from))
        .collect();
    let faces = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let facets = faces
        .map(|corners| Facet {
            polygons: vec![corners.map(VertexId).to_vec()],
            ..Facet::default()
        })
        .into();
    let plc = Plc {
        vertices,
        facets,
        ..Plc::default()
    };

    // By default: polygons are inserted by flips in exact order, and the inside is kept.
    let Meshed { mesh, report } = tetflip::mesh(&plc, &MeshOptions::default())?;
    assert_eq!(report.steiner_points, 0);
    assert!(report.notes.is_empty());
    assert_eq!(mesh.vertices, plc.vertices);
    assert_eq!(mesh.faces.len(), 12);

    // Do not believe it: check it, exactly.
    let verdict = verify(&plc, &mesh, VerifyOptions::default());
    assert!(verdict.is_ok(), "{verdict}");
    assert_eq!(verdict.counts.volume, 1.0);
    Ok(())
}
