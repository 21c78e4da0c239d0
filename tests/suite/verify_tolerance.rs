//! Steiner points within the tolerance of their facets do not make tetrahedra overlap unnoticed.

use crate::meshes::*;
use tetflip::exchange::{ExportedMesh, Plc};
use tetflip::verify::{VerifyOptions, verify};

const ULP: f64 = f64::EPSILON;

/// Two unit boxes, the second of which begins at `gap` above the first; the top of the first has a vertex at `height`
/// above it in its middle, and the bottom of the second is divided by a diagonal.
fn boxes(gap: f64, height: f64) -> (Plc, ExportedMesh) {
    let mut vertices = cube_vertices();
    let shifted = cube_vertices()
        .into_iter()
        .map(|[x, y, z]| [x, y, if z == 0.0 { 1.0 + gap } else { 2.0 }]);
    vertices.extend(shifted);
    let input = vertices.clone();
    vertices.push([0.5, 0.25, 1.0 + height]);
    let facets: Vec<Vec<u32>> = [0, 8]
        .iter()
        .flat_map(|first| CUBE.map(|f| f.iter().map(|v| first + v).collect()))
        .collect();
    let plc = plc(&input, &facets.iter().map(|f| &f[..]).collect::<Vec<_>>());
    // From the middle of the first box's top over all its faces that are not in this; the second as it is.
    let top = 16;
    let mut tets: Vec<[u32; 4]> = Vec::new();
    for f in CUBE {
        if f.iter().any(|&v| v < 4) {
            let quads: [u32; 4] = f.try_into().expect("a square");
            let [a, b, c, d] = quads;
            tets.extend([[a, b, c, top], [a, c, d, top]]);
        }
    }
    tets.extend(SIX.map(|t| t.map(|v| v + 8)));
    (plc, mesh(&vertices, &tets))
}

#[test]
fn a_spike_within_the_tolerance_pierces_nothing() {
    let any = VerifyOptions {
        any_triangulation: true,
        ..VerifyOptions::default()
    };
    for (gap, height, crosses) in [
        (4.0, 12.0, true),
        (4.0, 5.0, true),
        (4.0, 4.0, true),
        (4.0, 2.0, false),
        (4.0, 0.0, false),
        (4.0, -8.0, false),
        (64.0, 12.0, false),
    ] {
        let (plc, mesh) = boxes(gap * ULP, height * ULP);
        let verdict = verify(&plc, &mesh, any);
        assert_eq!(
            verdict.totals.contains_key("boundary crosses"),
            crosses,
            "{verdict}"
        );
        assert_eq!(verdict.is_ok(), !crosses, "{verdict}");
        assert!(verdict.counts.faces_compared >= 4);
        let strict = VerifyOptions {
            tolerance: 0.0,
            ..any
        };
        assert_eq!(verify(&plc, &mesh, strict).is_ok(), height == 0.0);
    }
}
